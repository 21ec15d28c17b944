//! Decay of audible tones, apart from the damping of the fracture.
//!
//! A break is over in a millisecond and does not care how long 10 kHz ring; the ear does. The numbers of the fracture let glass ring ten times
//! too long there, so sound has damping of its own, in three parts that add up: the material's, here; what the body [radiates](crate::Body),
//! which follows from its modes; and what [supports](Hold) take.

use frangible::Material;

/// Loss of a mode's energy in its material: it falls as e^{−dt}, its amplitude as e^{−dt/2}, with d = α + β ω² + η ω.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AudibleDamping {
    /// Rayleigh's α of the mass, 1/s.
    pub mass: f64,
    /// Rayleigh's β of the stiffness, s.
    pub stiffness: f64,
    /// Loss factor η, the same at all frequencies.
    pub loss_factor: f64,
}

/// A material and its damping.
struct Known {
    names: &'static [&'static str],
    damping: AudibleDamping,
    source: &'static str,
}

const fn rayleigh(mass: f64, stiffness: f64) -> AudibleDamping {
    AudibleDamping {
        mass,
        stiffness,
        loss_factor: 0.0,
    }
}

const fn hysteretic(loss_factor: f64) -> AudibleDamping {
    AudibleDamping {
        mass: 0.0,
        stiffness: 0.0,
        loss_factor,
    }
}

const WANG_JAMES: &str = "Wang and James, KleinPAT, ACM TOG 38(4), 2019, Table 4";
const CREMER: &str = "order of magnitude of Cremer and Heckl, Structure-Borne Sound, Springer 1988, table of loss factors";
const ESTIMATE: &str = "an estimate: no measurement was found";

const KNOWN: [Known; 12] = [
    Known {
        names: &[
            "glass",
            "paper-glass",
            "paper-slab",
            "paper-slab-low",
            "paper-slab-high",
            "paper-slab-very-high",
        ],
        damping: rayleigh(1.0, 1e-7),
        source: WANG_JAMES,
    },
    Known {
        names: &["porcelain", "paper-piggy", "paper-rabbit"],
        damping: rayleigh(6.0, 1e-7),
        source: WANG_JAMES,
    },
    Known {
        names: &["wood"],
        damping: rayleigh(60.0, 2e-6),
        source: WANG_JAMES,
    },
    Known {
        names: &["steel"],
        damping: rayleigh(5.0, 3e-8),
        source: WANG_JAMES,
    },
    Known {
        names: &["pmma"],
        damping: hysteretic(3e-2),
        source: CREMER,
    },
    Known {
        names: &["brick"],
        damping: hysteretic(1.5e-2),
        source: CREMER,
    },
    Known {
        names: &["concrete"],
        damping: hysteretic(6e-3),
        source: CREMER,
    },
    Known {
        names: &["marble", "stone"],
        damping: hysteretic(3e-3),
        source: ESTIMATE,
    },
    Known {
        names: &["ice"],
        damping: hysteretic(1e-2),
        source: ESTIMATE,
    },
    Known {
        names: &["sugar"],
        damping: hysteretic(5e-3),
        source: ESTIMATE,
    },
    Known {
        names: &["chocolate"],
        damping: hysteretic(1e-1),
        source: ESTIMATE,
    },
    Known {
        names: &["rubber"],
        damping: hysteretic(2e-1),
        source: ESTIMATE,
    },
];

impl AudibleDamping {
    /// The damping of a material by its name, and its source.
    #[must_use]
    pub fn published(name: &str) -> Option<(Self, &'static str)> {
        let known = KNOWN.iter().find(|known| known.names.contains(&name))?;
        Some((known.damping, known.source))
    }

    /// The published damping of a material, or the fracture's own of one with an unknown name.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        Self::published(&material.name).map_or(
            rayleigh(material.mass_damping, material.stiffness_damping),
            |(damping, _)| damping,
        )
    }

    /// The loss d at an angular frequency, rad/s, in 1/s.
    #[must_use]
    pub fn loss(&self, frequency: f64) -> f64 {
        self.mass + self.stiffness * frequency * frequency + self.loss_factor * frequency
    }
}

/// Support of a body while it rings, which takes energy from it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// Nothing: it flies, or touches only for moments.
    #[default]
    Free,
    /// It stands or lies on something: a loss of 4/s, by which a glass on a table rings half as long at its lowest tone. An estimate;
    /// stone takes far less, by the mobility of its half-space, and a cloth far more.
    Standing,
    /// Its edge is set in a frame with putty or mortar: a loss factor of 0.02, in the middle of 0.01 to 0.03 that the standard EN 12354-1
    /// gives for building elements with their joints.
    Framed,
    /// A hand: a loss of 60/s, an estimate.
    Hand,
}

impl Hold {
    /// Its part of the loss d at an angular frequency, rad/s, in 1/s.
    #[must_use]
    pub fn loss(self, frequency: f64) -> f64 {
        match self {
            Self::Free => 0.0,
            Self::Standing => 4.0,
            Self::Framed => 0.02 * frequency,
            Self::Hand => 60.0,
        }
    }
}
