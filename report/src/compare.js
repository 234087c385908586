// Two runs over each other.
import { Curves } from "./data.js";
import { element, section, select } from "./dom.js";
import { mainPair } from "./events.js";
import { digits, largestOf, percent, shownUnit } from "./format.js";
import { keys, LINES, scatter } from "./plots.js";

export function showComparison(page, numbers) {
  const { meta } = numbers;
  const runs = ["a", "b"].map((n) => new Curves(numbers, n));
  const common = runs[0].columns.map((c) => c.name).filter((n) => runs[1].find(n));
  page.append(element("div.top", element("div", element("p.kicker", "Fissura comparison"), element("h1", `${meta.names[0]} and ${meta.names[1]}`)),
    element(`span.status.${meta.agree ? "complete" : "failed"}`, meta.agree ? "agree" : "differ")));
  page.append(element("p.note.lead", meta.verdict));

  const gauges = common.filter((n) => !n.startsWith("energy_") && n !== "time");
  const choice = mainPair(runs[0], meta.gauges);
  const box = section("curves", "Curves", null), place = element("div.pair");
  const options = ["time", ...gauges, ...common.filter((n) => n.startsWith("energy_"))].map((n) => [n, n.replaceAll("_", " ")]);
  const redraw = () => place.replaceChildren(over("plot-pair", runs, meta, choice.x, choice.y), over("plot-time", runs, meta, "time", choice.y));
  box.append(element("div.controls", select("over", options, choice.x, (v) => ((choice.x = v), redraw())), select("reading", options, choice.y, (v) => ((choice.y = v), redraw()))), place);
  page.append(box);
  redraw();

  const table = section("differences", "Differences", `Mean and largest difference over the range of the first run's column, where both runs have rows; above ${percent(meta.tolerance)} in the mean counts as different.`);
  table.append(element("div.scroll", element("table", element("thead", element("tr", ["column", "mean", "largest", "at t [s]", "peak, first", "peak, second", ""].map((h) => element("th", h)))),
    element("tbody", meta.rows.filter((r) => r.peaks.some((p) => p !== 0)).map((r) => element("tr", element("td.word", element("code", r.name), r.unit === "-" ? "" : ` [${r.unit}]`), element("td.strong", percent(r.mean)), element("td", percent(r.largest)), element("td", digits(r.at, 4)),
      element("td", digits(r.peaks[0], 4)), element("td", digits(r.peaks[1], 4)), element("td.word", r.differs ? element("b.bad", "differs") : "")))))));
  page.append(table);
  page.append(element("footer", `Written ${meta.written} by Fissura ${meta.version}.`));
}

function over(id, runs, meta, x, y) {
  const scale = (name) => shownUnit(runs[0].find(name).unit, Math.max(...runs.map((r) => largestOf(r.values(name)))), name);
  const [xUnit, xFactor] = scale(x), [yUnit, yFactor] = scale(y);
  const label = (name, unit) => `${name.replaceAll("_", " ")}${unit ? ` [${unit}]` : ""}`;
  const series = runs.map((r, i) => ({ label: meta.names[i], colour: LINES[i], dash: i ? [7, 4] : null, x: Array.from(r.values(x), (v) => v * xFactor), y: Array.from(r.values(y), (v) => v * yFactor) }));
  return element("figure", scatter(id, { x: label(x, xUnit), y: label(y, yUnit), series, height: 340 }).box, keys(series));
}
