//! Properties of the ready shapes.

use super::grid::Grid;
use super::random::Random;
use frangible_mesh::glam::{DVec3, UVec3};
use frangible_mesh::{DistanceSolid, READY_SHAPES, Solid, ready_shape};
use rayon::prelude::*;

/// Figures stated for a shape: volume (cm³) within 5 %, holes through it, thinnest part (mm), box (mm) within 1.
struct Form {
    name: &'static str,
    volume: f64,
    holes: i64,
    thinnest: f64,
    size: [f64; 3],
}

const FORMS: [Form; 10] = [
    Form {
        name: "piggy_bank",
        volume: 314.6,
        holes: 0,
        thinnest: 6.0,
        size: [92.0, 151.0, 116.0],
    },
    Form {
        name: "rabbit",
        volume: 457.4,
        holes: 0,
        thinnest: 9.5,
        size: [84.0, 132.5, 148.5],
    },
    Form {
        name: "statuette",
        volume: 246.0,
        holes: 2,
        thinnest: 5.8,
        size: [106.0, 105.0, 250.0],
    },
    Form {
        name: "coffee_cup",
        volume: 153.4,
        holes: 1,
        thinnest: 5.0,
        size: [85.0, 116.5, 95.0],
    },
    Form {
        name: "brick_solid",
        volume: 925.3,
        holes: 3,
        thinnest: 27.9,
        size: [210.0, 100.0, 50.0],
    },
    Form {
        name: "hammer_head",
        volume: 55.0,
        holes: 1,
        thinnest: 4.9,
        size: [29.0, 124.5, 46.0],
    },
    Form {
        name: "wine_glass",
        volume: 70.3,
        holes: 0,
        thinnest: 2.0,
        size: [79.8, 79.8, 187.0],
    },
    Form {
        name: "chandelier",
        volume: 878.0,
        holes: 0,
        thinnest: 10.9,
        size: [340.0, 340.0, 230.0],
    },
    Form {
        name: "candelabrum",
        volume: 524.0,
        holes: 0,
        thinnest: 10.0,
        size: [301.5, 123.0, 330.5],
    },
    Form {
        name: "coral",
        volume: 244.0,
        holes: 0,
        thinnest: 4.7,
        size: [202.0, 193.0, 170.5],
    },
];

fn each_form(check: impl Fn(&Form, &DistanceSolid)) {
    assert_eq!(FORMS.len(), READY_SHAPES.len());
    for (form, name) in FORMS.iter().zip(READY_SHAPES) {
        assert_eq!(form.name, name);
        check(form, &ready_shape(name).expect("a listed shape"));
    }
    assert!(ready_shape("no such shape").is_none());
}

#[test]
fn distances_differ_no_more_than_their_points_are_apart() {
    each_form(|form, solid| {
        let mut random = Random(7);
        let [low, high] = solid.bounds();
        let middle = 0.5 * (low + high);
        let (low, high) = (
            middle + 1.5 * (low - middle),
            middle + 1.5 * (high - middle),
        );
        for i in 0..60_000 {
            let p = random.within(low, high);
            // Far pairs and near ones; below a tenth of a millimetre the rounding of positions would be seen.
            let q = p + random.direction()
                * (high - low).max_element()
                * 10_f64.powf(-3.0 * random.unit());
            let (a, b) = (solid.signed_distance(p), solid.signed_distance(q));
            assert!(
                (a - b).abs() <= (p - q).length() * (1.0 + 1e-9),
                "{} pair {i}: {a} at {p} and {b} at {q}",
                form.name
            );
        }
    });
}

#[test]
fn the_box_holds_the_body_and_is_as_large_as_said() {
    each_form(|form, solid| {
        let mut random = Random(8);
        let [low, high] = solid.bounds();
        for _ in 0..30_000 {
            let mut p = random.within(low, high);
            let axis = (3.0 * random.unit()) as usize;
            p[axis] = if random.unit() < 0.5 {
                low[axis]
            } else {
                high[axis]
            };
            assert!(solid.signed_distance(p) > 0.0, "{} at {p}", form.name);
        }
        assert!(low.z > -1e-5, "{} stands on the ground", form.name);
        let (seen_low, seen_high) = seen_box(solid);
        let size = 1e3 * (seen_high - seen_low);
        println!("{}: {size} mm from {seen_low} to {seen_high}", form.name);
        assert!(seen_low.z < 5e-4, "{} starts at {}", form.name, seen_low.z);
        assert!(
            (size - DVec3::from(form.size)).abs().max_element() < 1.0,
            "{}: {size}",
            form.name
        );
        let middle = 0.5 * (seen_low + seen_high).truncate();
        assert!(middle.abs().max_element() < 0.02, "{}: {middle}", form.name);
    });
}

/// Box of the cubes of half a millimetre that are inside.
fn seen_box(solid: &DistanceSolid) -> (DVec3, DVec3) {
    let [low, high] = solid.bounds();
    let edge = 5e-4;
    let cells = ((high - low) / edge).ceil().as_uvec3();
    (0..cells.z)
        .into_par_iter()
        .map(|z| {
            let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for y in 0..cells.y {
                let mut x = 0;
                while x < cells.x {
                    let p = low + edge * (UVec3::new(x, y, z).as_dvec3() + 0.5);
                    let distance = solid.signed_distance(p);
                    if distance < 0.0 {
                        least = least.min(p - 0.5 * edge);
                        most = most.max(p + 0.5 * edge);
                    }
                    x += 1 + (distance.abs() / edge) as u32 / 2;
                }
            }
            (least, most)
        })
        .reduce(
            || (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |a, b| (a.0.min(b.0), a.1.max(b.1)),
        )
}

#[test]
fn every_shape_is_one_piece_with_the_holes_drawn() {
    each_form(|form, solid| {
        let grid = Grid::of(solid, 1.25e-3);
        let volume = 1e6 * grid.volume();
        println!(
            "{}: {volume:.1} cm³, Euler number {}",
            form.name,
            grid.euler_number()
        );
        assert!(
            (volume / form.volume - 1.0).abs() < 0.05,
            "{}: {volume} cm³",
            form.name
        );
        assert_eq!(grid.parts(true).len(), 1, "{}", form.name);
        assert_eq!(grid.parts(false).len(), 1, "{}", form.name);
        assert_eq!(1 - grid.euler_number(), form.holes, "{}", form.name);
    });
}

#[test]
fn the_pigs_cavity_opens_through_its_slot_only() {
    let pig = ready_shape("piggy_bank").expect("a listed shape");
    let grid = Grid::of(&pig, 1.25e-3);
    let plugged = grid
        .plugged(|p| p.x.abs() < 4e-3 && (p.y - 0.010).abs() < 0.02 && p.z > 0.085 && p.z < 0.105);
    let mut outside = plugged.parts(false);
    outside.sort_by(f64::total_cmp);
    println!("cavity {:.1} cm³", 1e6 * outside[0]);
    assert_eq!(outside.len(), 2, "{outside:?}");
    assert!((250e-6..400e-6).contains(&outside[0]), "{outside:?}");
}

#[test]
fn no_part_is_thinner_than_said() {
    each_form(|form, solid| {
        let samples: Vec<(f64, DVec3)> = (0..64)
            .into_par_iter()
            .flat_map_iter(|seed| thicknesses(solid, seed))
            .collect();
        assert!(
            samples.len() > 2_000,
            "{}: {} samples",
            form.name,
            samples.len()
        );
        let (thinnest, at) = samples
            .iter()
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("samples");
        println!(
            "{}: {:.2} mm at {at} of {} samples",
            form.name,
            1e3 * thinnest,
            samples.len()
        );
        assert!(
            1e3 * thinnest >= form.thinnest,
            "{}: {thinnest} at {at}",
            form.name
        );
    });
}

/// Ways through the body, straight in at points of its surface.
fn thicknesses(solid: &DistanceSolid, seed: u64) -> Vec<(f64, DVec3)> {
    let mut random = Random(seed);
    let [low, high] = solid.bounds();
    let mut found = Vec::new();
    for _ in 0..4_000 {
        let p = random.within(low, high);
        if solid.signed_distance(p).abs() > 1e-3 {
            continue;
        }
        let surface = solid.closest(p);
        if solid.signed_distance(surface.position).abs() > 1e-6 {
            continue;
        }
        let mut way = 2e-4;
        loop {
            let depth = -solid.signed_distance(surface.position - way * surface.normal);
            if depth < 1e-6 || way > 1.0 {
                break;
            }
            way += depth;
        }
        found.push((way, 1e3 * surface.position));
    }
    found
}

#[test]
fn area_is_what_lines_through_the_body_count() {
    // Crofton: a line through a ball of area A meets a surface of area S inside it 2 S / A times, on average.
    let mean = |solid: &dyn Solid, centre: DVec3, radius: f64, lines: u64| {
        let crossings: u64 = (0..lines)
            .into_par_iter()
            .map(|seed| {
                let mut random = Random(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
                let along = random.direction();
                let (u, v) = along.any_orthonormal_pair();
                let (angle, out) = (
                    std::f64::consts::TAU * random.unit(),
                    radius * random.unit().sqrt(),
                );
                let start =
                    centre + out * (angle.cos() * u + angle.sin() * v) - 1.01 * radius * along;
                let (mut way, mut inside, mut count) = (0.0, false, 0);
                while way < 2.02 * radius {
                    let distance = solid.signed_distance(start + way * along);
                    count += u64::from((distance < 0.0) != inside);
                    inside = distance < 0.0;
                    way += distance.abs().max(1e-5);
                }
                count
            })
            .sum();
        crossings as f64 / lines as f64 * 2.0 * std::f64::consts::PI * radius * radius
    };
    let ball = DistanceSolid::sphere(DVec3::new(0.01, 0.0, 0.0), 0.03);
    let area = mean(&ball, DVec3::ZERO, 0.05, 40_000);
    assert!((area / 0.011_310 - 1.0).abs() < 0.03, "{area}");
    each_form(|form, solid| {
        let [low, high] = solid.bounds();
        let area = mean(
            solid,
            0.5 * (low + high),
            0.5 * (high - low).length(),
            40_000,
        );
        println!("{}: {:.0} cm²", form.name, 1e4 * area);
        // No body of that volume has less area than the ball.
        let least = (36.0 * std::f64::consts::PI * (1e-6 * form.volume).powi(2)).cbrt();
        assert!(
            area > 1.1 * least && area < 10.0 * least,
            "{}: {area} m²",
            form.name
        );
    });
}
