// Tables: cracks, energy accounts, the facts of the run, what the log said, the deck.
import { element, section } from "./dom.js";
import { MODES } from "./colours.js";
import { digits, duration, percent, quantity, shownUnit, whole } from "./format.js";

const MODE_NAMES = { 0: "not failed", 1: "opening", 2: "sliding", 3: "mixed" };

const WORDS = new Set(["mode", "account", "what"]);

/** Widths in mm, as far as they can be told apart. */
const millimetres = (m) => (1e3 * m).toFixed(Math.abs(m) >= 1e-2 ? 1 : Math.abs(m) >= 1e-3 ? 2 : 3).replace("-", "−");

function table(head, rows) {
  return element("div.scroll", element("table", element("thead", element("tr", head.map((h) => element(WORDS.has(h) ? "th.word" : "th", h)))), element("tbody", rows)));
}

export function crackTable(meta, moment) {
  const { rows, distance } = meta.crack_table;
  const box = section("cracks", "Crack widths", `The widest place of each crack: what lies within ${quantity(distance, "m", 2)} of a wider place is left out. Openings are means over a joint, over the saved moments; places are those of the undeformed body.`);
  const long = Math.max(...rows.flatMap((r) => r.place.map(Math.abs))) >= 10;
  const [unit, factor] = long ? ["m", 1] : ["mm", 1e3];
  box.append(table(["", `x [${unit}]`, `y [${unit}]`, `z [${unit}]`, "width now [mm]", "largest [mm]", "when", "sliding now [mm]", "mode", "failed at"],
    rows.map((r, i) => element("tr", element("td", String(i + 1)), r.place.map((p) => element("td", digits(p * factor, 4))),
      element("td", millimetres(r.now)), element("td.strong", millimetres(r.largest)), element("td", quantity(r.time, "s", 3)), element("td", millimetres(r.sliding)),
      element("td.word", element("i.area", { style: `background:${MODES[r.mode]}` }), MODE_NAMES[r.mode] ?? "–"), element("td", r.failed > 0 ? quantity(r.failed, "s", 3) : "holds")))));
  return box;
}

const ACCOUNTS = {
  kinetic: "of the motion", strain: "stored in the concrete", joints: "stored in joints", bars: "stored in bars", bar_joints: "stored in bar joints", contact: "stored in contact", impactors: "kinetic energy of impactors",
  fracture_I: "cracks that open", fracture_II: "cracks that slide", friction: "friction of crack faces", contact_friction: "friction in contact", bond_steel: "bond slip and yielding", dowel: "dowel action", rupture: "set free by broken bars",
  viscous: "viscous damping", mass_damping: "mass damping", local_damping: "local damping", absorbed: "absorbing boundaries", joint_inertia: "joint inertia of released joints", work_supports: "put in by supports and motions", work_forces: "put in by forces", work_gravity: "put in by gravity",
};

export function energyTable(meta, curves) {
  const names = Object.keys(ACCOUNTS).filter((n) => curves.values(`energy_${n}`));
  const last = (n) => curves.values(`energy_${n}`).at(-1);
  const largest = (n) => curves.values(`energy_${n}`).reduce((m, v) => (Math.abs(v) > Math.abs(m) ? v : m), 0);
  const put = ["work_supports", "work_forces", "work_gravity"].reduce((s, n) => s + (names.includes(n) ? last(n) : 0), 0);
  const [unit, factor] = shownUnit("J", Math.max(...names.map((n) => Math.abs(largest(n)))));
  const rows = names.filter((n) => Math.abs(largest(n)) > 0).map((n) => element("tr", element("td.word", element("code", n)), element("td.word", ACCOUNTS[n]), element("td.strong", digits(last(n) * factor, 3)), element("td", digits(largest(n) * factor, 3)), element("td", put !== 0 ? percent(last(n) / put) : "–")));
  return element("details", element("summary", "All accounts"), table(["account", "what", `at the end [${unit}]`, `largest [${unit}]`, "of what was put in"], rows));
}

export function facts(meta) {
  const box = section("facts", "The run", null);
  const { run } = meta;
  if (!run) {
    box.append(element("p.note", "run.json is written when the run ends."));
    return box;
  }
  const pairs = [["tets, joints", `${whole(run.tets)}, ${whole(run.joints)}`], ["bar elements, bar joints", `${whole(run.bar_elements)}, ${whole(run.bar_joints)}`], ["time step", `${quantity(run.dt, "s", 4).replace("ms", "ms")}`],
    ["limited by", run.stable_dt_limiter], ["mass", `${digits(run.total_mass, 4)}\u202fkg${run.added_mass > 0 ? ` + ${digits(run.added_mass, 3)}\u202fkg by mass scaling` : ""}`],
    ["joints damaged, cracked, broken", `${whole(run.joints_damaged)}, ${whole(run.joints_cracked)}, ${whole(run.joints_broken)}`],
    ["bar joints crossed, yielded", `${whole(run.bar_joints_activated)}, ${whole(run.bar_joints_yielded)}`], ["bars broken", whole(run.bars_broken)],
    ["wall time", `${duration(run.wall_seconds)} on ${run.threads} thread${run.threads === 1 ? "" : "s"} (${digits(run.tet_steps_per_second / 1e6, 3)} million tet-steps a second)`],
    ["program", `Fissura ${run.version}, kernels ${run.kernels}`], ["state hash", run.state_hash]];
  box.append(element("dl", pairs.flatMap(([name, text]) => [element("dt", name), element("dd", text)])));
  return box;
}

export function logSection(meta) {
  const box = section("log", "Said and given", null);
  box.append(element("details", element("summary", `Log (${meta.log.length} lines)`), element("pre", meta.log.map(([level, text]) => (level === "info" ? text : `${level}: ${text}`)).join("\n"))));
  if (meta.deck_text) box.append(element("details", element("summary", "The deck with every default"), element("pre", meta.deck_text)));
  return box;
}
