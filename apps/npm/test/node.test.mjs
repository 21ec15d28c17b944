// The package in Node: `node node.test.mjs HASHES`, in a project that has it installed.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { Breakable } from 'frangible';
import { bake, breakable } from 'frangible/bake';
import { Workshop } from 'frangible/worker';

const native = JSON.parse(await readFile(process.argv[2], 'utf8'));
const bodyFile = (name) => readFile(new URL(`../bodies/${name}.frangible`, import.meta.url));
const ball = { mass: 0.13 };
const blows = {
  pane: { point: [0, 0, 0.002], normal: [0, 0, -1], speed: 12, striker: ball },
  block: { point: [0.105, 0.05, -0.025], normal: [-0.105, -0.05, 0.025], speed: 20 },
};

// The same bits as outside.
for (const [name, blow] of Object.entries(blows)) {
  const kind = await Breakable.load(await bodyFile(name));
  const outcome = kind.body(3).impact(blow);
  const { seconds, ...bits } = native[name];
  assert.deepEqual(hashOf(outcome), bits, `${name} breaks here as it does outside`);
  closed(outcome, kind);
  conserving(outcome, kind);
  const again = kind.body(3).impact(blow);
  const warm = kind.body(3).impact(blow);
  console.log(`npm: ${name} in Node: ${outcome.fragments.length} pieces, bits as outside, ${(1e3 * warm.report.seconds).toFixed(1)} ms, ${(warm.report.seconds / seconds).toFixed(1)} times as long as there`);
  assert.equal(again.fragments.length, outcome.fragments.length);
}

const pane = await Breakable.load(await bodyFile('pane'));
softBlowHolds();
worldAxesAreTurned();
refusals();
await refusedFiles();
await piecesBreakAgain();
await inAWorker();
await baked();
await looks();
console.log('npm: errors name what is wrong, a worker gives the same pieces and its end rejects what waits');

function hashOf(outcome) {
  let hash = 0x811c9dc5;
  let bytes = 0;
  const add = (view) => {
    for (const byte of new Uint8Array(view.buffer, view.byteOffset, view.byteLength)) hash = Math.imul(hash ^ byte, 0x01000193);
    bytes += view.byteLength;
  };
  for (const { geometry, mass } of outcome.fragments) {
    add(geometry.positions);
    add(geometry.indices);
    add(Float64Array.of(mass));
  }
  return { pieces: outcome.fragments.length, bytes, hash: (hash >>> 0).toString(16).padStart(8, '0') };
}

/** Every directed edge of a piece has its opposite, in its solid and where it is drawn, and the pieces weigh what the body did. */
function closed(outcome, kind) {
  const mass = outcome.fragments.reduce((sum, fragment) => sum + fragment.mass, 0);
  assert.ok(Math.abs(mass / kind.mass - 1) < 1e-6, `${mass} kg of ${kind.mass}`);
  for (const { solid, geometry, hulls } of outcome.fragments) {
    const edges = new Set();
    for (let i = 0; i < solid.indices.length; i += 3) {
      const [a, b, c] = solid.indices.slice(i, i + 3);
      for (const edge of [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]) {
        assert.ok(!edges.has(edge));
        edges.add(edge);
      }
    }
    for (const edge of edges) assert.ok(edges.has(edge.split(' ').reverse().join(' ')));
    assert.ok(geometry.outerIndices <= geometry.indices.length && geometry.indices.every((i) => i < geometry.positions.length / 3));
    assert.deepEqual(bordersOf(geometry), [], 'what is drawn is closed');
    assert.equal(geometry.uvs.length / 2, geometry.positions.length / 3);
    assert.ok(hulls.length > 0);
  }
}

/** Directed edges, from place to place, that do not run as often the other way: what is drawn has a vertex for each normal of a place. */
function bordersOf({ positions, indices }) {
  const place = (i) => positions.slice(3 * i, 3 * i + 3).join(' ');
  const surplus = new Map();
  const add = (edge, by) => surplus.set(edge, (surplus.get(edge) ?? 0) + by);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [...indices.slice(i, i + 3)].map(place);
    for (const [from, to] of [[a, b], [b, c], [c, a]]) {
      add(`${from}, ${to}`, 1);
      add(`${to}, ${from}`, -1);
    }
  }
  return [...surplus].filter(([, by]) => by > 0).map(([edge]) => edge);
}

/** Momentum and angular momentum of pieces and ball are the ball's, and energy does not rise. */
function conserving(outcome, kind) {
  const turn = Math.SQRT1_2;
  const before = { mass: 0.13, position: [0.3, 1.04, -0.2], radius: 0.0158, linear: [0.5, -12, 0.25] };
  const pose = { position: [0.3, 1, -0.2], rotation: [-turn, 0, 0, turn] };
  if (kind.supported) return;
  const after = outcome.motions({ pose, striker: before });
  const bodies = outcome.fragments.map((fragment, i) => ({ mass: fragment.mass, ...after.fragments[i] }));
  bodies.push({ ...before, ...after.striker });
  const sum = (of) => bodies.reduce((total, body) => total.map((x, k) => x + of(body)[k]), [0, 0, 0]);
  const momentum = sum((body) => body.linear.map((v) => v * body.mass));
  for (const k of [0, 1, 2]) assert.ok(Math.abs(momentum[k] - 0.13 * before.linear[k]) < 1e-9, `${momentum}`);
  const energy = (v, m) => 0.5 * m * v.reduce((s, x) => s + x * x, 0);
  const kinetic = bodies.reduce((total, body) => total + energy(body.linear, body.mass), 0);
  assert.ok(kinetic + outcome.report.fractureEnergy * 0.999 <= energy(before.linear, 0.13), `${kinetic} J`);
}

function softBlowHolds() {
  const outcome = pane.body(1).impact({ ...blows.pane, speed: 0.05 });
  assert.ok(!outcome.broke && outcome.margin > 1 && outcome.fragments.length === 0);
  assert.equal(outcome.motions, undefined);
  const script = pane.body(1).impact({ point: { x: 0, y: 0, z: 0.002 }, impulse: [0, 0, -2], duration: 1e-3 });
  assert.ok(script.broke);
}

function worldAxesAreTurned() {
  // The pane upright, hit along +y.
  const turn = Math.SQRT1_2;
  const pose = { position: { x: 5, y: 6, z: 7 }, rotation: { x: turn, y: 0, z: 0, w: turn } };
  const there = pane.body(3).impact({ ...blows.pane, point: [5, 6 - 0.002, 7], normal: [0, 1, 0] }, { pose });
  const here = pane.body(3).impact(blows.pane);
  assert.ok(there.broke && Math.abs(there.report.contacts[0].impulse / here.report.contacts[0].impulse - 1) < 0.05);
}

function refusals() {
  const refused = (change, words) => assert.throws(() => pane.body(1).impact({ ...blows.pane, ...change }), words);
  refused({ speed: NaN }, /contacts\[0\]\.speed is NaN: give 0 or more, m\/s/);
  refused({ point: [0, 0] }, /contacts\[0\]\.point is \[0,0\]: give three finite numbers, m/);
  refused({ normal: undefined }, /normal is missing/);
  refused({ normal: [0, 0, 0] }, /normal|direction/);
  refused({ striker: { mass: 0 } }, /striker\.mass is 0/);
  refused({ striker: { mass: 1, material: 'cheese' } }, /cheese/);
  assert.throws(() => pane.body(-1), /the seed is -1/);
  assert.throws(() => pane.body(1).impact(blows.pane, { pose: { position: [0, 0, 0], rotation: [0, 0, 0, 2] } }), /rotation/);
  assert.throws(() => pane.body(1).impact([null]), /contacts\[0\] is not a contact/);
}

async function refusedFiles() {
  const bytes = new Uint8Array(await bodyFile('pane'));
  await assert.rejects(Breakable.load(bytes.slice(0, 1000)), /./);
  await assert.rejects(Breakable.load(new Uint8Array(0)), /./);
  const changed = bytes.slice();
  changed[9999] ^= 1;
  await assert.rejects(Breakable.load(changed), /damaged/);
  await assert.rejects(Breakable.load('file:///nowhere.frangible'), /could not be fetched/);
  await assert.rejects(Breakable.load(5), /the source of a baked body must be a URL/);
}

/** A box of concrete, and a mesh as three.js has them. */
async function baked() {
  const { BoxGeometry, TorusGeometry } = await import('three');
  const box = await breakable(new BoxGeometry(0.2, 0.1, 0.1).translate(1, 0, 0), { material: 'concrete', name: 'box' });
  assert.ok(Math.abs(box.volume / 0.002 - 1) < 0.02, `${box.volume} m³`);
  assert.ok(Math.abs(box.offset[0] + 1) < 1e-3 && box.name === 'box');
  // A wall along the same mesh, which is scaled about the middle of its box: the middle is the origin of the body's frame. Its f32 round its length by up to 1.2e-6.
  const shell = await bake(new BoxGeometry(0.2, 0.1, 0.1).translate(1, 0, 0), { size: 0.4, wall: 0.03, tetrahedra: 4000, modes: 10 });
  const middle = [1, 0, 0].map((x, axis) => shell.scale * x + shell.offset[axis]);
  assert.ok(Math.abs(shell.scale - 2) < 2e-6 && middle.every((x) => Math.abs(x) < 2e-3), `${shell.scale} ${middle}`);
  const hit = box.body(1).impact({ point: [0, 0.05, 0], normal: [0, -1, 0], speed: 30, striker: { mass: 1 } });
  assert.ok(hit.broke);
  closed(hit, box);
  await assert.rejects(bake({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0] }), /./);
  await assert.rejects(bake({}), /the mesh has no positions/);
  await assert.rejects(bake(new BoxGeometry(), { tetrahedra: NaN }), /tetrahedra is NaN/);
  await assert.rejects(bake(new BoxGeometry(), { material: 'cheese' }), /cheese/);
  // The surface of glass decides its strength.
  const panes = ['glass-abraded', 'glass', 'glass-new'].map((material) => breakable(new BoxGeometry(0.1, 0.1, 0.02), { material, modes: 10 }));
  const [abraded, handled, fresh] = (await Promise.all(panes)).map((pane) => pane.strength);
  assert.ok(abraded < handled && handled < fresh, `${abraded} ${handled} ${fresh} Pa`);
  const workshop = new Workshop();
  const stages = new Set();
  const begin = performance.now();
  const { bytes } = await workshop.bake(new TorusGeometry(0.04, 0.015), { material: 'porcelain', onProgress: (stage) => stages.add(stage) });
  assert.ok(stages.size > 3, [...stages].join());
  const torus = await workshop.load(bytes);
  await workshop.close();
  console.log(`npm: a ring baked in a worker of Node in ${((performance.now() - begin) / 1e3).toFixed(1)} s: ${(1e3 * torus.mass).toFixed(0)} g, ${(bytes.length / 1e3).toFixed(0)} kB`);
}

/** A tile whose colours are (x, y, z) over its sides, its second texture coordinates (2 y, z); the front is glazed. */
async function looks() {
  const { DoubleSide } = await import('three');
  const { materials, meshes } = await import('frangible/three');
  const tile = await Breakable.load(await bodyFile('tile'));
  assert.equal(tile.looks.name, 'painted tile');
  assert.deepEqual(tile.looks.materials.map(({ name }) => name), ['glaze', 'clay']);
  const [glaze] = tile.looks.materials;
  assert.deepEqual(glaze.emission, [0.5, 0.25, 0]);
  assert.ok(glaze.doubleSided && glaze.blending === 'mask' && glaze.alphaCutoff === 0.75);
  assert.deepEqual([glaze.textures[0].slot, glaze.textures[0].uvSet, ...glaze.textures[0].wrap], ['baseColor', 1, 'clamp', 'mirror']);
  const [image] = tile.looks.images;
  assert.deepEqual([image.name, image.type, image.bytes[1]], ['glaze.png', 'image/png', 0x50]);
  const sides = [0.1, 0.1, 0.006];
  const painted = ({ positions, colors, moreUvs, indices, outerIndices, groups }, centre) => {
    assert.equal(groups.reduce((sum, { count }) => sum + count, 0), outerIndices);
    for (const { start, count, material } of groups) {
      for (const v of indices.slice(start, start + count)) {
        const place = sides.map((side, k) => (positions[3 * v + k] + centre[k]) / side + 0.5);
        place.forEach((x, k) => assert.ok(Math.abs(colors[4 * v + k] - x) < 0.02));
        assert.ok(Math.abs(moreUvs[0][2 * v] - 2 * place[1]) < 0.04 && Math.abs(moreUvs[0][2 * v + 1] - place[2]) < 0.02);
        assert.ok(material === 1 || place[2] > 0.99, 'the glaze is the front');
      }
    }
    for (const v of indices.slice(outerIndices)) assert.deepEqual([...colors.slice(4 * v, 4 * v + 4)], [1, 1, 1, 1]);
  };
  painted(tile.geometry, [0, 0, 0]);
  const outcome = tile.body(3).impact({ point: [0, 0, 0.003], normal: [0, 0, -1], speed: 25, striker: ball });
  assert.ok(outcome.broke);
  for (const { geometry, centre } of outcome.fragments) painted(geometry, centre);
  const made = materials(tile);
  assert.ok(made[0].side === DoubleSide && made[0].vertexColors && made[0].map.channel === 1 && made[0].name === 'glaze');
  const [piece] = meshes(outcome, outcome.motions({}), made);
  assert.ok(piece.geometry.attributes.uv1 && piece.geometry.attributes.color.itemSize === 4);
  assert.equal(piece.material.length, 3);
  assert.equal(piece.geometry.groups.at(-1).materialIndex, 2);

  // A mesh that is baked here keeps them, too.
  const { BoxGeometry, BufferAttribute } = await import('three');
  const box = new BoxGeometry(0.2, 0.1, 0.1);
  const count = box.attributes.position.count;
  box.setAttribute('color', new BufferAttribute(Float32Array.from({ length: 3 * count }, (_, i) => (i % 3) / 2), 3));
  box.setAttribute('uv1', new BufferAttribute(Float32Array.from({ length: 2 * count }, (_, i) => i % 2), 2));
  const own = await breakable(box, { material: 'concrete' });
  assert.deepEqual(own.geometry.groups.map(({ material }) => material), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual([...own.geometry.colors.slice(0, 4)], [0, 0.5, 1, 1]);
  assert.deepEqual([...own.geometry.moreUvs[0].slice(0, 2)], [0, 1]);
  console.log(`npm: ${outcome.fragments.length} pieces of a tile keep colours, texture coordinates, materials and names`);
}

async function piecesBreakAgain() {
  const kind = await Breakable.load(await bodyFile('pane'), { again: true });
  const first = kind.body(3).impact(blows.pane);
  const { seconds, ...bits } = native.pane;
  assert.deepEqual(hashOf(first), bits, 'the second module breaks the pane as the first does');
  const begin = performance.now();
  const piece = first.body(0);
  const ready = performance.now() - begin;
  const soft = piece.impact({ ...blows.pane, speed: 0.001 });
  assert.ok(!soft.broke && soft.margin > 1);
  const second = piece.impact({ ...blows.pane, speed: 25 });
  assert.ok(second.broke);
  closed(second, first.fragments[0]);
  assert.equal(second.motions({}).fragments.length, second.fragments.length);
  assert.ok(second.body(0).impact({ ...blows.pane, speed: 0.001 }).margin > 1, 'and a piece of a piece is a body');
  const small = first.fragments.length - 1;
  assert.ok(first.body(small) === undefined || !first.body(small).impact({ ...blows.pane, speed: 0 }).broke);
  assert.throws(() => first.body(first.fragments.length), /there is no fragment/);
  assert.throws(() => pane.body(3).impact(blows.pane).body(0), /load it with \{ again: true \}/);
  console.log(`npm: a piece of the pane is a body again after ${ready.toFixed(0)} ms, and breaks into ${second.fragments.length}`);

  const workshop = new Workshop();
  const there = await workshop.load(await bodyFile('pane'), { again: true });
  const broken = await (await there.body(3)).impact(blows.pane);
  const again = await (await broken.body(0)).impact({ ...blows.pane, speed: 25 });
  assert.equal(again.fragments.length, second.fragments.length);
  await assert.rejects(broken.body(-1), /there is no fragment -1/);
  await workshop.close();
}

async function inAWorker() {
  const workshop = new Workshop();
  const kind = await workshop.load(await bodyFile('pane'));
  assert.equal(kind.mass, pane.mass);
  const bodies = await Promise.all([kind.body(3), kind.body(3)]);
  const [first, second] = await Promise.all(bodies.map((body) => body.impact(blows.pane)));
  const { seconds, ...bits } = native.pane;
  assert.deepEqual(hashOf(first), bits);
  assert.deepEqual(hashOf(second), bits);
  const after = await first.motions({ striker: { mass: 0.13, position: [0, 0, 0.02], linear: [0, 0, -12] } });
  assert.equal(after.fragments.length, first.fragments.length);
  await assert.rejects((await kind.body(1)).impact({ ...blows.pane, speed: -1 }), /speed is -1/);
  await assert.rejects(workshop.load(new Uint8Array(3)), /./);
  const waiting = (await kind.body(4)).impact(blows.pane);
  const closing = workshop.close();
  await assert.rejects(waiting, /closed/);
  await closing;
  await assert.rejects(workshop.load(new Uint8Array(3)), /closed/);
}
