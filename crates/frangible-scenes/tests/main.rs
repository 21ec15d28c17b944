//! Scenes, their files, and whole breaks of bodies of their size.

mod adhesive;
mod branching;
mod common;
mod cracks_seen;
mod culling;
mod energy;
mod fields;
mod files_given;
mod first_break;
mod framing;
mod game;
mod grooves;
mod held;
mod kinds;
mod later_projectiles;
mod loads;
mod paint;
mod replay;
mod rotation;
mod scenes;
mod solids;
mod sound;
mod tetrahedra;
mod toml;
mod trends;
mod whole_breaks;
