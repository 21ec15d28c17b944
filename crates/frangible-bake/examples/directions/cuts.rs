//! Cuts of a traced break.

use frangible::Asset;
use frangible::glam::Vec3;
use frangible::internals::CrackTrace;

/// One cut of a crack through a tetrahedron.
pub(crate) struct Cut {
    /// Area, m².
    pub(crate) area: f64,
    /// Direction of its trace in the plane of the pane, rad, 0 to π.
    pub(crate) angle: f64,
    /// Middle of the cut, m.
    pub(crate) middle: Vec3,
    /// Time of the cut, s.
    pub(crate) time: f64,
}

/// All cuts of a trace.
pub(crate) fn cuts<'a>(asset: &'a Asset, trace: &'a CrackTrace) -> impl Iterator<Item = Cut> + 'a {
    trace.cracks.iter().flatten().filter_map(|element| {
        let x = asset.fracture().corners(element.tet as usize);
        let s = element.values;
        let mut points = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
            if (s[i] < 0.0) != (s[j] < 0.0) {
                points.push(x[i] + (x[j] - x[i]) * (s[i] / (s[i] - s[j])));
            }
        }
        let middle = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
        let edges = [1, 2, 3].map(|k| x[k] - x[0]);
        let [a, b, c] = edges;
        let normal =
            (b.cross(c) * (s[1] - s[0]) + c.cross(a) * (s[2] - s[0]) + a.cross(b) * (s[3] - s[0]))
                .try_normalize()?;
        let normal = if a.cross(b).dot(c) < 0.0 {
            -normal
        } else {
            normal
        };
        // The area of a convex polygon whose corners come in any order: by the angle about its middle.
        let u = normal.any_orthonormal_vector();
        let v = normal.cross(u);
        let turn = |p: &Vec3| (*p - middle).dot(v).atan2((*p - middle).dot(u));
        points.sort_by(|p, q| turn(p).total_cmp(&turn(q)));
        let area: f32 = (0..points.len())
            .map(|k| {
                (points[k] - middle)
                    .cross(points[(k + 1) % points.len()] - middle)
                    .dot(normal)
            })
            .sum();
        let angle = f64::from((-normal.x).atan2(normal.y)).rem_euclid(std::f64::consts::PI);
        Some(Cut {
            area: 0.5 * f64::from(area.abs()),
            angle,
            middle,
            time: element.time,
        })
    })
}
