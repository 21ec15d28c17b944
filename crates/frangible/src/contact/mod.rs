//! From contacts to a force pulse `[G12 §4.1-4.3]`.

mod admissible;
mod ball;
mod bytes;
mod duration;
mod kinds;
mod load;
mod pulse;
mod receptance;
mod report;
mod striker;

pub use crate::motion::Pulse;
pub use admissible::{admissible_duration, approach_energy};
pub use ball::first_touch_of_ball;
pub use duration::{
    answer_duration, contact_duration, hertz_duration, modal_hertz_duration, most_excited_mode,
};
pub(crate) use duration::{contact_radius_of_curvature, hertz_at, touch_duration};
pub use kinds::Contact;
pub(crate) use kinds::{in_one, pulse_lasts};
pub use load::{Load, Touch, modal_load};
pub(crate) use load::{give, inverse_mass};
pub use pulse::pulse;
pub use receptance::Receptance;
pub(crate) use receptance::WallReceptance;
pub use report::ContactReport;
pub use striker::{SharedMass, Striker};
