//! Meshes made breakable.

use std::path::PathBuf;

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::frangible_mesh::{self, InputGroup, InputMesh, PartChoice, Similarity};
use frangible_bake::{BakeError, BakeSpec, CancelToken, ImportOptions, Progress, import_parts};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::kind::Kind;
use crate::{numbers, refused};

/// A body, and the transform from the mesh's positions to its frame: a factor, then an offset, m.
type Baked<'py> = (Kind, f64, Bound<'py, PyArray1<f64>>);

/// A named range of faces: name, first and end.
type Named = (String, u32, u32);

/// Bakes a mesh, that of the file at `path` if there is one: one body for each of its parts, or `single`, whose absence is an error. `tell(stage, share)` is called meanwhile.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python gives them names")]
pub(crate) fn bake<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray1<'py, f64>,
    faces: PyReadonlyArray1<'py, u32>,
    name: String,
    material: &str,
    size: Option<f64>,
    wall: Option<f64>,
    tetrahedra: Option<usize>,
    modes: Option<usize>,
    supports: Vec<String>,
    seed: u64,
    tell: Option<Py<PyAny>>,
    groups: Vec<Named>,
    parts: Option<&str>,
    gap: Option<f64>,
    single: bool,
    path: Option<PathBuf>,
) -> PyResult<Vec<Baked<'py>>> {
    let given = InputMesh {
        positions: (vertices.as_slice()?.as_chunks().0.iter())
            .map(|&p| DVec3::from_array(p))
            .collect(),
        triangles: faces.as_slice()?.as_chunks().0.to_vec(),
        groups: (groups.into_iter())
            .map(|(name, start, end)| InputGroup {
                name,
                triangles: start..end,
            })
            .collect(),
        ..InputMesh::default()
    };
    // A file also has the looks of its surface, which pieces keep.
    let mesh = match &path {
        Some(path) => py
            .detach(|| frangible_mesh::read_mesh(path))
            .map_err(refused)?,
        None => given,
    };
    let parts = match (parts, gap) {
        (None, None) => PartChoice::Auto,
        (Some("weld"), gap) => PartChoice::Weld { gap },
        (_, Some(_)) => {
            return Err(refused(
                "gap is for parts that are welded; give parts=\"weld\"",
            ));
        }
        (Some("separate"), None) => PartChoice::Separate,
        (Some("largest"), None) => PartChoice::Largest,
        (Some(other), None) => {
            let message = format!("parts is `{other}`; give separate, largest or weld");
            return Err(refused(message));
        }
    };
    let material = Material::preset(material).map_err(refused)?;
    let held = supports
        .iter()
        .map(|text| frangible_cli::parse_support(text));
    let supports = held.collect::<Result<Vec<_>, _>>().map_err(refused)?;
    // Exception of the caller's function, or Ctrl-C.
    let mut stopped: Option<PyErr> = None;
    let cancel = CancelToken::default();
    let done = py.detach(|| -> PyResult<_> {
        let mut options = ImportOptions::default();
        (options.size, options.wall, options.parts) = (size, wall, parts);
        options.tets = tetrahedra.unwrap_or(options.tets);
        let imported = import_parts(&mesh, &options).map_err(refused)?;
        if single && imported.parts.len() > 1 {
            let found = imported.note.unwrap_or_default();
            return Err(refused(BakeError::SeveralParts { found }));
        }
        let mut progress = |p: Progress| {
            let heard = Python::attach(|py| {
                py.check_signals()?;
                let stage = p.stage.to_string();
                tell.as_ref()
                    .map_or(Ok(()), |tell| tell.call1(py, (stage, p.fraction)).map(drop))
            });
            if let Err(error) = heard {
                stopped.get_or_insert(error);
                cancel.cancel();
            }
        };
        let mut done = Vec::with_capacity(imported.parts.len());
        for part in imported.parts {
            let name = match part.name.is_empty() {
                true => name.clone(),
                false => part.name,
            };
            let mut spec = BakeSpec {
                groups: part.body.groups,
                render: part.body.render.filter(|_| path.is_some()),
                supports: supports.clone(),
                seed,
                cancel: cancel.clone(),
                ..BakeSpec::new(name, part.body.shape, material.clone())
            };
            spec.modes = modes.unwrap_or(spec.modes);
            let baked = frangible_bake::bake_with(&spec, &mut progress).map_err(refused)?;
            done.push((baked, part.body.similarity));
        }
        Ok(done)
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let bodies = done?
        .into_iter()
        .map(|(frangible_bake::Baked { asset, report }, similarity)| {
            let Similarity { scale, shift } = similarity;
            let offset = numbers(py, (shift - report.centre).to_array());
            Ok((Kind::new(asset)?, scale, offset))
        });
    bodies.collect()
}

/// Vertices, in the file's unit, triangles and groups of a mesh file.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "Python unpacks it at once")]
pub(crate) fn read_mesh<'py>(
    py: Python<'py>,
    path: PathBuf,
) -> PyResult<(
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u32>>,
    Vec<Named>,
)> {
    let mesh = py
        .detach(|| frangible_mesh::read_mesh(&path))
        .map_err(refused)?;
    let groups = mesh.groups.iter().map(|group| {
        let triangles = &group.triangles;
        (group.name.clone(), triangles.start, triangles.end)
    });
    let places = mesh.positions.iter().flat_map(|p| p.to_array());
    Ok((
        numbers(py, places),
        PyArray1::from_slice(py, mesh.triangles.as_flattened()),
        groups.collect(),
    ))
}
