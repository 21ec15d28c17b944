//! Windings and shells within shells: what is inside, and what is outside.

use frangible_mesh::glam::DVec3;

use super::{ball, input_volume, joined, repaired, turned, volume};

#[test]
fn scrambled_windings_are_made_one() {
    let mut scrambled = ball(1.0, DVec3::ZERO);
    let expected = input_volume(&scrambled);
    let mut turned = 0;
    for (i, t) in scrambled.triangles.iter_mut().enumerate() {
        if i * i % 7 == 2 {
            t.swap(1, 2);
            turned += 1;
        }
    }
    let (surface, report) = repaired(&scrambled);
    assert!((volume(&surface) - expected).abs() < 1e-12);
    assert_eq!(report.flipped, turned);
}

#[test]
fn an_inside_out_ball_is_turned() {
    let ball = ball(1.0, DVec3::ONE);
    let (surface, report) = repaired(&turned(ball.clone()));
    assert_eq!(report.flipped, ball.triangles.len());
    assert!((volume(&surface) - input_volume(&ball)).abs() < 1e-12);
}

#[test]
fn a_hollow_ball_stays_hollow_even_inside_out() {
    let (outer, inner) = (ball(1.0, DVec3::ZERO), ball(0.7, DVec3::X * 0.1));
    let expected = input_volume(&outer) - input_volume(&inner);
    let hollow = joined(&[outer, turned(inner)]);
    for mesh in [hollow.clone(), turned(hollow)] {
        let (surface, report) = repaired(&mesh);
        assert!((volume(&surface) - expected).abs() < 1e-12);
        assert_eq!(
            (report.shells, report.cavities, report.nested_alike),
            (2, 1, 0)
        );
    }
}

#[test]
fn shells_wound_alike_are_solid_within_solid() {
    let (outer, inner) = (ball(1.0, DVec3::ZERO), ball(0.2, DVec3::X * 0.5));
    let expected = input_volume(&outer) + input_volume(&inner);
    let (surface, report) = repaired(&joined(&[inner, outer]));
    assert!((volume(&surface) - expected).abs() < 1e-12);
    assert_eq!((report.cavities, report.nested_alike), (0, 1));
}

#[test]
fn a_stone_in_a_cavity_faces_outwards_whatever_its_winding() {
    let shell = [ball(1.0, DVec3::ZERO), turned(ball(0.7, DVec3::ZERO))];
    let stone = ball(0.2, DVec3::Z * 0.2);
    let expected = input_volume(&shell[0]) + input_volume(&shell[1]) + input_volume(&stone);
    for stone in [stone.clone(), turned(stone)] {
        let (surface, report) = repaired(&joined(&[shell[0].clone(), stone, shell[1].clone()]));
        assert!((volume(&surface) - expected).abs() < 1e-12);
        assert_eq!(
            (report.shells, report.cavities, report.nested_alike),
            (3, 1, 0)
        );
    }
}

#[test]
fn crossing_and_separate_balls_all_face_outwards() {
    let balls = [
        ball(1.0, DVec3::ZERO),
        turned(ball(0.8, DVec3::X)),
        turned(ball(1.0, DVec3::Y * 9.0)),
    ];
    let expected: f64 = balls.iter().map(|b| input_volume(b).abs()).sum();
    let (surface, report) = repaired(&joined(&balls));
    assert!((volume(&surface) - expected).abs() < 1e-9);
    assert_eq!(
        (report.shells, report.cavities + report.nested_alike),
        (3, 0)
    );
}

#[test]
fn a_doubled_shell_counts_once_either_way() {
    let ball = ball(1.0, DVec3::ZERO);
    for copy in [ball.clone(), turned(ball.clone())] {
        let (surface, report) = repaired(&joined(&[ball.clone(), copy]));
        assert_eq!(report.duplicate, ball.triangles.len());
        assert!(report.is_watertight());
        assert!((volume(&surface) - input_volume(&ball)).abs() < 1e-12);
    }
}
