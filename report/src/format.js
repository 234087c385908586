// Numbers as an engineer reads them: mm, kN, MPa, and no more digits than mean something.

/** Significant digits, without exponents between 1e-4 and 1e7. */
export function digits(value, significant = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) {
    const [mantissa, power] = value.toExponential(significant - 1).split("e");
    return `${minus(mantissa)}·10${superscript(Number(power))}`;
  }
  const places = Math.max(0, significant - 1 - Math.floor(Math.log10(size)));
  return minus(places === 0 ? String(Math.round(value)) : value.toFixed(places));
}

function minus(text) {
  return text.replace("-", "−");
}

function superscript(n) {
  return String(n).replace(/[-0-9]/g, (c) => ({ "-": "⁻" })[c] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]);
}

/** Unit to show and factor to it, for values of this largest magnitude; `name` tells strains from other ratios. */
export function shownUnit(unit, largest, name = "") {
  switch (unit) {
    case "m":
      return largest < 10 ? ["mm", 1e3] : ["m", 1];
    case "N":
      return largest >= 1e6 ? ["MN", 1e-6] : largest >= 500 ? ["kN", 1e-3] : ["N", 1];
    case "Pa":
      return largest >= 1e4 ? ["MPa", 1e-6] : ["Pa", 1];
    case "J":
      return largest >= 1e4 ? ["kJ", 1e-3] : largest >= 0.5 || largest === 0 ? ["J", 1] : ["mJ", 1e3];
    case "s":
      return largest < 1 ? ["ms", 1e3] : ["s", 1];
    case "N s":
      return largest >= 500 ? ["kN s", 1e-3] : ["N s", 1];
    case "-":
      return name.includes("strain") ? ["‰", 1e3] : ["", 1];
    default:
      return [unit, 1];
  }
}

export function largestOf(values) {
  let largest = 0;
  for (const v of values) if (Math.abs(v) > largest) largest = Math.abs(v);
  return largest;
}

/** A column with its values in the unit shown. */
export function shown(column) {
  const [unit, factor] = shownUnit(column.unit, largestOf(column.values), column.name);
  return { name: column.name, unit, factor, values: Array.from(column.values, (v) => v * factor), label: axisLabel(column.name, unit) };
}

export function axisLabel(name, unit) {
  const words = name.replaceAll("_", " ");
  return unit ? `${words} [${unit}]` : words;
}

/** One value with its unit. */
export function quantity(value, unit, significant = 3, name = "") {
  const [text, factor] = shownUnit(unit, Math.abs(value), name);
  return `${digits(value * factor, significant)}${text ? "\u202f" + text : ""}`;
}

export function percent(share, significant = 2) {
  return `${digits(100 * share, significant)}\u202f%`;
}

export function duration(seconds) {
  const s = Math.round(seconds);
  if (seconds < 10) return `${digits(seconds, 2)}\u202fs`;
  if (s < 60) return `${s}\u202fs`;
  if (s < 3600) return `${Math.floor(s / 60)}\u202fmin ${s % 60}\u202fs`;
  return `${Math.floor(s / 3600)}\u202fh ${Math.floor((s / 60) % 60)}\u202fmin`;
}

export function whole(n) {
  return String(Math.round(n)).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}
