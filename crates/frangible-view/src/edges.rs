//! The meshes themselves: the skins of the fracture mesh and of the analysis mesh as edges, moving with the body.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::Asset;
use frangible::glam::Vec3;
use frangible_bake::mode_field::{
    mode_on_analysis_mesh, mode_on_fracture_mesh, motion_on_analysis_mesh, motion_on_fracture_mesh,
};
use frangible_recording::Pose;
use frangible_scenes::{LiveScene, ThingKind};

use crate::marks::{mode_amplitude, reach};
use crate::picture::{Batch, BatchLooks};
use crate::session::Session;
use crate::{Mark, Subject};

/// Distance of the edges from the surface, share of the body's reach: on the surface they would flicker with it.
const OUT: f32 = 2e-3;

/// Colours, linear: of the fracture mesh, of the analysis mesh.
const FINE: [f32; 3] = [0.02, 0.06, 0.25];
const COARSE: [f32; 3] = [0.7, 0.12, 0.0];

/// Known skins, by the address of their body in memory; `true` for the fine mesh's.
#[derive(Default)]
pub(crate) struct Skins(BTreeMap<(usize, bool), Skin>);

/// The faces that one tetrahedron has alone. The body is kept, so that its place in memory is not another's.
struct Skin {
    body: Arc<Asset>,
    faces: Arc<Vec<[u32; 3]>>,
}

/// Faces with one tetrahedron only, looking outwards, in the order of the tetrahedra.
pub(crate) fn skin(tets: impl Iterator<Item = [u32; 4]>) -> Vec<[u32; 3]> {
    let mut all: Vec<([u32; 3], usize, [u32; 3])> = Vec::new();
    for [a, b, c, d] in tets {
        // Outwards for a tetrahedron whose last corner lies to the left of the others, as ours do.
        for face in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
            let mut key = face;
            key.sort_unstable();
            all.push((key, all.len(), face));
        }
    }
    all.sort_unstable();
    let mut alone: Vec<(usize, [u32; 3])> = all
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|faces| faces.len() == 1)
        .map(|faces| (faces[0].1, faces[0].2))
        .collect();
    alone.sort_unstable();
    alone.into_iter().map(|(_, face)| face).collect()
}

impl Skins {
    fn faces(&mut self, asset: &Arc<Asset>, fine: bool) -> Arc<Vec<[u32; 3]>> {
        // Only a few bodies are shown at once.
        if self.0.len() > 64 {
            self.0.clear();
        }
        let key = (Arc::as_ptr(asset) as usize, fine);
        let found = self.0.entry(key).or_insert_with(|| {
            let faces = match fine {
                true => skin(asset.fracture().tets.iter().copied()),
                false => {
                    let elements = asset.analysis().elements.iter();
                    skin(elements.map(|e| [e[0], e[1], e[2], e[3]]))
                }
            };
            Skin {
                body: Arc::clone(asset),
                faces: Arc::new(faces),
            }
        });
        debug_assert!(Arc::ptr_eq(&found.body, asset));
        Arc::clone(&found.faces)
    }

    /// A mesh as edges, its nodes displaced by `factor` times these.
    fn batch(
        &mut self,
        asset: &Arc<Asset>,
        fine: bool,
        pose: Pose,
        (factor, displacements): (f32, &[Vec3]),
    ) -> Batch {
        let faces = self.faces(asset, fine);
        let nodes = match fine {
            true => &asset.fracture().positions,
            false => &asset.analysis().nodes,
        };
        let mut positions = nodes.clone();
        for (node, displacement) in positions.iter_mut().zip(displacements) {
            *node += factor * *displacement;
        }
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for face in faces.iter() {
            let [a, b, c] = face.map(|node| positions[node as usize]);
            for node in face {
                normals[*node as usize] += (b - a).cross(c - a);
            }
        }
        let (rotation, out) = (pose.rotation.normalize(), OUT * reach(asset));
        for (position, normal) in positions.iter_mut().zip(&mut normals) {
            *normal = normal.normalize_or(Vec3::Y);
            *position = rotation * (*position + out * *normal) + pose.translation;
            *normal = rotation * *normal;
        }
        Batch {
            looks: BatchLooks::Edges(if fine { FINE } else { COARSE }),
            positions,
            normals,
            values: Vec::new(),
            faces,
            stamp: 0,
        }
    }
}

impl Session {
    /// The meshes that are marked: of the body that was hit as it is shown, or in the scene of all whole bodies.
    pub(crate) fn mesh_edges(&self, skins: &mut Skins) -> Vec<Batch> {
        let marked = [(Mark::FractureMesh, true), (Mark::AnalysisMesh, false)];
        let wanted = marked.into_iter().filter(|(mark, _)| self.is_marked(*mark));
        let mut batches = Vec::new();
        for (_, fine) in wanted {
            match (self.subject(), self.blow(), self.analysis()) {
                (Subject::Compare, ..) => {}
                (Subject::Stress, Some(blow), Some(analysis)) => {
                    let amplitudes = analysis.amplitudes(self.scrubbed());
                    let asset = &analysis.asset;
                    let field = match fine {
                        true => motion_on_fracture_mesh(asset, amplitudes),
                        false => motion_on_analysis_mesh(asset, amplitudes),
                    };
                    let moved = (self.exaggerated() as f32, &field.displacements[..]);
                    batches.push(skins.batch(asset, fine, blow.pose, moved));
                }
                (Subject::Modes, Some(blow), Some(analysis)) => {
                    let (asset, mode) = (&analysis.asset, self.mode_of(analysis));
                    let factor = mode_amplitude(asset, mode, self.scrubbed());
                    let field = match fine {
                        true => mode_on_fracture_mesh(asset, mode),
                        false => mode_on_analysis_mesh(asset, mode),
                    };
                    let moved = (factor, &field.displacements[..]);
                    batches.push(skins.batch(asset, fine, blow.pose, moved));
                }
                (Subject::Cracks, Some(blow), Some(analysis)) => {
                    batches.push(skins.batch(&analysis.asset, fine, blow.pose, (0.0, &[])));
                }
                _ => {
                    let live = self.live();
                    batches.extend(
                        live.into_iter()
                            .flat_map(whole_bodies)
                            .map(|(asset, pose)| skins.batch(&asset, fine, pose, (0.0, &[]))),
                    );
                }
            }
        }
        batches
    }
}

/// The scene's own bodies that have not broken, and where they are.
fn whole_bodies(live: &LiveScene) -> impl Iterator<Item = (Arc<Asset>, Pose)> {
    let things = live.things().iter();
    let bodies = things.filter(|thing| matches!(thing.kind, ThingKind::Body(_)));
    bodies.filter_map(|thing| {
        let body = live.body_before(thing.handle)?;
        Some((Arc::clone(body.asset()), live.pose(thing)?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_tetrahedra_that_share_a_face_have_six_faces_that_look_outwards() {
        let points = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
        let faces = skin([[0, 1, 2, 3], [1, 2, 3, 4]].into_iter());
        assert_eq!(faces.len(), 6);
        assert!(!faces.iter().any(|face| {
            let mut sorted = *face;
            sorted.sort_unstable();
            sorted == [1, 2, 3]
        }));
        // The volume by the divergence theorem: 1/6 for the corner, 1/3 for the rest.
        let volume: f32 = faces
            .iter()
            .map(|face| {
                let [a, b, c] = face.map(|v| points[v as usize]);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!((volume - 0.5).abs() < 1e-6, "{volume}");
    }
}
