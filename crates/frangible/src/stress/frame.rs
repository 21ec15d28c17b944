//! The axes in which the stress at a weak point is held: no more numbers than its law leaves.

use glam::Vec3;

use super::batch::{BATCH, Lanes};
use super::lanes::StressLanes;
use super::strain::{Elasticity, Law};
use super::tensor::{Symmetric3, mixed_products, products};
use super::wide::Wide;
use super::{Wall, perpendicular_axes};

/// Largest count of numbers of a stress.
pub(crate) const MOST: usize = 6;

/// Rounding of a bound, relative to its terms.
const ROUNDING: f32 = 2e-6;

/// From this cosine on a wall's normal is that of the surface.
const SAME: f32 = 0.999;

/// Numbers that are held of the stress at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Frame {
    /// In a surface without traction: along these unit vectors, and the shear between them.
    Surface([Vec3; 2]),
    /// At an edge: the tension along this unit vector.
    Edge(Vec3),
    /// All of it: xx, yy, zz, xy, yz, zx.
    Space,
}

impl Frame {
    /// The frame of a point with this law, in this wall, if any. What is added to the stress there lies in the wall.
    pub(crate) fn of(law: Law, wall: Option<&Wall>) -> Self {
        match law {
            Law::Edge(along) => Self::Edge(along),
            Law::Free(n) if wall.is_none_or(|wall| wall.normal.dot(n).abs() > SAME) => {
                let (a, b) = perpendicular_axes(n);
                Self::Surface([a, b])
            }
            Law::Free(_) | Law::Solid => Self::Space,
        }
    }

    /// Count of the numbers held.
    #[inline(always)]
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Surface(_) => 3,
            Self::Edge(_) => 1,
            Self::Space => MOST,
        }
    }

    /// Weight of a number's square in the square of the tensor's norm.
    #[inline(always)]
    pub(super) fn weight(self, number: usize) -> f32 {
        let shear = match self {
            Self::Surface(_) => 2,
            Self::Edge(_) | Self::Space => 3,
        };
        if number < shear { 1.0 } else { 2.0 }
    }

    /// Upper bound of the principal stresses of these numbers, be they tension or pressure.
    pub(super) fn size(self, numbers: &[f32]) -> f32 {
        match (self, numbers) {
            (Self::Surface(_), &[aa, bb, ab]) => {
                let half = 0.5 * (aa - bb);
                (0.5 * (aa + bb)).abs() + (half * half + ab * ab).sqrt()
            }
            _ => {
                let squares = numbers.iter().enumerate();
                let squares = squares.map(|(number, x)| self.weight(number) * x * x);
                squares.sum::<f32>().sqrt()
            }
        }
    }

    /// The numbers of a tension of 1 along unit `t`.
    pub(crate) fn of_uniaxial(self, t: Vec3) -> [f32; MOST] {
        self.numbers(&Symmetric3::uniaxial(1.0, t))
    }

    /// The numbers of a stress; those that the frame does not hold are zero.
    pub(crate) fn numbers(self, stress: &Symmetric3) -> [f32; MOST] {
        let mut numbers = [0.0; MOST];
        match self {
            Self::Surface([a, b]) => {
                let (along_a, along_b) = (stress.times(a), stress.times(b));
                numbers[..3].copy_from_slice(&[along_a.dot(a), along_b.dot(b), along_a.dot(b)]);
            }
            Self::Edge(along) => numbers[0] = stress.times(along).dot(along),
            Self::Space => numbers = stress.components(),
        }
        numbers
    }

    /// The whole tensor.
    #[inline(always)]
    pub(crate) fn stress(self, numbers: &[Lanes]) -> StressLanes {
        let mut lanes = StressLanes::default();
        match self {
            Self::Surface([a, b]) => {
                lanes.add_uniaxial(&numbers[0], a);
                lanes.add_uniaxial(&numbers[1], b);
                lanes.add(&numbers[2], mixed_products(a, b));
            }
            Self::Edge(along) => lanes.add_uniaxial(&numbers[0], along),
            Self::Space => lanes.components.copy_from_slice(&numbers[..MOST]),
        }
        lanes
    }

    /// Upper bounds of the largest principal tension where there is any, Pa; beside a free surface it is that tension.
    #[inline(always)]
    pub(crate) fn tension_bounds(self, numbers: &[Lanes]) -> Lanes {
        let mut bounds = [0.0; BATCH];
        match self {
            Self::Surface(_) => {
                let (aa, bb, ab) = (Wide(numbers[0]), Wide(numbers[1]), Wide(numbers[2]));
                let (mean, half) = ((aa + bb) * 0.5, (aa - bb) * 0.5);
                let radius = (half * half + ab * ab).sqrt();
                bounds = (mean + radius * (1.0 + ROUNDING)).0;
                for k in 0..BATCH {
                    bounds[k] += ROUNDING * mean.0[k].abs();
                }
            }
            Self::Edge(_) => {
                for k in 0..BATCH {
                    let along = numbers[0][k];
                    bounds[k] = along + ROUNDING * along.abs();
                }
            }
            Self::Space => bounds = self.stress(numbers).tension_bounds(),
        }
        bounds
    }
}

impl Elasticity {
    /// Numbers of a frame per displacement of a node, Pa/m: row after row. `g`: gradient of the node's shape function, 1/m.
    #[inline(always)]
    pub(super) fn per_displacement(&self, law: Law, frame: Frame, g: Vec3) -> [Vec3; MOST] {
        let mut rows = [Vec3::ZERO; MOST];
        match (law, frame) {
            (Law::Edge(t), _) => rows[0] = t * (self.youngs_modulus * g.dot(t)),
            (Law::Free(_), Frame::Surface([a, b])) => {
                rows[..3].copy_from_slice(&self.in_surface(a, b, g));
            }
            (Law::Free(n), _) => {
                let (a, b) = perpendicular_axes(n);
                let in_surface = self.in_surface(a, b, g);
                let shares = [products(a, a), products(b, b), mixed_products(a, b)];
                for (row, shares) in in_surface.into_iter().zip(shares) {
                    for (sum, share) in rows.iter_mut().zip(shares) {
                        *sum += row * share;
                    }
                }
            }
            (Law::Solid, _) => {
                for i in 0..3 {
                    let (e, f) = (Vec3::AXES[i], Vec3::AXES[(i + 1) % 3]);
                    rows[i] = g * self.lambda + e * (2.0 * self.mu * g.dot(e));
                    rows[3 + i] = (e * g.dot(f) + f * g.dot(e)) * self.mu;
                }
            }
        }
        rows
    }

    /// [`Self::per_displacement`] at another place than that of the frame, whose law may be another one.
    pub(super) fn per_displacement_in(&self, law: Law, frame: Frame, g: Vec3) -> [Vec3; MOST] {
        let tensor = self.per_displacement(law, Frame::Space, g);
        let along = |u: Vec3, v: Vec3| {
            let [xx, yy, zz, xy, yz, zx] = tensor;
            xx * (u.x * v.x)
                + yy * (u.y * v.y)
                + zz * (u.z * v.z)
                + xy * (u.x * v.y + u.y * v.x)
                + yz * (u.y * v.z + u.z * v.y)
                + zx * (u.z * v.x + u.x * v.z)
        };
        let mut rows = [Vec3::ZERO; MOST];
        match frame {
            Frame::Space => rows = tensor,
            Frame::Surface([a, b]) => {
                rows[..3].copy_from_slice(&[along(a, a), along(b, b), along(a, b)]);
            }
            Frame::Edge(t) => rows[0] = along(t, t),
        }
        rows
    }

    /// Rows of plane stress along unit vectors `a` and `b`: σ_aa, σ_bb, σ_ab.
    #[inline(always)]
    fn in_surface(&self, a: Vec3, b: Vec3, g: Vec3) -> [Vec3; 3] {
        let (along_a, along_b) = (a * g.dot(a), b * g.dot(b));
        let mean = (along_a + along_b) * self.plane_lambda;
        [
            mean + along_a * (2.0 * self.mu),
            mean + along_b * (2.0 * self.mu),
            (b * g.dot(a) + a * g.dot(b)) * self.mu,
        ]
    }
}
