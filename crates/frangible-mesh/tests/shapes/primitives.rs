//! Primitives and operators against closed forms and brute force.

use super::random::Random;
use frangible_mesh::distance::operators::{smooth_max, smooth_min};
use frangible_mesh::distance::primitives::{
    cylinder, ellipsoid, half_space, prism, revolved, round_cone, rounded_box, torus,
};
use frangible_mesh::glam::{DQuat, DVec2, DVec3};
use frangible_mesh::{DistanceSolid, Solid};
use std::f64::consts::{PI, TAU};

fn points(seed: u64, reach: f64, check: impl Fn(DVec3)) {
    let mut random = Random(seed);
    for _ in 0..400 {
        check(random.within(DVec3::splat(-reach), DVec3::splat(reach)));
    }
    // Planes and axes of symmetry, where closest points are not unique.
    for p in [
        DVec3::ZERO,
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(0.0, 1.0, 1.0),
    ] {
        check(0.3 * reach * p);
        check(-reach * p);
    }
}

/// Least of a function on [0, 1]: a fine scan, then narrower and narrower ones around the best.
fn least(of: impl Fn(f64) -> f64) -> f64 {
    let (mut middle, mut width, mut best) = (0.5, 0.5, f64::INFINITY);
    for _ in 0..9 {
        let mut at = middle;
        for i in -100..=100 {
            let t = (middle + width * f64::from(i) / 100.0).clamp(0.0, 1.0);
            if of(t) < best {
                (best, at) = (of(t), t);
            }
        }
        (middle, width) = (at, 0.05 * width);
    }
    best
}

#[test]
fn an_ellipsoids_distance_is_that_to_its_closest_point() {
    for radii in [
        DVec3::new(1.0, 2.0, 3.0),
        DVec3::new(2.0, 0.3, 2.0),
        DVec3::new(1.5, 1.5, 1.5),
    ] {
        points(1, 4.0, |p| {
            let d = ellipsoid(p, radii);
            assert_eq!(d < 0.0, (p / radii).length() < 1.0, "{p}");
            // A scan over both angles, then narrower ones around the best.
            let (mut at, mut width, mut least) = (DVec2::splat(0.5), 0.5, f64::INFINITY);
            for _ in 0..14 {
                let middle = at;
                for i in 0..61 * 61 {
                    let step = DVec2::new(f64::from(i % 61), f64::from(i / 61)) / 30.0 - 1.0;
                    let angles = (middle + width * step) * DVec2::new(TAU, PI);
                    let ring = DVec2::from_angle(angles.x) * angles.y.sin();
                    let distance =
                        (radii * DVec3::new(ring.x, ring.y, angles.y.cos()) - p).length();
                    if distance < least {
                        (least, at) = (distance, middle + width * step);
                    }
                }
                width *= 0.15;
            }
            assert!(
                (d.abs() - least).abs() < 1e-6,
                "{p} {radii}: {d} for {least}"
            );
        });
    }
}

#[test]
fn a_round_cone_is_all_its_balls() {
    for (b, radius_b) in [
        (DVec3::new(1.0, 0.5, 2.0), 0.4),
        (DVec3::new(0.0, 0.0, -3.0), 1.5),
        (DVec3::new(0.1, 0.0, 0.2), 0.3),
        (DVec3::ZERO, 0.8),
    ] {
        points(2, 4.0, |p| {
            let exact = least(|t| (p - t * b).length() - (1.0 + t * (radius_b - 1.0)));
            let d = round_cone(p, DVec3::ZERO, 1.0, b, radius_b);
            assert!((d - exact).abs() < 1e-7, "{p} {b}: {d} for {exact}");
        });
    }
}

#[test]
fn boxes_tori_and_half_spaces_have_their_closed_forms() {
    let half = DVec3::new(1.0, 0.5, 2.0);
    points(3, 3.0, |p| {
        let outside = (p - p.clamp(-half, half)).length();
        let inside = (half - p.abs()).min_element();
        let exact = if inside > 0.0 { -inside } else { outside };
        assert!((rounded_box(p, half, 0.0) - exact).abs() < 1e-12);
        // Rounding is growing a smaller box, outside of that.
        let grown = (p - p.clamp(-half + 0.2, half - 0.2)).length() - 0.2;
        if grown > -0.2 {
            assert!((rounded_box(p, half, 0.2) - grown).abs() < 1e-12);
        }
        let ring = least(|t| (p - 2.0 * DVec3::from((DVec2::from_angle(TAU * t), 0.0))).length());
        assert!((torus(p, 2.0, 0.5) - (ring - 0.5)).abs() < 1e-6);
        assert!((half_space(p, DVec3::Y, 0.3) - (p.y - 0.3)).abs() < 1e-12);
    });
}

#[test]
fn swept_outlines_agree_with_cylinder_box_and_cone() {
    let profile = [(0.0, -1.0), (1.5, -1.0), (1.5, 1.0), (0.0, 1.0)].map(|(r, z)| DVec2::new(r, z));
    let square =
        [(-1.0, -0.5), (1.0, -0.5), (1.0, 0.5), (-1.0, 0.5)].map(|(x, y)| DVec2::new(x, y));
    let cone = DistanceSolid::cone(1.0, 0.0, 2.0);
    points(4, 3.0, |p| {
        assert!(
            (revolved(p, &profile) - cylinder(p, 1.5, 1.0, 0.0)).abs() < 1e-12,
            "{p}"
        );
        assert!(
            (prism(p, &square, 2.0) - rounded_box(p, DVec3::new(1.0, 0.5, 2.0), 0.0)).abs() < 1e-12,
            "{p}"
        );
        let q = DVec2::new(p.truncate().length(), p.z);
        let slant = least(|t| (q - DVec2::new(1.0 - t, 2.0 * t)).length());
        let base = least(|t| (q - DVec2::new(t, 0.0)).length());
        let sign = if p.z > 0.0 && q.x < 1.0 - 0.5 * p.z {
            -1.0
        } else {
            1.0
        };
        assert!(
            (cone.signed_distance(p) - sign * slant.min(base)).abs() < 1e-6,
            "{p}"
        );
    });
}

#[test]
fn moving_a_body_moves_its_distances() {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.7);
    let way = DVec3::new(0.3, -1.0, 0.5);
    let half = DVec3::new(1.0, 0.5, 0.2);
    let moved = DistanceSolid::rounded_box(half, 0.1)
        .rotated(turn)
        .translated(way)
        .scaled(2.0);
    let pair = DistanceSolid::sphere(DVec3::new(1.5, 0.0, 0.0), 1.0).mirrored_x();
    points(5, 4.0, |p| {
        let exact = 2.0 * rounded_box(turn.inverse() * (p / 2.0 - way), half, 0.1);
        assert!((moved.signed_distance(p) - exact).abs() < 1e-12);
        let both = (p - 1.5 * DVec3::X)
            .length()
            .min((p + 1.5 * DVec3::X).length())
            - 1.0;
        assert!((pair.signed_distance(p) - both).abs() < 1e-12);
        let [low, high] = moved.bounds();
        assert!(exact > 0.0 || (p.cmpge(low) & p.cmple(high)).all());
    });
}

#[test]
fn a_ring_is_its_turned_copies() {
    let (a, b) = (DVec3::new(1.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.4));
    let ring = DistanceSolid::round_cone(a, 0.2, b, 0.3).ring(7);
    points(11, 3.0, |p| {
        let copies = (0..7)
            .map(|i| {
                round_cone(
                    DQuat::from_rotation_z(TAU * f64::from(i) / 7.0) * p,
                    a,
                    0.2,
                    b,
                    0.3,
                )
            })
            .fold(f64::INFINITY, f64::min);
        assert!((ring.signed_distance(p) - copies).abs() < 1e-12, "{p}");
    });
}

#[test]
fn a_hollow_ball_is_its_wall() {
    let hollow = DistanceSolid::sphere(DVec3::ZERO, 1.0).shell(0.2);
    let cut =
        DistanceSolid::sphere(DVec3::ZERO, 1.0).subtract(DistanceSolid::sphere(DVec3::ZERO, 0.8));
    points(6, 1.5, |p| {
        let exact = (p.length() - 0.9).abs() - 0.1;
        assert!((hollow.signed_distance(p) - exact).abs() < 1e-12);
        assert!((cut.signed_distance(p) - exact).abs() < 1e-12);
    });
}

#[test]
fn boxes_around_parts_change_no_bit() {
    let mut random = Random(9);
    let line: Vec<(DVec3, f64)> = (0..40)
        .map(|_| {
            (
                random.within(DVec3::NEG_ONE, DVec3::ONE),
                0.02 + 0.1 * random.unit(),
            )
        })
        .collect();
    let tube = DistanceSolid::tube(&line).expect("a line");
    let body = DVec3::new(0.6, 0.5, 0.4);
    let all = DistanceSolid::ellipsoid(DVec3::ZERO, body)
        .smooth_union(tube, 0.2)
        .smooth_subtract(DistanceSolid::sphere(DVec3::X, 0.7), 0.1);
    let way = DVec3::new(0.5, -0.25, 0.125);
    let nested = DistanceSolid::sphere(DVec3::NEG_Y, 0.3)
        .smooth_union(all.clone().grown(0.05).translated(way), 0.3);
    points(10, 2.0, |p| {
        let tube = line
            .windows(2)
            .map(|ends| round_cone(p, ends[0].0, ends[0].1, ends[1].0, ends[1].1))
            .fold(f64::INFINITY, f64::min);
        let whole = smooth_min(ellipsoid(p, body), tube, 0.2);
        let cut = smooth_max(whole, 0.7 - (p - DVec3::X).length(), 0.1);
        assert_eq!(all.signed_distance(p), cut, "{p}");
        let ball = (p + DVec3::Y).length() - 0.3;
        let moved = all.signed_distance(p - way) - 0.05;
        assert_eq!(
            nested.signed_distance(p),
            smooth_min(moved, ball, 0.3),
            "{p}"
        );
    });
}

#[test]
fn odd_numbers_make_no_panic() {
    let odd = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300];
    for a in odd {
        for b in odd {
            let p = DVec3::new(a, b, 1.0);
            let solids = [
                DistanceSolid::ellipsoid(p, DVec3::new(b, a, 1.0)),
                DistanceSolid::round_cone(p, a, DVec3::splat(b), b),
                DistanceSolid::rounded_box(p, a)
                    .smooth_union(DistanceSolid::cylinder(a, b, 1.0), b),
                DistanceSolid::torus(a, b).shell(a).rotated(DQuat::IDENTITY),
                DistanceSolid::half_space(p, a).scaled(b).mirrored_x(),
                DistanceSolid::prism(vec![DVec2::new(a, b); 3], a).grown(b),
                DistanceSolid::revolved(Vec::new())
                    .smooth_subtract(DistanceSolid::cone(a, b, a), b),
            ];
            for solid in solids {
                let _ = (
                    solid.bounds(),
                    solid.signed_distance(p),
                    solid.signed_distance(DVec3::ONE),
                );
            }
        }
    }
    assert!(DistanceSolid::tube(&[]).is_none());
}
