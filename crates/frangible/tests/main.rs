//! What the core promises, checked on three small baked bodies and on assets made of arbitrary numbers.

mod asset_file;
mod bodies;
mod common;
mod config;
mod contact;
mod crack;
mod crushing;
mod fragment;
mod fuzz_seeds;
mod hostile_state;
mod impact;
mod layers;
mod loads;
mod piece;
mod places;
mod principal;
mod refuse;
mod rigid;
mod scatter;
mod state;
mod steps;
mod two_bodies;
