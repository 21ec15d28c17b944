// Meshes as flat lists of numbers.

/** Flat arrays of a three.js BufferGeometry or of plain arrays. */
export function arraysOf(mesh) {
  const attributes = mesh?.attributes;
  const positions = attributes ? attributes.position?.array : mesh?.positions;
  if (!positions?.length || positions.length % 3) throw new TypeError('the mesh has no positions: give a BufferGeometry, or { positions, indices }');
  if (attributes && [attributes.position, attributes.normal, attributes.uv].some((of) => of?.isInterleavedBufferAttribute)) {
    throw new TypeError("the mesh's attributes are interleaved: deinterleave them first (BufferGeometryUtils.deinterleaveGeometry)");
  }
  const count = positions.length / 3;
  const given = attributes ? mesh.index?.array : mesh.indices;
  const indices = Uint32Array.from(given ?? Array.from({ length: count }, (_, i) => i));
  if (indices.length % 3 || indices.some((i) => i >= count)) throw new RangeError(`the indices are not triangles of ${count} vertices: give three per triangle, each below ${count}`);
  const list = (array, per) => Float32Array.from(array?.length === per * count ? array : []);
  const normals = attributes ? attributes.normal?.array : mesh.normals;
  const uvs = attributes ? attributes.uv?.array : mesh.uvs;
  const further = attributes ? [attributes.uv1, attributes.uv2, attributes.uv3].map((of) => of?.array) : (mesh.moreUvs ?? []);
  const sets = further.filter((set) => set?.length === 2 * count);
  return {
    positions: Float32Array.from(positions),
    indices,
    normals: list(normals, 3),
    uvs: list(uvs, 2),
    moreUvs: sets.map((set) => Float32Array.from(set)),
    colors: colorsOf(attributes?.color ?? mesh.colors, count),
    groups: (mesh.groups ?? []).map(({ start, count, materialIndex, material = materialIndex ?? 0 }) => ({ start, count, material })),
  };
}

/** Linear red, green, blue and opacity of each vertex: of an attribute of three or four numbers, as three.js has them, or of a list. */
function colorsOf(given, count) {
  if (given?.isBufferAttribute) {
    const alpha = (i) => (given.itemSize > 3 ? given.getW(i) : 1);
    return Float32Array.from(Array.from({ length: count }, (_, i) => [given.getX(i), given.getY(i), given.getZ(i), alpha(i)]).flat());
  }
  if (given?.length === 4 * count) return Float32Array.from(given);
  if (given?.length !== 3 * count) return new Float32Array();
  return Float32Array.from(Array.from({ length: count }, (_, i) => [...given.slice(3 * i, 3 * i + 3), 1]).flat());
}

/** Number of the material of each triangle; none if there are no groups. */
export function materialsOf(groups, triangles) {
  const materials = new Uint32Array(groups.length ? triangles : 0);
  for (const { start, count, material } of groups) materials.fill(material, start / 3, Math.min((start + count) / 3, triangles));
  return materials;
}

/** Lists of numbers as one. */
export const joined = (lists) => Float32Array.from(lists.flatMap((list) => [...list]));
