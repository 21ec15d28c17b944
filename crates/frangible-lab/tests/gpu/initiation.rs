//! Stresses and crack initiation on the GPU against the CPU's.

use super::common::{Numbers, gpu, kinds, uneven, weak_rim};
use frangible::internals::stress::Law;
use frangible::internals::{Stage, Vibration};
use frangible::{Body, Breakable, Contact, FractureConfig};
use frangible_lab::gpu::{
    DOUBT, Exceedance, GpuError, Impact, Initiation, LIST, Verdict, initiation_on_cpu,
};

/// Analyses every time step: peaks are peaks, not bounds.
fn without_culling(mut config: FractureConfig) -> FractureConfig {
    config.culling = false;
    config
}

/// Every law of stress, and strain with and without its quadratic terms.
fn configs() -> [FractureConfig; 2] {
    [
        FractureConfig::with_given_impulses(),
        FractureConfig::as_in_the_paper(),
    ]
    .map(without_culling)
}

/// Counts of the comparison.
#[derive(Debug, Default)]
struct Tally {
    impacts: usize,
    with_cracks: usize,
    overflowed: usize,
    exceeding: usize,
    /// Tetrahedra, or first cracks, that differ: each within 1e-3 of its strength.
    marginal: usize,
    /// Largest difference of a peak stress, over the strength.
    peak: f64,
    /// Largest bound over the smallest strength of impacts without cracks.
    bound: f64,
    /// Weak points whose peaks were compared: inside, on free surfaces and at edges.
    laws: [usize; 3],
    /// Weak points under a contact, which would be on the surface.
    pressed: usize,
}

/// Both on bodies of a kind; speeds that bring stresses about the strength.
fn compare(
    kind: &Breakable,
    config: &FractureConfig,
    numbers: &mut Numbers,
    impacts: usize,
    tally: &mut Tally,
) {
    let Some(gpu) = gpu() else { return };
    let loaded = gpu.load(kind).unwrap();
    let bodies: Vec<Body> = (0..impacts as u64).map(|seed| kind.body(seed)).collect();
    let contacts: Vec<Vec<Contact>> = (0..impacts)
        .map(|k| {
            let speed = 0.2 + 8.0 * numbers.next().powi(2);
            let blow = |_| numbers.blow(kind.asset(), speed);
            (0..1 + k % 2).map(blow).collect()
        })
        .collect();
    let batch: Vec<Impact<'_>> = (bodies.iter().zip(&contacts))
        .map(|(body, contacts)| Impact::new(&loaded, body, contacts))
        .collect();
    let found = gpu.initiation(&batch, config).unwrap();
    for ((body, contacts), found) in bodies.iter().zip(&contacts).zip(found) {
        let Stage::Vibrates(vibration) = Vibration::begin(body, contacts, config).unwrap() else {
            panic!("without culling every impact vibrates");
        };
        let (found, expected) = (
            found.unwrap(),
            initiation_on_cpu(body, &vibration, config, 0),
        );
        agree(body, &found, &expected, tally);
        let law = |tet, pressed: &[u32]| body.weak_place(tet, config, pressed).1;
        for e in &expected.exceeding {
            tally.laws[match law(e.tet, &vibration.pressed) {
                Law::Solid => 0,
                Law::Free(_) => 1,
                Law::Edge(_) => 2,
            }] += 1;
        }
        let weak = body.weak_tets().iter();
        let moved = |&&tet: &&u32| law(tet, &vibration.pressed) != law(tet, &[]);
        tally.pressed += weak.filter(moved).count();
    }
}

fn agree(body: &Body, found: &Initiation, expected: &Initiation, tally: &mut Tally) {
    let strength = body.weakest() as f32;
    let difference = (found.peak_stress - expected.peak_stress).abs() / strength;
    // Far above the strength, where no decision hangs on it, the difference is relative.
    let scale = (expected.peak_stress / strength).max(1.0);
    tally.peak = tally.peak.max(f64::from(difference / scale));
    if found.doubt.is_none() {
        tally.bound = tally.bound.max(f64::from(found.bound) / body.weakest());
    }
    assert!(
        difference <= DOUBT * scale,
        "{} and {} Pa",
        found.peak_stress,
        expected.peak_stress
    );
    let share = expected.peak_share;
    assert!((found.peak_share - share).abs() <= DOUBT * share.max(1.0));
    assert!((found.margin / expected.margin - 1.0).abs() < f64::from(DOUBT));
    let near = |e: &Exceedance, stress: f32| {
        let of_tet = body.strength(e.tet);
        (stress / of_tet - 1.0).abs() < DOUBT
    };
    // Which tetrahedra: those of both lists as far as neither is cut.
    let known = |list: &[Exceedance], tet| list.iter().any(|e| e.tet == tet);
    if !found.overflowed() && !expected.overflowed() {
        for (ours, theirs) in [
            (&found.exceeding, &expected.exceeding),
            (&expected.exceeding, &found.exceeding),
        ] {
            for e in ours.iter().filter(|e| !known(theirs, e.tet)) {
                assert!(near(e, e.peak), "{e:?} is only in one list");
                tally.marginal += 1;
            }
        }
    }
    // As far as the lists are the same, what the law of each place makes of its motion.
    let both = found.exceeding.iter().zip(&expected.exceeding);
    for (a, b) in both.take_while(|(a, b)| a.tet == b.tet) {
        assert!((a.peak / b.peak - 1.0).abs() <= DOUBT, "{a:?} {b:?}");
    }
    assert_eq!(found.overflowed(), found.exceeding_count > LIST);
    assert!(found.exceeding.is_sorted_by_key(|e| e.tet));
    for e in &found.exceeding {
        assert!(e.stress > body.strength(e.tet) && e.peak >= e.stress);
    }
    // The first crack: the same step and tetrahedron, or one that is marginal.
    match (&found.first, &expected.first) {
        (None, None) => (),
        (Some(a), Some(b)) if (a.step, a.tet) == (b.step, b.tet) => (),
        (Some(a), Some(b)) => {
            let alike = a.step == b.step && (a.stress / b.stress - 1.0).abs() < DOUBT;
            assert!(
                alike || near(a, a.stress) || near(b, b.stress),
                "{a:?} {b:?}"
            );
            tally.marginal += 1;
        }
        (Some(e), None) | (None, Some(e)) => {
            assert!(near(e, e.peak), "{e:?} on one side only");
            tally.marginal += 1;
        }
    }
    // The step handed to the CPU is never later than its first crack.
    if let Some(first) = expected.first {
        assert!(found.doubt.is_some_and(|step| step <= first.step));
    }
    tally.impacts += 1;
    tally.with_cracks += usize::from(expected.first.is_some());
    tally.overflowed += usize::from(expected.overflowed());
    tally.exceeding += expected.exceeding_count;
}

#[test]
fn peaks_and_first_cracks_are_the_cpus() {
    if gpu().is_none() {
        return;
    }
    let mut numbers = Numbers(3);
    let mut all = Tally::default();
    for (name, kind) in kinds() {
        let mut tally = Tally::default();
        for config in configs() {
            compare(kind, &config, &mut numbers, 5, &mut tally);
            compare(&uneven(kind), &config, &mut numbers, 3, &mut tally);
        }
        compare(&weak_rim(kind), &configs()[0], &mut numbers, 4, &mut tally);
        println!("{name}: {tally:?}");
        for (all, law) in all.laws.iter_mut().zip(tally.laws) {
            *all += law;
        }
        all.pressed += tally.pressed;
        all.bound = all.bound.max(tally.bound);
        all.impacts += tally.impacts;
        all.with_cracks += tally.with_cracks;
        all.overflowed += tally.overflowed;
        all.peak = all.peak.max(tally.peak);
    }
    println!("all: {all:?}");
    let clear = all.impacts - all.with_cracks;
    assert!(
        all.with_cracks >= 10 && clear >= 10 && all.overflowed >= 1,
        "{all:?}"
    );
    assert!(all.laws.iter().all(|&n| n > 0), "{all:?}");
}

/// The flaw under a contact does not count; for another impact on the same body, in the same batch, it does.
#[test]
fn under_a_contact_stress_is_taken_inside() {
    let Some(gpu) = gpu() else { return };
    let config = &configs()[0];
    let mut moved = 0;
    for (name, kind) in kinds() {
        let (loaded, asset, body) = (gpu.load(kind).unwrap(), kind.asset(), kind.body(1));
        let mut numbers = Numbers(6);
        let away = numbers.blow(asset, 20.0);
        // The first, which a list of those that pass the strength does not cut.
        let tets = &body.weak_tets()[..10];
        let triangles = (0..).zip(&asset.surface().tets);
        let contacts: Vec<Vec<Contact>> = triangles
            .filter(|&(t, tet)| {
                let law = |pressed| body.weak_place(*tet, config, pressed).1;
                tets.contains(tet) && law(&[t]) != law(&[])
            })
            .map(|(t, _)| {
                let corners = asset.surface().triangles[t as usize];
                let corners = corners.map(|v| asset.fracture().positions[v as usize]);
                let point = (corners[0] + corners[1] + corners[2]) / 3.0;
                let there = Contact {
                    point,
                    ..away.clone()
                };
                vec![away.clone(), there]
            })
            .take(3)
            .chain([vec![away.clone()]])
            .collect();
        let batch: Vec<Impact<'_>> = contacts
            .iter()
            .map(|contacts| Impact::new(&loaded, &body, contacts))
            .collect();
        let found = gpu.initiation(&batch, config).unwrap();
        for (contacts, found) in contacts.iter().zip(found) {
            let stage = Vibration::begin(&body, contacts, config).unwrap();
            let Stage::Vibrates(mut vibration) = stage else {
                panic!("without culling every impact vibrates");
            };
            let expected = initiation_on_cpu(&body, &vibration, config, 0);
            agree(&body, &found.unwrap(), &expected, &mut Tally::default());
            vibration.pressed.clear();
            let unpressed = initiation_on_cpu(&body, &vibration, config, 0);
            moved += usize::from(unpressed.exceeding != expected.exceeding);
        }
        println!("{name}: {} impacts, {moved} lists changed", contacts.len());
    }
    assert!(moved >= 1);
}

#[test]
fn a_batch_is_its_impacts_one_by_one() {
    let Some(gpu) = gpu() else { return };
    let mut numbers = Numbers(5);
    let config = FractureConfig::with_given_impulses();
    let loaded: Vec<_> = kinds().iter().map(|k| gpu.load(&k.1).unwrap()).collect();
    let bodies: Vec<Body> = (0..18)
        .map(|i| kinds()[i % 3].1.body(i as u64 / 6))
        .collect();
    let contacts: Vec<[Contact; 1]> = (0..18)
        .map(|i| [numbers.blow(kinds()[i % 3].1.asset(), 3.0)])
        .collect();
    let batch: Vec<Impact<'_>> = (0..18)
        .map(|i| Impact::new(&loaded[i % 3], &bodies[i], &contacts[i]))
        .collect();
    let together = gpu.initiation(&batch, &config).unwrap();
    assert!(together.iter().flatten().any(|i| i.first.is_some()));
    assert_eq!(
        together,
        gpu.initiation(&batch, &config).unwrap(),
        "a second run"
    );
    for (impact, found) in batch.iter().zip(together) {
        let alone = gpu.initiation(&[*impact], &config).unwrap();
        assert_eq!(alone, [found]);
    }
}

#[test]
fn every_pass_has_a_time_and_timing_changes_nothing() {
    let Some(gpu) = gpu() else { return };
    let (_, kind) = &kinds()[1];
    let (loaded, body) = (gpu.load(kind).unwrap(), kind.body(0));
    let contacts = [Numbers(5).blow(kind.asset(), 3.0)];
    let batch = [Impact::new(&loaded, &body, &contacts)];
    let config = without_culling(FractureConfig::with_given_impulses());
    let before = gpu.initiation(&batch, &config).unwrap();
    let times = gpu.pass_times(&batch, &config).unwrap();
    assert_eq!(before, gpu.initiation(&batch, &config).unwrap());
    if times.is_empty() {
        println!("SKIPPED: the adapter has no clock");
        return;
    }
    let mut passes: Vec<&str> = times.iter().map(|t| t.pass).collect();
    passes.sort_unstable();
    let all = [
        "amplitudes",
        "bounds",
        "clusters",
        "displacements",
        "gather",
        "stress",
        "summaries",
    ];
    assert_eq!(passes, all);
    let together: f64 = times.iter().map(|t| t.seconds).sum();
    assert!(together > 0.0 && together < 100.0, "{together} s");
}

#[test]
fn near_the_strength_the_cpu_decides() {
    let Some(gpu) = gpu() else { return };
    let mut numbers = Numbers(8);
    let mut decided_by_cpu = 0;
    for (name, kind) in kinds() {
        let loaded = gpu.load(kind).unwrap();
        let body = kind.body(1);
        // With a duration that does not depend on the impulse, stress grows with it, steadily.
        let mut config = FractureConfig::with_given_impulses();
        config.admissible_duration = false;
        let blow = numbers.blow(kind.asset(), 2.0);
        let scaled = |factor: f64| Contact {
            impulse: (f64::from(blow.impulse) * factor) as f32,
            ..blow.clone()
        };
        let share = |factor| {
            let contacts = [scaled(factor)];
            let mut config = config.clone();
            config.culling = false;
            let stage = Vibration::begin(&body, &contacts, &config).unwrap();
            let Stage::Vibrates(vibration) = stage else {
                panic!("without culling every impact vibrates");
            };
            initiation_on_cpu(&body, &vibration, &config, 0).peak_share
        };
        // Nearly linear: a few steps find the impulse that just reaches the strength, to the rounding of a tension that
        // is the same in all directions of a plane.
        let mut at_strength = 1.0;
        for _ in 0..6 {
            at_strength /= f64::from(share(at_strength));
        }
        let reached = share(at_strength);
        assert!((reached - 1.0).abs() < 1e-4, "{name}: {reached}");
        for offset in [-2e-2, -5e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 5e-4, 2e-2] {
            let contacts = [scaled(at_strength * (1.0 + offset))];
            let batch = [Impact::new(&loaded, &body, &contacts)];
            let verdict = gpu.verdicts(&batch, &config).unwrap().remove(0);
            let held = matches!(verdict, Verdict::Held(..));
            assert_eq!(held, offset < -1e-2, "{name} {offset}");
            decided_by_cpu += usize::from(!held);
        }
    }
    assert_eq!(decided_by_cpu, 3 * 8);
}

#[test]
fn what_cannot_be_computed_is_refused_by_its_number() {
    let Some(gpu) = gpu() else { return };
    let [(_, glass), (_, pane), _] = kinds();
    let loaded = gpu.load(glass).unwrap();
    let config = FractureConfig::with_given_impulses();
    let (own, other) = (glass.body(1), pane.body(1));
    let good = [Numbers(1).blow(glass.asset(), 1.0)];
    let bad = [Contact {
        impulse: f32::NAN,
        ..good[0].clone()
    }];
    let first = Impact::new(&loaded, &own, &good);
    let wrong = [first, Impact::new(&loaded, &other, &good)];
    let error = gpu.impacts(&wrong, &config).unwrap_err();
    assert_eq!(error, GpuError::WrongBody(1));
    assert!(error.to_string().contains("impact 1"));
    let error = gpu.impacts(&[first, Impact::new(&loaded, &own, &bad)], &config);
    assert!(matches!(error, Err(GpuError::Input { impact: 1, .. })));
    assert!(gpu.impacts(&[], &config).unwrap().is_empty());
    // So strong that the rounding of its amplitudes may pass what is left to the CPU: all time steps are the CPU's.
    let strong = [Numbers(1).blow(glass.asset(), 100.0)];
    let verdicts = gpu.verdicts(&[Impact::new(&loaded, &own, &strong)], &config);
    let verdict = verdicts.unwrap().remove(0);
    let Verdict::Open {
        first_step: 0,
        initiation: Some(initiation),
        ..
    } = verdict
    else {
        panic!("{verdict:?}");
    };
    assert!(f64::from(initiation.bound) > 50.0 * own.weakest() && initiation.doubt > Some(0));
    // So strong that its cube would leave the numbers of the GPU: the CPU's.
    let absurd = [Contact {
        impulse: 1e9,
        ..good[0].clone()
    }];
    let verdicts = gpu.verdicts(&[Impact::new(&loaded, &own, &absurd)], &config);
    assert!(matches!(
        verdicts.unwrap()[0],
        Verdict::Open {
            first_step: 0,
            initiation: None,
            ..
        }
    ));
}
