//! Uniform scaling and translation.

use glam::DVec3;

use crate::{InputMesh, Surface};

/// The transform `p ↦ scale · p + shift`. Applied to a render mesh and its solid surface alike, it keeps the two aligned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Factor of all lengths, above 0.
    pub scale: f64,
    /// Translation after scaling, m.
    pub shift: DVec3,
}

impl Similarity {
    /// The identity transform.
    pub const IDENTITY: Self = Self {
        scale: 1.0,
        shift: DVec3::ZERO,
    };

    /// Scales the box `[low, high]` about its centre so that its longest side is `longest`, m. A box without extent is not changed.
    #[must_use]
    pub fn resizing([low, high]: [DVec3; 2], longest: f64) -> Self {
        let scale = longest / (high - low).max_element();
        if !(scale.is_finite() && scale > 0.0) {
            return Self::IDENTITY;
        }
        let centre = 0.5 * low + 0.5 * high;
        let shift = (1.0 - scale) * centre;
        Self { scale, shift }
    }

    /// Transforms a point.
    #[must_use]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.scale * p + self.shift
    }
}

impl Surface {
    /// Transforms all vertices.
    pub fn transform(&mut self, by: &Similarity) {
        for p in &mut self.positions {
            *p = by.apply(*p);
        }
    }

    /// Scales the surface about the centre of its bounding box so that its longest side is `longest`, m. Returns the transform to apply to the
    /// [`InputMesh`].
    pub fn resize(&mut self, longest: f64) -> Similarity {
        let similarity = Similarity::resizing(self.bounds(), longest);
        self.transform(&similarity);
        similarity
    }

    /// Moves all vertices by `shift`, m.
    pub fn translate(&mut self, shift: DVec3) {
        self.transform(&Similarity { scale: 1.0, shift });
    }
}

impl InputMesh {
    /// Transforms all vertices.
    pub fn transform(&mut self, by: &Similarity) {
        for p in &mut self.positions {
            *p = by.apply(*p);
        }
    }
}
