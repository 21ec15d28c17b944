//! Baking the bodies of a scene.

use std::sync::Arc;

use frangible::Asset;
use frangible::internals::asset::RenderSurface;
use frangible_bake::{BakeReport, CancelToken, Group, Progress, Shape, check_groups};

use crate::assembly::divide;
use crate::body::BodySpec;
use crate::error::SceneError;
use crate::read::Files;
use crate::rescale::{Rescale, rescaled};
use crate::scene::Scene;
use crate::source::{BodySource, Opened, open_parts, open_source_from};

/// A baked body of a scene.
#[derive(Clone, Debug)]
pub struct BakedBody {
    /// The asset, shared by all bodies with the same source, material and number of modes.
    pub asset: Arc<Asset>,
    /// Report of the bake; `None` for a body that was already baked.
    pub report: Option<Arc<BakeReport>>,
}

/// Bakes the bodies of a scene, in their order; equal bodies are baked once.
///
/// # Errors
/// An invalid quantity, file or shape.
pub fn bake(scene: &Scene) -> Result<Vec<BakedBody>, SceneError> {
    bake_with(scene, |_| {})
}

/// Bakes the bodies of a scene like [`bake()`], and calls `progress` at every advance of a body.
///
/// # Errors
/// The errors of [`bake()`].
pub fn bake_with(
    scene: &Scene,
    mut progress: impl FnMut(Progress),
) -> Result<Vec<BakedBody>, SceneError> {
    let opened = open_sources(scene)?;
    bake_opened(scene, opened, &mut progress)
}

/// Checks the scene and reads the sources of its bodies, each of which must be one body. All errors in these are found here, before any
/// computation.
///
/// # Errors
/// An invalid quantity of the scene, an invalid file, or a mesh of several parts, for which there is [`open_scene`].
pub fn open_sources(scene: &Scene) -> Result<Vec<Opened>, SceneError> {
    open_sources_from(scene, &Files::Disk)
}

/// Like [`open_sources`], with the given files.
///
/// # Errors
/// The errors of [`open_sources`].
pub fn open_sources_from(scene: &Scene, files: &Files) -> Result<Vec<Opened>, SceneError> {
    scene.validate()?;
    let mut opened: Vec<Opened> = Vec::with_capacity(scene.bodies.len());
    for (i, body) in scene.bodies.iter().enumerate() {
        let known = scene.bodies[..i]
            .iter()
            .position(|b| (&b.source, &b.rescale) == (&body.source, &body.rescale));
        opened.push(match known {
            Some(same) => opened[same].clone(),
            None => open_body(body, files)?,
        });
        check_opened(body, opened.last())?;
    }
    Ok(opened)
}

/// Checks the scene and reads the sources of its bodies. Each part of a mesh file becomes a body of the scene that is returned, as
/// [`BodySource::Mesh`] says; a projectile aimed at the mesh is aimed at the largest. All errors in files are found here.
///
/// # Errors
/// An invalid quantity of the scene, or an invalid file.
pub fn open_scene(scene: &Scene) -> Result<(Scene, Vec<Opened>), SceneError> {
    open_scene_from(scene, &Files::Disk)
}

/// Like [`open_scene`], with the given files.
///
/// # Errors
/// The errors of [`open_scene`].
pub fn open_scene_from(scene: &Scene, files: &Files) -> Result<(Scene, Vec<Opened>), SceneError> {
    scene.validate()?;
    let mut bodies: Vec<BodySpec> = Vec::with_capacity(scene.bodies.len());
    let mut opened: Vec<Opened> = Vec::with_capacity(scene.bodies.len());
    let mut aims = Vec::with_capacity(scene.bodies.len());
    for body in &scene.bodies {
        let known = bodies
            .iter()
            .position(|b| (&b.source, &b.rescale) == (&body.source, &body.rescale));
        let parts = match (known, &body.source) {
            (None, BodySource::Mesh { .. }) => open_parts(&body.source, files)?.0,
            _ => Vec::new(),
        };
        let first = bodies.len();
        if parts.len() > 1 {
            let volumes = || parts.iter().map(|part| part.volume).enumerate();
            let largest = volumes().fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
            aims.push(first + largest.0);
            for (part, source) in divide(body, parts)? {
                bodies.push(part);
                opened.push(source);
            }
        } else {
            aims.push(first);
            bodies.push(body.clone());
            opened.push(match (known, parts.into_iter().next()) {
                (Some(same), _) => opened[same].clone(),
                (None, Some(part)) => part.opened,
                (None, None) => open_body(body, files)?,
            });
        }
        for (body, opened) in bodies[first..].iter().zip(&opened[first..]) {
            check_opened(body, Some(opened))?;
        }
    }
    let mut divided = Scene {
        bodies,
        ..scene.clone()
    };
    for projectile in &mut divided.projectiles {
        // Checked above.
        projectile.target = aims.get(projectile.target).copied().unwrap_or(0);
    }
    divided.validate()?;
    Ok((divided, opened))
}

/// Checks what a body asks of its source.
fn check_opened(body: &BodySpec, opened: Option<&Opened>) -> Result<(), SceneError> {
    if let Some(Opened::Shape { groups, .. }) = opened {
        check_groups(&body.supports, groups)?;
    }
    match opened.filter(|_| !body.paint.is_empty()) {
        Some(opened) => check_painted(body, opened),
        None => Ok(()),
    }
}

/// Refuses paint on a body whose file has no vertex colours, before it is baked.
fn check_painted(body: &BodySpec, opened: &Opened) -> Result<(), SceneError> {
    let (BodySource::Mesh { path, .. } | BodySource::Asset(path)) = &body.source else {
        return Ok(());
    };
    let colors = match opened {
        Opened::Shape { render, .. } => render.as_ref().map_or(0, |r| r.colors.len()),
        Opened::Asset(asset) => asset.render().map_or(0, |r| r.colors.len()),
    };
    if colors > 0 {
        return Ok(());
    }
    Err(SceneError::File {
        path: path.clone(),
        problem: "weakness is painted with vertex colours, but this file has none; export it with them (glTF COLOR_0, PLY \
                  red green blue, OBJ v x y z r g b), or remove `paint`"
            .into(),
    })
}

/// Reads a body's source; a baked one is brought to the material and size asked for.
fn open_body(body: &BodySpec, files: &Files) -> Result<Opened, SceneError> {
    match (open_source_from(&body.source, files)?, &body.source) {
        (Opened::Asset(asset), BodySource::Asset(path)) if body.rescale != Rescale::default() => {
            let asset = rescaled(Arc::unwrap_or_clone(asset), &body.rescale, path)?;
            Ok(Opened::Asset(Arc::new(asset)))
        }
        (opened, _) => Ok(opened),
    }
}

/// Bakes sources read by [`open_sources`].
///
/// # Errors
/// A body that cannot be baked.
pub fn bake_opened(
    scene: &Scene,
    opened: Vec<Opened>,
    progress: &mut dyn FnMut(Progress),
) -> Result<Vec<BakedBody>, SceneError> {
    bake_until(scene, opened, &CancelToken::default(), progress)
}

/// Like [`bake_opened`], but can be cancelled with [`CancelToken::cancel`].
///
/// # Errors
/// A body that cannot be baked, or the cancellation.
pub fn bake_until(
    scene: &Scene,
    opened: Vec<Opened>,
    cancel: &CancelToken,
    progress: &mut dyn FnMut(Progress),
) -> Result<Vec<BakedBody>, SceneError> {
    let mut baked: Vec<BakedBody> = Vec::with_capacity(scene.bodies.len());
    for (i, (body, source)) in scene.bodies.iter().zip(opened).enumerate() {
        let same = |other: &BodySpec| {
            (
                &other.source,
                &other.material,
                &other.supports,
                &other.rescale,
            ) == (&body.source, &body.material, &body.supports, &body.rescale)
                && (other.resolution, other.modes, other.followed)
                    == (body.resolution, body.modes, body.followed)
        };
        baked.push(match (scene.bodies[..i].iter().position(same), source) {
            (Some(known), _) => baked[known].clone(),
            (None, Opened::Asset(asset)) => BakedBody {
                asset,
                report: None,
            },
            (
                None,
                Opened::Shape {
                    shape,
                    render,
                    groups,
                    ..
                },
            ) => bake_body(body, shape, render, groups, cancel, progress)?,
        });
    }
    Ok(baked)
}

#[cfg(feature = "bake")]
fn bake_body(
    body: &BodySpec,
    shape: Shape,
    render: Option<Box<RenderSurface>>,
    groups: Vec<Group>,
    cancel: &CancelToken,
    progress: &mut dyn FnMut(Progress),
) -> Result<BakedBody, SceneError> {
    let size = body.resolution.map(|tets| shape.size_for(tets as f64));
    let spec = frangible_bake::BakeSpec {
        modes: body.modes,
        followed: body.followed,
        render: render.map(|r| *r),
        fracture: size.transpose()?,
        supports: body.supports.clone(),
        groups,
        cancel: cancel.clone(),
        ..frangible_bake::BakeSpec::new(&body.name, shape, body.material.clone())
    };
    let baked = frangible_bake::bake_with(&spec, progress);
    let frangible_bake::Baked { asset, report } = baked.map_err(|e| mendable(&spec, e))?;
    Ok(BakedBody {
        asset: Arc::new(asset),
        report: Some(Arc::new(report)),
    })
}

#[cfg(not(feature = "bake"))]
fn bake_body(
    body: &BodySpec,
    _: Shape,
    _: Option<Box<RenderSurface>>,
    _: Vec<Group>,
    _: &CancelToken,
    _: &mut dyn FnMut(Progress),
) -> Result<BakedBody, SceneError> {
    Err(SceneError::NoBake {
        body: body.name.clone(),
    })
}

/// Walls too thin and supports beside the body, said with what the user of a scene can do about them.
#[cfg(feature = "bake")]
fn mendable(spec: &frangible_bake::BakeSpec, error: frangible_bake::BakeError) -> SceneError {
    use crate::check::MOST_TETS;
    use frangible_bake::BakeError;
    use frangible_mesh::TetError;

    let (wall, needed) = match error {
        BakeError::Tetrahedra(TetError::TooThin { wall, needed, .. }) => (wall, needed),
        BakeError::Support { support, problem } => {
            return misplaced(spec, support, problem).unwrap_or_else(|| error.into());
        }
        _ => return error.into(),
    };
    let (body, wall_mm) = (spec.name.clone(), 1e3 * wall);
    if needed <= MOST_TETS {
        return SceneError::ThinWalls {
            body,
            wall_mm,
            needed,
        };
    }
    SceneError::WaferWalls {
        body,
        // Of a wall of one area, the number of cells goes with the inverse square of its thickness.
        least_mm: wall_mm * (needed as f64 / MOST_TETS as f64).sqrt(),
        wall_mm,
        limit: MOST_TETS,
    }
}

/// Error of a support that cannot be used: its region, and the extent of the body along the axes that it names.
#[cfg(feature = "bake")]
fn misplaced(spec: &frangible_bake::BakeSpec, number: usize, problem: &str) -> Option<SceneError> {
    use frangible_bake::Region;

    let support = spec.supports.get(number)?;
    let [low, high] = crate::source::bounds(&spec.shape)?;
    // To a hundredth of a millimetre; zero has no sign.
    let metres = |x: f64| (1e5 * x).round() / 1e5 + 0.0;
    let named = |k: usize| match &support.region {
        Region::HalfSpace { normal, .. } => normal[k] != 0.0,
        Region::Group(_) => false,
        _ => true,
    };
    let reach: Vec<String> = ["x", "y", "z"]
        .into_iter()
        .enumerate()
        .filter(|(k, _)| named(*k))
        .map(|(k, axis)| {
            let (low, high) = (metres(low[k]), metres(high[k]));
            format!("from {low} to {high} m along {axis}")
        })
        .collect();
    (!reach.is_empty()).then(|| {
        SceneError::Clash(format!(
            "support {number} of `{}`, {}, {problem} (the body reaches {})",
            spec.name,
            crate::text::support::support_text(support),
            reach.join(", ")
        ))
    })
}
