// The two WebAssembly modules. The first breaks bodies; the second also bakes them and lets pieces break again.
import * as first from './frangible_js.js';

/** Returns a function that loads a module once, retries after a failure, and returns its exports. */
function loader(usual, glue) {
  let loading;
  const begin = async (given) => {
    const inside = await glue();
    const found = await moduleOf(usual, given);
    await ('bytes' in found ? inside.initSync({ module: found.bytes }) : inside.default({ module_or_path: found.at }));
    return inside;
  };
  return (given) => {
    loading ??= begin(given).catch((error) => {
      loading = undefined;
      throw new Error(`the WebAssembly module of frangible could not be loaded: ${error.message}`, { cause: error });
    });
    return loading;
  };
}

/** Returns the source of a module: bytes, a compiled module, or a URL. */
async function moduleOf(usual, given) {
  if (given instanceof WebAssembly.Module) return { bytes: given };
  if (given === undefined && usual.protocol === 'file:' && globalThis.process?.versions?.node) {
    const { readFile } = await import('node:fs/promises');
    return { bytes: await readFile(usual) };
  }
  return { at: given ?? usual };
}

export const breaking = loader(new URL('./frangible_js_bg.wasm', import.meta.url), () => first);
export const baking = loader(new URL('./frangible_js_bake_bg.wasm', import.meta.url), () => import('./frangible_js_bake.js'));

/** Rethrows errors of the modules with the caller's stack; the modules throw strings, or errors without it. */
export function made(make) {
  try {
    return make();
  } catch (error) {
    throw error instanceof WebAssembly.RuntimeError
      ? new Error('frangible failed with an internal error; reload the page, and please report this as a bug', { cause: error })
      : new Error(error.message ?? String(error), { cause: error });
  }
}
