// Stress and slip along the bars at the moment of the 3-D view.
import { element, section, select } from "./dom.js";
import { digits, quantity, shownUnit } from "./format.js";
import { LINES, scatter } from "./plots.js";

export function showBars(page, numbers, moment) {
  const scene = numbers.meta.scene;
  if (!scene?.bars?.stress || numbers.get("bars/bar").length === 0) return;
  const along = numbers.get("bars/along"), bar = numbers.get("bars/bar"), copy = numbers.get("bars/copy");
  const jointAlong = numbers.get("bars/joint_along"), jointBar = numbers.get("bars/joint_bar"), jointCopy = numbers.get("bars/joint_copy"), states = numbers.get("bars/joint_state");
  const { frames, deck } = numbers.meta;
  const value = (name, frame) => {
    const scale = scene.bars[name][frame];
    return Array.from(numbers.get(`bars/${name}/${frame}`), (v) => v * scale);
  };

  const names = [...new Set(Array.from(bar, (b, i) => `${b}/${copy[i]}`))];
  const title = (id) => {
    const [b, c] = id.split("/").map(Number);
    const described = deck.bars[b];
    return `${described?.name || `bar ${b + 1}`}${described?.count > 1 || (!described && c > 0) ? `, no. ${c + 1}` : ""}`;
  };
  // The bar to begin with: the one that has yielded most, or else the one that was stretched most.
  const rank = new Map(names.map((id) => [id, 0]));
  states.forEach((s, i) => rank.set(`${jointBar[i]}/${jointCopy[i]}`, (rank.get(`${jointBar[i]}/${jointCopy[i]}`) ?? 0) + (s > 0 ? 1 : 0)));
  if (![...rank.values()].some((n) => n > 0)) value("stress", frames.length - 1).forEach((s, i) => rank.set(`${bar[i]}/${copy[i]}`, Math.max(rank.get(`${bar[i]}/${copy[i]}`), Math.abs(s))));
  const choice = { id: names.reduce((best, id) => (rank.get(id) > rank.get(best) ? id : best)) };

  const box = section("bars", "Along the bars", null);
  const place = element("div.pair"), status = element("p.note");
  const shownNames = names.length > 300 ? names.slice(0, 300) : names;
  box.append(element("div.controls", select("bar", shownNames.map((id) => [id, title(id)]), choice.id, (v) => ((choice.id = v), redraw()))), place, status);
  page.append(box);

  const redraw = () => {
    const frame = Math.max(0, frames.findIndex((t) => t >= moment.time - 1e-12));
    const [b, c] = choice.id.split("/").map(Number);
    const elements = [...along.keys()].filter((i) => bar[i] === b && copy[i] === c);
    const joints = [...jointAlong.keys()].filter((i) => jointBar[i] === b && jointCopy[i] === c);
    const stress = value("stress", frame), atJoint = value("joint_stress", frame), slip = value("slip", frame);
    const lengths = elements.map((i) => along[i]);
    const [lengthUnit, lengthFactor] = (lengths.at(-1) ?? 0) < 1 ? ["mm", 1e3] : ["m", 1];
    const x = `along the bar [${lengthUnit}]`;
    const f_y = deck.bars[b]?.f_y;
    const highest = Math.max(0, ...elements.map((i) => Math.abs(stress[i])));
    const lines = () => (f_y && highest > 0.3 * f_y ? [{ y: f_y / 1e6, text: `yield ${digits(f_y / 1e6, 3)} MPa`, colour: LINES[4], include: true },
      ...(elements.some((i) => stress[i] < -0.5 * f_y) ? [{ y: -f_y / 1e6, text: "−yield", colour: LINES[4], include: true }] : [])] : []);
    const cracked = joints.filter((i) => atJoint[i] !== 0 || slip[i] !== 0);
    const first = scatter("plot-bar-stress", { x, y: "stress [MPa]", lines, series: [
      { label: "bar", colour: LINES[0], x: elements.map((i) => along[i] * lengthFactor), y: elements.map((i) => stress[i] / 1e6) },
      { label: "at cracks", colour: LINES[1], points: true, x: cracked.map((i) => jointAlong[i] * lengthFactor), y: cracked.map((i) => atJoint[i] / 1e6) }] });
    const [slipUnit, slipFactor] = shownUnit("m", Math.max(...joints.map((i) => Math.abs(slip[i])), 0));
    const second = scatter("plot-bar-slip", { x, y: `slip [${slipUnit}]`, series: [
      { label: "slip", colour: LINES[2], width: 1, x: joints.map((i) => jointAlong[i] * lengthFactor), y: joints.map((i) => slip[i] * slipFactor) },
      { label: "slip", colour: LINES[2], points: true, x: joints.map((i) => jointAlong[i] * lengthFactor), y: joints.map((i) => slip[i] * slipFactor) }] });
    place.replaceChildren(element("figure", first.box, element("figcaption", "Stress: the line in the bar elements, dots where a crack crosses the bar.")),
      element("figure", second.box, element("figcaption", "Slip where the bar crosses joints; it is zero where no crack has opened.")));
    const yielded = joints.filter((i) => states[i] === 1).length, broken = joints.filter((i) => states[i] === 2).length;
    status.textContent = `${title(choice.id)}${deck.bars[b] ? `, diameter ${quantity(deck.bars[b].diameter, "m", 2)}` : ""}, at t = ${quantity(frames[frame], "s", 3)}. At the end ${yielded} of its ${joints.length} joints have yielded and ${broken} have broken.`;
  };
  redraw();
  let due = null;
  moment.followers.push(() => {
    cancelAnimationFrame(due);
    due = requestAnimationFrame(redraw);
  });
}
