//! The default model of the star cracks, and the variants that differ from it in one thing each.

use std::f64::consts::PI;

use frangible::internals::{Fields, Model};
use frangible::{Breakable, FractureConfig, InputError, Material};

use super::blow::{Projectile, STEEL_DENSITY};

/// Width of the projectile, m.
pub(crate) const WIDTH: f64 = 4e-3;
/// Length of the projectile, m. Reports of the experiment call it a cylinder, one a bullet-shaped one, and give its width alone;
/// bullets are two to four times as long as wide, and both ends of that range are among the variants.
pub(crate) const LENGTH: f64 = 3.0 * WIDTH;

/// The default model, or how a computation differs from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    model: Model,
    strength: f64,
    weak_points: f64,
    /// If true, the branching constant is that of glass.
    forks_as_glass: bool,
    /// Young's modulus, Pa, where it is another.
    pub(crate) modulus: Option<f64>,
    scatter: bool,
    /// Shape of the projectile.
    shape: Shot,
}

/// The shape of a projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shot {
    /// A ball.
    Ball,
    /// A cylinder with half a ball as its nose, of this length, m.
    Bullet(f64),
}

/// The default model, which all other variants start from.
pub(crate) const DEFAULT: Variant = Variant {
    name: "default",
    model: Model::Ours,
    strength: 1.0,
    weak_points: 1.0,
    forks_as_glass: false,
    modulus: None,
    scatter: true,
    shape: Shot::Bullet(LENGTH),
};

/// The other ways in which the measured thickness is computed.
pub(crate) const VARIANTS: [Variant; 11] = [
    Variant {
        name: "the paper's cracks: at once, planar, from centres of tetrahedra (`Model::Paper`)",
        model: Model::Paper,
        ..DEFAULT
    },
    Variant {
        name: "cracks fork as readily as in glass (`branching_constant` 2.9)",
        forks_as_glass: true,
        ..DEFAULT
    },
    Variant {
        name: "Young's modulus of slow tests, 3.2 GPa, with the same K_Ic",
        modulus: Some(3.204e9),
        ..DEFAULT
    },
    Variant {
        name: "Young's modulus of waves of some MHz, 5.7 GPa, with the same K_Ic",
        modulus: Some(5.705e9),
        ..DEFAULT
    },
    Variant {
        name: "every weak point as strong as the others, R_c",
        scatter: false,
        ..DEFAULT
    },
    Variant {
        name: "strength × 1.3, what a sphere's impact was found to need more than a slow test",
        strength: 1.3,
        ..DEFAULT
    },
    Variant {
        name: "strength ÷ 1.5",
        strength: 1.0 / 1.5,
        ..DEFAULT
    },
    Variant {
        name: "weak points × 4",
        weak_points: 4.0,
        ..DEFAULT
    },
    Variant {
        name: "projectile 8 mm long (0.72 g)",
        shape: Shot::Bullet(2.0 * WIDTH),
        ..DEFAULT
    },
    Variant {
        name: "projectile 16 mm long (1.50 g)",
        shape: Shot::Bullet(4.0 * WIDTH),
        ..DEFAULT
    },
    Variant {
        name: "a ball (0.26 g)",
        shape: Shot::Ball,
        ..DEFAULT
    },
];

impl Variant {
    /// Material of the plate where it differs from the default: its fracture toughness stays the same.
    pub(crate) fn material(self, usual: &Material) -> Option<Material> {
        let modulus = self.modulus?;
        let mut material = usual.clone();
        material.youngs_modulus = modulus;
        material.fracture_energy *= usual.youngs_modulus / modulus;
        Some(material)
    }

    /// This hits the plate.
    pub(crate) fn projectile(self) -> Projectile {
        self.shape.projectile()
    }

    /// Cracks run with this configuration.
    pub(crate) fn config(self) -> FractureConfig {
        let mut config = FractureConfig::default();
        config.model = self.model;
        config
    }

    /// The plate gets another strength or branching constant, or more weak points; none of them matters to its modes.
    pub(crate) fn applied_to(
        self,
        plate: &Breakable,
        glass: &Material,
    ) -> Result<Breakable, InputError> {
        let mut asset = (**plate.asset()).clone();
        asset.parts_mut().material.strength *= self.strength;
        asset.parts_mut().material.weak_point_density *= self.weak_points;
        if self.forks_as_glass {
            asset.parts_mut().material.branching_constant = glass.branching_constant;
        }
        let fields = if self.scatter {
            Fields::of_material(asset.material())
        } else {
            Fields::default()
        };
        Breakable::new(asset)?.with_fields(fields)
    }
}

impl Shot {
    fn projectile(self) -> Projectile {
        let radius = 0.5 * WIDTH;
        let ball = 4.0 / 3.0 * PI * radius.powi(3);
        let volume = match self {
            Self::Ball => ball,
            Self::Bullet(length) => 0.5 * ball + PI * radius.powi(2) * (length - radius),
        };
        Projectile {
            mass: STEEL_DENSITY * volume,
            radius,
        }
    }
}
