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
  return { positions: Float32Array.from(positions), indices, normals: list(normals, 3), uvs: list(uvs, 2) };
}
