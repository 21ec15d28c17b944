//! From contacts to a force pulse `[G12 §4.1-4.3]`.

mod admissible;
mod ball;
mod bytes;
mod duration;
mod kinds;
mod load;
mod pulse;

pub use admissible::{admissible_duration, approach_energy};
pub use ball::first_touch_of_ball;
pub use duration::{
    answer_duration, contact_duration, hertz_duration, modal_hertz_duration, most_excited_mode,
};
pub(crate) use duration::{contact_radius_of_curvature, hertz_at};
pub use kinds::{Contact, SharedMass, Striker};
#[doc(hidden)]
pub use load::each_row;
pub use load::{Load, Touch, modal_load};
pub(crate) use load::{carriers, give};
pub use pulse::{Pulse, pulse};
