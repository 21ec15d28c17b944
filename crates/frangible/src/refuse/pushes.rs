//! Pushes on a body, and the bound of the whole body under them.

use glam::Vec3;

use crate::asset::{Asset, each_row};
use crate::blow::has_near_field;
use crate::body::Body;
use crate::bounds::tension_bound;
use crate::mesh::SurfacePoint;
use crate::near_field::PlateTheory;

/// Largest number of pushes that a quick bound looks at; more are rare, and go on to the full computation.
pub(super) const MOST_CONTACTS: usize = 16;

/// Modes looked at together: their sums stay on the stack.
const BLOCK: usize = 64;

/// Pushes on a body: their places, and their impulses, N·s, or forces, N.
pub(crate) struct Pushes {
    places: [(SurfacePoint, Vec3); MOST_CONTACTS],
    count: usize,
}

impl Pushes {
    /// `None` when there are too many.
    pub(crate) fn new(body: &Body, pushes: impl Iterator<Item = (Vec3, Vec3)>) -> Option<Self> {
        let nowhere = SurfacePoint {
            triangle: 0,
            weights: [0.0; 3],
            position: Vec3::ZERO,
        };
        let mut found = Self {
            places: [(nowhere, Vec3::ZERO); MOST_CONTACTS],
            count: 0,
        };
        for (point, push) in pushes {
            let place = found.places.get_mut(found.count)?;
            *place = (body.prepared.surface.closest(point), push);
            found.count += 1;
        }
        Some(found)
    }

    pub(crate) fn places(&self) -> &[(SurfacePoint, Vec3)] {
        &self.places[..self.count]
    }

    /// Returns true if any of them has a near field.
    pub(super) fn any_near(&self, asset: &Asset, theory: PlateTheory) -> bool {
        let mut places = self.places().iter();
        places.any(|(at, _)| has_near_field(asset, at.triangle, theory))
    }

    /// Adds Σ φ_i(b) · push of some modes to `sums`, which is as long.
    fn modal(&self, asset: &Asset, modes: std::ops::Range<usize>, sums: &mut [f32]) {
        for place in self.places() {
            Self::modal_of(place, asset, modes.clone(), sums);
        }
    }

    /// Adds φ_i(b) · push of one place.
    pub(super) fn modal_of(
        (place, push): &(SurfacePoint, Vec3),
        asset: &Asset,
        modes: std::ops::Range<usize>,
        sums: &mut [f32],
    ) {
        each_row(asset, place, |node, weight| {
            (asset.modes).add_push_to(modes.clone(), node, *push * weight, sums);
        });
    }

    /// The stress bound of the whole body, Pa. `amplitude` turns a mode's number and its Σ φ_i(b) · push into its amplitude, m·√kg.
    pub(crate) fn bound(
        &self,
        body: &Body,
        quadratic_modulus: f32,
        amplitude: impl Fn(usize, f32) -> f32,
    ) -> f32 {
        let (asset, root) = (&*body.asset, &body.prepared.whole);
        let modes = asset.modes.count();
        let with_gradient = quadratic_modulus > 0.0;
        let (mut stress, mut gradient) = (0.0, 0.0);
        for first in (0..modes).step_by(BLOCK) {
            let block = first..(first + BLOCK).min(modes);
            let mut amplitudes = [0.0_f32; BLOCK];
            let amplitudes = &mut amplitudes[..block.len()];
            self.modal(asset, block.clone(), amplitudes);
            for (q, mode) in amplitudes.iter_mut().zip(block.clone()) {
                *q = amplitude(mode, *q);
            }
            // The quadratic term needs the sum over all blocks first.
            let zero = [0.0; BLOCK];
            let zero = &zero[..block.len()];
            stress += tension_bound(amplitudes, &root.0[block.clone()], zero, 0.0);
            if with_gradient {
                gradient += tension_bound(amplitudes, &root.1[block], zero, 0.0);
            }
        }
        stress + 0.5 * quadratic_modulus * gradient * gradient
    }
}
