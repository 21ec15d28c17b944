//! Tests of the compared methods.

mod common;
mod division;
mod methods;
