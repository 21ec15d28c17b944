//! Two outcomes of one impact, one beside the other.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_recording::RecordedMesh;
use frangible_scenes::LiveScene;

use crate::blow::Blow;
use crate::marks::reach;
use crate::mesher::numbered;
use crate::picture::{Batch, BatchLooks};
use crate::shown::Compared;

/// Distance of the middles, in units of the body's reach.
const GAP: f32 = 2.3;

/// Half the width and height of both outcomes, pieces drawn somewhat apart, m.
pub(crate) fn extent(blow: &Blow) -> [f32; 2] {
    let reach = reach(blow.body.asset());
    [(0.5 * GAP + 1.3) * reach, 1.3 * reach]
}

/// Both outcomes where the body was hit, the old one to the left as seen from `look_from`, pieces drawn apart by `explode`.
pub(crate) fn side_by_side(
    live: &LiveScene,
    compared: &Compared,
    look_from: Vec3,
    explode: f32,
) -> Vec<Batch> {
    let right = Vec3::Y.cross(look_from).normalize_or(Vec3::X);
    let mut batches: BTreeMap<usize, Batch> = BTreeMap::new();
    for (blow, side) in compared.blows.iter().zip([-0.5, 0.5]) {
        let Some(thing) = live.things().get(blow.thing) else {
            continue;
        };
        let positions = thing.mesh.positions.iter();
        let reach = positions.map(|p| p.length()).fold(0.0, f32::max);
        let shift = side * GAP * reach * right;
        match &blow.fracture {
            Some(fracture) => {
                for (birth, mesh) in live.shapes(thing, fracture) {
                    let middle = (1.0 + explode) * birth;
                    place(live, &mesh, blow, middle, shift, &mut batches);
                }
            }
            None => place(live, &thing.mesh, blow, Vec3::ZERO, shift, &mut batches),
        }
    }
    for batch in batches.values_mut() {
        batch.faces = Arc::new(numbered(batch.positions.len()));
    }
    batches.into_values().collect()
}

/// Adds a shape of the body that was hit, its origin at `middle` in the body's frame.
pub(crate) fn place(
    live: &LiveScene,
    mesh: &RecordedMesh,
    blow: &Blow,
    middle: Vec3,
    shift: Vec3,
    batches: &mut BTreeMap<usize, Batch>,
) {
    let rotation = blow.pose.rotation.normalize();
    let origin = rotation * middle + blow.pose.translation + shift;
    for part in &mesh.parts {
        let batch = batches.entry(part.surface).or_insert_with(|| Batch {
            looks: BatchLooks::Surface(live.surfaces()[part.surface].clone()),
            positions: Vec::new(),
            normals: Vec::new(),
            values: Vec::new(),
            faces: Arc::default(),
            stamp: 0,
        });
        for &corner in &part.indices {
            let corner = corner as usize;
            batch
                .positions
                .push(rotation * mesh.positions[corner] + origin);
            batch
                .normals
                .push(rotation * mesh.normals[corner].normalize_or(Vec3::Y));
        }
    }
}
