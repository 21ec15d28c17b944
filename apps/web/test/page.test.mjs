// Opens the page in a browser, throws a ball at the pane with the mouse and waits for it to break, and to be heard to break; then plays
// scenes and compares what breaks, pieces of pieces too, with what comes of them without a browser; then drops a mesh on the page.
//
//   SECONDS=600 node page.test.mjs FOLDER BROWSER PLAYWRIGHT OUT PLAYED.json RENDERER…
//
// FOLDER is the page's, PLAYWRIGHT the folder with playwright-core, OUT where pictures go; PLAYED.json is what came of scenes without a
// browser; RENDERER is webgpu or webgl2; it gives up after SECONDS.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { serve } from "../../npm/test/serve.mjs";

const [folder, program, playwright, out, playedFile, ...renderers] = process.argv.slice(2);
const { chromium } = createRequire(resolve(playwright, "package.json"))("playwright-core");

/** A frame of a software renderer takes a second or more. */
const PATIENCE = 120_000;
const SIZE = { width: 800, height: 500 };
const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
/** Where the pane is touched there. */
const TAP = { x: 300, y: 600 };
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

/** A page with a scene that stands, and what to do with it; on a screen as Playwright describes one. */
async function open(browser, address, renderer, screen = { viewport: SIZE }) {
  const page = await browser.newPage(screen);
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

/** Steps until something is in pieces; a fall from 1.5 m takes 2124. */
async function broken(command) {
  for (let steps = 0; steps < 3000; steps += 100) {
    const state = await command("step 100");
    if (state.pieces > 0) return state;
  }
  return assert.fail("nothing broke");
}

/** Notes the page's longest time without a turn, ms. */
function pulse() {
  const noted = (window.pulse = { last: performance.now(), longest: 0 });
  noted.timer = setInterval(() => {
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

  // What follows is computed in the session's own thread, which draws nothing: once is enough.
  if (renderer === renderers[0]) {
    await played(renderer, page, command);
    await meshes(renderer, page, until, command);
    await all(renderer, page, command);
  }
  await page.close();
}

/** Notes the page's longest time without a turn, ms, while something is done. */
async function longest(page, work) {
  await page.evaluate(pulse);
  await work();
  const { longest, timer } = await page.evaluate(() => window.pulse);
  await page.evaluate((timer) => clearInterval(timer), timer);
  return longest;
}

/** The number of the look at which something was first seen broken. */
const firstBroken = (seen) => seen.findIndex(({ pieces }) => pieces > 0);

/** Pieces that came when pieces broke again. */
const cameLater = (seen) => Math.max(...seen.map(({ pieces }) => pieces)) - seen[firstBroken(seen)].pieces;

/** Chooses every scene of the page once: its bodies are fetched, and it goes on. */
async function all(renderer, page, command) {
  const scenes = await page.evaluate(() => window.frangible.scenes);
  for (const scene of scenes) {
    await command(`scene ${scene}`);
    const state = await command("step 10");
    assert.deepEqual([state.scene, state.steps, state.whole > 0], [scene, 10, true]);
  }
  console.log(`${renderer}: all ${scenes.length} scenes can be chosen`);
}

/** Plays scenes as they were played without a browser: not a bit may differ of what breaks, where each piece is and how it moves. */
async function played(renderer, page, command) {
  // Breaks are computed elsewhere, and the page's own thread hardly waits.
  assert.equal(page.workers().length, 1);
  for (const { scene, steps, native } of known) {
    await command(`scene ${scene}`);
    const seen = [];
    let last;
    const waited = await longest(page, async () => {
      while (seen.length < native.seen.length) {
        last = await command(`step ${steps}`);
        seen.push({ whole: last.whole, pieces: last.pieces, masses: last.masses, fingerprint: last.fingerprint });
      }
    });
    assert.deepEqual(seen, native.seen, `${scene} is not as without a browser`);
    console.log(
      `${renderer}: ${scene}: ${seen[firstBroken(seen)].pieces} pieces and ${cameLater(seen)} more when pieces broke again, every bit as without a ` +
        `browser; the break took ${(1e3 * last.fracture_seconds).toFixed(0)} ms, without a browser ${(1e3 * native.fracture_seconds).toFixed(0)} ms; ` +
        `the page stood still for ${waited.toFixed(0)} ms at most`,
    );
    await page.screenshot({ path: join(out, `browser-${scene}-${renderer}.png`), timeout: PATIENCE });
  }
  assert.ok(known.some(({ native }) => cameLater(native.seen) > 0), "there is a scene in which pieces break again");
}

/** A ring as OBJ, m. */
function ring() {
  const [around, across, radius, thickness] = [64, 24, 0.07, 0.02];
  const lines = [];
  for (let i = 0; i < around; i++) {
    for (let j = 0; j < across; j++) {
      const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
      const out = radius + thickness * Math.cos(b);
      lines.push(`v ${out * Math.cos(a)} ${out * Math.sin(a)} ${thickness * Math.sin(b)}`);
    }
  }
  const vertex = (i, j) => 1 + (i % around) * across + (j % across);
  for (let i = 0; i < around; i++) {
    for (let j = 0; j < across; j++) lines.push(`f ${vertex(i, j)} ${vertex(i + 1, j)} ${vertex(i + 1, j + 1)} ${vertex(i, j + 1)}`);
  }
  return lines.join("\n");
}

/** A box as OBJ with sides of these lengths, m. */
function box(...sides) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${sides.map((side, axis) => ((i >> axis) & 1) * side).join(" ")}`);
  const faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
  return [...corners, ...faces.map((face) => `f ${face}`)].join("\n");
}

/** Drops a file onto the page, as a hand would. */
async function drop(page, name, content) {
  const data = await page.evaluateHandle(([name, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([content], name));
    return data;
  }, [name, content]);
  await page.dispatchEvent("#stage", "drop", { dataTransfer: data });
}

/** Drops a mesh onto the page, which bakes it and lets it fall, and files that are refused. */
async function meshes(renderer, page, until, command) {
  const refuse = async (name, content) => {
    const before = await page.evaluate(() => JSON.parse(window.frangible_state()).commands);
    await drop(page, name, content);
    await page.waitForFunction((before) => JSON.parse(window.frangible_state()).commands > before, before);
    const { message, complaint } = await until(() => JSON.parse(window.frangible_state()).done);
    assert.ok(complaint && message.includes(name.split(".")[0]) && !message.includes("\n"), `${name}: ${message}`);
    console.log(`${renderer}: ${name} is refused: ${message}`);
  };
  await refuse("letter.txt", "Dear reader,");
  await refuse("letter.obj", "Dear reader,");
  await refuse("foil.obj", box(0.3, 0.2, 0.00002));

  const mesh = ring();
  await drop(page, "ring.obj", mesh);
  await page.waitForFunction(() => JSON.parse(window.frangible_state()).bake?.[0] === "meshing");
  const cancelled = await command("cancel-bake");
  assert.deepEqual([cancelled.message, cancelled.bake, cancelled.whole], ["the bake was cancelled", null, 0]);

  await page.evaluate(() => void (window.stages = []));
  const began = Date.now();
  const waited = await longest(page, async () => {
    await drop(page, "ring.obj", mesh);
    await page.waitForFunction(() => {
      const { scene, bake, whole } = JSON.parse(window.frangible_state());
      if (bake && window.stages.at(-1) !== bake[0]) window.stages.push(bake[0]);
      return scene === "ring" && whole === 1;
    });
  });
  const seconds = (Date.now() - began) / 1000;
  const seen = await page.evaluate(() => window.stages);
  assert.ok(seen.length > 2, `the bake tells how far it is: ${seen}`);
  await command("pause");
  const fallen = await broken(command);
  const mass = fallen.masses.reduce((sum, piece) => sum + piece, 0);
  // A torus of porcelain: 2 π² R r² at 2400 kg/m³; the mesh is inscribed in it.
  const wanted = 2 * Math.PI ** 2 * 0.07 * 0.02 ** 2 * 2400;
  assert.ok(mass > 0.95 * wanted && mass < wanted, `the ring weighs ${mass} kg, ${wanted} kg were expected`);
  console.log(
    `${renderer}: a mesh of ${(mesh.length / 1e3).toFixed(0)} kB was baked in ${seconds.toFixed(1)} s, fell, and broke into ${fallen.pieces} pieces; ` +
      `the page stood still for ${waited.toFixed(0)} ms at most; stages shown: ${seen.join(", ")}`,
  );
  await command("step 100");
  await page.screenshot({ path: join(out, `browser-ring-${renderer}.png`), timeout: PATIENCE });
}

/** The page in the hand: a small screen of many pixels, and a finger that throws the ball. */
async function phone(browser, address, renderer) {
  const { page, until, command } = await open(browser, address, renderer, PHONE);
  const sizes = await page.evaluate(() => {
    const { width, height } = document.getElementById("stage");
    return { drawn: [width, height], page: document.documentElement.scrollWidth };
  });
  const { width, height } = PHONE.viewport;
  // One pixel for each of the layout, not for each of the screen's: the window's library has no more.
  assert.deepEqual(sizes, { drawn: [width, height], page: width });
  await page.screenshot({ path: join(out, `phone-${renderer}.png`), timeout: PATIENCE });
  const before = (await until(() => JSON.parse(window.frangible_state()).done)).commands;
  await page.touchscreen.tap(TAP.x, TAP.y);
  await page.waitForFunction((before) => JSON.parse(window.frangible_state()).commands > before, before);
  const thrown = await broken(command);
  console.log(`${renderer}: on a telephone's screen a tap breaks the pane into ${thrown.pieces} pieces`);
  const flying = await command("step 100");
  await page.waitForFunction((frames) => JSON.parse(window.frangible_state()).frames > frames + 1, flying.frames);
  await page.screenshot({ path: join(out, `phone-broken-${renderer}.png`), timeout: PATIENCE });
  await page.close();
}

const known = JSON.parse(await readFile(playedFile, "utf8"));
const { server, address } = await serve(folder);
const browser = await chromium.launch({ executablePath: program, headless: true, args: SWITCHES });
try {
  await phone(browser, address, renderers[0]);
  for (const renderer of renderers) await trial(browser, address, renderer);
} finally {
  await browser.close();
  server.close();
}
