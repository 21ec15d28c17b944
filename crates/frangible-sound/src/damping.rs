//! Damping of audible tones, separate from the damping of the fracture model.
//!
//! A break is over in a millisecond, so the damping at 10 kHz does not affect it, but it is audible: with the values of the fracture model, glass
//! would ring ten times too long. Sound therefore has its own damping, the sum of three parts: the material, defined here; the
//! [radiation](crate::SoundBody), which follows from the modes; and the [supports](Hold).

use frangible::Material;

/// Material damping of a mode: its energy falls as e^{−dt}, its amplitude as e^{−dt/2}, with d = α + β ω² + η ω.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AudibleDamping {
    /// Mass-proportional Rayleigh coefficient α, 1/s.
    pub mass: f64,
    /// Stiffness-proportional Rayleigh coefficient β, s.
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
const BIRCH_BANCROFT: &str =
    "Q = 150 of granite from 140 to 4500 Hz: Birch and Bancroft, Bull. Seismol. Soc. Am. 28, 1938";
const ESTIMATE: &str = "an estimate: no measurement was found";

const KNOWN: [Known; 13] = [
    Known {
        names: &[
            "glass",
            "glass-new",
            "glass-abraded",
            "tempered-glass",
            "heat-strengthened-glass",
            "paper-glass",
            "paper-slab",
            "paper-slab-low",
            "paper-slab-high",
            "paper-slab-very-high",
        ],
        damping: hysteretic(1e-3),
        source: CREMER,
    },
    Known {
        names: &["laminated-glass"],
        damping: hysteretic(5e-2),
        source: ESTIMATE,
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
        damping: hysteretic(1.0 / 150.0),
        source: BIRCH_BANCROFT,
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
    /// Returns the published damping of a material by its name, with its source.
    #[must_use]
    pub fn published(name: &str) -> Option<(Self, &'static str)> {
        let known = KNOWN.iter().find(|known| known.names.contains(&name))?;
        Some((known.damping, known.source))
    }

    /// Returns the published damping of a material, or the damping of its fracture model if its name is unknown.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        Self::published(&material.name).map_or(
            rayleigh(material.mass_damping, material.stiffness_damping),
            |(damping, _)| damping,
        )
    }

    /// Returns the loss rate d at an angular frequency, rad/s, in 1/s.
    #[must_use]
    pub fn loss(&self, frequency: f64) -> f64 {
        self.mass + self.stiffness * frequency * frequency + self.loss_factor * frequency
    }
}

/// Support of a ringing body, which adds damping.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// Free: the body flies or touches other bodies only briefly.
    #[default]
    Free,
    /// Standing or lying on something: a loss of 4/s, which halves the ringing of a glass on a table at its lowest tone. An estimate; a stone
    /// floor absorbs far less, according to the mobility of a half-space, and a cloth far more.
    Standing,
    /// Edge set in a frame with putty or mortar: a loss factor of 0.02, in the middle of 0.01 to 0.03 that the standard EN 12354-1
    /// gives for building elements with their joints.
    Framed,
    /// Held in a hand: a loss of 60/s, an estimate.
    Hand,
}

impl Hold {
    /// Returns the contribution of the support to the loss rate d at an angular frequency, rad/s, in 1/s.
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
