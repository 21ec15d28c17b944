// Opens the page in a browser, throws a ball at the pane with the mouse and waits for it to break, and to be heard to break; then lets
// the scene's own ball fly and compares what it breaks with what the program for this machine says.
//
//   SECONDS=600 node page.test.mjs FOLDER BROWSER PLAYWRIGHT OUT REPORT.json RENDERER…
//
// FOLDER is the page's, PLAYWRIGHT the folder with playwright-core, OUT where pictures go; REPORT.json is what `frangible break` says
// of the page's pane; RENDERER is webgpu or webgl2; it gives up after SECONDS.

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import { join, normalize, resolve } from "node:path";

const [folder, program, playwright, out, report, ...renderers] = process.argv.slice(2);
const { chromium } = createRequire(resolve(playwright, "package.json"))("playwright-core");

/** A frame of a software renderer takes a second or more. */
const PATIENCE = 120_000;
const SIZE = { width: 800, height: 500 };
/** Where the pane is clicked: beside its middle, which the scene's own ball meets. */
const CLICK = { x: 585, y: 150 };
const SWITCHES = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  // Both WebGPU and WebGL 2, drawn by the processor.
  "--enable-unsafe-webgpu", "--enable-features=Vulkan", "--use-vulkan=swiftshader", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

setTimeout(() => {
  console.error("the browser took too long");
  process.exit(1);
}, 1000 * Number(process.env.SECONDS ?? 600)).unref();

const TYPES = { html: "text/html", js: "text/javascript", json: "application/json" };

/** The folder, as any web server would give it. */
async function serve() {
  const server = createServer(async (question, answer) => {
    try {
      const path = normalize(new URL(question.url, "http://page").pathname);
      const file = join(folder, path === "/" ? "index.html" : path);
      const content = await readFile(file);
      answer.writeHead(200, { "content-type": TYPES[file.split(".").pop()] ?? "application/octet-stream" });
      answer.end(content);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return server;
}

/** Notes in the page what is handed to the loudspeaker: contexts, frames and the largest sample. */
function eavesdrop() {
  const heard = (window.heard = { contexts: 0, frames: 0, loudest: 0 });
  window.AudioContext = class extends AudioContext {
    constructor() {
      super();
      heard.contexts += 1;
    }
  };
  const start = AudioBufferSourceNode.prototype.start;
  AudioBufferSourceNode.prototype.start = function (...when) {
    const samples = this.buffer.getChannelData(0);
    heard.frames += samples.length;
    heard.loudest = samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), heard.loudest);
    return start.apply(this, when);
  };
}

/** A page with a scene that stands, and what to do with it. */
async function open(browser, address, renderer) {
  const page = await browser.newPage({ viewport: SIZE });
  page.setDefaultTimeout(PATIENCE);
  await page.addInitScript(eavesdrop);
  page.on("pageerror", (error) => console.log(`  page: ${error.message}`));
  page.on("console", (line) => console.log(`  console: ${line.text().slice(0, 200)}`));
  await page.goto(`${address}/?clock=stands${renderer === "webgl2" ? "&renderer=webgl2" : ""}`);
  const failed = page.waitForSelector("#cover.failed", { timeout: 0 }).then(() => page.textContent("#text")).then((why) => assert.fail(why), () => {});
  const state = () => page.evaluate(() => JSON.parse(window.frangible_state()));
  const until = async (met) => {
    await Promise.race([failed, page.waitForFunction(met)]);
    return state();
  };
  const command = async (line) => {
    assert.equal(await page.evaluate((line) => window.frangible_command(line), line), "");
    const after = await until(() => JSON.parse(window.frangible_state()).done);
    assert.ok(!after.complaint, `${line}: ${after.message}`);
    return after;
  };
  await until(() => window.frangible?.times.picture !== undefined);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.renderer), renderer);
  return { page, state, until, command };
}

/** Steps until something is in pieces. */
async function broken(command) {
  for (let steps = 0; steps < 1500; steps += 50) {
    const state = await command("step 50");
    if (state.pieces > 0) return state;
  }
  return assert.fail("nothing broke");
}

/** Notes the page's longest time without a turn, ms. */
function pulse() {
  const noted = (window.pulse = { last: performance.now(), longest: 0 });
  setInterval(() => {
    const now = performance.now();
    noted.longest = Math.max(noted.longest, now - noted.last);
    noted.last = now;
  }, 4);
}

async function trial(browser, address, renderer) {
  const { page, state, until, command } = await open(browser, address, renderer);
  const times = await page.evaluate(() => window.frangible.times);
  console.log(`${renderer}: first picture after ${(times.picture / 1000).toFixed(2)} s (fetched ${(times.fetched / 1000).toFixed(2)}, started ${(times.started / 1000).toFixed(2)})`);
  const whole = await state();
  assert.equal(whole.scene, "pane");
  assert.deepEqual([whole.whole, whole.pieces], [1, 0]);

  const heard = () => page.evaluate(() => ({ ...window.heard }));
  await command("step 10");
  assert.deepEqual(await heard(), { contexts: 0, frames: 0, loudest: 0 }, "a page that nobody has touched is silent");

  await command("ball 0.2 0.01 80 steel");
  const before = (await state()).commands;
  await page.mouse.move(CLICK.x, CLICK.y);
  await page.mouse.click(CLICK.x, CLICK.y);
  await page.waitForFunction((before) => JSON.parse(window.frangible_state()).commands > before, before);
  const thrown = await broken(command);
  assert.ok(thrown.pieces > 1, "a ball of 0.2 kg at 80 m/s breaks the pane");
  assert.equal(thrown.whole, 0);
  assert.ok(Math.hypot(thrown.hit[0], thrown.hit[1] - 0.2) > 0.05, `hit at ${thrown.hit}, where the scene's own ball hits`);
  console.log(`${renderer}: the ball thrown by a click broke the pane into ${thrown.pieces} pieces`);
  const sound = await heard();
  assert.equal(sound.contexts, 1);
  assert.ok(sound.frames > 0 && sound.loudest > 0.01 && sound.loudest <= 1, JSON.stringify(sound));
  console.log(`${renderer}: ${sound.frames} frames of sound were handed over, the loudest at ${sound.loudest.toFixed(2)}`);
  await command("sound off");
  await page.evaluate(() => Object.assign(window.heard, { frames: 0, loudest: 0 }));
  await command("step 20");
  const muted = await heard();
  assert.ok(muted.frames > 0 && muted.loudest === 0, `muted: ${JSON.stringify(muted)}`);
  await command("sound on");
  // So that they are seen to fly.
  const flying = await command("step 150");
  await until(() => JSON.parse(window.frangible_state()).done);
  await page.waitForFunction((frames) => JSON.parse(window.frangible_state()).frames > frames + 1, flying.frames);
  await page.screenshot({ path: join(out, `browser-${renderer}.png`), timeout: PATIENCE });

  // A link to it shows the same break, bit for bit.
  await page.click("#link");
  await page.waitForFunction(() => location.hash.startsWith("#do="));
  const again = await browser.newPage({ viewport: SIZE });
  again.setDefaultTimeout(PATIENCE);
  await again.goto(await page.evaluate(() => location.href));
  await again.waitForFunction(() => window.frangible?.times.followed !== undefined);
  const followed = await again.evaluate(() => JSON.parse(window.frangible_state()));
  const now = await state();
  assert.deepEqual([followed.pieces, followed.steps, followed.masses], [now.pieces, now.steps, now.masses]);
  console.log(`${renderer}: a link of ${(await page.evaluate(() => location.href.length))} characters shows the same ${now.pieces} pieces`);
  await again.close();

  // Breaks are computed elsewhere, and the page's own thread hardly waits.
  assert.equal(page.workers().length, 1);
  await command("reset");
  await page.evaluate(pulse);
  const own = await broken(command);
  const longest = await page.evaluate(() => window.pulse.longest);
  await page.close();
  return { ...own, longest };
}

/** What the browser's break has to do with the native one. */
function compare(renderer, own, known) {
  const sum = own.masses.reduce((all, mass) => all + mass, 0);
  assert.ok(Math.abs(sum / known.mass_kg - 1) < 1e-5, `the pieces have ${sum} kg of ${known.mass_kg}`);
  const largest = [...own.masses].sort((a, b) => b - a).slice(0, known.largest_fragments_kg.length);
  const apart = Math.max(...largest.map((mass, i) => Math.abs(mass - known.largest_fragments_kg[i]))) / known.mass_kg;
  const stages = Object.fromEntries(known.stages_ms);
  const native = ["response", "stress", "cracks", "fragments"].reduce((all, stage) => all + (stages[stage] ?? 0), 0);
  console.log(
    `${renderer}: the scene's own ball: ${own.masses.length} pieces, without a browser ${known.fragments}; the largest differ by up to ` +
      `${apart.toExponential(1)} of the whole; the break took ${(1e3 * own.fracture_seconds).toFixed(0)} ms, without a browser ${native.toFixed(0)} ms; the page stood still for ${own.longest.toFixed(0)} ms at most`,
  );
}

const known = JSON.parse(await readFile(report, "utf8"));
const server = await serve();
const address = `http://127.0.0.1:${server.address().port}`;
const browser = await chromium.launch({ executablePath: program, headless: true, args: SWITCHES });
try {
  for (const renderer of renderers) compare(renderer, await trial(browser, address, renderer), known);
} finally {
  await browser.close();
  server.close();
}
