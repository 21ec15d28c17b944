//! The stage: parts that all pictures have in common, however they are drawn.
//!
//! The stage has its own units: the view's target lies at the origin, and half the height of the picture there is 1. So lights, shadows and fog are
//! set once, for a thimble and for a column.

use frangible_recording::glam::Vec3;
use frangible_recording::{Recording, SurfaceMaterial, View};

use crate::floor_shadow::Caster;

/// The change from world to stage units.
#[derive(Clone, Copy, Debug)]
pub struct StageUnits {
    /// Target of the view, m.
    pub origin: Vec3,
    /// Stage units per metre.
    pub scale: f32,
}

impl StageUnits {
    /// The units of a view.
    #[must_use]
    pub fn of(view: &View) -> Self {
        let half_height = view.eye.distance(view.target) * (0.5 * view.vertical_fov).tan();
        Self {
            origin: view.target,
            scale: half_height.recip(),
        }
    }

    /// A point of the world, m, on the stage.
    #[must_use]
    pub fn point(self, world: Vec3) -> Vec3 {
        (world - self.origin) * self.scale
    }

    /// A view of the world on the stage.
    #[must_use]
    pub fn view(self, world: &View) -> View {
        View {
            eye: self.point(world.eye),
            target: Vec3::ZERO,
            ..*world
        }
    }
}

/// Level directions on the stage: from the view's target back to the camera, and to the camera's right.
#[must_use]
pub fn stage_directions(view: &View) -> [Vec3; 2] {
    let backward = Vec3::new(view.eye.x, 0.0, view.eye.z)
        .try_normalize()
        .unwrap_or(Vec3::Z);
    [backward, Vec3::Y.cross(backward)]
}

/// Direction and distance of the key light, stage units.
#[must_use]
pub fn key_light(view: &View) -> Vec3 {
    let [backward, right] = stage_directions(view);
    -3.4 * right + 4.6 * Vec3::Y + 2.4 * backward
}

/// Clarity of a surface for its shadow, 0 for an opaque one.
#[must_use]
pub fn clarity(surface: &SurfaceMaterial) -> f32 {
    surface.transmission.max(1.0 - surface.base_color[3])
}

/// Every face of a recording's first frame that can shade the floor.
#[must_use]
pub fn casters(recording: &Recording, units: StageUnits) -> Vec<Caster> {
    let mut casters = Vec::new();
    for (index, node) in recording.nodes.iter().enumerate() {
        let pose = recording.pose(index, 0);
        let mesh = &recording.meshes[node.mesh];
        let place = |&at: &Vec3| units.point(pose.rotation.normalize() * at + pose.translation);
        let points: Vec<Vec3> = mesh.positions.iter().map(place).collect();
        for part in &mesh.parts {
            let surface = &recording.surfaces[part.surface];
            let clarity = clarity(surface);
            let one_sided = clarity <= 0.0 && !surface.double_sided;
            casters.extend(part.indices.chunks_exact(3).map(|face| Caster {
                corners: [face[0], face[1], face[2]].map(|corner| points[corner as usize]),
                clarity,
                one_sided,
            }));
        }
    }
    casters
}
