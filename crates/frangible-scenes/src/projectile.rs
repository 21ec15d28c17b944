//! Projectiles that are thrown at the bodies.

use frangible::glam::Vec3;

/// Something unbreakable thrown at a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Projectile {
    /// Its form.
    pub kind: ProjectileKind,
    /// Mass, kg.
    pub mass: f64,
    /// Radius of the ball or of the hammer's striking face, m.
    pub radius: f64,
    /// Speed on arrival, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
    /// Number of the body it is aimed at, from 0.
    pub target: usize,
    /// Point that it is aimed at, m from the body's centre of mass, world axes.
    pub at: Vec3,
    /// Direction of flight, of any length.
    pub toward: Vec3,
    /// Time at which it sets out, s after the beginning.
    pub delay: f64,
    /// Time for which it stays after that, s: a hammer is lifted again. `None`: to the end.
    pub stays: Option<f64>,
}

/// Form of a projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProjectileKind {
    /// A solid ball.
    Ball,
    /// A hammer's head: a cylinder along the flight with a crowned striking face in front, as long as its mass asks for.
    Hammer {
        /// Radius of curvature of the striking face, m; never less than the face's radius.
        crown: f64,
    },
}

impl ProjectileKind {
    /// A hammer whose face is crowned as usual: 60 mm.
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
    /// A steel ball of this mass (kg), radius (m) and speed (m/s) at the first body's centre, along −z.
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

    /// A steel hammer head of this mass (kg), radius of its face (m) and speed (m/s) from above.
    #[must_use]
    pub fn hammer(mass: f64, radius: f64, speed: f64) -> Self {
        Self {
            kind: ProjectileKind::HAMMER,
            toward: Vec3::NEG_Y,
            ..Self::ball(mass, radius, speed)
        }
    }
}
