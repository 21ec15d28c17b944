//! Strikers: their stiffness, shape and mass at a contact.

use std::sync::Arc;

use glam::{Mat3, Vec3};

use super::Receptance;
use crate::material::Material;

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
    pub(super) fn fits(&self, inverse_effective_mass: f64) -> bool {
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

    /// Sets the effective mass at the contact, kg: the mass of a ball, less for a body that turns when it is struck.
    #[must_use]
    pub fn with_effective_mass(self, mass: f64) -> Self {
        Self {
            inverse_effective_mass: (1.0 / mass) as f32,
            ..self
        }
    }

    /// Sets the radius of curvature at the contact, m.
    #[must_use]
    pub fn with_curvature_radius(self, radius: f64) -> Self {
        Self {
            curvature_radius: radius as f32,
            ..self
        }
    }

    /// Sets the coefficient of restitution of the pair, 0..=1.
    #[must_use]
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self {
            restitution: restitution as f32,
            ..self
        }
    }

    /// Sets the plane-strain modulus E/(1−ν²), Pa.
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
