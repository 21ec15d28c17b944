//! What the page's script gives: the object `frangible`, with
//!
//! | | |
//! |---|---|
//! | `scenes` | names of the scenes there are |
//! | `byClock` | whether scenes run by the clock |
//! | `failed(text)` | the program cannot go on |
//!
//! on the page besides
//!
//! | | |
//! |---|---|
//! | `first`, `smooth`, `canvas` | how to begin, see [`PageOptions`](frangible_view::PageOptions) |
//! | `give(line)` | gives the session a command |
//! | `news()` | an array of bytes, each what the session told since this was asked last |
//! | `drawn(frames)` | a frame is there |
//!
//! and in the worker that the session runs in
//!
//! | | |
//! |---|---|
//! | `scene(name)` | a scene, TOML |
//! | `bodies(scene, tell)` | promise of an array of bytes, one baked body each; `tell(share)` meanwhile |
//! | `save(name, bytes)` | offers a file for download |
//! | `hear(samples, rate)` | plays what is heard next: left and right in turn, −1 to 1 |

use js_sys::{Array, Function, Object, Promise, Reflect, Uint8Array};
use wasm_bindgen::{JsCast, JsValue};

/// The object of the page's script.
#[derive(Clone)]
pub(crate) struct Bridge(Object);

impl Bridge {
    /// None on a page that is not ours.
    pub(crate) fn find() -> Option<Self> {
        let object = Reflect::get(&js_sys::global(), &"frangible".into()).ok()?;
        object.dyn_into().ok().map(Self)
    }

    /// Whether this is a worker of a page and not the page itself.
    pub(crate) fn is_in_worker(&self) -> bool {
        !Reflect::has(&js_sys::global(), &"document".into()).unwrap_or(false)
    }

    /// A panic ends the program: the page says so instead of standing still.
    pub(crate) fn report_panics(&self) {
        std::panic::set_hook(Box::new(|panic| {
            if let Some(bridge) = Self::find() {
                let _ = bridge.call("failed", &[panic.to_string().into()]);
            }
        }));
    }

    pub(crate) fn get(&self, name: &str) -> JsValue {
        Reflect::get(&self.0, &name.into()).unwrap_or(JsValue::UNDEFINED)
    }

    pub(crate) fn text(&self, name: &str) -> Option<String> {
        self.get(name).as_string()
    }

    pub(crate) fn scenes(&self) -> Vec<String> {
        let names = Array::from(&self.get("scenes"));
        names.iter().filter_map(|name| name.as_string()).collect()
    }

    /// The scene of this name, as TOML.
    pub(crate) fn scene(&self, name: &str) -> Option<String> {
        self.call("scene", &[name.into()]).ok()?.as_string()
    }

    /// Calls one of its functions; a page without it is not told.
    pub(crate) fn call(&self, name: &str, arguments: &[JsValue]) -> Result<JsValue, String> {
        let function: Function = self
            .get(name)
            .dyn_into()
            .map_err(|_| format!("the page has no function `{name}`"))?;
        let list: Array = arguments.iter().collect();
        function.apply(&self.0, &list).map_err(|error| said(&error))
    }

    /// Has the baked bodies of a scene fetched.
    pub(crate) async fn bodies(
        &self,
        scene: &str,
        tell: &Function,
    ) -> Result<Vec<Vec<u8>>, String> {
        let promise = self.call("bodies", &[scene.into(), tell.clone().into()])?;
        let promise: Promise = promise
            .dyn_into()
            .map_err(|_| "`bodies` gave no promise".to_string())?;
        let fetched = wasm_bindgen_futures::JsFuture::from(promise).await;
        let arrays = Array::from(&fetched.map_err(|error| said(&error))?);
        Ok(arrays
            .iter()
            .map(|a| Uint8Array::new(&a).to_vec())
            .collect())
    }
}

/// What an exception says.
fn said(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => error.as_string().unwrap_or_else(|| "it failed".into()),
    }
}
