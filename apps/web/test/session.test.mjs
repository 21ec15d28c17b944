// Plays scenes in the session's program, in Node, and compares every bit of what comes of them with a run without WebAssembly:
//
//   node session.test.mjs PROGRAM.js PROGRAM.wasm BAKED PLAYED.json
//
// PROGRAM.wasm may be packed by gzip; BAKED is where the bodies lie that `bodies` baked; PLAYED.json is what `plays` saw.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";

const [script, program, baked, playedFile] = process.argv.slice(2);
const list = JSON.parse(await readFile(join(baked, "list.json"), "utf8"));
const scenes = Object.fromEntries(list.map((scene) => [scene.scene, scene]));
const files = ({ files }) => Promise.all(files.map(async (file) => new Uint8Array(await readFile(join(baked, file)))));

globalThis.frangible = {
  scenes: Object.keys(scenes),
  scene: (name) => scenes[name]?.text,
  byClock: false,
  given: () => [],
  bodies: async (name) => [await files(scenes[name]), scenes[name].of],
  failed: (why) => {
    console.error(why);
    process.exit(1);
  },
};
const { default: init } = await import(pathToFileURL(resolve(script)));
const bytes = await readFile(program);
await init({ module_or_path: bytes[0] === 0x1f ? gunzipSync(bytes) : bytes });

/** Gives a command, and waits until all that it began is done. */
async function give(line) {
  globalThis.frangible_take(line);
  for (;;) {
    globalThis.frangible_turn();
    const [done, whole, pieces, masses, fingerprint] = globalThis.frangible_told();
    if (done) return { whole, pieces, masses: [...masses], fingerprint };
    await new Promise((later) => setTimeout(later));
  }
}

const played = JSON.parse(await readFile(playedFile, "utf8"));
for (const { scene, steps, native } of played) {
  await give(`scene ${scene}`);
  let most = 0;
  const began = performance.now();
  for (const [look, wanted] of native.seen.entries()) {
    const seen = await give(`step ${steps}`);
    assert.deepEqual(seen, wanted, `${scene} after ${(look + 1) * steps} steps`);
    most = Math.max(most, seen.pieces);
  }
  const first = native.seen.find(({ pieces }) => pieces > 0);
  assert.ok(first, `${scene} breaks`);
  console.log(
    `node: ${scene}: the same bits as without WebAssembly, in ${native.seen.length} looks ${steps} steps apart: ${first.pieces} pieces, ` +
      `${most - first.pieces} more when pieces broke again, and where each is and how it moves; ${((performance.now() - began) / 1e3).toFixed(1)} s`,
  );
}
// The session waits for more commands.
process.exit(0);
