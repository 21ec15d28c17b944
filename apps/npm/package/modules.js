// The two WebAssembly modules. The first breaks bodies; the second does so too, bakes them, and makes their pieces break again.
import * as first from './frangible_js.js';

/** A function that loads a module once, and tries again after it failed. It gives what the module can do. */
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
      throw new Error(`the module of frangible could not be loaded: ${error.message}`, { cause: error });
    });
    return loading;
  };
}

/** What a module is made of: bytes or a module at hand, or where it is fetched from. */
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

/** What the modules throw are strings or errors without a stack of the caller's. */
export function made(make) {
  try {
    return make();
  } catch (error) {
    throw error instanceof WebAssembly.RuntimeError
      ? new Error('frangible failed inside; load the page anew and report what you did', { cause: error })
      : new Error(error.message ?? String(error), { cause: error });
  }
}
