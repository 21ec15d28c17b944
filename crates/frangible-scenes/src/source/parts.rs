//! The parts of a mesh file.

use frangible_bake::{ImportOptions, import_parts};
use frangible_mesh::glam::DVec3;
use frangible_mesh::{InputMesh, PartChoice, RepairReport, TetFormat};

use super::{BodySource, FileKind, Opened, fit, tets};
use crate::error::SceneError;
use crate::read::Files;

/// A part of a mesh file, in metres, y up.
pub(crate) struct OpenedPart {
    /// Its name; empty if the file has only one part.
    pub(crate) name: String,
    /// Tetrahedra of its fracture mesh, about.
    pub(crate) tets: usize,
    /// Centre of the volume inside, m.
    pub(crate) centre: DVec3,
    /// Volume inside, m³, roughly.
    pub(crate) volume: f64,
    pub(crate) opened: Opened,
}

/// Reads a mesh file, and makes a shape of each part that is chosen. The notes, on the whole file, stand with the first part.
pub(crate) fn open_parts(
    source: &BodySource,
    files: &Files,
) -> Result<(Vec<OpenedPart>, Vec<String>), SceneError> {
    let BodySource::Mesh {
        path,
        size,
        up,
        resolution,
        wall,
        parts,
    } = source
    else {
        return Ok((Vec::new(), Vec::new()));
    };
    let refused = |problem: String| SceneError::File {
        path: path.clone(),
        problem,
    };
    files.check(path, FileKind::Mesh)?;
    if TetFormat::from_extension(path).is_some() {
        if *parts != PartChoice::Auto {
            let problem = "parts cannot be chosen: the tetrahedra of the file are used unchanged; give the surface of the body (.stl, .obj)";
            return Err(refused(problem.into()));
        }
        let input = || files.tets(path);
        let opened = tets::open(input, path, *size, *up, *resolution, *wall)?;
        return Ok((vec![single(opened)], Vec::new()));
    }
    let mut mesh = files.mesh(path)?;
    fit::fit(&mut mesh, path, *size, *up)?;
    let mut options = ImportOptions::default();
    options.tets = resolution.unwrap_or(options.tets);
    options.wall = *wall;
    options.parts = parts.clone();
    let imported = import_parts(&mesh, &options).map_err(|error| refused(error.to_string()))?;
    let found: Vec<String> = imported.note.into_iter().collect();
    let mut list = Vec::with_capacity(imported.parts.len());
    for part in imported.parts {
        let body = part.body;
        // Welding is no news: every STL has its corners doubled, and every mesh with a texture its seams.
        let mended = RepairReport {
            welded: 0,
            // A sheet that becomes a wall ends somewhere.
            boundary_loops: if wall.is_some() {
                0
            } else {
                body.mended.boundary_loops
            },
            ..body.mended
        };
        let mut notes = Vec::new();
        if list.is_empty() {
            notes.extend(
                found
                    .iter()
                    .map(|note| format!("{}: {note}", path.display())),
            );
            notes.extend(left_out(&mesh, *wall).map(|what| format!("{}: {what}", path.display())));
        }
        let mended = mended.to_string();
        if !mended.is_empty() {
            let place = match part.name.is_empty() {
                true => path.display().to_string(),
                false => format!("{}, {}", path.display(), part.name),
            };
            notes.push(format!("{place}: {mended}"));
        }
        list.push(OpenedPart {
            name: part.name,
            tets: part.tets,
            centre: part.centre,
            volume: body.thickness.volume,
            opened: Opened::Shape {
                shape: body.shape,
                render: body.render.map(Box::new),
                groups: body.groups,
                notes,
                open: wall.is_none() && body.mended.open_shells > 0,
            },
        });
    }
    Ok((list, found))
}

/// One note on what of a file is not kept.
fn left_out(mesh: &InputMesh, wall: Option<f64>) -> Option<String> {
    let mut list: Vec<&str> = mesh.left_out.iter().map(String::as_str).collect();
    // A wall is drawn along its own faces, as the author's surface lies in its middle.
    let drawn = [
        (!mesh.colors.is_empty(), "vertex colours"),
        (!mesh.uvs.is_empty(), "texture coordinates"),
        (!mesh.materials.is_empty(), "materials"),
    ];
    let drawn = drawn.into_iter().filter(|(there, _)| *there);
    list.extend(drawn.filter(|_| wall.is_some()).map(|(_, what)| what));
    (!list.is_empty()).then(|| format!("not kept: {}", list.join("; ")))
}

fn single(opened: Opened) -> OpenedPart {
    OpenedPart {
        name: String::new(),
        tets: 0,
        centre: DVec3::ZERO,
        volume: 0.0,
        opened,
    }
}
