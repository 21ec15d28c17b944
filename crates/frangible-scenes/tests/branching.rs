//! Cracks that fork.

use std::sync::Arc;

use crate::common::{mean, pane, pane_hit};
use frangible::internals::Fields;
use frangible::{Asset, Breakable, FractureConfig, ImpactReport, impact};

/// A blow in the middle of a pane whose strength scatters as glass does.
fn struck(asset: &Arc<Asset>, speed: f64, seed: u64, config: &FractureConfig) -> ImpactReport {
    let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
    let fields = Fields::of_material(asset.material());
    let body = kind.with_fields(fields).unwrap().body(seed);
    let outcome = impact(&body, &[pane_hit(0.0, 0.0, speed)], config).unwrap();
    outcome.report().clone()
}

#[test]
fn a_harder_blow_forks_more_cracks() {
    let ours = FractureConfig::default();
    let forks = |speed| mean(6, |seed| struck(pane(), speed, seed, &ours).forks as f64);
    let [slow, middle, fast] = [3.0, 8.0, 20.0].map(forks);
    println!("forks at 3, 8, 20 m/s: {slow:.1} {middle:.1} {fast:.1}");
    assert!(slow < middle && middle < fast && fast >= 10.0);
}

#[test]
fn tougher_glass_forks_less() {
    // The same blow, strength and feed; what a fork needs grows with the root of the toughness.
    let config = FractureConfig::default();
    let forks = [1.0, 4.0, 16.0].map(|factor| {
        let mut asset = Asset::clone(pane());
        asset.parts_mut().material.fracture_energy *= factor;
        asset.parts_mut().material.energy_depth *= factor;
        let asset = Arc::new(asset);
        mean(6, |seed| struck(&asset, 12.0, seed, &config).forks as f64)
    });
    println!("forks at 12 m/s, G_c × 1, 4, 16: {forks:.1?}");
    assert!(forks[0] > forks[1] && forks[1] > forks[2]);
    assert!(forks[2] < 0.2 * forks[0]);
}

#[test]
fn a_branching_constant_stands_for_as_many_times_the_toughness() {
    let config = FractureConfig::default();
    let [glass, twice, never] = [1.0, 2.0, f64::INFINITY].map(|factor| {
        let mut asset = Asset::clone(pane());
        asset.parts_mut().material.branching_constant *= factor;
        let asset = Arc::new(asset);
        mean(6, |seed| struck(&asset, 12.0, seed, &config).forks as f64)
    });
    println!("forks at 12 m/s, branching constant × 1, 2, ∞: {glass:.1} {twice:.1} {never:.1}");
    assert!(twice < 0.7 * glass && never == 0.0);
}

#[test]
fn cracks_that_fork_spend_no_more_than_the_body_holds() {
    for seed in 1..=4 {
        let report = struck(pane(), 20.0, seed, &FractureConfig::default());
        assert!(report.forks > 0 && report.forks < report.cracks);
        assert!(report.fracture_energy <= report.peak_strain_energy);
    }
}
