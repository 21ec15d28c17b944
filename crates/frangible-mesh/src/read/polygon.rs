//! Faces of any number of corners to triangles.

use glam::{DVec2, DVec3};

/// Faces with more corners are cut as a fan without looking at their shape. A fan's overlaps cancel by their sign, so
/// a flat face still bounds the same solid.
const MOST_CLIPPED: usize = 512;

/// Cuts a face into `corners.len() - 2` triangles, given by the places of their corners in `corners`, wound as the
/// face. Quads are cut along the shorter diagonal that stays inside; fewer than three corners give nothing.
pub(crate) fn triangulate(corners: &[DVec3], triangles: &mut Vec<[u32; 3]>) {
    triangles.clear();
    match corners {
        [] | [_] | [_, _] => {}
        [_, _, _] => triangles.push([0, 1, 2]),
        &[a, b, c, d] => cut_quad([a, b, c, d], triangles),
        _ => {
            let flat = flattened(corners);
            if corners.len() > MOST_CLIPPED || is_convex(&flat) {
                triangles.extend((2..corners.len() as u32).map(|k| [0, k - 1, k]));
            } else {
                clip_ears(&flat, triangles);
            }
        }
    }
}

fn cut_quad([a, b, c, d]: [DVec3; 4], triangles: &mut Vec<[u32; 3]>) {
    let normal = (c - a).cross(d - b);
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal);
    let along_ac = area(a, b, c).min(area(a, c, d));
    let along_bd = area(a, b, d).min(area(b, c, d));
    let prefers_bd = if along_ac > 0.0 && along_bd > 0.0 {
        b.distance_squared(d) < a.distance_squared(c)
    } else {
        along_bd > along_ac
    };
    if prefers_bd {
        triangles.extend([[0, 1, 3], [1, 2, 3]]);
    } else {
        triangles.extend([[0, 1, 2], [0, 2, 3]]);
    }
}

/// The face in the plane across its mean normal (Newell's), counter-clockwise.
fn flattened(corners: &[DVec3]) -> Vec<DVec2> {
    let origin = corners[0];
    let normal: DVec3 = (1..corners.len() - 1)
        .map(|k| (corners[k] - origin).cross(corners[k + 1] - origin))
        .sum();
    let (u, v) = normal.normalize_or(DVec3::Z).any_orthonormal_pair();
    corners
        .iter()
        .map(|&p| DVec2::new((p - origin).dot(u), (p - origin).dot(v)))
        .collect()
}

fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - b)
}

fn is_convex(flat: &[DVec2]) -> bool {
    // All turns to the left also holds for a star that winds twice; only one that winds once has a single descent.
    let n = flat.len();
    let left = (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) > 0.0);
    let descents = (0..n)
        .filter(|&i| flat[(i + 1) % n].x >= flat[i].x && flat[(i + 2) % n].x < flat[(i + 1) % n].x)
        .count();
    left && descents == 1
}

/// Cuts off one ear after another; where rounding or crossing edges leave none, the sharpest left turn.
fn clip_ears(flat: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
    let mut ring: Vec<u32> = (0..flat.len() as u32).collect();
    let at = |v: u32| flat[v as usize];
    while ring.len() > 3 {
        let n = ring.len();
        let around = |i: usize| [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]];
        let is_ear = |i: usize| {
            let [a, b, c] = around(i);
            turn(at(a), at(b), at(c)) > 0.0
                && ring
                    .iter()
                    .filter(|&&v| ![at(a), at(b), at(c)].contains(&at(v)))
                    .all(|&v| !is_within(at(v), [at(a), at(b), at(c)]))
        };
        let sharpest = || {
            let measure = |i: &usize| {
                let [a, b, c] = around(*i).map(at);
                turn(a, b, c)
            };
            (0..n).max_by(|i, j| measure(i).total_cmp(&measure(j)))
        };
        let Some(ear) = (0..n).find(|&i| is_ear(i)).or_else(sharpest) else {
            return;
        };
        triangles.push(around(ear));
        ring.remove(ear);
    }
    triangles.push([ring[0], ring[1], ring[2]]);
}

fn is_within(p: DVec2, [a, b, c]: [DVec2; 3]) -> bool {
    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
        triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| corners[v as usize]);
                0.5 * (b - a).cross(c - a).z
            })
            .collect()
    }

    #[test]
    fn concave_faces_are_tiled_by_triangles_of_their_own_winding() {
        // An L, an arrow head (concave quad), and a comb; areas by counting squares.
        let faces: [(&[(f64, f64)], f64); 3] = [
            (
                &[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)],
                3.0,
            ),
            (&[(0., 0.), (2., 1.), (0., 2.), (1., 1.)], 1.0),
            (
                &[
                    (0., 0.),
                    (5., 0.),
                    (5., 2.),
                    (4., 2.),
                    (4., 1.),
                    (3., 1.),
                    (3., 2.),
                    (2., 2.),
                    (2., 1.),
                    (1., 1.),
                    (1., 2.),
                    (0., 2.),
                ],
                8.0,
            ),
        ];
        for (face, expected) in faces {
            let corners: Vec<DVec3> = face.iter().map(|&(x, y)| DVec3::new(x, y, 7.0)).collect();
            let mut triangles = Vec::new();
            triangulate(&corners, &mut triangles);
            let areas = area(&corners, &triangles);
            assert_eq!(triangles.len(), corners.len() - 2);
            assert!(areas.iter().all(|&a| a >= 0.0), "{areas:?}");
            assert!((areas.iter().sum::<f64>() - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn quads_are_cut_along_the_shorter_diagonal() {
        let kite = [(0., 0.), (1., -0.2), (4., 0.), (1., 0.2)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let mut triangles = Vec::new();
        triangulate(&kite, &mut triangles);
        assert_eq!(triangles, [[0, 1, 3], [1, 2, 3]]);
    }
}
