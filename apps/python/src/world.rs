//! A world of rigid bodies that break.

use std::path::PathBuf;

use frangible::glam::{Quat, Vec3};
use frangible::{Breakable, FractureConfig};
use frangible_export::write_glb;
use frangible_recording::write_atomically;
use frangible_scenes::{
    BodySource, BodySpec, LiveScene, PieceSpec, Place, Reel, Scene, ThingKind, Throw,
};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::kind::Kind;
use crate::{numbers, refused};

/// Bodies that are in the world from its beginning.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Placed {
    kind: Py<Kind>,
    position: [f32; 3],
    rotation: [f32; 4],
    velocity: [f32; 3],
    spin: [f32; 3],
    name: String,
}

/// A world on the move.
#[pyclass(module = "frangible._frangible")]
pub(crate) struct LiveWorld {
    live: LiveScene,
    reel: Reel,
}

#[pymethods]
impl LiveWorld {
    #[new]
    fn new(
        bodies: Vec<Placed>,
        floor: Option<String>,
        seed: u64,
        generations: u32,
        load_duration: f64,
    ) -> PyResult<Self> {
        let kinds = bodies.iter().map(|body| {
            let kind = body.kind.get().whole("cannot be put into a world")?;
            Ok(kind.clone())
        });
        let kinds = kinds.collect::<PyResult<Vec<Breakable>>>()?;
        let specs = bodies.iter().zip(&kinds).map(|(body, kind)| {
            // The body is baked already: its source is not used.
            let source = BodySource::Asset(PathBuf::from(&body.name));
            let material = kind.asset().material().clone();
            BodySpec {
                place: Place::Centre(body.position.into()),
                rotation: Quat::from_array(body.rotation),
                velocity: body.velocity.into(),
                spin: body.spin.into(),
                ..BodySpec::new(body.name.clone(), source, material)
            }
        });
        let specs: Vec<BodySpec> = specs.collect();
        let first = specs.first().cloned();
        let first =
            first.ok_or_else(|| refused("the world has no body; add one before the first step"))?;
        let mut fracture = FractureConfig::default();
        fracture.load_duration = load_duration;
        let scene = Scene {
            bodies: specs,
            fracture,
            floor,
            seed,
            pieces: PieceSpec {
                generations,
                ..PieceSpec::default()
            },
            ..Scene::one_body(first)
        };
        let live = LiveScene::of_kinds(&scene, &kinds).map_err(refused)?;
        let mut reel = Reel::keeping(f64::INFINITY);
        reel.note(&live, 0.0);
        Ok(Self { live, reel })
    }

    /// Steps until so many seconds have passed. Returns the number of new pieces.
    fn advance(&mut self, py: Python<'_>, seconds: f64) -> PyResult<usize> {
        let end = self.live.time() + seconds;
        let mut pieces = 0;
        while self.live.time() < end - 1e-9 {
            py.check_signals()?;
            let before = self.live.time();
            py.detach(|| self.live.step()).map_err(refused)?;
            let broken = self.live.world().breaks().iter();
            pieces += broken.map(|b| b.fragments.len()).sum::<usize>();
            self.reel.note(&self.live, self.live.time() - before);
        }
        Ok(pieces)
    }

    /// Throws a ball.
    fn throw(
        &mut self,
        mass: f64,
        radius: f64,
        speed: f64,
        material: String,
        from: [f32; 3],
        through: [f32; 3],
    ) -> PyResult<()> {
        let throw = Throw {
            mass,
            radius,
            speed,
            material,
            from: from.into(),
            through: through.into(),
        };
        self.live.throw(&throw).map_err(refused)
    }

    #[getter]
    fn time(&self) -> f64 {
        self.live.time()
    }

    /// Things in the world: name, kind, mass, kg, position, m, and rotation (x, y, z, w).
    #[expect(clippy::type_complexity, reason = "Python unpacks it at once")]
    fn things<'py>(
        &self,
        py: Python<'py>,
    ) -> Vec<(
        String,
        &'static str,
        f64,
        Bound<'py, PyArray1<f64>>,
        Bound<'py, PyArray1<f64>>,
    )> {
        let things = self.live.things().iter();
        let there = things.filter_map(|thing| {
            let pose = self.live.pose(thing)?;
            let what = match thing.kind {
                ThingKind::Body(_) => "body",
                ThingKind::Piece { .. } => "piece",
                ThingKind::Projectile => "ball",
            };
            let place = numbers(py, pose.translation.to_array());
            let turn = numbers(py, pose.rotation.to_array());
            Some((thing.name.clone(), what, thing.mass, place, turn))
        });
        there.collect()
    }

    /// Writes the run so far as a GLB with an animation.
    fn export(
        &self,
        py: Python<'_>,
        path: PathBuf,
        rate: f64,
        look_from: [f32; 3],
    ) -> PyResult<()> {
        py.detach(|| {
            let view = self.live.view(Vec3::from_array(look_from));
            let seconds = self.reel.seconds();
            let recording = self.reel.recording(&self.live, seconds, rate, view);
            let bytes = write_glb(&recording).map_err(refused)?;
            write_atomically(&path, &bytes).map_err(refused)
        })
    }
}
