//! Functions that the package's Python calls. Numbers pass as flat arrays; the Python beside makes objects and sentences of them, and describes them.

mod bake;
mod drawn;
mod kind;
mod outcome;
mod world;

use std::ffi::OsString;
use std::fmt::Display;

use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Every error of ours is about a value that was given.
pub(crate) fn refused(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Numbers for Python, in f64.
pub(crate) fn numbers<'py, T: Into<f64> + Copy>(
    py: Python<'py>,
    of: impl IntoIterator<Item = T>,
) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_vec(py, of.into_iter().map(Into::into).collect())
}

/// Runs a command line. Returns the exit status.
#[pyfunction]
fn run(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| frangible_cli::run(&words))
}

#[pymodule]
fn _frangible(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<kind::Kind>()?;
    module.add_class::<outcome::Impact>()?;
    module.add_class::<world::LiveWorld>()?;
    module.add_function(wrap_pyfunction!(bake::bake, module)?)?;
    module.add_function(wrap_pyfunction!(bake::read_mesh, module)?)?;
    module.add_function(wrap_pyfunction!(kind::striker, module)?)?;
    module.add_function(wrap_pyfunction!(run, module)?)
}
