// Opens the page in a browser without a graphics card, waits until the glass has broken, and keeps a picture of before and one of after.
//
//   SECONDS=600 node page.test.mjs FOLDER BROWSER PLAYWRIGHT OUT
//
// FOLDER is the page's, PLAYWRIGHT the folder with playwright-core, OUT where pictures go; it gives up after SECONDS.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";
import { serve } from "../../../apps/npm/test/serve.mjs";

const [folder, program, playwright, out] = process.argv.slice(2);
const { chromium } = createRequire(resolve(playwright, "package.json"))("playwright-core");

const SIZE = { width: 640, height: 400 };
const SWITCHES = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  // WebGL 2, drawn by the processor.
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

setTimeout(() => {
  console.error("the browser took too long");
  process.exit(1);
}, 1000 * Number(process.env.SECONDS ?? 600)).unref();

const { server, address } = await serve(folder);

const packed = gzipSync(await readFile(join(folder, "glass_bg.wasm")), { level: 9 }).length;
console.log(`bevy page: as a server packs it, the program has ${(packed / 1e6).toFixed(1)} MB`);

const browser = await chromium.launch({ executablePath: program, args: SWITCHES });
try {
  const page = await browser.newPage({ viewport: SIZE });
  const said = [];
  const failed = [];
  page.on("console", (line) => {
    said.push(line.text());
    console.log(`  console: ${line.text().slice(0, 300)}`);
  });
  page.on("pageerror", (error) => {
    if (!error.message.includes("control flow")) failed.push(error.message);
    console.log(`  page: ${error.message.slice(0, 300)}`);
  });
  const begun = Date.now();
  const since = () => `${((Date.now() - begun) / 1000).toFixed(1)} s`;
  const until = async (met, what) => {
    while (!met()) {
      assert.deepEqual(failed, [], what);
      const told = await page.textContent("#text");
      assert.ok(!told.startsWith("It cannot be shown"), told);
      await new Promise((later) => setTimeout(later, 50));
    }
  };
  await page.goto(`${address}/`);
  const shot = async (name) => {
    const picture = await page.screenshot({ timeout: 0 });
    await writeFile(join(out, `bevy-${name}.png`), picture);
    return picture;
  };
  const pieces = () => said.map((line) => /(\d+) pieces/.exec(line)).find(Boolean);
  await until(() => said.some((line) => line.includes("the scene is drawn")), "no frame was drawn");
  console.log(`bevy page: first frame after ${since()}`);
  const before = await shot("before");
  assert.equal(pieces(), undefined, "the first picture is one of before");
  await until(pieces, "nothing broke");
  const count = Number(pieces()[1]);
  console.log(`bevy page: the glass broke into ${count} pieces after ${since()}`);
  assert.ok(count > 1);
  // Where a frame takes half a second the pieces are up in the air for long.
  await new Promise((later) => setTimeout(later, 15000));
  const after = await shot("after");
  assert.ok(!before.equals(after), "the picture did not change");
  // Another glass.
  const many = said.length;
  await page.keyboard.press("Space", { delay: 1500 });
  await until(() => said.slice(many).some((line) => /\d+ pieces/.test(line)), "the second glass did not break");
  console.log(`bevy page: a second glass broke after ${since()}`);
  assert.deepEqual(failed, []);
} finally {
  await browser.close();
  server.close();
}
