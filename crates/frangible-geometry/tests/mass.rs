//! Mass properties against closed forms.

use frangible_geometry::MassProperties;
use frangible_geometry::glam::DVec3;

/// Five tetrahedra of an axis-aligned box from `low` to `high`.
fn box_tetrahedra(low: DVec3, high: DVec3) -> Vec<[DVec3; 4]> {
    let p = |i: usize| {
        DVec3::new(
            if i & 1 == 0 { low.x } else { high.x },
            if i & 2 == 0 { low.y } else { high.y },
            if i & 4 == 0 { low.z } else { high.z },
        )
    };
    [
        [0, 1, 2, 4],
        [3, 2, 1, 7],
        [5, 1, 4, 7],
        [6, 4, 2, 7],
        [1, 2, 4, 7],
    ]
    .map(|t| t.map(p))
    .to_vec()
}

#[test]
fn a_box_has_the_textbook_mass_centre_and_inertia() {
    let (low, high) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.2, 2.5, 3.1));
    let size = high - low;
    let mass = MassProperties::of_tetrahedra(2500.0, box_tetrahedra(low, high).into_iter());
    let m = 2500.0 * size.x * size.y * size.z;
    assert!((mass.mass / m - 1.0).abs() < 1e-12);
    assert!((mass.centre - (low + high) / 2.0).length() < 1e-12);
    let expected = m / 12.0 * (size.y * size.y + size.z * size.z);
    assert!((mass.inertia.x_axis.x / expected - 1.0).abs() < 1e-10);
    assert!(mass.inertia.x_axis.y.abs() < 1e-10 * expected);
}

#[test]
fn effective_mass_at_the_centre_is_the_mass_and_less_at_a_corner() {
    let mass = MassProperties::of_tetrahedra(
        1000.0,
        box_tetrahedra(DVec3::splat(-0.5), DVec3::splat(0.5)).into_iter(),
    );
    assert!((mass.inverse_effective_mass(DVec3::Z * 0.5, DVec3::Z) * 1000.0 - 1.0).abs() < 1e-12);
    // r × n = 1/2 along y, I = m/6: 1/m + (1/4)/(m/6) = 2.5/m.
    let corner = mass.inverse_effective_mass(DVec3::new(0.5, 0.0, 0.5), DVec3::Z);
    assert!((corner * 1000.0 - 2.5).abs() < 1e-9);
}
