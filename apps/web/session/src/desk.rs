//! The session: commands in, bytes of its state out. The worker's script calls
//!
//! | | |
//! |---|---|
//! | `frangible_take(line)` | a command |
//! | `frangible_turn()` | lets the session go on for some milliseconds, or for as long as a break takes |
//! | `frangible_news()` | bytes of the state, if it has changed |
//! | `frangible_told()` | whether all is done, bodies that are whole, pieces, masses of those of the last break, kg, and the fingerprint of all that moves |

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use frangible_view::{Command, Outlet, Packer, Shown, Worker};
use frangible_web::{Bridge, offer};
use js_sys::{Array, Float32Array, Float64Array, Uint8Array};
use wasm_bindgen::JsValue;
use wasm_bindgen::closure::Closure;

use crate::folder::Folder;

/// Samples per second; the browser resamples them for its loudspeaker.
const RATE: f64 = 48_000.0;

/// State that the three functions share.
struct Desk {
    bridge: Bridge,
    worker: Worker,
    outlet: Outlet,
    packer: Packer,
    /// State of the session that was packed last.
    told: Arc<Shown>,
}

/// Begins a session without a scene.
pub(crate) fn start(bridge: Bridge) {
    let outlet = Outlet::new(RATE);
    let by_clock = bridge.get("byClock").is_truthy();
    let host = Box::new(Folder(bridge.clone()));
    let desk = Rc::new(RefCell::new(Desk {
        worker: Worker::start_here(by_clock, host, Some(outlet.clone())),
        bridge,
        outlet,
        packer: Packer::default(),
        told: Arc::default(),
    }));
    let inbox = Rc::clone(&desk);
    let take =
        Closure::<dyn FnMut(String)>::new(move |line: String| inbox.borrow_mut().take(&line));
    let clock = Rc::clone(&desk);
    let turn = Closure::<dyn FnMut()>::new(move || clock.borrow_mut().turn());
    let told = Rc::clone(&desk);
    let told = Closure::<dyn FnMut() -> JsValue>::new(move || told.borrow().told());
    let news = Closure::<dyn FnMut() -> JsValue>::new(move || desk.borrow_mut().news());
    offer([
        ("frangible_take", take.into_js_value()),
        ("frangible_turn", turn.into_js_value()),
        ("frangible_news", news.into_js_value()),
        ("frangible_told", told.into_js_value()),
    ]);
}

impl Desk {
    fn take(&mut self, line: &str) {
        match Command::parse(line) {
            Ok(command) => _ = self.worker.send(command),
            // The window wrote the line, so that this is a defect: the page says so.
            Err(error) => _ = self.bridge.call("failed", &[error.to_string().into()]),
        }
    }

    fn turn(&mut self) {
        self.worker.advance();
        let heard = self.outlet.drain();
        if !heard.is_empty() {
            let samples = Float32Array::from(&heard[..]);
            // A page that plays nothing has no such function.
            let _ = self
                .bridge
                .call("hear", &[samples.into(), self.outlet.rate().into()]);
        }
    }

    fn told(&self) -> JsValue {
        let shown = self.worker.latest();
        let masses = shown.blow.as_ref().map_or(&[][..], |blow| &blow.masses);
        let fingerprint = format!("{:016x}", shown.fingerprint);
        let list: [JsValue; 5] = [
            self.worker.is_done(&shown).into(),
            (shown.whole as f64).into(),
            (shown.pieces as f64).into(),
            Float64Array::from(masses).into(),
            fingerprint.into(),
        ];
        list.into_iter().collect::<Array>().into()
    }

    fn news(&mut self) -> JsValue {
        let latest = self.worker.latest();
        if Arc::ptr_eq(&latest, &self.told) {
            return JsValue::UNDEFINED;
        }
        let bytes = self.packer.pack(&latest);
        self.told = latest;
        Uint8Array::from(&bytes[..]).into()
    }
}
