// Breaks and bakes bodies in a worker without blocking the page: the interface of index.js with promises. worker.d.ts documents it.

import { arraysOf } from './arrays.js';

/** A worker that holds bodies and breaks them. */
export class Workshop {
  #worker;
  #waiting = new Map();
  #next = 0;
  #ended;

  constructor() {
    this.#begin();
  }

  async #begin() {
    this.#worker = open(new URL('./worker-inside.js', import.meta.url));
    const worker = await this.#worker;
    worker.heard((answer) => this.#hear(answer));
    worker.died((reason) => this.#end(`the worker died: ${reason}; make a new Workshop`));
  }

  #hear({ id, stage, share, result, error }) {
    const waiting = this.#waiting.get(id);
    if (stage !== undefined) return waiting?.tell?.(stage, share);
    this.#waiting.delete(id);
    if (error === undefined) waiting?.resolve(result);
    else waiting?.reject(Object.assign(new Error(error.message), { name: error.name }));
  }

  #end(reason) {
    this.#ended ??= reason;
    for (const { reject } of this.#waiting.values()) reject(new Error(this.#ended));
    this.#waiting.clear();
  }

  async #ask(what, values, tell) {
    const worker = await this.#worker;
    if (this.#ended) throw new Error(this.#ended);
    const id = (this.#next += 1);
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, tell });
      try {
        worker.post({ id, what, values });
      } catch (error) {
        this.#waiting.delete(id);
        reject(error);
      }
    });
  }

  /** Bakes a mesh in the worker, like `bake` of bake.js. */
  async bake(mesh, { onProgress, module, ...options } = {}) {
    return this.#ask('bake', [arraysOf(mesh), options, module === undefined ? undefined : String(module)], onProgress);
  }

  /** Reads a baked body in the worker, from a URL or bytes. */
  async load(source, { module, again } = {}) {
    const address = typeof source === 'string' || source instanceof URL;
    const from = address ? String(new URL(source, globalThis.location?.href)) : source;
    const options = { module: module === undefined ? undefined : String(module), again };
    const { number, about } = await this.#ask('load', [from, options]);
    const body = async (seed = 1) => this.#body(await this.#ask('body', [number, seed]));
    return { ...about, body, free: () => this.#ask('free', [number]) };
  }

  #body(number) {
    return {
      impact: (contacts, options) => this.#impact(number, contacts, options),
      free: () => this.#ask('free', [number]),
    };
  }

  async #impact(body, contacts, options) {
    const { number, ...outcome } = await this.#ask('impact', [body, contacts, options]);
    if (number === undefined) return outcome;
    outcome.motions = (before) => this.#ask('motions', [number, before]);
    outcome.body = async (fragment) => {
      const piece = await this.#ask('piece', [number, fragment]);
      return piece === undefined ? undefined : this.#body(piece);
    };
    return outcome;
  }

  /** Ends the worker and rejects pending calls. */
  async close() {
    const worker = await this.#worker;
    this.#end('the Workshop was closed');
    worker.stop();
  }
}

/** Opens a worker in the browser or in Node, with the same four functions for both. */
async function open(address) {
  if (globalThis.Worker) {
    const worker = new Worker(address, { type: 'module' });
    return {
      post: (message) => worker.postMessage(message),
      heard: (hear) => worker.addEventListener('message', (event) => hear(event.data)),
      died: (tell) => worker.addEventListener('error', (event) => tell(event.message ?? 'its script could not be loaded')),
      stop: () => worker.terminate(),
    };
  }
  const { Worker: Thread } = await import('node:worker_threads');
  const worker = new Thread(address);
  return {
    post: (message) => worker.postMessage(message),
    heard: (hear) => worker.on('message', hear),
    died: (tell) => worker.on('error', (error) => tell(error.message)).on('exit', (code) => tell(`it ended with ${code}`)),
    stop: () => worker.terminate(),
  };
}
