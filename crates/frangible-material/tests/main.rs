//! The materials by name, checked against what was published.

mod presets;
