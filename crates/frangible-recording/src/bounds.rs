//! Extent of a recording.

use glam::Vec3;

use crate::Recording;

impl Recording {
    /// A sphere around everything visible in any frame, as its centre and its radius, m. The floor does not count; an empty recording gives zero.
    #[must_use]
    pub fn bounding_sphere(&self) -> (Vec3, f32) {
        let reach: Vec<f32> = self
            .meshes
            .iter()
            .map(|mesh| {
                mesh.positions
                    .iter()
                    .map(|p| p.length())
                    .fold(0.0, f32::max)
            })
            .collect();
        let mut low = Vec3::INFINITY;
        let mut high = Vec3::NEG_INFINITY;
        for node in &self.nodes {
            let radius = Vec3::splat(reach.get(node.mesh).copied().unwrap_or(0.0));
            let seen = if node.poses.len() == 1 {
                0..1
            } else {
                node.visible.clone()
            };
            for pose in node.poses.get(seen).unwrap_or_default() {
                low = low.min(pose.translation - radius);
                high = high.max(pose.translation + radius);
            }
        }
        if !low.cmple(high).all() {
            return (Vec3::ZERO, 0.0);
        }
        (0.5 * (low + high), 0.5 * low.distance(high))
    }
}
