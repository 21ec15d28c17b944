//! The haptic loop: the same bits in every run, forces that push, pieces at a tick that is known.

use frangible::glam::Vec3;
use frangible::{Breakable, FractureConfig, Material};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_lab::bench::haptic::touch::{DELAY, Felt, Kind, Probe, Touch};
use frangible_lab::bench::subjects::steel_ball;

const RADIUS: f32 = 0.0158;

/// A plate of glass 100 × 100 × 5 mm, coarse.
fn plate() -> Breakable {
    let size = |edge| Some(MeshSize { edge, layers: 1 });
    let spec = BakeSpec {
        modes: 40,
        analysis: size(0.0125),
        fracture: size(0.006),
        ..BakeSpec::new(
            "plate",
            Shape::plate(0.1, 0.1, 0.005),
            Material::preset("glass").unwrap(),
        )
    };
    Breakable::uniform(bake(&spec).unwrap()).unwrap()
}

fn touch(kind: &Breakable) -> Touch {
    let probe = Probe {
        radius: RADIUS,
        striker: steel_ball(0.13).unwrap(),
        stiffness: 20e3,
        damping: 30.0,
    };
    Touch::new(kind.body(1), probe, &FractureConfig::default()).unwrap()
}

/// A head of 130 g that falls on the plate at this speed, m/s, for so many ticks.
fn fall(touch: &mut Touch, speed: f32, ticks: usize) -> Vec<Felt> {
    let mut position = Vec3::new(0.01, 0.007, 0.0025 + RADIUS + 0.004);
    let mut velocity = Vec3::NEG_Z * speed;
    (0..ticks)
        .map(|_| {
            let felt = touch.tick(position, velocity).unwrap();
            touch.judge().hand_over();
            velocity += felt.force * (1e-3 / 0.13);
            position += velocity * 1e-3;
            felt
        })
        .collect()
}

#[test]
fn a_light_tap_is_pushed_back_and_breaks_nothing() {
    let felt = fall(&mut touch(&plate()), 0.2, 80);
    let touched: Vec<&Felt> = felt.iter().filter(|f| f.force != Vec3::ZERO).collect();
    assert!(touched.len() > 3, "{}", touched.len());
    for felt in touched {
        assert!(felt.force.z > 0.0 && felt.force.truncate().length() < 1e-3 * felt.force.z);
        // The surface gives way from the head, by less than a tenth of a millimetre.
        assert!(felt.at_rest.z < 0.0 && felt.displacement.length() < 1e-4);
    }
    let blow = |f: &&Felt| matches!(f.kind, Kind::Blow | Kind::Asked);
    assert_eq!(felt.iter().filter(blow).count(), 1);
    assert!(felt.iter().all(|f| f.pieces.is_none()));
}

#[test]
fn a_hard_blow_breaks_and_its_pieces_are_there_at_a_known_tick() {
    let kind = plate();
    let felt = fall(&mut touch(&kind), 9.0, 120);
    let at = |wanted: Kind| felt.iter().position(|f| f.kind == wanted);
    let blow = at(Kind::Asked).expect("it lands");
    let verdict = at(Kind::Verdict).expect("pieces");
    assert_eq!(verdict, blow + DELAY as usize);
    let fracture = felt[verdict].pieces.as_ref().expect("it breaks");
    assert!(fracture.fragments.len() > 1);
    // Nothing is left to touch.
    let after = &felt[verdict + 1..];
    assert!(
        after
            .iter()
            .all(|f| f.force == Vec3::ZERO && f.kind == Kind::Free)
    );
}

#[test]
fn two_runs_feel_the_same_bits() {
    let kind = plate();
    let bits = |felt: &Felt| {
        let numbers = [felt.force, felt.displacement, felt.at_rest];
        (felt.kind, numbers.map(|v| v.to_array().map(f32::to_bits)))
    };
    let run = || {
        let felt = fall(&mut touch(&kind), 9.0, 120);
        let pieces: Vec<_> = felt
            .iter()
            .filter_map(|f| f.pieces.as_ref())
            .flat_map(|fracture| &fracture.fragments)
            .map(|fragment| fragment.mesh.positions.clone())
            .collect();
        (felt.iter().map(bits).collect::<Vec<_>>(), pieces)
    };
    let (first, second) = (run(), run());
    assert!(!first.1.is_empty());
    assert_eq!(first, second);
}
