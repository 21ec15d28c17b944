//! A coarse bar and a coarse plate, broken: the subjects of Figs. 6, 9 and 10.

use std::collections::BTreeSet;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::{CrackTrace, TetMesh, impact_traced};
use frangible::{Asset, Body, Contact, Fracture, FractureConfig, Material, Outcome, Striker};
use frangible_bake::Shape;

use crate::figures::FigureError;
use crate::figures::bodies::{baked, changed};
use crate::figures::draw::{Colour, Model};

/// A break, and how its cracks ran.
pub(crate) struct Broken {
    pub(crate) asset: Arc<Asset>,
    pub(crate) fracture: Box<Fracture>,
    pub(crate) trace: CrackTrace,
    /// Speed of the ball, m/s.
    pub(crate) speed: f64,
}

/// The paper's model, but every piece counts, however small.
pub(crate) fn config() -> FractureConfig {
    let mut config = FractureConfig::as_in_the_paper();
    config.crumb_share = 0.0;
    config
}

/// Slowest and fastest ball that is tried, m/s, and the factor between one and the next.
const SPEEDS: [f64; 3] = [2.0, 30.0, 1.04];

/// Seeds that are tried at each speed.
const SEEDS: u64 = 6;

/// Modes of these bodies: their blows are long against their higher ones.
const MODES: usize = 30;

/// A bar of 160 × 60 × 50 mm, hit in its middle so that one crack parts it.
pub(crate) fn bar() -> Result<Broken, FigureError> {
    let asset = baked(
        "bar",
        Shape::block([0.16, 0.06, 0.05]),
        "porcelain",
        1800.0,
        MODES,
    )?;
    let top = Vec3::new(0.0, 0.0, 0.025);
    search(&asset, top, |f, trace| {
        f.fragments.len() == 2 && trace.cracks.len() == 1
    })
    .or_else(|_| search(&asset, top, |f, _| f.fragments.len() == 2))
}

/// A plate of 120 × 90 × 8 mm, a single layer of tetrahedra, hit in its middle so that a few cracks part it.
pub(crate) fn plate() -> Result<Broken, FigureError> {
    let asset = baked(
        "plate",
        Shape::plate(0.12, 0.09, 0.008),
        "porcelain",
        900.0,
        MODES,
    )?;
    // Few weak points, so that cracks start where there is one and not all under the blow.
    let asset = changed(&asset, |m| m.weak_point_density = 1e6);
    let top = Vec3::new(0.02, 0.012, 0.004);
    search(&asset, top, |fracture, trace| {
        (3..=6).contains(&fracture.fragments.len())
            && trace.cracks.len() <= 5
            && smallest(fracture) > 0.05
    })
    .or_else(|_| search(&asset, top, |f, _| f.fragments.len() >= 3))
}

/// Share of the smallest piece.
fn smallest(fracture: &Fracture) -> f64 {
    let volumes = || fracture.fragments.iter().map(|f| f.mass.volume);
    volumes().fold(f64::INFINITY, f64::min) / volumes().sum::<f64>()
}

/// The gentlest blow of a steel ball whose outcome is wanted.
fn search(
    asset: &Arc<Asset>,
    point: Vec3,
    wanted: impl Fn(&Fracture, &CrackTrace) -> bool,
) -> Result<Broken, FigureError> {
    let steel = Material::preset("steel")?;
    let kind = frangible::Breakable::uniform(Arc::clone(asset))?;
    let [slowest, fastest, factor] = SPEEDS;
    let mut speed = slowest;
    while speed < fastest {
        let contact: Contact = Contact::collision(
            asset,
            point,
            Vec3::NEG_Z,
            speed,
            Striker::ball(&steel, 0.2, 0.018),
        );
        for seed in 1..=SEEDS {
            let body: Body = kind.body(seed);
            let (outcome, trace) = impact_traced(&body, std::slice::from_ref(&contact), &config())?;
            if let Outcome::Broke(fracture) = outcome
                && wanted(&fracture, &trace)
            {
                return Ok(Broken {
                    asset: Arc::clone(asset),
                    fracture,
                    trace,
                    speed,
                });
            }
        }
        speed *= factor;
    }
    Err(FigureError::Nothing(
        "no blow parts the coarse body as the figure needs it",
    ))
}

/// The edges of the outside, drawn as bars.
pub(crate) fn add_edges(
    model: &mut Model,
    mesh: &TetMesh,
    triangles: &[[u32; 3]],
    colour: Colour,
    half_width: f32,
) {
    let mut edges = BTreeSet::new();
    for &[a, b, c] in triangles {
        for [v, w] in [[a, b], [b, c], [c, a]] {
            edges.insert((v.min(w), v.max(w)));
        }
    }
    for (v, w) in edges {
        model.bar(
            colour,
            [v, w].map(|v| mesh.positions[v as usize]),
            half_width,
        );
    }
}
