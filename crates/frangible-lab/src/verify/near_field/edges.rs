//! Accuracy of the near field close to an edge of the wall: supported, free or held.

use frangible::{Asset, FractureConfig};
use frangible_bake::{BakeError, MeshSize, bake};
use serde_json::{Value, json};

use crate::verify::blows::plate::Terms;
use crate::verify::blows::probe::{
    self, BALL, PLATE, ball, body, felt, following, material, places,
};
use crate::verify::cases::near_field::Compared;
use crate::verify::experiments::clamped;

/// Distances of the contact from the edge, in shortest wavelengths of the modes.
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.1];

/// Modes of the free and of the held plate that stand for all, and of which so many are followed.
const MODES: usize = 300;
const FOLLOWED: usize = 75;

/// Largest difference of the total stress over its peak, by distance from the edge.
pub(super) fn compute(plate: &Asset) -> Result<Vec<Value>, BakeError> {
    let supported = body(plate.clone())?;
    let wavelength = wavelength_of(plate.modes().count());
    let mut rows = Vec::new();
    for (name, at) in [
        (
            "supported",
            (|d| [0.5 * PLATE.side - d, 0.013]) as fn(f64) -> [f64; 2],
        ),
        ("corner of two supported", |d| [0.5 * PLATE.side - d; 2]),
    ] {
        let config = FractureConfig::default();
        let errors = SHARES.iter().map(|share| {
            let compared = Compared::of(&supported, &config, Terms::Layer, at(share * wavelength))?;
            Ok(compared.error(|s| s[0] + s[1]))
        });
        let errors: Vec<f64> = errors.collect::<Result<_, BakeError>>()?;
        rows.push(json!({ "name": name, "errors": errors }));
    }
    for (name, held) in [("free", false), ("held", true)] {
        let asset = other(held)?;
        for (corner, suffix) in [(false, ""), (true, ", corner")] {
            let errors = SHARES.iter().map(|share| {
                let d = 0.5 * PLATE.side - share * wavelength_of(FOLLOWED);
                let at = if corner { [d, d] } else { [d, 0.013] };
                many(&asset, at)
            });
            let errors: Vec<f64> = errors.collect::<Result<_, BakeError>>()?;
            rows.push(json!({ "name": format!("{name}{suffix}"), "errors": errors }));
        }
    }
    Ok(rows)
}

/// 2π/k_c of so many modes of the plate: k_c² = 4πN/A.
fn wavelength_of(modes: usize) -> f64 {
    let pi = std::f64::consts::PI;
    2.0 * pi / (4.0 * pi * modes as f64).sqrt() * PLATE.side
}

/// The plate without supports, or with all of its edges held.
fn other(held: bool) -> Result<Asset, BakeError> {
    let m = material(PLATE.youngs_modulus, PLATE.poisson_ratio, PLATE.density);
    let mut spec = clamped(PLATE.side, PLATE.thickness, m, [0.0025, 0.0015], MODES);
    spec.fracture = spec.fracture.map(|size| MeshSize { layers: 1, ..size });
    if !held {
        spec.supports.clear();
    }
    bake(&spec)
}

/// Few modes, the others as residual vector, and the near field, beside all modes and theirs: the total stress around the contact.
fn many(asset: &Asset, at: [f64; 2]) -> Result<f64, BakeError> {
    let config = FractureConfig::default();
    let bodies = [
        body(following(asset.clone(), FOLLOWED))?,
        body(following(asset.clone(), MODES))?,
    ];
    let blows = [
        probe::blow(&bodies[0], ball(at, 20.0, BALL), &config)?,
        probe::blow(&bodies[1], ball(at, 20.0, BALL), &config)?,
    ];
    let inwards = [-1.0, 0.0];
    let distances = [1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 6e-3, 8e-3, 12e-3];
    let around = places(&bodies[0], at, inwards, &distances);
    let (mut most, mut off) = (0.0_f64, 0.0_f64);
    for t in [10e-6, 20e-6, 40e-6, 60e-6] {
        for place in &around {
            // Between two steps, whose lengths differ.
            let [few, all] = [0, 1].map(|i| {
                let x = t / blows[i].time_step() - 1.0;
                let before = x.floor();
                let [a, b] = [before, before + 1.0].map(|step| {
                    let s = felt(&bodies[i], &blows[i], place, step as usize, &config);
                    s[0] + s[1]
                });
                a + (b - a) * (x - before)
            });
            most = most.max(all.abs());
            off = off.max((few - all).abs());
        }
    }
    Ok(off / most)
}
