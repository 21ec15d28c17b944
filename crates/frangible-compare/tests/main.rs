//! What each of the compared methods makes of a blow.

mod common;
mod division;
mod methods;
