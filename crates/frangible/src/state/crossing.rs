//! Crossing of a tetrahedron by a crack.

use glam::Vec3;

/// Edge points where s changes sign in a tetrahedron, as a polygon of three or four corners in order; zero counts as positive.
pub(crate) fn crossing_polygon(x: &[Vec3; 4], s: &[f32; 4]) -> ([Vec3; 4], usize) {
    let negative = s.map(|v| v < 0.0);
    let cut = |i: usize, j: usize| x[i] + (x[j] - x[i]) * (s[i] / (s[i] - s[j]));
    let mut polygon = [Vec3::ZERO; 4];
    match negative.iter().filter(|&&n| n).count() {
        count @ (1 | 3) => {
            let lone = negative
                .iter()
                .position(|&n| n == (count == 1))
                .unwrap_or(0);

            for (k, j) in (0..4).filter(|&j| j != lone).enumerate() {
                polygon[k] = cut(lone, j);
            }
            (polygon, 3)
        }
        2 => {
            let mut low = [0; 2];
            let mut high = [0; 2];
            let (mut l, mut h) = (0, 0);
            for i in 0..4 {
                if negative[i] {
                    low[l] = i;
                    l += 1;
                } else {
                    high[h] = i;
                    h += 1;
                }
            }
            let ([a, b], [c, d]) = (low, high);
            ([cut(a, c), cut(a, d), cut(b, d), cut(b, c)], 4)
        }
        _ => (polygon, 0),
    }
}

/// Middle of the corners of the crack's polygon in a tetrahedron, m.
pub(crate) fn crossing_middle(x: &[Vec3; 4], s: &[f32; 4]) -> Vec3 {
    middle(crossing_polygon(x, s))
}

/// Area of the crack inside a tetrahedron, m² `[G12 Eq. 11]`.
pub(crate) fn crossing_area(x: &[Vec3; 4], s: &[f32; 4]) -> f32 {
    area(crossing_polygon(x, s), Vec3::length)
}

/// Area of the crack inside a tetrahedron without its roughness, m²: projected on a plane of this unit normal.
pub(crate) fn nominal_area(x: &[Vec3; 4], s: &[f32; 4], normal: Vec3) -> f32 {
    area(crossing_polygon(x, s), |a| a.dot(normal).abs())
}

/// [`crossing_middle`] and [`crossing_area`].
pub(crate) fn crossing(x: &[Vec3; 4], s: &[f32; 4]) -> (Vec3, f32) {
    let polygon = crossing_polygon(x, s);
    (middle(polygon), area(polygon, Vec3::length))
}

/// [`crossing_middle`] and [`nominal_area`].
pub(crate) fn nominal_crossing(x: &[Vec3; 4], s: &[f32; 4], normal: Vec3) -> (Vec3, f32) {
    let polygon = crossing_polygon(x, s);
    (middle(polygon), area(polygon, |a| a.dot(normal).abs()))
}

fn middle((polygon, corners): ([Vec3; 4], usize)) -> Vec3 {
    polygon[..corners].iter().sum::<Vec3>() / corners.max(1) as f32
}

/// Sum of a measure of the polygon's triangles, given their vector areas, m².
fn area((p, corners): ([Vec3; 4], usize), measure: impl Fn(Vec3) -> f32) -> f32 {
    let triangle = |a: Vec3, b: Vec3, c: Vec3| 0.5 * measure((b - a).cross(c - a));
    match corners {
        3 => triangle(p[0], p[1], p[2]),
        4 => triangle(p[0], p[1], p[2]) + triangle(p[0], p[2], p[3]),
        _ => 0.0,
    }
}
