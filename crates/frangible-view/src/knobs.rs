//! Adjustable parameters of the model, each with its unit, its range and its equation.

mod table;

use frangible::internals::DurationModel;
use frangible::{FractureConfig, Material};
use frangible_scenes::{BakedBody, BodySource, Scene};

pub use table::KNOBS;

/// Settings changed by the knobs.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Material of the body.
    pub material: Material,
    /// Settings of the fracture model.
    pub fracture: FractureConfig,
    /// Number of vibration modes.
    pub modes: usize,
    /// Random seed of the weak points and of the roughness of the cracks.
    pub seed: u64,
    /// c of the duration `[G12 Eq. 2]` as printed, m^(1/5) s^(2/5); kept while another model is chosen.
    pub printed_coefficient: f64,
}

impl Settings {
    /// The scene's own; of a body that came baked they are its asset's. None of a scene without bodies.
    pub(crate) fn of(scene: &Scene, baked: Option<&BakedBody>) -> Option<Self> {
        let body = scene.bodies.first()?;
        let asset = match body.source {
            BodySource::Asset(_) => baked.map(|baked| &baked.asset),
            _ => None,
        };
        Some(Self {
            material: asset.map_or(&body.material, |a| a.material()).clone(),
            fracture: scene.fracture.clone(),
            modes: asset.map_or(body.modes, |a| a.modes().count()),
            seed: scene.seed,
            printed_coefficient: match scene.fracture.duration {
                DurationModel::AsPrinted { c } => c,
                // The right order for a hand-sized thing.
                _ => 0.01,
            },
        })
    }
}

/// Kind of a knob's scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number on a logarithmic scale.
    Factor,
    /// A number on a linear scale.
    Even,
    /// A whole number.
    Whole,
    /// On (1) or off (0).
    Switch,
    /// One of these choices, by index from 0.
    Choice(&'static [&'static str]),
}

/// A knob.
#[derive(Debug)]
pub struct Knob {
    /// Name in scripts.
    pub name: &'static str,
    /// Name in the panel.
    pub label: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// SI units per unit.
    factor: f64,
    /// Smallest and largest value, in its unit.
    pub range: [f64; 2],
    /// Kind of its scale.
    pub kind: Kind,
    /// Description of its effect, with the equation it enters.
    pub help: &'static str,
    /// True if a change requires the body to be baked again.
    pub rebakes: bool,
    get: fn(&Settings) -> f64,
    set: fn(&mut Settings, f64),
}

impl Knob {
    /// The knob of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        KNOBS.iter().find(|knob| knob.name == name)
    }

    /// Its value, in its unit.
    #[must_use]
    pub fn value(&self, settings: &Settings) -> f64 {
        (self.get)(settings) / self.factor
    }

    /// Sets it to a value in its unit, clamped to its range; NaN is ignored.
    pub fn turn(&self, settings: &mut Settings, value: f64) {
        if value.is_nan() {
            return;
        }
        let value = value.clamp(self.range[0], self.range[1]);
        let value = match self.kind {
            Kind::Factor | Kind::Even => value,
            Kind::Whole | Kind::Switch | Kind::Choice(_) => value.round(),
        };
        (self.set)(settings, value * self.factor);
    }
}

/// Turns a material's numbers as the knobs are turned from the scene's `own` to `now`; of another preset it has all numbers.
pub(crate) fn turn_material(material: &mut Material, now: &Settings, own: &Settings) {
    if now.material.name != own.material.name {
        *material = now.material.clone();
        return;
    }
    let mut settings = Settings {
        material: material.clone(),
        ..own.clone()
    };
    for knob in &KNOBS {
        if knob.value(now) != knob.value(own) {
            knob.turn(&mut settings, knob.value(now));
        }
    }
    *material = settings.material;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings() -> Settings {
        Settings {
            material: Material::preset("glass").unwrap(),
            fracture: FractureConfig::default(),
            modes: 60,
            seed: 1,
            printed_coefficient: 0.01,
        }
    }

    #[test]
    fn every_knob_turns_its_own_number_and_back() {
        for knob in &KNOBS {
            let mut turned = settings();
            let old = knob.value(&turned);
            for end in knob.range {
                knob.turn(&mut turned, end);
                let value = knob.value(&turned);
                assert!(
                    (value - end).abs() <= 1e-12 * end.abs(),
                    "{}: {value}",
                    knob.name
                );
            }
            let others = KNOBS.iter().filter(|other| other.name != knob.name);
            for other in others {
                assert_eq!(
                    other.value(&turned),
                    other.value(&settings()),
                    "{} by {}",
                    other.name,
                    knob.name
                );
            }
            knob.turn(&mut turned, old);
            assert!(
                (knob.value(&turned) - old).abs() <= 1e-12 * old.abs(),
                "{}",
                knob.name
            );
        }
    }

    #[test]
    fn presets_are_within_the_ranges() {
        for preset in Material::presets() {
            let mut settings = settings();
            settings.material = preset.material().clone();
            for knob in &KNOBS {
                let value = knob.value(&settings);
                assert!(
                    (knob.range[0]..=knob.range[1]).contains(&value),
                    "{} of {}: {value}",
                    knob.name,
                    preset.name
                );
            }
        }
    }

    #[test]
    fn nan_turns_nothing_and_too_much_stops_at_the_end() {
        let knob = Knob::named("strength").unwrap();
        let mut turned = settings();
        knob.turn(&mut turned, f64::NAN);
        assert_eq!(turned, settings());
        knob.turn(&mut turned, 1e30);
        assert_eq!(knob.value(&turned), knob.range[1]);
        assert!(Knob::named("strenth").is_none());
    }
}
