//! Pieces that have parted during a blow: their vibration, their inertia under a contact, and the balance of energy and momentum.

use std::f64::consts::TAU;
use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::blow::Blow;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

use crate::common::assert_near;

/// Length and side of the bar, m.
const BAR: [f64; 2] = [0.3, 0.02];

/// Glass without damping.
fn undamped() -> Material {
    let mut material = Material::preset("glass").unwrap();
    (material.stiffness_damping, material.mass_damping) = (0.0, 0.0);
    material
}

fn bar(length: f64, modes: usize, supports: Vec<Support>) -> Asset {
    let shape = Shape::block([length, BAR[1], BAR[1]]);
    let spec = BakeSpec {
        modes,
        analysis: Some(shape.size_for(3000.0 * length / BAR[0]).unwrap()),
        fracture: Some(shape.size_for(20_000.0 * length / BAR[0]).unwrap()),
        supports,
        ..BakeSpec::new("bar", shape, undamped())
    };
    let mut asset = bake(&spec).unwrap();
    asset.parts_mut().modes.residual_modes = 0;
    asset
}

fn body(asset: Asset) -> Body {
    Breakable::uniform(Arc::new(asset)).unwrap().body(1)
}

/// Pieces by the number that `of` gives each place, the largest first.
fn pieces(body: &Body, of: impl Fn(Vec3) -> usize) -> (Vec<u32>, usize) {
    let positions = &body.asset().fracture().positions;
    let numbers: Vec<usize> = positions.iter().map(|&p| of(p)).collect();
    let count = numbers.iter().max().unwrap() + 1;
    let size = |piece: usize| numbers.iter().filter(|&&n| n == piece).count();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&piece| std::cmp::Reverse(size(piece)));
    let place = |n: &usize| order.iter().position(|piece| piece == n).unwrap() as u32;
    (numbers.iter().map(place).collect(), count)
}

/// A blow by a small steel ball.
fn blow(body: &Body, point: Vec3, normal: Vec3, speed: f32) -> Blow {
    let ball = Striker::ball(&Material::preset("steel").unwrap(), 0.02, 0.004);
    let contact = Contact::strike(point, normal, speed, ball);
    Blow::new(body, &[contact], &FractureConfig::default())
        .unwrap()
        .unwrap()
}

/// The step after which no contact pushes.
fn last_push(blow: &Blow) -> usize {
    blow.reports()[0].force.len()
}

/// The frequency near one at which the amplitudes after a step have most of their power, Hz.
fn loudest(blow: &Blow, modes: usize, from: usize, near: f64) -> f64 {
    let motion = blow.motion();
    let times: Vec<f64> = (from..motion.steps())
        .map(|s| motion.begin(s + 1, blow.time_step()))
        .collect();
    let (first, last) = (times[0], times[times.len() - 1]);
    let power = |frequency: f64| {
        let of_mode = |mode: usize| {
            let (mut re, mut im, mut before) = (0.0, 0.0, first);
            for (k, &t) in times.iter().enumerate() {
                let window = (std::f64::consts::PI * (t - first) / (last - first))
                    .sin()
                    .powi(2);
                let q = f64::from(motion.at(from + k)[mode]) * window * (t - before);
                let (sin, cos) = (TAU * frequency * t).sin_cos();
                (re, im, before) = (re + q * cos, im + q * sin, t);
            }
            re * re + im * im
        };
        (0..modes).map(of_mode).sum::<f64>()
    };
    let tried = (-150..=150).map(|k| near * (1.0 + 0.001 * f64::from(k)));
    tried
        .max_by(|a, b| power(*a).total_cmp(&power(*b)))
        .unwrap()
}

/// Struck on its end, the bar sends a wave of pressure that comes back from the far end as one of tension, and parts.
#[test]
fn a_bar_that_parts_rings_as_its_halves_do() {
    let body = body(bar(BAR[0], 120, Vec::new()));
    let struck = blow(&body, Vec3::new(0.15, 0.0, 0.0), Vec3::NEG_X, 2.0);
    let (labels, count) = pieces(&body, |p| usize::from(p.x < 0.0));
    // The piece that moves on its own is the one with fewer nodes.
    let side = |label: u32| {
        let nodes = labels.iter().zip(&body.asset().fracture().positions);
        nodes
            .filter(|&(&l, _)| l == label)
            .map(|(_, p)| f64::from(p.x))
            .sum::<f64>()
    };
    let away = side(1).signum();
    let last = last_push(&struck);
    let parted = (last..last + 200).find_map(|step| {
        let mut blow = struck.clone();
        blow.part(&body, &labels, count, step);
        (blow.drifts()[0][0].x * away > 0.02).then_some((blow, step))
    });
    let (blow, step) = parted.expect("a time at which the halves part");
    // Half a wave in each half.
    let material = body.asset().material();
    let expected = (material.youngs_modulus / f64::from(material.density as f32)).sqrt() / BAR[0];
    let found = loudest(&blow, 120, step, expected);
    println!("half a wave in a half: {expected:.0} Hz, in the parted bar {found:.0} Hz");
    assert_near(found, expected, 0.03, "half a wave");
}

#[test]
fn energy_never_grows_when_pieces_part_and_none_is_made_by_contacts() {
    let body = body(bar(BAR[0], 60, Vec::new()));
    let mut blow = blow(&body, Vec3::new(0.02, 0.01, 0.004), Vec3::NEG_Y, 5.0);
    let during = last_push(&blow) / 3;
    let quarter = |p: Vec3| (4.0 * (f64::from(p.x) / BAR[0] + 0.5)).clamp(0.0, 3.0) as usize;
    let cuts: [(usize, &dyn Fn(Vec3) -> usize); 3] = [
        (during, &|p| usize::from(p.x < 0.0)),
        (2 * during, &quarter),
        (4 * during, &|p| {
            quarter(p) + 4 * usize::from(p.x > 0.1 && p.z > 0.0)
        }),
    ];
    for (step, of) in cuts {
        let (labels, count) = pieces(&body, of);
        blow.part(&body, &labels, count, step);
    }
    assert_eq!(blow.drifts().len(), 4);
    let [gained, lost] = blow.energies();
    let crushing: f64 = blow.reports().iter().map(|r| r.crushing_energy).sum();
    println!("{gained:.6} J of {lost:.6} J, {crushing:.6} J crushed");
    assert!(gained + crushing < 1.001 * lost && gained > 0.9 * lost);
    let energies = blow.energies_over_time();
    let free = &energies[last_push(&blow)..];
    for pair in free.windows(2) {
        assert!(pair[1][0] <= pair[0][0] * (1.0 + 1e-9), "{pair:?}");
        assert!(pair[1][1] <= pair[1][0] && pair[1][1] >= 0.0);
    }
}

/// A slice at the end of the bar, a twentieth of it, is hit along its cut: it takes the impulse of a body of its own mass, and leaves with it.
#[test]
fn a_small_piece_that_is_hit_weighs_what_it_weighs() {
    let body = body(bar(BAR[0], 60, Vec::new()));
    let cut = 0.45 * BAR[0] as f32;
    let point = Vec3::new(0.475 * BAR[0] as f32, 0.01, 0.0);
    let mut whole = blow(&body, point, Vec3::NEG_Y, 2.0);
    let before = whole.reports()[0].impulse;
    let (labels, count) = pieces(&body, |p| usize::from(p.x > cut));
    whole.part(&body, &labels, count, 1);
    let asset = body.asset();
    let mesh = asset.fracture();
    let own = (0..mesh.tets.len()).map(|e| {
        let own = mesh.tets[e]
            .iter()
            .filter(|&&v| labels[v as usize] == 1)
            .count();
        0.25 * own as f64 * mesh.volume(e) * f64::from(asset.material().density as f32)
    });
    let (piece, ball) = (own.sum::<f64>(), 0.02);
    let report = &whole.reports()[0];
    // Two compact bodies swap their speeds but for what crushing takes.
    let reduced = piece * ball / (piece + ball);
    let most = 2.0 * 2.0 * reduced;
    println!(
        "impulse {:.5} N s, of the whole bar {before:.5} N s, at most {most:.5} N s",
        report.impulse
    );
    assert!(report.impulse < 1.1 * most && report.impulse > 0.8 * most);
    assert!(before > 1.2 * report.impulse);
    // Its momentum against the whole: the momentum that it was given less its share of that of the whole.
    let mass = &asset.mass();
    let at = point.as_dvec3();
    let spin = mass.inertia.inverse() * at.cross(DVec3::NEG_Y * report.impulse);
    let rigid = DVec3::NEG_Y * report.impulse / mass.mass + spin.cross(DVec3::new(at.x, 0.0, 0.0));
    let speed = whole.drifts()[0][0] + rigid;
    println!("it leaves with {speed:.3} m/s");
    assert_near(-speed.y, report.impulse / piece, 0.05, "speed of the piece");
}

/// A heavy ball throws off the last twentieth of the bar, comes on, and meets the rest: no energy is made where it does.
#[test]
fn what_is_beside_a_piece_that_has_flown_off_is_met_next() {
    let body = body(bar(BAR[0], 60, Vec::new()));
    let cut = 0.45 * BAR[0] as f32;
    let point = Vec3::new(0.475 * BAR[0] as f32, 0.01, 0.0);
    let (labels, count) = pieces(&body, |p| usize::from(p.x > cut));
    let of_ball = |radius: f64| {
        let ball = Striker::ball(&Material::preset("steel").unwrap(), 0.2, radius);
        let contact = Contact::strike(point, Vec3::NEG_Y, 2.0, ball);
        let blow = Blow::new(&body, &[contact], &FractureConfig::default());
        let mut blow = blow.unwrap().unwrap();
        blow.part(&body, &labels, count, 1);
        let [gained, lost] = blow.energies();
        let report = &blow.reports()[0];
        println!(
            "ball of {radius} m: {:.5} N s, leaves at {:.3} m/s; {gained:.5} J of {lost:.5} J, {:.5} J crushed",
            report.impulse, report.departure_speed, report.crushing_energy
        );
        assert!(gained + report.crushing_energy <= 1.001 * lost);
        (report.impulse, report.departure_speed)
    };
    let piece = 0.05 * body.asset().mass().mass;
    let most = 2.0 * 2.0 * piece * 0.2 / (piece + 0.2);
    let ((wide, leaves), (narrow, flies_on)) = (of_ball(0.05), of_ball(0.004));
    assert!(wide > 1.5 * most && leaves > flies_on, "{wide} of {most}");
    // A ball that sinks into the hole flies on.
    assert!(narrow < 1.1 * most && flies_on < -1.0, "{narrow} of {most}");
}

#[test]
fn halves_that_are_struck_apart_fly_symmetrically() {
    let body = body(bar(BAR[0], 60, Vec::new()));
    let mut blow = blow(&body, Vec3::new(0.0, 0.01, 0.0), Vec3::NEG_Y, 5.0);
    let step = last_push(&blow);
    let (labels, count) = pieces(&body, |p| usize::from(p.x < 0.0));
    blow.part(&body, &labels, count, step);
    let impulse = blow.reports()[0].impulse;
    let [linear, angular] = blow.drifts()[0];
    let fair = impulse / body.asset().mass().mass;
    println!("drift {linear:.4} m/s, {angular:.2} rad/s, the whole {fair:.4} m/s");
    // Neither half is faster than the other, and both turn, as a bar that is bent about its middle does when it parts there.
    assert!(linear.y.abs() < 0.02 * fair && linear.z.abs() < 0.02 * fair);
    assert!(angular.z.abs() * 0.25 * BAR[0] > 0.2 * fair);
    assert!(angular.x.abs() + angular.y.abs() < 0.25 * angular.z.abs());
}

#[test]
fn held_bodies_and_odd_pieces_keep_their_energy_finite() {
    let held = vec![Support::clamped(Region::below(0, 0.01))];
    let cantilever = body(bar(BAR[0], 30, held));
    let few = body(bar(BAR[0], 3, Vec::new()));
    let one_tet = few.asset().fracture().tets[700];
    let positions = few.asset().fracture().positions.clone();
    let single = move |p: Vec3| usize::from(one_tet.iter().any(|&v| positions[v as usize] == p));
    let scattered = |p: Vec3| ((p.x * 977.0 + p.y * 4409.0 + p.z * 2711.0).abs() as usize) % 40;
    // Name, body, piece of each place, and how many pieces move on their own.
    type Case<'a> = (&'a str, &'a Body, &'a dyn Fn(Vec3) -> usize, usize);
    let cases: [Case<'_>; 5] = [
        (
            "a cantilever in its middle",
            &cantilever,
            &|p| usize::from(p.x > 0.0),
            1,
        ),
        (
            "all of it held",
            &cantilever,
            &|p| usize::from(p.x < -0.139),
            1,
        ),
        (
            "more unknowns than modes",
            &few,
            &|p| (p.x * 40.0 + 6.0) as usize,
            12,
        ),
        ("one tetrahedron", &few, &single, 0),
        ("nodes at random", &few, &scattered, 12),
    ];
    for (name, body, of, acting) in cases {
        let mut blow = blow(body, Vec3::new(0.1, 0.01, 0.0), Vec3::NEG_Y, 5.0);
        let (labels, count) = pieces(body, of);
        blow.part(body, &labels, count, 2);
        assert_eq!(blow.drifts().len(), acting, "{name}");
        let [gained, lost] = blow.energies();
        println!("{name}: {gained:.5} J of {lost:.5} J");
        assert!(gained <= 1.001 * lost, "{name}");
        let energies = blow.energies_over_time();
        let free = &energies[last_push(&blow)..];
        assert!(free.iter().flatten().all(|e| e.is_finite()), "{name}");
        for pair in free.windows(2) {
            assert!(pair[1][0] <= pair[0][0] * (1.0 + 1e-9), "{name}: {pair:?}");
        }
    }
}
