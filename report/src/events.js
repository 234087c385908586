// What a curve is read for: its peak, the first crack, the first yield, and which readings to draw at all.

const LOADS = ["reaction", "force", "contact_force"], WAYS = ["displacement", "mean_strain", "impactor_displacement"];

/** The pair to draw first: a load over a displacement, else over time. */
export function mainPair(curves, gauges) {
  const first = (kinds) => gauges.find((g) => kinds.includes(g.kind) && curves.find(g.name))?.name;
  const byUnit = (unit) => curves.columns.find((c) => c.unit === unit && !c.name.startsWith("energy_"))?.name;
  const y = first(LOADS) ?? byUnit("N") ?? first(["bar"]) ?? curves.columns.find((c) => c.name !== "time" && !c.name.startsWith("energy_"))?.name ?? "time";
  const x = first(WAYS) ?? byUnit("m") ?? "time";
  return { x, y };
}

/** Means over `width` rows around each; at the ends over as many as there are. The shock of a crack lasts a row or two and is not
 * the strength of a member. */
export function means(values, width) {
  const half = (width - 1) / 2;
  return Array.from(values, (_, i) => {
    const [from, to] = [Math.max(0, i - half), Math.min(values.length - 1, i + half)];
    let sum = 0;
    for (let k = from; k <= to; ++k) sum += values[k];
    return sum / (to - from + 1);
  });
}

function rowOfPeak(values) {
  let best = 0;
  for (let i = 0; i < values.length; ++i) if (Math.abs(values[i]) > Math.abs(values[best])) best = i;
  return best;
}

const MEAN = 5, ROWS_FOR_MEANS = 100;

/** First row where a count has left zero, or -1. */
export function firstRow(values) {
  return values ? values.findIndex((v) => v > 0) : -1;
}

/** [{row, value, name, text, shape, colour}] for the curve of column y. Values are means over five rows, but single readings in
 * a dynamic case or a short history. */
export function events(curves, y, dynamic = false) {
  const values = means(curves.values(y) ?? [], dynamic || curves.rows < ROWS_FOR_MEANS ? 1 : MEAN);
  const list = [];
  const add = (row, name, text, shape, colour) => row >= 0 && list.push({ row, value: values[row], name, text, shape, colour });
  add(firstRow(curves.values("joints_cracked")), "cracking", "first crack", "diamond", "#009e73");
  add(firstRow(curves.values("bar_joints_yielded")), "yield", "first yield", "triangle", "#e69f00");
  add(firstRow(curves.values("bars_broken")), "rupture", "first bar breaks", "triangle", "#8c5aa6");
  if (curves.rows > 0) add(rowOfPeak(values), "peak", "peak", "circle", "#d55e00");
  return list;
}

/** Rows around a mark that its value is read from. */
export const NEAR = (MEAN - 1) / 2;

/** When the load of the page's first curve is largest [s], or null. */
export function timeOfPeak(curves, meta) {
  if (curves.rows < 2) return null;
  const { y } = mainPair(curves, meta.deck.gauges);
  const peak = events(curves, y, meta.deck.dynamic).find((e) => e.name === "peak");
  return peak ? curves.values("time")[peak.row] : null;
}

/** Row nearest to a time [s]; times grow. */
export function rowAt(times, t) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  return Math.abs(times[high] - t) < Math.abs(times[low] - t) ? high : low;
}

/** Kinetic over internal energy per row; null while the internal energy is below 1 % of its largest. */
export function kineticRatio(curves) {
  const kinetic = curves.values("energy_kinetic");
  if (!kinetic) return null;
  const stored = ["strain", "joints", "bars", "bar_joints", "contact"].map((n) => curves.values(`energy_${n}`)).filter(Boolean);
  const internal = Array.from(kinetic, (_, i) => stored.reduce((sum, v) => sum + v[i], 0));
  const largest = Math.max(...internal, 0);
  return internal.map((e, i) => (e > 0.01 * largest ? kinetic[i] / e : null));
}

/** [{from, to, largest}]: rows up to `last` in which kinetic energy is 5 % of the internal or more, the longest span first. Spans
 * nearer to each other than five rows are one. */
export function loudSpans(ratio, last) {
  const spans = [];
  for (let i = 0; i <= last; ++i) {
    if (ratio[i] === null || ratio[i] < 0.05) continue;
    if (spans.length && i - spans.at(-1).to <= MEAN) spans.at(-1).to = i;
    else spans.push({ from: i, to: i, largest: 0 });
    spans.at(-1).largest = Math.max(spans.at(-1).largest, ratio[i]);
  }
  return spans.sort((a, b) => b.to - b.from - (a.to - a.from) || a.from - b.from);
}

/** Turning points of a reading: rows where it changes direction by more than a twentieth of its range. */
export function reversals(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) (low = Math.min(low, v)), (high = Math.max(high, v));
  const step = 0.05 * (high - low);
  const rows = [];
  if (!(step > 0)) return rows;
  let extreme = 0, direction = 0;
  for (let i = 1; i < values.length; ++i) {
    const way = values[i] - values[extreme];
    if (direction === 0) {
      if (Math.abs(way) > step) (direction = Math.sign(way)), (extreme = i);
    } else if (way * direction > 0) extreme = i;
    else if (-way * direction > step) rows.push(extreme), (direction = -direction), (extreme = i);
  }
  return rows;
}
