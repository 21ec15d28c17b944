//! Time integration of a blow together with the struck body (an extension of the paper).
//!
//! # Idea
//!
//! The force and the duration of a contact follow from the two bodies: from the striker's mass, the Hertz contact stiffness, and the
//! rigid-body and vibrational response of the struck body. No pulse is prescribed: the input is the striker's velocity, and force,
//! duration, impulse and restitution are results. A striker drops from a thin wall that absorbs the blow and rebounds from a brick.
//!
//! # Equations
//!
//! For contact k, with F_k ≥ 0 the force on the body along its unit normal and g_k the depth of the striker in the body,
//!
//! `g_k = y_k − Σ_i ξ_ki q_i − Σ_l c_kl F_l = (F_k / K_k)^(2/3)`, `ÿ_k = −Σ_l B_kl F_l`, `q̈_i + d_i q̇_i + λ_i q_i = Σ_k ξ_ki F_k`,
//!
//! where y is the displacement of the striker relative to the rigid motion of the body, B the inverse masses of the rigid bodies at the contacts,
//! with rotation, q the amplitudes of the integrated modes and, on a wall, of the wall oscillators (`near_field`), c the residual compliance of the
//! omitted modes and waves, and `K = 4/3 E* √R` the Hertz contact stiffness, which yields if the contact pressure crushes the weaker body
//! (`spring.rs`). F is linear over each substep, so every oscillator is integrated exactly. The new forces solve one equation per contact, which
//! has exactly one root, since the left side decreases with F and the right side increases.
//!
//! A breakable striker vibrates too and is treated in the same way ([`Receptance`]): its modes, its wall oscillators and its residual compliance
//! are driven by the same F_k and subtracted from the gap with those of the body. St Venant's two rods and Hertz's two spheres are limiting cases.
//!
//! Friction is proportional to the normal force: the force on the body acts along n + f, where f is the ratio of the engine's friction impulse and
//! normal impulse. Friction does not affect the normal force: q and y in the first equation are the responses to the normal forces only. Otherwise
//! the force could grow without bound, since friction takes its energy from a sliding motion that is not simulated. Scripted forces already
//! include friction.
//!
//! Cracks change the resistance to the contacts, and from then on forces, motion and cracks are recomputed:
//! - a star crack with three or more arms under a contact leaves cantilevers, which are more compliant (`star.rs`);
//! - separated pieces move independently (`parted.rs`, `flight.rs`): the resistance is that of the mass of the piece under the contact, and of
//!   the body behind it.
//!
//! # Limits
//!
//! Crushing is modelled as an indentation with a loss of energy: no powder is ejected, and the crushed region keeps its mass and stiffness. Steel
//! strikers do not indent. A chattering contact is integrated until all its points have separated; if the body then swings back against a striker
//! that is still near, there is no second blow. Once pieces move independently, an open contact is integrated for as long again as its expected
//! duration, since a chip may bounce between the striker and the body behind it. A striker that still approaches then hits the rest of the body at
//! the same point. Two vibrating bodies have the same contact force whichever of them is computed, as long as they have no other contacts and
//! neither has broken: the blow on a body does not include other contacts of the striker or softening by the striker's cracks.
//!
//! Substeps are a hundredth of the Hertz contact duration, or a four-hundredth if both bodies vibrate. Steps after the blow are as long as the
//! modes allow.

mod accounts;
mod apart;
mod bank;
mod contacts;
mod couple;
mod course;
mod faces;
mod flight;
mod groups;
mod integrate;
mod lane;
mod limits;
mod moments;
mod parted;
mod plan;
mod receptance;
mod record;
mod results;
mod solve;
mod solver;
mod spring;
mod star;
mod wall;

pub use crate::contact::Receptance;
pub use accounts::BlowEnergy;
pub(crate) use apart::Apart;
pub use course::Blow;
pub(crate) use groups::Groups;
pub(crate) use limits::Limits;
pub(crate) use parted::outer;
pub(crate) use spring::Spring;
pub(crate) use wall::{SteadyNear, has_near_field};
