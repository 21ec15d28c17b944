//! Upper bounds of the stress from the modal amplitudes alone, by which a contact is refused unseen (beyond the paper).
//!
//! With `s_i` the spectral norm of mode i's linear stress at a tetrahedron and `g_i` a norm of its displacement gradient,
//! the largest principal tension of Green–Lagrange strain and Hooke's law is at any time at most
//! `Σ|q_i| s_i + ½ k (Σ|q_i| g_i)²`, k = max(3λ, 0) + 2μ (λ, μ Lamé's parameters). Maxima of s and g over a cluster of
//! tetrahedra bound all of them. The maxima contain what the rounding of the run time's f32 can add, so a cluster whose
//! bound stays below the strength holds no crack, exactly: results with and without the bounds are the same bits.
//! The Frobenius norm serves for g: it is never below the spectral norm, and its term is small.
//!
//! Stress is looked at where it may be asked for: at each tetrahedron's centre, with the traction across a wall and without it, and at the corners
//! of the face on the free surface that has its flaw, without ([`Skin`]). The whole face is seen by one element, whose strain is linear, so that no
//! place of the face has more of any mode, and of its rounding, than a corner. A piece's flaws are settled. Without traction Hooke's law has
//! λ* = 2λμ/(λ + 2μ) and the strain in the surface has two principal values, so the quadratic term is at most ½ (2 max(λ*, 0) + 2μ) g², and
//! 2λ* < 3λ where λ is positive: the same k bounds both. At an edge Young's modulus serves, which is below k too.

use glam::Vec3;

use crate::asset::{Asset, EmbeddedPoint, StressBounds};
use crate::material::Material;
use crate::mesh::TetMesh;
use crate::stress::{BATCH, Elasticity, Lanes, Law, Places, Skin, Wide};

/// Largest number of tetrahedra of a cluster.
const CLUSTER: usize = 256;

/// Rounding of u = Φ q and of its gradient in f32, relative to the sum of the absolute values of all terms: twenty
/// times ε/2 = 6e-8, since the errors of a sum of n terms grow as √n, and n is about a hundred.
const ROUNDING: f32 = 1.2e-6;

/// Weights of a face's corners at each of them.
const CORNERS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl StressBounds {
    /// Finds the bounds of an asset from its other arrays.
    #[must_use]
    pub fn of(asset: &Asset) -> Self {
        Self::with_skin(asset, &Skin::of(asset), None).0
    }

    /// Finds the bounds of an asset whose skin is known, and the peak stress of its modes, Pa per m·√kg: that of the tetrahedra's centres and
    /// the middles of their free faces. `places`: where its flaws are, if that is settled.
    pub(crate) fn with_skin(
        asset: &Asset,
        skin: &Skin,
        places: Option<&Places>,
    ) -> (Self, Vec<f32>) {
        let numbers: Vec<usize> = asset.tets().collect();
        let (cluster_of_tet, clusters) = clusters(&asset.fracture, &numbers);
        let m = asset.modes.count();
        let mut bounds = Self {
            cluster_of_tet,
            stress: vec![0.0; clusters * m],
            gradient: vec![0.0; clusters * m],
        };
        let mut rows = Rows::new(m, &asset.material);
        let on_face = |rows: &mut Rows, bounds: &mut Self, place: usize, weights: &[[f32; 3]]| {
            let Some(flaw) = skin.flaw(place) else { return };
            let wall = skin.wall(asset, numbers[place]);
            let along = wall.and_then(|wall| wall.edge(flaw.normal));
            let laws = [Some(Law::Free(flaw.normal)), along.map(Law::Edge)];
            for &weights in weights {
                let (_, point) = Skin::on_face(asset, flaw, weights);
                raise(rows, bounds, place, asset, &point, laws);
            }
        };
        for (place, (&tet, point)) in numbers.iter().zip(&asset.embedding.tets).enumerate() {
            let wall = skin.wall(asset, tet);
            let laws = [Some(Law::Solid), wall.map(|wall| Law::Free(wall.normal))];
            raise(&mut rows, &mut bounds, place, asset, point, laws);
            on_face(&mut rows, &mut bounds, place, &[Places::MIDDLE]);
        }
        let peak_stress = bounds.root(m).0;
        for (place, &tet) in numbers.iter().enumerate() {
            match places {
                Some(places) => on_face(&mut rows, &mut bounds, place, &[places.weights(tet)]),
                None => on_face(&mut rows, &mut bounds, place, &CORNERS),
            }
        }
        (bounds, peak_stress)
    }
}

impl Asset {
    /// The asset with its stress bounds and the peak stress of its modes found anew, as the bake does: for one whose
    /// mode shapes were changed.
    #[must_use]
    pub fn restressed(mut self) -> Self {
        let (bounds, peak_stress) = StressBounds::with_skin(&self, &Skin::of(&self), None);
        (self.bounds, self.modes.peak_stress) = (bounds, peak_stress);
        self
    }
}

/// k of the quadratic term, Pa: max(3λ, 0) + 2μ.
pub(crate) fn quadratic_modulus(material: &Material) -> f32 {
    ((3.0 * material.lame_lambda()).max(0.0) + 2.0 * material.shear_modulus()) as f32
}

/// Σ|q_i| s_i + ½ k (Σ|q_i| g_i)², Pa, summed in a fixed order over eight lanes: call it from a place that `pulp` dispatches
/// where many are wanted.
#[inline(always)]
pub(crate) fn tension_bound(amplitudes: &[f32], stress: &[f32], gradient: &[f32], k: f32) -> f32 {
    let s = sum_of_sizes(amplitudes, stress);
    if k == 0.0 {
        return s;
    }
    let g = sum_of_sizes(amplitudes, gradient);
    s + 0.5 * k * g * g
}

/// Σ|q_i| r_i.
#[inline(always)]
fn sum_of_sizes(amplitudes: &[f32], row: &[f32]) -> f32 {
    const LANES: usize = 8;
    let ((amplitudes, tail), (row, row_tail)) =
        (amplitudes.as_chunks::<LANES>(), row.as_chunks::<LANES>());
    let mut sums = [0.0_f32; LANES];
    for (q, r) in amplitudes.iter().zip(row) {
        for i in 0..LANES {
            sums[i] += q[i].abs() * r[i];
        }
    }
    for ((sum, q), r) in sums.iter_mut().zip(tail).zip(row_tail) {
        *sum += q.abs() * r;
    }
    sums.iter().sum()
}

/// [`tension_bound`] at each step of a batch, bit by bit, from the size of each mode's amplitude at each step, m·√kg, none below zero.
#[inline(always)]
pub(crate) fn tension_bounds(sizes: &[Lanes], stress: &[f32], gradient: &[f32], k: f32) -> Lanes {
    let mut bounds = sums_of_sizes(sizes, stress);
    if k != 0.0 {
        let sums = sums_of_sizes(sizes, gradient);
        for (bound, g) in bounds.iter_mut().zip(sums) {
            *bound += 0.5 * k * g * g;
        }
    }
    bounds
}

/// Σ|q_i| r_i at each step, in the order of [`sum_of_sizes`].
#[inline(always)]
fn sums_of_sizes(sizes: &[Lanes], row: &[f32]) -> Lanes {
    let ((sizes, tail), (row, row_tail)) = (sizes.as_chunks::<8>(), row.as_chunks::<8>());
    let mut all = Wide::default();
    // Four sums at a time stay in registers.
    for first in [0, 4] {
        let zero = Wide::default();
        let [mut a, mut b, mut c, mut d] = [zero, zero, zero, zero];
        for (q, r) in sizes.iter().zip(row) {
            a = a.plus(r[first], &q[first]);
            b = b.plus(r[first + 1], &q[first + 1]);
            c = c.plus(r[first + 2], &q[first + 2]);
            d = d.plus(r[first + 3], &q[first + 3]);
        }
        let mut sums = [a, b, c, d];
        let tail = tail.iter().zip(row_tail).skip(first);
        for (sum, (q, r)) in sums.iter_mut().zip(tail) {
            *sum = sum.plus(*r, q);
        }
        for sum in sums {
            all = all + sum;
        }
    }
    all.0
}

/// Gradients of all modes at one place, sixteen modes side by side.
struct Rows {
    /// ∂u_row/∂x_column, row after row.
    gradient: Vec<[Lanes; 9]>,
    /// Σ |φ| |∇N|, to which rounding is relative.
    terms: Vec<Lanes>,
    /// k of the quadratic term, Pa.
    modulus: f32,
    elasticity: Elasticity,
}

impl Rows {
    fn new(modes: usize, material: &Material) -> Self {
        let chunks = modes.div_ceil(BATCH);
        Self {
            gradient: vec![[Lanes::default(); 9]; chunks],
            terms: vec![Lanes::default(); chunks],
            modulus: quadratic_modulus(material),
            elasticity: Elasticity::new(material),
        }
    }

    #[inline(always)]
    fn find(&mut self, asset: &Asset, point: &EmbeddedPoint) {
        let element = point.element as usize;
        let weights = point.shape_gradients(&asset.analysis.barycentric_gradients[element]);
        let nodes = &asset.analysis.elements[element];
        for (chunk, (gradient, terms)) in self.gradient.iter_mut().zip(&mut self.terms).enumerate()
        {
            (*gradient, *terms) = ([Lanes::default(); 9], Lanes::default());
            for n in 0..nodes.len() {
                let g = weights[n];
                let size = g.abs().element_sum();
                let rows = asset.modes.rows(nodes[n] as usize);
                for row in 0..3 {
                    let mut phi = Lanes::default();
                    let own = &rows[row][chunk * BATCH..];
                    let own = &own[..own.len().min(BATCH)];
                    phi[..own.len()].copy_from_slice(own);
                    let [x, y, z] = [3 * row, 3 * row + 1, 3 * row + 2];
                    for k in 0..BATCH {
                        terms[k] += phi[k].abs() * size;
                        gradient[x][k] += phi[k] * g.x;
                        gradient[y][k] += phi[k] * g.y;
                        gradient[z][k] += phi[k] * g.z;
                    }
                }
            }
        }
    }

    /// Raises the bounds of the cluster of the tetrahedron at a place to this point's values by a law.
    #[inline(always)]
    fn raise(&self, bounds: &mut StressBounds, place: usize, modes: usize, law: Law) {
        let cluster = bounds.cluster_of_tet[place] as usize;
        let row = cluster * modes..(cluster + 1) * modes;
        let stress = bounds.stress[row.clone()].chunks_mut(BATCH);
        let norms = bounds.gradient[row].chunks_mut(BATCH);
        let known = self.gradient.iter().zip(&self.terms);
        for ((g, terms), (stress, norms)) in known.zip(stress.zip(norms)) {
            let at = |k: usize| Wide(g[k]);
            let allowance = Wide(*terms) * ROUNDING;
            let mut squares = at(0) * at(0);
            for k in 1..9 {
                squares = squares + at(k) * at(k);
            }
            let frobenius = squares.sqrt() + allowance;
            for (norm, new) in norms.iter_mut().zip(frobenius.0) {
                *norm = norm.max(new);
            }
            let strain = [
                at(0),
                at(4),
                at(8),
                (at(1) + at(3)) * 0.5,
                (at(5) + at(7)) * 0.5,
                (at(6) + at(2)) * 0.5,
            ];
            let s @ [xx, yy, zz, xy, yz, zx] = self.elasticity.linear(&strain, law);
            // The Frobenius norm is never below the spectral norm: nearly all tetrahedra end here.
            let squares = xx * xx + yy * yy + zz * zz + (yz * yz + zx * zx + xy * xy) * 2.0;
            let allowance = allowance * self.modulus;
            let most = squares.sqrt() + allowance;
            for (k, bound) in stress.iter_mut().enumerate() {
                if most.0[k] > *bound {
                    let [xx, yy, zz, xy, yz, zx] = s.each_ref().map(|s| f64::from(s.0[k]));
                    let norm = spectral_norm([xx, yy, zz, yz, zx, xy]) as f32 * (1.0 + 1e-6);
                    *bound = bound.max(norm + allowance.0[k]);
                }
            }
        }
    }
}

widest! {
    /// Raises the bounds of the cluster of the tetrahedron at a place to the values of a point by some laws.
    fn raise(
        rows: &mut Rows,
        bounds: &mut StressBounds,
        place: usize,
        asset: &Asset,
        point: &EmbeddedPoint,
        laws: [Option<Law>; 2],
    ) {
        rows.find(asset, point);
        for law in laws.into_iter().flatten() {
            rows.raise(bounds, place, asset.modes.count(), law);
        }
    }
}

/// Largest absolute eigenvalue of a symmetric 3 × 3 matrix (xx, yy, zz, yz, zx, xy), by the trigonometric solution of
/// its characteristic cubic.
fn spectral_norm([xx, yy, zz, yz, zx, xy]: [f64; 6]) -> f64 {
    let mean = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - mean, yy - mean, zz - mean);
    let p = ((a * a + b * b + c * c + 2.0 * (yz * yz + zx * zx + xy * xy)) / 6.0).sqrt();
    if p == 0.0 {
        return mean.abs();
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
    let angle = libm::acos((determinant / (2.0 * p * p * p)).clamp(-1.0, 1.0)) / 3.0;
    let largest = mean + 2.0 * p * libm::cos(angle);
    let smallest = mean + 2.0 * p * libm::cos(angle + std::f64::consts::TAU / 3.0);
    largest.abs().max(smallest.abs())
}

/// Halves the tetrahedra along the longest side of their box until none has more than [`CLUSTER`]: number of the
/// cluster of each, and number of clusters.
fn clusters(mesh: &TetMesh, tets: &[usize]) -> (Vec<u32>, usize) {
    let centroids: Vec<Vec3> = tets.iter().map(|&e| mesh.centroid(e)).collect();
    let mut order: Vec<u32> = (0..tets.len() as u32).collect();
    let mut of_tet = vec![0; tets.len()];
    let mut count = 0;
    let mut parts = Vec::new();
    parts.push(0..order.len());
    while let Some(part) = parts.pop() {
        let tets = &mut order[part.clone()];
        if tets.len() <= CLUSTER {
            if !tets.is_empty() {
                tets.iter().for_each(|&e| of_tet[e as usize] = count);
                count += 1;
            }
            continue;
        }
        let at = |e: u32| centroids[e as usize];
        let low = tets.iter().fold(Vec3::INFINITY, |a, &e| a.min(at(e)));
        let high = tets.iter().fold(Vec3::NEG_INFINITY, |a, &e| a.max(at(e)));
        let axis = (high - low).max_position();
        let middle = tets.len() / 2;
        tets.select_nth_unstable_by(middle, |&a, &b| {
            at(a)[axis].total_cmp(&at(b)[axis]).then(a.cmp(&b))
        });
        parts.push(part.start + middle..part.end);
        parts.push(part.start..part.start + middle);
    }
    (of_tet, count as usize)
}

#[cfg(test)]
mod tests {
    use super::{spectral_norm, tension_bound, tension_bounds};
    use crate::rng::{Purpose, stream, uniform};
    use crate::stress::Lanes;

    #[test]
    fn spectral_norm_of_known_matrices() {
        assert!((spectral_norm([1.0, -3.0, 2.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-12);
        // Pure shear τ has eigenvalues ±τ and 0; all ones has 3.
        assert!((spectral_norm([0.0, 0.0, 0.0, 0.0, 0.0, 2.0]) - 2.0).abs() < 1e-12);
        assert!((spectral_norm([1.0; 6]) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn the_bound_is_the_sum_for_any_number_of_modes() {
        for modes in 0..20 {
            let q: Vec<f32> = (0..modes)
                .map(|i| if i % 2 == 0 { 1.0 } else { -2.0 })
                .collect();
            let s: Vec<f32> = (0..modes).map(|i| i as f32).collect();
            let g: Vec<f32> = (0..modes).map(|i| 1.0 + i as f32).collect();
            let plain = |row: &[f32]| q.iter().zip(row).map(|(q, r)| q.abs() * r).sum::<f32>();
            let expected = plain(&s) + 0.5 * 3.0 * plain(&g).powi(2);
            assert_eq!(tension_bound(&q, &s, &g, 3.0), expected);
        }
    }

    #[test]
    fn bounds_of_a_batch_have_the_bits_of_each_step_s() {
        let mut rng = stream(5, Purpose::WeakPoints, 0);
        let mut number = || uniform(&mut rng) as f32;
        for modes in 0..30 {
            let mut row = || -> Vec<f32> { (0..modes).map(|_| 1e9 * number()).collect() };
            let (s, g) = (row(), row());
            let sizes: Vec<Lanes> = (0..modes)
                .map(|_| std::array::from_fn(|_| 1e-6 * number()))
                .collect();
            for k in [0.0, 3e10] {
                let bounds = tension_bounds(&sizes, &s, &g, k);
                for (step, bound) in bounds.into_iter().enumerate() {
                    let q: Vec<f32> = sizes.iter().map(|q| q[step]).collect();
                    assert_eq!(bound, tension_bound(&q, &s, &g, k), "{modes} modes");
                }
            }
        }
    }
}
