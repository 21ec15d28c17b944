//! Interactive viewer: throw things, change the parameters of the model, and inspect breaks.
//!
//! The **view model** needs no window: a [`Session`] simulates a scene step by step, executes [`Command`]s and returns its displayed state
//! ([`Shown`]); a [`Worker`] runs a session on another thread or in another program ([`Remote`]), so that bakes and breaks do not block; a
//! [`Script`] is a list of commands. The **window** (feature `window`) displays the state and translates mouse, keys and panels to the same
//! commands as scripts.
//!
//! ```no_run
//! use frangible_view::{Command, Session};
//! let mut session = Session::new();
//! session.apply(Command::parse("scene pane")?)?;
//! session.finish_jobs(); // the bake
//! session.apply(Command::parse("step 600")?)?;
//! println!("{} pieces", session.shown().pieces);
//! # Ok::<(), frangible_view::ViewError>(())
//! ```

pub mod analysis;
mod baking;
mod blow;
mod camera;
mod command;
mod compare;
mod edges;
mod error;
mod film;
mod host;
mod jobs;
pub mod knobs;
mod marks;
mod mesher;
pub mod numbers;
mod parse;
mod picking;
mod picture;
mod save;
mod script;
mod session;
mod shown;
mod tape;
mod times;
#[cfg(feature = "window")]
mod window;
mod wire;
mod worker;

pub use baking::same_bakes;
pub use blow::Blow;
pub use camera::{Orbit, Ray};
pub use command::{
    BallSpec, Command, FilmKind, FilmOptions, HammerSpec, Mark, Subject, Target, Tool,
};
pub use error::ViewError;
pub use frangible_sound::Outlet;
pub use host::{Delivery, Host};
pub use picture::{Batch, BatchLooks, Dot, Label, Line, Picture};
pub use script::Script;
pub use session::Session;
pub use shown::{BakeShown, Compared, Focus, Selection, Shown};
pub use times::Spread;
#[cfg(feature = "window")]
pub use window::{Page, PageOptions, run_in_page};
#[cfg(all(feature = "window", not(target_family = "wasm")))]
pub use window::{WindowOptions, run};
pub use wire::{Packer, Unpacker};
pub use worker::{Remote, Worker};
