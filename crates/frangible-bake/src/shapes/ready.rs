//! Predefined vessels and dishes, in metres, with their axis along z, upwards.

use crate::shapes::profile::Station;

/// Tumbler, Ø 70 mm at the foot and 76 mm at the rim, 105 mm high, wall 2 mm, base 6 mm.
pub(crate) fn drinking_glass() -> Vec<Station> {
    let wall = |z: f64, thickness: f64| {
        let outer = 0.035 + 0.003 * (z - 0.008) / 0.097;
        Station::smooth([outer, z], [outer - thickness, z])
    };
    vec![
        Station::smooth([0.0, 0.0], [0.0, 0.006]),
        Station::smooth([0.018, 0.0], [0.018, 0.006]),
        // Round the heel the outer curve is longer: the pairs fan out, so that no element is skewed.
        Station::smooth([0.0275, 0.0], [0.0268, 0.006]),
        Station::smooth([0.0332, 0.0011], [0.0304, 0.0067]),
        Station::smooth([0.0349, 0.0046], [0.0322, 0.0083]),
        wall(0.0125, 0.0022),
        wall(0.030, 0.0021),
        wall(0.060, 0.0020),
        wall(0.105, 0.0017),
    ]
}

/// A bottle of 0.33 l, 230 mm high, 61 mm across, with a wall of 3 mm.
pub(crate) fn bottle() -> Vec<Station> {
    let wall = |r: f64, z: f64| Station::smooth([r, z], [r - 0.003, z]);
    vec![
        Station::smooth([0.0, 0.0], [0.0, 0.005]),
        Station::smooth([0.018, 0.0], [0.018, 0.005]),
        Station::smooth([0.0270, 0.0008], [0.0245, 0.0058]),
        Station::smooth([0.0305, 0.0050], [0.0272, 0.0085]),
        wall(0.0305, 0.030),
        wall(0.0305, 0.080),
        wall(0.0305, 0.120),
        wall(0.0270, 0.145),
        wall(0.0180, 0.170),
        wall(0.0145, 0.195),
        wall(0.0130, 0.230),
    ]
}

/// Round bowl, Ø 150 mm at the rim, 62 mm high, wall 4 mm.
pub(crate) fn bowl() -> Vec<Station> {
    // An arc of the mid-line about (0, R): flat at the axis, 74° at the rim.
    let (radius, half_wall) = (0.078, 0.002);
    (0..=8)
        .map(|i| {
            let angle = f64::from(i) / 8.0 * 74.0_f64.to_radians();
            let at = |r: f64| [r * angle.sin(), radius + half_wall - r * angle.cos()];
            Station::smooth(at(radius + half_wall), at(radius - half_wall))
        })
        .collect()
}

/// Slender vase, Ø 100 mm at the belly, 55 mm at the neck, 210 mm high, wall 4 mm.
pub(crate) fn vase() -> Vec<Station> {
    let wall = |r: f64, z: f64, slope: f64| {
        // `slope` is dr/dz of the mid-line; the wall is 4 mm thick across it.
        let scale = 0.002 / slope.hypot(1.0);
        Station::smooth(
            [r + scale, z - scale * slope],
            [r - scale, z + scale * slope],
        )
    };
    vec![
        Station::smooth([0.0, 0.0], [0.0, 0.006]),
        Station::smooth([0.018, 0.0], [0.018, 0.006]),
        Station::smooth([0.0262, 0.0002], [0.0256, 0.0062]),
        Station::smooth([0.0318, 0.0040], [0.0287, 0.0082]),
        wall(0.0348, 0.020, 0.22),
        wall(0.0430, 0.055, 0.20),
        wall(0.0480, 0.090, 0.02),
        wall(0.0415, 0.130, -0.28),
        wall(0.0295, 0.165, -0.26),
        wall(0.0265, 0.190, 0.10),
        wall(0.0320, 0.210, 0.42),
    ]
}

/// Dinner plate, Ø 240 mm, 5 mm thick, a flat well and a raised rim 22 mm high.
pub(crate) fn dinner_plate() -> Vec<Station> {
    vec![
        Station::smooth([0.0, 0.0], [0.0, 0.005]),
        Station::smooth([0.040, 0.0], [0.040, 0.005]),
        Station::smooth([0.071, 0.0], [0.070, 0.005]),
        Station::smooth([0.082, 0.0025], [0.0795, 0.0069]),
        Station::smooth([0.0915, 0.0092], [0.089, 0.0136]),
        Station::smooth([0.1005, 0.0136], [0.099, 0.0184]),
        Station::smooth([0.111, 0.0160], [0.110, 0.0208]),
        Station::smooth([0.120, 0.0174], [0.1193, 0.0220]),
    ]
}
