//! Contacts refused free of time: bounds of the stress that follow no motion, from the cheapest (beyond the paper).
//!
//! 1. One number per surface triangle and duration ([`PerImpulse`](super::PerImpulse)).
//! 2. The reach of every mode under its impulse (`modal/reach.rs`) in the bound of the whole body …
//! 3. … and of its parts.
//!
//! A contact that is made admissible only lasts longer, and the reaches fall with the duration: Hertz' duration, which needs no modes,
//! serves for all of them. With the other models of the duration the bounds ask for none.

use glam::Vec3;

use super::Contact;
use super::duration::hertz_at;
use super::load::{each_row, give};
use crate::asset::Asset;
use crate::body::Body;
use crate::config::{DurationModel, FractureConfig};
use crate::crack::refused_by_parts;
use crate::impact::harmless;
use crate::mesh::SurfacePoint;
use crate::outcome::LookedAt;
use crate::stress::tension_bound;

/// Most pushes that a quick bound looks at; more are rare, and go on to the full computation.
const MOST_CONTACTS: usize = 16;

/// Modes looked at together: their sums stay on the stack.
const BLOCK: usize = 64;

/// Why an impact does nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refusal {
    /// What had to be looked at.
    pub(crate) looked_at: LookedAt,
    /// No weak point has more tension than this, Pa …
    pub(crate) bound: f32,
    /// … and none feels more than the weakest would at this, Pa.
    pub(crate) as_weakest: f32,
}

impl Refusal {
    /// Another bound, and as the weakest point would feel it, Pa.
    pub(crate) fn raise(&mut self, bound: f32, as_weakest: f32) {
        self.bound = self.bound.max(bound);
        self.as_weakest = self.as_weakest.max(as_weakest);
    }
}

/// What pushes on a body: where, and with which impulse, N·s, or force, N.
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

    fn places(&self) -> &[(SurfacePoint, Vec3)] {
        &self.places[..self.count]
    }

    /// Adds Σ φ_i(b) · push of some modes to `sums`, which is as long.
    fn modal(&self, asset: &Asset, modes: std::ops::Range<usize>, sums: &mut [f32]) {
        for (place, push) in self.places() {
            each_row(asset, place, |node, weight| {
                let w = *push * weight;
                let [x, y, z] = [0, 1, 2].map(|k| &asset.modes.row(3 * node + k)[modes.clone()]);
                for (((sum, x), y), z) in sums.iter_mut().zip(x).zip(y).zip(z) {
                    *sum += w.x * x + w.y * y + w.z * z;
                }
            });
        }
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

    /// Σ_k |push_k| times the number of its triangle, Pa.
    fn rough_bound(&self, body: &Body, pulse_frequency: f32) -> f32 {
        let per_impulse = &body.prepared.per_impulse;
        let of = |(at, push): &(SurfacePoint, Vec3)| {
            push.length() * per_impulse.of(at.triangle, pulse_frequency)
        };
        self.places().iter().map(of).sum()
    }
}

/// Whether a bound free of time shows that no stress of this impact does anything to the body. Allocates nothing unless parts of the
/// body have to be asked. `None` says nothing.
pub(crate) fn refused(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Option<Refusal> {
    let hit = || contacts.iter().filter(|c| c.impulse > 0.0);
    let pushes = Pushes::new(body, hit().map(|c| (c.point, c.push())))?;
    let u = pulse_frequency(body, hit().zip(pushes.places()), config);
    let quadratic_modulus = body.quadratic_modulus(config);
    let harmless = harmless(body);
    let whole = |looked_at, bound: f32| {
        (bound <= harmless).then_some(Refusal {
            looked_at,
            bound,
            as_weakest: bound,
        })
    };
    if quadratic_modulus == 0.0
        && let Some(refusal) = whole(LookedAt::Sizes, pushes.rough_bound(body, u))
    {
        return Some(refusal);
    }
    let reaches = &body.prepared.reaches;
    let reach = |mode: usize, push: f32| push * reaches.most(mode, u);
    let bound = pushes.bound(body, quadratic_modulus, reach);
    if let Some(refusal) = whole(LookedAt::Impulses, bound) {
        return Some(refusal);
    }
    // Fronts of old cracks feel the stress of the whole body.
    if u.is_infinite() || !body.state().is_intact() {
        return None;
    }
    let modes = body.asset.modes.count();
    let mut amplitudes = vec![0.0; modes];
    pushes.modal(&body.asset, 0..modes, &mut amplitudes);
    for (mode, q) in amplitudes.iter_mut().enumerate() {
        *q = reach(mode, *q);
    }
    refused_by_parts(body, &amplitudes, quadratic_modulus)
}

/// u = π/t_d of the shortest duration that the impact may have, rad/s; infinite where it takes the modes to say.
fn pulse_frequency<'a>(
    body: &Body,
    contacts: impl Iterator<Item = (&'a Contact, &'a (SurfacePoint, Vec3))>,
    config: &FractureConfig,
) -> f32 {
    if config.duration != DurationModel::Hertz {
        return f32::INFINITY;
    }
    let asset = &*body.asset;
    let durations = contacts.map(|(contact, (at, _))| {
        let radius = f64::from(asset.surface.curvature_radius[at.triangle as usize]);
        let give = give(asset, at, contact.normal.normalize());
        hertz_at(asset, contact, radius, give)
    });
    (std::f64::consts::PI / durations.fold(f64::INFINITY, f64::min)) as f32
}
