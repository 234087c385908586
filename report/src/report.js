// The report of one run.
import { Curves } from "./data.js";
import { element, section, select } from "./dom.js";
import { events, kineticRatio, loudSpans, mainPair, NEAR, reversals, rowAt, timeOfPeak } from "./events.js";
import { digits, duration, largestOf, percent, quantity, shown, shownUnit, whole } from "./format.js";
import { keys, LINES, markKeys, overTime, scatter } from "./plots.js";
import { showScene } from "./scene.js";
import { showBars } from "./bars.js";
import { crackTable, energyTable, facts, logSection } from "./tables.js";

export function showReport(page, numbers, state) {
  const { meta } = numbers;
  const curves = new Curves(numbers, "history");
  const times = curves.values("time") ?? new Float32Array();
  const moment = { time: meta.frames.at(-1) ?? times.at(-1) ?? 0, followers: [] };
  moment.set = (t) => {
    moment.time = t;
    moment.followers.forEach((f) => f());
  };
  page.append(heading(meta, curves));
  if (curves.rows > 1) page.append(figures(meta, curves));
  page.append(verdicts(meta, curves));
  state.peak = timeOfPeak(curves, meta);
  showScene(page, numbers, moment, state, state.peak);
  if (curves.rows > 1) {
    page.append(loadSection(meta, curves, moment));
    page.append(energySection(meta, curves, moment));
  } else page.append(element("p.note", "history.csv has no two rows yet: the curves come with the next report."));
  showBars(page, numbers, moment);
  if (meta.crack_table?.rows.length) page.append(crackTable(meta, moment));
  page.append(facts(meta));
  page.append(logSection(meta));
  page.append(element("footer", `Written ${meta.written} by Fissura ${meta.version}. SI inside; tension, opening and elongation are positive. This page holds all its numbers and asks nothing from the network.`));
  if (!meta.run) comeBack(state);
}

function heading(meta, curves) {
  const status = meta.run?.status ?? "running";
  const reached = meta.run?.time ?? curves.values("time")?.at(-1) ?? 0;
  return element("div.top",
    element("div", element("p.kicker", "Fissura report"), element("h1", meta.title), element("p.note", `Run folder ${meta.folder} · t = ${quantity(reached, "s", 4)}${meta.run ? ` · ${whole(meta.run.steps)} steps in ${duration(meta.run.wall_seconds)}` : ""}`)),
    element(`span.status.${status}`, { title: meta.run?.reason ?? "the run goes on; this page reads itself anew" }, status));
}

/** The numbers an engineer looks for first. */
function figures(meta, curves) {
  const pair = mainPair(curves, meta.deck.gauges);
  const at = (row) => `at ${pair.x.replaceAll("_", " ")} ${quantity(curves.values(pair.x)[row], curves.find(pair.x).unit, 3, pair.x)}`;
  const list = [];
  const add = (name, value, note) => list.push(element("div.figure", element("span.name", name), element("span.value", value), element("span.note", note)));
  const value = (event) => quantity(event.value, curves.find(pair.y).unit, 3, pair.y);
  const names = { peak: `peak ${pair.y.replaceAll("_", " ")}`, cracking: "first crack", yield: "first yield", rupture: "first bar breaks" };
  const found = events(curves, pair.y, meta.deck.dynamic);
  for (const name of ["peak", "cracking", "yield", "rupture"]) {
    const event = found.find((e) => e.name === name);
    if (event) add(names[name], value(event), at(event.row));
  }
  const widest = meta.crack_table?.rows[0];
  if (widest) add("widest crack", quantity(widest.largest, "m"), `at t = ${quantity(widest.time, "s")}`);
  const fragments = meta.run?.fragments;
  if (fragments?.count > 1) add("fragments", whole(fragments.count), `largest ${percent(fragments.largest[0].mass / fragments.mass)} of the mass`);
  return element("div.figures", list);
}

/** Good, look, bad: a word and a shape as well as a colour. */
function verdict(level, title, text, ...more) {
  const sign = { good: "✓", look: "!", bad: "✕", plain: "·" }[level];
  return element(`div.verdict.${level}`, element("span.sign", { "aria-hidden": "true" }, sign), element("div", element("h3", title), element("p", text), ...more));
}

function verdicts(meta, curves) {
  const { run } = meta;
  const box = element("section.verdicts", { id: "verdicts" });
  box.append(run
    ? verdict({ complete: "good", stopped: "look", failed: "bad" }[run.status] ?? "look", { complete: "Complete", stopped: "Stopped", failed: "Failed" }[run.status] ?? run.status, run.reason)
    : verdict("look", "Still running", `So far t = ${quantity(curves.values("time")?.at(-1) ?? 0, "s", 4)}. What follows is what has been saved until now.`));
  box.append(energyVerdict(run, curves), quasiStatic(meta, curves), meshVerdict(meta));
  return box;
}

function energyVerdict(run, curves) {
  const residual = run?.energy_residual ?? [...(curves.values("energy_residual") ?? [])].reduce((worst, v) => (Math.abs(v) > Math.abs(worst) ? v : worst), 0);
  const size = Math.abs(residual);
  const level = size < 0.01 ? "good" : size < 0.05 ? "look" : "bad";
  return verdict(level, level === "good" ? "Energy is balanced" : "Energy is out of balance",
    `The accounts miss at most ${percent(size)} of the energy put in (${residual < 0 ? "created" : "lost"}); below 1\u202f% is good, the run stops at 5\u202f%.`);
}

function quasiStatic(meta, curves) {
  const ratio = kineticRatio(curves);
  const pair = mainPair(curves, meta.deck.gauges);
  const marks = events(curves, pair.y, meta.deck.dynamic);
  const peak = marks.find((e) => e.name === "peak")?.row ?? -1;
  const counted = (ratio ?? []).slice(0, peak + 1).filter((r) => r !== null);
  const untilPeak = counted.length ? counted.filter((r) => r < 0.05).length / counted.length : null;
  const { run } = meta;
  const share = run?.quasi_static_share, balance = run?.force_imbalance;
  const balanced = !run || balance < BALANCE;
  const quiet = run ? run.quasi_static ?? (share > 0.9 && balanced) : untilPeak > 0.9;
  const loud = () => loudMoments(curves, ratio, marks, peak, { untilPeak, balance, balanced });
  const numbers = [];
  if (run) numbers.push(`Kinetic over internal energy is below 5\u202f% in ${percent(share)} of the time (max_kinetic_ratio ${digits(run.max_kinetic_ratio, 2)}), forces are out of balance by ${percent(balance)}${run.vibration_period > 0 ? ` (vibrations of up to ${quantity(run.vibration_period, "s", 2)} smoothed away)` : ""}.`);
  if (untilPeak !== null) numbers.push(`Up to the peak: ${percent(untilPeak, 3)} of the readings.`);
  if (quiet) return verdict("good", "Quasi-static", numbers.join(" "));
  if (meta.deck.dynamic) return verdict("plain", "Dynamic", `Inertia takes part, as the case asks for. ${numbers[0] ?? ""}`);
  if (untilPeak > 0.9 && balanced)
    return verdict("good", "Quasi-static up to the peak", `${numbers.join(" ")} What follows the peak is dynamic, as a failure is.`, ...loud());
  return verdict("look", "Inertia matters", `${numbers.join(" ")} If the test is a slow one: load more slowly, or raise mass_damping.`, ...loud());
}

const SPANS = 3, BALANCE = 0.05; // BALANCE: as sim/inertia.hpp

/** Which marks of the curve are as in a slow test, in words. None is where most readings are not quiet, so that a mark between them is there
 * by chance, or where the forces are out of balance. */
function quietMarks(marks, spans, { untilPeak, balance, balanced }) {
  if (!balanced) return `Forces are out of balance by ${percent(balance)}: no mark of the curve can be taken for that of a slow test.`;
  if (!(untilPeak > 0.5)) return `Only ${percent(untilPeak ?? 0, 3)} of the readings up to the peak are quiet: no mark of the curve can be taken for that of a slow test.`;
  const outside = marks.filter((e) => !spans.some((s) => e.row >= s.from - NEAR && e.row <= s.to + NEAR)).map((e) => e.text);
  return outside.length ? `Read where it is quiet: ${outside.join(", ")}.` : "None of the marks of the curve is read where it is quiet.";
}

/** When, up to the peak, inertia takes part, what happens then, and which marks of the curve lie outside and so are as in a slow test. */
function loudMoments(curves, ratio, marks, peak, judged) {
  if (!ratio || peak < 0) return [];
  const spans = loudSpans(ratio, peak), shown = spans.slice(0, SPANS).sort((a, b) => a.from - b.from);
  if (!shown.length) return [element("p", "Up to the peak there is no such reading: it is what follows.")];
  const times = curves.values("time"), cracked = curves.values("joints_cracked");
  const lines = shown.map(({ from, to, largest }) => {
    const [begin, end] = [from, to].map((row) => quantity(times[row], "s", 3));
    const between = begin === end ? begin : `${begin} to ${end}`;
    const joints = cracked ? cracked[to] - cracked[Math.max(0, from - 1)] : 0;
    return `${between}: up to ${percent(largest)}${joints > 0 ? `, while ${whole(joints)} ${joints === 1 ? "joint cracks" : "joints crack"}` : ""}`;
  });
  if (spans.length > shown.length) lines.push(`${whole(spans.length - shown.length)} shorter ${spans.length - shown.length === 1 ? "one" : "ones"}`);
  return [element("p", "5\u202f% and more up to the peak:"), element("ul", lines.map((l) => element("li", l))), element("p", quietMarks(marks, spans, judged))];
}

function meshVerdict(meta) {
  const said = meta.warnings.filter((w) => !/energy residual/.test(w));
  if (said.length === 0) return verdict("good", "No warnings", "Mesh, bars and loads keep the rules that are checked when a run begins.");
  return verdict("look", said.length === 1 ? "1 warning" : `${said.length} warnings`, "What the check of mesh, bars and loads says:", element("ul", said.map((w) => element("li", w))));
}

/** What the curve is. Only a load that goes to and fro on purpose has a hysteresis: an impact swings by itself. */
function curveTitle(deck, choice, curves) {
  if (choice.x === "time") return "Readings";
  if (deck.cyclic && reversals(curves.values(choice.x)).length >= 2) return "Hysteresis";
  return deck.dynamic ? "Force and displacement" : "Load and displacement";
}

const COUNTS = /^(joints_|bar_joints_|bars_broken|fragments)/;

function loadSection(meta, curves, moment) {
  const gauges = curves.columns.filter((c) => !c.name.startsWith("energy_") && !COUNTS.test(c.name));
  const choice = mainPair(curves, meta.deck.gauges);
  const box = section("load", curveTitle(meta.deck, choice, curves), null);
  const place = element("div.pair");
  const options = gauges.map((c) => [c.name, c.name.replaceAll("_", " ")]);
  const controls = element("div.controls",
    select("over", options, choice.x, (v) => ((choice.x = v), redraw())),
    select("reading", options, choice.y, (v) => ((choice.y = v), redraw())));
  let plots = [];
  const redraw = () => {
    const x = shown(curves.find(choice.x)), y = shown(curves.find(choice.y)), t = shown(curves.find("time"));
    const found = events(curves, choice.y, meta.deck.dynamic);
    const now = () => rowAt(curves.values("time"), moment.time);
    const withUnit = (c, value) => `${digits(value, 3)}${c.unit ? "\u202f" + c.unit : ""}`;
    const text = (e) => `${e.text}: ${withUnit(y, e.value * y.factor)} at ${withUnit(x, x.values[e.row])}`;
    const marks = (xs) => () => [...found.map((e) => ({ ...e, x: xs.values[e.row], y: e.value * y.factor })),
      { x: xs.values[now()], y: y.values[now()], shape: "ring", colour: "#1f2933" }];
    const said = [...found.map((e) => ({ ...e, text: text(e) })), { shape: "ring", colour: "#1f2933", text: "the moment of the 3-D view" }];
    const over = scatter("plot-load", { x: x.label, y: y.label, series: [{ x: x.values, y: y.values, label: y.name, colour: LINES[0] }], marks: marks(x), height: 340,
      tip: (s, i) => `${x.label}: ${digits(x.values[i], 4)}\n${y.label}: ${digits(y.values[i], 4)}\nt: ${digits(t.values[i], 4)}\u202f${t.unit}` });
    const history = overTime("plot-history", { x: t.label, y: y.label, times: t.values, series: [{ values: y.values, label: y.name.replaceAll("_", " "), colour: LINES[0] }],
      now: () => moment.time * t.factor, marks: marks(t), height: 340 });
    plots = choice.x === "time" ? [history] : [over, history];
    if (choice.x === "time") return place.replaceChildren(element("figure.wide", history.box, markKeys(said), element("figcaption", "Drag along the axis to zoom, double click to see all.")));
    place.replaceChildren(element("figure", over.box, markKeys(said)),
      element("figure", history.box, element("figcaption", "The same over time. Drag along the axis to zoom, double click to see all.")));
  };
  redraw();
  moment.followers.push(() => plots.forEach((p) => p.redraw()));
  box.append(controls, place, damageFigure(curves, moment));
  return box;
}

/** Counts of cracked joints and yielded bars over time. */
function damageFigure(curves, moment) {
  const t = shown(curves.find("time"));
  const wanted = [["joints_cracked", "joints cracked"], ["joints_broken", "joints broken"], ["bar_joints_activated", "bar joints crossed by a crack"], ["bar_joints_yielded", "bar joints yielded"], ["bars_broken", "bars broken"]];
  const series = wanted.filter(([name]) => largestOf(curves.values(name) ?? []) > 0).map(([name, label], i) => ({ values: Array.from(curves.values(name)), label, colour: LINES[i], dash: [null, [7, 4], [2, 3], [9, 3, 2, 3], [4, 4]][i] }));
  if (series.length === 0) return element("p.note", "No joint has cracked.");
  const plot = overTime("plot-counts", { x: t.label, y: "count", times: t.values, series, now: () => moment.time * t.factor, height: 220 });
  moment.followers.push(plot.redraw);
  return element("figure", plot.box, keys(series), element("figcaption", "Damage: how many joints have cracked and broken, how many bar joints have been crossed, have yielded and have broken."));
}

/** Accounts that belong together, from the bottom of the stack to its top. */
const STACK = [
  ["kinetic", ["kinetic", "impactors"], "#e69f00"],
  ["elastic: concrete, joints, contact", ["strain", "joints", "contact"], "#56b4e9"],
  ["elastic: bars", ["bars", "bar_joints"], "#0072b2"],
  ["fracture", ["fracture_I", "fracture_II"], "#d55e00"],
  ["friction", ["friction", "contact_friction"], "#cc79a7"],
  ["bond, yield, dowel, rupture", ["bond_steel", "dowel", "rupture"], "#009e73"],
  ["damping, absorbed", ["viscous", "mass_damping", "local_damping", "absorbed", "joint_inertia"], "#b5bcc4"],
];

function energySection(meta, curves, moment) {
  const box = section("energy", "Energy", "Every joule has an account: what supports, forces and gravity put in is held, or dissipated, or it shows up as missing.");
  const rows = curves.rows, sum = (names) => {
    const parts = names.map((n) => curves.values(`energy_${n}`)).filter(Boolean);
    return Array.from({ length: rows }, (_, i) => parts.reduce((s, v) => s + v[i], 0));
  };
  const t = shown(curves.find("time"));
  const work = sum(["work_supports", "work_forces", "work_gravity"]);
  const start = sum(["kinetic", "impactors"])[0] ?? 0; // bodies in motion at the start bring theirs along
  const given = work.map((w) => w + start);
  const groups = STACK.map(([label, names, colour]) => ({ label, colour, own: sum(names) })).filter((g) => largestOf(g.own) > 1e-4 * largestOf(given));
  const [unit, factor] = shownUnit("J", Math.max(largestOf(given), ...groups.map((g) => largestOf(g.own))));
  let below = new Array(rows).fill(0);
  const series = groups.map((g) => {
    below = below.map((b, i) => b + g.own[i]);
    return { label: g.label, colour: g.colour, fill: g.colour, width: 0.5, values: below.map((v) => v * factor), raw: g.own.map((v) => v * factor), area: true };
  }).reverse(); // the tallest first: each later one covers its foot
  series.push({ label: "put in", colour: "#1f2933", width: 1.6, values: given.map((v) => v * factor) });
  const stack = overTime("plot-energy", { x: t.label, y: `energy [${unit}]`, times: t.values, series, now: () => moment.time * t.factor, height: 320 });

  const ratio = kineticRatio(curves)?.map((r) => (r === null ? null : 100 * r)) ?? [];
  const residual = Array.from(curves.values("energy_residual") ?? [], (v) => 100 * v);
  const top = Math.min(Math.max(10, ...ratio.filter((r) => r !== null)) * 1.05, 60);
  const kinetic = overTime("plot-kinetic", { x: t.label, y: "share [%]", times: t.values, height: 320, now: () => moment.time * t.factor,
    range: [Math.min(-2, ...residual), top],
    series: [{ values: ratio, label: "kinetic / internal", colour: LINES[4] }, { values: residual, label: "residual / put in", colour: LINES[5] }],
    lines: () => [{ y: 5, text: "5 %: quasi-static below", colour: "#8a8a8a" }] });
  moment.followers.push(stack.redraw, kinetic.redraw);
  box.append(element("div.pair",
    element("figure", stack.box, keys([series.at(-1), ...series.slice(0, -1)]), element("figcaption", "Where the energy is: areas on top of each other; the black line is what was put in.")),
    element("figure", kinetic.box, keys([{ label: "kinetic over internal energy", colour: LINES[4] }, { label: "energy residual", colour: LINES[5] }]), element("figcaption", "How quiet the run is, and how well its energy is balanced."))));
  box.append(energyTable(meta, curves));
  return box;
}

/** A page of a run that goes on reads itself anew now and then and comes back to where the reader was. */
function comeBack(state) {
  const key = `fissura:${location.pathname}`;
  const seconds = 20;
  let touched = 0;
  for (const kind of ["pointerdown", "wheel", "keydown"]) window.addEventListener(kind, () => (touched = performance.now()), { passive: true });
  try {
    const kept = JSON.parse(sessionStorage.getItem(key) ?? "null");
    if (kept) {
      window.scrollTo(0, kept.scroll);
      if (kept.eye && state.view) state.view.eye = kept.eye;
    }
  } catch {
    // a browser that keeps nothing for files: the page starts from the top
  }
  setInterval(() => {
    if (performance.now() - touched < 1000 * seconds) return;
    try {
      sessionStorage.setItem(key, JSON.stringify({ scroll: window.scrollY, eye: state.view?.eye }));
    } catch {
      // as above
    }
    location.reload();
  }, 1000 * seconds);
}

