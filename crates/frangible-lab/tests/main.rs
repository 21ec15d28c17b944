//! The evidence itself, the data and the pages that quote it, and the program that measures.

mod agreement;
mod cases;
mod compare;
mod evidence;
mod experiments;
mod gpu;
mod pieces;
mod program;
