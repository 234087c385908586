// Curves: over time (uPlot as it is) and one reading over another (uPlot's second mode, whose x need not grow).
import uPlot from "uplot";
import { element } from "./dom.js";
import { digits } from "./format.js";
import { LINES } from "./colours.js";

const HEIGHT = 300;
const INK = "#3a424c", GRID = "#e4e7eb";
const FONT = '12px "Inter", "Segoe UI", "Lato", "Helvetica Neue", Arial, sans-serif';

export const drawn = []; // all plots of the page

function axes(x, y) {
  const common = { stroke: INK, font: FONT, labelFont: FONT, labelGap: 0, labelSize: 20, grid: { stroke: GRID, width: 1 }, ticks: { stroke: GRID, width: 1, size: 5 } };
  const values = (u, ticks) => ticks.map((v) => (v === null ? null : Number(v.toPrecision(12)).toString().replace("-", "−")));
  return [
    { ...common, label: x, values, space: 60, size: 28 },
    { ...common, label: y, values, size: 52, space: 36 },
  ];
}

function padded(low, high) {
  if (!(high > low)) return [low - 0.5 * Math.abs(low || 1), low + 0.5 * Math.abs(low || 1)];
  const pad = 0.05 * (high - low);
  return [low >= 0 && low < 0.1 * (high - low) ? Math.min(low, 0) : low - pad, high + pad];
}

function extent(arrays) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays)
    for (const v of values)
      if (v !== null && Number.isFinite(v)) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
  return low <= high ? [low, high] : [0, 1];
}

/** Shapes that differ too, not colour alone. */
function drawMark(context, shape, x, y, size, colour) {
  const p = new Path2D();
  if (shape === "circle") p.arc(x, y, size, 0, 2 * Math.PI);
  else if (shape === "ring") p.arc(x, y, size, 0, 2 * Math.PI);
  else if (shape === "diamond") [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]].forEach(([a, b], i) => p[i ? "lineTo" : "moveTo"](x + a * size, y + b * size));
  else [[0, -1.25], [1.2, 0.95], [-1.2, 0.95]].forEach(([a, b], i) => p[i ? "lineTo" : "moveTo"](x + a * size, y + b * size));
  p.closePath();
  context.lineWidth = 0.25 * size + 1;
  context.strokeStyle = shape === "ring" ? colour : "#ffffff";
  context.fillStyle = shape === "ring" ? "rgb(255 255 255 / 70%)" : colour;
  context.fill(p);
  context.stroke(p);
}

/** marks(): [{x, y, shape, colour}] in the plot's units, asked for at every drawing. */
function markPlugin(marks) {
  return {
    hooks: {
      draw: (u) => {
        const context = u.ctx, ratio = window.devicePixelRatio;
        context.save();
        for (const m of marks())
          if (Number.isFinite(m.x) && Number.isFinite(m.y)) drawMark(context, m.shape, u.valToPos(m.x, "x", true), u.valToPos(m.y, "y", true), 4.5 * ratio, m.colour);
        context.restore();
      },
    },
  };
}

/** Horizontal lines with a word: limits, strengths. lines(): [{y, text, colour}]. */
function linePlugin(lines) {
  return {
    hooks: {
      draw: (u) => {
        const context = u.ctx, ratio = window.devicePixelRatio;
        context.save();
        context.font = FONT.replace("12px", `${11 * ratio}px`);
        for (const l of lines()) {
          const y = u.valToPos(l.y, "y", true);
          if (y < u.bbox.top || y > u.bbox.top + u.bbox.height) continue;
          context.strokeStyle = context.fillStyle = l.colour ?? "#8a8a8a";
          context.lineWidth = ratio;
          context.setLineDash([5 * ratio, 4 * ratio]);
          context.beginPath();
          context.moveTo(u.bbox.left, y);
          context.lineTo(u.bbox.left + u.bbox.width, y);
          context.stroke();
          context.textAlign = "right";
          context.textBaseline = "bottom";
          context.fillText(l.text, u.bbox.left + u.bbox.width - 4 * ratio, y - 2 * ratio);
        }
        context.restore();
      },
    },
  };
}

function holder(id) {
  const box = element("div.plot", { id });
  const tip = element("div.tip", { hidden: true });
  box.append(tip);
  return { box, tip };
}

function keep(box, u) {
  const resize = () => box.clientWidth > 0 && box.clientWidth !== u.width && u.setSize({ width: box.clientWidth, height: u.height });
  new ResizeObserver(resize).observe(box);
  drawn.push(u);
  return u;
}

/** Keys of a plot, below it: a line in its colour and its name. */
export function keys(series) {
  return element("ul.keys", series.map((s) => element("li", element(s.area ? "i.area" : "i", { style: s.area ? `background:${s.colour}` : `border-color:${s.colour};border-top-style:${s.dash ? "dashed" : "solid"}` }), s.label)));
}

/**
 * One reading over another. series: [{x, y, label, colour, dash, points}], arrays in the units of the labels; `points`:
 * dots instead of a line. Returns {box, redraw}.
 */
export function scatter(id, { x, y, series, marks = () => [], lines = () => [], tip = null, height = HEIGHT }) {
  const { box, tip: tipBox } = holder(id);
  const wide = padded(...extent(series.map((s) => s.x)));
  const tall = padded(...extent([...series.map((s) => s.y), lines().filter((l) => l.include).map((l) => l.y)]));
  const path = (u, index) => {
    uPlot.orient(u, index, (s, dataX, dataY, scaleX, scaleY, toX, toY, left, top, width, tallness) => {
      const given = series[index - 1], context = u.ctx, ratio = window.devicePixelRatio;
      const line = new Path2D();
      let pen = false;
      for (let i = 0; i < dataX.length; ++i) {
        if (!Number.isFinite(dataX[i]) || !Number.isFinite(dataY[i])) {
          pen = false;
          continue;
        }
        const px = toX(dataX[i], scaleX, width, left), py = toY(dataY[i], scaleY, tallness, top);
        if (given.points) line.moveTo(px + 2.4 * ratio, py), line.arc(px, py, 2.4 * ratio, 0, 2 * Math.PI);
        else line[pen ? "lineTo" : "moveTo"](px, py);
        pen = true;
      }
      context.save();
      context.beginPath();
      context.rect(left, top, width, tallness);
      context.clip();
      context.lineJoin = "round";
      context.lineWidth = (given.width ?? 1.6) * ratio;
      context.strokeStyle = context.fillStyle = given.colour;
      if (given.dash) context.setLineDash(given.dash.map((d) => d * ratio));
      if (given.points) context.fill(line);
      else context.stroke(line);
      context.restore();
    });
    return null;
  };
  const options = {
    mode: 2, width: 480, height, legend: { show: false }, cursor: { drag: { x: false, y: false }, points: { show: false }, x: false, y: false },
    scales: { x: { time: false, range: () => wide }, y: { range: () => tall } },
    axes: axes(x, y),
    series: [null, ...series.map((s) => ({ label: s.label, stroke: s.colour, paths: path, facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }] }))],
    plugins: [linePlugin(lines), markPlugin(marks)],
  };
  const u = keep(box, new uPlot(options, [null, ...series.map((s) => [s.x, s.y])], box));
  u.over.addEventListener("mousemove", (event) => {
    let best = null;
    series.forEach((s) => {
      for (let i = 0; i < s.x.length; ++i) {
        const d = Math.hypot(u.valToPos(s.x[i], "x") - event.offsetX, u.valToPos(s.y[i], "y") - event.offsetY);
        if (d < (best?.d ?? 25)) best = { d, s, i };
      }
    });
    tipBox.hidden = !best;
    if (!best) return;
    const { s, i } = best;
    tipBox.textContent = tip ? tip(s, i) : `${x}: ${digits(s.x[i], 4)}\n${y}: ${digits(s.y[i], 4)}`;
    tipBox.style.left = `${u.over.offsetLeft + u.valToPos(s.x[i], "x") + 10}px`;
    tipBox.style.top = `${u.over.offsetTop + u.valToPos(s.y[i], "y") - 10}px`;
  });
  u.over.addEventListener("mouseleave", () => (tipBox.hidden = true));
  return { box, redraw: () => u.redraw(false), plot: u };
}

/** Curves over time. series: [{values, label, colour, fill, dash}]; drag to zoom, double click to see all. */
export function overTime(id, { x, y, times, series, marks = () => [], lines = () => [], range = null, height = HEIGHT, now = () => null }) {
  const { box, tip } = holder(id);
  const tall = range ?? padded(...extent([...series.map((s) => s.values), lines().filter((l) => l.include).map((l) => l.y)]));
  const nowPlugin = {
    hooks: {
      draw: (u) => {
        const t = now();
        if (t === null) return;
        const px = u.valToPos(t, "x", true);
        if (px < u.bbox.left - 1 || px > u.bbox.left + u.bbox.width + 1) return;
        u.ctx.save();
        u.ctx.strokeStyle = "#1f2933";
        u.ctx.lineWidth = window.devicePixelRatio;
        u.ctx.setLineDash([2 * window.devicePixelRatio, 3 * window.devicePixelRatio]);
        u.ctx.beginPath();
        u.ctx.moveTo(px, u.bbox.top);
        u.ctx.lineTo(px, u.bbox.top + u.bbox.height);
        u.ctx.stroke();
        u.ctx.restore();
      },
    },
  };
  const options = {
    width: 480, height, legend: { show: false }, cursor: { points: { size: 6 }, y: false },
    scales: { x: { time: false }, y: { range: () => tall } },
    axes: axes(x, y),
    series: [{}, ...series.map((s) => ({ label: s.label, stroke: s.colour, fill: s.fill, width: s.width ?? 1.5, dash: s.dash, points: { show: false }, spanGaps: false }))],
    plugins: [linePlugin(lines), nowPlugin, markPlugin(marks)],
    hooks: {
      setCursor: [(u) => {
        const i = u.cursor.idx;
        tip.hidden = i === null || i === undefined || u.cursor.left < 0;
        if (tip.hidden) return;
        tip.textContent = [`${x.replace(/ \[.*/, "")} ${digits(times[i], 4)}${/\[(.*)\]/.exec(x)?.[1] ? "\u202f" + /\[(.*)\]/.exec(x)[1] : ""}`,
          ...series.map((s) => `${s.label}: ${digits((s.raw ?? s.values)[i], 3)}`)].join("\n");
        const left = u.over.offsetLeft + u.cursor.left;
        tip.style.left = left > 0.6 * box.clientWidth ? "" : `${left + 12}px`;
        tip.style.right = left > 0.6 * box.clientWidth ? `${box.clientWidth - left + 12}px` : "";
        tip.style.top = `${u.over.offsetTop + 8}px`;
      }],
    },
  };
  const u = keep(box, new uPlot(options, [times, ...series.map((s) => s.values)], box));
  return { box, redraw: () => u.redraw(false), plot: u };
}

const SHAPES = { circle: "●", diamond: "◆", triangle: "▲", ring: "○" };

/** Keys of the marks: their shape, and what they say. */
export function markKeys(marks) {
  return element("ul.keys.marks", marks.map((m) => element("li", element("b", { style: `color:${m.colour}` }, SHAPES[m.shape]), m.text)));
}

export { LINES };
