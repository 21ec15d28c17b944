//! A scene as plain data: bodies that may break, projectiles, and the floor.

use frangible::FractureConfig;
use frangible::glam::Vec3;
use frangible_bake::pieces::Method;

use crate::body::BodySpec;
use crate::output::Output;
use crate::projectile::Projectile;

/// A scene: breakable bodies above a floor (y = 0, y up), dropped or hit.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name of the scene and of its output files.
    pub name: String,
    /// One-line description.
    pub summary: String,
    /// Bodies that may break; at least one.
    pub bodies: Vec<BodySpec>,
    /// Projectiles thrown at the bodies.
    pub projectiles: Vec<Projectile>,
    /// Material preset of the floor, if there is one.
    pub floor: Option<String>,
    /// Random seed of weak points and crack roughness.
    pub seed: u64,
    /// Settings of the fracture model.
    pub fracture: FractureConfig,
    /// Settings of pieces that can break again.
    pub pieces: PieceSpec,
    /// Tensile strength of the mortar between bodies with touching faces, Pa; `None` for no mortar.
    pub mortar: Option<f64>,
    /// Adhesive between adjacent faces of bodies; `None` for no adhesive.
    pub adhesive: Option<Adhesive>,
    /// Largest simulated time, s; the scene ends earlier if everything is at rest.
    pub duration: f64,
    /// Direction from the subject towards the camera.
    pub look_from: Vec3,
    /// Output files.
    pub output: Output,
}

/// A thin adhesive layer between bodies, such as glue or the film in laminated glass. It bonds in patches, so that each piece of a broken body
/// stays bonded. It does not affect the vibration of the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adhesive {
    /// Strength of a patch under tension, bending or shear, Pa.
    pub strength: f64,
    /// Side length of a patch, m. Smaller patches hold smaller pieces and cost more.
    pub patch: f64,
}

/// Settings of pieces that can break again, and of the computation of their modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceSpec {
    /// Number of generations of pieces that can break again; 0 for none.
    pub generations: u32,
    /// Smallest mass of a piece that can break again, kg.
    pub least_mass: f64,
    /// Method for computing their modes.
    pub method: Method,
}

impl Default for PieceSpec {
    fn default() -> Self {
        Self {
            generations: 0,
            least_mass: 2e-3,
            method: Method::Auto,
        }
    }
}

impl Scene {
    /// A scene of one body on a stone floor, seed 1, at most 8 s.
    #[must_use]
    pub fn one_body(body: BodySpec) -> Self {
        Self {
            name: body.name.clone(),
            summary: String::new(),
            bodies: vec![body],
            projectiles: Vec::new(),
            floor: Some("stone".into()),
            seed: 1,
            fracture: FractureConfig::default(),
            pieces: PieceSpec::default(),
            mortar: None,
            adhesive: None,
            duration: 8.0,
            look_from: Vec3::new(0.55, 0.5, 1.0),
            output: Output::default(),
        }
    }

    /// Drops every body with its lowest point at this height, m, and removes the projectiles.
    pub fn drop_all(&mut self, height: f64) {
        self.projectiles.clear();
        for body in &mut self.bodies {
            body.drop_from(height);
        }
    }

    /// Places dropped bodies on the floor, and replaces the projectiles by this one.
    pub fn throw(&mut self, projectile: Projectile) {
        self.projectiles = vec![projectile];
        for body in &mut self.bodies {
            body.stand();
        }
    }
}
