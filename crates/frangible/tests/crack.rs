//! What must hold of cracks, whatever they cut.

use crate::bodies::{breaking, breaks, models, pane, pane_hit, strike};
use frangible::internals::impact_traced;
use frangible::{Breakable, FractureConfig};

#[test]
fn cracks_cost_their_area_times_the_toughness() {
    for b in breaks() {
        let (name, report) = (&b.name, &b.fracture.report);
        assert!(report.cracks > 0 && report.crack_area > 0.0, "{name}");
        let cost = b.body.asset().material().fracture_energy * report.crack_area;
        assert!(
            (report.fracture_energy / cost - 1.0).abs() < 1e-6,
            "{name}: {} J, not {cost} J",
            report.fracture_energy
        );
        assert!(report.first_crack_time.is_some(), "{name}");
        assert!(report.first_crack_point.is_some(), "{name}");
        assert!(
            report.peak_stress > report.strength,
            "{name}: it broke below its strength"
        );
    }
}

#[test]
fn cracks_spend_no_more_than_the_strain_energy_of_the_motion() {
    let mut spent = 0;
    for (name, kind, contact) in breaking() {
        for (model, config) in models() {
            if config.is_paper() {
                continue;
            }
            for seed in 1..=3 {
                let outcome = strike(kind, seed, contact.clone(), &config);
                let report = outcome.report();
                let (spends, held) = (report.fracture_energy, report.peak_strain_energy);
                assert!(
                    spends <= held * (1.0 + 1e-9),
                    "{name}, {model}, seed {seed}: {spends} J of {held} J"
                );
                spent += usize::from(spends > 0.0);
            }
        }
    }
    assert!(spent > 15, "{spent} of 24 crack");
}

/// What a striker brings is ½ m v², with the mass m that it has at the contact.
#[test]
fn cracks_spend_no_more_than_the_blow_brought() {
    for (name, kind, contact) in breaking() {
        for seed in 1..=3 {
            let outcome = strike(kind, seed, contact.clone(), &FractureConfig::default());
            let report = outcome.report();
            let give = f64::from(contact.striker.inverse_effective_mass);
            if give > 0.0 {
                let brought = 0.5 * f64::from(contact.approach_speed).powi(2) / give;
                assert!(report.fracture_energy < brought, "{name}, seed {seed}");
            }
        }
    }
}

/// Where even the first tetrahedron costs more than the motion holds, nothing cracks, however high the stress is.
#[test]
fn what_no_motion_can_pay_does_not_crack() {
    let mut asset = (**pane().asset()).clone();
    asset.parts_mut().material.fracture_energy *= 1e6;
    let kind = Breakable::uniform(asset).unwrap();
    for seed in 1..=3 {
        let hit = pane_hit(0.0, 0.0, 20.0);
        let outcome = strike(&kind, seed, hit, &FractureConfig::default());
        let report = outcome.report();
        assert!(report.peak_stress > report.strength, "seed {seed}");
        assert_eq!(report.cracks, 0, "seed {seed}");
    }
}

#[test]
fn the_first_crack_follows_the_point_of_impact() {
    let first = |seed: u64, x: f32| {
        let outcome = strike(
            pane(),
            seed,
            pane_hit(x, 0.0, 20.0),
            &FractureConfig::default(),
        );
        outcome.report().first_crack_point.unwrap()
    };
    for seed in 1..=4 {
        let (left, right) = (first(seed, -0.06), first(seed, 0.06));
        assert!(right.x > left.x + 0.06, "seed {seed}: {left}, {right}");
    }
}

/// Each crack's tetrahedra join one another through faces, are cut by no other crack, and come in the order of their times.
#[test]
fn a_crack_is_one_surface_that_grows_in_time() {
    let mut seen = 0;
    for (name, kind, contact) in breaking() {
        for (model, config) in models() {
            let body = kind.body(2);
            let (outcome, _) =
                impact_traced(&body, std::slice::from_ref(&contact), &config).unwrap();
            let tets = &body.asset().fracture().tets;
            let mut cut_by = vec![None; tets.len()];
            for (crack, arrivals) in outcome.report().arrivals.iter().enumerate() {
                let what = format!("{name}, {model}, crack {crack}");
                assert!(
                    arrivals.windows(2).all(|w| w[1].1 >= w[0].1),
                    "{what} runs back in time"
                );
                for (place, &(tet, _)) in arrivals.iter().enumerate() {
                    let before = cut_by[tet as usize].replace(crack);
                    assert_eq!(before, None, "{what}: {tet} is cut twice");
                    let joins = |other: &(u32, f64)| {
                        let corners = tets[other.0 as usize];
                        let mine = tets[tet as usize];
                        mine.iter().filter(|v| corners.contains(v)).count() == 3
                    };
                    // The first of all starts it; a fork begins where it left another crack.
                    let joined = arrivals[..place].iter().any(joins);
                    assert!(place == 0 || joined, "{what}: {tet} joins nothing");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 500, "{seen}");
}

/// A crack is nowhere before it can have run there from where it started. The paper's are everywhere at once.
#[test]
fn cracks_run_at_their_speed_or_at_once() {
    let hit = pane_hit(0.0, 0.0, 20.0);
    let (asset, speed) = (
        pane().asset(),
        0.5 * pane().asset().material().rayleigh_speed(),
    );
    let mut farthest = 0.0_f64;
    let outcome = strike(pane(), 1, hit.clone(), &FractureConfig::default());
    for crack in &outcome.report().arrivals {
        let (start, since) = crack[0];
        for &(tet, time) in crack {
            let [a, b] = [start, tet].map(|tet| asset.fracture().centroid(tet as usize));
            // From the middle of a tetrahedron to that of another, within which the crack itself begins and arrives.
            let way = f64::from(a.distance(b) - 2.0 * asset.fracture().mean_edge());
            assert!(
                way <= speed * (time - since),
                "{way} m in {} s",
                time - since
            );
            farthest = farthest.max(way);
        }
    }
    assert!(farthest > 0.02, "{farthest} m");
    let outcome = strike(pane(), 1, hit, &FractureConfig::as_in_the_paper());
    let mut cracks = outcome.report().arrivals.iter();
    assert!(cracks.all(|crack| crack.last().unwrap().1 == crack[0].1));
}
