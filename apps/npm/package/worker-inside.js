// The script of the worker that worker.js opens.
import { Breakable } from './index.js';

const things = new Map();
let next = 0;

const keep = (thing) => {
  next += 1;
  things.set(next, thing);
  return next;
};

/** The calls that the worker answers; the first argument is the number of the call. */
const tasks = {
  async load(_, source, options) {
    const kind = await Breakable.load(source, options);
    return { number: keep(kind), about: { ...kind } };
  },
  async bake(id, arrays, options, module) {
    const { bake } = await import('./bake.js');
    const onProgress = (stage, share) => port.postMessage({ id, stage, share });
    return bake(arrays, { ...options, module, onProgress });
  },
  body: (_, kind, seed) => keep(things.get(kind).body(seed)),
  impact(_, body, contacts, options) {
    const { motions, body: piece, ...outcome } = things.get(body).impact(contacts, options);
    return motions ? { ...outcome, number: keep({ motions, piece }) } : outcome;
  },
  motions: (_, number, before) => things.get(number).motions(before),
  piece(_, number, fragment) {
    const body = things.get(number).piece(fragment);
    return body && keep(body);
  },
  free(_, number) {
    things.get(number)?.free?.();
    things.delete(number);
  },
};

const port = globalThis.postMessage ? globalThis : (await import('node:worker_threads')).parentPort;

async function answer({ id, what, values }) {
  try {
    const result = await tasks[what](id, ...values);
    port.postMessage({ id, result }, buffers(result));
  } catch ({ name, message }) {
    port.postMessage({ id, error: { name, message } });
  }
}

/** The buffers of fragment arrays, which are transferred instead of copied. */
function buffers({ fragments = [] } = {}) {
  const views = fragments.filter(({ hulls }) => hulls).flatMap(({ centre, inertia, hulls, geometry, solid }) => [
    centre, inertia, ...hulls, ...geometry.moreUvs, ...Object.values(geometry), ...Object.values(solid),
  ]);
  return [...new Set(views.filter(ArrayBuffer.isView).map(({ buffer }) => buffer))];
}

if (port === globalThis) addEventListener('message', (event) => answer(event.data));
else port.on('message', answer);
