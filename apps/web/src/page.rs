//! The page: commands in, state of the session out.

use std::cell::RefCell;
use std::pin::Pin;
use std::rc::Rc;
use std::sync::Arc;

use frangible_draw::open_canvas;
use frangible_view::{Command, Page, PageOptions, Remote, Shown, ViewError, run_in_page};
use js_sys::{Array, Function, Promise, Reflect, Uint8Array};
use serde::Serialize;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};

use frangible_web::{Bridge, offer};

/// State that the page and the window share.
#[derive(Default)]
struct Shared {
    commands: Vec<Command>,
    shown: Arc<Shown>,
    done: bool,
    frames: u64,
}

struct Around {
    bridge: Bridge,
    shared: Rc<RefCell<Shared>>,
}

/// The session, in a worker of the browser.
struct Elsewhere(Bridge);

impl Remote for Elsewhere {
    fn give(&mut self, line: String) {
        // The page says so where its worker has failed.
        let _ = self.0.call("give", &[line.into()]);
    }

    fn news(&mut self) -> Vec<Vec<u8>> {
        let told = self.0.call("news", &[]).unwrap_or_default();
        let bytes = Array::from(&told).to_vec().into_iter();
        bytes.map(|b| Uint8Array::new(&b).to_vec()).collect()
    }
}

/// Opens the window in the page, and gives the page `frangible_command(text)` and `frangible_state()`.
pub(crate) fn start(bridge: Bridge) {
    let shared = Rc::new(RefCell::new(Shared::default()));
    give_functions(&shared);
    let scenes = bridge.names("scenes");
    let first = bridge.text("first").or_else(|| scenes.first().cloned());
    let options = PageOptions {
        first: Command::Scene(first.unwrap_or_default()),
        scenes,
        by_clock: bridge.get("byClock").is_truthy(),
        session: Box::new(Elsewhere(bridge.clone())),
        page: Box::new(Around {
            bridge: bridge.clone(),
            shared,
        }),
    };
    spawn_local(async move {
        if let Err(error) = live(&bridge, options).await {
            let _ = bridge.call("failed", &[error.to_string().into()]);
        }
    });
}

async fn live(bridge: &Bridge, options: PageOptions) -> Result<(), ViewError> {
    let canvas = bridge.text("canvas").unwrap_or_else(|| "canvas".into());
    let mut window = open_canvas(&canvas, bridge.get("smooth").is_truthy()).await?;
    run_in_page(&mut window, options).await
}

/// The two functions of the page.
fn give_functions(shared: &Rc<RefCell<Shared>>) {
    let inbox = Rc::clone(shared);
    let command = Closure::<dyn FnMut(String) -> String>::new(move |line: String| {
        match Command::parse(&line) {
            Ok(command) => {
                let mut shared = inbox.borrow_mut();
                shared.commands.push(command);
                shared.done = false;
                String::new()
            }
            Err(error) => error.to_string(),
        }
    });
    let seen = Rc::clone(shared);
    let state = Closure::<dyn FnMut() -> String>::new(move || {
        let shared = seen.borrow();
        serde_json::to_string(&State::of(&shared)).unwrap_or_default()
    });
    offer([
        ("frangible_command", command.into_js_value()),
        ("frangible_state", state.into_js_value()),
    ]);
}

/// Answer of `frangible_state()`, as JSON.
#[derive(Serialize)]
struct State<'a> {
    scene: &'a str,
    /// Commands carried out; `done` if all of them are, with all they began.
    commands: u64,
    done: bool,
    busy: bool,
    /// Frames drawn.
    frames: u64,
    /// Simulated time, s, and steps.
    time: f64,
    steps: u64,
    paused: bool,
    whole: usize,
    pieces: usize,
    /// Hash of the bits of all positions, motions and masses: one number, which JavaScript has no type for.
    fingerprint: String,
    triangles: usize,
    /// Duration of the last break, s: of the impact here, of the whole step in the next field.
    fracture_seconds: f64,
    step_seconds: f64,
    /// Masses of the pieces of the last break, kg.
    masses: &'a [f64],
    /// Position of the last contact that mattered, m.
    hit: Option<[f32; 3]>,
    /// Item that is being fetched or baked, and the share of it that is done.
    bake: Option<(&'a str, f64)>,
    message: Option<&'a str>,
    complaint: bool,
}

impl<'a> State<'a> {
    fn of(shared: &'a Shared) -> Self {
        let shown = &shared.shown;
        let step = &shown.break_step;
        let blow = shown.blow.as_ref();
        Self {
            scene: &shown.scene,
            commands: shown.commands,
            done: shared.done,
            busy: shown.busy,
            frames: shared.frames,
            time: shown.time,
            steps: shown.steps,
            paused: shown.paused,
            whole: shown.whole,
            pieces: shown.pieces,
            fingerprint: format!("{:016x}", shown.fingerprint),
            triangles: shown.picture.triangles(),
            fracture_seconds: step.fracture,
            step_seconds: step.ours() + step.rigid,
            masses: blow.map_or(&[], |blow| &blow.masses),
            hit: blow.and_then(|blow| blow.point).map(|p| p.to_array()),
            bake: (shown.bake.as_ref()).map(|bake| (bake.what.as_str(), bake.share)),
            message: shown.message.as_ref().map(|(text, _)| text.as_str()),
            complaint: shown
                .message
                .as_ref()
                .is_some_and(|(_, complaint)| *complaint),
        }
    }
}

impl Page for Around {
    fn commands(&self) -> Vec<Command> {
        std::mem::take(&mut self.shared.borrow_mut().commands)
    }

    fn show(&self, shown: &Arc<Shown>, done: bool, frames: u64) {
        let before = {
            let mut shared = self.shared.borrow_mut();
            shared.shown = Arc::clone(shown);
            shared.done = done && shared.commands.is_empty();
            std::mem::replace(&mut shared.frames, frames)
        };
        if before != frames {
            // A page that does not need the number of frames has no such function.
            let _ = self.bridge.call("drawn", &[(frames as f64).into()]);
        }
    }

    fn next_frame(&self) -> Pin<Box<dyn Future<Output = ()>>> {
        let promise = Promise::new(&mut |resolve: Function, _| request_frame(&resolve));
        Box::pin(async move {
            // It is never rejected.
            let _ = JsFuture::from(promise).await;
        })
    }
}

/// Has the browser call this when it draws again.
fn request_frame(then: &Function) {
    let global = js_sys::global();
    let request = Reflect::get(&global, &"requestAnimationFrame".into());
    if let Ok(Ok(request)) = request.map(JsCast::dyn_into::<Function>) {
        let argument: &JsValue = then.as_ref();
        let _ = request.call1(&global, argument);
    }
}
