//! Meshes made breakable.

use std::path::PathBuf;

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::frangible_mesh::{self, InputMesh, Similarity};
use frangible_bake::{BakeSpec, CancelToken, ImportOptions, Progress, import_mesh};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::kind::Kind;
use crate::{numbers, refused};

/// A body, and the transform from the mesh's positions to its frame: a factor, then an offset, m.
type Baked<'py> = (Kind, f64, Bound<'py, PyArray1<f64>>);

/// Bakes a mesh. `tell(stage, share)` is called meanwhile.
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
) -> PyResult<Baked<'py>> {
    let mesh = InputMesh {
        positions: (vertices.as_slice()?.as_chunks().0.iter())
            .map(|&p| DVec3::from_array(p))
            .collect(),
        triangles: faces.as_slice()?.as_chunks().0.to_vec(),
        ..InputMesh::default()
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
        (options.size, options.wall) = (size, wall);
        options.tets = tetrahedra.unwrap_or(options.tets);
        let imported = import_mesh(&mesh, &options).map_err(refused)?;
        let mut spec = BakeSpec {
            groups: imported.groups,
            supports,
            seed,
            cancel: cancel.clone(),
            ..BakeSpec::new(name, imported.shape, material)
        };
        spec.modes = modes.unwrap_or(spec.modes);
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
        let baked = frangible_bake::bake(&spec, &mut progress).map_err(refused)?;
        Ok((baked, imported.similarity))
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let ((asset, report), Similarity { scale, shift }) = done?;
    let offset = numbers(py, (shift - report.centre).to_array());
    Ok((Kind::new(asset)?, scale, offset))
}

/// Vertices, in the file's unit, and triangles of a mesh file.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "Python unpacks it at once")]
pub(crate) fn read_mesh<'py>(
    py: Python<'py>,
    path: PathBuf,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<u32>>)> {
    let mesh = py
        .detach(|| frangible_mesh::read_mesh(&path))
        .map_err(refused)?;
    let places = mesh.positions.iter().flat_map(|p| p.to_array());
    Ok((
        numbers(py, places),
        PyArray1::from_slice(py, mesh.triangles.as_flattened()),
    ))
}
