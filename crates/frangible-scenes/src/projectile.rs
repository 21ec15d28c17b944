//! Projectiles.

use frangible::glam::Vec3;

/// An unbreakable projectile.
#[derive(Clone, Debug, PartialEq)]
pub struct Projectile {
    /// Shape of the projectile.
    pub kind: ProjectileKind,
    /// Mass, kg.
    pub mass: f64,
    /// Radius of the ball or of the hammer's striking face, m.
    pub radius: f64,
    /// Speed on arrival, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
    /// Index of the target body, from 0.
    pub target: usize,
    /// Aim point, m from the body's centre of mass, in world axes.
    pub at: Vec3,
    /// Direction of flight, of any length.
    pub toward: Vec3,
    /// Time at which it starts, s.
    pub delay: f64,
    /// Time after which it is removed, s, such as for a hammer that is lifted again. `None`: it stays to the end.
    pub stays: Option<f64>,
}

/// Shape of a projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProjectileKind {
    /// A solid ball.
    Ball,
    /// A hammer head: a cylinder along the flight direction with a crowned striking face; its length follows from its mass.
    Hammer {
        /// Radius of curvature of the striking face, m; never less than the face's radius.
        crown: f64,
    },
}

impl ProjectileKind {
    /// A hammer with a usual crown radius of 60 mm.
    pub const HAMMER: Self = Self::Hammer { crown: 0.06 };

    /// Name in scene files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Hammer { .. } => "hammer",
        }
    }
}

impl Projectile {
    /// A steel ball with this mass (kg), radius (m) and speed (m/s), aimed at the centre of the first body along −z.
    #[must_use]
    pub fn ball(mass: f64, radius: f64, speed: f64) -> Self {
        Self {
            kind: ProjectileKind::Ball,
            mass,
            radius,
            speed,
            material: "steel".into(),
            target: 0,
            at: Vec3::ZERO,
            toward: Vec3::NEG_Z,
            delay: 0.0,
            stays: None,
        }
    }

    /// A steel hammer head with this mass (kg), radius of its face (m) and speed (m/s), from above.
    #[must_use]
    pub fn hammer(mass: f64, radius: f64, speed: f64) -> Self {
        Self {
            kind: ProjectileKind::HAMMER,
            toward: Vec3::NEG_Y,
            ..Self::ball(mass, radius, speed)
        }
    }
}
