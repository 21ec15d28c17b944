//! The object `frangible` that the page's scripts provide, with `byClock`, true if scenes run by the clock, and `failed(text)`, which says that the
//! program cannot go on. In the window it also has
//!
//! | | |
//! |---|---|
//! | `scenes` | names of the scenes |
//! | `first`, `smooth`, `canvas` | how to begin, see `PageOptions` of the viewer |
//! | `give(line)` | gives the session a command |
//! | `news()` | an array of byte arrays, which the session has sent since the last call |
//! | `drawn(frames)` | a frame is there |
//!
//! Its members in the session's workers are described in that program's `folder.rs`.

use js_sys::{Array, Function, Object, Reflect};
use wasm_bindgen::{JsCast, JsValue};

use crate::console;

/// The object of the page's scripts.
#[derive(Clone, Debug)]
pub struct Bridge(Object);

impl Bridge {
    /// Finds the object, and sends it panics and log messages. None on a page that is not ours.
    #[must_use]
    pub fn begin() -> Option<Self> {
        let bridge = Self::find()?;
        // A panic ends the program: the page says so instead of standing still.
        std::panic::set_hook(Box::new(|panic| {
            if let Some(bridge) = Self::find() {
                let _ = bridge.call("failed", &[panic.to_string().into()]);
            }
        }));
        console::start();
        Some(bridge)
    }

    fn find() -> Option<Self> {
        let object = Reflect::get(&js_sys::global(), &"frangible".into()).ok()?;
        object.dyn_into().ok().map(Self)
    }

    /// One of its members; undefined where it has none of this name.
    #[must_use]
    pub fn get(&self, name: &str) -> JsValue {
        Reflect::get(&self.0, &name.into()).unwrap_or(JsValue::UNDEFINED)
    }

    /// A member that is text.
    #[must_use]
    pub fn text(&self, name: &str) -> Option<String> {
        self.get(name).as_string()
    }

    /// The names in a member that is a list of them.
    #[must_use]
    pub fn names(&self, name: &str) -> Vec<String> {
        let names = Array::from(&self.get(name));
        names.iter().filter_map(|name| name.as_string()).collect()
    }

    /// Calls one of its functions.
    ///
    /// # Errors
    /// It has no such function, or that failed.
    pub fn call(&self, name: &str, arguments: &[JsValue]) -> Result<JsValue, String> {
        let function: Function = self
            .get(name)
            .dyn_into()
            .map_err(|_| format!("the page has no function `{name}`"))?;
        let list: Array = arguments.iter().collect();
        function.apply(&self.0, &list).map_err(|error| said(&error))
    }
}

/// Gives the scripts functions of these names.
pub fn offer<const N: usize>(functions: [(&str, JsValue); N]) {
    let global = js_sys::global();
    for (name, function) in functions {
        // It fails on frozen objects only, and neither a window nor a worker's global object is one.
        let _ = Reflect::set(&global, &name.into(), &function);
    }
}

/// Message of an exception.
#[must_use]
pub fn said(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => error.as_string().unwrap_or_else(|| "it failed".into()),
    }
}
