//! Exact time step of a mode under a half-sine pulse.
//!
//! The mode and the pulse together are a linear system without input: its state after a time step is a matrix times its state before,
//! the exponential of the system's matrix. The matrix is computed once per mode and step length, and each step is one product.

pub(crate) type Matrix2 = [[f64; 2]; 2];

/// A 4 × 4 matrix of the state (ω q, q̇, sin ut, cos ut) in 2 × 2 blocks: the mode on itself, the force on the mode, the turn of the force;
/// the force does not feel the mode, so the fourth block is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) own: Matrix2,
    pub(crate) force: Matrix2,
    pub(crate) turn: Matrix2,
}

impl Step {
    const IDENTITY: Self = Self {
        own: [[1.0, 0.0], [0.0, 1.0]],
        force: [[0.0; 2]; 2],
        turn: [[1.0, 0.0], [0.0, 1.0]],
    };

    /// Matrix times state.
    #[inline(always)]
    pub(super) fn times(&self, [q, v, s, c]: [f64; 4]) -> [f64; 4] {
        let Self { own, force, turn } = self;
        [
            own[0][0] * q + own[0][1] * v + force[0][0] * s + force[0][1] * c,
            own[1][0] * q + own[1][1] * v + force[1][0] * s + force[1][1] * c,
            turn[0][0] * s + turn[0][1] * c,
            turn[1][0] * s + turn[1][1] * c,
        ]
    }

    fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        let block = |m: &Matrix2| m.map(|row| row.map(&f));
        Self {
            own: block(&self.own),
            force: block(&self.force),
            turn: block(&self.turn),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        let block = |a: &Matrix2, b: &Matrix2| -> Matrix2 {
            std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
        };
        Self {
            own: block(&self.own, &other.own),
            force: block(&self.force, &other.force),
            turn: block(&self.turn, &other.turn),
        }
    }

    fn product(&self, other: &Self) -> Self {
        let block = |a: &Matrix2, b: &Matrix2| -> Matrix2 {
            std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
        };
        let (own, by) = (&self.own, &self.force);
        let force = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                own[i][0] * other.force[0][j]
                    + own[i][1] * other.force[1][j]
                    + by[i][0] * other.turn[0][j]
                    + by[i][1] * other.turn[1][j]
            })
        });
        Self {
            own: block(&self.own, &other.own),
            force,
            turn: block(&self.turn, &other.turn),
        }
    }

    /// Largest sum of the absolute values of a row.
    fn norm(&self) -> f64 {
        let sum = |i: usize| self.own[i][0].abs() + self.own[i][1].abs();
        let by = |i: usize| self.force[i][0].abs() + self.force[i][1].abs();
        let turn = |i: usize| self.turn[i][0].abs() + self.turn[i][1].abs();
        let upper = (sum(0) + by(0)).max(sum(1) + by(1));
        upper.max(turn(0)).max(turn(1))
    }

    /// Matrix exponential by scaling, a Taylor series of order 13 (remainder below 1e-15 at norm ½), squaring.
    pub(super) fn exponential(&self) -> Self {
        let norm = self.norm();
        let squarings = if norm > 0.5 {
            libm::log2(norm / 0.5).ceil() as i32
        } else {
            0
        };
        let scaled = self.map(|x| x * 0.5_f64.powi(squarings));
        let mut sum = Self::IDENTITY;
        let mut term = Self::IDENTITY;
        for k in 1..=13 {
            term = term.product(&scaled).map(|x| x / f64::from(k));
            sum = sum.plus(&term);
        }
        for _ in 0..squarings {
            sum = sum.product(&sum);
        }
        sum
    }
}
