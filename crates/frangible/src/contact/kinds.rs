//! Contacts of an impact, as the rigid-body engine reports them.

use std::borrow::Cow;
use std::sync::Arc;

use glam::Vec3;

use super::Receptance;
use crate::asset::Asset;
use crate::config::DurationModel;
use crate::error::{InputError, finite, not_negative, positive};
use crate::material::{Material, OutOfRange};

/// One contact of an impact, in the body frame of the body that may break.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Point of contact, m.
    pub point: Vec3,
    /// Unit direction of the impulse **on this body** (from the striker into the body).
    pub normal: Vec3,
    /// Magnitude φ of the normal impulse, N·s. Only the models of the duration that are not integrated, and scripts, take it as
    /// given; of an integrated blow it is an outcome, and this number only says how large friction is in relation to it.
    pub impulse: f32,
    /// Friction's part of the impulse on this body, N·s: whatever is not along the normal.
    pub friction: Vec3,
    /// Speed of approach along the normal before the rigid-body step, m/s.
    pub approach_speed: f32,
    /// Duration of a blow that a script asks for, s: its impulse is then given as a half-sine, whatever strikes. 0 for a striker,
    /// whose blow is [integrated](crate::internals::DurationModel::Integrated).
    pub duration: f32,
    /// Body that struck.
    pub striker: Striker,
}

/// Properties of the other body that a contact depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Striker {
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid striker.
    pub contact_modulus: f32,
    /// Pressure that crushes its surface, or dents it for good, Pa ([`Material::crushing_pressure`]); infinite where none does.
    pub crushing_pressure: f32,
    /// nᵀ K n of the striker at the contact, 1/kg; zero for one that cannot move.
    pub inverse_effective_mass: f32,
    /// Radius of curvature at the contact, m; infinite for a flat one.
    pub curvature_radius: f32,
    /// Coefficient of restitution of the pair, 0..=1.
    pub restitution: f32,
    /// Duration that the other body answers with when it vibrates itself, s: of two bodies' durations the longer holds
    /// `[G12 §4.1]`. Used by the modal models; 0 for a body that is not breakable. See [`answer_duration`](super::answer_duration).
    pub modal_duration: f32,
    /// Share in the mass of a body that strikes at several points; none for a body that strikes at this point only.
    pub shared: Option<SharedMass>,
    /// Receptance of a striker that vibrates itself, for blows that are [integrated](crate::internals::DurationModel::Integrated);
    /// none for one that moves as a rigid body behind Hertz' dent. [`Striker::flexible`] finds it.
    pub receptance: Option<Arc<Receptance>>,
}

/// Share of a contact in the mass of a body that strikes at several points: an impulse at one of them moves it at the others too.
///
/// Let `a = (velocity, spin)` be the body's mass-weighted answer to a unit impulse at a contact. Then a unit impulse at contact l takes
/// `a_k · a_l` from the speed of approach at contact k of the same body, 1/kg; at its own contact that is
/// [`Striker::inverse_effective_mass`]. Without this each contact would strike with the whole mass, and the energy of the body would be
/// counted once per contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedMass {
    /// Number of the body: contacts of one impact with equal numbers are of one body. Below [`SharedMass::MOST_BODIES`].
    pub body: u32,
    /// √M times the velocity that a unit impulse along the contact's normal gives the body, 1/√kg: `M^(−1/2) n`.
    pub velocity: Vec3,
    /// √I times the spin that it gives, 1/√kg: `I^(−1/2) (r × n)` for the arm r from the centre of mass.
    pub spin: Vec3,
}

impl SharedMass {
    /// Upper limit of the numbers of bodies, which are below it.
    pub const MOST_BODIES: u32 = 1 << 24;

    /// Returns true if this inverse effective mass, 1/kg, is no smaller than its own, but for a per cent of rounding: a body that gave way less at
    /// its own contacts than from one to another would bring energy without end.
    fn fits(&self, inverse_effective_mass: f64) -> bool {
        let [velocity, spin] = [self.velocity, self.spin].map(|v| v.as_dvec3().length_squared());
        velocity + spin <= 1.01 * inverse_effective_mass
    }

    /// The share of body number `body` in a contact when no impulse moves it: one that is held fast, or that moves as it is told. Its
    /// contacts still belong together, for it may vibrate.
    #[must_use]
    pub fn immovable(body: u32) -> Self {
        Self {
            body,
            velocity: Vec3::ZERO,
            spin: Vec3::ZERO,
        }
    }

    /// The share of body number `body` in a contact: `velocity` is its `M^(−1/2) n`, `inverse_inertia` has the columns of its I⁻¹, 1/(kg·m²), and
    /// `turn` is r × n, all in world axes. Where I⁻¹ does not give way, nor does the spin.
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
    /// Radius of curvature of edges and corners, with which bodies that are no balls strike others, m.
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

    /// A flat thing that cannot move, of this material: a floor, a wall.
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

    /// A ball of this mass, kg, and radius, m, hitting centrally.
    #[must_use]
    pub fn ball(material: &Material, mass: f64, radius: f64) -> Self {
        Self {
            inverse_effective_mass: (1.0 / mass) as f32,
            curvature_radius: radius as f32,
            ..Self::fixed(material)
        }
    }

    /// Rigid, flat and fixed.
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
    /// A contact without friction: its point (m), the direction of the impulse on this body, its size (N·s), the speed of approach
    /// (m/s), and what hit the body.
    #[must_use]
    pub const fn new(
        point: Vec3,
        normal: Vec3,
        impulse: f32,
        approach_speed: f32,
        striker: Striker,
    ) -> Self {
        Self {
            point,
            normal,
            impulse,
            friction: Vec3::ZERO,
            approach_speed,
            duration: 0.0,
            striker,
        }
    }

    /// A half-sine that a script asks for: its point (m), its impulse (N·s, on this body) and its duration (s).
    #[must_use]
    pub fn script(point: Vec3, impulse: Vec3, duration: f32) -> Self {
        let mut contact = Self::new(point, impulse, impulse.length(), 0.0, Striker::rigid());
        contact.duration = duration;
        contact
    }

    /// Returns true if a script gives its impulse and duration.
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

    /// A collision of rigid bodies. The striker hits a body of this asset at `point`, m, moving `toward` a direction of any length at
    /// `speed`, m/s; the impulse is (1 + e) v / (nᵀ K n of both). Without friction; none where neither can move.
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
        Self::new(point, normal, impulse as f32, speed as f32, striker)
    }

    /// The whole impulse on this body, N·s.
    #[must_use]
    pub fn push(&self) -> Vec3 {
        self.normal.normalize_or_zero() * self.impulse + self.friction
    }

    /// A script's push as one along its own direction: nothing rubs there. A striker's contact stays as it is. None where a script's friction
    /// takes away all of its impulse.
    fn in_one(&self) -> Option<Self> {
        if !self.rubs_by_script() {
            return Some(self.clone());
        }
        let push = self.push();
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

    /// Checks that every number can be used.
    ///
    /// # Errors
    /// Names the first field that is NaN, negative or not a unit vector.
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
