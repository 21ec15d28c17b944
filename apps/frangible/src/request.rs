//! Makes scenes from the command line.

use std::error::Error;
use std::path::Path;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::frangible_mesh::PartChoice;
use frangible_bake::{MOST_MODES, USUAL_MODES};
use frangible_scenes::{
    Axis, BodySource, FileKind, FileWish, MaterialEdit, Projectile, SCENE_NAMES, Scene,
};

use crate::args::{BakeArgs, BreakArgs, MeshArgs, ModesArgs, SceneArgs};
use crate::support::parse_support;

/// A scene, with notes on the defaults that were chosen for it.
pub(crate) struct Request {
    pub(crate) scene: Scene,
    pub(crate) notes: Vec<String>,
}

/// Scene to break, with the outputs to make, every number checked.
pub(crate) fn break_of(file: Option<&Path>, args: &BreakArgs) -> Result<Request, Box<dyn Error>> {
    let mut request = scene_of(file, &args.scene)?;
    let wanted = &mut request.scene;
    if let Some(n) = args.contact_sheet {
        if args.no_pictures {
            return Err(format!(
                "--contact-sheet {n} draws a picture, which --no-pictures forbids; remove one of the two"
            )
            .into());
        }
        wanted.output.seeds = usize::try_from(n)
            .ok()
            .filter(|n| (1..=36).contains(n))
            .ok_or_else(|| format!("--contact-sheet is {n}; it must be 1 to 36"))?;
        if !wanted.output.contact_sheet.is_wanted() {
            wanted.output.contact_sheet = FileWish::Yes;
        }
    }
    if let Some(drawing) = args.drawing {
        wanted.output.drawing = drawing.into();
    }
    if args.no_pictures {
        wanted.output.picture = FileWish::No;
        wanted.output.contact_sheet = FileWish::No;
    }
    if args.no_sound {
        wanted.output.wav = FileWish::No;
    }
    Ok(request)
}

/// The scene to break, every number checked.
pub(crate) fn scene_of(file: Option<&Path>, args: &SceneArgs) -> Result<Request, Box<dyn Error>> {
    let mut wanted = opened(file, args.scene.as_deref())?;
    let mut notes = Vec::new();
    if let Some(file) = file
        && FileKind::of(file)? != FileKind::Scene
    {
        if args.material.is_none() && FileKind::of(file)? == FileKind::Mesh {
            let material = &wanted.bodies[0].material.name;
            notes.push(format!(
                "material {material}, because none was given (--material)"
            ));
        }
        if args.drop.is_none() && args.ball.is_none() && args.supports.is_empty() {
            notes.push(
                "dropped from 1.5 m, because no other blow was given (--drop, --ball)".into(),
            );
        }
    }
    set_material(&mut wanted, args.material.as_deref())?;
    set_modes(&mut wanted, args.modes)?;
    if let Some(generations) = args.generations {
        wanted.pieces.generations = generations;
    }
    set_mesh(&mut wanted, &args.mesh)?;
    set_supports(&mut wanted, &args.supports)?;
    if let Some(height) = args.drop {
        wanted.drop_all(height);
    }
    if let Some(ball) = &args.ball {
        let mut throw = parse_ball(ball)?;
        if let Some(at) = &args.at {
            throw.at = parse_vector("--at", at)?;
        }
        if let Some(toward) = &args.toward {
            throw.toward = parse_vector("--toward", toward)?;
        }
        wanted.throw(throw);
    }
    if let ([body], []) = (&wanted.bodies[..], &wanted.projectiles[..])
        && !body.supports.is_empty()
    {
        return Err(
            "a supported body cannot be dropped; throw a ball at it, for example --ball 0.1,0.015,10"
                .into(),
        );
    }
    if let Some(seed) = args.seed {
        wanted.seed = seed;
    }
    wanted.validate()?;
    Ok(Request {
        scene: wanted,
        notes,
    })
}

/// The scene whose only body is to be baked, every number checked.
pub(crate) fn body_of(args: &BakeArgs) -> Result<Scene, Box<dyn Error>> {
    let mut wanted = opened(args.file.as_deref(), args.scene.as_deref())?;
    match &wanted.bodies[..] {
        [body] if matches!(body.source, BodySource::Asset(_)) => {
            return Err(
                "the file holds a body that is already baked; bake the mesh it was made from"
                    .into(),
            );
        }
        [_] => {}
        bodies => {
            let count = bodies.len();
            return Err(format!(
                "the scene has {count} bodies, but a .frangible file holds one; bake a scene with one body"
            )
            .into());
        }
    }
    set_material(&mut wanted, args.material.as_deref())?;
    set_modes(&mut wanted, args.modes)?;
    set_followed(&mut wanted, args.followed)?;
    set_mesh(&mut wanted, &args.mesh)?;
    set_supports(&mut wanted, &args.supports)?;
    wanted.validate()?;
    Ok(wanted)
}

/// Scene whose only body is analysed, every number checked.
pub(crate) fn body_with_modes(args: &ModesArgs) -> Result<Scene, Box<dyn Error>> {
    let mut wanted = opened(args.file.as_deref(), args.scene.as_deref())?;
    if wanted.bodies.len() != 1 {
        let count = wanted.bodies.len();
        return Err(format!(
            "the scene has {count} bodies, but modes are shown for one body at a time; give a scene with one body"
        )
        .into());
    }
    set_material(&mut wanted, args.material.as_deref())?;
    set_mesh(&mut wanted, &args.mesh)?;
    wanted.validate()?;
    Ok(wanted)
}

/// The scene of a file, or the built-in one of this name.
fn opened(file: Option<&Path>, name: Option<&str>) -> Result<Scene, Box<dyn Error>> {
    let taken_for_file = file
        .filter(|file| !file.exists())
        .and_then(Path::to_str)
        .filter(|given| SCENE_NAMES.contains(given));
    if let Some(scene) = taken_for_file {
        return Err(format!(
            "there is no file `{scene}`; for the built-in scene of that name, give --scene {scene}"
        )
        .into());
    }
    Ok(frangible_scenes::scene_of(file, name)?)
}

fn set_material(scene: &mut Scene, name: Option<&str>) -> Result<(), Box<dyn Error>> {
    let Some(name) = name else { return Ok(()) };
    let material = Material::preset(name)?;
    for body in &mut scene.bodies {
        if matches!(body.source, BodySource::Asset(_)) {
            // Rescaled, not baked again: the file is read later, and may refuse.
            body.rescale.material = Some(MaterialEdit::preset(name));
        }
        body.material = material.clone();
    }
    Ok(())
}

fn set_modes(scene: &mut Scene, modes: Option<i64>) -> Result<(), Box<dyn Error>> {
    let Some(modes) = modes else { return Ok(()) };
    let count = usize::try_from(modes)
        .ok()
        .filter(|&m| m > 0)
        .ok_or_else(|| {
            format!("--modes is {modes}; it must be 1 to {MOST_MODES} ({USUAL_MODES} is plenty for most bodies)")
        })?;
    refuse_baked(scene, "--modes")?;
    for body in &mut scene.bodies {
        body.modes = count;
    }
    Ok(())
}

fn set_followed(scene: &mut Scene, followed: Option<i64>) -> Result<(), Box<dyn Error>> {
    let Some(followed) = followed else {
        return Ok(());
    };
    let count = usize::try_from(followed).ok().filter(|&m| m > 0);
    let count = count.ok_or_else(|| {
        format!("--followed is {followed}; it must be 1 to the number of modes, or be left out")
    })?;
    for body in &mut scene.bodies {
        body.followed = Some(count);
    }
    Ok(())
}

fn refuse_baked(scene: &Scene, option: &str) -> Result<(), String> {
    let baked = scene
        .bodies
        .iter()
        .find(|body| matches!(body.source, BodySource::Asset(_)));
    match baked {
        None => Ok(()),
        Some(body) => Err(format!(
            "{option} cannot change `{}`, which is already baked; give it to `frangible bake` instead",
            body.name
        )),
    }
}

/// Adds to the scene's supports.
fn set_supports(scene: &mut Scene, specs: &[String]) -> Result<(), String> {
    if specs.is_empty() {
        return Ok(());
    }
    refuse_baked(scene, "--support")?;
    let [body] = &mut scene.bodies[..] else {
        return Err(
            "--support applies to a single body, but the scene has several; set `supports` in the scene file".into(),
        );
    };
    for spec in specs {
        body.supports.push(parse_support(spec)?);
    }
    Ok(())
}

fn set_mesh(scene: &mut Scene, args: &MeshArgs) -> Result<(), String> {
    let axis = match args.up.as_deref() {
        None => None,
        Some(name) => Some(
            Axis::from_name(name)
                .ok_or_else(|| format!("--up is `{name}`; it must be x, y or z"))?,
        ),
    };
    let parts = parts_of(args)?;
    // The resolution stands last, because any body that is not baked takes it.
    let given = [
        ("--size", args.size.is_some()),
        ("--up", axis.is_some()),
        ("--wall", args.wall.is_some()),
        ("--parts", parts.is_some()),
        ("--resolution", args.resolution.is_some()),
    ];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else {
        return Ok(());
    };
    if scene.bodies.len() != 1 {
        return Err(format!(
            "{option} applies to a single body, but the scene has several; set it in the scene file"
        ));
    }
    for (option, given) in [
        ("--resolution", args.resolution.is_some()),
        ("--wall", args.wall.is_some()),
    ] {
        if given {
            refuse_baked(scene, option)?;
        }
    }
    let only_resolution =
        args.size.is_none() && axis.is_none() && args.wall.is_none() && parts.is_none();
    let body = &mut scene.bodies[0];
    match &mut body.source {
        BodySource::Mesh {
            size,
            resolution,
            up,
            wall,
            parts: chosen,
            ..
        } => {
            if let Some(parts) = parts {
                *chosen = parts;
            }
            if args.wall.is_some() {
                *wall = args.wall;
            }
            if args.size.is_some() {
                *size = args.size;
            }
            if let Some(tets) = args.resolution {
                *resolution = Some(count(tets)?);
            }
            *up = axis.unwrap_or(*up);
            Ok(())
        }
        BodySource::Ready { resolution, .. } if only_resolution => {
            if let Some(tets) = args.resolution {
                *resolution = Some(count(tets)?);
            }
            Ok(())
        }
        BodySource::Shape(_) if only_resolution => {
            if let Some(tets) = args.resolution {
                body.resolution = Some(count(tets)?);
            }
            Ok(())
        }
        BodySource::Asset(_) if parts.is_none() => {
            if args.size.is_some() {
                body.rescale.size = args.size;
            }
            if let Some(up) = axis {
                body.rotation = upright(up);
            }
            Ok(())
        }
        _ => Err(format!(
            "{option} applies only to mesh files (.obj, .stl, .ply, .gltf, .glb){}",
            if ["--wall", "--parts"].contains(&option) {
                ""
            } else {
                " and baked bodies"
            }
        )),
    }
}

fn parts_of(args: &MeshArgs) -> Result<Option<PartChoice>, String> {
    let gap = args.gap;
    match (args.parts.as_deref(), gap) {
        (None, None) => Ok(None),
        (Some("weld"), gap) => Ok(Some(PartChoice::Weld { gap })),
        (_, Some(_)) => Err("--gap is for parts that are welded; add --parts weld".into()),
        (Some("separate"), None) => Ok(Some(PartChoice::Separate)),
        (Some("largest"), None) => Ok(Some(PartChoice::Largest)),
        (Some(other), None) => Err(format!(
            "--parts is `{other}`; it must be separate, largest or weld"
        )),
    }
}

fn count(tets: i64) -> Result<usize, String> {
    usize::try_from(tets)
        .map_err(|_| format!("--resolution is {tets}; it must be 500 to 2000000 tetrahedra"))
}

/// Turns this axis of the body up.
fn upright(axis: Axis) -> Quat {
    let quarter = std::f32::consts::FRAC_PI_2;
    match axis {
        Axis::X => Quat::from_rotation_z(quarter),
        Axis::Y => Quat::IDENTITY,
        Axis::Z => Quat::from_rotation_x(-quarter),
    }
}

fn parse_ball(text: &str) -> Result<Projectile, String> {
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
    let mut ball = Projectile::ball(
        number("mass", "kg", mass)?,
        number("radius", "m", radius)?,
        number("speed", "m/s", speed)?,
    );
    if let Some(material) = parts.get(3) {
        ball.material = (*material).to_string();
    }
    Ok(ball)
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
