// The 3-D view with its controls and colour keys.
import { element, section, select, slider } from "./dom.js";
import { barColour, crackColour, gradient, MODES } from "./colours.js";
import { digits, quantity } from "./format.js";
import { rowAt } from "./events.js";
import { View } from "./view3d.js";

/** `peak`: when the load is largest [s]; null where that is unknown. */
export function showScene(page, numbers, moment, state, peak = null) {
  const { meta } = numbers;
  const box = section("scene", meta.scene?.bars?.stress ? "Cracks and bars" : "Cracks", null);
  page.append(box);
  if (!meta.scene || meta.frames.length === 0) {
    box.append(element("p.note", "No frame has been saved yet."));
    return;
  }
  const stage = element("div.stage"), legend = element("div.legend");
  box.append(stage);
  stage.style.height = `${stageHeight(meta.scene.body, stage.clientWidth)}px`;
  let view;
  try {
    view = new View(stage, numbers, peak === null ? numbers.meta.frames.length - 1 : rowAt(numbers.meta.frames, peak));
  } catch (error) {
    stage.replaceWith(element("p.note", `The 3-D view needs WebGL, which this browser does not offer (${error.message}).`));
    return;
  }
  state.view = view;
  stage.append(legend);
  const clock = element("div.clock");
  stage.append(clock);

  const { natural } = view;
  view.options.scale = natural;
  const last = view.times.length - 1, first = view.lastInView(); // the moment that is shown first
  const pieces = view.body.fragment?.some((f) => f > 0);

  // A body in many pieces is read by its pieces; else the cracks inside it matter.
  if (pieces && meta.run?.fragments?.count > 50) view.options.concrete = "pieces";
  if (view.options.concrete === "pieces") view.options.cracks = "hidden";

  const refresh = () => {
    clock.textContent = `t = ${quantity(view.times[view.frame], "s", 4)}   displacements ×\u202f${factor(view.options.scale)}`;
    drawLegend(legend, view);
  };
  const show = (frame) => {
    view.show(frame);
    refresh();
    moment.set(view.times[view.frame]);
  };

  const time = slider("time", { min: 0, max: last, step: 1, value: first }, (f) => quantity(view.times[f], "s", 3), (f) => (stop(), show(f)));
  let timer = null;
  const play = element("button", { type: "button", title: "play the saved moments" }, "▶");
  const stop = () => {
    clearInterval(timer);
    timer = null;
    play.textContent = "▶";
  };
  play.addEventListener("click", () => {
    if (timer) return stop();
    play.textContent = "❚❚";
    if (view.frame === last) view.frame = -1;
    timer = setInterval(() => {
      show(view.frame + 1);
      time.show(view.frame);
      if (view.frame === last) stop();
    }, Math.max(60, Math.min(250, 8000 / (last + 1))));
  });

  const scales = scaleSteps(natural);
  const scale = slider("deformation", { min: 0, max: scales.length - 1, step: 1, value: scales.indexOf(natural) }, (i) => `×\u202f${factor(scales[i])}`, (i) => {
    view.set({ scale: scales[i] });
    refresh();
  });
  const widths = [0, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 3e-4, 5e-4, 1e-3, 2e-3, 5e-3].filter((w) => w < (view.cracks?.largest ?? 0));
  // Hairlines nobody would see hide the cracks that matter: not drawn at first where there are wide ones.
  const hairline = view.cracks?.largest > 2e-4 ? widths.indexOf(2e-5) : 0;
  view.options.least = widths[hairline] ?? 0;
  const least = slider("cracks from", { min: 0, max: Math.max(widths.length - 1, 0), step: 1, value: hairline }, (i) => (widths[i] ? quantity(widths[i], "m", 2) : "all"), (i) => {
    view.set({ least: widths[i] });
    refresh();
  });
  const change = (name) => (value) => {
    view.set({ [name]: value });
    refresh();
  };
  const look = (name) => element("button", { type: "button", onclick: () => view.look(name) }, name);
  const save = element("button", { type: "button", title: "save the picture as PNG", onclick: () => element("a", { href: view.picture(), download: `${meta.folder}.png` }).click() }, "PNG");

  box.append(
    element("div.controls.time", play, time),
    element("div.controls", scale, view.cracks && least,
      select("concrete", [["glass", "glass"], ["solid", "solid"], ...(pieces ? [["pieces", "fragments"]] : []), ["hidden", "hidden"]], view.options.concrete, change("concrete")),
      view.cracks && select("cracks by", [["opening", "opening"], ["mode", "mode"], ["time", "time of failure"], ["hidden", "hidden"]], view.options.cracks, change("cracks")),
      view.cracks && select("scale", [["log", "logarithmic"], ["linear", "linear"]], "log", (v) => change("logarithmic")(v === "log")),
      view.bars && select("bars", [["on", "by stress"], ["off", "hidden"]], "on", (v) => change("bars")(v === "on")),
      element("span.views", look("oblique"), look("front"), look("side"), look("top"), save)));
  const left = meta.frames_saved - meta.frames.length;
  box.append(element("p.note", `Drag to turn, wheel to zoom, right button to move. Cracks: joints with damage of 0.2 or more, midway between their faces.${left > 0 ? ` ${meta.frames.length} of ${meta.frames_saved} saved moments are in this page, to keep it small.` : ""}`));
  show(first);
}

/** Height of the view [px]: a slender body leaves no empty room above and below it. */
function stageHeight({ low, high }, width) {
  const [x, y, z] = low.map((l, k) => high[k] - l);
  const seen = (z + 0.4 * Math.min(x, y)) / (Math.max(x, y) + 0.45 * Math.min(x, y)); // height over width of the oblique view
  return Math.round(Math.min(540, Math.max(340, width * seen + 170)));
}

/** A factor of 1, 2 or 5 times a power of ten. */
const factor = (v) => Number(v.toPrecision(2)).toString();

/** 0, 1 and the steps 1, 2, 5 around the natural factor. */
function scaleSteps(natural) {
  const steps = [0, 1];
  for (let power = 0.1; power <= natural * 20; power *= 10)
    for (const m of [1, 2, 5]) {
      const v = Number((m * power).toPrecision(1));
      if (v > 1 && v <= natural * 10) steps.push(v);
    }
  if (!steps.includes(natural)) steps.push(natural);
  return steps.sort((a, b) => a - b);
}

function key(title, colour, ticks) {
  return element("div.key", element("span.title", title), element("div.bar", { style: `background:${gradient(colour)}` }),
    element("div.ticks", ticks.map(([share, text]) => element("span", { style: `left:${100 * share}%` }, text))));
}

function drawLegend(legend, view) {
  legend.replaceChildren();
  if (view.cracks && view.options.cracks !== "hidden") {
    if (view.options.cracks === "opening") {
      const { least, largest } = view.crackRange();
      const values = view.options.logarithmic ? decades(least, largest) : [0, 0.25, 0.5, 0.75, 1].map((s) => s * largest);
      legend.append(key("crack opening [mm]", crackColour, values.map((v) => [view.crackShare(v), digits(1e3 * v, 2)])));
    } else if (view.options.cracks === "mode")
      legend.append(element("div.key", element("span.title", "mode of fracture"), element("ul.keys", [[1, "opening"], [2, "sliding"], [3, "mixed"], [0, "not failed"]].map(([m, text]) => element("li", element("i.area", { style: `background:${MODES[m]}` }), text)))));
    else {
      const end = view.times.at(-1);
      legend.append(key("time of failure", (s) => crackColour(1 - s), [0, 0.5, 1].map((s) => [s, quantity(s * end, "s", 2)])));
    }
  }
  if (view.bars && view.options.bars) {
    const { low, high } = view.bars;
    const values = low < -0.05 * high ? [low, 0, high / 2, high] : [0, high / 2, high];
    legend.append(key("bar stress [MPa]", barColour, values.map((v) => [(v - low) / (high - low), digits(v / 1e6, 3)])));
  }
}

function decades(least, largest) {
  const values = [];
  for (let p = Math.round(Math.log10(least)); 10 ** p <= largest * 1.0001; ++p) values.push(Number((10 ** p).toPrecision(3)));
  if (Math.log(largest / values.at(-1)) > 0.15 * Math.log(largest / least)) values.push(largest);
  return values;
}
