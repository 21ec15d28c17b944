// Bodies are baked here, in a worker of their own: the session goes on meanwhile, and ends the worker to give the bake up.

import init from "./frangible-web-session.js";

addEventListener("message", async ({ data: { module, scene, given } }) => {
  const failed = (problem) => postMessage({ problem });
  globalThis.frangible = { bakes: true, failed };
  try {
    await init({ module_or_path: module });
    const bodies = globalThis.frangible_bake(scene, given, (what, share) => postMessage({ what, share }));
    postMessage({ bodies });
  } catch (error) {
    failed(error.message ?? String(error));
  }
});
