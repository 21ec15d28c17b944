//! Every number of a scene, checked before anything long begins.

mod body;
mod fracture;
mod names;
mod projectile;
mod quantity;
mod weakness;

use crate::error::SceneError;
use crate::scene::{Adhesive, Scene};
use body::check_body;
use fracture::check_fracture;
use frangible::Material;
use names::{check_output, file_name};
use projectile::check_projectile;
use quantity::{direction, quantity, range};

pub use names::tame;

/// Largest speed of a ball or a body, m/s: beyond, stress waves steepen into shocks that modes cannot carry.
const MAX_SPEED: f64 = 300.0;

/// Most bodies, and most projectiles, of a scene.
const MOST_ITEMS: usize = 100;

/// Most generations of pieces that break again.
const MOST_GENERATIONS: u32 = 20;

/// Smallest patch of an adhesive, m: each is a joint.
const LEAST_PATCH: f64 = 1e-3;

/// Shortest and longest that the longest side of a body may be, m.
pub(crate) const SIZES: [f64; 2] = [1e-3, 3.0];

/// Most tetrahedra of a fracture mesh.
pub(crate) const MOST_TETS: usize = 2_000_000;

/// Longest name of a scene or a file, bytes.
const LONGEST_NAME: usize = 120;

/// A fault of a scene, and the key of the scene file under which it stands.
#[derive(Debug)]
pub(crate) struct Fault {
    /// List and number in it: `body` 0 is the first `[[body]]`.
    pub(crate) item: Option<(&'static str, usize)>,
    /// The key, below the item if there is one; dots part tables.
    pub(crate) key: &'static str,
    pub(crate) error: SceneError,
}

impl Fault {
    pub(crate) fn new(key: &'static str, error: impl Into<SceneError>) -> Self {
        Self {
            item: None,
            key,
            error: error.into(),
        }
    }

    pub(crate) fn of(self, list: &'static str, index: usize) -> Self {
        Self {
            item: Some((list, index)),
            ..self
        }
    }
}

impl Scene {
    /// Checks every number before anything long begins. Files are not looked at.
    ///
    /// # Errors
    /// The first invalid quantity, and its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.check().map_err(|fault| {
            let several = match fault.item {
                Some(("body", _)) => self.bodies.len() > 1,
                _ => self.projectiles.len() > 1,
            };
            match fault.item {
                Some((list, index)) if several => SceneError::Item {
                    item: format!("{list} {}", index + 1),
                    source: Box::new(fault.error),
                },
                _ => fault.error,
            }
        })
    }

    /// Checks what [`Scene::validate`] does, and names the place of the fault.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        file_name("name", "the scene's name", &self.name)?;
        for (key, what, count, least) in [
            ("body", "the number of bodies", self.bodies.len(), 1),
            (
                "projectile",
                "the number of projectiles",
                self.projectiles.len(),
                0,
            ),
        ] {
            if !(least..=MOST_ITEMS).contains(&count) {
                let must = if least == 0 {
                    "at most 100"
                } else {
                    "1 to 100; add a [[body]]"
                };
                return Err(quantity(key, what, count, must));
            }
        }
        range(
            "duration",
            "the duration",
            self.duration,
            0.0,
            60.0,
            "above 0 and at most 60 s",
        )?;
        direction("look_from", "the direction of the camera", self.look_from)?;
        if let Some(floor) = &self.floor {
            Material::preset(floor).map_err(|e| Fault::new("floor", e))?;
        }
        for (i, body) in self.bodies.iter().enumerate() {
            check_body(body).map_err(|fault| fault.of("body", i))?;
        }
        for (i, projectile) in self.projectiles.iter().enumerate() {
            check_projectile(projectile, self.bodies.len())
                .map_err(|fault| fault.of("projectile", i))?;
        }
        check_fracture(&self.fracture)?;
        if self.pieces.generations > MOST_GENERATIONS {
            let (key, what) = ("pieces.generations", "the number of generations");
            return Err(quantity(key, what, self.pieces.generations, "0 to 20"));
        }
        if !(self.pieces.least_mass.is_finite() && self.pieces.least_mass >= 0.0) {
            let (key, what) = ("pieces.least_mass", "the least mass of a piece");
            let must = "0 kg or above";
            return Err(quantity(key, what, self.pieces.least_mass, must));
        }
        if let Some(strength) = self.mortar {
            let must = "above 0 and at most 1e9 Pa";
            range(
                "mortar",
                "the strength of the mortar",
                strength,
                0.0,
                1e9,
                must,
            )?;
        }
        if let Some(Adhesive { strength, patch }) = self.adhesive {
            let (key, what) = ("adhesive.strength", "the strength of the adhesive");
            range(key, what, strength, 0.0, 1e9, "above 0 and at most 1e9 Pa")?;
            let (key, what) = ("adhesive.patch", "the side of its patches");
            let value = if patch >= LEAST_PATCH {
                patch
            } else {
                f64::NAN
            };
            range(key, what, value, 0.0, 10.0, "1e-3 to 10 m")?;
        }
        check_output(&self.output, &self.name)
    }
}
