//! The lines of cracks in a plate, and counts of them.

use std::f64::consts::TAU;

use frangible::Asset;
use frangible::glam::DVec2;
use frangible::internals::CrackTrace;

/// Lines in which the cracks of a plate cut a plane parallel to its faces: one straight piece per fractured tetrahedron, m, in the body frame (its
/// origin, the middle of the plate, is where the plate is hit).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CrackPattern {
    /// Both ends of each piece; pieces of one crack share their ends.
    pub pieces: Vec<[DVec2; 2]>,
}

impl CrackPattern {
    /// The pattern of an impact at this height above the middle of a plate that lies across z, m.
    ///
    /// Take a height at which the mesh has no nodes: there a crack on the nodes would show twice, or not at all.
    #[must_use]
    pub fn of(asset: &Asset, trace: &CrackTrace, height: f64) -> Self {
        let cuts = trace.cracks.iter().flatten();
        let piece = |cut: &frangible::internals::ElementTrace| {
            let corners = asset.fracture().corners(cut.tet as usize);
            piece(
                corners.map(|c| c.as_dvec3().to_array()),
                cut.values.map(f64::from),
                height,
            )
        };
        Self {
            pieces: cuts.filter_map(piece).collect(),
        }
    }

    /// Both ends of each piece, mm, to a tenth.
    #[must_use]
    pub fn millimetres(&self) -> Vec<[f64; 4]> {
        let ends = |[a, b]: &[DVec2; 2]| [a.x, a.y, b.x, b.y].map(|x| (1e4 * x).round() / 10.0);
        self.pieces.iter().map(ends).collect()
    }

    /// Number of radial cracks that cross the circle of this radius about the middle, m: places where a piece that runs within 45° of the radius
    /// passes through it. Places less than `gap` m apart along the circle are one crack.
    #[must_use]
    pub fn crossings(&self, radius: f64, gap: f64) -> usize {
        let mut angles: Vec<f64> = self
            .pieces
            .iter()
            .filter(|[a, b]| (a.length() < radius) != (b.length() < radius) && is_radial(*a, *b))
            .map(|[a, b]| {
                let share = (radius - a.length()) / (b.length() - a.length());
                a.lerp(*b, share).to_angle()
            })
            .collect();
        angles.sort_by(f64::total_cmp);
        let Some(first) = angles.first() else {
            return 0;
        };
        let after = angles.iter().skip(1).copied().chain([first + TAU]);
        let apart = angles
            .iter()
            .zip(after)
            .filter(|(a, b)| (b - *a) * radius > gap);
        // A ring of places without a gap anywhere is one.
        apart.count().max(1)
    }

    /// Length of the cracks whose middle lies between two distances from the middle of the plate, m: those within 45° of the
    /// radius, and all.
    #[must_use]
    pub fn lengths(&self, nearest: f64, farthest: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for &[a, b] in &self.pieces {
            if (nearest..farthest).contains(&(0.5 * (a + b)).length()) {
                let length = a.distance(b);
                sums[1] += length;
                if is_radial(a, b) {
                    sums[0] += length;
                }
            }
        }
        sums
    }
}

/// Returns true if a piece runs within 45° of the radius at its middle.
fn is_radial(a: DVec2, b: DVec2) -> bool {
    let (along, out) = (b - a, a + b);
    along.dot(out).abs() > along.perp_dot(out).abs()
}

/// Line in which the plane at this height meets the crack, s = 0, in a tetrahedron; zero counts as positive, as in the crack.
fn piece(corners: [[f64; 3]; 4], values: [f64; 4], height: f64) -> Option<[DVec2; 2]> {
    const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];
    let above = |k: usize| corners[k][2] >= height;
    // On the edge between two corners: place and s. From the lower corner, so that both sides of a face agree.
    let on_edge = |i: usize, j: usize| {
        let (low, high) = if above(i) { (j, i) } else { (i, j) };
        let share = (height - corners[low][2]) / (corners[high][2] - corners[low][2]);
        let place = |k: usize| DVec2::new(corners[k][0], corners[k][1]);
        (
            place(low).lerp(place(high), share),
            values[low] + share * (values[high] - values[low]),
        )
    };
    let mut ends = Vec::with_capacity(2);
    for [i, j, k] in FACES {
        let edges = [[i, j], [j, k], [k, i]];
        let mut cut = edges.into_iter().filter(|&[i, j]| above(i) != above(j));
        if let (Some([i, j]), Some([k, l])) = (cut.next(), cut.next()) {
            let ((a, s), (b, t)) = (on_edge(i, j), on_edge(k, l));
            if (s >= 0.0) != (t >= 0.0) {
                ends.push(a.lerp(b, s / (s - t)));
            }
        }
    }
    ends.try_into().ok()
}

#[cfg(test)]
mod tests {
    use frangible::glam::DVec2;

    use super::piece;

    #[test]
    fn a_crack_meets_a_plane_along_a_line_that_neighbours_continue() {
        // Cut by the crack x + y = 0.6.
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.1, 0.2, 1.0]];
        let below = [
            [0.0, 0.0, 0.3],
            [1.0, 0.1, 0.4],
            [0.2, 1.0, 0.5],
            [0.3, 0.3, -1.0],
        ];
        let s = |c: &[f64; 3]| c[0] + c[1] - 0.6;
        let cut = |corners: [[f64; 3]; 4], height| piece(corners, corners.map(|c| s(&c)), height);
        for (corners, height) in [(corners, 0.2), (below, 0.2), (below, 0.35)] {
            let [a, b] = cut(corners, height).unwrap();
            assert!((a.x + a.y - 0.6).abs() < 1e-12 && (b.x + b.y - 0.6).abs() < 1e-12);
            assert!(a.distance(b) > 0.1);
        }
        assert_eq!(cut(corners, 1.5), None, "above the tetrahedron");
        assert_eq!(piece(corners, [1.0; 4], 0.2), None, "no crack in it");
        // The same face in another order of corners: the same end.
        let other = [corners[3], corners[1], corners[0], [0.5, -1.0, 0.5]];
        let [a, b] = cut(corners, 0.2).unwrap();
        let [c, d] = cut(other, 0.2).unwrap();
        let same = |p: DVec2, q: DVec2| p.distance(q) < 1e-12;
        let shared = [(a, c), (a, d), (b, c), (b, d)];
        assert_eq!(shared.into_iter().filter(|(p, q)| same(*p, *q)).count(), 1);
    }
}
