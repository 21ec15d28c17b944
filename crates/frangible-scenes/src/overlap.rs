//! Bodies of a scene that start inside each other: the rigid bodies would push them apart with any force, and they would break.

use std::collections::HashMap;
use std::sync::Arc;

use frangible::Asset;
use frangible::glam::{DVec3, Quat, Vec3};
use frangible_mesh::{MeshSolid, Surface};

use crate::error::SceneError;
use crate::stage::Placed;

/// Depth that a place of one body may lie inside another, over the longer side of the smaller body's box.
const DEPTH: f32 = 0.01;

/// Share of the smaller body's volume that two thin walls may have in common.
const SHARE: f64 = 0.01;

/// Most places of one body that are looked for in another; of more every second, third, … is.
const MOST_PLACES: usize = 4000;

/// A body where it starts.
#[derive(Clone, Copy)]
struct Start<'a> {
    name: &'a str,
    asset: &'a Arc<Asset>,
    centre: Vec3,
    rotation: Quat,
    bounds: [Vec3; 2],
}

/// Overlap of one body with another.
#[derive(Clone, Copy, Debug, Default)]
struct Overlap {
    /// Depth of its deepest place, m.
    depth: f32,
    /// Volume in common, m³.
    volume: f64,
}

/// Checks that no two bodies overlap; they may touch, and one may stand in the hollow of another.
///
/// # Errors
/// Names the first two that overlap.
pub(crate) fn check_overlaps(
    bodies: &[Placed<'_>],
    assets: &[Arc<Asset>],
) -> Result<(), SceneError> {
    let starts = bodies.iter().zip(assets).map(|(body, asset)| Start {
        name: &body.spec.name,
        asset,
        centre: body.target.centre,
        rotation: body.spec.rotation,
        bounds: body.bounds,
    });
    let mut starts: Vec<Start<'_>> = starts.collect();
    // Swept along x, so that only neighbours are compared.
    starts.sort_by(|a, b| a.bounds[0].x.total_cmp(&b.bounds[0].x));
    let mut solids = HashMap::new();
    for (i, one) in starts.iter().enumerate() {
        let reached = |other: &&Start<'_>| other.bounds[0].x < one.bounds[1].x;
        for other in starts[i + 1..].iter().take_while(reached) {
            let overlap = overlap(one, other, &mut solids);
            let sizes = [one, other].map(|body| longest_side(&local_bounds(body.asset)));
            let smaller = one.asset.mass().volume.min(other.asset.mass().volume);
            if overlap.depth > DEPTH * sizes[0].min(sizes[1]) || overlap.volume > SHARE * smaller {
                return Err(SceneError::Overlap {
                    one: one.name.into(),
                    other: other.name.into(),
                    depth_mm: 1e3 * overlap.depth,
                });
            }
        }
    }
    Ok(())
}

/// The solids of the bodies looked at so far, by their assets; none of a surface that encloses nothing.
type Solids = HashMap<*const Asset, Option<MeshSolid>>;

/// Overlap of two bodies: the larger of each in the other.
fn overlap(one: &Start<'_>, other: &Start<'_>, solids: &mut Solids) -> Overlap {
    let (low, high) = (
        one.bounds[0].max(other.bounds[0]),
        one.bounds[1].min(other.bounds[1]),
    );
    if low.cmpge(high).any() {
        return Overlap::default();
    }
    let [a, b] = [(one, other), (other, one)].map(|(inner, outer)| inside(inner, outer, solids));
    Overlap {
        depth: a.depth.max(b.depth),
        volume: a.volume.max(b.volume),
    }
}

/// Overlap of one body with another, at places of the first: its nodes, and the middles of its tetrahedra, as two bodies in the same place have all
/// their nodes on each other's surface.
fn inside(inner: &Start<'_>, outer: &Start<'_>, solids: &mut Solids) -> Overlap {
    let back = outer.rotation.inverse();
    let [low, high] = local_bounds(outer.asset);
    let there = |p: Vec3| back * (inner.centre + inner.rotation * p - outer.centre);
    let near = |p: &Vec3| p.cmpgt(low).all() && p.cmplt(high).all();
    let mesh = inner.asset.fracture();
    let nodes = mesh.positions.iter().map(|&p| (there(p), 0.0));
    let middles = (0..mesh.tets.len()).map(|e| (there(mesh.centroid(e)), mesh.volume(e)));
    let places = nodes.filter(|(p, _)| near(p));
    let mut places: Vec<(Vec3, f64)> = places.chain(middles.filter(|(p, _)| near(p))).collect();
    let stride = places.len().div_ceil(MOST_PLACES).max(1);
    if stride > 1 {
        places = places.into_iter().step_by(stride).collect();
    }
    if places.is_empty() {
        return Overlap::default();
    }
    let solid = solids.entry(Arc::as_ptr(outer.asset)).or_insert_with(|| {
        let surface = Surface {
            positions: outer
                .asset
                .surface_positions()
                .iter()
                .map(|p| p.as_dvec3())
                .collect(),
            triangles: outer.asset.surface().triangles.clone(),
        };
        MeshSolid::new(&surface).ok()
    });
    let Some(solid) = solid else {
        return Overlap::default();
    };
    let points: Vec<DVec3> = places.iter().map(|(p, _)| p.as_dvec3()).collect();
    let mut found = Overlap::default();
    for ((&point, (_, volume)), inside) in
        points.iter().zip(&places).zip(solid.inside_many(&points))
    {
        if inside {
            let nearest = solid.nearest(point, f64::INFINITY);
            let depth = nearest.map_or(0.0, |nearest| nearest.distance) as f32;
            found.depth = found.depth.max(depth);
            found.volume += volume * stride as f64;
        }
    }
    found
}

/// Lowest and highest corner of a body's box in its own frame, m.
fn local_bounds(asset: &Asset) -> [Vec3; 2] {
    let positions = asset.surface_positions().iter();
    let nothing = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    positions.fold(nothing, |[low, high], &p| [low.min(p), high.max(p)])
}

fn longest_side([low, high]: &[Vec3; 2]) -> f32 {
    (*high - *low).max_element()
}
