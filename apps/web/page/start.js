// Has a worker fetch the session's program and the first scene's bodies, fetches the window's program beside it, finds out what the browser
// draws with, and starts.
//
// In the address: ?scene=NAME; ?renderer=webgl2 leaves WebGPU out; ?clock=stands runs scenes by commands only; #do=COMMANDS, with a semicolon
// between two, does again what was done where the link was made.

import { program } from "./fetch.js";

// The window draws one pixel for each pixel of the page's layout, but lays its panels out and reads pointers as if it drew as many as the screen
// has: on a telephone they were twice as large and a touch missed. So it is told that the two are the same.
window.devicePixelRatio = 1;

// The picture is turned and thrown at with a mouse: the first finger is one, with its left button down as long as it touches.
const stage = document.getElementById("stage");
const asMouse = ({ clientX, clientY }) => ({ clientX, clientY, pointerType: "mouse", button: 0 });
for (const [touched, told] of [["pointerdown", ["pointermove", "pointerdown"]], ["pointerup", ["pointerup"]], ["pointercancel", ["pointerup"]]]) {
  stage.addEventListener(touched, (event) => {
    if (event.pointerType !== "touch" || !event.isPrimary) return;
    for (const name of told) stage.dispatchEvent(new PointerEvent(name, asMouse(event)));
  });
}
for (const name of ["touchstart", "touchmove", "touchend", "touchcancel"]) {
  stage.addEventListener(name, (event) => {
    event.preventDefault();
    event.stopImmediatePropagation();
  }, { passive: false });
}

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
  if (problem) throw new Error(`the link cannot be replayed: ${problem}`);
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

/** Says something on the button of links, for a while. */
function answer(words) {
  link.textContent = words;
  setTimeout(() => (link.textContent = "Copy link"), 3000);
}

/** Puts what was done into the address, and into the clipboard where the browser lets the page. */
async function share(script) {
  const lines = script.split("\n").filter((line) => line && !line.startsWith("#"));
  if (lines.some((line) => line.startsWith("open "))) return answer("Files cannot be shared by link");
  const at = new URL(location.href);
  const scene = lines.find((line) => line.startsWith("scene "));
  if (scene) at.searchParams.set("scene", scene.slice(6));
  at.hash = String(new URLSearchParams({ do: lines.join(";") }));
  history.replaceState(null, "", at);
  const copied = await navigator.clipboard?.writeText(at.href).then(() => true, () => false);
  answer(copied ? "Copied" : "See the address bar");
}

/** Says what went wrong first: what follows from it says less. */
function failed(why) {
  if (cover.classList.contains("failed")) return;
  cover.hidden = false;
  cover.style.display = "";
  cover.classList.add("failed");
  text.textContent = why;
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

/** Files that belong to others and cannot be opened by themselves. */
const BESIDE = /\.(mtl|bin|ele|face|png|jpe?g)$/i;

/** Gives the session files, and has it open the one that the others belong to. */
async function openFiles(session, files) {
  if (files.length === 0) return;
  const names = [];
  for (const file of files) {
    // A command is a line.
    const name = file.name.replace(/\s+/g, " ").trim();
    const content = new Uint8Array(await file.arrayBuffer());
    session.postMessage({ file: { name, content } }, [content.buffer]);
    names.push(name);
  }
  const main = names.find((name) => /\.toml$/i.test(name)) ?? names.find((name) => !BESIDE.test(name)) ?? names[0];
  window.frangible_command(`open ${main}`);
}

/** Files come by the button, or are dropped onto the page. */
function takeFiles(session) {
  const chosen = document.getElementById("files");
  const button = document.getElementById("open");
  button.addEventListener("click", () => chosen.click());
  chosen.addEventListener("change", async () => {
    await openFiles(session, [...chosen.files]);
    // So that the same file can be chosen again.
    chosen.value = "";
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    openFiles(session, [...event.dataTransfer.files]);
  });
  button.hidden = false;
}

async function start() {
  const { programs, first: usual, scenes } = await (await fetch("scenes.json")).json();
  const wanted = wishes.get("scene");
  const first = wanted in scenes ? wanted : usual;
  const byClock = wishes.get("clock") !== "stands";

  const sizes = { window: programs.window.size, session: programs.session.size, body: 0 };
  sizes.body = scenes[first].bodies.files.reduce((sum, { size }) => sum + size, 0);
  const shares = { window: 0, session: 0, body: 0 };
  const tell = (news) => {
    Object.assign(shares, news);
    const have = Object.keys(sizes).reduce((sum, part) => sum + sizes[part] * shares[part], 0);
    bar.value = have / (sizes.window + sizes.session + sizes.body);
  };

  const session = new Worker("session.js", { type: "module" });
  const told = [];
  const save = ({ name, content }) => {
    if (name === LINK) return share(new TextDecoder().decode(content));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([content]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  };
  const answers = {
    news: (bytes) => told.push(bytes),
    hear: ({ samples, rate }) => hear(samples, rate),
    share: tell,
    save,
    failed,
  };
  session.addEventListener("message", ({ data }) => Object.entries(data).forEach(([what, value]) => answers[what](value)));
  session.addEventListener("error", ({ message }) => failed(`The simulation has stopped: ${message ?? "it could not be started"}. Reload the page.`));
  session.postMessage({ start: { file: programs.session, scenes, first, byClock } });

  const [module, drawn, { default: init }] = await Promise.all([
    program(programs.window, (bytes) => tell({ window: bytes / sizes.window })),
    renderer(),
    import("./frangible-web.js"),
  ]);
  times.fetched = performance.now();
  if (!drawn.kind) {
    failed("This browser supports neither WebGPU nor WebGL 2, one of which the viewer needs. Turn on hardware acceleration, or use a newer browser.");
    return;
  }
  document.documentElement.dataset.renderer = drawn.kind;
  text.textContent = "starting";
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
      stage.focus();
      link.hidden = false;
      takeFiles(session);
      const commands = new URLSearchParams(location.hash.slice(1)).get("do")?.split(";") ?? [];
      if (commands.length) follow(commands).catch(({ message }) => failed(message)).finally(() => (times.followed = performance.now()));
    },
  };
  await init({ module_or_path: module });
  times.started = performance.now();
}

window.addEventListener("unhandledrejection", (event) => failed(`The viewer could not start: ${event.reason?.message ?? event.reason}`));
start();
