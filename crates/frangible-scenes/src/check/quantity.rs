//! Ranges of numbers.

use frangible::glam::Vec3;

use super::Fault;
use crate::error::SceneError;

pub(super) fn quantity(
    key: &'static str,
    what: &'static str,
    value: impl ToString,
    must: &'static str,
) -> Fault {
    let value = value.to_string();
    Fault::new(key, SceneError::Quantity { what, value, must })
}

pub(super) fn range(
    key: &'static str,
    what: &'static str,
    value: f64,
    above: f64,
    most: f64,
    must: &'static str,
) -> Result<(), Fault> {
    if value.is_finite() && value > above && value <= most {
        Ok(())
    } else {
        Err(quantity(key, what, value, must))
    }
}

pub(super) fn direction(key: &'static str, what: &'static str, v: Vec3) -> Result<(), Fault> {
    if v.is_finite() && v.length() > 0.0 && v.length().is_finite() {
        Ok(())
    } else {
        Err(quantity(key, what, v, "three finite numbers, not all zero"))
    }
}

/// A place within a kilometre: farther away f32 loses the millimetre.
pub(super) fn finite(key: &'static str, what: &'static str, v: Vec3) -> Result<(), Fault> {
    if v.is_finite() && v.abs().max_element() <= 1e3 {
        Ok(())
    } else {
        Err(quantity(
            key,
            what,
            v,
            "finite numbers, at most 1000 from the origin",
        ))
    }
}
