//! Two bodies that come together.

use std::sync::Arc;

use crate::common::plate;
use frangible_sound::glam::Vec3;
use frangible_sound::{SoundBody, SoundPulse, Strike, first_push};

fn strike(impulse: f64, duration: f64, push: &[f32]) -> Strike {
    Strike {
        pulse: Arc::new(SoundPulse::half_sine(impulse, duration)),
        push: push.to_vec(),
        direction: Vec3::Z,
    }
}

#[test]
fn modes_get_no_more_than_a_quarter_of_the_energy_of_the_approach() {
    let mut worst = 0.0_f64;
    for sides in [[0.08, 0.05, 0.003], [0.03, 0.02, 0.002], [0.2, 0.2, 0.004]] {
        let (plate, body) = plate(sides);
        for x in [0.0, 0.3, 0.5] {
            let point = Vec3::new((x * sides[0]) as f32, (0.5 * sides[1]) as f32, 0.0);
            let push = plate.push(point, Vec3::Z);
            let yields = body.yields(point, Vec3::Z);
            for duration in [1e-6, 1e-5, 1e-4, 1e-3] {
                let speed = 2.0;
                let bodies: [(&SoundBody, &[f32]); 1] = [(&body, &push)];
                let (impulse, _) = first_push(speed, yields, &bodies, |_| duration);
                let energy = strike(impulse, duration, &push).energy(&body);
                let approach = 0.5 * speed * speed / yields;
                worst = worst.max(energy / approach);
                assert!(impulse <= speed / yields * (1.0 + 1e-9));
            }
        }
    }
    // The rounds that find the push end within half a per cent of it.
    assert!((0.1..0.252).contains(&worst), "{worst}");
}

#[test]
fn the_impulse_of_rigid_bodies_would_give_modes_more_than_there_is() {
    let (plate, body) = plate([0.08, 0.05, 0.003]);
    let corner = Vec3::new(0.04, 0.025, 0.0);
    let push = plate.push(corner, Vec3::Z);
    let yields = body.yields(corner, Vec3::Z);
    let (speed, duration) = (2.0, 1e-5);
    let approach = 0.5 * speed * speed / yields;
    let given = strike(speed / yields, duration, &push).energy(&body);
    assert!(given > 2.0 * approach, "{given} of {approach}");
}

#[test]
fn a_push_in_the_middle_moves_the_mass_and_one_at_the_end_turns_it_too() {
    let (_, body) = plate([0.2, 0.01, 0.01]);
    let middle = body.yields(Vec3::ZERO, Vec3::Z) * body.mass;
    assert!((middle - 1.0).abs() < 1e-9, "{middle}");
    // A rod at its end: 1 + l²/4 / (l²/12) = 4; the surface of this one has more of it at the ends.
    let end = body.yields(Vec3::new(0.1, 0.0, 0.0), Vec3::Z) * body.mass;
    assert!((3.7..4.1).contains(&end), "{end}");
    let held = SoundBody {
        mass: f64::INFINITY,
        ..body
    };
    assert_eq!(held.yields(Vec3::X, Vec3::Z), 0.0);
}

#[test]
fn what_cannot_move_is_pushed_by_nothing() {
    let (impulse, duration) = first_push(1.0, 0.0, &[], |mass| if mass > 1e9 { 0.02 } else { 0.0 });
    assert_eq!((impulse, duration), (0.0, 0.02));
}
