//! Contacts of an impact.

use std::borrow::Cow;

use glam::Vec3;

use super::{SharedMass, Striker};
use crate::asset::Asset;
use crate::config::DurationModel;
use crate::error::{InputError, finite, not_negative, positive};
use crate::material::{Material, OutOfRange};

/// A contact of an impact, in the frame of the body that may break.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Point of contact, m.
    pub point: Vec3,
    /// Unit direction of the impulse **on this body** (from the striker into the body).
    pub normal: Vec3,
    /// Magnitude φ of the normal impulse, N·s. It is an input only for scripts and for duration models without integration. For an
    /// integrated blow the impulse is a result, and this value only sets the ratio of friction to normal impulse.
    #[doc(hidden)]
    pub impulse: f32,
    /// Frictional part of the impulse on this body, N·s: the component perpendicular to the normal.
    #[doc(hidden)]
    pub friction: Vec3,
    /// Approach speed along the normal before the rigid-body step, m/s.
    pub approach_speed: f32,
    /// Duration of a scripted blow, s: its impulse is applied as a half-sine, regardless of the striker. 0 for a striker, whose blow is
    /// [integrated](crate::internals::DurationModel::Integrated).
    #[doc(hidden)]
    pub duration: f32,
    /// The striker.
    pub striker: Striker,
}

impl Contact {
    /// A blow without friction: the striker hits the body at `point`, m, while it approaches along `normal`, a direction into the body, at `speed`,
    /// m/s. Force, duration and impulse are results.
    #[must_use]
    pub const fn strike(point: Vec3, normal: Vec3, speed: f32, striker: Striker) -> Self {
        Self {
            point,
            normal,
            impulse: 0.0,
            friction: Vec3::ZERO,
            approach_speed: speed,
            duration: 0.0,
            striker,
        }
    }

    /// A half-sine push at `point`, m, with this impulse on the body, N·s, and this duration, s.
    #[must_use]
    pub fn push(point: Vec3, impulse: Vec3, duration: f32) -> Self {
        Self {
            impulse: impulse.length(),
            duration,
            ..Self::strike(point, impulse, 0.0, Striker::rigid())
        }
    }

    /// The blow with friction: `over_normal` is the force of friction on the body over the normal force, perpendicular to the normal. Where the
    /// striker slides, its length is the coefficient of friction.
    #[must_use]
    pub fn with_friction(self, over_normal: Vec3) -> Self {
        let impulse = if self.impulse > 0.0 {
            self.impulse
        } else {
            1.0
        };
        Self {
            impulse,
            friction: over_normal * impulse,
            ..self
        }
    }

    /// Returns true if the contact is scripted, with given impulse and duration.
    #[doc(hidden)]
    #[must_use]
    pub fn is_script(&self) -> bool {
        self.duration > 0.0
    }

    /// Returns true if it pushes in this model: an integrated blow needs a script or a speed of approach, the others a given impulse.
    pub(crate) fn pushes(&self, model: DurationModel) -> bool {
        match model {
            DurationModel::Integrated => self.is_script() || self.approach_speed > 0.0,
            _ => self.impulse > 0.0,
        }
    }

    /// Direction of its force on the body: the unit normal, plus the friction over the impulse.
    pub(crate) fn direction(&self) -> Vec3 {
        let normal = self.normal.normalize_or_zero();
        if self.friction == Vec3::ZERO {
            normal
        } else {
            normal + self.friction / self.impulse
        }
    }

    /// A frictionless rigid-body collision. The striker hits a body of this asset at `point`, m, moving `toward` a direction of any length at
    /// `speed`, m/s; the impulse, an input of models that do not integrate the blow, is (1 + e) v / (nᵀ K n of both), or zero if neither can move.
    #[doc(hidden)]
    #[must_use]
    pub fn collision(
        asset: &Asset,
        point: Vec3,
        toward: Vec3,
        speed: f64,
        striker: Striker,
    ) -> Self {
        let normal = toward.normalize_or_zero();
        let mut give = f64::from(striker.inverse_effective_mass);
        if !asset.is_supported() {
            give += asset
                .mass
                .inverse_effective_mass(point.as_dvec3(), normal.as_dvec3());
        }
        let impulse = if give > 0.0 {
            (1.0 + f64::from(striker.restitution)) * speed / give
        } else {
            0.0
        };
        Self {
            impulse: impulse as f32,
            ..Self::strike(point, normal, speed as f32, striker)
        }
    }

    /// Total impulse on this body, N·s, including friction.
    #[must_use]
    pub fn whole_impulse(&self) -> Vec3 {
        self.normal.normalize_or_zero() * self.impulse + self.friction
    }

    /// A script's push as one along its own direction: nothing rubs there. A striker's contact stays as it is. None where a script's friction
    /// takes away all of its impulse.
    fn in_one(&self) -> Option<Self> {
        if !self.rubs_by_script() {
            return Some(self.clone());
        }
        let push = self.whole_impulse();
        let impulse = push.length();
        (impulse > 0.0).then(|| Self {
            normal: push,
            impulse,
            friction: Vec3::ZERO,
            ..self.clone()
        })
    }

    fn rubs_by_script(&self) -> bool {
        self.is_script() && self.friction != Vec3::ZERO
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first field that is NaN, negative or not a unit vector.
    #[doc(hidden)]
    pub fn validate(&self) -> Result<(), InputError> {
        finite("a contact's point", self.point)?;
        finite("a contact's normal", self.normal)?;
        finite("a contact's friction impulse", self.friction)?;
        positive(
            "the length of a contact's normal",
            f64::from(self.normal.length()),
            "",
        )?;
        // A script's friction is part of its push, whatever is along the normal.
        if !self.is_script() {
            finite(
                "a contact's friction impulse over its impulse",
                self.direction(),
            )?;
        }
        for (what, value) in [
            ("a contact's impulse (N·s)", self.impulse),
            ("a contact's approach speed (m/s)", self.approach_speed),
            ("a contact's duration (s)", self.duration),
            (
                "a striker's inverse effective mass (1/kg)",
                self.striker.inverse_effective_mass,
            ),
            (
                "a striker's modal duration (s)",
                self.striker.modal_duration,
            ),
        ] {
            not_negative(what, f64::from(value))?;
        }
        pulse_lasts("a contact's duration (s)", self.duration)?;
        // Infinity is meant here: a rigid or a flat striker.
        for (what, value) in [
            ("a striker's contact modulus", self.striker.contact_modulus),
            (
                "a striker's radius of curvature",
                self.striker.curvature_radius,
            ),
        ] {
            let must = "above zero, and may be infinite";
            OutOfRange::unless(value > 0.0, what, f64::from(value), must)?;
        }
        let pressure = f64::from(self.striker.crushing_pressure);
        let fits = pressure >= Material::LEAST_CRUSHING_PRESSURE;
        let (what, must) = (
            "a striker's crushing pressure",
            OutOfRange::CRUSHING_PRESSURE,
        );
        OutOfRange::unless(fits, what, pressure, must)?;
        if let Some(shared) = &self.striker.shared {
            finite("a striker's shared velocity", shared.velocity)?;
            finite("a striker's shared spin", shared.spin)?;
            let own = f64::from(self.striker.inverse_effective_mass);
            OutOfRange::unless(
                shared.fits(own),
                "a striker's inverse effective mass (1/kg)",
                own,
                "no less than the squares of the shared velocity and spin together",
            )?;
            let (what, body) = ("the number of a striker's body", shared.body);
            let fits = body < SharedMass::MOST_BODIES;
            OutOfRange::unless(fits, what, f64::from(body), "below 16777216")?;
        }
        if let Some(receptance) = &self.striker.receptance {
            receptance.validate()?;
        }
        let e = f64::from(self.striker.restitution);
        let fits = (0.0..=1.0).contains(&e);
        OutOfRange::unless(fits, "restitution", e, OutOfRange::RESTITUTION)?;
        Ok(())
    }
}

/// Shortest pulse, s: light goes a third of a millimetre meanwhile. Times in it are no normal numbers of single precision in the end.
const SHORTEST_PULSE: f32 = 1e-12;

/// Checks that a pulse, if it has a duration, is long enough to be computed.
///
/// # Errors
/// A duration that is not.
pub(crate) fn pulse_lasts(what: &'static str, duration: f32) -> Result<(), OutOfRange> {
    let fits = duration == 0.0 || duration >= SHORTEST_PULSE;
    let must = "1e-12 or more; give a longer pulse of the same impulse";
    OutOfRange::unless(fits, what, f64::from(duration), must)
}

/// These contacts with every script's push as one along its own direction.
pub(crate) fn in_one(contacts: &[Contact]) -> Cow<'_, [Contact]> {
    if contacts.iter().any(Contact::rubs_by_script) {
        contacts.iter().filter_map(Contact::in_one).collect()
    } else {
        Cow::Borrowed(contacts)
    }
}
