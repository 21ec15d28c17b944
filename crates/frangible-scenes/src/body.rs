//! One breakable body of a scene.

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible::internals::Fatigue;
use frangible_bake::weakness::{Paint, Patch};
use frangible_bake::{Support, USUAL_MODES};

use crate::rescale::Rescale;
use crate::source::BodySource;

/// A breakable body and its initial state.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Name of the body and of its nodes in the animation.
    pub name: String,
    /// Source of its geometry.
    pub source: BodySource,
    /// Material. Ignored for a [`BodySource::Asset`], which has its own; see [`BodySpec::rescale`].
    pub material: Material,
    /// Number of vibration modes; ignored for a [`BodySource::Asset`].
    pub modes: usize,
    /// Number of modes integrated through time during a blow; `None`: chosen by the bake.
    pub followed: Option<usize>,
    /// Position at the start.
    pub place: Place,
    /// Orientation at the start.
    pub rotation: Quat,
    /// Velocity of its centre of mass at the start, m/s.
    pub velocity: Vec3,
    /// Angular velocity at the start, rad/s.
    pub spin: Vec3,
    /// Approximate number of tetrahedra of the fracture mesh of a [`BodySource::Shape`]; `None`: the default of the bake. Other sources have
    /// their own.
    pub resolution: Option<usize>,
    /// Supports, m, in the frame of the shape: parts that stay fixed, before and after the break. Part of the bake, so a
    /// [`BodySource::Asset`] has its own.
    pub supports: Vec<Support>,
    /// Zones in which the body is weaker or stronger than its material; later zones override earlier ones. In m from the centre of mass, along
    /// the axes of the shape. Not part of the bake.
    pub weakness: Vec<Patch>,
    /// Weakness from the vertex colours of the mesh; overridden by [`BodySpec::weakness`]. The colours are part of the bake, the weakness is
    /// not.
    pub paint: Vec<Paint>,
    /// Weibull modulus of the strength, see [`frangible::Fields::weibull_modulus`]; 0: no scatter. `None`: the value of the material
    /// preset ([`frangible::internals::Preset::weibull_modulus`]).
    pub weibull_modulus: Option<f64>,
    /// Volume of the test specimen with the strength of the material, m³; `None`: the value of the preset.
    pub specimen: Option<f64>,
    /// Static fatigue: the loss of strength under sustained loads; `None`: the value of the material preset.
    pub fatigue: Option<Fatigue>,
    /// Changes of size or material of a [`BodySource::Asset`]; ignored for other sources.
    pub rescale: Rescale,
}

/// Initial position of a body. The floor is at y = 0, even if the scene has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// On the floor.
    Standing {
        /// x and z of its centre of mass, m.
        over: [f32; 2],
    },
    /// With its lowest point at a height above the floor.
    Above {
        /// Height, m.
        height: f64,
        /// x and z of its centre of mass, m.
        over: [f32; 2],
    },
    /// With its centre of mass at this point, m.
    Centre(Vec3),
}

impl BodySpec {
    /// A body of this material at rest on the floor, with the default number of modes.
    #[must_use]
    pub fn new(name: impl Into<String>, source: BodySource, material: Material) -> Self {
        Self {
            name: name.into(),
            source,
            material,
            modes: USUAL_MODES,
            followed: None,
            resolution: None,
            place: Place::Standing { over: [0.0; 2] },
            rotation: Quat::IDENTITY,
            velocity: Vec3::ZERO,
            spin: Vec3::ZERO,
            supports: Vec::new(),
            weakness: Vec::new(),
            paint: Vec::new(),
            weibull_modulus: None,
            specimen: None,
            fatigue: None,
            rescale: Rescale::default(),
        }
    }

    /// Drops the body from rest, with its lowest point `height` metres above the floor, at the same horizontal position.
    pub fn drop_from(&mut self, height: f64) {
        let over = self.place.over();
        self.place = Place::Above { height, over };
    }

    /// Places a dropped body on the floor; a body with a given centre is not moved.
    pub fn stand(&mut self) {
        if let Place::Above { over, .. } = self.place {
            self.place = Place::Standing { over };
        }
    }
}

impl Place {
    fn over(&self) -> [f32; 2] {
        match *self {
            Self::Standing { over } | Self::Above { over, .. } => over,
            Self::Centre(p) => [p.x, p.z],
        }
    }
}
