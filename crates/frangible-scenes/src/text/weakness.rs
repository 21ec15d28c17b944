//! Weak places of a body, from and to TOML.

use frangible::glam::Vec3;
use frangible_bake::weakness::{Channel, Paint, Patch, Zone};
use frangible_mesh::did_you_mean;
use serde::Deserialize;

use super::body::clash;
use super::convert::{short, vector};
use super::either::OneOrTwo;
use super::values::{list, single, vector as vector_text};
use crate::check::Fault;
use crate::error::SceneError;

const KEY: &str = "weakness";

const ONE_ZONE: &str = "a weakness must have exactly one of `box`, `sphere` with `radius`, `plane`, `line` with `radius`, and `paint`, \
     for example { line = [[0, -0.04, 0], [0, 0.04, 0]], radius = 0.002, strength = 0.3 }";

/// Part of a body that is weaker, or stronger: one zone, or a channel of its vertex colours, and the factors there.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WeaknessTable {
    #[serde(rename = "box")]
    cuboid: Option<[[f64; 3]; 2]>,
    sphere: Option<[f64; 3]>,
    plane: Option<PlaneTable>,
    line: Option<Vec<[f64; 3]>>,
    paint: Option<String>,
    radius: Option<f64>,
    strength: Option<OneOrTwo>,
    toughness: Option<OneOrTwo>,
    weak_points: Option<OneOrTwo>,
    groove: Option<OneOrTwo>,
}

/// A plane; the part of the body behind it belongs to the zone.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    point: [f64; 3],
    normal: [f64; 3],
}

/// Sorts entries into paint and zones, which lie over it.
pub(super) fn weakness(tables: Vec<WeaknessTable>) -> Result<(Vec<Paint>, Vec<Patch>), Fault> {
    let (mut paint, mut patches) = (Vec::new(), Vec::new());
    for table in tables {
        match table.paint.clone() {
            Some(channel) => paint.push(self::paint(&channel, table)?),
            None => patches.push(patch(table)?),
        }
    }
    Ok((paint, patches))
}

fn paint(channel: &str, table: WeaknessTable) -> Result<Paint, Fault> {
    let zoned = table.cuboid.is_some()
        || table.sphere.is_some()
        || table.plane.is_some()
        || table.line.is_some()
        || table.radius.is_some();
    if zoned {
        return Err(clash(KEY, ONE_ZONE));
    }
    let channel = Channel::from_name(channel).ok_or_else(|| {
        let names = Channel::ALL.map(Channel::name);
        let hint = did_you_mean(channel, names);
        let channel = short(channel);
        let problem = format!(
            "`{channel}` is not a colour channel{hint}; channels: {}",
            names.join(", ")
        );
        Fault::new(KEY, SceneError::Clash(problem))
    })?;
    let pair = |given: Option<OneOrTwo>| given.map(|g| g.two(1.0));
    Ok(Paint {
        channel,
        strength: pair(table.strength),
        toughness: pair(table.toughness),
        weak_points: pair(table.weak_points),
        groove: table.groove.map(|g| g.two(0.0)),
    })
}

fn patch(table: WeaknessTable) -> Result<Patch, Fault> {
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
        strength: single_factor(table.strength)?,
        toughness: single_factor(table.toughness)?,
        weak_points: single_factor(table.weak_points)?,
        groove: single_factor(table.groove)?,
    })
}

fn single_factor(given: Option<OneOrTwo>) -> Result<Option<f32>, Fault> {
    let problem = "a zone takes single values; pairs, for colour 0 and colour 1, are allowed only with `paint`";
    given
        .map(|g| g.one().ok_or_else(|| clash(KEY, problem)))
        .transpose()
}

pub(super) fn paint_text(paint: &Paint) -> String {
    let mut parts = vec![format!("paint = \"{}\"", paint.channel.name())];
    for (key, factors) in [
        ("strength", paint.strength),
        ("toughness", paint.toughness),
        ("weak_points", paint.weak_points),
        ("groove", paint.groove),
    ] {
        parts.extend(factors.map(|f| format!("{key} = {}", list(&f))));
    }
    format!("{{ {} }}", parts.join(", "))
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
        ("groove", patch.groove),
    ] {
        parts.extend(factor.map(|f| format!("{key} = {}", single(f))));
    }
    format!("{{ {} }}", parts.join(", "))
}

fn points(points: &[Vec3]) -> String {
    let texts: Vec<String> = points.iter().map(|p| list(&p.to_array())).collect();
    format!("[{}]", texts.join(", "))
}
