// Fetches the program and the first scene's bodies, finds out what the browser draws with, and starts.
//
// In the address: ?scene=NAME; ?renderer=webgl2 leaves WebGPU out; ?clock=stands runs scenes by commands only; #do=COMMANDS, with a semicolon
// between two, does again what was done where the link was made.

const wishes = new URLSearchParams(location.search);
const cover = document.getElementById("cover");
const bar = document.getElementById("bar");
const text = document.getElementById("text");
const times = { begun: performance.now() };
const link = document.getElementById("link");

/** What the script is saved as that a link is made of. */
const LINK = "link.txt";
link.addEventListener("click", () => window.frangible_command(`save script ${LINK}`));

/** Commands that a link may not give: they write files, or ask for some. */
const NOT_IN_LINKS = /^(open|save|screenshot|quit|cancel-)/;

/** Carries out a command and waits until all that it began is done. */
async function carryOut(line) {
  const problem = window.frangible_command(line);
  if (problem) throw new Error(`the link cannot be followed: ${problem}`);
  do await new Promise((next) => requestAnimationFrame(next));
  while (!JSON.parse(window.frangible_state()).done);
}

/** Does what the address says; the clock stands meanwhile. */
async function follow(commands) {
  await carryOut("pause");
  await carryOut("reset");
  for (const line of commands) if (!/^(scene |run$|pause$)/.test(line) && !NOT_IN_LINKS.test(line)) await carryOut(line);
  const last = commands.findLast((line) => line === "run" || line === "pause");
  if (last !== "pause" && wishes.get("clock") !== "stands") await carryOut("run");
}

/** Puts what was done into the address, and into the clipboard where the browser lets the page. */
async function share(script) {
  const lines = script.split("\n").filter((line) => line && !line.startsWith("#"));
  const at = new URL(location.href);
  const scene = lines.find((line) => line.startsWith("scene "));
  if (scene) at.searchParams.set("scene", scene.slice(6));
  at.hash = String(new URLSearchParams({ do: lines.join(";") }));
  history.replaceState(null, "", at);
  const copied = await navigator.clipboard?.writeText(at.href).then(() => true, () => false);
  link.textContent = copied ? "Copied" : "It is in the address";
  setTimeout(() => (link.textContent = "Copy link"), 2000);
}

/** Says what went wrong first: what follows from it says less. */
function failed(why) {
  if (cover.classList.contains("failed")) return;
  cover.hidden = false;
  cover.style.display = "";
  cover.classList.add("failed");
  text.textContent = why;
}

/** The bytes of a file of this folder, unpacked; tell(share) meanwhile. */
async function bytes(name, size, tell) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: the server says ${answer.status}`);
  const parts = [];
  let have = 0;
  const reader = answer.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    have += value.length;
    tell(Math.min(have / size, 1));
  }
  const packed = new Blob(parts);
  // Some servers unpack by themselves what ends in .gz.
  const [a, b] = new Uint8Array(await packed.slice(0, 2).arrayBuffer());
  if (a !== 0x1f || b !== 0x8b) return new Uint8Array(await packed.arrayBuffer());
  const unpacked = packed.stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

/** What draws: "webgpu", "webgl2" or null, and whether it is a program that draws with the processor. */
async function renderer() {
  const adapter = wishes.get("renderer") === "webgl2" ? null : await navigator.gpu?.requestAdapter().catch(() => null);
  if (adapter) {
    const info = adapter.info ?? {};
    return { kind: "webgpu", software: info.isFallbackAdapter === true || info.architecture === "swiftshader" };
  }
  // The program would prefer a WebGPU that then gives no adapter.
  Object.defineProperty(navigator, "gpu", { value: undefined, configurable: true });
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return { kind: null, software: false };
  const named = context.getExtension("WEBGL_debug_renderer_info");
  const name = named ? context.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return { kind: "webgl2", software: /swiftshader|llvmpipe|software/i.test(name) };
}

/** The loudspeaker. Browsers are silent until somebody touches the page, and so there is none before. */
let speaker = null;
/** Until when what was heard so far plays, s by the loudspeaker's clock. */
let heard = 0;
for (const touch of ["pointerdown", "touchend", "keydown"]) {
  addEventListener(touch, () => (speaker ??= new AudioContext()).resume(), { capture: true });
}

/** Plays samples, left and right in turn, after those before them. */
function hear(samples, rate) {
  if (speaker?.state !== "running") return;
  const frames = samples.length / 2;
  const buffer = speaker.createBuffer(2, frames, rate);
  for (const side of [0, 1]) {
    const channel = buffer.getChannelData(side);
    for (let i = 0; i < frames; i++) channel[i] = samples[2 * i + side];
  }
  const source = speaker.createBufferSource();
  source.buffer = buffer;
  source.connect(speaker.destination);
  // The next samples come with the next picture.
  if (heard < speaker.currentTime) heard = speaker.currentTime + 0.03;
  source.start(heard);
  heard += frames / rate;
}

async function start() {
  const { program, programBytes, first: usual, scenes } = await (await fetch("scenes.json")).json();
  const wanted = wishes.get("scene");
  const first = wanted in scenes ? wanted : usual;
  const fetched = new Map();
  // Each file once, whoever asks, and again after a failure.
  const file = ({ name, size }, tell) => {
    if (!fetched.has(name)) {
      const promise = bytes(name, size, tell);
      promise.catch(() => fetched.delete(name));
      fetched.set(name, promise);
    }
    return fetched.get(name);
  };
  const bodies = (scene, tell) => Promise.all(scenes[scene].bodies.map((body) => file(body, tell)));

  const shares = [0, 0];
  const tell = (which) => (share) => {
    shares[which] = share;
    bar.value = 0.8 * shares[0] + 0.2 * shares[1];
  };
  const [wasm, drawn, { default: init }] = await Promise.all([
    bytes(program, programBytes, tell(0)),
    renderer(),
    import("./frangible-web.js"),
    bodies(first, tell(1)),
  ]);
  times.fetched = performance.now();
  if (!drawn.kind) {
    failed("This browser gives neither WebGPU nor WebGL 2, which the viewer draws with. Switch hardware acceleration on, or take a newer browser.");
    return;
  }
  document.documentElement.dataset.renderer = drawn.kind;
  text.textContent = "starting";
  const module = await WebAssembly.compile(wasm);
  const byClock = wishes.get("clock") !== "stands";
  const save = ({ name, content }) => {
    if (name === LINK) return share(new TextDecoder().decode(content));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([content]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  };

  const session = new Worker("session.js", { type: "module" });
  const told = [];
  const answers = {
    news: (bytes) => told.push(bytes),
    hear: ({ samples, rate }) => hear(samples, rate),
    save,
    failed,
    bodies: ({ scene, number }) =>
      bodies(scene, (share) => session.postMessage({ share: { number, share } })).then(
        (arrays) => session.postMessage({ fetched: { number, bodies: arrays } }),
        ({ message }) => session.postMessage({ fetched: { number, problem: message } }),
      ),
  };
  session.addEventListener("message", ({ data }) => Object.entries(data).forEach(([what, value]) => answers[what](value)));
  session.addEventListener("error", ({ message }) => failed(`The session has ended: ${message ?? "it could not be started"}. Reload the page.`));
  session.postMessage({ start: { module, scenes, byClock } });
  window.frangible = {
    scenes: Object.keys(scenes),
    first,
    smooth: !drawn.software,
    byClock,
    canvas: "stage",
    failed,
    times,
    give: (line) => session.postMessage({ line }),
    news() {
      if (told.length) session.postMessage({ seen: true });
      return told.splice(0);
    },
    drawn() {
      if (times.picture) return;
      const { whole, pieces } = JSON.parse(window.frangible_state());
      if (whole + pieces === 0) return;
      times.picture = performance.now();
      cover.style.display = "none";
      document.getElementById("stage").focus();
      link.hidden = false;
      const commands = new URLSearchParams(location.hash.slice(1)).get("do")?.split(";") ?? [];
      if (commands.length) follow(commands).catch(({ message }) => failed(message)).finally(() => (times.followed = performance.now()));
    },
  };
  await init({ module_or_path: module });
  times.started = performance.now();
}

window.addEventListener("unhandledrejection", (event) => failed(`The viewer could not start: ${event.reason?.message ?? event.reason}`));
start();
