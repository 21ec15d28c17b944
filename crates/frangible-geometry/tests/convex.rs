//! Which bodies have a box as their collider, and which points of a part its hull keeps.

use frangible_geometry::glam::Vec3;
use frangible_geometry::{box_of, thinned};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Corners of a box of these half sides about a point, m.
fn corners(half: Vec3, centre: Vec3) -> Vec<Vec3> {
    let side = |bit: bool| if bit { 1.0 } else { -1.0 };
    (0..8)
        .map(|i| centre + half * Vec3::new(side(i & 1 > 0), side(i & 2 > 0), side(i & 4 > 0)))
        .collect()
}

#[test]
fn only_what_fills_its_bounds_about_the_origin_is_a_box() {
    let half = Vec3::new(0.15, 0.1, 0.002);
    let volume = 8.0 * half.as_dvec3().element_product();
    let found = box_of(&corners(half, Vec3::ZERO), volume).expect("it is a box");
    assert!((found - half).length() < 1e-6);
    // Corners are rounded to single precision, a volume is not.
    assert!(box_of(&corners(half, Vec3::ZERO), (1.0 - 2e-6) * volume).is_some());

    // A hole of 3 mm radius, and a corner that lacks 3 % of each side.
    let hole = std::f64::consts::PI * 0.003 * 0.003 * 0.004;
    let cut = 0.03_f64.powi(3) / 6.0 * 8.0 * volume;
    for less in [hole, cut] {
        assert_eq!(box_of(&corners(half, Vec3::ZERO), volume - less), None);
    }
    let moved = corners(half, Vec3::new(0.01, 0.0, 0.0));
    assert_eq!(box_of(&moved, volume), None);
    assert_eq!(box_of(&[], volume), None);
    assert_eq!(box_of(&[Vec3::NAN], volume), None);
}

#[test]
fn a_hull_keeps_the_points_that_lie_farthest_in_directions_all_around() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut number = move || rng.next_u32() as f32 / u32::MAX as f32 - 0.5;
    for count in [1, 7, 30, 33, 200] {
        // Each point twice: of equals the first one is kept.
        let once: Vec<Vec3> = (0..count)
            .map(|_| Vec3::new(number(), number(), number()))
            .collect();
        let points = [once.clone(), once].concat();
        let kept = thinned(&points, 24);
        assert!(
            kept.len() <= 24.max(count) && !kept.is_empty() || count == 1,
            "{count}"
        );
        if count <= 24 {
            assert!(count == 1 || kept == points[..count], "{count}");
            continue;
        }
        // In the order of the points, none of them twice, and each of them the farthest in some direction.
        let numbers: Vec<usize> = (kept.iter())
            .map(|p| {
                points
                    .iter()
                    .position(|q| p == q)
                    .expect("one of the points")
            })
            .collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
        let middle = points.iter().sum::<Vec3>() / points.len() as f32;
        let reach =
            |points: &[Vec3], d: Vec3| points.iter().map(|p| p.dot(d)).fold(f32::MIN, f32::max);
        for _ in 0..100 {
            let direction = Vec3::new(number(), number(), number()).normalize();
            let all = reach(&points, direction) - middle.dot(direction);
            let found = reach(&kept, direction) - middle.dot(direction);
            assert!(found > 0.8 * all, "{count}: {found} of {all}");
        }
    }
}
