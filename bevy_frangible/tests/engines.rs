//! The two engines against each other, in the scenes of the example `engines`.

#[path = "../examples/engines/in_avian.rs"]
mod in_avian;
#[path = "../examples/engines/in_rapier.rs"]
mod in_rapier;
#[path = "../examples/engines/scenes.rs"]
#[allow(dead_code, reason = "the example has more scenes")]
mod scenes;

use bevy_frangible::FrangibleAsset;
use bevy_frangible::frangible::{Asset, Material};
use scenes::{Outcome, Scene, ball_on_pane};

fn throw(speed: f32) -> Scene {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/frangible/tests/bodies/pane.frangible"
    );
    let pane = FrangibleAsset::new(Asset::load(file).unwrap()).unwrap().0;
    ball_on_pane(&pane, &Material::preset("steel").unwrap(), speed)
}

#[test]
fn a_throw_ends_in_avian_as_it_does_in_rapier() {
    let scene = throw(12.0);
    let mut sums = [0.0_f32; 2];
    for seed in 0..100 {
        let rapier = in_rapier::run(&scene, seed, 240.0).unwrap();
        let avian = in_avian::run(&scene, seed, 240.0);
        println!("seed {seed}: {rapier:?}\n  in Avian {avian:?}");
        assert!(rapier.broke.is_some() && avian.broke.is_some());
        sums[0] -= rapier.striker.z;
        sums[1] -= avian.striker.z;
    }
    let [rapier, avian] = sums.map(|sum| sum / 100.0);
    println!("the ball goes on at {rapier} m/s in Rapier, {avian} m/s in Avian");
    // Both move striker and pieces on with the velocities of the blow (docs/engines.md): what is left is the engines' rounding.
    assert!((avian / rapier - 1.0).abs() < 0.005, "{avian} {rapier}");
}

/// Momentum stays over the step of the break, and the motion pays for the cracks.
fn conserves(of: impl Fn(u64) -> Outcome) {
    // The last two leave large flat pieces that spin about axes aslant to those of the pane.
    for seed in [0, 1, 2, 3, 31, 36] {
        let broke = of(seed).broke.expect("it breaks");
        let [before, after] = broke.momentum;
        let change = (after - before).length() / before.length();
        let [had, has] = broke.energy;
        println!("{change:e} of the momentum, {had} J, then {has} J: {broke:?}");
        assert!(change < 1e-4, "{before} {after}");
        assert!(has + broke.cracks <= had * (1.0 + 1e-4), "{broke:?}");
    }
}

#[test]
fn rapier_keeps_momentum_over_a_break_and_pays_for_its_cracks() {
    for speed in [12.0, 25.0] {
        let scene = throw(speed);
        conserves(|seed| in_rapier::run(&scene, seed, 240.0).unwrap());
    }
}

#[test]
fn avian_keeps_momentum_over_a_break_and_pays_for_its_cracks() {
    for speed in [12.0, 25.0] {
        let scene = throw(speed);
        conserves(|seed| in_avian::run(&scene, seed, 240.0));
    }
}
