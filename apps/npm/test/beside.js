// Beside three-pinata: the same meshes in the same browser, ours by a blow, theirs into as many cells. The pieces are asked what a physics engine asks.
import { BoxGeometry, MeshBasicMaterial, TorusGeometry } from 'three';
import { DestructibleMesh, FractureOptions } from '@dgreenheck/three-pinata';
import { breakable } from 'frangible/bake';

const BODIES = {
  ring: {
    geometry: () => new TorusGeometry(0.04, 0.015, 24, 48),
    options: { material: 'porcelain' },
    blow: { point: [0.055, 0, 0], normal: [-1, 0, 0], speed: 8, striker: { mass: 0.5 } },
  },
  block: {
    geometry: () => new BoxGeometry(0.2, 0.1, 0.1),
    options: { material: 'concrete' },
    blow: { point: [0, 0.05, 0], normal: [0, -1, 0], speed: 30, striker: { mass: 1 } },
  },
};
const ROUNDS = 7;

/** For each body: pieces, median time in ms, share of closed pieces, and how far their volumes sum from the mesh's. */
export async function beside() {
  const rows = [];
  for (const [name, { geometry, options, blow }] of Object.entries(BODIES)) {
    const whole = volumeOf(surface(geometry()));
    const kind = await breakable(geometry(), options);
    const ours = timed(() => kind.body(1).impact(blow).fragments);
    const solids = ours.result.map(({ solid }) => solid);
    rows.push({ name, by: 'frangible', ...ours, ...judged(solids, kind.volume), mesh: kind.volume / whole - 1 });
    const mesh = new DestructibleMesh(geometry(), new MeshBasicMaterial());
    const choice = new FractureOptions({ fractureMethod: 'voronoi', fragmentCount: ours.result.length, voronoiOptions: { mode: '3D' }, seed: 1 });
    const theirs = timed(() => mesh.fracture(choice));
    rows.push({ name, by: 'three-pinata', ...theirs, ...judged(theirs.result.map(({ geometry: g }) => surface(g)), whole), mesh: 0 });
  }
  return rows.map(({ result, ...row }) => row);
}

function timed(make) {
  let result = make();
  const times = Array.from({ length: ROUNDS }, () => {
    const begin = performance.now();
    result = make();
    return performance.now() - begin;
  });
  return { result, ms: times.sort((a, b) => a - b)[ROUNDS >> 1] };
}

function judged(solids, whole) {
  const sum = solids.reduce((total, solid) => total + volumeOf(solid), 0);
  const closed = solids.filter(isClosed).length;
  return { pieces: solids.length, closed: closed / solids.length, volume: sum / whole - 1 };
}

function surface(geometry) {
  const positions = geometry.attributes.position.array;
  const indices = geometry.index?.array ?? Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
  return { positions, indices };
}

/** Whether each edge is passed as often one way as the other, vertices at one place being one: normals and textures part them. */
function isClosed({ positions, indices }) {
  const size = positions.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  const places = new Map();
  const number = (i) => {
    const key = [0, 1, 2].map((k) => Math.round((positions[3 * i + k] / size) * 1e5)).join();
    if (!places.has(key)) places.set(key, places.size);
    return places.get(key);
  };
  const edges = new Map();
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => number(indices[i + k]));
    for (const [p, q] of [[a, b], [b, c], [c, a]]) {
      if (p === q) continue;
      const key = p < q ? `${p} ${q}` : `${q} ${p}`;
      edges.set(key, (edges.get(key) ?? 0) + (p < q ? 1 : -1));
    }
  }
  return [...edges.values()].every((sum) => sum === 0);
}

function volumeOf({ positions: p, indices }) {
  let volume = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => p.slice(3 * indices[i + k], 3 * indices[i + k] + 3));
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  return volume;
}
