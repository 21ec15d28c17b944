//! Location of points in the analysis mesh: element and barycentric coordinates.

use frangible::glam::DVec3;
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::mesh::closest_on_triangle;

use crate::error::BakeError;
use crate::fem::QuadraticMesh;
use crate::mesh::barycentric_gradients;

/// A uniform grid over the elements of an analysis mesh, for point location.
///
/// Points just outside are mapped to the closest point of the nearest element. A distance above a quarter of that element's mean
/// edge length is an error, since the displacement would be extrapolated too far.
#[derive(Clone, Debug)]
pub struct Locator {
    corners: Vec<[DVec3; 4]>,
    gradients: Vec<[DVec3; 4]>,
    reach: Vec<f64>,
    origin: DVec3,
    cell: f64,
    counts: [usize; 3],
    /// Elements of grid cell c: `items[starts[c]..starts[c + 1]]`, in ascending order.
    starts: Vec<usize>,
    items: Vec<u32>,
}

/// Barycentric coordinates this little below zero still count as inside.
const INSIDE: f64 = -1e-9;
/// Allowed distance outside, as a share of the nearest element's mean edge.
const REACH: f64 = 0.25;

impl Locator {
    /// Builds the grid for a mesh.
    #[must_use]
    pub fn new(mesh: &QuadraticMesh) -> Self {
        let corners: Vec<[DVec3; 4]> = (0..mesh.elements.len()).map(|e| mesh.corners(e)).collect();
        let reach: Vec<f64> = corners.iter().map(|x| REACH * mean_edge(x)).collect();
        let bounds = |e: usize| {
            let (low, high) = corners[e]
                .iter()
                .fold((corners[e][0], corners[e][0]), |(l, h), &x| {
                    (l.min(x), h.max(x))
                });
            (low - reach[e], high + reach[e])
        };
        let everything = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = (0..corners.len())
            .map(bounds)
            .fold(everything, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let cell = reach.iter().sum::<f64>() / (REACH * corners.len().max(1) as f64);
        let size = (high - low).max(DVec3::ZERO);
        let counts = size
            .to_array()
            .map(|s| ((s / cell).ceil() as usize).clamp(1, 256));
        let mut grid = Self {
            gradients: corners.iter().map(|&x| barycentric_gradients(x)).collect(),
            origin: low,
            // The cap on the counts must not leave the far end out.
            cell: (0..3).fold(cell, |c, k| c.max(size[k] / counts[k] as f64)),
            counts,
            starts: Vec::new(),
            items: Vec::new(),
            corners: Vec::new(),
            reach: Vec::new(),
        };
        let mut entries: Vec<(u32, u32)> = Vec::new();
        for e in 0..corners.len() {
            let (low, high) = bounds(e);
            let (a, b) = (grid.coordinates(low), grid.coordinates(high));
            for i in a[0]..=b[0] {
                for j in a[1]..=b[1] {
                    entries.extend((a[2]..=b[2]).map(|k| (grid.index([i, j, k]) as u32, e as u32)));
                }
            }
        }
        entries.sort_unstable();
        let cells = counts.iter().product::<usize>() as u32;
        grid.starts = (0..=cells)
            .map(|c| entries.partition_point(|x| x.0 < c))
            .collect();
        grid.items = entries.into_iter().map(|x| x.1).collect();
        (grid.corners, grid.reach) = (corners, reach);
        grid
    }

    fn coordinates(&self, p: DVec3) -> [usize; 3] {
        std::array::from_fn(|k| {
            (((p[k] - self.origin[k]) / self.cell).max(0.0) as usize).min(self.counts[k] - 1)
        })
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.counts[1] + j) * self.counts[2] + k
    }

    fn barycentric(&self, e: usize, p: DVec3) -> [f64; 4] {
        let from_first = p - self.corners[e][0];
        let l: [f64; 4] = std::array::from_fn(|k| self.gradients[e][k].dot(from_first));
        [1.0 - l[1] - l[2] - l[3], l[1], l[2], l[3]]
    }

    /// Returns the element, the barycentric coordinates and the offset (m) of a point, in f64.
    ///
    /// # Errors
    /// [`BakeError::OutsideAnalysisMesh`] when no element is near enough.
    pub fn locate(&self, p: DVec3) -> Result<(usize, [f64; 4], DVec3), BakeError> {
        let outside = || BakeError::OutsideAnalysisMesh {
            x: p.x,
            y: p.y,
            z: p.z,
        };
        if !p.is_finite() {
            return Err(outside());
        }
        let cell = self.index(self.coordinates(p));
        let candidates = &self.items[self.starts[cell]..self.starts[cell + 1]];
        for &e in candidates {
            let l = self.barycentric(e as usize, p);
            if l.iter().all(|&x| x >= INSIDE) {
                return Ok((e as usize, l, DVec3::ZERO));
            }
        }
        let mut best: Option<(f64, usize, [f64; 4], DVec3)> = None;
        for &e in candidates {
            let e = e as usize;
            let l = closest_in_tet(&self.corners[e], self.barycentric(e, p), p);
            let closest: DVec3 = (0..4).map(|k| l[k] * self.corners[e][k]).sum();
            let distance = p.distance(closest);
            if distance <= self.reach[e] && best.is_none_or(|b| distance < b.0) {
                best = Some((distance, e, l, p - closest));
            }
        }
        best.map(|(_, e, l, offset)| (e, l, offset))
            .ok_or_else(outside)
    }

    /// Locates a point and returns the result in the format of the asset.
    ///
    /// # Errors
    /// [`BakeError::OutsideAnalysisMesh`] when no element is near enough.
    pub fn embed(&self, p: DVec3) -> Result<EmbeddedPoint, BakeError> {
        let (element, barycentric, offset) = self.locate(p)?;
        Ok(EmbeddedPoint {
            element: element as u32,
            barycentric: barycentric.map(|x| x as f32),
            offset: offset.as_vec3(),
        })
    }
}

fn mean_edge(x: &[DVec3; 4]) -> f64 {
    let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    pairs.iter().map(|&[i, j]| x[i].distance(x[j])).sum::<f64>() / 6.0
}

/// Barycentric coordinates of the point of a tetrahedron closest to `p`, which lies outside it.
fn closest_in_tet(x: &[DVec3; 4], l: [f64; 4], p: DVec3) -> [f64; 4] {
    let mut best = (f64::INFINITY, [0.0; 4]);
    for k in 0..4 {
        // The closest point lies on a face that the point is beyond.
        if l[k] < 0.0 {
            let face = [(k + 1) % 4, (k + 2) % 4, (k + 3) % 4];
            let weights = closest_on_triangle(face.map(|i| x[i]), p);
            let distance = p.distance_squared((0..3).map(|i| weights[i] * x[face[i]]).sum());
            if distance < best.0 {
                let mut out = [0.0; 4];
                (0..3).for_each(|i| out[face[i]] = weights[i]);
                best = (distance, out);
            }
        }
    }
    best.1
}
