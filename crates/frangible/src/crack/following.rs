//! Stress of the motion that follows the force, with its signs: what refuses blows that are slow for the modes.
//!
//! Under a pulse that is long for a mode it moves as q = c sin(ut) + rest (`modal/reach.rs`). The stress of Σ c φ is looked at weak
//! point by weak point, where the modes cancel; only the rests are bounded by their sizes. During the pulse, since
//! 0 ≤ sin(ut) ≤ 1, no principal tension exceeds max(σ₁(Σ c φ), 0) + Σ rest s; after it none exceeds Σ after s.

use glam::{Mat3, Vec3};

use super::field::weak_place;
use super::parts::Parts;
use crate::asset::{Asset, EmbeddedPoint};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::Refusal;
use crate::modal::Split;
use crate::outcome::LookedAt;
use crate::stress::{Elasticity, MARGIN, ROUNDING, ShapeWeights, dot, largest_eigenvalue_bound};

/// Elements whose displacements are kept.
const KEPT: usize = 64;

/// Whether no weak point of a body without cracks reaches its strength under a pulse of frequency u, rad/s. `None` says nothing.
pub(crate) fn refused_following(
    body: &Body,
    modal_impulse: &[f64],
    pressed: &[u32],
    pulse_frequency: f32,
    config: &FractureConfig,
) -> Option<Refusal> {
    let quadratic_modulus = body.quadratic_modulus(config);
    let reaches = &body.prepared.reaches;
    let impulse = |mode: usize| modal_impulse[mode] as f32;
    let modes = 0..modal_impulse.len();
    let amplitudes: Vec<f32> = modes
        .clone()
        .map(|i| impulse(i) * reaches.most(i, pulse_frequency))
        .collect();
    let parts = Parts::new(body, quadratic_modulus);
    let mut refusal = Refusal {
        looked_at: LookedAt::Impulses,
        bound: 0.0,
        as_weakest: 0.0,
    };
    let mut doubtful = Vec::new();
    let mut bounds = Vec::new();
    parts.bounds(&amplitudes, &mut bounds);
    for (part, bound) in bounds.into_iter().enumerate() {
        if bound > parts.limit(part) {
            doubtful.push((bound / parts.limit(part), part));
        } else {
            refusal.raise(bound, parts.as_weakest(part, bound));
        }
    }
    if doubtful.is_empty() {
        return Some(refusal);
    }
    if quadratic_modulus > 0.0 {
        return None;
    }
    refusal.looked_at = LookedAt::Following;
    let split: Vec<Split> = modes.map(|i| reaches.split(i, pulse_frequency)).collect();
    let of = |part: fn(&Split) -> f32| -> Vec<f32> {
        let parts = split.iter().map(part).enumerate();
        parts.map(|(i, share)| impulse(i) * share).collect()
    };
    let (rest, after) = (of(|s| s.rest), of(|s| s.after));
    // The likeliest to fail first.
    doubtful.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for &(_, part) in &doubtful {
        let limit = parts.limit(part);
        if parts.bound(part, &rest) > limit || parts.bound(part, &after) > limit {
            return None;
        }
    }
    let mut look = Following::new(body, of(|s| s.following), &amplitudes, pressed, config);
    for &(_, part) in &doubtful {
        let after = parts.bound(part, &after);
        let rest = parts.bound(part, &rest);
        refusal.raise(after, parts.as_weakest(part, after));
        pulp::Arch::new().dispatch(Points {
            look: &mut look,
            part,
            rest,
            refusal: &mut refusal,
        })?;
    }
    Some(refusal)
}

/// The motion Σ c φ and what has been looked at of it.
struct Following<'a> {
    body: &'a Body,
    config: &'a FractureConfig,
    pressed: &'a [u32],
    /// Amplitudes c of every mode, m·√kg.
    amplitudes: Vec<f32>,
    elasticity: Elasticity,
    /// What rounding adds to a stress, Pa per 1/m of the gradients of the shape functions.
    rounding: f32,
    /// Displacements at the nodes of the elements met last, m, at the place of the element's number modulo [`KEPT`].
    kept: [(u32, [Vec3; 10]); KEPT],
}

impl<'a> Following<'a> {
    fn new(
        body: &'a Body,
        amplitudes: Vec<f32>,
        most: &[f32],
        pressed: &'a [u32],
        config: &'a FractureConfig,
    ) -> Self {
        let prepared = &body.prepared;
        // No displacement exceeds this, m, nor do all terms of its sum together.
        let sizes = most.iter().zip(&prepared.largest_shapes);
        let displacement: f32 = sizes.map(|(q, phi)| q.abs() * phi).sum();
        Self {
            body,
            config,
            pressed,
            amplitudes,
            elasticity: Elasticity::new(&body.asset.material)
                .with_green_lagrange(config.green_lagrange),
            // Three components; once for the motion itself, once for this part of it, and the rest's.
            rounding: 3.0 * 3.0 * ROUNDING * prepared.quadratic_modulus * displacement,
            kept: [(u32::MAX, [Vec3::ZERO; 10]); KEPT],
        }
    }

    /// An upper bound of the tension of a weak point, Pa, without the rests.
    #[inline(always)]
    fn tension(&mut self, tet: usize) -> f32 {
        let asset = &*self.body.asset;
        let skin = &self.body.prepared.skin;
        let (point, law) = weak_place(asset, skin, self.config, self.pressed, tet);
        let (gradient, weight) = self.gradient(asset, point);
        let stress = self.elasticity.state_by(gradient, law).stress;
        largest_eigenvalue_bound(&stress).max(0.0) + self.rounding * weight
    }

    /// ∇u and Σ |∇N|, 1/m.
    #[inline(always)]
    fn gradient(&mut self, asset: &Asset, point: &EmbeddedPoint) -> (Mat3, f32) {
        let element = point.element as usize;
        let gradients =
            ShapeWeights::gradients(point, &asset.analysis.barycentric_gradients[element]);
        let kept = &mut self.kept[element % KEPT];
        if kept.0 != point.element {
            *kept = (
                point.element,
                displacements(asset, element, &self.amplitudes),
            );
        }
        let shared = kept.1[0];
        let (mut sum, mut weight) = (Mat3::ZERO, 0.0);
        for (u, g) in kept.1.iter().zip(gradients) {
            let u = *u - shared;
            sum.x_axis += u * g.x;
            sum.y_axis += u * g.y;
            sum.z_axis += u * g.z;
            weight += g.abs().element_sum();
        }
        (sum, weight)
    }
}

/// u = Φ q at the ten nodes of an analysis element, m.
#[inline(always)]
fn displacements(asset: &Asset, element: usize, amplitudes: &[f32]) -> [Vec3; 10] {
    let mut displacements = [Vec3::ZERO; 10];
    // Loops, not maps: their closures would not be compiled for the wider vectors.
    for (u, node) in displacements
        .iter_mut()
        .zip(asset.analysis.elements[element])
    {
        for k in 0..3 {
            u[k] = dot(asset.modes.row(3 * node as usize + k), amplitudes);
        }
    }
    displacements
}

/// The look at all weak points of a part.
struct Points<'l, 'a> {
    look: &'l mut Following<'a>,
    part: usize,
    /// Σ rest s of the part, Pa.
    rest: f32,
    refusal: &'l mut Refusal,
}

impl pulp::NullaryFnOnce for Points<'_, '_> {
    type Output = Option<()>;

    #[inline(always)]
    fn call(self) -> Option<()> {
        let body = self.look.body;
        for &tet in body.clusters.tets(self.part) {
            let strength = body.resistance.strength(tet);
            let bound = self.look.tension(tet as usize) + self.rest;
            if bound > strength * (1.0 - MARGIN) {
                return None;
            }
            let felt = body.resistance.as_weakest(bound, strength);
            self.refusal.raise(bound, felt);
        }
        Some(())
    }
}
