// Bakes meshes into bodies that can break. bake.d.ts documents the interface.
import { arraysOf, joined, materialsOf } from './arrays.js';
import { Breakable } from './index.js';
import { baking, made } from './modules.js';

/** Bakes a mesh (a three.js BufferGeometry or plain arrays). Returns the bytes of the file and the transform from the mesh to the body. */
export async function bake(mesh, { material = 'glass', name = 'body', size = 0, wall = 0, tetrahedra = 1500, modes = 40, parts = '', gap = NaN, onProgress, module } = {}) {
  const { positions, indices, normals, uvs, moreUvs, colors, groups } = arraysOf(mesh);
  for (const [what, x, least] of [['size', size, 0], ['wall', wall, 0], ['tetrahedra', tetrahedra, 1], ['modes', modes, 1]]) {
    if (!(x >= least && x < Infinity)) throw new RangeError(`${what} is ${x}: give a number, ${least} or above`);
  }
  if (!['', 'largest', 'weld'].includes(parts)) throw new RangeError(`parts is ${parts}: give 'largest' or 'weld'`);
  const inside = await baking(module);
  const numbers = Float64Array.of(size, wall, tetrahedra, modes, gap);
  const baked = made(() => inside.bake(positions, normals, uvs, [joined(moreUvs), colors], indices, materialsOf(groups, indices.length / 3), numbers, [material, name, parts].map(String), onProgress ?? (() => {})));
  const result = { bytes: baked.bytes(), scale: baked.scale(), offset: [...baked.offset()] };
  baked.free();
  return result;
}

/** Bakes a mesh and loads the result, with pieces that can break again. */
export async function breakable(mesh, options) {
  const { bytes, ...place } = await bake(mesh, options);
  return Object.assign(await Breakable.load(bytes, { again: true }), place);
}
