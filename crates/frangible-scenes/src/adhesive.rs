//! An adhesive between bodies whose faces lie close to each other, patch by patch.
//!
//! Mortar over a whole face holds one piece of a broken body, the one at its middle. Laminated glass, a tile on a wall and the cover of a
//! telephone hold all their pieces: here each patch is a bond of its own, and goes to the piece that it lies on.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::Asset;
use frangible::glam::{DVec3, Quat, Vec3};
use frangible_mesh::{MeshSolid, Surface};
use frangible_rapier::{BreakableWorld, Mortar};

use crate::error::SceneError;
use crate::launch::vector;
use crate::scene::Adhesive;
use crate::stage::Placed;

/// Thickest layer, m.
const THICKEST: f32 = 3e-3;

/// Cosine of the angle between a face and the way to the other body, at least.
const FACING: f32 = 0.7;

/// Smallest patch, as a share of a whole one: smaller ones lie at the rim.
const LEAST_SHARE: f32 = 0.02;

/// Sums over a patch.
#[derive(Clone, Copy, Default)]
struct Patch {
    area: f32,
    /// Place and way across the layer, times the area, m³.
    place: Vec3,
    across: Vec3,
}

/// Bonds all bodies over the faces that lie within the thickest layer of each other.
pub(crate) fn glue(
    world: &mut BreakableWorld,
    bodies: &[Placed<'_>],
    assets: &[Arc<Asset>],
    adhesive: &Adhesive,
) -> Result<(), SceneError> {
    for i in 0..bodies.len() {
        for j in i + 1..bodies.len() {
            let (one, two) = (bodies[i].bounds, bodies[j].bounds);
            let gap = (one[0] - two[1]).max(two[0] - one[1]);
            if gap.max_element() > THICKEST {
                continue;
            }
            // The finer surface says where the patches are.
            let finer = if triangle(&assets[i]) <= triangle(&assets[j]) {
                [i, j]
            } else {
                [j, i]
            };
            let [fine, coarse] = finer.map(|k| (&bodies[k], &*assets[k]));
            for patch in patches(fine, coarse, adhesive.patch as f32) {
                let mortar = Mortar {
                    centre: vector(patch.place / patch.area),
                    normal: vector(patch.across),
                    area: patch.area,
                    strength: adhesive.strength as f32,
                };
                world.insert_mortar(bodies[i].handle, bodies[j].handle, mortar)?;
            }
        }
    }
    Ok(())
}

/// Mean area of a surface's triangles, m².
fn triangle(asset: &Asset) -> f32 {
    let positions = &asset.fracture.positions;
    let triangles = &asset.surface.triangles;
    let areas = triangles
        .iter()
        .map(|t| area(t.map(|v| positions[v as usize])).length());
    areas.sum::<f32>() / triangles.len().max(1) as f32
}

/// Normal of a triangle, as long as its area.
fn area([a, b, c]: [Vec3; 3]) -> Vec3 {
    0.5 * (b - a).cross(c - a)
}

/// Where the first body's surface faces the second one's, in squares of this side.
fn patches(
    (one, asset): (&Placed<'_>, &Asset),
    (two, other): (&Placed<'_>, &Asset),
    side: f32,
) -> Vec<Patch> {
    let Ok(solid) = MeshSolid::new(&surface(other)) else {
        return Vec::new();
    };
    let (turn, back) = (one.spec.rotation, two.spec.rotation.inverse());
    let [low, high] = two.bounds;
    let mut squares: BTreeMap<[i32; 3], Patch> = BTreeMap::new();
    for corners in &asset.surface.triangles {
        let corners = corners.map(|v| asset.fracture.positions[v as usize]);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let place = one.target.centre + turn * middle;
        if (low - place).max(place - high).max_element() > THICKEST {
            continue;
        }
        let normal = turn * area(corners);
        let Some(across) = way(&solid, back, place - two.target.centre) else {
            continue;
        };
        if normal.dot(across) < FACING * normal.length() * across.length() {
            continue;
        }
        let square = (middle / side).floor().as_ivec3().to_array();
        let patch = squares.entry(square).or_default();
        let area = normal.length();
        patch.area += area;
        patch.place += area * (place + 0.5 * across);
        patch.across += normal;
    }
    let least = LEAST_SHARE * side * side;
    let mut patches: Vec<Patch> = squares.into_values().collect();
    patches.retain(|patch| patch.area >= least);
    patches
}

/// From a place, m from the second body's centre, to the nearest place of its surface, if that is near enough.
fn way(solid: &MeshSolid, back: Quat, place: Vec3) -> Option<Vec3> {
    let there = (back * place).as_dvec3();
    let nearest = solid.nearest(there, f64::from(THICKEST))?;
    Some(back.inverse() * (nearest.position - there).as_vec3())
}

fn surface(asset: &Asset) -> Surface {
    let positions = asset.fracture.positions.iter();
    Surface {
        positions: positions.map(|p| DVec3::from(*p)).collect(),
        triangles: asset.surface.triangles.clone(),
    }
}
