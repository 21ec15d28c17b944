//! Scenes that both engines play, and the measurements in them.

use bevy_frangible::frangible::glam::{DVec3, Quat, Vec3};
use bevy_frangible::frangible::{Breakable, Fracture, Material};

/// Steps per second in both engines: the last one counts where only one does.
pub const RATES: [f32; 3] = [60.0, 120.0, 240.0];

/// Acceleration of gravity in scenes that have it, m/s².
pub const GRAVITY: f32 = 9.81;

/// Initial pose and velocity of a thing.
#[derive(Clone, Copy)]
pub struct Start {
    /// Centre of mass, m.
    pub at: Vec3,
    /// Orientation.
    pub turn: Quat,
    /// Velocity, m/s.
    pub velocity: Vec3,
}

/// The shape of a thing that cannot break.
#[derive(Clone, Copy)]
pub enum Solid {
    /// A ball of this radius, m.
    Ball(f32),
    /// A box of these half extents, m.
    Box(Vec3),
}

/// A thing that strikes the body.
#[derive(Clone)]
pub struct Striker {
    /// Shape.
    pub solid: Solid,
    /// Material, which also gives its density.
    pub material: Material,
    /// Initial pose and velocity.
    pub start: Start,
}

/// A body and its striker.
#[derive(Clone)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// The body.
    pub kind: Breakable,
    /// Initial pose and velocity of the body.
    pub start: Start,
    /// Thing that strikes the body.
    pub striker: Option<Striker>,
    /// Material of the floor at y = 0. Without a floor there is no gravity either.
    pub floor: Option<Material>,
    /// Duration, s.
    pub seconds: f32,
}

/// Outcome of a scene.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// The first break, if there was one.
    pub broke: Option<Break>,
    /// The striker's velocity at the end, m/s.
    pub striker: Vec3,
}

/// Measurements of the first break.
#[derive(Clone, Debug)]
pub struct Break {
    /// Number of pieces.
    pub pieces: usize,
    /// Time from the beginning of the contact to the first crack, s.
    pub first_crack: f64,
    /// Energy of the cracks, J.
    pub cracks: f64,
    /// Impulse of the blow, N·s.
    pub impulse: f64,
    /// Kinetic energy before and after the step of the break, J.
    pub energy: [f64; 2],
    /// Momentum before and after that step, N·s.
    pub momentum: [DVec3; 2],
}

impl Break {
    /// Takes a break's report, and the motion before and after its step.
    pub fn new(fracture: &Fracture, [before, after]: [(f64, DVec3); 2]) -> Self {
        let report = &fracture.report;
        Self {
            pieces: fracture.fragments.len(),
            first_crack: report.first_crack_time.unwrap_or(f64::NAN),
            cracks: report.fracture_energy,
            impulse: report.contacts.iter().map(|c| c.impulse).sum(),
            energy: [before.0, after.0],
            momentum: [before.1, after.1],
        }
    }
}

impl Scene {
    /// Speed that the striker has lost at the end, m/s.
    pub fn lost(&self, outcome: &Outcome) -> Option<f64> {
        let before = self.striker.as_ref()?.start.velocity;
        Some(f64::from(
            (before - outcome.striker).dot(before.normalize()),
        ))
    }
}

impl Start {
    /// At a place, at rest.
    pub fn at(at: Vec3) -> Self {
        Self {
            at,
            turn: Quat::IDENTITY,
            velocity: Vec3::ZERO,
        }
    }
}

/// A ball of steel of 129.7 g that flies at a free pane, a little off its middle.
pub fn ball_on_pane(pane: &Breakable, steel: &Material, speed: f32) -> Scene {
    let start = Start {
        velocity: Vec3::NEG_Z * speed,
        ..Start::at(Vec3::new(0.01, 0.005, 0.1))
    };
    Scene {
        name: format!("ball on pane, {speed} m/s"),
        kind: pane.clone(),
        start: Start::at(Vec3::ZERO),
        striker: Some(Striker {
            solid: Solid::Ball(0.0158),
            material: steel.clone(),
            start,
        }),
        floor: None,
        seconds: 0.25,
    }
}

/// The lowest point of a kind that is turned, m below its centre of mass.
fn depth(kind: &Breakable, turn: Quat) -> f32 {
    let surface = kind.asset().surface_positions().iter();
    -surface.map(|&p| (turn * p).y).fold(f32::INFINITY, f32::min)
}

/// A body that falls on stone and is 5 mm above it.
pub fn dropped(name: &str, kind: &Breakable, stone: &Material, turn: Quat, speed: f32) -> Scene {
    let at = Vec3::Y * (depth(kind, turn) + 5e-3);
    Scene {
        name: format!("{name} on stone, {speed} m/s"),
        kind: kind.clone(),
        start: Start {
            at,
            turn,
            velocity: Vec3::NEG_Y * speed,
        },
        striker: None,
        floor: Some(stone.clone()),
        seconds: 0.25,
    }
}

/// A brick of stone of 2.8 kg that falls with a corner first on a plate, which lies along x and z and is held.
pub fn brick_on_plate(plate: &Breakable, stone: &Material, speed: f32) -> Scene {
    let flat = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let half = Vec3::new(0.105, 0.05, 0.025);
    let turn = Quat::from_rotation_z(0.5) * Quat::from_rotation_x(0.4);
    let lowest: f32 = (0..3)
        .map(|k| (turn * Vec3::AXES[k] * half[k]).y.abs())
        .sum();
    // A metre above the floor, so that pieces fall freely.
    let height = 1.0 + depth(plate, flat) + lowest + 5e-3;
    Scene {
        name: format!("brick on held plate, {speed} m/s"),
        kind: plate.clone(),
        start: Start {
            turn: flat,
            ..Start::at(Vec3::Y)
        },
        striker: Some(Striker {
            solid: Solid::Box(half),
            material: stone.clone(),
            start: Start {
                at: Vec3::new(0.02, height, 0.01),
                turn,
                velocity: Vec3::NEG_Y * speed,
            },
        }),
        floor: Some(stone.clone()),
        seconds: 0.25,
    }
}
