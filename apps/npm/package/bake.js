// Makes meshes breakable. bake.d.ts tells what there is.
import { arraysOf } from './arrays.js';
import { Breakable } from './index.js';
import { baking, made } from './modules.js';

/** A mesh, three.js's BufferGeometry or plain arrays, as a baked body: the bytes of its file, and where it lies in the mesh's frame. */
export async function bake(mesh, { material = 'glass', name = 'body', size = 0, wall = 0, tetrahedra = 1500, modes = 40, onProgress, module } = {}) {
  const { positions, indices, normals, uvs } = arraysOf(mesh);
  for (const [what, x, least] of [['size', size, 0], ['wall', wall, 0], ['tetrahedra', tetrahedra, 1], ['modes', modes, 1]]) {
    if (!(x >= least && x < Infinity)) throw new RangeError(`${what} is ${x}: give a number from ${least} on`);
  }
  const inside = await baking(module);
  const numbers = Float64Array.of(size, wall, tetrahedra, modes);
  const baked = made(() => inside.bake(positions, normals, uvs, indices, numbers, material, name, onProgress ?? (() => {})));
  const result = { bytes: baked.bytes(), scale: baked.scale(), offset: [...baked.offset()] };
  baked.free();
  return result;
}

/** The same, ready to be broken, and its pieces again. */
export async function breakable(mesh, options) {
  const { bytes, ...place } = await bake(mesh, options);
  return Object.assign(await Breakable.load(bytes, { again: true }), place);
}
