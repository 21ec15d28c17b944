//! Weak places of a body, from and to TOML.

use frangible::glam::Vec3;
use frangible::{Patch, Zone};
use serde::Deserialize;

use super::body::clash;
use super::convert::vector;
use super::values::{list, single, vector as vector_text};
use crate::check::Fault;

const KEY: &str = "weakness";

const ONE_ZONE: &str = "a weakness has one of `box`, `sphere` with `radius`, `plane`, and `line` with `radius`, \
     for example { line = [[0, -0.04, 0], [0, 0.04, 0]], radius = 0.002, strength = 0.3 }";

/// Where a body is weaker, or stronger: one zone, and the factors there.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WeaknessTable {
    #[serde(rename = "box")]
    cuboid: Option<[[f64; 3]; 2]>,
    sphere: Option<[f64; 3]>,
    plane: Option<PlaneTable>,
    line: Option<Vec<[f64; 3]>>,
    radius: Option<f64>,
    strength: Option<f32>,
    toughness: Option<f32>,
    weak_points: Option<f32>,
}

/// A plane; what lies behind it belongs to the zone.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    point: [f64; 3],
    normal: [f64; 3],
}

pub(super) fn patch(table: WeaknessTable) -> Result<Patch, Fault> {
    let radius = table.radius.map(|r| r as f32);
    let zone = match (table.cuboid, table.sphere, table.plane, table.line, radius) {
        (Some(corners), None, None, None, None) => Zone::Box(corners.map(vector)),
        (None, Some(centre), None, None, Some(radius)) => Zone::Sphere {
            centre: vector(centre),
            radius,
        },
        (None, None, Some(plane), None, None) => Zone::HalfSpace {
            point: vector(plane.point),
            normal: vector(plane.normal),
        },
        (None, None, None, Some(line), Some(radius)) => Zone::Tube {
            line: line.into_iter().map(vector).collect(),
            radius,
        },
        _ => return Err(clash(KEY, ONE_ZONE)),
    };
    Ok(Patch {
        zone,
        strength: table.strength,
        toughness: table.toughness,
        weak_points: table.weak_points,
    })
}

pub(super) fn patch_text(patch: &Patch) -> String {
    let mut parts = match &patch.zone {
        Zone::Box(corners) => vec![format!("box = {}", points(corners))],
        Zone::Sphere { centre, radius } => vec![
            format!("sphere = {}", vector_text(*centre)),
            format!("radius = {}", single(*radius)),
        ],
        Zone::HalfSpace { point, normal } => {
            let (point, normal) = (vector_text(*point), vector_text(*normal));
            vec![format!("plane = {{ point = {point}, normal = {normal} }}")]
        }
        Zone::Tube { line, radius } => vec![
            format!("line = {}", points(line)),
            format!("radius = {}", single(*radius)),
        ],
        // No other kind can be asked for here.
        _ => Vec::new(),
    };
    for (key, factor) in [
        ("strength", patch.strength),
        ("toughness", patch.toughness),
        ("weak_points", patch.weak_points),
    ] {
        parts.extend(factor.map(|f| format!("{key} = {}", single(f))));
    }
    format!("{{ {} }}", parts.join(", "))
}

fn points(points: &[Vec3]) -> String {
    let texts: Vec<String> = points.iter().map(|p| list(&p.to_array())).collect();
    format!("[{}]", texts.join(", "))
}
