//! From the command line to a scene.

use std::error::Error;

use frangible::Material;
use frangible::glam::Vec3;
use frangible_scenes::{Action, BallThrow, Scene, scene};

use crate::args::BreakArgs;

/// The scene that was asked for, every number checked.
pub(crate) fn scene_of(args: &BreakArgs) -> Result<Scene, Box<dyn Error>> {
    let mut wanted = scene(&args.scene)?;
    if let Some(name) = &args.material {
        wanted.material = Material::preset(name)?;
    }
    if let Some(height) = args.drop {
        wanted.action = Action::Drop { height };
    }
    if let Some(ball) = &args.ball {
        let mut throw = parse_ball(ball)?;
        if let Some(at) = &args.at {
            throw.at = parse_vector("--at", at)?;
        }
        if let Some(toward) = &args.toward {
            throw.toward = parse_vector("--toward", toward)?;
        }
        wanted.action = Action::Ball(throw);
    }
    if let Some(modes) = args.modes {
        wanted.modes = usize::try_from(modes)
            .ok()
            .filter(|&m| m > 0)
            .ok_or_else(|| {
                format!("--modes is {modes}; it must be 1 or more (100 is plenty for most bodies)")
            })?;
    }
    if let Some(seed) = args.seed {
        wanted.seed = seed;
    }
    wanted.validate()?;
    Ok(wanted)
}

fn parse_ball(text: &str) -> Result<BallThrow, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let ([mass, radius, speed] | [mass, radius, speed, _]) = parts[..] else {
        return Err(format!(
            "--ball is `{text}`; it must be MASS,RADIUS,SPEED[,MATERIAL], for example 0.1,0.015,10,steel"
        ));
    };
    let number = |what: &str, unit: &str, s: &str| {
        s.parse::<f64>()
            .map_err(|_| format!("--ball: the {what} is `{s}`; it must be a number, in {unit}"))
    };
    Ok(BallThrow {
        mass: number("mass", "kg", mass)?,
        radius: number("radius", "m", radius)?,
        speed: number("speed", "m/s", speed)?,
        material: parts.get(3).copied().unwrap_or("steel").to_string(),
        at: Vec3::ZERO,
        toward: Vec3::NEG_Z,
    })
}

fn parse_vector(what: &str, text: &str) -> Result<Vec3, String> {
    let wrong =
        || format!("{what} is `{text}`; it must be three numbers x,y,z, for example 0,0.02,0");
    let parts: Vec<f32> = text
        .split(',')
        .map(|s| s.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| wrong())?;
    let [x, y, z] = parts[..] else {
        return Err(wrong());
    };
    Ok(Vec3::new(x, y, z))
}
