// The page in Chromium, from disk: numbers, controls, address, pictures, downloads; and the program in it against the command.
//
// `scripts/page --test` runs it in the folder of the built page; HERTZLAMB is the command.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const ADDRESS = pathToFileURL("hertzlamb.html").href;
const PICTURES = process.env.HERTZLAMB_PICTURES;
const COMMAND = process.env.HERTZLAMB;
let browser;
let context;

before(async () => {
  browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
  context = await browser.newContext({ viewport: { width: 1280, height: 1000 }, acceptDownloads: true });
});

after(() => browser.close());

/** A page with its first numbers, whose errors are those of the test. */
async function opened(hash = "", size = null) {
  const page = await context.newPage();
  if (size) await page.setViewportSize(size);
  const failed = new Promise((_, reject) => page.on("pageerror", reject));
  failed.catch(() => {});
  await page.goto(ADDRESS + hash);
  await Promise.race([failed, page.waitForFunction(() => document.querySelectorAll("#numbers dd").length > 4)]);
  return page;
}

const number = async (page, name) =>
  page.evaluate((wanted) => {
    const dt = [...document.querySelectorAll("#numbers dt")].find((one) => one.textContent === wanted);
    return dt?.nextElementSibling.firstChild.textContent.trim();
  }, name);

const isDone = (page) => page.waitForFunction(() => document.getElementById("progress").value === 1, null, { timeout: 60000 });

function command(toml) {
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  writeFileSync(join(folder, "scene.toml"), toml);
  return JSON.parse(execFileSync(COMMAND, ["impact", join(folder, "scene.toml"), "--json"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
}

test("the first numbers are there at once, and the file is small", async () => {
  assert.ok(readFileSync("hertzlamb.html").length < 1.5e6);
  const page = await context.newPage();
  await page.addInitScript(() => {
    addEventListener("load", () => (window.loaded = performance.now()));
    new MutationObserver(() => {
      if (!window.shown && document.querySelectorAll("#numbers dd").length > 4) window.shown = performance.now();
    }).observe(document, { childList: true, subtree: true });
  });
  await page.goto(ADDRESS);
  await page.waitForFunction(() => window.shown && window.loaded);
  const wait = await page.evaluate(() => window.shown - window.loaded);
  console.log(`first numbers ${wait.toFixed(0)} ms after the load event`);
  await page.close();
});

test("a section plays, a click shows a history, and the address holds it all", async () => {
  const page = await opened();
  const start = Date.now();
  await page.waitForFunction(() => document.getElementById("section-note").textContent.startsWith("30 by 30"), null, { timeout: 60000 });
  console.log(`coarse section complete ${Date.now() - start} ms after the first numbers`);
  await isDone(page);
  console.log(`section complete ${Date.now() - start} ms after the first numbers`);
  assert.match(await page.textContent("#section-note"), /60 by 60 points, 20 frames, relative tolerance 1e-2: estimated error/);
  const box = await page.locator("#section").boundingBox();
  await page.mouse.click(box.x + 0.55 * box.width, box.y + 0.4 * box.height);
  await page.waitForSelector("#probe svg");
  assert.match(await page.textContent("#probe-note"), /^Largest axial velocity of the particles: .* with an estimated error of /);
  const hash = await page.evaluate(() => location.hash);
  assert.match(hash, /probe.r_m=/);
  const force = await number(page, "Peak force");
  if (PICTURES) await page.screenshot({ path: join(PICTURES, "desktop.png"), fullPage: true });
  const again = await opened(hash);
  assert.equal(await number(again, "Peak force"), force);
  await again.waitForSelector("#probe svg");
  await Promise.all([page.close(), again.close()]);
});

test("a slider changes the numbers while nothing blocks for long", async () => {
  const page = await opened();
  const before = await number(page, "Peak force");
  await page.evaluate(() => {
    window.longest = 0;
    new PerformanceObserver((list) => list.getEntries().forEach((e) => (window.longest = Math.max(window.longest, e.duration)))).observe({ entryTypes: ["longtask"] });
  });
  await page.locator("#speed-slider").focus();
  for (let i = 0; i < 20; i += 1) await page.keyboard.press("ArrowRight");
  await page.waitForFunction((old) => document.querySelector("#numbers dd").textContent.trim().split("after")[0].trim() !== old, before);
  await isDone(page);
  console.log(`longest task ${await page.evaluate(() => window.longest)} ms`);
  await page.close();
});

test("the scene that is downloaded has the command's numbers", async () => {
  const page = await opened("#target.material=granite&striker.material=steel&striker.diameter_m=0.004&striker.drop_height_m=0.05&contact.tolerance=1e-5");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-scene")]);
  const toml = readFileSync(await download.path(), "utf8");
  const report = command(toml);
  const shown = (await number(page, "Restitution")).trim();
  assert.equal(shown, report.restitution.toFixed(6));
  const [csv] = await Promise.all([page.waitForEvent("download"), page.click("#save-csv")]);
  const lines = readFileSync(await csv.path(), "utf8").trim().split("\n");
  const column = lines[0].split(",").indexOf("force_n");
  const largest = Math.max(...lines.slice(1).map((line) => Number(line.split(",")[column])));
  assert.ok(Math.abs(largest / report.peak_force_n - 1) < 1e-3);
  const [svg] = await Promise.all([page.waitForEvent("download"), page.click('.svg[data-of="force"]')]);
  assert.match(readFileSync(await svg.path(), "utf8"), /^<svg xmlns/);
  await page.close();
});

test("bad input gets the program's sentence, and the page goes on", async () => {
  const page = await opened();
  await page.fill("#diameter", "-3");
  await page.waitForSelector("#error:not([hidden])");
  assert.match(await page.textContent("#error"), /striker\.diameter_m = -0\.003 is outside \(0, inf\)/);
  await page.fill("#diameter", "3");
  await page.waitForSelector("#error[hidden]", { state: "attached" });
  await page.close();
});

test("own numbers, plasticity and a phone", async () => {
  const page = await opened("#target.youngs_modulus_pa=7e10&target.poisson_ratio=0.33&target.density_kg_m3=2700&contact.plasticity=none&output.quantities=von_mises", { width: 390, height: 844 });
  assert.equal(await page.inputValue("#modulus"), "70");
  await page.selectOption("#target", "aluminium-6061-t6");
  await page.selectOption("#plasticity", "thornton");
  await page.waitForFunction(() => [...document.querySelectorAll("#numbers dt")].some((dt) => dt.textContent === "Plastic work"));
  await isDone(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} pixels wide`);
  if (PICTURES) await page.screenshot({ path: join(PICTURES, "phone.png"), fullPage: true });
  await page.close();
});

/** The calls of the program in the page, without a browser. */
async function program() {
  const { exports } = (await WebAssembly.instantiate(readFileSync("program.wasm"), {})).instance;
  return (name, toml) => {
    const [a, b] = [name, toml].map((text) => new TextEncoder().encode(text));
    const place = exports.allocate(a.length + b.length);
    new Uint8Array(exports.memory.buffer, place, a.length).set(a);
    new Uint8Array(exports.memory.buffer, place + a.length, b.length).set(b);
    const head = exports.call(place, a.length + b.length, a.length, 0, 0);
    const [json, length] = new Uint32Array(exports.memory.buffer, head, 4);
    const found = JSON.parse(new TextDecoder().decode(new Uint8Array(exports.memory.buffer, json, length)));
    exports.release(head);
    return found;
  };
}

test("more samples than 32 bits can count are rejected", async () => {
  const call = await program();
  const scene = '[target]\nmaterial = "steel"\n[striker]\nshape = "ball"\nmaterial = "steel"\ndiameter_m = 0.01\nvelocity_m_s = 1\n';
  for (const more of ["[output]\nduration_s = 1e9\n", "[[probe]]\nr_m = 0\nz_m = 1e9\n"]) {
    assert.match(call("impact", scene + more).error.message, /^the output needs .* samples of .* more than 4000000/);
  }
});

test("100 random scenes have the command's numbers to 1e-12", async () => {
  const call = await program();
  const materials = call("materials", "").materials.filter((m) => m.density_kg_m3 !== null);
  // a fixed sequence (Park and Miller)
  let state = 20261128;
  const draw = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const log = (low, high) => low * (high / low) ** draw();
  let [worst, compared] = [0, 0];
  for (let i = 0; i < 100; i += 1) {
    const [block, ball] = [0, 1].map(() => materials[Math.floor(draw() * materials.length)].name);
    const toml = `[target]\nmaterial = "${block}"\n[striker]\nshape = "ball"\nmaterial = "${ball}"\ndiameter_m = ${log(1e-4, 0.1)}\nvelocity_m_s = ${log(1e-3, 30)}\n[contact]\ntolerance = ${log(1e-6, 1e-2)}\n`;
    const found = call("impact", toml);
    if (found.error) continue;
    compared += 1;
    const report = command(toml);
    for (const name of ["peak_force_n", "contact_time_s", "restitution", "radiated_energy_j", "peak_displacement_m"]) {
      if (found[name] !== report[name]) worst = Math.max(worst, Math.abs(found[name] / report[name] - 1));
    }
    assert.equal(found.model, report.model);
  }
  console.log(`largest relative difference ${worst} in ${compared} scenes`);
  assert.ok(compared > 80 && worst < 1e-12);
});
