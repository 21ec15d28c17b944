//! Outcome of a blow.

use frangible::internals::MassProperties;
use frangible::internals::outcome::ContactReport;
use frangible::{Body, Fracture, Fragment, Outcome};
use frangible_bake::pieces::{Method, Pieces};
use frangible_js::drawn::Drawn;
use frangible_js::hulls::hulls_of_fragment;
use frangible_js::plain;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::drawn::arrays;
use crate::kind::Kind;
use crate::{numbers, refused};

/// Outcome of a blow. Without fragments the body held.
#[pyclass(frozen, module = "frangible._frangible")]
pub(crate) struct Impact {
    body: Body,
    margin: f64,
    fracture: Fracture,
}

impl Impact {
    pub(crate) fn new(body: Body, outcome: Outcome) -> Self {
        let (margin, fracture) = match outcome {
            Outcome::Held { margin, report, .. } => (margin, Fracture::new(Vec::new(), report)),
            Outcome::Broke(fracture) => (
                fracture.report.strength / fracture.report.stress_bound,
                *fracture,
            ),
            other => (f64::NAN, Fracture::new(Vec::new(), other.report().clone())),
        };
        Self {
            body,
            margin,
            fracture,
        }
    }
}

impl Impact {
    /// Time and place at which each crack starts, or at which an old one goes on, in the order of time, with the number of tetrahedra that it cuts.
    fn starts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let (mesh, origin) = (self.body.asset().fracture(), self.body.origin());
        let cracks = self.fracture.report.arrivals.iter();
        let mut starts: Vec<(f64, u32, usize)> = cracks
            .filter_map(|cuts| cuts.first().map(|&(tet, time)| (time, tet, cuts.len())))
            .collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let start = |(time, tet, cuts): (f64, u32, usize)| -> PyResult<Bound<'py, PyDict>> {
            let dict = PyDict::new(py);
            let point = mesh.centroid(tet as usize).as_dvec3() - origin;
            dict.set_item("time", time)?;
            dict.set_item("point", numbers(py, point.to_array()))?;
            dict.set_item("tetrahedra", cuts)?;
            Ok(dict)
        };
        let starts: Vec<_> = starts.into_iter().map(start).collect::<PyResult<_>>()?;
        PyList::new(py, starts)
    }
}

#[pymethods]
impl Impact {
    #[getter]
    pub(crate) fn margin(&self) -> f64 {
        self.margin
    }

    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (dict, report) = (PyDict::new(py), &self.fracture.report);
        for (name, number) in [
            ("contact_duration", report.contact_duration),
            ("time_step", report.time_step),
            ("peak_stress", report.peak_stress),
            ("stress_bound", report.stress_bound),
            ("strength", report.strength),
            ("approach_energy", report.approach_energy),
            ("peak_strain_energy", report.peak_strain_energy),
            ("fracture_energy", report.fracture_energy),
            ("crack_area", report.crack_area),
            ("seconds", report.timings.total()),
        ] {
            dict.set_item(name, number)?;
        }
        dict.set_item("cracks", report.cracks)?;
        dict.set_item("first_crack_time", report.first_crack_time)?;
        let first = report.first_crack_point.map(|p| numbers(py, p.to_array()));
        dict.set_item("first_crack_point", first)?;
        let contacts = report.contacts.iter().map(|c| contact(py, c));
        dict.set_item("contacts", contacts.collect::<PyResult<Vec<_>>>()?)?;
        dict.set_item("starts", self.starts(py)?)?;
        Ok(dict)
    }

    fn fragments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let all = self.fracture.fragments.iter().map(|f| fragment(py, f));
        PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)
    }

    /// Arrays of the mesh of a fragment to draw.
    fn drawn<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyDict>> {
        let fragments = &self.fracture.fragments;
        let count = fragments.len();
        let fragment = fragments
            .get(number)
            .ok_or_else(|| missing(number, count))?;
        let drawn = py.detach(|| Drawn::fragment(self.body.asset(), fragment));
        arrays(py, &drawn, fragment.mass.centre)
    }

    /// A fragment as a body that breaks again, with vibration modes of its own.
    fn piece(&self, py: Python<'_>, number: usize) -> PyResult<Kind> {
        py.detach(|| {
            let mut portions = self.fracture.portions(&self.body, |k, _| k == number);
            let portion = portions.get_mut(number).and_then(Option::take);
            let count = self.fracture.fragments.len();
            let portion = portion.ok_or_else(|| missing(number, count))?;
            let elastic = Pieces::default().elastic(Method::Auto, &portion, &self.body);
            let body = self.body.piece(&portion, elastic.map_err(refused)?);
            Ok(Kind::piece(body.map_err(refused)?))
        })
    }

    /// The motions afterwards, rows of numbers as those of the npm package.
    fn motions<'py>(
        &self,
        py: Python<'py>,
        pose: PyReadonlyArray1<'py, f64>,
        motion: PyReadonlyArray1<'py, f64>,
        striker: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let rows = plain::motions(
            self.body.asset(),
            &self.fracture,
            pose.as_slice()?,
            motion.as_slice()?,
            striker.as_slice()?,
        );
        Ok(numbers(py, rows))
    }
}

fn missing(number: usize, count: usize) -> PyErr {
    refused(format!("there is no fragment {number}; there are {count}"))
}

fn contact<'py>(py: Python<'py>, report: &ContactReport) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, number) in [
        ("impulse", report.impulse),
        ("peak_force", report.peak_force),
        ("duration", report.duration),
        ("contact_radius", report.contact_radius),
        ("departure_speed", report.departure_speed),
        ("crushing_energy", report.crushing_energy),
        ("crushed_volume", report.crushed_volume),
    ] {
        dict.set_item(name, number)?;
    }
    dict.set_item("force", numbers(py, report.force.iter().copied()))?;
    Ok(dict)
}

/// A fragment where it was in the body.
fn fragment<'py>(py: Python<'py>, fragment: &Fragment) -> PyResult<Bound<'py, PyDict>> {
    let (dict, mesh) = (PyDict::new(py), &fragment.mesh);
    let centre = fragment.mass.centre;
    let place = |p: frangible::glam::Vec3| (p.as_dvec3() + centre).to_array();
    let places = mesh.positions.iter().flat_map(|&p| place(p));
    dict.set_item("vertices", numbers(py, places))?;
    dict.set_item(
        "faces",
        PyArray1::from_slice(py, mesh.triangles.as_flattened()),
    )?;
    let outside = std::iter::repeat_n(-1, mesh.outer_triangles);
    let other = |&n: &u32| if n == Fragment::PARTED { -1 } else { n as i32 };
    let neighbours = outside.chain(fragment.neighbours.iter().map(other));
    dict.set_item("neighbour", PyArray1::from_vec(py, neighbours.collect()))?;
    dict.set_item("outer_faces", mesh.outer_triangles)?;
    dict.set_item("supported", fragment.supported)?;
    let hulls: Vec<_> = hulls_of_fragment(fragment)
        .into_iter()
        .map(|hull| {
            let corners = hull.as_chunks().0.iter();
            numbers(py, corners.flat_map(|&p| place(p.into())))
        })
        .collect();
    dict.set_item("hulls", hulls)?;
    masses(&dict, &fragment.mass)?;
    Ok(dict)
}

/// Mass, kg, volume, m³, centre, m, and inertia about it, kg·m².
pub(crate) fn masses(dict: &Bound<'_, PyDict>, mass: &MassProperties) -> PyResult<()> {
    let py = dict.py();
    dict.set_item("mass", mass.mass)?;
    dict.set_item("volume", mass.volume)?;
    dict.set_item("center", numbers(py, mass.centre.to_array()))?;
    dict.set_item("inertia", numbers(py, mass.inertia.to_cols_array()))
}
