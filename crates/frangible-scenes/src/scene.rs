//! A scene as plain data: one body that may break, what happens to it, what it lands on.

use frangible::glam::{Quat, Vec3};
use frangible::{FractureConfig, Material};
use frangible_bake::Shape;

use crate::error::SceneError;

/// One breakable body above a floor (y = 0, y up), dropped or hit by a ball.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name, also of the files it makes.
    pub name: String,
    /// One line about what it shows.
    pub summary: String,
    /// The body's shape, in its own frame.
    pub shape: Shape,
    /// What the body is made of.
    pub material: Material,
    /// Number of vibration modes.
    pub modes: usize,
    /// Orientation of the body at the start.
    pub rotation: Quat,
    /// What happens to it.
    pub action: Action,
    /// Material preset of the floor.
    pub floor: String,
    /// Seed of weak points and crack roughness.
    pub seed: u64,
    /// Switches and numbers of the fracture.
    pub fracture: FractureConfig,
    /// Longest simulated time, s; the scene ends sooner when everything rests.
    pub duration: f64,
    /// Direction from what is looked at towards the camera.
    pub look_from: Vec3,
}

/// What happens to the body.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// It falls from rest; its lowest point starts this high above the floor.
    Drop {
        /// Height, m.
        height: f64,
    },
    /// It stands on the floor and a ball hits it.
    Ball(BallThrow),
}

/// A ball thrown at the body.
#[derive(Clone, Debug, PartialEq)]
pub struct BallThrow {
    /// Mass, kg.
    pub mass: f64,
    /// Radius, m.
    pub radius: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
    /// Where it is aimed at, m from the body's centre of mass, world axes.
    pub at: Vec3,
    /// Direction of flight, any length.
    pub toward: Vec3,
}

/// Largest speed of a ball, m/s: beyond, stress waves steepen into shocks that modes cannot carry.
const MAX_SPEED: f64 = 300.0;

/// Highest drop, m.
const MAX_HEIGHT: f64 = 100.0;

impl Scene {
    /// Checks every number before anything long begins.
    ///
    /// # Errors
    /// The first quantity at fault, and what it must be.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.material.validate()?;
        let check = |what, value: f64, low: f64, high: f64, must| {
            if value.is_finite() && value > low && value <= high {
                Ok(())
            } else {
                Err(SceneError::Quantity {
                    what,
                    value: value.to_string(),
                    must,
                })
            }
        };
        check(
            "the duration",
            self.duration,
            0.0,
            60.0,
            "above 0 and at most 60 s",
        )?;
        check(
            "the number of modes",
            self.modes as f64,
            0.0,
            1000.0,
            "1 to 1000",
        )?;
        if !(self.rotation.is_finite() && (self.rotation.length() - 1.0).abs() < 1e-3) {
            let value = self.rotation.to_string();
            return Err(SceneError::Quantity {
                what: "the body's rotation",
                value,
                must: "a unit quaternion",
            });
        }
        direction("the direction of the camera", self.look_from)?;
        Material::preset(&self.floor)?;
        match &self.action {
            Action::Drop { height } => check(
                "the drop height",
                *height,
                0.0,
                MAX_HEIGHT,
                "above 0 and at most 100 m",
            ),
            Action::Ball(ball) => {
                check(
                    "the ball's mass",
                    ball.mass,
                    0.0,
                    1e4,
                    "above 0 and at most 10000 kg",
                )?;
                check(
                    "the ball's radius",
                    ball.radius,
                    0.0,
                    10.0,
                    "above 0 and at most 10 m",
                )?;
                check(
                    "the ball's speed",
                    ball.speed,
                    0.0,
                    MAX_SPEED,
                    "above 0 and at most 300 m/s",
                )?;
                Material::preset(&ball.material)?;
                if !ball.at.is_finite() {
                    let value = ball.at.to_string();
                    return Err(SceneError::Quantity {
                        what: "--at",
                        value,
                        must: "three finite numbers, m",
                    });
                }
                direction("--toward", ball.toward)
            }
        }
    }
}

fn direction(what: &'static str, v: Vec3) -> Result<(), SceneError> {
    if v.is_finite() && v.length() > 0.0 {
        Ok(())
    } else {
        Err(SceneError::Quantity {
            what,
            value: v.to_string(),
            must: "three finite numbers, not all zero",
        })
    }
}
