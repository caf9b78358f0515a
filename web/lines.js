// Line charts as SVG, which are what the page shows and what it saves.

import { digits, prefixed, thousands } from "./words.js";

const COLOURS = ["#0b5394", "#b3202c", "#3d7a37"];
const EDGES = { left: 64, right: 14, top: 34, bottom: 44 };

/** Round steps between two numbers, about `count` of them. */
export function ticks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((part) => part * power).find((part) => part >= rough) ?? rough;
  const found = [];
  for (let i = Math.ceil(low / step); i * step <= high + 1e-9 * step; i += 1) found.push(i * step);
  return found;
}

function decades(low, high) {
  const found = [];
  for (let i = Math.ceil(Math.log10(low)); i <= Math.log10(high); i += 1) found.push(10 ** i);
  return found;
}

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");

/**
 * A chart: `x` and `y` have a name, a unit and, for x, `log`; each of `curves` a name, numbers over `at`, and `error`, the half
 * width of a band; `marks` are vertical lines {at, label}; `width` is in pixels.
 */
export function chart({ title, x, y, curves, marks = [], width = 560 }) {
  const { left, right, top, bottom } = EDGES;
  const height = Math.round(0.45 * width + 50);
  const shown = curves.flatMap(({ at, values, error = 0 }) =>
    Array.from(values, (value, i) => [at[i], value - error, value + error]).filter((three) => three.every(Number.isFinite)),
  );
  if (shown.length === 0) return "";
  const bounds = (list) => list.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const [x0, x1] = bounds(shown.map(([at]) => at));
  let [y0, y1] = bounds(shown.flatMap(([, low, high]) => [low, high]));
  if (y0 === y1) [y0, y1] = y0 === 0 ? [-1, 1] : [Math.min(0, 2 * y0), Math.max(0, 2 * y1)];
  const margin = 0.04 * (y1 - y0);
  [y0, y1] = [y0 < 0 || y.free ? y0 - margin : 0, y1 + margin];
  const part = x.log ? (v) => Math.log(v / x0) / Math.log(x1 / x0) : (v) => (v - x0) / (x1 - x0 || 1);
  const across = (v) => left + part(v) * (width - left - right);
  const up = (v) => height - bottom - ((v - y0) / (y1 - y0)) * (height - top - bottom);
  const scales = [x, y].map(({ unit }, i) => (unit === "1" || unit.includes("^") ? 0 : thousands(i ? Math.max(y1, -y0) : x1)));
  const label = ({ name, unit }, scale) => (unit === "1" ? name : `${name} [${prefixed(unit, scale)}]`);
  const text = (px, py, words, more = "") => `<text x="${px.toFixed(1)}" y="${py.toFixed(1)}" ${more}>${escaped(words)}</text>`;
  let svg = "";
  for (const v of x.log ? decades(x0, x1) : ticks(x0 / 1000 ** scales[0], x1 / 1000 ** scales[0], 6).map((t) => t * 1000 ** scales[0])) {
    svg += `<path class="grid" d="M${across(v).toFixed(1)} ${top}V${height - bottom}"/>`;
    svg += text(across(v), height - bottom + 16, digits(v / 1000 ** scales[0]), 'text-anchor="middle"');
  }
  for (const v of ticks(y0 / 1000 ** scales[1], y1 / 1000 ** scales[1], 5).map((t) => t * 1000 ** scales[1])) {
    svg += `<path class="grid" d="M${left} ${up(v).toFixed(1)}H${width - right}"/>`;
    svg += text(left - 6, up(v) + 4, digits(v / 1000 ** scales[1]), 'text-anchor="end"');
  }
  for (const { at, label: words } of marks.filter(({ at }) => at >= x0 && at <= x1)) {
    svg += `<path class="mark" d="M${across(at).toFixed(1)} ${top}V${height - bottom}"/>`;
    svg += text(across(at) + 3, top + 12, words);
  }
  curves.forEach(({ name, at, values, error = 0 }, i) => {
    const points = Array.from(values, (value, k) => [at[k], value]).filter((pair) => pair.every(Number.isFinite));
    const path = (list) => list.map(([a, v], k) => `${k ? "L" : "M"}${across(a).toFixed(1)} ${up(v).toFixed(1)}`).join("");
    if (error > 0) {
      const [above, below] = [1, -1].map((side) => points.map(([a, v]) => [a, v + side * error]));
      svg += `<path d="${path(above)}${path(below.reverse()).replace("M", "L")}Z" fill="${COLOURS[i]}" fill-opacity="0.2"/>`;
    }
    const dash = i > 0 ? ' stroke-dasharray="6 4"' : "";
    svg += `<path d="${path(points)}" fill="none" stroke="${COLOURS[i]}" stroke-width="1.6"${dash}/>`;
    if (curves.length > 1) {
      const before = curves.slice(0, i).reduce((sum, one) => sum + 50 + 6.5 * one.name.length, 0);
      const [px, py] = [left + 4 + before, top - 8];
      svg += `<path d="M${px} ${py - 4}h22" stroke="${COLOURS[i]}" stroke-width="1.6"${dash}/>${text(px + 27, py, name)}`;
    }
  });
  svg += `<path class="frame" d="M${left} ${top}H${width - right}V${height - bottom}H${left}Z"/>`;
  svg += text((left + width - right) / 2, height - 8, label(x, scales[0]), 'text-anchor="middle"');
  const middle = (top + height - bottom) / 2;
  svg += text(14, middle, label(y, scales[1]), `text-anchor="middle" transform="rotate(-90 14 ${middle})"`);
  const style =
    "text{font:12px Ubuntu,system-ui,sans-serif;fill:#111}.grid{stroke:#e3e3e3}.frame{fill:none;stroke:#111}.mark{stroke:#555;stroke-dasharray:4 3}";
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" role="img" aria-label="${escaped(title)}"><title>${escaped(title)}</title><style>${style}</style><rect width="${width}" height="${height}" fill="#fff"/>${svg}</svg>`;
}
