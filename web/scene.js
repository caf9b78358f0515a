// A scene in the words of data-schema/scene.md: as the page's address, and as the text of a scene file.

/** Every key that the page knows, with the value that a page without an address has. */
export const DEFAULTS = {
  "target.material": "soda-lime-glass",
  "target.youngs_modulus_pa": "7.2e10",
  "target.poisson_ratio": "0.22",
  "target.density_kg_m3": "2500",
  "striker.material": "bearing-steel",
  "striker.diameter_m": "0.003",
  "striker.velocity_m_s": "1",
  "striker.drop_height_m": "",
  "contact.plasticity": "none",
  "contact.tolerance": "1e-4",
  "map.r_max_m": "",
  "output.quantities": "velocity_z",
  "probe.r_m": "",
  "probe.z_m": "",
};

const TEXTS = ["target.material", "striker.material", "contact.plasticity"];
const OWN = ["target.youngs_modulus_pa", "target.poisson_ratio", "target.density_kg_m3"];

/** The keys of an address; unknown ones are left out. */
export function fromHash(hash) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const scene = { ...DEFAULTS };
  for (const [key, value] of given) {
    if (key in DEFAULTS) scene[key] = value;
  }
  if (given.has("striker.drop_height_m") && !given.has("striker.velocity_m_s")) scene["striker.velocity_m_s"] = "";
  if (!given.has("target.material") && OWN.some((key) => given.has(key))) scene["target.material"] = "";
  return scene;
}

/** The address of a scene: the keys that say something. */
export function toHash(scene) {
  const told = Object.entries(scene).filter(([key, value]) => value !== "" && !isIdle(scene, key));
  return `#${new URLSearchParams(told)}`;
}

function isIdle(scene, key) {
  return scene["target.material"] !== "" && OWN.includes(key);
}

function line(scene, key) {
  const value = scene[key];
  return `${key.split(".")[1]} = ${TEXTS.includes(key) ? JSON.stringify(value) : value}\n`;
}

/** A scene file. `more` may have a `map` {r_max_m, points, frames, duration_s} and a `tolerance` of its own. */
export function toToml(scene, { map = null, probe = true, tolerance = null } = {}) {
  const lines = (keys) => keys.filter((key) => scene[key] !== "" && !isIdle(scene, key)).map((key) => line(scene, key)).join("");
  const keysOf = (section) => Object.keys(DEFAULTS).filter((key) => key.startsWith(`${section}.`));
  let text = `[target]\n${lines(keysOf("target"))}\n[striker]\nshape = "ball"\n${lines(keysOf("striker"))}\n`;
  text += `[contact]\n${lines(["contact.plasticity"])}tolerance = ${tolerance ?? scene["contact.tolerance"]}\n`;
  if (probe && scene["probe.r_m"] !== "" && scene["probe.z_m"] !== "") {
    text += `\n[[probe]]\n${lines(["probe.r_m", "probe.z_m"])}`;
  }
  if (map) {
    const { r_max_m: r, points, frames } = map;
    text += `\n[map]\nr_max_m = ${r}\nz_max_m = ${r}\npoints = [${points}, ${points}]\nframes = ${frames}\n`;
  }
  const quantity = scene["output.quantities"];
  const duration = map ? `duration_s = ${map.duration_s}\n` : "";
  const asked = FIELDS.includes(quantity) ? "" : `quantities = ["${quantity}"]\n`;
  if (duration || asked) text += `\n[output]\n${duration}${asked}`;
  return text;
}

/** The fields that every scene has. */
const FIELDS = ["displacement_r", "displacement_z", "stress_rr", "stress_tt", "stress_zz", "stress_rz"];
