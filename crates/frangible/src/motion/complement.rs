//! Parts of a motion that the integrated modes do not include: the static response of the other modes (the residual vector) and the
//! near fields of contacts on walls.
//!
//! **Residual vector**, or modal truncation augmentation (Dickens, Nakagawa and Wittbrodt 1997): modes much faster than the force
//! follow it, `q_i = ξ_i F(t)/λ_i`. Together they are one more shape of the body per contact, `u_s = Σ ξ_i φ_i/λ_i`, with the
//! amplitude F(t). A brick that lands on its corner shows a fifth of its stress in 80 modes, and all of it with this shape.

use std::sync::Arc;

use crate::asset::Asset;
use crate::near_field::{NearField, NearFields};
use crate::stress::{MARGIN, Shape};

/// Parts of a motion that the followed modes leave out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Complement {
    pub(crate) residuals: Vec<Residual>,
    pub(crate) near: Vec<NearField>,
}

/// A shape of the body that follows a force.
#[derive(Clone, Debug)]
pub(crate) struct Residual {
    pub(crate) shape: Arc<Shape>,
    /// The force at each time step, N; zero after the last.
    pub(crate) force: Vec<f32>,
}

impl Residual {
    /// The shape of a unit force: `push` is ξ_i of the last modes of the body, 1/√kg; none where it moves nothing.
    pub(crate) fn shape(asset: &Asset, push: &[f64]) -> Option<Arc<Shape>> {
        let basis = &asset.modes;
        let first = basis.count() - push.len();
        let eigenvalues = &basis.eigenvalues[first..];
        let amplitudes: Vec<f32> = push
            .iter()
            .zip(eigenvalues)
            .map(|(xi, lambda)| (xi / lambda) as f32)
            .collect();
        let moves = amplitudes.iter().any(|&q| q != 0.0);
        moves.then(|| Arc::new(Shape::new(asset, amplitudes)))
    }

    /// Force at a time step, N.
    pub(crate) fn force(&self, step: usize) -> f32 {
        self.force.get(step).copied().unwrap_or(0.0)
    }

    /// Upper bound of the stress per newton, Pa/N, if no mode's stress exceeds its number in `row`, Pa per m·√kg.
    pub(crate) fn bound(&self, row: &[f32]) -> f32 {
        let amplitudes = &self.shape.amplitudes;
        let last = &row[row.len() - amplitudes.len()..];
        let terms = last.iter().zip(amplitudes);
        let sum: f32 = terms.map(|(s, q)| s * q.abs()).sum();
        sum * (1.0 + MARGIN)
    }
}

impl Complement {
    /// Returns true if there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.residuals.is_empty() && self.near.is_empty()
    }

    /// The near fields.
    pub(crate) fn near(&self) -> NearFields<'_> {
        NearFields(&self.near)
    }
}
