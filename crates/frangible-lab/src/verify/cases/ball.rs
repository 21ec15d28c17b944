//! A solid ball, baked as any solid is: filled with tetrahedra, its modes on a lattice that covers it.

use std::f64::consts::{PI, TAU};

use frangible_bake::{BakeError, Baked, bake_with};

use crate::verify::case::Findings;
use crate::verify::check::checks;
use crate::verify::models::{GLASS, ball, root};

const RADIUS: f64 = 0.05;

const LAMB: &str = "H. Lamb, Proc. London Math. Soc. 13, 189 (1882)";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let Baked { asset, report } = bake_with(&ball(RADIUS, &GLASS, None), |_| {})?;
    let shear_speed = (GLASS.lame().1 / GLASS.density).sqrt();
    let of = |root: f64| root * shear_speed / (RADIUS * TAU);
    let (twist, football) = (
        of(twisting_root()),
        of(spheroidal_root(GLASS.poisson_ratio)),
    );
    let found = &report.frequencies;
    let mass = GLASS.density * 4.0 / 3.0 * PI * RADIUS.powi(3);
    Ok(checks![
        "₀T₂, lowest of five", "Hz", found[0] => twist, 0.02, LAMB;
        "₀T₂, highest of five", "Hz", found[4] => twist, 0.02, LAMB;
        "₀S₂, lowest of five", "Hz", found[5] => football, 0.02, LAMB;
        "₀S₂, highest of five", "Hz", found[9] => football, 0.02, LAMB;
        "mass", "kg", asset.mass().mass => mass, 0.01, "4/3 π r³ ρ";
    ]
    .into())
}

/// Spherical Bessel functions j₂ and j₃.
fn bessel(x: f64) -> [f64; 2] {
    let (s, c) = x.sin_cos();
    let j1 = (s / x - c) / x;
    let j2 = 3.0 / x * j1 - s / x;
    [j2, 5.0 / x * j2 - j1]
}

/// ω r / c_s of ₀T₂: (l − 1) j_l(x) = x j_(l+1)(x) with l = 2.
fn twisting_root() -> f64 {
    let of = |x: f64| {
        let [j2, j3] = bessel(x);
        j2 - x * j3
    };
    root(of, 2.0, 3.0)
}

/// ω r / c_s of ₀S₂: no traction on the surface, for l = 2.
fn spheroidal_root(nu: f64) -> f64 {
    let ratio = ((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))).sqrt();
    let of = |y: f64| {
        let x = y * ratio;
        let ([p2, p3], [s2, s3]) = (bessel(x), bessel(y));
        let half = 0.5 * y * y;
        // Radial and tangential traction of the pressure and of the shear wave.
        let radial = [(2.0 - half) * p2 + 2.0 * x * p3, 6.0 * (s2 - y * s3)];
        let tangential = [p2 - x * p3, (3.0 - half) * s2 + y * s3];
        radial[0] * tangential[1] - radial[1] * tangential[0]
    };
    root(of, 2.0, 3.5)
}

#[cfg(test)]
mod tests {
    #[test]
    fn roots_are_those_of_the_tables() {
        assert!((super::twisting_root() - 2.501_13).abs() < 1e-5);
        // Lamb 1882: 0.840 π at ν = 1/4.
        let lamb = 0.840 * std::f64::consts::PI;
        assert!((super::spheroidal_root(0.25) / lamb - 1.0).abs() < 1e-3);
        assert!((super::spheroidal_root(0.23) - 2.637_11).abs() < 1e-5);
    }
}
