//! Quality of tetrahedra.

use glam::DVec3;

/// Signed volume of a tetrahedron, m³.
#[must_use]
pub fn volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a) / 6.0
}

/// Smallest and largest angle between two faces of a right-handed tetrahedron, degrees (70.5 in a regular one).
/// An inverted or flat one counts as 0 and 180.
#[must_use]
pub fn dihedral_range(x: [DVec3; 4]) -> (f64, f64) {
    let (low, high) = dihedral_cosines(x);
    (low.acos().to_degrees(), high.acos().to_degrees())
}

/// Cosines of the smallest and of the largest dihedral angle; (1, −1) for an inverted or flat tetrahedron.
#[must_use]
pub(crate) fn dihedral_cosines(x: [DVec3; 4]) -> (f64, f64) {
    if volume(x) <= 0.0 {
        return (1.0, -1.0);
    }
    // Outward normals of the faces opposite each corner; faces meet at the supplement of their normals' angle.
    let [a, b, c, d] = x;
    let normals = [
        (c - b).cross(d - b),
        (d - a).cross(c - a),
        (b - a).cross(d - a),
        (c - a).cross(b - a),
    ]
    .map(DVec3::normalize_or_zero);
    let (mut smallest, mut largest) = (-1.0_f64, 1.0_f64);
    for i in 0..4 {
        for j in 0..i {
            let cosine = -normals[i].dot(normals[j]);
            smallest = smallest.max(cosine);
            largest = largest.min(cosine);
        }
    }
    (smallest.clamp(-1.0, 1.0), largest.clamp(-1.0, 1.0))
}
