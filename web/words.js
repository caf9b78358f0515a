// Numbers and quantities in words, as `hertzlamb plot` writes them (crates/plot/src/words.rs).

const PREFIXES = ["f", "p", "n", "\u00b5", "m", "", "k", "M", "G", "T"];

/** Four digits without zeros at the end. */
export function digits(value) {
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const size = Math.floor(Math.log10(Math.abs(value)));
  if (size < -4 || size >= 6) {
    const [mantissa, power] = value.toExponential(3).split("e");
    return `${trimmed(mantissa)}\u00b710^${power.replace("+", "").replace("-", "\u2212")}`;
  }
  return trimmed(value.toFixed(Math.max(3 - size, 0)));
}

function trimmed(text) {
  const short = text.includes(".") ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
  return short.replace("-", "\u2212");
}

/** The power of a thousand that shows a value well, between 1e-15 and 1e12. */
export function thousands(value) {
  if (value === 0 || !Number.isFinite(value)) return 0;
  return Math.max(-5, Math.min(4, Math.floor(Math.log10(Number(Math.abs(value).toExponential(3))) / 3)));
}

/** A unit with the prefix of a power of a thousand. */
export function prefixed(unit, power) {
  return `${PREFIXES[power + 5]}${unit}`;
}

/** A value in its unit with an SI prefix. */
export function withUnit(value, unit) {
  if (unit === "1" || unit === "") return digits(value);
  const power = unit.includes("^") ? 0 : thousands(value);
  return `${digits(value / 1000 ** power)} ${prefixed(unit, power)}`;
}

/** Name of a quantity in words: what a file says of it, up to its sign. */
export const named = (meaning) => meaning.split(",")[0];
