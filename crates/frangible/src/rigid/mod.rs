//! Motion of bodies after a break, in plain numbers: any engine turns its bodies into [`Rigid`]s, has the blow's impulse put on
//! the pieces and the cracks' energy taken from the motion, and takes the velocities back.
//!
//! **The blow.** Where the motion of the pieces was followed through the blow ([`Fracture::moves_apart`]), all of them together take the impulse
//! as one body ([`push_whole`]), and then [move apart](part) as they did in it. Where that was not followed, or the blow [is local](is_local), the
//! striker pushes a plug as heavy as the blow made it, not a single splinter with all the momentum of a wall: the pieces nearest to the contacts take
//! the impulse as one body, the fewest that do not leave faster than the striker follows, and all of them where even they do. What the motion loses
//! by it went into vibration.
//!
//! A ball then [flies through](fly_through) the pieces in its way. A body that [has held](take_held) the blow gets its impulses as a whole.
//!
//! **The toll.** What the cracks cost beyond that is taken from the motion of pieces and striker against their common rigid motion, the
//! one with their momentum and angular momentum. Every body's deviation from it is scaled by √(1 − E/T), T the deviations' kinetic
//! energy: their sum carries neither momentum nor angular momentum, so both stay. Where one of them does not give way the common
//! motion is its own, so that the toll comes from the fall that broke the body, or from the striker that broke what was held.

mod blow;
mod held;
mod meet;
mod passage;

use glam::{DMat3, DVec3};

pub use blow::{
    affordable, is_local, kick_together, nearest_first, part, push_plug, push_whole, take_blow,
    take_energy,
};
pub use held::take_held;
pub use passage::{APART, Ball, fly_through, pass};

/// A rigid body, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Rigid {
    /// Mass, kg; infinite for one that does not give way.
    pub mass: f64,
    /// Moments of inertia about the centre, kg·m².
    pub inertia: DMat3,
    /// One over the mass as an impulse meets it, 1/kg: less where an engine has locked an axis.
    pub inverse_mass: f64,
    /// Inverse of the inertia as a moment meets it, 1/(kg·m²): less where an engine has locked an axis.
    pub inverse_inertia: DMat3,
    /// Centre of mass, m.
    pub centre: DVec3,
    /// Velocity of the centre, m/s.
    pub linear: DVec3,
    /// Angular velocity, rad/s.
    pub angular: DVec3,
}

/// Impulses at points: m and N·s.
pub type Pushes = [(DVec3, DVec3)];

/// An impulse, N·s, and its moment about the centre of mass of what gets it, N·m·s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kick {
    /// The impulse.
    pub linear: DVec3,
    /// The moment.
    pub moment: DVec3,
}

impl Kick {
    /// Sums up impulses at points, about a centre.
    #[must_use]
    pub fn about(centre: DVec3, pushes: &Pushes) -> Self {
        let mut kick = Self::default();
        for &(point, impulse) in pushes {
            kick.linear += impulse;
            kick.moment += (point - centre).cross(impulse);
        }
        kick
    }

    /// The kick times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            linear: self.linear * factor,
            moment: self.moment * factor,
        }
    }
}

impl Rigid {
    /// A body that is free to move; an immovable one where the numbers cannot be those of a body.
    #[must_use]
    pub fn free(mass: f64, inertia: DMat3, [centre, linear, angular]: [DVec3; 3]) -> Self {
        let inverse_inertia = inertia.inverse();
        if !(mass > 0.0 && mass.is_finite() && inverse_inertia.is_finite()) {
            return Self::immovable([centre, linear, angular]);
        }
        Self {
            mass,
            inertia,
            inverse_mass: 1.0 / mass,
            inverse_inertia,
            centre,
            linear,
            angular,
        }
    }

    /// A body that no impulse moves, whatever its motion.
    #[must_use]
    pub fn immovable([centre, linear, angular]: [DVec3; 3]) -> Self {
        Self {
            mass: f64::INFINITY,
            inertia: DMat3::IDENTITY,
            inverse_mass: 0.0,
            inverse_inertia: DMat3::ZERO,
            centre,
            linear,
            angular,
        }
    }

    /// A body that stands still, whatever pushes it.
    #[must_use]
    pub fn earth() -> Self {
        Self::immovable([DVec3::ZERO; 3])
    }

    /// Returns true if it is a body that moves freely.
    #[must_use]
    pub fn gives_way(&self) -> bool {
        self.mass.is_finite()
    }

    /// Bodies taken as one, with their mass, momentum and angular momentum: the one alone, those of several that give way, and the earth
    /// where none is left.
    #[must_use]
    pub fn together(bodies: &[Self]) -> Self {
        if let [only] = bodies {
            return *only;
        }
        let all = || bodies.iter().filter(|b| b.gives_way());
        let mass: f64 = all().map(|b| b.mass).sum();
        let mean =
            |of: &dyn Fn(&Self) -> DVec3| all().map(|b| of(b) * b.mass).sum::<DVec3>() / mass;
        let (centre, linear) = (mean(&|b| b.centre), mean(&|b| b.linear));
        let (mut inertia, mut spin) = (DMat3::ZERO, DVec3::ZERO);
        for b in all() {
            let r = b.centre - centre;
            // Steiner: m (r² 1 − r rᵀ).
            let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
            let steiner = DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer;
            inertia += b.inertia + steiner * b.mass;
            spin += b.inertia * b.angular + r.cross(b.linear - linear) * b.mass;
        }
        let angular = inertia.inverse() * spin;
        if !(linear.is_finite() && angular.is_finite()) {
            return Self::earth();
        }
        Self::free(mass, inertia, [centre, linear, angular])
    }

    /// Kinetic energy, J; none of what does not give way.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.deviation(DVec3::ZERO, DVec3::ZERO)
    }

    /// Kinetic energy of its motion against another, J.
    fn deviation(&self, linear: DVec3, angular: DVec3) -> f64 {
        if !self.gives_way() {
            return 0.0;
        }
        let (u, w) = (self.linear - linear, self.angular - angular);
        0.5 * (self.mass * u.length_squared() + w.dot(self.inertia * w))
    }

    /// Velocity of the rigid motion at a point, m/s.
    #[must_use]
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.linear + self.angular.cross(point - self.centre)
    }

    /// Rate at which a kick works on its motion, J.
    #[must_use]
    pub fn work(&self, kick: Kick) -> f64 {
        kick.linear.dot(self.linear) + kick.moment.dot(self.angular)
    }

    /// Change of velocity and angular velocity by a kick.
    #[must_use]
    pub fn answer(&self, kick: Kick) -> (DVec3, DVec3) {
        (
            kick.linear * self.inverse_mass,
            self.inverse_inertia * kick.moment,
        )
    }

    /// Twice the energy that a kick brings to it at rest, J: the measure of how much it gives way.
    #[must_use]
    pub fn give(&self, kick: Kick) -> f64 {
        let (linear, angular) = self.answer(kick);
        kick.linear.dot(linear) + kick.moment.dot(angular)
    }
}
