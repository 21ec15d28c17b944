//! Bodies from a mesh file of several parts, placed as the file has them.

use frangible::glam::{DVec3, Quat, Vec3};
use frangible_bake::{Region, Support};
use frangible_mesh::PartChoice;

use crate::body::{BodySpec, Place};
use crate::check::tame;
use crate::error::SceneError;
use crate::source::{BodySource, Opened, OpenedPart};
use crate::stage::STANDING_GAP;

/// Makes a body of each part. Together they stand, hang, move and turn as the one body would; each is held by the supports that reach it.
///
/// # Errors
/// Zones of weakness, which are placed from the centre of mass of one body.
pub(crate) fn divide(
    body: &BodySpec,
    parts: Vec<OpenedPart>,
) -> Result<Vec<(BodySpec, Opened)>, SceneError> {
    let BodySource::Mesh { path, .. } = &body.source else {
        return Ok(Vec::new());
    };
    if !body.weakness.is_empty() {
        return Err(SceneError::File {
            path: path.clone(),
            problem: "zones of weakness are placed from the centre of mass of one body, but this file has several parts; \
                      give each its own [[body]] with `part`, or choose one with `parts`"
                .into(),
        });
    }
    let turn = |p: DVec3| body.rotation.as_dquat() * p;
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for part in &parts {
        sum += part.volume * part.centre;
        total += part.volume;
    }
    let middle = sum / total;
    let lowest: Vec<f64> = parts
        .iter()
        .map(|part| lowest_point(&part.opened, body.rotation))
        .collect();
    let ground = lowest.iter().copied().fold(f64::INFINITY, f64::min);
    let held = held_by(&body.supports, &parts);
    let placed = parts.into_iter().zip(lowest).zip(held);
    Ok(placed
        .map(|((part, lowest), supports)| {
            let from_middle = turn(part.centre - middle).as_vec3();
            let aside = |[x, z]: [f32; 2]| [x + from_middle.x, z + from_middle.z];
            let above = lowest - ground;
            let place = match body.place {
                Place::Standing { over } => Place::Above {
                    height: f64::from(STANDING_GAP) + above,
                    over: aside(over),
                },
                Place::Above { height, over } => Place::Above {
                    height: height + above,
                    over: aside(over),
                },
                Place::Centre(centre) => Place::Centre(centre + from_middle),
            };
            let mut source = body.source.clone();
            if let BodySource::Mesh {
                parts, resolution, ..
            } = &mut source
            {
                *parts = PartChoice::Only(part.name.clone());
                *resolution = Some(part.tets);
            }
            let spec = BodySpec {
                name: tame(&format!("{} {}", body.name, part.name)),
                source,
                place,
                velocity: body.velocity + body.spin.cross(from_middle),
                supports,
                ..body.clone()
            };
            (spec, part.opened)
        })
        .collect())
}

/// Places of a part's surface, m.
fn places(opened: &Opened) -> &[Vec3] {
    match opened {
        Opened::Shape {
            render: Some(render),
            ..
        } => &render.positions,
        _ => &[],
    }
}

fn lowest_point(opened: &Opened, rotation: Quat) -> f64 {
    let heights = places(opened)
        .iter()
        .map(|p| (rotation.as_dquat() * p.as_dvec3()).y);
    let lowest = heights.fold(f64::INFINITY, f64::min);
    if lowest.is_finite() { lowest } else { 0.0 }
}

/// The supports of each part. One that reaches none stays with the first, whose bake says so.
fn held_by(supports: &[Support], parts: &[OpenedPart]) -> Vec<Vec<Support>> {
    let mut held = vec![Vec::new(); parts.len()];
    for support in supports {
        let mut any = false;
        for (part, held) in parts.iter().zip(&mut held) {
            if reaches(&support.region, &part.opened) {
                held.push(support.clone());
                any = true;
            }
        }
        if let (false, Some(first)) = (any, held.first_mut()) {
            first.push(support.clone());
        }
    }
    held
}

fn reaches(region: &Region, opened: &Opened) -> bool {
    let points = places(opened).iter().map(|p| p.as_dvec3());
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = points
        .clone()
        .fold(nothing, |[l, h], p| [l.min(p), h.max(p)]);
    match region {
        Region::HalfSpace { point, normal } => {
            points.into_iter().any(|p| (p - *point).dot(*normal) <= 0.0)
        }
        Region::Box {
            low: from,
            high: to,
        } => from.cmple(high).all() && to.cmpge(low).all(),
        Region::Sphere { centre, radius } => centre.clamp(low, high).distance(*centre) <= *radius,
        Region::Group(name) => match opened {
            Opened::Shape { groups, .. } => groups.iter().any(|group| group.name == *name),
            Opened::Asset(_) => false,
        },
        _ => true,
    }
}
