//! Normals of surfaces without any.

use glam::Vec3;

/// Corners that turn by more than this from their vertex's mean are shaded flat (cosine).
const SMOOTH_COSINE: f32 = 0.6;

/// Corner normals: area-weighted vertex means, flat at sharp turns.
pub fn smooth_normals(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let flat = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| vertices[v as usize]);
        (b - a).cross(c - a)
    };
    let mut sums = vec![Vec3::ZERO; vertices.len()];
    for t in triangles {
        for &v in t {
            sums[v as usize] += flat(t);
        }
    }
    triangles
        .iter()
        .map(|t| {
            let own = flat(t).normalize_or(Vec3::Y);
            t.map(|v| {
                let mean = sums[v as usize].normalize_or(own);
                if mean.dot(own) > SMOOTH_COSINE {
                    mean
                } else {
                    own
                }
            })
        })
        .collect()
}
