// The session runs here, in a worker of the browser: a break takes as long as it takes, and the page goes on drawing.

import init from "./frangible-web-session.js";
import { bytes, fromPlanes, program } from "./fetch.js";

/** How long to wait for the next turn where nothing moves, ms. */
const REST = 8;

/** Whether the page has taken in what it was told last. */
let seen = true;
/** Files that the page was given, by their names. */
const given = new Map();
/** Promises of baked bodies, by the names of their files: each is fetched once, and again after a failure. */
const fetched = new Map();

function body(file, tell) {
  if (!fetched.has(file.name)) {
    const promise = bytes(file, tell).then(fromPlanes);
    promise.catch(() => fetched.delete(file.name));
    fetched.set(file.name, promise);
  }
  return fetched.get(file.name);
}

/** Baked bodies of one of the page's scenes: files, and which file is whose. */
async function bodies({ files, of }, tell) {
  const all = files.reduce((sum, { size }) => sum + size, 0);
  const have = files.map(() => 0);
  const note = (i) => (bytes) => {
    have[i] = bytes;
    tell(have.reduce((sum, bytes) => sum + bytes, 0) / all);
  };
  return [await Promise.all(files.map((file, i) => body(file, note(i)))), of];
}

/** Has another worker bake a scene's bodies, for as long as tell(what, share) returns true. */
function bake(module, scene, tell) {
  return new Promise((done, failed) => {
    const baker = new Worker(new URL("baker.js", import.meta.url), { type: "module" });
    const end = (then, what) => {
      baker.terminate();
      then(what);
    };
    baker.addEventListener("message", ({ data: { bodies, problem, what, share } }) => {
      if (bodies) end(done, bodies);
      else if (problem) end(failed, new Error(problem));
      else if (!tell(what, share)) end(failed, new Error("the bake was cancelled"));
    });
    baker.addEventListener("error", ({ message }) => end(failed, new Error(`the bake stopped: ${message ?? "it could not be started"}`)));
    baker.postMessage({ module, scene, given: [...given] });
  });
}

const tasks = {
  async start({ file, scenes, first, byClock }) {
    // Beside each other; what fails is asked for again, and told then.
    bodies(scenes[first].bodies, (share) => postMessage({ share: { body: share } })).catch(() => {});
    const module = await program(file, (bytes) => postMessage({ share: { session: bytes / file.size } }));
    globalThis.frangible = {
      scenes: Object.keys(scenes),
      scene: (name) => scenes[name]?.text,
      byClock,
      given: () => [...given],
      bodies: (name, tell) =>
        bodies(scenes[name].bodies, (share) => tell(`fetching ${name}`, share)).catch(({ message }) => {
          throw new Error(`the bodies of ${name} could not be fetched (${message}); choose the scene again`);
        }),
      bake: (scene, tell) => bake(module, scene, tell),
      save: (name, content) => postMessage({ save: { name, content } }),
      hear: (samples, rate) => postMessage({ hear: { samples, rate } }),
      failed: (why) => postMessage({ failed: why }),
    };
    await init({ module_or_path: module });
    turn();
  },
  line: (text) => globalThis.frangible_take(text),
  file: ({ name, content }) => given.set(name, content),
  seen: () => (seen = true),
};

/** Lets the session go on, tells what there is to see, and comes again. */
function turn() {
  globalThis.frangible_turn();
  const news = seen ? globalThis.frangible_news() : undefined;
  if (news) {
    seen = false;
    postMessage({ news }, [news.buffer]);
  }
  setTimeout(turn, news || !seen ? 0 : REST);
}

/** Commands come one after another, but none before the program runs. */
let ready = Promise.resolve();
addEventListener("message", ({ data }) => {
  for (const [what, value] of Object.entries(data)) ready = ready.then(() => tasks[what](value));
  ready.catch(({ message }) => postMessage({ failed: message }));
});
