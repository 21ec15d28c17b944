//! A Rapier world whose bodies break **inside** the step.
//!
//! [`BreakableWorld::step`] is the main entry point: it steps Rapier and passes every impact on a breakable body to
//! [`frangible::impact()`]. If a body breaks, it undoes the step, replaces the body by fragments with the velocities from **before** the
//! impact, applies the impulse of the blow, and steps again. So a ball continues through the pane that it broke with its remaining
//! speed, instead of bouncing off a pane that no longer exists. If the body holds, the rebound follows from the blow: a thin wide pane
//! absorbs it, a block reflects it.
//!
//! ```
//! use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};
//! use rapier3d::math::{Pose, Vector};
//!
//! let mut world = BreakableWorld::new(WorldConfig::default())?;
//! world.insert_fixed_box(Vector::new(1.0, 0.05, 1.0), Pose::IDENTITY, SurfaceProperties::STONE)?;
//! let ball = Ball { mass: 0.1, radius: 0.02 };
//! let start = Pose::translation(0.0, 0.5, 0.0);
//! world.insert_ball(ball, SurfaceProperties::STEEL, start, Vector::ZERO)?;
//! let breaks = world.step()?;
//! assert!(breaks.is_empty());
//! # Ok::<(), frangible_rapier::WorldError>(())
//! ```
//!
//! `examples/glass.rs` is a complete program: a glass falls and breaks. A game with its own Rapier world keeps it and steps it with a
//! [`Breaker`] instead of Rapier's pipeline: `examples/window.rs`.
//!
//! # Causes of breaks
//! - Impacts with friction, on one breakable body or between two.
//! - Sustained loads: after every step the forces of a body's resting contacts, and the weight of a supported body, are passed to
//!   [`frangible::internals::rest()`]; [`BreakableWorld::rest_margin`] gives the safety margin.
//! - [`BreakableWorld::blast`] and [`BreakableWorld::fracture_at`].
//!
//! [`BreakEvent::cause`] gives the cause. [`BreakableWorld::would_break`] tests a blow without applying it.
//!
//! # Guarantees
//! - Mass, centre and inertia of a fragment are those of the exact piece, not of its collider.
//! - Replacing a body by its fragments conserves momentum and angular momentum, and adds no kinetic energy.
//! - Impulses of blows are equal and opposite on body and striker, and never add energy.
//! - The energy of cracks is taken from the energy absorbed by the blow, then from the relative motion of fragments and striker.
//! - No fragment's centre of mass passes through a fixed body, and no ball through anything.
//! - Two runs are bit-identical; with the feature `portable`, which is on by default, also on different machines.
//!   [`BreakableWorld::fingerprint`] verifies it.
//!
//! # Cost
//! A step copies the world only when a breakable body may be hit at [`WorldConfig::impact_speed`] or more
//! (0.8 ms for 300 bodies); replacing a body by 100 pieces costs about 8 ms, once, in addition to the break. A world at rest costs one
//! pass over the velocities. [`BreakableWorld::timings`] gives the times of the parts of a step.
//!
//! # Many bodies
//! For scenes with hundreds of bodies use [`Breaking::AfterStep`], which needs no copy and no second step and spreads the work over
//! steps and threads; [`ColliderDetail`] and [`SmallPieces`] for simple colliders; [`WorldConfig::dust_mass`] and [`WorldConfig::debris_mass`] for
//! negligible pieces; and the feature `parallel` for Rapier's own threads. Results are bit-identical for any number of threads. The
//! china shop, the example `shop` of the unpublished crate `frangible-lab`, has a thousand bodies.
//!
//! # Resting pieces
//! Pieces that stay in their place sleep, become fixed, are removed, or are merged into one fixed body with one compound collider for each body
//! that broke ([`AtRest::Merge`]), as [`WorldConfig::at_rest`] says. A merged piece keeps its handle and its pose, so that drawing needs no change
//! ([`BreakableWorld::merged`] lists them). It comes loose before the step that may break it, by
//! [`BreakableWorld::loosen`], or when its body is made dynamic. A heap of 300 pieces that jostle costs 17 ms in a step, as fixed bodies
//! 0.9 ms, merged 0.3 ms; with a copy of the world 30, 6.5 and 1.2 ms (`benches/step.rs`, beside other work).
//!
//! # Supported bodies
//! A body whose asset has supports (a pane in its frame, a shelf in a wall) is fixed until it breaks; then the fragments with a
//! supported node stay in place, and the others fall.
//!
//! # Fragments that break again
//! With a model for their modes ([`BreakableWorld::with_piece_model`]; the module `pieces` of `frangible-bake` has several), fragments
//! become breakable [`PieceConfig::delay`] after the break, within limits of generation, mass and size; the others stay plain bodies.
//! Bodies that are cracked but not broken get new modes in the same way.
//!
//! # Limitations
//! Contacts that a bound refuses unseen, and blows judged in a later step than their own, keep the engine's impulse and
//! restitution. Two breakable bodies that meet both vibrate under one force; the mean of their answers counts.
//! Without a model fragments are plain bodies: they do not break again. Multibody joints of a broken body are released,
//! impulse joints move to the fragment that holds them; neither loads a body. A blow of less than
//! [`WorldConfig::impact_speed`] breaks nothing: only a push that lasts four steps in a row counts as a load.
//! Rapier's simplified friction keeps no friction impulse of a blow; with several partners at once it is estimated by
//! Coulomb's law (`FrictionModel::Coulomb` keeps it all). Breakable bodies and fragments are swept against fixed bodies
//! and balls only, not against each other. A merged piece breaks by blows, blasts and scripts, but not
//! under a load that is laid on it. Rapier limits spin to an eighth of a turn per step, and applies a contact's
//! impulse at the arms of the step's start: chips that would spin faster lose angular momentum, and a blow during which
//! bodies move centimetres per step changes the total by some percent. Shorter steps cure both. A ball that alone breaks a body that
//! touches nothing else loses the same speed with steps of any length (`examples/passage.rs`), and meets the loose pieces again only 0.25 s later.
//! Any other striker meets pieces as contacts of the engine, and so does any ball with pieces that are held. What is left of a held body does not
//! break again in the same step.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod bodies;
mod breaker;
mod callbacks;
mod calm;
mod config;
mod contact;
mod counts;
mod error;
mod event;
mod fingerprint;
mod fragments;
mod impulses;
mod loads;
mod saved;
mod snapshot;
mod stepping;
mod threads;
mod timings;
mod workshop;
mod world;

pub use bodies::collider::collision_shape;
pub use bodies::dispatch::PieceContacts;
pub use bodies::insert::Ball;
pub use bodies::mortar::Mortar;
pub use breaker::{Breaker, Sets};
pub use config::{AtRest, Breaking, ColliderDetail, PieceConfig, SmallPieces, WorldConfig};
pub use contact::surface::SurfaceProperties;
pub use counts::LoadCounts;
pub use error::WorldError;
pub use event::{BreakCause, BreakEvent, HeldEvent};
pub use fragments::rubble::Merged;
pub use rapier3d;
pub use saved::SavedWorld;
pub use timings::StepTimings;
pub use world::{BreakFn, BreakableWorld, RestFn};
