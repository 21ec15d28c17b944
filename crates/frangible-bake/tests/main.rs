//! Baking, checked against closed forms and brute force.

mod asset_file;
mod bake;
mod blow;
mod branches;
mod cancel;
mod clipped_render;
mod common;
mod core_bodies;
mod cover;
mod directions;
mod embedding;
mod fronts;
mod generations;
mod imported_tets;
mod methods;
mod modal;
mod mode_field;
mod parted;
mod rescale;
mod rupture;
mod shapes;
mod skin;
mod solids;
mod sturm;
mod supports;
mod walls;
