// The section: frames of one quantity over depth and distance, mirrored at the axis, with the fronts of the waves.

import { digits, prefixed, thousands, withUnit } from "./words.js";

// the stations of crates/figure/src/colour.rs
const MAPS = {
  sequential: [0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c, 0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725],
  diverging: [0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xffffff, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f],
};

/** Red, green and blue at a fraction of the way along a map. */
export function colour(map, fraction) {
  const stations = MAPS[map];
  const place = Math.min(Math.max(fraction, 0), 1) * (stations.length - 1);
  const lower = Math.min(Math.floor(place), stations.length - 2);
  const mixed = (shift) => {
    const [from, to] = [lower, lower + 1].map((i) => (stations[i] >> shift) & 255);
    return Math.round(from + (place - lower) * (to - from));
  };
  return [mixed(16), mixed(8), mixed(0)];
}

const MARGIN = { left: 56, right: 110, top: 26, bottom: 40 };

/** The map of a quantity: magnitudes have no sign. */
const mapOf = ({ name }) => (["von_mises", "tresca", "max_shear"].includes(name) ? "sequential" : "diverging");

/** The picture on a canvas; `picked` hears the point in m that is clicked. */
export class Section {
  constructor(canvas, picked) {
    this.canvas = canvas;
    // in pixels of the page; the canvas has as many as the screen
    this.width = 640;
    this.height = 372;
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.shown = null;
    this.under = null;
    this.frame = 0;
    this.point = null;
    canvas.addEventListener("click", (event) => {
      const box = canvas.getBoundingClientRect();
      const place = this.place(event.clientX - box.left, event.clientY - box.top);
      if (place) picked(place);
    });
  }

  resize() {
    const width = this.canvas.clientWidth;
    if (width === 0 || width === this.width) return;
    [this.width, this.height] = [width, Math.round(0.5 * (width - MARGIN.left - MARGIN.right)) + MARGIN.top + MARGIN.bottom];
    this.draw();
  }

  /** A new section of `points` times `points` places up to `reach_m`, empty at first; a finer one covers what is shown. */
  begin(points, reach_m, speeds, isFiner) {
    this.under = isFiner ? this.shown : null;
    this.shown = { points, reach_m, speeds, rows: new Map(), time_s: [], limit: 0, about: null };
  }

  /** Adds rows, counted from the surface. */
  add(first, { time_s, values }, about) {
    const { points } = this.shown;
    const rows = values.length / time_s.length / points;
    Object.assign(this.shown, { time_s, about });
    for (let row = 0; row < rows; row += 1) {
      const frames = Array.from(time_s, (_, n) => values.subarray((n * rows + row) * points, (n * rows + row + 1) * points));
      this.shown.rows.set(first + row, frames);
    }
    this.limit();
    this.draw();
  }

  /** The size that 97 of 100 values over space and time do not exceed: close to the contact they are far larger. */
  limit() {
    const { rows, points, time_s } = this.shown;
    const sizes = new Float32Array(rows.size * time_s.length * points);
    let next = 0;
    for (const frames of rows.values()) {
      for (const row of frames) {
        for (const value of row) sizes[next++] = Math.abs(value);
      }
    }
    sizes.sort();
    this.shown.limit = sizes[Math.floor(0.97 * sizes.length)] || sizes.at(-1) || 1;
  }

  area() {
    const [w, h] = [this.width - MARGIN.left - MARGIN.right, this.height - MARGIN.top - MARGIN.bottom];
    return { x: MARGIN.left, y: MARGIN.top, w, h };
  }

  /** Distance and depth in m of a pixel. */
  place(px, py) {
    const { x, y, w, h } = this.area();
    if (!this.shown || px < x || px > x + w || py < y || py > y + h) return null;
    const { reach_m } = this.shown;
    return [Math.abs(((px - x) / w) * 2 - 1) * reach_m, ((py - y) / h) * reach_m];
  }

  draw() {
    const context = this.canvas.getContext("2d");
    const fine = devicePixelRatio || 1;
    Object.assign(this.canvas, { width: Math.round(fine * this.width), height: Math.round(fine * this.height) });
    context.setTransform(fine, 0, 0, fine, 0, 0);
    context.font = "12px Ubuntu, system-ui, sans-serif";
    const top = this.shown?.about ? this.shown : this.under;
    if (!top?.about) return;
    const time_s = top.time_s[Math.min(this.frame, top.time_s.length - 1)];
    for (const layer of [this.under, this.shown]) if (layer?.about) this.paint(context, layer, top.limit);
    this.fronts(context, time_s);
    this.axes(context, time_s, top);
  }

  /** The values of a section as colours; rows that are not there yet show what is under them. */
  paint(context, { points, rows, time_s, about }, limit) {
    const frame = Math.min(this.frame, time_s.length - 1);
    const image = new ImageData(2 * points - 1, points);
    const map = mapOf(about);
    for (const [row, frames] of rows) {
      for (let i = 0; i < points; i += 1) {
        const part = frames[frame][i] / limit;
        const rgb = colour(map, map === "diverging" ? 0.5 + 0.5 * part : part);
        for (const column of [points - 1 + i, points - 1 - i]) {
          image.data.set([...rgb, 255], 4 * (row * image.width + column));
        }
      }
    }
    const { x, y, w, h } = this.area();
    const small = new OffscreenCanvas(image.width, image.height);
    small.getContext("2d").putImageData(image, 0, 0);
    context.imageSmoothingEnabled = true;
    // values stand at the middles of pixels, the outermost half a pixel inside
    context.drawImage(small, 0.5, 0.5, image.width - 1, image.height - 1, x, y, w, h);
  }

  fronts(context, time_s) {
    const { x, y, w, h } = this.area();
    const scale = w / (2 * this.shown.reach_m);
    const [p, s, r] = this.shown.speeds.map((speed) => speed * time_s * scale);
    context.save();
    context.beginPath();
    context.rect(x, y, w, h);
    context.clip();
    context.strokeStyle = "#111";
    context.fillStyle = "#111";
    context.setLineDash([5, 4]);
    [p, s].forEach((radius, i) => {
      context.beginPath();
      context.arc(x + w / 2, y, radius, 0, Math.PI);
      context.stroke();
      context.fillText("PS"[i], x + w / 2 + 0.71 * radius + 4, y + 0.71 * radius + 4);
    });
    for (const side of [-1, 1]) {
      context.beginPath();
      context.moveTo(x + w / 2 + side * r, y);
      context.lineTo(x + w / 2 + side * r, y + 18);
      context.stroke();
    }
    context.fillText("R", x + w / 2 + r - 12, y + 16);
    if (this.point) {
      const [px, py] = [x + w / 2 + this.point[0] * scale, y + this.point[1] * scale];
      context.setLineDash([]);
      context.beginPath();
      context.arc(px, py, 5, 0, 2 * Math.PI);
      context.stroke();
    }
    context.restore();
  }

  axes(context, time_s, { reach_m, about, limit }) {
    const { x, y, w, h } = this.area();
    context.fillStyle = "#111";
    context.strokeStyle = "#111";
    context.strokeRect(x, y, w, h);
    const power = thousands(reach_m);
    const length = (part) => digits((part * reach_m) / 1000 ** power);
    context.textAlign = "center";
    for (const part of [-1, -0.5, 0, 0.5, 1]) context.fillText(length(part), x + ((part + 1) / 2) * w, y + h + 15);
    context.fillText(`distance from the axis [${prefixed("m", power)}]`, x + w / 2, y + h + 32);
    context.fillText(withUnit(time_s, "s"), x + w / 2, y - 9);
    context.textAlign = "right";
    for (const part of [0, 0.5, 1]) context.fillText(length(part), x - 6, y + part * h + 4);
    context.save();
    context.translate(13, y + h / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(`depth [${prefixed("m", power)}]`, 0, 0);
    context.restore();
    const bar = { x: x + w + 14, w: 12 };
    const map = mapOf(about);
    for (let i = 0; i < h; i += 1) {
      context.fillStyle = `rgb(${colour(map, 1 - i / h).join()})`;
      context.fillRect(bar.x, y + i, bar.w, 1.5);
    }
    context.fillStyle = "#111";
    context.textAlign = "left";
    const ends = map === "diverging" ? [limit, 0, -limit] : [limit, limit / 2, 0];
    ends.forEach((value, i) => context.fillText(withUnit(value, about.unit), bar.x + bar.w + 4, y + (i / 2) * h + 4));
  }
}
