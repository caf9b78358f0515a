// The page: controls, address and pictures, around the calls of the program.

import { Engine, compiled } from "./engine.js";
import { chart } from "./lines.js";
import { DEFAULTS, fromHash, toHash, toToml } from "./scene.js";
import { Section } from "./section.js";
import { digits, named, withUnit } from "./words.js";

const of = (id) => document.getElementById(id);
const module = compiled();
// numbers do not wait for pictures
const numbers = new Engine(module, 1);
const pictures = new Engine(module, Math.max(1, Math.min(8, navigator.hardwareConcurrency || 2)));

const POINTS = 60;
const FRAMES = 20;
const ROWS_OF_TILE = 2;
const COARSE = "1e-2";

let scene = fromHash(location.hash);
let latest = null;
let speeds = [];
const section = new Section(of("section"), ([r_m, z_m]) => {
  change({ "probe.r_m": written(r_m), "probe.z_m": written(z_m) });
});

/** Draws a chart into a figure, as wide as that is. */
const draw = (id, what) => (of(id).innerHTML = chart({ ...what, width: Math.max(300, of(id).clientWidth) }));

/** A number for a scene: four digits are plenty for a place that was clicked. */
const written = (value) => String(Number(value.toPrecision(4)));

// --- controls ------------------------------------------------------------------------------------------------------

/** Number inputs: their element, key, and SI units of one of the input's. */
const NUMBERS = [
  ["diameter", "striker.diameter_m", 1e-3],
  ["modulus", "target.youngs_modulus_pa", 1e9],
  ["ratio", "target.poisson_ratio", 1],
  ["density", "target.density_kg_m3", 1],
  ["reach", "map.r_max_m", 1e-3],
  ["probe-r", "probe.r_m", 1e-3],
  ["probe-z", "probe.z_m", 1e-3],
];
const CHOICES = [
  ["striker", "striker.material"],
  ["target", "target.material"],
  ["plasticity", "contact.plasticity"],
  ["tolerance", "contact.tolerance"],
  ["quantity", "output.quantities"],
];
const SLIDERS = [
  ["diameter-slider", "diameter"],
  ["speed-slider", "speed"],
];

/** Text of a number in other units, without the noise of a division. */
const scaled = (text, unit) => (text.trim() === "" ? "" : String(Number((Number(text) * unit).toPrecision(12))));

const isDrop = () => scene["striker.drop_height_m"] !== "";
const speedKey = () => (isDrop() ? "striker.drop_height_m" : "striker.velocity_m_s");
const speedUnit = () => (isDrop() ? 1e-3 : 1);

/** Writes the scene into the controls. */
function show() {
  for (const [id, key, unit] of NUMBERS) put(id, scaled(scene[key], 1 / unit));
  for (const [id, key] of CHOICES) put(id, scene[key]);
  put("motion", isDrop() ? "drop" : "velocity");
  put("speed", scaled(scene[speedKey()], 1 / speedUnit()));
  of("motion-label").textContent = isDrop() ? "Drop height in mm" : "Velocity in m/s";
  const [low, high] = isDrop() ? [-1, 4] : [-2, 2];
  Object.assign(of("speed-slider"), { min: low, max: high });
  for (const [slider, id] of SLIDERS) of(slider).value = Math.log10(Number(of(id).value) || 1);
  of("own").hidden = scene["target.material"] !== "";
}

function put(id, value) {
  // what is being typed is left alone
  if (document.activeElement !== of(id) || of(id).tagName === "SELECT") of(id).value = value;
}

/** Changes keys of the scene, and computes what depends on them. */
function change(keys) {
  scene = { ...scene, ...keys };
  history.replaceState(null, "", toHash(scene));
  show();
  update();
}

function listen() {
  for (const [id, key, unit] of NUMBERS) of(id).addEventListener("input", () => change({ [key]: scaled(of(id).value, unit) }));
  for (const [id, key] of CHOICES) of(id).addEventListener("input", () => change({ [key]: of(id).value }));
  of("speed").addEventListener("input", () => change({ [speedKey()]: scaled(of("speed").value, speedUnit()) }));
  for (const [slider, id] of SLIDERS) {
    of(slider).addEventListener("input", () => {
      of(id).value = String(Number((10 ** Number(of(slider).value)).toPrecision(3)));
      of(id).dispatchEvent(new Event("input"));
    });
  }
  of("motion").addEventListener("input", () => {
    const drops = of("motion").value === "drop";
    change(drops ? { "striker.velocity_m_s": "", "striker.drop_height_m": "0.05" } : { "striker.velocity_m_s": "1", "striker.drop_height_m": "" });
  });
  of("frame").addEventListener("input", () => {
    stop();
    section.frame = Number(of("frame").value);
    section.draw();
  });
  of("play").addEventListener("click", () => (playing ? stop() : play()));
  of("copy").addEventListener("click", copy);
  of("save-scene").addEventListener("click", () => save("scene.toml", toToml(scene), "application/toml"));
  of("save-csv").addEventListener("click", () => latest && save("impact.csv", csv(latest), "text/csv"));
  for (const button of document.querySelectorAll(".svg")) {
    const id = button.dataset.of;
    button.addEventListener("click", () => of(id).innerHTML && save(`${id}.svg`, of(id).innerHTML, "image/svg+xml"));
  }
  addEventListener("hashchange", () => {
    scene = fromHash(location.hash);
    show();
    update();
  });
  of("controls").addEventListener("submit", (event) => event.preventDefault());
}

async function copy() {
  try {
    await navigator.clipboard.writeText(toToml(scene));
    of("said").textContent = "Copied.";
  } catch {
    of("said").textContent = "This browser does not let the page copy; use Download scene.toml.";
  }
}

function save(name, text, type) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** All histories as columns. */
function csv({ lists }) {
  const names = Object.keys(lists).filter((name) => lists[name].length === lists.time_s.length);
  const rows = Array.from(lists.time_s, (_, i) => names.map((name) => lists[name][i]).join());
  return `${names.join()}\n${rows.join("\n")}\n`;
}

// --- results -------------------------------------------------------------------------------------------------------

let pending = 0;

/** Computes the numbers at once, and the pictures when the controls have rested for a moment. */
async function update() {
  numbers.begin("impact");
  clearTimeout(pending);
  const found = await numbers.ask("impact", "impact", toToml(scene));
  of("error").hidden = !found.error;
  of("results").classList.toggle("stale", Boolean(found.error));
  if (found.error) {
    of("error").textContent = found.error.message;
    return;
  }
  latest = found;
  report(found);
  pending = setTimeout(() => {
    drawCurve();
    drawSection(found);
  }, 150);
}

function report(found) {
  const energy = (part) => `${digits((100 * part) / found.initial_energy_j)} %`;
  const rows = [
    ["Peak force", withUnit(found.peak_force_n, "N"), `after ${withUnit(found.peak_force_time_s, "s")}`],
    ["Contact time", withUnit(found.contact_time_s, "s"), ""],
    ["Restitution", found.restitution.toFixed(6), `rebound at ${withUnit(found.rebound_velocity_m_s, "m/s")}`],
    ["Energy into waves", energy(found.radiated_energy_j), `of ${withUnit(found.initial_energy_j, "J")}`],
  ];
  if (found.plastic_work_j !== null) rows.push(["Plastic work", energy(found.plastic_work_j), ""]);
  rows.push(["Contact radius", withUnit(found.contact_radius_m, "m"), ""]);
  rows.push(["Relative error", found.relative_error_estimate.toExponential(1), "estimated"]);
  rows.push(["Model", found.model, found.reason]);
  of("numbers").replaceChildren(
    ...rows.flatMap(([name, value, more]) => {
      const [dt, dd, small] = ["dt", "dd", "small"].map((tag) => document.createElement(tag));
      dt.textContent = name;
      dd.textContent = `${value} `;
      small.textContent = more;
      dd.append(small);
      return [dt, dd];
    }),
  );
  of("warnings").replaceChildren(...found.warnings.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
  const { time_s, force_n, hertz_n } = found.lists;
  const end = Array.from(time_s).findIndex((t) => t > 1.15 * found.contact_time_s);
  const until = (list) => list.subarray(0, end < 0 ? list.length : end);
  const curves = [{ name: "force", at: until(time_s), values: until(force_n), error: found.relative_error_estimate * found.peak_force_n }];
  if (hertz_n) curves.push({ name: "Hertz, without waves", at: until(time_s), values: until(hertz_n) });
  draw("force", { title: "Contact force over time", x: { name: "time", unit: "s" }, y: { name: "force", unit: "N" }, curves });
  drawProbe(found);
  speeds = found.speeds_m_s;
}

function drawProbe({ probe, lists }) {
  const shown = probe?.quantities.find(({ name }) => name === scene["output.quantities"]);
  section.point = probe ? [Number(scene["probe.r_m"]), Number(scene["probe.z_m"])] : null;
  section.draw();
  if (!shown) {
    of("probe").innerHTML = "";
    return;
  }
  const { name, unit, meaning, error } = shown;
  const words = named(meaning);
  const marks = probe.arrival_s.map((at, i) => ({ at, label: "PSR"[i] })).filter(({ at }) => Number.isFinite(at));
  const curves = [{ name: words, at: lists.time_s, values: lists[name], error }];
  draw("probe", { title: `${words} over time`, x: { name: "time", unit: "s" }, y: { name: words, unit }, curves, marks });
  const peak = lists[name].reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  of("probe-note").textContent = `Largest ${words}: ${withUnit(peak, unit)}, with an estimated error of ${withUnit(error, unit)}.`;
}

/** The scenes of the pictures that are shown or on their way: a point that is clicked changes none of them. */
const drawn = {};

function isNew(kind, text) {
  if (drawn[kind] === text) return false;
  drawn[kind] = text;
  pictures.begin(kind);
  return true;
}

async function drawCurve() {
  const text = toToml(scene, { probe: false });
  if (!isNew("curve", text)) return;
  const { lists } = await pictures.ask("curve", "curve", text);
  if (!lists.velocity_m_s) return;
  const at = lists.velocity_m_s;
  const curves = [{ name: "elastic", at, values: lists.elastic }];
  if (lists.plastic) curves.unshift({ name: scene["contact.plasticity"], at, values: lists.plastic });
  const now = Math.sqrt(at[0] * at[at.length - 1]);
  const axes = { x: { name: "velocity", unit: "m/s", log: true }, y: { name: "restitution", unit: "1", free: true } };
  draw("curve", { title: "Restitution over velocity", ...axes, curves, marks: [{ at: now, label: "now" }] });
}

/** Computes the section, first coarsely, unless it is shown already. */
function drawSection({ contact_time_s, contact_radius_m }) {
  const automatic = Math.max(2.5 * speeds[2] * contact_time_s, 8 * contact_radius_m);
  const reach_m = Number(scene["map.r_max_m"]) || Number(automatic.toPrecision(2));
  const duration_s = Math.max(1.1 * contact_time_s, reach_m / speeds[2]);
  const text = (points) => toToml(scene, { map: { r_max_m: reach_m, points, frames: FRAMES, duration_s }, probe: false, tolerance: COARSE });
  if (!isNew("rows", text(POINTS))) return;
  of("section-note").textContent = "";
  of("progress").value = 0;
  drawRows(POINTS / 2, reach_m, text).then(() => drawRows(POINTS, reach_m, text));
}

/** Computes a section in tiles of a few rows, those at the surface first. */
function drawRows(points, reach_m, text) {
  const isFiner = points === POINTS;
  section.begin(points, reach_m, speeds, isFiner);
  const errors = [];
  let done = 0;
  return new Promise((complete) => {
    for (let to = points; to > 0; to -= ROWS_OF_TILE) {
      const from = Math.max(0, to - ROWS_OF_TILE);
      pictures.ask("rows", "rows", text(points), from, to).then((found) => {
        done += to - from;
        if (isFiner) of("progress").value = done / points;
        if (found.error) {
          of("section-note").textContent = found.error.message;
          return;
        }
        section.add(points - to, flipped(found.lists, to - from, points), found);
        errors.push(...found.lists.errors);
        if (done === points) complete(tell(points, errors, found.unit));
      });
    }
  });
}

/** A sentence on the section below it. */
function tell(points, errors, unit) {
  errors.sort((a, b) => a - b);
  const median = withUnit(errors[Math.floor(errors.length / 2)], unit);
  of("section-note").textContent = `${points} by ${points} points, ${FRAMES} frames, relative tolerance ${COARSE}: estimated error ${median} at half of the points. Colours end at ${withUnit(section.shown.limit, unit)}, which 3 of 100 values exceed.`;
}

/** Rows from the surface down instead of from below. */
function flipped({ time_s, values }, rows, points) {
  const turned = new Float64Array(values.length);
  for (let n = 0; n < time_s.length; n += 1) {
    for (let row = 0; row < rows; row += 1) {
      const from = (n * rows + row) * points;
      turned.set(values.subarray(from, from + points), (n * rows + rows - 1 - row) * points);
    }
  }
  return { time_s, values: turned };
}

// --- time ----------------------------------------------------------------------------------------------------------

let playing = 0;

function play() {
  of("play").textContent = "Pause";
  playing = setInterval(() => {
    section.frame = (section.frame + 1) % FRAMES;
    of("frame").value = section.frame;
    section.draw();
  }, 150);
}

function stop() {
  clearInterval(playing);
  playing = 0;
  of("play").textContent = "Play";
}

async function begin() {
  listen();
  show();
  update();
  numbers.begin("materials");
  const { materials } = await numbers.ask("materials", "materials", "");
  for (const [id, own] of [["striker", false], ["target", true]]) {
    const options = materials.filter((m) => m.density_kg_m3 !== null).map(({ name }) => new Option(name));
    if (own) options.unshift(new Option("own numbers", ""));
    of(id).replaceChildren(...options);
  }
  show();
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) stop();
  else play();
}

begin();
