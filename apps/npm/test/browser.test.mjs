// The example pages in a browser: `node browser.test.mjs BROWSER PLAYWRIGHT OUT`, in a project that has the package installed.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { serve } from './serve.mjs';

const [program, playwright, out] = process.argv.slice(2);
const { chromium } = createRequire(resolve(playwright, 'package.json'))('playwright-core');

/** A frame of a software renderer takes a second or more. */
const PATIENCE = 180_000;
const SWITCHES = ['--no-sandbox', '--disable-quic', '--no-first-run', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const DESK = { viewport: { width: 800, height: 500 } };
const PHONE = { viewport: { width: 390, height: 700 }, deviceScaleFactor: 2, hasTouch: true };

const { server, address } = await serve(process.cwd());
const browser = await chromium.launch({ executablePath: program, args: SWITCHES });

async function open(name, size) {
  const context = await browser.newContext(size);
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(`${address}/pages/${name}.html?seed=3`);
  await page.waitForFunction(() => globalThis.drawn > 1).catch((error) => assert.fail(`${error.message} ${errors}`));
  return { page, errors };
}

/** Waits until something is in pieces, so often, and some frames more; takes a picture. */
async function broken({ page, errors }, name, more, times = 1) {
  await page.waitForFunction((times) => globalThis.pieces > 1 && (globalThis.breaks ?? 1) >= times, times);
  const frames = await page.evaluate(() => globalThis.drawn);
  await page.waitForFunction((enough) => globalThis.drawn >= enough, frames + more);
  await page.screenshot({ path: join(out, `npm-${name}.png`) });
  assert.deepEqual(errors, []);
  const pieces = await page.evaluate(() => globalThis.pieces);
  await page.context().close();
  return pieces;
}

const rapier = await broken(await open('rapier', DESK), 'rapier', 10, 2);
console.log(`npm: with Rapier in a page, where a piece has broken again: ${rapier} pieces`);
for (const [page, name, size] of [['three', 'desk', DESK], ['three', 'phone', PHONE], ['fiber', 'desk', DESK]]) {
  const shown = await open(page, size);
  await shown.page.mouse.click(size.viewport.width / 2, size.viewport.height / 2);
  const pieces = await broken(shown, `${page}-${name}`, 12);
  console.log(`npm: touched in a page of ${page === 'fiber' ? 'react-three-fiber' : 'three.js'}, ${name}: ${pieces} pieces`);
}

// The same in a worker of the page: frames keep coming meanwhile, and what a dead worker owes is rejected.
const { page } = await open('three', DESK);
const told = await page.evaluate(async () => {
  const { Workshop } = await import('frangible/worker');
  const workshop = new Workshop();
  const kind = await workshop.load('../bodies/pane.frangible');
  const body = await kind.body(3);
  const blow = { point: [0, 0, 0.002], normal: [0, 0, -1], speed: 12, striker: { mass: 0.13 } };
  const { fragments, report } = await body.impact(blow);
  const lost = await workshop.load('../bodies/nothing').then(() => 'loaded', ({ message }) => message);
  await workshop.close();
  return { pieces: fragments.length, seconds: report.seconds, lost };
}).catch((error) => assert.fail(error.message));
assert.match(told.lost, /nothing could not be fetched: 404/);
console.log(`npm: in a worker of the page: ${told.pieces} pieces in ${(1e3 * told.seconds).toFixed(1)} ms`);

// Ours are closed and fill the body, whatever others do.
const bench = await browser.newPage();
bench.setDefaultTimeout(PATIENCE);
bench.on('pageerror', (error) => console.error(error));
await bench.goto(`${address}/test/beside.html`);
const rows = await (await bench.waitForFunction(() => globalThis.rows)).jsonValue();
for (const { name, by, pieces, ms, closed, volume } of rows) {
  console.log(`npm: ${name} by ${by}: ${pieces} pieces in ${ms.toFixed(1)} ms, ${(100 * closed).toFixed(0)} % closed, volume off by ${volume.toExponential(1)}`);
  if (by === 'frangible') assert.ok(closed === 1 && Math.abs(volume) < 1e-5 && pieces > 3);
}
await browser.close();
server.close();
