//! A blow, integrated against the body that it hits (beyond the paper).
//!
//! # Idea
//!
//! The force and the duration of a contact follow from the two bodies: from the striker's mass, Hertz's spring between them, and the
//! motion of the struck body under the force, rigid and vibrating. No pulse is prescribed: the striker arrives with its speed, and force,
//! duration, impulse and restitution are results. A wall that absorbs the blow lets the striker drop; a brick throws it back.
//!
//! # Equations
//!
//! For contact k, with F_k ≥ 0 the force on the body along its unit normal and g_k the depth of the striker in the body,
//!
//! `g_k = y_k − Σ_i ξ_ki q_i − Σ_l c_kl F_l = (F_k / K_k)^(2/3)`, `ÿ_k = −Σ_l B_kl F_l`, `q̈_i + d_i q̇_i + λ_i q_i = Σ_k ξ_ki F_k`,
//!
//! where y is the displacement of the striker relative to the rigid motion of the body, B the inverse masses of the rigid bodies at the contacts,
//! with rotation, q the amplitudes of the followed modes and, on a wall, of the wall oscillators (`near_field`), c the residual compliance of the
//! modes and waves left out, and `K = 4/3 E* √R` the stiffness of Hertz's spring, which yields where the pressure under it crushes the weaker body
//! (`spring.rs`). F is linear over each substep, so every oscillator is stepped exactly. The new forces solve one equation per contact, which has
//! exactly one root, as the left side falls with F and the right side grows.
//!
//! A breakable striker vibrates too. The contact feels it in the same way ([`Receptance`]): its modes, its wall oscillators and its residual
//! compliance are driven by the same F_k and subtracted from the gap with the body's. St Venant's two rods and Hertz's two spheres are limits of it.
//!
//! Friction follows the normal force: the body is pushed along n + f, f the ratio of the engine's friction and normal impulse. The force itself does
//! not feel friction: q in the first equation is the response to the normal forces alone, as y is the striker's displacement under them alone. A
//! force that felt the wall moved by friction could grow without end, since friction takes its energy from a slide that is not followed. A script
//! gives its push whole: friction is part of it.
//!
//! Cracks change what the contacts push against, and from then on forces, motion and cracks are found anew:
//! - a star of three arms or more under a contact leaves cantilevers, which give way more (`star.rs`);
//! - pieces that cracks have parted move on their own (`parted.rs`, `flight.rs`): the contact feels the mass of the piece that it pushes, and what
//!   the piece presses on.
//!
//! # Limits
//!
//! Crushing is a dent and a loss of energy: no powder flies, and the crushed place keeps its mass and stiffness. Steel strikers do not dent. A
//! contact that chatters is followed until all its points have parted; if the body then swings back against a striker that is still near, it does not
//! hit it again. Once pieces move on their own, an open contact is followed for as long again as it was expected to last: a chip bounces between the
//! striker and the body that follows. A striker that still approaches then goes on to what the piece under it was part of, at the same place. Two
//! bodies that both vibrate find the same force, whichever of them is computed, as long as they meet nothing else and neither has broken: the blow on
//! the body contains no other contacts of the striker, and no softening by the striker's own cracks.
//!
//! Forces are linear over substeps of a hundredth of Hertz's time (a four-hundredth where both bodies vibrate), every oscillator is stepped
//! exactly, and one equation per contact and substep has one root. Steps after the blow are as long as the modes allow.

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
pub(crate) use apart::Apart;
pub use course::Blow;
pub(crate) use groups::Groups;
pub(crate) use limits::Limits;
pub(crate) use spring::Spring;
pub(crate) use wall::{SteadyNear, has_near_field};
