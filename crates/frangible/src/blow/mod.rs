//! A blow, integrated against the body that it hits (beyond the paper).
//!
//! # Idea
//!
//! How long a contact lasts and how hard it pushes follows from the two bodies: the striker's mass, Hertz' spring between them, and
//! how the struck body gives way, as a whole and by vibrating. So nothing about the pulse is chosen: the striker flies in with its
//! speed, and force, duration, impulse and restitution are outcomes. A wall that swallows the blow lets the striker drop; a brick
//! throws it back.
//!
//! # Equations
//!
//! Per contact k, with F_k ≥ 0 the force on the body along its unit normal and g_k how deep the striker is in,
//!
//! `g_k = y_k − Σ_i ξ_ki q_i − Σ_l c_kl F_l = (F_k / K_k)^(2/3)`, `ÿ_k = −Σ_l B_kl F_l`, `q̈_i + d_i q̇_i + λ_i q_i = Σ_k ξ_ki F_k`,
//!
//! where y is the striker's way against the body as a rigid one, B the rigid bodies' inverse masses at the contacts, with rotation, q the
//! modes that are followed and, on a wall, the wall oscillators (`near_field`), c what the modes left out give way by, statically, and
//! `K = 4/3 E* √R` Hertz' spring, which gives way where the pressure under it crushes the weaker body (`spring.rs`). F is linear over each
//! substep, so every oscillator is stepped exactly; the new forces solve one equation per contact, which has exactly one root, as the left
//! side falls with F and the right side grows.
//!
//! A breakable striker vibrates too. What the contact feels of it is of the same kind ([`Receptance`]): its modes, its wall oscillators and what
//! follows the force of it are driven by the same F_k, and leave the gap with the body's. St Venant's two rods and Hertz' two spheres are
//! limits of it.
//!
//! What friction there is follows the normal force: the body is pushed along n + f, f the ratio of the engine's friction and normal impulse. The
//! force itself does not feel it: q in the first equation is what the normal forces alone would do, as y is the way that they alone leave the
//! striker. A force that friction moves the wall under could grow without end, since friction takes its energy from a slide that is not
//! followed. A script gives its push whole: friction is part of it.
//!
//! Cracks change what the contacts push against, and from then on forces, motion and cracks are found anew:
//! - a star of three arms or more under a contact leaves cantilevers, which give way more (`star.rs`);
//! - pieces that cracks have parted move on their own (`parted.rs`, `flight.rs`): the contact feels the piece that it pushes, as heavy as
//!   that is, and what the piece presses on.
//!
//! # Limits
//!
//! Crushing is a dent and a loss of energy: no powder flies, and the crushed place keeps its mass and stiffness. Steel strikers do not dent. A
//! contact that chatters is followed until all its points have parted; where the body then swings back against a striker that is still near,
//! it does not hit it again. Once pieces move on their own, a contact that has opened is waited for as long again as it was expected to last: a
//! chip bounces between the striker and the body that follows. A striker that still comes nearer goes on to what the piece under it was part of,
//! at the same place. Two bodies that both vibrate find one force whichever is asked, as long as they meet nothing else and neither
//! has broken: what else touches the striker, and how its own cracks soften it, is not in the blow on the body.
//!
//! Forces are linear over substeps of a hundredth of Hertz' time (a four-hundredth where both bodies vibrate), every oscillator is stepped
//! exactly, and one equation per contact and substep has one root. Steps after the blow are as long as the modes allow.

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
