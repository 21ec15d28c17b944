//! Stress bounds: places that they pass over hold no crack, so results with and without them are the same bits.

use crate::common::{block, blow, glass, pane, steel_ball, stone_floor};
use frangible::glam::Vec3;
use frangible::internals::{Factors, Fields, LookedAt};
use frangible::{Asset, Breakable, Contact, FractureConfig, Outcome, impact, would_break};
use frangible_bake::weakness::{self, Patch, Zone};
use std::sync::Arc;

/// Numbers in 0..1 (a linear congruential generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A blow on a random place of the surface, from outside, up to 20 m/s, most of them soft.
    fn blow(&mut self, asset: &Asset) -> Contact {
        let triangle = (self.next() * asset.surface().triangles.len() as f64) as usize;
        let corners =
            asset.surface().triangles[triangle].map(|v| asset.fracture().positions[v as usize]);
        let inward = -asset.surface().normals[triangle][0];
        let tilt = Vec3::from_array(std::array::from_fn(|_| self.next() as f32 - 0.5));
        let speed = 20.0 * self.next().powi(6);
        let striker = if self.next() < 0.5 {
            steel_ball(0.02 + 0.2 * self.next())
        } else {
            stone_floor()
        };
        blow(asset, corners[0], inward + tilt, speed, striker)
    }
}

fn cracks_and_pieces(outcome: &Outcome) -> Vec<u64> {
    let report = outcome.report();
    let mut bits = vec![
        report.cracks as u64,
        report.crack_area.to_bits(),
        report.fracture_energy.to_bits(),
        report.first_crack_time.unwrap_or(-1.0).to_bits(),
    ];
    if let Outcome::Broke(fracture) = outcome {
        for fragment in &fracture.fragments {
            bits.push(fragment.mass.mass.to_bits());
            bits.extend(
                fragment
                    .mesh
                    .positions
                    .iter()
                    .flat_map(|p| p.to_array().map(|x| u64::from(x.to_bits()))),
            );
        }
    }
    bits
}

/// Stages at which a blow is refused, in the order of [`LookedAt`].
const LEVELS: [&str; 5] = [
    "by sizes",
    "by impulses",
    "by time steps",
    "by parts",
    "looked at",
];

/// Returns true if blows of every kind were met.
fn enough([sizes, impulses, amplitudes, clusters, stresses]: [usize; 5]) -> bool {
    sizes + impulses > 3 && amplitudes + clusters > 3 && stresses > 3
}

fn models() -> [FractureConfig; 2] {
    [FractureConfig::default(), FractureConfig::as_in_the_paper()]
}

#[test]
fn culling_changes_no_bit_of_what_breaks() {
    let mut numbers = Numbers(1);
    let mut looked = [0; LEVELS.len()];
    let mut ratios = [const { Vec::new() }; LEVELS.len()];
    for (name, asset) in [("glass", glass()), ("pane", pane()), ("block", block())] {
        let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
        let mut broke = 0;
        for k in 0..10 {
            let body = kind.body(k);
            let contacts: Vec<Contact> = (0..1 + k % 3).map(|_| numbers.blow(asset)).collect();
            for config in models() {
                let mut without = config.clone();
                without.culling = false;
                let fast = impact(&body, &contacts, &config).unwrap();
                let slow = impact(&body, &contacts, &without).unwrap();
                assert!(
                    cracks_and_pieces(&fast) == cracks_and_pieces(&slow),
                    "{name}, blow {k}: {:?} against {:?}",
                    fast.report(),
                    slow.report()
                );
                assert!(
                    fast.report().stress_bound >= slow.report().peak_stress * (1.0 - 1e-6),
                    "{name}, blow {k}: the bound {} is below the stress {}",
                    fast.report().stress_bound,
                    slow.report().peak_stress
                );
                let breaks = matches!(slow, Outcome::Broke(_));
                assert_eq!(would_break(&body, &contacts, &config).unwrap(), breaks);
                if let Outcome::Held { margin, .. } = fast {
                    let within = slow.report().peak_stress <= slow.report().strength;
                    assert_eq!(margin >= 1.0, within, "{name}, blow {k}: {margin}");
                }
                let level = fast.report().looked_at as usize;
                looked[level] += 1;
                if slow.report().peak_stress > 0.0 {
                    ratios[level].push(fast.report().stress_bound / slow.report().peak_stress);
                }
                broke += usize::from(breaks);
            }
        }
        println!("{name}: {broke} broke");
        assert!(broke > 2, "{name}");
    }
    for (what, ratios) in LEVELS.iter().zip(&mut ratios[..LEVELS.len() - 1]) {
        if ratios.is_empty() {
            println!("bound over stress, {what}: no blow");
            continue;
        }
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[(share * (ratios.len() - 1) as f64) as usize];
        println!(
            "bound over stress, {what}: {:.2}, {:.2}, {:.2}",
            at(0.0),
            at(0.5),
            at(1.0)
        );
    }
    println!("{LEVELS:?}: {looked:?}");
    assert!(enough(looked));
}

#[test]
fn the_hardest_blow_that_is_refused_free_of_time_leaves_the_strength_unreached() {
    let mut numbers = Numbers(3);
    let mut met = [0; LEVELS.len()];
    let config = FractureConfig::default();
    let without = {
        let mut without = config.clone();
        without.culling = false;
        without
    };
    for (name, asset) in [("glass", glass()), ("pane", pane()), ("block", block())] {
        let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
        for seed in 0..4 {
            let body = kind.body(seed);
            let some = numbers.blow(asset);
            let mut hardest: [Option<Outcome>; 2] = [None, None];
            let mut blows = [some.clone(), some.clone()];
            for k in 0..60 {
                let speed = 1e-3 * 1.15_f64.powi(k);
                let blow =
                    Contact::collision(asset, some.point, some.normal, speed, some.striker.clone());
                let outcome = impact(&body, std::slice::from_ref(&blow), &config).unwrap();
                let level = outcome.report().looked_at as usize;
                if level > LookedAt::Impulses as usize {
                    break;
                }
                hardest[level] = Some(outcome);
                blows[level] = blow;
            }
            for (level, (fast, blow)) in hardest.into_iter().zip(blows).enumerate() {
                let Some(fast) = fast else { continue };
                let slow = impact(&body, std::slice::from_ref(&blow), &without).unwrap();
                assert!(cracks_and_pieces(&fast) == cracks_and_pieces(&slow));
                let (bound, stress) = (fast.report().stress_bound, slow.report().peak_stress);
                println!(
                    "{name} {seed}, {}: bound over stress {:.2}",
                    LEVELS[level],
                    bound / stress
                );
                assert!(
                    bound >= stress && bound <= slow.report().strength,
                    "{name} {seed}"
                );
                met[level] += 1;
            }
        }
    }
    assert!(met[0] > 3 && met[1] > 3, "{met:?}");
}

#[test]
fn culling_changes_no_bit_where_the_strength_varies() {
    let mut numbers = Numbers(2);
    let mut looked = [0; LEVELS.len()];
    let mut broke = 0;
    for (name, asset) in [("glass", glass()), ("pane", pane()), ("block", block())] {
        let waves = Fields::from_function(asset, |p| Factors {
            strength: 1.0 + 0.9 * (90.0 * p.x).sin(),
            toughness: 1.0 + 0.8 * (70.0 * p.y).cos(),
            weak_points: 1.0 + (50.0 * p.z).sin(),
            ..Factors::ONE
        })
        .with_weibull_modulus(0.0);
        let line = Zone::Tube {
            line: vec![Vec3::new(0.02, -0.2, 0.0), Vec3::new(0.04, 0.2, 0.0)],
            radius: 0.01,
        };
        let scored =
            weakness::patched(Fields::default(), asset, &[Patch::of_strength(line, 0.3)]).unwrap();
        for (k, fields) in [
            waves.clone(),
            waves.with_weibull_modulus(6.0),
            scored,
            Fields::default().with_weibull_modulus(10.0),
        ]
        .into_iter()
        .enumerate()
        {
            let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
            let kind = kind.with_fields(fields).unwrap();
            for blow in 0..2 {
                let body = kind.body(blow);
                let contact = [numbers.blow(asset)];
                for config in models() {
                    let mut without = config.clone();
                    without.culling = false;
                    let fast = impact(&body, &contact, &config).unwrap();
                    let slow = impact(&body, &contact, &without).unwrap();
                    let what = format!("{name}, fields {k}, blow {blow}");
                    assert!(
                        cracks_and_pieces(&fast) == cracks_and_pieces(&slow),
                        "{what}"
                    );
                    let (a, b) = (fast.report(), slow.report());
                    assert!(a.stress_bound >= b.peak_stress * (1.0 - 1e-6), "{what}");
                    if let (Outcome::Held { margin: a, .. }, Outcome::Held { margin: b, .. }) =
                        (&fast, &slow)
                    {
                        assert_eq!(*a >= 1.0, *b >= 1.0, "{what}: {a} {b}");
                        assert!(*a <= b * (1.0 + 1e-6), "{what}: {a} {b}");
                    }
                    looked[fast.report().looked_at as usize] += 1;
                    broke += usize::from(matches!(slow, Outcome::Broke(_)));
                }
            }
        }
    }
    println!("{broke} broke; {LEVELS:?}: {looked:?}");
    assert!(broke > 5 && enough(looked));
}
