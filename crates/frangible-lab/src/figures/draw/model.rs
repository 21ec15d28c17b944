//! Coloured things to look at, as a recording of one frame.

use frangible::glam::{Quat, Vec3};
use frangible_recording::{MeshPart, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial};

/// Linear red, green, blue, and opacity.
pub(crate) type Colour = [f32; 4];

/// Triangles of several colours.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    paints: Vec<(Colour, RecordedMesh)>,
}

impl Model {
    /// A triangle with a normal at each corner.
    pub(crate) fn smooth(&mut self, colour: Colour, corners: [Vec3; 3], normals: [Vec3; 3]) {
        let mesh = self.mesh(colour);
        mesh.positions.extend(corners);
        mesh.normals
            .extend(normals.map(|n| n.try_normalize().unwrap_or(Vec3::Y)));
    }

    /// A flat triangle.
    pub(crate) fn flat(&mut self, colour: Colour, [a, b, c]: [Vec3; 3]) {
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        self.smooth(colour, [a, b, c], [normal; 3]);
    }

    /// A flat triangle that is visible from both sides.
    pub(crate) fn sheet(&mut self, colour: Colour, [a, b, c]: [Vec3; 3]) {
        self.flat(colour, [a, b, c]);
        self.flat(colour, [a, c, b]);
    }

    /// A straight bar of this half width, m.
    pub(crate) fn bar(&mut self, colour: Colour, [a, b]: [Vec3; 2], half_width: f32) {
        let Some(along) = (b - a).try_normalize() else {
            return;
        };
        let first = along.any_orthonormal_vector();
        let second = along.cross(first);
        let ring = |p: Vec3| [first, second, -first, -second].map(|side| p + side * half_width);
        let (low, high) = (ring(a - along * half_width), ring(b + along * half_width));
        for i in 0..4 {
            let j = (i + 1) % 4;
            self.flat(colour, [low[i], low[j], high[j]]);
            self.flat(colour, [low[i], high[j], high[i]]);
        }
        for [i, j, k] in [[0, 1, 2], [0, 2, 3]] {
            self.flat(colour, [low[i], low[k], low[j]]);
            self.flat(colour, [high[i], high[j], high[k]]);
        }
    }

    /// A ball of eight faces, shaded round.
    pub(crate) fn dot(&mut self, colour: Colour, at: Vec3, radius: f32) {
        for [x, y, z] in [
            [1.0, 1.0, 1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
            [1.0, -1.0, -1.0],
        ] {
            let [a, b, c] = [Vec3::X * x, Vec3::Y * y, Vec3::Z * z];
            for corners in [[a, b, c], [-a, -c, -b]] {
                // Once more divided: eight faces look like a gem, 32 like a ball.
                let [p, q, r] = corners;
                let middle = |u: Vec3, v: Vec3| (u + v).normalize();
                let (pq, qr, rp) = (middle(p, q), middle(q, r), middle(r, p));
                for face in [[p, pq, rp], [pq, q, qr], [rp, qr, r], [pq, qr, rp]] {
                    self.smooth(colour, face.map(|n| at + n * radius), face);
                }
            }
        }
    }

    /// Every position, for the view.
    pub(crate) fn points(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.paints
            .iter()
            .flat_map(|(_, mesh)| mesh.positions.iter().copied())
    }

    /// The model as a recording, turned.
    pub(crate) fn recording(&self, rotation: Quat) -> Recording {
        let mut recording = Recording {
            frame_rate: 60.0,
            frame_count: 1,
            ..Recording::default()
        };
        for (surface, (colour, mesh)) in self.paints.iter().enumerate() {
            recording.surfaces.push(SurfaceMaterial {
                base_color: *colour,
                roughness: 0.85,
                double_sided: colour[3] < 1.0,
                ..SurfaceMaterial::default()
            });
            let mut mesh = mesh.clone();
            mesh.parts.push(MeshPart {
                surface,
                indices: (0..mesh.positions.len() as u32).collect(),
            });
            recording.nodes.push(RecordedNode {
                mesh: recording.meshes.len(),
                poses: vec![Pose {
                    translation: Vec3::ZERO,
                    rotation,
                }],
                visible: 0..1,
                ..RecordedNode::default()
            });
            recording.meshes.push(mesh);
        }
        recording
    }

    fn mesh(&mut self, colour: Colour) -> &mut RecordedMesh {
        let at = self.paints.iter().position(|(known, _)| *known == colour);
        let at = at.unwrap_or_else(|| {
            self.paints.push((colour, RecordedMesh::default()));
            self.paints.len() - 1
        });
        &mut self.paints[at].1
    }
}
