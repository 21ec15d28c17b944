//! Smooth normals of surfaces.

use glam::Vec3;

/// Corners that turn by more than this from their vertex's mean are shaded flat (cosine).
const SMOOTH_COSINE: f32 = 0.6;

/// Returns corner normals: area-weighted averages at the vertices, except across sharp edges.
pub fn smooth_normals(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let flat = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| vertices[v as usize]);
        (b - a).cross(c - a)
    };
    let mut sums = vec![Vec3::ZERO; vertices.len()];
    for t in triangles {
        let own = flat(t);
        for &v in t {
            sums[v as usize] += own;
        }
    }
    // Once for each vertex, and not for each of its corners.
    let means: Vec<Option<Vec3>> = sums.into_iter().map(Vec3::try_normalize).collect();
    let corners = |t: &[u32; 3]| {
        let own = flat(t).normalize_or(Vec3::Y);
        let smooth = |v: u32| match means[v as usize] {
            Some(mean) if mean.dot(own) > SMOOTH_COSINE => mean,
            _ => own,
        };
        [smooth(t[0]), smooth(t[1]), smooth(t[2])]
    };
    triangles.iter().map(corners).collect()
}
