//! Cuts a tetrahedron along the planes of the lattice.

use frangible::glam::DVec3;

use crate::fem::cover::lattice::{Cell, PLANES};
use crate::mesh::tet_volume;

/// Corners this near a plane lie on it, in cube sides: far above rounding, far below any element.
const ON_PLANE: f64 = 1e-9;
/// Parts smaller than this are dropped, in cubes: rounding.
const NOTHING: f64 = 1e-18;

/// Lists for [`cut`], kept from one call to the next.
#[derive(Default)]
pub(crate) struct Parts {
    now: Vec<[DVec3; 4]>,
    next: Vec<[DVec3; 4]>,
}

/// Calls `each` with the parts of a tetrahedron, all lengths in cube sides: cell, corners, volume. The parts
/// are tetrahedra of either handedness that tile it.
pub(crate) fn cut(x: [DVec3; 4], parts: &mut Parts, each: &mut dyn FnMut(Cell, [DVec3; 4], f64)) {
    parts.now.clear();
    parts.now.push(x);
    for normal in PLANES {
        let heights = x.map(|p| normal.dot(p));
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut level = (low + ON_PLANE).ceil();
        while level < high - ON_PLANE {
            parts.next.clear();
            for &part in &parts.now {
                split(part, part.map(|p| normal.dot(p) - level), &mut parts.next);
            }
            std::mem::swap(&mut parts.now, &mut parts.next);
            level += 1.0;
        }
    }
    for &part in &parts.now {
        let volume = tet_volume(part).abs();
        if volume > NOTHING {
            each(Cell::at(part.iter().sum::<DVec3>() / 4.0), part, volume);
        }
    }
}

/// Splits a tetrahedron by the plane that its corners lie `d` above.
fn split(x: [DVec3; 4], d: [f64; 4], out: &mut Vec<[DVec3; 4]>) {
    let above = |i: &usize| d[*i] > ON_PLANE;
    let below = |i: &usize| d[*i] < -ON_PLANE;
    let (ups, downs) = ((0..4).filter(above).count(), (0..4).filter(below).count());
    // Point at which the plane meets an edge; a corner on the plane is its own crossing.
    let crossing = |i: usize, j: usize| {
        if d[j].abs() <= ON_PLANE {
            x[j]
        } else {
            x[i] + (d[i] / (d[i] - d[j])) * (x[j] - x[i])
        }
    };
    if ups == 0 || downs == 0 {
        out.push(x);
    } else if ups == 2 && downs == 2 {
        let pair = |side: &dyn Fn(&usize) -> bool| {
            let mut corners = (0..4).filter(side);
            // Two of each, as counted above.
            [corners.next().unwrap_or(0), corners.next().unwrap_or(0)]
        };
        let ([a, b], [c, e]) = (pair(&below), pair(&above));
        let (ac, ae, bc, be) = (
            crossing(a, c),
            crossing(a, e),
            crossing(b, c),
            crossing(b, e),
        );
        prism([x[a], ac, ae], [x[b], bc, be], out);
        prism([x[c], ac, bc], [x[e], ae, be], out);
    } else {
        // One corner is alone on its side.
        let alone: &dyn Fn(&usize) -> bool = if downs == 1 { &below } else { &above };
        let apex = (0..4).find(alone).unwrap_or(0);
        let rest = [(apex + 1) % 4, (apex + 2) % 4, (apex + 3) % 4];
        let cuts = rest.map(|i| crossing(apex, i));
        out.push([x[apex], cuts[0], cuts[1], cuts[2]]);
        prism(cuts, rest.map(|i| x[i]), out);
    }
}

/// Three tetrahedra of a prism with corresponding corners p and q; without those that have no volume since
/// corresponding corners coincide.
fn prism(p: [DVec3; 3], q: [DVec3; 3], out: &mut Vec<[DVec3; 4]>) {
    if p[2] != q[2] {
        out.push([p[0], p[1], p[2], q[2]]);
    }
    if p[1] != q[1] {
        out.push([p[0], p[1], q[1], q[2]]);
    }
    if p[0] != q[0] {
        out.push([p[0], q[0], q[1], q[2]]);
    }
}

#[cfg(test)]
mod tests {
    use super::{Parts, cut};
    use crate::mesh::tet_volume;
    use crate::random;
    use frangible::glam::DVec3;

    #[test]
    fn parts_tile_the_tetrahedron_and_stay_in_their_cells() {
        let mut parts = Parts::default();
        for i in 0..2000_u64 {
            // Every third one has corners on the planes.
            let snap = |v: f64| {
                if i % 3 == 0 {
                    (2.0 * v).round() / 2.0
                } else {
                    v
                }
            };
            let x: [DVec3; 4] = std::array::from_fn(|c| {
                DVec3::from_array(
                    [0, 1, 2].map(|k| snap(1.5 * random::symmetric(9, 12 * i + 3 * c as u64 + k))),
                )
            });
            let mut sum = 0.0;
            let mut moment = DVec3::ZERO;
            cut(x, &mut parts, &mut |cell, part, volume| {
                sum += volume;
                moment += volume * part.iter().sum::<DVec3>() / 4.0;
                for p in part {
                    let l = cell.frame().barycentric(p);
                    assert!(l.iter().all(|&l| l > -1e-8), "{l:?}");
                }
            });
            let volume = tet_volume(x).abs();
            assert!((sum - volume).abs() < 1e-13, "{sum} of {volume}");
            let centroid = x.iter().sum::<DVec3>() / 4.0;
            assert!((moment - volume * centroid).length() < 1e-13);
        }
    }
}
