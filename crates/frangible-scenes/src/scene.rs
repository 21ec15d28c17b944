//! A scene as plain data: bodies that may break, projectiles, and the floor.

use frangible::FractureConfig;
use frangible::glam::Vec3;
use frangible_bake::pieces::Method;

use crate::body::BodySpec;
use crate::output::Output;
use crate::projectile::Projectile;

/// Breakable bodies above a floor (y = 0, y up), dropped or hit.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name, also of the files it makes.
    pub name: String,
    /// One line about its subject.
    pub summary: String,
    /// Bodies that may break; at least one.
    pub bodies: Vec<BodySpec>,
    /// Projectiles thrown at the bodies.
    pub projectiles: Vec<Projectile>,
    /// Material preset of the floor, if there is one.
    pub floor: Option<String>,
    /// Seed of weak points and crack roughness.
    pub seed: u64,
    /// Switches and numbers of the fracture.
    pub fracture: FractureConfig,
    /// Settings for pieces that break again.
    pub pieces: PieceSpec,
    /// Mortar between bodies whose faces touch, if there is any: its tensile strength, Pa.
    pub mortar: Option<f64>,
    /// Adhesive between the faces of bodies that lie close to each other, if there is any.
    pub adhesive: Option<Adhesive>,
    /// Longest simulated time, s; the scene ends sooner when everything rests.
    pub duration: f64,
    /// Direction from the subject towards the camera.
    pub look_from: Vec3,
    /// Files it asks for.
    pub output: Output,
}

/// A thin layer between bodies: glue, the film in laminated glass. It holds patch by patch, so that the pieces of a broken body stay where
/// each of them is bonded. The vibrations of the bodies do not know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adhesive {
    /// Stress of pull, bending or shear at which a patch gives way, Pa.
    pub strength: f64,
    /// Side of a patch, m. Smaller patches hold smaller pieces, and cost more.
    pub patch: f64,
}

/// Settings for pieces that break again, and for finding their modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceSpec {
    /// Generations of pieces that can break again; 0: none.
    pub generations: u32,
    /// Mass of the lightest pieces that can, kg.
    pub least_mass: f64,
    /// Method by which their modes are found.
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

    /// Drops every body from this height of its lowest point, m, and throws nothing.
    pub fn drop_all(&mut self, height: f64) {
        self.projectiles.clear();
        for body in &mut self.bodies {
            body.drop_from(height);
        }
    }

    /// Stands every body that was to fall on the floor, and throws this instead of the projectiles before.
    pub fn throw(&mut self, projectile: Projectile) {
        self.projectiles = vec![projectile];
        for body in &mut self.bodies {
            body.stand();
        }
    }
}
