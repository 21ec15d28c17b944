//! Files that hold recordings.

mod atomic;
