//! Random places in a body.

use frangible::glam::{DVec3, Vec3};
use frangible::internals::TetMesh;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Draws places in a mesh with a density of its own in each tetrahedron.
pub(crate) struct Draws<'a> {
    mesh: &'a TetMesh,
    /// Σ of the weights up to and with each tetrahedron.
    sums: Vec<f64>,
    rng: ChaCha8Rng,
}

impl<'a> Draws<'a> {
    /// `density`: of each tetrahedron, per volume, in any unit; not negative. None where it is zero everywhere.
    pub(crate) fn new(
        mesh: &'a TetMesh,
        density: impl Fn(usize) -> f64,
        seed: u64,
        stream: u64,
    ) -> Option<Self> {
        let mut sum = 0.0;
        let sums: Vec<f64> = (0..mesh.tets.len())
            .map(|e| {
                sum += density(e) * mesh.volume(e);
                sum
            })
            .collect();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        (sum.is_finite() && sum > 0.0).then_some(Self { mesh, sums, rng })
    }

    /// Uniform in [0, 1).
    fn uniform(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A place: a tetrahedron by its weight, a point of it, m.
    pub(crate) fn place(&mut self) -> DVec3 {
        let total = self.sums.last().copied().unwrap_or(0.0);
        let at = self.uniform() * total;
        let tet = self.sums.partition_point(|&sum| sum <= at);
        let tet = tet.min(self.sums.len() - 1);
        // Distances between three sorted numbers, and of them to the ends, are uniform barycentric coordinates.
        let mut cuts = [self.uniform(), self.uniform(), self.uniform()];
        cuts.sort_by(f64::total_cmp);
        let [a, b, c] = cuts;
        let corners = self.mesh.corners(tet).map(Vec3::as_dvec3);
        let shares = [a, b - a, c - b, 1.0 - c];
        corners
            .iter()
            .zip(shares)
            .map(|(&x, share)| x * share)
            .sum()
    }
}
