//! Bodies, and the effects of blows on them.

use std::path::PathBuf;
use std::sync::Arc;

use frangible::glam::DVec3;
use frangible::internals::stress::largest_eigenvalue;
use frangible::internals::{Factors, Fatigue, Fields, ShownStress, Stage, Vibration};
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Material, impact, would_break};
use frangible_bake::mode_field::mode_on_fracture_mesh;
use frangible_js::drawn::{Drawn, authored};
use frangible_js::plain;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::drawn::{arrays, looks};
use crate::outcome::{Impact, masses};
use crate::{numbers, refused};

/// Fastest approach that is tried, m/s.
const FASTEST: f64 = 1000.0;

/// Plane-strain modulus, Pa, crushing pressure, Pa, coefficient of restitution and density, kg/m³, of a named material.
#[pyfunction]
pub(crate) fn striker(material: &str) -> PyResult<(f64, f64, f64, f64)> {
    let material = Material::preset(material).map_err(refused)?;
    let modulus = material.contact_modulus();
    Ok((
        modulus,
        material.crushing_pressure,
        material.restitution,
        material.density,
    ))
}

/// Origin of a body.
enum Made {
    /// A bake.
    Whole(Breakable),
    /// A break of another body, whose seed the piece has.
    Piece(Box<Body>),
}

/// A kind of body, or a piece of a body.
#[pyclass(frozen, module = "frangible._frangible")]
pub(crate) struct Kind(Made);

impl Kind {
    pub(crate) fn new(asset: Asset) -> PyResult<Self> {
        Ok(Self(Made::Whole(Breakable::new(asset).map_err(refused)?)))
    }

    pub(crate) fn piece(body: Body) -> Self {
        Self(Made::Piece(Box::new(body)))
    }

    pub(crate) fn asset(&self) -> &Arc<Asset> {
        match &self.0 {
            Made::Whole(kind) => kind.asset(),
            Made::Piece(body) => body.asset(),
        }
    }

    /// A body that can be hit, with this seed, or the usual one.
    fn body(&self, seed: Option<u64>) -> PyResult<Body> {
        match (&self.0, seed) {
            (Made::Whole(kind), seed) => Ok(kind.body(seed.unwrap_or(1))),
            (Made::Piece(body), None) => Ok((**body).clone()),
            (Made::Piece(_), Some(_)) => Err(refused(
                "a piece uses the seed of the body that it comes from; do not give a seed",
            )),
        }
    }

    /// Computes the effect of contacts on the body, without the interpreter's lock.
    fn hit(
        &self,
        py: Python<'_>,
        rows: &PyReadonlyArray1<'_, f64>,
        seed: Option<u64>,
        config: &FractureConfig,
    ) -> PyResult<Impact> {
        let contacts = contacts(rows)?;
        let body = self.body(seed)?;
        let outcome = py.detach(|| impact(&body, &contacts, config));
        Ok(Impact::new(body, outcome.map_err(refused)?))
    }

    /// Returns the baked body. A piece is an error, since it cannot do what is asked.
    pub(crate) fn whole(&self, asked: &str) -> PyResult<&Breakable> {
        match &self.0 {
            Made::Whole(kind) => Ok(kind),
            Made::Piece(_) => Err(refused(format!(
                "a piece {asked}; use the body that it comes from, with the blow and the seed"
            ))),
        }
    }
}

fn contacts(rows: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<Contact>> {
    Ok(plain::contacts(rows.as_slice()?))
}

#[pymethods]
impl Kind {
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let asset = py.detach(|| Asset::load(&path)).map_err(refused)?;
        Self::new(asset)
    }

    #[staticmethod]
    fn of_bytes(bytes: &[u8]) -> PyResult<Self> {
        Self::new(Asset::from_bytes(bytes).map_err(refused)?)
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let kind = self.whole("cannot be saved or pickled")?;
        Ok(PyBytes::new(py, &kind.asset().to_bytes()))
    }

    /// Name, material, mass, and data of its mesh.
    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let asset = self.asset();
        let about = PyDict::new(py);
        about.set_item("name", asset.name())?;
        about.set_item("material", &asset.material().name)?;
        about.set_item("strength", asset.material().strength)?;
        about.set_item("supported", asset.is_supported())?;
        let piece = asset.portion();
        let tets = piece.map_or(asset.fracture().tets.len(), |p| p.tets().len());
        about.set_item("tetrahedra", tets)?;
        let nodes = asset.surface_positions().iter().flat_map(|p| p.to_array());
        about.set_item("vertices", numbers(py, nodes))?;
        let triangles = asset.surface().triangles.as_flattened();
        about.set_item("faces", PyArray1::from_slice(py, triangles))?;
        let frequencies = (0..asset.modes().count()).map(|i| asset.modes().frequency(i));
        about.set_item("frequencies", numbers(py, frequencies))?;
        masses(&about, &asset.mass())?;
        Ok(about)
    }

    /// Arrays of the mesh to draw.
    fn drawn<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let asset = self
            .whole("is drawn by the outcome that it comes from")?
            .asset();
        arrays(py, &py.detach(|| Drawn::whole(asset)), DVec3::ZERO)
    }

    /// Name, materials and images of the mesh that was baked, if it has any.
    fn looks<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let surface = authored(self.asset());
        surface.map(|surface| looks(py, surface)).transpose()
    }

    /// Displacement of each vertex in a mode of unit modal mass, 1/√kg.
    fn mode<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let asset = self.whole("has no accessible modes")?.asset();
        let field = py.detach(|| mode_on_fracture_mesh(asset, number));
        Ok(numbers(
            py,
            field.displacements.iter().flat_map(|d| d.to_array()),
        ))
    }

    /// The four vertices of each tetrahedron.
    fn tets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let mesh = &self.whole("cannot be weakened")?.asset().fracture();
        Ok(PyArray1::from_slice(py, mesh.tets.as_flattened()))
    }

    /// Strength, toughness and weak points of each tetrahedron, as factors on its material's numbers, and the depth of a groove, m; none where
    /// all are 1.
    fn factors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let of_tet = &self.whole("has no factors of its own")?.fields().of_tet;
        let rows = of_tet
            .iter()
            .flat_map(|f| [f.strength, f.toughness, f.weak_points, f.groove]);
        Ok(numbers(py, rows))
    }

    /// This kind with such factors in the place of its own.
    fn with_factors(&self, py: Python<'_>, rows: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        let kind = self.whole("cannot be weakened")?.clone();
        let of_tet = rows.as_slice()?.as_chunks().0.iter();
        let of_tet = of_tet.map(|&[strength, toughness, weak_points, groove]| Factors {
            strength: strength as f32,
            toughness: toughness as f32,
            weak_points: weak_points as f32,
            groove: groove as f32,
        });
        let mut fields = Fields::clone(kind.fields());
        fields.of_tet = of_tet.collect();
        let kind = py.detach(|| kind.with_fields(fields)).map_err(refused)?;
        Ok(Self(Made::Whole(kind)))
    }

    /// Weibull modulus, volume of the specimen, m³, and exponent, rate, Pa/s, and increase of static fatigue, if its strength falls with time.
    fn scatter(&self) -> PyResult<(f64, f64, Option<[f64; 3]>)> {
        let fields = self.whole("has no scatter of its own")?.fields();
        let fatigue = fields.fatigue.map(|f| [f.exponent, f.rate, f.increase]);
        Ok((fields.weibull_modulus, fields.specimen, fatigue))
    }

    /// This kind with such numbers in the place of its own.
    fn with_scatter(
        &self,
        py: Python<'_>,
        weibull_modulus: f64,
        specimen: f64,
        fatigue: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        let kind = self
            .whole("uses the scatter of the body that it comes from")?
            .clone();
        let mut fields = Fields::clone(kind.fields());
        (fields.weibull_modulus, fields.specimen) = (weibull_modulus, specimen);
        fields.fatigue = fatigue.map(|[exponent, rate, increase]| Fatigue {
            exponent,
            rate,
            increase,
        });
        let kind = py.detach(|| kind.with_fields(fields)).map_err(refused)?;
        Ok(Self(Made::Whole(kind)))
    }

    fn impact(
        &self,
        py: Python<'_>,
        rows: PyReadonlyArray1<'_, f64>,
        seed: Option<u64>,
        least_share: Option<f64>,
    ) -> PyResult<Impact> {
        let mut config = FractureConfig::default();
        config.crumb_share = least_share.unwrap_or(config.crumb_share);
        self.hit(py, &rows, seed, &config)
    }

    /// Strength over the largest stress at a weak point. Every weak point is analysed.
    fn margin(
        &self,
        py: Python<'_>,
        rows: PyReadonlyArray1<'_, f64>,
        seed: Option<u64>,
    ) -> PyResult<f64> {
        let mut config = FractureConfig::default();
        config.culling = false;
        Ok(self.hit(py, &rows, seed, &config)?.margin())
    }

    fn would_break(
        &self,
        py: Python<'_>,
        rows: PyReadonlyArray1<'_, f64>,
        seed: Option<u64>,
    ) -> PyResult<bool> {
        let contacts = contacts(&rows)?;
        let body = self.body(seed)?;
        let broke = py.detach(|| would_break(&body, &contacts, &FractureConfig::default()));
        broke.map_err(refused)
    }

    /// Slowest approach of all contacts at which the body breaks, m/s, to this share; infinite where none does.
    fn minimum_speed(
        &self,
        py: Python<'_>,
        rows: PyReadonlyArray1<'_, f64>,
        seed: Option<u64>,
        tolerance: f64,
    ) -> PyResult<f64> {
        let contacts = contacts(&rows)?;
        let body = self.body(seed)?;
        let breaks = |speed: f64| {
            let mut contacts = contacts.clone();
            contacts
                .iter_mut()
                .for_each(|c| c.approach_speed = speed as f32);
            would_break(&body, &contacts, &FractureConfig::default()).map_err(refused)
        };
        py.detach(|| slowest(&breaks, tolerance))
    }

    /// Times, s, and the largest principal tension on each face at each of them, Pa, row after row; NaN where no flaw is.
    #[expect(clippy::type_complexity, reason = "Python unpacks it at once")]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        rows: PyReadonlyArray1<'py, f64>,
        seed: Option<u64>,
        wanted: Option<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let contacts = contacts(&rows)?;
        let body = self.body(seed)?;
        let found = py.detach(|| stresses(&body, &contacts, wanted));
        let (times, tensions) = found.map_err(refused)?;
        Ok((numbers(py, times), numbers(py, tensions)))
    }
}

/// Bisection between a speed that breaks and one that does not.
fn slowest(breaks: &dyn Fn(f64) -> PyResult<bool>, tolerance: f64) -> PyResult<f64> {
    let mut high = 1.0;
    while !breaks(high)? {
        high *= 2.0;
        if high > FASTEST {
            return Ok(f64::INFINITY);
        }
    }
    let mut low = if high > 1.0 { 0.5 * high } else { 0.0 };
    while high - low > tolerance * high {
        // Downwards from 1 m/s by halves until one holds.
        let middle = 0.5 * (low + high);
        *(if breaks(middle)? { &mut high } else { &mut low }) = middle;
    }
    Ok(high)
}

/// The tension on the surface as if nothing cracked: at the time step nearest to `wanted`, or at all of them.
fn stresses(
    body: &Body,
    contacts: &[Contact],
    wanted: Option<f64>,
) -> Result<(Vec<f64>, Vec<f64>), frangible::InputError> {
    let mut config = FractureConfig::default();
    // Also where bounds say that nothing breaks.
    config.culling = false;
    let faces = body.asset().surface().triangles.len();
    let vibration = match Vibration::begin(body, contacts, &config)? {
        Stage::Vibrates(vibration) => vibration,
        Stage::Held(_) => return Ok((vec![0.0], vec![0.0; faces])),
    };
    let motion = vibration.motion(body);
    let mut stress = ShownStress::new(body, &config, &vibration.pressed, &motion);
    let step = vibration.report.time_step;
    let last = motion.steps().saturating_sub(1);
    let steps: Vec<usize> = match wanted {
        Some(time) => vec![
            (0..=last)
                .min_by(|&a, &b| {
                    let off = |k: usize| (motion.begin(k, step) - time).abs();
                    off(a).total_cmp(&off(b))
                })
                .unwrap_or(0),
        ],
        None => (0..=last).collect(),
    };
    let mut tensions = Vec::with_capacity(faces * steps.len());
    for &k in &steps {
        let mut row = vec![f64::NAN; faces];
        for (triangle, tensor) in stress.on_surface(k) {
            let place = &mut row[triangle as usize];
            *place = place.max(f64::from(largest_eigenvalue(&tensor)));
        }
        tensions.extend(row);
    }
    Ok((
        steps.iter().map(|&k| motion.begin(k, step)).collect(),
        tensions,
    ))
}
