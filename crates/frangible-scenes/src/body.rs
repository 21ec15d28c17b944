//! One breakable body of a scene.

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible::internals::Fatigue;
use frangible_bake::weakness::{Paint, Patch};
use frangible_bake::{Support, USUAL_MODES};

use crate::rescale::Rescale;
use crate::source::BodySource;

/// A breakable body, and its state at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Name, also of its nodes in the animation.
    pub name: String,
    /// Source of its geometry.
    pub source: BodySource,
    /// Its material. A [`BodySource::Asset`] brings its own, and this one is not looked at: see
    /// [`BodySpec::rescale`].
    pub material: Material,
    /// Number of vibration modes that are kept; a [`BodySource::Asset`] brings its own.
    pub modes: usize,
    /// Number of them that a blow follows through time; without it the bake's own choice.
    pub followed: Option<usize>,
    /// Position at the start.
    pub place: Place,
    /// Orientation at the start.
    pub rotation: Quat,
    /// Velocity of its centre of mass at the start, m/s.
    pub velocity: Vec3,
    /// Angular velocity at the start, rad/s.
    pub spin: Vec3,
    /// Tetrahedra of the fracture mesh of a [`BodySource::Shape`], about; without it the bake's default. Other sources
    /// name their own.
    pub resolution: Option<usize>,
    /// Supports, m, in the frame of its shape: what these hold stays where it is, also after the break. Part of the bake, so that a
    /// [`BodySource::Asset`] brings its own.
    pub supports: Vec<Support>,
    /// Zones in which it is weaker than its material, or stronger; one over the other. m from its centre of mass, along the axes of
    /// its shape. Not part of the bake.
    pub weakness: Vec<Patch>,
    /// Weakness painted with the vertex colours of its mesh; [`BodySpec::weakness`] lies over it. Not part of the bake, but the
    /// colours are.
    pub paint: Vec<Paint>,
    /// Weibull modulus of the scatter of its strength, see [`frangible::internals::Fields::weibull_modulus`]; 0: none. That of the
    /// material preset if none is given ([`frangible::internals::Preset::weibull_modulus`]).
    pub weibull_modulus: Option<f64>,
    /// Volume of the specimen whose strength is its material's, m³; that of the preset if none is given.
    pub specimen: Option<f64>,
    /// Static fatigue: the loss of strength under loads that last; that of the material preset if none is given.
    pub fatigue: Option<Fatigue>,
    /// Changes to the bake of a [`BodySource::Asset`]; not looked at for other sources.
    pub rescale: Rescale,
}

/// Position of a body at the start. The floor is y = 0, also where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// On the floor.
    Standing {
        /// x and z of its centre of mass, m.
        over: [f32; 2],
    },
    /// Its lowest point this high above the floor.
    Above {
        /// Height, m.
        height: f64,
        /// x and z of its centre of mass, m.
        over: [f32; 2],
    },
    /// Its centre of mass here, m.
    Centre(Vec3),
}

impl BodySpec {
    /// A body of this material at rest on the floor, with as many modes as a bake keeps unless told.
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

    /// Lets it fall from rest, its lowest point `height` metres above the floor, over the same place as before.
    pub fn drop_from(&mut self, height: f64) {
        let over = self.place.over();
        self.place = Place::Above { height, over };
    }

    /// Puts a body that was to fall on the floor; one with a given centre stays there.
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
