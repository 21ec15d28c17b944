//! Contacts and strikers of an impact.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{Mat3, Vec3};

use super::Receptance;
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

/// Properties of the striking body that determine a contact, as [`Striker::fixed`], [`Striker::ball`], [`Striker::body`] or
/// [`Striker::flexible`] make them; methods named `with_…` change one.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Striker {
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid striker.
    #[doc(hidden)]
    pub contact_modulus: f32,
    /// Pressure that crushes or permanently dents its surface, Pa ([`Material::crushing_pressure`]); infinite if none does.
    #[doc(hidden)]
    pub crushing_pressure: f32,
    /// Inverse effective mass nᵀ K n of the striker at the contact, 1/kg; zero for an immovable striker.
    #[doc(hidden)]
    pub inverse_effective_mass: f32,
    /// Radius of curvature at the contact, m; infinite for a flat striker.
    #[doc(hidden)]
    pub curvature_radius: f32,
    /// Coefficient of restitution of the pair, 0..=1.
    #[doc(hidden)]
    pub restitution: f32,
    /// Contact duration of the striker's own vibration, s; the longer of the durations of both bodies applies `[G12 §4.1]`. Used by the
    /// modal duration models; 0 for a striker that is not breakable. See [`answer_duration`](super::answer_duration).
    #[doc(hidden)]
    pub modal_duration: f32,
    /// Mass coupling of a striker with several contacts; `None` for a single contact.
    #[doc(hidden)]
    pub shared: Option<SharedMass>,
    /// Receptance of a vibrating striker, for [integrated](crate::internals::DurationModel::Integrated) blows; `None` for a rigid striker
    /// with a Hertz contact. Computed by [`Striker::flexible`].
    #[doc(hidden)]
    pub receptance: Option<Arc<Receptance>>,
}

/// Mass coupling between the contacts of a striker that hits at several points: an impulse at one contact moves the striker at the others.
///
/// Let `a = (velocity, spin)` be the mass-weighted response of the striker to a unit impulse at a contact. A unit impulse at contact l
/// reduces the approach speed at contact k of the same striker by `a_k · a_l`, 1/kg; for k = l this is
/// [`Striker::inverse_effective_mass`]. Without the coupling each contact would strike with the whole mass, and the energy of the striker
/// would be counted once per contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedMass {
    /// Number of the striker: contacts of one impact with equal numbers belong to the same striker. Below [`SharedMass::MOST_BODIES`].
    pub body: u32,
    /// √M times the velocity change by a unit impulse along the contact normal, 1/√kg: `M^(−1/2) n`.
    pub velocity: Vec3,
    /// √I times the spin change by that impulse, 1/√kg: `I^(−1/2) (r × n)` with the arm r from the centre of mass.
    pub spin: Vec3,
}

impl SharedMass {
    /// Exclusive upper limit of [`SharedMass::body`].
    pub const MOST_BODIES: u32 = 1 << 24;

    /// Returns true if this inverse effective mass, 1/kg, is no smaller than its own, but for a per cent of rounding: a body that gave way less at
    /// its own contacts than from one to another would bring energy without end.
    fn fits(&self, inverse_effective_mass: f64) -> bool {
        let [velocity, spin] = [self.velocity, self.spin].map(|v| v.as_dvec3().length_squared());
        velocity + spin <= 1.01 * inverse_effective_mass
    }

    /// Coupling of striker number `body` that no impulse moves, because it is fixed or kinematic. Its contacts still belong together, because
    /// it may vibrate.
    #[must_use]
    pub fn immovable(body: u32) -> Self {
        Self {
            body,
            velocity: Vec3::ZERO,
            spin: Vec3::ZERO,
        }
    }

    /// Coupling of striker number `body`: `velocity` is `M^(−1/2) n`, `inverse_inertia` holds the columns of I⁻¹, 1/(kg·m²), and `turn` is
    /// r × n, all in world axes. Axes with zero I⁻¹ get no spin.
    #[must_use]
    pub fn of(body: u32, velocity: Vec3, inverse_inertia: [Vec3; 3], turn: Vec3) -> Self {
        // I⁻¹ = L Lᵀ: the square of Lᵀ turn is the part of the spin in the inverse effective mass.
        let spins = lower_factor(inverse_inertia);
        Self {
            body,
            velocity,
            spin: Vec3::from_array(spins.map(|column| column.dot(turn))),
        }
    }
}

/// Columns of the lower triangular L with L Lᵀ = the symmetric matrix of these columns; zero where a pivot is not positive.
fn lower_factor(columns: [Vec3; 3]) -> [Vec3; 3] {
    let mut rest = columns;
    std::array::from_fn(|k| {
        let pivot = rest[k][k];
        if pivot <= 0.0 {
            return Vec3::ZERO;
        }
        let column = rest[k] / pivot.sqrt();
        for (l, other) in rest.iter_mut().enumerate() {
            *other -= column * column[l];
        }
        column
    })
}

impl Striker {
    /// Radius of curvature assumed for striking edges and corners, m.
    pub const EDGE_RADIUS: f32 = 3e-3;

    /// Speed of approach that a unit impulse at the contact of `other` takes away at this one, which is another contact, 1/kg.
    pub(crate) fn inverse_mass_between(&self, other: &Self) -> f64 {
        match (&self.shared, &other.shared) {
            (Some(a), Some(b)) if a.body == b.body => {
                let velocity = a.velocity.as_dvec3().dot(b.velocity.as_dvec3());
                velocity + a.spin.as_dvec3().dot(b.spin.as_dvec3())
            }
            _ => 0.0,
        }
    }

    /// An immovable flat striker of this material, such as a floor or a wall.
    #[must_use]
    pub fn fixed(material: &Material) -> Self {
        Self {
            contact_modulus: material.contact_modulus() as f32,
            crushing_pressure: material.crushing_pressure as f32,
            inverse_effective_mass: 0.0,
            curvature_radius: f32::INFINITY,
            restitution: material.restitution as f32,
            modal_duration: 0.0,
            shared: None,
            receptance: None,
        }
    }

    /// A ball of this mass, kg, and radius, m, in a central impact.
    #[must_use]
    pub fn ball(material: &Material, mass: f64, radius: f64) -> Self {
        Self {
            inverse_effective_mass: (1.0 / mass) as f32,
            curvature_radius: radius as f32,
            ..Self::fixed(material)
        }
    }

    /// A moving rigid body with edges, such as a table or a hammer: its mass, kg, the inverse of its inertia tensor, 1/(kg·m²), and, in the same axes,
    /// `arm`, m, from its centre of mass to the contact and `normal`, the unit direction of the blow. Contacts of one impact with equal `number`
    /// belong to one body, so that an impulse at one of them moves it at the others.
    #[must_use]
    pub fn body(
        material: &Material,
        number: u32,
        mass: f64,
        inverse_inertia: Mat3,
        arm: Vec3,
        normal: Vec3,
    ) -> Self {
        let columns = [
            inverse_inertia.x_axis,
            inverse_inertia.y_axis,
            inverse_inertia.z_axis,
        ];
        let velocity = normal * (1.0 / mass).sqrt() as f32;
        let shared = SharedMass::of(number, velocity, columns, arm.cross(normal));
        Self {
            inverse_effective_mass: shared.velocity.length_squared() + shared.spin.length_squared(),
            curvature_radius: Self::EDGE_RADIUS,
            shared: Some(shared),
            ..Self::fixed(material)
        }
    }

    /// The same striker with this effective mass at the contact, kg: of a ball its mass, of a body that turns when it is struck less.
    #[must_use]
    pub fn with_effective_mass(self, mass: f64) -> Self {
        Self {
            inverse_effective_mass: (1.0 / mass) as f32,
            ..self
        }
    }

    /// The same striker with this radius of curvature at the contact, m.
    #[must_use]
    pub fn with_curvature_radius(self, radius: f64) -> Self {
        Self {
            curvature_radius: radius as f32,
            ..self
        }
    }

    /// The same striker with this coefficient of restitution of the pair, 0..=1.
    #[must_use]
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self {
            restitution: restitution as f32,
            ..self
        }
    }

    /// The same striker with this plane-strain modulus E/(1−ν²), Pa.
    #[doc(hidden)]
    #[must_use]
    pub fn with_contact_modulus(self, modulus: f64) -> Self {
        Self {
            contact_modulus: modulus as f32,
            ..self
        }
    }

    /// A rigid, flat and immovable striker.
    #[must_use]
    pub const fn rigid() -> Self {
        Self {
            contact_modulus: f32::INFINITY,
            crushing_pressure: f32::INFINITY,
            inverse_effective_mass: 0.0,
            curvature_radius: f32::INFINITY,
            restitution: 0.0,
            modal_duration: 0.0,
            shared: None,
            receptance: None,
        }
    }
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

/// These contacts with every script's push as one along its own direction.
pub(crate) fn in_one(contacts: &[Contact]) -> Cow<'_, [Contact]> {
    if contacts.iter().any(Contact::rubs_by_script) {
        contacts.iter().filter_map(Contact::in_one).collect()
    } else {
        Cow::Borrowed(contacts)
    }
}
