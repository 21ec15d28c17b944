//! Voronoi cells around the impact point, as in most tools for artists. No stress, no energy, no material.
//!
//! Sites are drawn in the body with a density that falls as exp(−d / ℓ) with the distance d from the impact point, ℓ a quarter of
//! the largest distance there is. Their number is the caller's; [`compare`](crate::compare) takes as many as ours has pieces, two
//! at least. A cell that hangs together in several parts leaves several pieces, one that holds no node of the mesh none.

use frangible::Body;
use frangible::glam::{DVec3, Vec3};
use frangible::internals::TetMesh;

use super::divide::Division;
use super::draws::Draws;
use super::error::CompareError;
use super::hit::Hit;

/// Largest distance from the impact point over the length ℓ in which the density of sites falls to 1/e.
const FALL: f64 = 4.0;

/// Stream of random numbers of this method's sites.
const STREAM: u64 = 1;

/// Sites of a Voronoi diagram, m.
pub(crate) struct Sites(pub(crate) Vec<DVec3>);

impl Sites {
    /// Number of the nearest site to a point, the lowest of equals.
    fn nearest(&self, p: DVec3) -> u32 {
        let distances = self.0.iter().map(|site| site.distance_squared(p));
        let nearest = (0..).zip(distances).min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.map_or(0, |(i, _)| i)
    }

    /// Position at which the way from `a`, in the cell of site `i`, to `b`, in that of site `j`, crosses the plane between both: 0 at `a`, 1 at `b`.
    fn crossing(&self, [a, b]: [DVec3; 2], [i, j]: [u32; 2]) -> f64 {
        // |x − s_i|² − |x − s_j|² is linear in x.
        let (si, sj) = (self.0[i as usize], self.0[j as usize]);
        let difference = |x: DVec3| x.distance_squared(sj) - x.distance_squared(si);
        let (at_a, at_b) = (difference(a), difference(b));
        match at_a - at_b {
            span if span > 0.0 => at_a / span,
            _ => 0.5,
        }
    }

    /// The body divided among the cells.
    pub(crate) fn divide<'a>(&self, body: &'a Body) -> Result<Division<'a>, CompareError> {
        let mesh: &TetMesh = body.asset().fracture();
        let place = |node: u32| mesh.positions[node as usize].as_dvec3();
        let nodes = 0..mesh.positions.len() as u32;
        let cells: Vec<u32> = nodes.map(|node| self.nearest(place(node))).collect();
        let cell = cells.clone();
        Division::new(body, cells, |a, b| {
            self.crossing([place(a), place(b)], [cell[a as usize], cell[b as usize]])
        })
    }
}

/// This many sites around the impact point.
pub(crate) fn sites_around(hit: Hit<'_>, count: usize, seed: u64) -> Sites {
    let mesh = hit.body.asset().fracture();
    let centre = hit.point();
    let far = |p: &Vec3| p.as_dvec3().distance(centre);
    let reach = mesh.positions.iter().map(far).fold(0.0, f64::max);
    let density = |tet: usize| (-FALL * far(&mesh.centroid(tet)) / reach).exp();
    let draws = Draws::new(mesh, density, seed, STREAM);
    Sites(draws.map_or_else(Vec::new, |mut draws| {
        (0..count).map(|_| draws.place()).collect()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_crossing_is_as_far_from_both_sites() {
        let sites = Sites(vec![DVec3::new(0.1, 0.2, -0.3), DVec3::new(1.4, -0.7, 0.9)]);
        let ends = [DVec3::new(0.0, 0.1, 0.05), DVec3::new(1.0, -1.0, 0.4)];
        assert_eq!(ends.map(|p| sites.nearest(p)), [0, 1]);
        let t = sites.crossing(ends, [0, 1]);
        let p = ends[0].lerp(ends[1], t);
        assert!((p.distance(sites.0[0]) - p.distance(sites.0[1])).abs() < 1e-14);
        // From the other end it is the same place.
        let back = sites.crossing([ends[1], ends[0]], [1, 0]);
        assert!((t + back - 1.0).abs() < 1e-14);
    }
}
