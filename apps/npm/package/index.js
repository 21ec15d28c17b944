// Physically based brittle fracture. index.d.ts documents the interface.
import { baking, breaking, made } from './modules.js';

/** Loads the module in advance; `Breakable.load` also loads it. */
export const ready = (module) => breaking(module).then(() => undefined);

/** A kind of body: a baked shape and material. */
export class Breakable {
  #kind;
  #inside;

  constructor(kind, inside) {
    this.#kind = kind;
    this.#inside = inside;
    Object.assign(this, kind.about());
  }

  static async load(source, { module, again = false } = {}) {
    const bytes = await bytesOf(source);
    const inside = await (again ? baking : breaking)(module);
    return new Breakable(made(() => new inside.Kind(bytes)), inside);
  }

  body(seed = 1) {
    if (!Number.isInteger(seed) || seed < 0 || seed > 0xffffffff) {
      throw new RangeError(`the seed is ${seed}: give a whole number from 0 to 4294967295`);
    }
    return new Body(this, this.#kind.body(seed), this.#inside);
  }

  free() {
    this.#kind.free();
  }
}

/** One body, with weak points of its own, or a piece of one. */
export class Body {
  #body;
  #inside;

  constructor(kind, body, inside) {
    this.kind = kind;
    this.#body = body;
    this.#inside = inside;
  }

  impact(contacts, { pose } = {}) {
    const list = Array.isArray(contacts) ? contacts : [contacts];
    const rows = Float64Array.from(list.flatMap((contact, index) => rowOf(contact, index, this.#inside)));
    const found = made(() => this.#body.impact(rows, poseOf(pose)));
    const outcome = found.outcome();
    if (!outcome.broke) {
      found.free();
      return outcome;
    }
    // The arrays may be on their way to another thread by then.
    const centres = outcome.fragments.map(({ centre }) => [...centre]);
    outcome.motions = (motion) => motionsOf(found, centres, motion);
    outcome.body = (number) => this.#piece(found, centres.length, number);
    return outcome;
  }

  #piece(found, count, number) {
    if (!Number.isInteger(number) || number < 0 || number >= count) throw new RangeError(`there is no fragment ${number}: give a whole number below ${count}`);
    const { piece } = this.#inside;
    if (!piece) throw new Error('pieces of this body cannot break again: load it with { again: true }');
    const body = made(() => piece(found, number));
    return body && new Body(this.kind, body, this.#inside);
  }

  free() {
    this.#body.free();
  }
}

async function bytesOf(source) {
  if (source instanceof Uint8Array) return source;
  if (source instanceof ArrayBuffer) return new Uint8Array(source);
  if (typeof source === 'string' || source instanceof URL) {
    const answer = await fetch(source).catch((error) => {
      throw new Error(`${source} could not be fetched: ${error.message}`, { cause: error });
    });
    if (!answer.ok) throw new Error(`${source} could not be fetched: ${answer.status} ${answer.statusText}`);
    return new Uint8Array(await answer.arrayBuffer());
  }
  if (source instanceof Response) return new Uint8Array(await source.arrayBuffer());
  throw new TypeError('the source of a baked body must be a URL, a Uint8Array, an ArrayBuffer or a Response');
}

const STEEL = 'steel';
const strikers = new Map();

/** One row of numbers for the module, of a contact. */
function rowOf(contact, index, inside) {
  const at = `contacts[${index}]`;
  if (contact === null || typeof contact !== 'object') throw new TypeError(`${at} is not a contact: give { point, normal, speed, striker }`);
  const point = triple(contact.point, `${at}.point`, 'm');
  if (contact.impulse !== undefined) {
    const impulse = triple(contact.impulse, `${at}.impulse`, 'N·s');
    const duration = number(contact.duration, `${at}.duration`, 's', (x) => x > 0 && x < Infinity, 'a number above 0');
    return [...point, ...impulse, 0, 0, Infinity, Infinity, Infinity, 0, ...impulse, duration];
  }
  const normal = triple(contact.normal, `${at}.normal`, 'the direction of the push on the body');
  const speed = number(contact.speed, `${at}.speed`, 'm/s', (x) => x >= 0 && x < Infinity, '0 or more');
  const { material: name = STEEL, mass = Infinity, radius, restitution } = contact.striker ?? {};
  number(mass, `${at}.striker.mass`, 'kg', (x) => x > 0, 'a number above 0, or Infinity for an immovable striker');
  const [modulus, pressure, usual] = known(name, inside);
  const round = radius ?? (mass < Infinity ? made(() => inside.ball(name, mass)) : Infinity);
  number(round, `${at}.striker.radius`, 'm', (x) => x > 0, 'a number above 0, or Infinity for a flat striker');
  const bounce = number(restitution ?? usual, `${at}.striker.restitution`, '', (x) => x >= 0 && x <= 1, 'a number from 0 to 1');
  return [...point, ...normal, speed, 1 / mass, round, modulus, pressure, bounce, 0, 0, 0, 0];
}

function known(name, inside) {
  if (!strikers.has(name)) strikers.set(name, made(() => inside.material(String(name))));
  return strikers.get(name);
}

function number(x, name, unit, fits, wanted) {
  if (typeof x !== 'number' || !fits(x)) throw new RangeError(`${name} is ${x}: give ${wanted}${unit && `, ${unit}`}`);
  return x;
}

/** Three finite numbers: an array, or an object with x, y and z. */
function triple(v, name, unit) {
  const numbers = v && 'x' in Object(v) ? [v.x, v.y, v.z] : [...(v?.[Symbol.iterator] ? v : [])];
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new RangeError(`${name} is ${v === undefined ? 'missing' : JSON.stringify(v)}: give three finite numbers, ${unit}`);
  }
  return numbers;
}

function quaternion(q, name) {
  const numbers = q && 'w' in Object(q) ? [q.x, q.y, q.z, q.w] : [...(q?.[Symbol.iterator] ? q : [])];
  if (numbers.length !== 4 || Math.abs(Math.hypot(...numbers) - 1) > 1e-3 || numbers.some(Number.isNaN)) {
    throw new RangeError(`${name} is ${JSON.stringify(q)}: give a quaternion x, y, z, w of length 1`);
  }
  return numbers;
}

function poseOf(pose) {
  if (pose === undefined) return new Float64Array();
  return Float64Array.from([...triple(pose.position, 'pose.position', 'm'), ...quaternion(pose.rotation, 'pose.rotation')]);
}

const REST = [0, 0, 0];

function motionsOf(found, centres, { pose, linear = REST, angular = REST, striker } = {}) {
  const place = pose ? poseOf(pose) : Float64Array.of(0, 0, 0, 0, 0, 0, 1);
  const motion = [...triple(linear, 'linear', 'm/s'), ...triple(angular, 'angular', 'rad/s')];
  const rows = found.motions(place, Float64Array.from(motion), Float64Array.from(strikerRow(striker)));
  const at = (i) => ({ linear: [...rows.slice(6 * i, 6 * i + 3)], angular: [...rows.slice(6 * i + 3, 6 * i + 6)] });
  const fragments = centres.map((centre, i) => ({
    position: placed(place, centre),
    rotation: [...place.slice(3)],
    ...at(i),
  }));
  return { fragments, striker: striker ? at(fragments.length) : undefined };
}

/** Row of numbers of the striker. Without a given inertia it is a ball, which affects the energy of the break only little. */
function strikerRow(striker) {
  if (!striker) return [];
  const mass = number(striker.mass, 'striker.mass', 'kg', (x) => x > 0 && x < Infinity, 'a number above 0; omit an immovable striker');
  const i = 0.4 * mass * number(striker.radius ?? 0.05, 'striker.radius', 'm', (x) => x > 0 && x < Infinity, 'a number above 0') ** 2;
  const inertia = striker.inertia ? [...striker.inertia] : [i, 0, 0, 0, i, 0, 0, 0, i];
  if (inertia.length !== 9 || !inertia.every(Number.isFinite)) throw new RangeError('striker.inertia: give nine numbers, column by column, kg·m², world axes');
  return [
    mass,
    ...triple(striker.position, 'striker.position', 'm'),
    ...inertia,
    ...triple(striker.linear ?? REST, 'striker.linear', 'm/s'),
    ...triple(striker.angular ?? REST, 'striker.angular', 'rad/s'),
  ];
}

/** A place in the body's frame, in the world. */
function placed([x, y, z, qx, qy, qz, qw], [a, b, c]) {
  const u = [qy * c - qz * b + qw * a, qz * a - qx * c + qw * b, qx * b - qy * a + qw * c];
  return [
    x + a + 2 * (qy * u[2] - qz * u[1]),
    y + b + 2 * (qz * u[0] - qx * u[2]),
    z + c + 2 * (qx * u[1] - qy * u[0]),
  ];
}
