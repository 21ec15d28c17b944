//! The evidence itself, and the program that writes it.

mod agreement;
mod cases;
mod experiments;
mod haptic;
mod live;
mod pieces;
mod program;
mod shop;
