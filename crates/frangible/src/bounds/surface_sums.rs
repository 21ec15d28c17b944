//! Motion of the surface with each mode, summed with weights: a table of numbers per vertex of the surface.

use glam::Vec3;

use crate::asset::{Asset, carriers};
use crate::mesh::SurfacePoint;
use crate::stress::dot;

/// Σ_i |φ_i| r_i at each vertex of the surface, for rows r of one number per mode; zero at vertices without a triangle.
pub(crate) fn surface_sums<const N: usize>(asset: &Asset, rows: &[Vec<f32>; N]) -> Vec<[f32; N]> {
    let mut sums = vec![[0.0_f32; N]; asset.surface_positions().len()];
    if asset.modes.count() > 0 {
        at_nodes(asset, rows, &mut sums);
    }
    sums
}

widest! {
    /// The sums at all nodes of the surface.
    fn at_nodes[const N: usize](asset: &Asset, rows: &[Vec<f32>; N], sums: &mut [[f32; N]]) {
        let mut shapes = Shapes::new(rows[0].len());
        let mut known = vec![false; sums.len()];
        for (triangle, corners) in asset.surface.triangles.iter().enumerate() {
            for (k, &node) in corners.iter().enumerate() {
                if known[node as usize] {
                    continue;
                }
                known[node as usize] = true;
                shapes.find(asset, triangle as u32, k);
                // A loop, not a map: its closure would not be compiled for the wider vectors.
                for (sum, row) in sums[node as usize].iter_mut().zip(rows) {
                    *sum = dot(&shapes.lengths, row);
                }
            }
        }
    }
}

/// The mode shapes at a corner of the surface.
struct Shapes {
    /// φ_x, φ_y, φ_z of every mode, 1/√kg.
    axes: [Vec<f32>; 3],
    /// |φ|.
    lengths: Vec<f32>,
}

impl Shapes {
    fn new(modes: usize) -> Self {
        Self {
            axes: std::array::from_fn(|_| vec![0.0; modes]),
            lengths: vec![0.0; modes],
        }
    }

    /// Finds the shapes at a triangle's corner.
    #[inline(always)]
    fn find(&mut self, asset: &Asset, triangle: u32, corner: usize) {
        self.axes.iter_mut().for_each(|axis| axis.fill(0.0));
        let mut weights = [0.0; 3];
        weights[corner] = 1.0;
        let at = SurfacePoint {
            triangle,
            weights,
            position: Vec3::ZERO,
        };
        let (carriers, count) = carriers(asset, &at);
        for &(node, weight) in carriers[..count].iter().filter(|c| c.1 != 0.0) {
            let rows = asset.modes.rows(node as usize);
            for (sums, row) in self.axes.iter_mut().zip(rows) {
                for (sum, &phi) in sums.iter_mut().zip(row) {
                    *sum += weight * phi;
                }
            }
        }
        let [x, y, z] = &self.axes;
        for (((length, x), y), z) in self.lengths.iter_mut().zip(x).zip(y).zip(z) {
            *length = (x * x + y * y + z * z).sqrt();
        }
    }
}
