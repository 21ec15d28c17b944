//! The breaks of scenes make no energy; the example `energy` shows the same of all of them.

use frangible_scenes::{Scene, bake, play, scene};

/// A built-in scene with few modes, to its break.
fn cheap(name: &str) -> Scene {
    let mut scene = scene(name).unwrap();
    scene.duration = 1.2;
    for body in &mut scene.bodies {
        body.modes = 40;
        body.resolution = body.resolution.or(Some(15_000));
    }
    scene
}

#[test]
fn breaks_make_no_energy() {
    let mut broke = 0;
    for name in ["pane", "plate", "brick", "chocolate", "shards"] {
        let scene = cheap(name);
        let baked = bake(&scene).unwrap();
        let run = play(&scene, &baked, &mut |_| {}).unwrap();
        for b in &run.breaks {
            let r = &b.report;
            println!(
                "{name}, {:?}: approach {:.3}, strain {:.4}, cracks {:.4}; T {:.3} + {:.4} → {:.3}, paid {:.4} J",
                b.cause,
                r.approach_energy,
                r.peak_strain_energy,
                r.fracture_energy,
                b.kinetic_before,
                b.work,
                b.kinetic_after,
                b.energy_paid
            );
            assert_eq!(b.energy_created(), None, "{name}");
            assert!(b.energy_paid <= r.fracture_energy);
            // Work, losses and what is left are summed each on its own.
            let e = r.blow_energy;
            let open = e.work - e.damped - e.faces - e.released - e.kept;
            println!("of {:.5} J brought in {open:.6} J are not closed", e.work);
            assert!(open.abs() <= 0.015 * e.work, "{name}: {e:?}");
            broke += 1;
        }
    }
    assert!(broke >= 8, "{broke}");
}

#[test]
fn energy_that_is_made_is_named() {
    let scene = cheap("pane");
    let baked = bake(&scene).unwrap();
    let run = play(&scene, &baked, &mut |_| {}).unwrap();
    let sound = run.breaks.first().expect("it breaks").clone();
    let named = |change: fn(&mut frangible_scenes::BreakRecord), word: &str| {
        let mut record = sound.clone();
        change(&mut record);
        let problem = record.energy_created().expect("energy was made");
        assert!(problem.contains(word), "{problem}");
    };
    named(|b| b.report.approach_energy *= 1e-6, "approach");
    named(
        |b| b.report.fracture_energy = 1.1 * b.report.peak_strain_energy,
        "of crack energy from",
    );
    named(
        |b| b.kinetic_after = 1.1 * (b.kinetic_before + b.work),
        "kinetic energy and work",
    );
}
