//! Contacts refused free of time: bounds of the stress that follow no motion, from the cheapest (beyond the paper).
//!
//! 1. One number per surface triangle and largest force ([`PerImpulse`](crate::bounds::PerImpulse)).
//! 2. The reach of every mode under its impulse (`reach.rs`) in the bound of the whole body.
//! 3. The same reaches in the bound of each cluster of tetrahedra.
//!
//! A blow that is integrated has no impulse and no duration yet: what it can bring at most follows from the energy of approach
//! (`blow/limits.rs`). A contact on a wall is not refused here: its near field is known only once it is integrated.

use glam::Vec3;

use super::cluster_bounds::refused_by_clusters;
use super::harmless;
use super::pushes::{MOST_CONTACTS, Pushes};
use crate::blow::Limits;
use crate::body::Body;
use crate::config::{DurationModel, FractureConfig};
use crate::contact::{Contact, give, hertz_at};
use crate::mesh::SurfacePoint;
use crate::outcome::LookedAt;

/// Bounds that show that an impact is harmless.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refusal {
    /// Level of detail at which the impact was decided.
    pub(crate) looked_at: LookedAt,
    /// Upper bound of the tension at all weak points, Pa.
    pub(crate) bound: f32,
    /// Upper bound of that tension, scaled to the strength of the weakest point, Pa.
    pub(crate) as_weakest: f32,
}

impl Refusal {
    /// Raises the bounds to another bound and its value scaled to the strength of the weakest point, Pa.
    pub(crate) fn raise(&mut self, bound: f32, as_weakest: f32) {
        self.bound = self.bound.max(bound);
        self.as_weakest = self.as_weakest.max(as_weakest);
    }
}

/// Refuses an impact if a bound free of time shows that none of its stress does anything to the body. Allocates nothing unless parts of the
/// body have to be asked. `None` says nothing.
pub(crate) fn refused(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Option<Refusal> {
    let hit = || contacts.iter().filter(|c| c.pushes(config.duration));
    let pushes = Pushes::new(body, hit().map(|c| (c.point, c.direction())))?;
    if let Some(theory) = config.near_field
        && pushes.any_near(&body.asset, theory)
    {
        return None;
    }
    let mut limits = [Limits::default(); MOST_CONTACTS];
    if config.duration == DurationModel::Integrated {
        let mut hits = [None; MOST_CONTACTS];
        for (slot, hit) in hits.iter_mut().zip(hit().zip(pushes.places())) {
            *slot = Some((hit.0, hit.1.0));
        }
        if !Limits::of(&body.asset, &hits[..pushes.places().len()], &mut limits) {
            return None;
        }
    } else {
        let given = given_duration(body, || hit().zip(pushes.places()), config);
        for (limit, contact) in limits.iter_mut().zip(hit()) {
            let impulse = f64::from(contact.impulse);
            let force = std::f64::consts::FRAC_PI_2 * impulse / given;
            *limit = Limits { impulse, force };
        }
    }
    let quadratic_modulus = body.quadratic_modulus(config);
    let harmless = harmless(body, 1.0);
    let whole = |looked_at, bound: f32| {
        (bound <= harmless).then_some(Refusal {
            looked_at,
            bound,
            as_weakest: bound,
        })
    };
    let each = || pushes.places().iter().zip(&limits);
    let force_of = |limit: &Limits| (limit.force / limit.impulse.max(f64::MIN_POSITIVE)) as f32;
    if quadratic_modulus == 0.0 {
        let per_impulse = &body.prepared.per_impulse;
        let bound = each()
            .map(|((at, direction), limit)| {
                let number = per_impulse.of(at.triangle, force_of(limit));
                direction.length() * limit.impulse as f32 * number
            })
            // A sum of nothing is to be 0, and not -0: a margin is a quotient of it.
            .fold(0.0, |sum, bound| sum + bound);
        if let Some(refusal) = whole(LookedAt::Sizes, bound) {
            return Some(refusal);
        }
    }
    // Forces of several contacts need not rise and fall together: the sizes of what they do add up.
    let reaches = &body.prepared.reaches;
    let modes = body.asset.modes.count();
    if pushes.places().len() == 1 {
        let limit = limits[0];
        let (impulse, force) = (limit.impulse as f32, force_of(&limit));
        let reach = |mode: usize, push: f32| push * impulse * reaches.most(mode, force);
        let bound = pushes.bound(body, quadratic_modulus, reach);
        if let Some(refusal) = whole(LookedAt::Impulses, bound) {
            return Some(refusal);
        }
    }
    // Fronts of old cracks feel the stress of the whole body.
    if !body.state().is_intact() {
        return None;
    }
    let mut amplitudes = vec![0.0; modes];
    let mut own = vec![0.0; modes];
    for (place, limit) in each() {
        own.fill(0.0);
        Pushes::modal_of(place, &body.asset, 0..modes, &mut own);
        let (impulse, force) = (limit.impulse as f32, force_of(limit));
        for (mode, (sum, push)) in amplitudes.iter_mut().zip(&own).enumerate() {
            *sum += push.abs() * impulse * reaches.most(mode, force);
        }
    }
    refused_by_clusters(body, &amplitudes, quadratic_modulus)
}

/// Duration of the contacts whose impulses are given, s: the shortest of all that touch. Infinite where it takes the modes to say: with no modes
/// that follow the force the bounds ask for no duration.
fn given_duration<'a, Hits>(body: &Body, hits: impl Fn() -> Hits, config: &FractureConfig) -> f64
where
    Hits: Iterator<Item = (&'a Contact, &'a (SurfacePoint, Vec3))>,
{
    let asset = &*body.asset;
    match config.duration {
        DurationModel::Hertz => {
            let durations = hits().map(|(contact, (at, _))| {
                if contact.is_script() {
                    return f64::from(contact.duration);
                }
                let radius = f64::from(asset.surface.curvature_radius[at.triangle as usize]);
                let give = give(asset, at, contact.normal.normalize());
                hertz_at(asset, contact, radius, give)
            });
            durations.fold(f64::INFINITY, f64::min)
        }
        _ => f64::INFINITY,
    }
}
