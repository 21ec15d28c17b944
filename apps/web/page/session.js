// The session runs here, in a worker of the browser: a break takes as long as it takes, and the page goes on drawing.

import init from "./frangible-web.js";

/** How long to wait for the next turn where nothing moves, ms. */
const REST = 8;

/** Who waits for bodies, by the number of the question. */
const waiting = new Map();
let questions = 0;
/** Whether the page has taken in what it was told last. */
let seen = true;

const tasks = {
  async start({ module, scenes, byClock }) {
    globalThis.frangible = {
      scenes: Object.keys(scenes),
      scene: (name) => scenes[name]?.text,
      byClock,
      bodies: (scene, tell) =>
        new Promise((done, failed) => {
          questions += 1;
          waiting.set(questions, { tell, done, failed });
          postMessage({ bodies: { scene, number: questions } });
        }),
      save: (name, content) => postMessage({ save: { name, content } }),
      hear: (samples, rate) => postMessage({ hear: { samples, rate } }),
      failed: (why) => postMessage({ failed: why }),
    };
    await init({ module_or_path: module });
    turn();
  },
  line: (text) => globalThis.frangible_take(text),
  seen: () => (seen = true),
  share: ({ number, share }) => waiting.get(number)?.tell(share),
  fetched({ number, bodies, problem }) {
    const { done, failed } = waiting.get(number);
    waiting.delete(number);
    if (problem) failed(new Error(problem));
    else done(bodies);
  },
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
