//! Runs all methods, one after another.

use std::time::Instant;

use frangible::{Outcome, impact};

use super::divide::{Border, Division};
use super::elements;
use super::energy_voronoi::{self, DEFAULT_SITES};
use super::error::CompareError;
use super::hit::Hit;
use super::method::Method;
use super::quasi_static::{DEFAULT_STEP, quasi_static};
use super::result::{Broken, border_area};
use super::voronoi::sites_around;

/// Most cells of a Voronoi diagram.
const MOST_CELLS: usize = 10_000;

/// Options of the compared methods.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Random seed for the Voronoi sites; weak points are those of the body. Default 1.
    pub seed: u64,
    /// Duration over which the quasi-static method spreads the impulse, s: longer means a smaller force. Default [`DEFAULT_STEP`].
    pub step: f64,
    /// Number of Voronoi sites sampled by strain energy. Default [`DEFAULT_SITES`].
    pub sites: usize,
    /// Number of Voronoi sites around the impact point. Default `None`: the number of pieces of our method, at least 2.
    pub cells: Option<usize>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            step: DEFAULT_STEP,
            sites: DEFAULT_SITES,
            cells: None,
        }
    }
}

impl Options {
    fn check(&self) -> Result<(), CompareError> {
        let wrong = |what, value: String, wanted| CompareError::Option {
            what,
            value,
            wanted,
        };
        if !(self.step.is_finite() && self.step > 0.0) {
            let value = format!("{} s", self.step);
            return Err(wrong("the quasi-static step", value, "above 0 s"));
        }
        let counts = [
            ("the number of sites", Some(self.sites)),
            ("the number of cells", self.cells),
        ];
        for (what, count) in counts {
            let count = count.filter(|count| !(1..=MOST_CELLS).contains(count));
            if let Some(count) = count {
                return Err(wrong(what, count.to_string(), "1 to 10000"));
            }
        }
        Ok(())
    }
}

/// Breaks the body with each of these methods. Calls `before` with each method before it starts.
///
/// # Errors
/// A piece of a broken body, contacts without impulse or rejected by the fracture model, an option out of range.
pub fn compare(
    hit: Hit<'_>,
    methods: &[Method],
    options: &Options,
    before: &mut dyn FnMut(Method),
) -> Result<Vec<Broken>, CompareError> {
    hit.check()?;
    options.check()?;
    let mut all: Vec<Broken> = Vec::new();
    for &method in methods {
        before(method);
        let cells = match (method, options.cells) {
            (Method::Voronoi, Some(cells)) => cells,
            (Method::Voronoi, None) => pieces_of_ours(hit, &all)?.max(2),
            _ => 0,
        };
        let clock = Instant::now();
        let mut broken = match method {
            Method::Ours => of_outcome(impact(hit.body, hit.contacts, hit.config)?),
            Method::QuasiStatic => of_outcome(quasi_static(hit, options.step)?),
            Method::Elements => of_faces(hit)?,
            Method::EnergyVoronoi => {
                let (division, energy) = energy_voronoi::divide(hit, options.sites, options.seed)?;
                let mut broken = of_division(hit, division);
                broken.available = energy;
                broken
            }
            Method::Voronoi => {
                let sites = sites_around(hit, cells, options.seed);
                of_division(hit, sites.divide(hit.body)?)
            }
        };
        broken.seconds = clock.elapsed().as_secs_f64();
        broken.method = method;
        if broken.fragments.len() < 2 {
            broken.fragments.clear();
        }
        broken.border_area = border_area(&broken.fragments);
        all.push(broken);
    }
    Ok(all)
}

fn pieces_of_ours(hit: Hit<'_>, known: &[Broken]) -> Result<usize, CompareError> {
    match known.iter().find(|broken| broken.method == Method::Ours) {
        Some(ours) => Ok(ours.pieces()),
        None => match impact(hit.body, hit.contacts, hit.config)? {
            Outcome::Broke(fracture) => Ok(fracture.fragments.len()),
            _ => Ok(1),
        },
    }
}

/// An empty result; every method fills in its own numbers.
fn empty() -> Broken {
    Broken {
        method: Method::Ours,
        fragments: Vec::new(),
        crack_area: 0.0,
        border_area: 0.0,
        energy: 0.0,
        available: 0.0,
        seconds: 0.0,
    }
}

fn of_outcome(outcome: Outcome) -> Broken {
    let report = outcome.report();
    let broken = Broken {
        crack_area: report.crack_area,
        energy: report.fracture_energy,
        available: report.peak_strain_energy,
        ..empty()
    };
    match outcome {
        Outcome::Broke(fracture) => Broken {
            fragments: fracture.fragments,
            ..broken
        },
        _ => broken,
    }
}

fn of_faces(hit: Hit<'_>) -> Result<Broken, CompareError> {
    let separated = elements::separate(hit)?;
    Ok(Broken {
        fragments: separated.fragments,
        crack_area: separated.crack_area,
        energy: separated.energy,
        available: separated.available,
        ..empty()
    })
}

fn of_division(hit: Hit<'_>, division: Division<'_>) -> Broken {
    let (fragments, borders) = division.pieces(hit.config.crumb_share);
    let cost = |border: &Border| border.area * hit.body.toughness(border.tet);
    // Not by `sum`: of nothing it is −0.
    let total = |of: &dyn Fn(&Border) -> f64| borders.iter().fold(0.0, |sum, b| sum + of(b));
    Broken {
        fragments,
        crack_area: total(&|border| border.area),
        energy: total(&cost),
        ..empty()
    }
}
