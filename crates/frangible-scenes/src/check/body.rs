//! Checks of one body.

use frangible::glam::Vec3;
use frangible_bake::{MOST_MODES, READY_SHAPES, check_supports};
use frangible_mesh::PartChoice;

use super::quantity::{finite, quantity, range};
use super::{Fault, LONGEST_NAME, MAX_SPEED, MOST_TETS, SIZES};
use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::source::{BodySource, bounds};

/// Widest gap that is welded, m.
const MOST_GAP: f64 = 1.0;

/// Highest drop, m.
const MAX_HEIGHT: f64 = 100.0;

pub(super) fn check_body(body: &BodySpec) -> Result<(), Fault> {
    if body.name.is_empty() || body.name.len() > LONGEST_NAME {
        let must = "1 to 120 bytes long";
        return Err(quantity(
            "name",
            "the body's name",
            format!("`{}`", body.name),
            must,
        ));
    }
    body.material
        .validate()
        .map_err(|e| Fault::new("material", frangible::InputError::from(e)))?;
    range(
        "modes",
        "the number of modes",
        body.modes as f64,
        0.0,
        MOST_MODES as f64,
        "1 to 400",
    )?;
    if let Some(followed) = body.followed
        && !(1..=body.modes).contains(&followed)
    {
        let must = "1 or more, and at most the number of modes";
        return Err(quantity(
            "followed",
            "the number of modes to follow",
            followed,
            must,
        ));
    }
    if let BodySource::Mesh {
        size,
        resolution,
        wall,
        parts,
        ..
    } = &body.source
    {
        if let PartChoice::Weld { gap: Some(gap) } = *parts
            && !(0.0..=MOST_GAP).contains(&gap)
        {
            let must = "0 to 1 m";
            return Err(quantity("gap", "the gap that is welded", gap, must));
        }
        if wall.is_some() && *parts != PartChoice::Auto {
            let problem = "the parts of a wall cannot be chosen: all its sheets are one body; remove --parts or --wall (in a scene file: `parts`, `part` or `wall`)";
            return Err(Fault::new("wall", SceneError::Clash(problem.into())));
        }
        if let Some(wall) = *wall {
            let must = "above 0 and at most 0.1 m";
            range("wall", "the thickness of the wall", wall, 0.0, 0.1, must)?;
        }
        if let Some(size) = *size {
            check_longest("size", "the body's size", size)?;
        }
        check_resolution(*resolution)?;
    }
    if let BodySource::Ready { name, resolution } = &body.source {
        check_resolution(*resolution)?;
        if !READY_SHAPES.contains(&name.as_str()) {
            let must = "the name of a ready shape";
            return Err(quantity("shape", "the shape", format!("`{name}`"), must));
        }
    }
    if let BodySource::Shape(shape) = &body.source {
        shape.volume().map_err(|e| Fault::new("shape", e))?;
        if let Some([low, high]) = bounds(shape) {
            let longest = (high - low).max_element();
            check_longest("shape", "the longest side of `shape`", longest)?;
        }
        check_resolution(body.resolution)?;
    } else if body.resolution.is_some() {
        let problem =
            "the body's resolution is for built-in shapes; a mesh or ready solid has its own";
        return Err(Fault::new("resolution", SceneError::Clash(problem.into())));
    }
    match body.place {
        Place::Standing { over } => finite("position", "the body's position", flat(over))?,
        Place::Above { height, over } => {
            let must = "above 0 and at most 100 m";
            range("drop", "the drop height", height, 0.0, MAX_HEIGHT, must)?;
            finite("position", "the body's position", flat(over))?;
        }
        Place::Centre(centre) => finite("position", "the body's position", centre)?,
    }
    if !(body.rotation.is_finite() && (body.rotation.length() - 1.0).abs() < 1e-3) {
        return Err(quantity(
            "rotation",
            "the body's rotation",
            body.rotation,
            "a unit quaternion",
        ));
    }
    let limited = |key, what, v: Vec3, limit: f64, must| {
        finite(key, what, v)?;
        if f64::from(v.length()) > limit {
            return Err(quantity(key, what, v, must));
        }
        Ok(())
    };
    limited(
        "velocity",
        "the body's velocity",
        body.velocity,
        MAX_SPEED,
        "at most 300 m/s",
    )?;
    limited(
        "spin",
        "the body's spin",
        body.spin,
        1e3,
        "at most 1000 rad/s",
    )?;
    if let Some(size) = body.rescale.size {
        check_longest("size", "the body's size", size)?;
    }
    if let Some(preset) = body
        .rescale
        .material
        .as_ref()
        .and_then(|m| m.preset.as_ref())
    {
        frangible::Material::preset(preset).map_err(|e| Fault::new("material", e))?;
    }
    if !body.supports.is_empty() && matches!(body.source, BodySource::Asset(_)) {
        let problem = "`supports` are part of a baked body; bake it again to change them";
        return Err(Fault::new("supports", SceneError::Clash(problem.into())));
    }
    super::weakness::check_weakness(body)?;
    check_supports(&body.supports).map_err(|e| Fault::new("supports", e))
}

fn check_longest(key: &'static str, what: &'static str, longest: f64) -> Result<(), Fault> {
    if (SIZES[0]..=SIZES[1]).contains(&longest) {
        return Ok(());
    }
    Err(quantity(key, what, longest, "0.001 to 3 m"))
}

fn check_resolution(tets: Option<usize>) -> Result<(), Fault> {
    match tets {
        Some(tets) if !(500..=MOST_TETS).contains(&tets) => {
            let must = "500 to 2000000 tetrahedra";
            Err(quantity("resolution", "the resolution", tets, must))
        }
        _ => Ok(()),
    }
}

fn flat([x, z]: [f32; 2]) -> Vec3 {
    Vec3::new(x, 0.0, z)
}
