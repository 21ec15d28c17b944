//! Bodies that have a box as their collider.

use frangible_geometry::box_of;
use frangible_geometry::glam::Vec3;

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
