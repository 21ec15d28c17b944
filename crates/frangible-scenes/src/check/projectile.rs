//! Checks of one projectile.

use frangible::Material;

use super::quantity::{direction, quantity, range};
use super::{Fault, MAX_SPEED};
use crate::projectile::{Projectile, ProjectileKind};

pub(super) fn check_projectile(projectile: &Projectile, bodies: usize) -> Result<(), Fault> {
    let ball = projectile.kind == ProjectileKind::Ball;
    let what = |of_ball, of_hammer| if ball { of_ball } else { of_hammer };
    range(
        "mass",
        what("the ball's mass", "the hammer's mass"),
        projectile.mass,
        0.0,
        1e4,
        "above 0 and at most 10000 kg",
    )?;
    range(
        "radius",
        what("the ball's radius", "the hammer's radius"),
        projectile.radius,
        0.0,
        10.0,
        "above 0 and at most 10 m",
    )?;
    range(
        "speed",
        what("the ball's speed", "the hammer's speed"),
        projectile.speed,
        0.0,
        MAX_SPEED,
        "above 0 and at most 300 m/s",
    )?;
    if let ProjectileKind::Hammer { crown } = projectile.kind
        && !(crown.is_finite() && crown >= projectile.radius)
    {
        let must = "a finite length, no less than the face's radius, in m";
        return Err(quantity("crown", "the hammer's crown", crown, must));
    }
    Material::preset(&projectile.material).map_err(|e| Fault::new("material", e))?;
    if projectile.target >= bodies {
        let must = "the number of a body of the scene";
        let target = projectile.target + 1;
        return Err(quantity("target", "the target", target, must));
    }
    if !projectile.at.is_finite() {
        return Err(quantity(
            "at",
            "--at",
            projectile.at,
            "three finite numbers, m",
        ));
    }
    let within = |key, what, seconds: f64| {
        if (0.0..=60.0).contains(&seconds) {
            Ok(())
        } else {
            Err(quantity(key, what, seconds, "0 to 60 s"))
        }
    };
    within("delay", "the projectile's delay", projectile.delay)?;
    within(
        "stays",
        "the time the projectile stays",
        projectile.stays.unwrap_or(0.0),
    )?;
    direction("toward", "--toward", projectile.toward)
}
