//! An adhesive between bodies whose faces lie close to each other, patch by patch.
//!
//! Mortar over a whole face holds one piece of a broken body, the one at its middle. Laminated glass, a tile on a wall and the cover of a
//! telephone hold all their pieces: here each patch is a bond of its own, and goes to the piece that it lies on.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::Asset;
use frangible::glam::{DVec3, Vec3};
use frangible_mesh::{MeshSolid, Surface};
use frangible_rapier::{BreakableWorld, Mortar};

use crate::error::SceneError;
use crate::launch::vector;
use crate::scene::Adhesive;
use crate::stage::Placed;

/// Thickest layer, m.
const THICKEST: f32 = 3e-3;

/// Cosine of the angle between a face and the turned face of the other body, at least.
const FACING: f32 = 0.7;

/// Smallest patch, as a share of a whole one, or of all that the two bodies share where that is less: smaller ones lie at the rim.
const LEAST_SHARE: f32 = 0.02;

/// Sums over a patch.
#[derive(Clone, Copy, Default)]
struct Patch {
    /// Area of the patch, m².
    area: f32,
    /// Place of the middle of the layer times the area, m³.
    place: Vec3,
    /// Outward normal of the first body times the area, m².
    normal: Vec3,
}

/// Bonds all bodies over the faces that lie within the thickest layer of each other, touch, or overlap by as little.
///
/// # Errors
/// An adhesive that bonds nothing.
pub(crate) fn glue(
    world: &mut BreakableWorld,
    bodies: &[Placed<'_>],
    assets: &[Arc<Asset>],
    adhesive: &Adhesive,
) -> Result<(), SceneError> {
    let mut count = 0;
    for i in 0..bodies.len() {
        for j in i + 1..bodies.len() {
            let (one, two) = (bodies[i].bounds, bodies[j].bounds);
            let gap = (one[0] - two[1]).max(two[0] - one[1]);
            if gap.max_element() > THICKEST {
                continue;
            }
            // The finer surface says where the patches are.
            let (fine, coarse) = if triangle(&assets[i]) <= triangle(&assets[j]) {
                (i, j)
            } else {
                (j, i)
            };
            let pair = [fine, coarse].map(|k| (&bodies[k], &*assets[k]));
            let patches = patches(pair, adhesive.patch as f32);
            count += patches.len();
            for patch in patches {
                let mortar = Mortar {
                    centre: vector(patch.place / patch.area),
                    normal: vector(patch.normal),
                    area: patch.area,
                    strength: adhesive.strength as f32,
                };
                world.insert_mortar(bodies[fine].handle, bodies[coarse].handle, mortar)?;
            }
        }
    }
    if count == 0 {
        return Err(SceneError::Clash(format!(
            "the adhesive bonds nothing: no two bodies have faces within {} mm of each other; bring them closer or leave the adhesive out",
            1e3 * THICKEST
        )));
    }
    Ok(())
}

/// Mean area of a surface's triangles, m².
fn triangle(asset: &Asset) -> f32 {
    let positions = &asset.fracture().positions;
    let triangles = &asset.surface().triangles;
    let areas = triangles
        .iter()
        .map(|t| area(t.map(|v| positions[v as usize])).length());
    areas.sum::<f32>() / triangles.len().max(1) as f32
}

/// Normal of a triangle, as long as its area.
fn area([a, b, c]: [Vec3; 3]) -> Vec3 {
    0.5 * (b - a).cross(c - a)
}

/// Parts of the first body's surface that face the second one's, in squares of this side.
fn patches([(one, asset), (two, other)]: [(&Placed<'_>, &Asset); 2], side: f32) -> Vec<Patch> {
    let Ok(solid) = MeshSolid::new(&surface(other)) else {
        return Vec::new();
    };
    let (turn, back) = (one.spec.rotation, two.spec.rotation.inverse());
    let [low, high] = two.bounds;
    let mut squares: BTreeMap<[i32; 3], Patch> = BTreeMap::new();
    for corners in &asset.surface().triangles {
        let corners = corners.map(|v| asset.fracture().positions[v as usize]);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let place = one.target.centre + turn * middle;
        if (low - place).max(place - high).max_element() > THICKEST {
            continue;
        }
        let there = (back * (place - two.target.centre)).as_dvec3();
        let Some(nearest) = solid.nearest(there, f64::from(THICKEST)) else {
            continue;
        };
        // The way to the nearest place says nothing where the bodies touch or overlap by rounding; the two normals do.
        let (normal, opposite) = (
            turn * area(corners),
            two.spec.rotation * nearest.normal.as_vec3(),
        );
        let area = normal.length();
        if -normal.dot(opposite) < FACING * area {
            continue;
        }
        let across = two.spec.rotation * (nearest.position - there).as_vec3();
        let square = (middle / side).floor().as_ivec3().to_array();
        let patch = squares.entry(square).or_default();
        patch.area += area;
        patch.place += area * (place + 0.5 * across);
        patch.normal += normal;
    }
    let mut patches: Vec<Patch> = squares.into_values().collect();
    let all: f32 = patches.iter().map(|patch| patch.area).sum();
    let least = LEAST_SHARE * (side * side).min(all);
    patches.retain(|patch| patch.area >= least);
    patches
}

fn surface(asset: &Asset) -> Surface {
    let positions = asset.fracture().positions.iter();
    Surface {
        positions: positions.map(|p| DVec3::from(*p)).collect(),
        triangles: asset.surface().triangles.clone(),
    }
}
