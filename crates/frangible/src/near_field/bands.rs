//! The wave numbers of an infinite wall in bands: wall oscillators, and what follows the force.

use std::f64::consts::PI;

use super::bessel::Bessel;
use super::wall::{WallMaterial, hertz_disc};

/// Width of the highest bands that swing, over their frequency.
const WIDEST: f64 = 0.25;

/// Width of the first band over that of the even ones. What a cut through a spectrum leaves over is `sin(ωt)/t` on either side, and
/// bands of width Δ make it larger by x/sin x, x = Δt/2: only where both sides are fine does it cancel. Measured: with even bands from
/// the first on, the force on a plate in its last third is up to a third off, by where the modes end; with these 4 %.
const FIRST_WIDTH: f64 = 0.125;

/// Largest ratio of a band's width to that of the one before.
const WIDER: f64 = 1.2;

/// Ratio of the wave numbers of neighbouring bands that follow the force.
const WAVE_NUMBER_RATIO: f64 = 1.12;

/// Largest number of evenly spaced bands: a blow longer than they can tell apart hears its own echo.
const MOST_EVEN: f64 = 64.0;

/// Spacing of the bands in frequency, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spacing {
    /// Width of the bands: oscillators so far apart swing together again after 2π over it. The first are narrower.
    pub(crate) width: f64,
    /// Up to this frequency the bands are no wider than that; above it each is wider than the last.
    pub(crate) even_to: f64,
    /// Waves above this frequency follow the force.
    pub(crate) follows_from: f64,
}

/// A band of wave numbers that swings as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Band {
    /// Its edges, 1/m.
    edges: [f64; 2],
    /// ω², 1/s².
    pub(crate) eigenvalue: f64,
    /// ξ², 1/kg, for the contact: p̂² Δ(k²)/(4πμ) of a thin plate; in general such that ξ²/ω² is the compliance of the layer.
    pub(crate) give: f64,
    /// H of its middle, 1/(Pa·m): curvature per steady pressure.
    curvature: f64,
}

impl Band {
    fn new(wall: &WallMaterial, contact_radius: f64, edges: [f64; 2]) -> Self {
        let [low, high] = edges;
        // The middle by area in the plane of wave vectors.
        let k = (0.5 * (low * low + high * high)).sqrt();
        let pressure = hertz_disc(k * contact_radius);
        Self {
            edges,
            eigenvalue: wall.eigenvalue(k),
            give: pressure * pressure * (high * high - low * low) / (4.0 * PI)
                * wall.compliance(k)
                * wall.eigenvalue(k),
            curvature: pressure * wall.curvature(k),
        }
    }
}

/// κ_r + κ_θ and κ_θ − κ_r of each band at distance r per newton of ω² q, 1/(N·m). A band begins where the one before it ends.
fn shapes(bands: &[Band], bessel: Bessel, r: f64) -> impl Iterator<Item = [f64; 2]> {
    let mut below = match bands.first() {
        Some(band) => integrals(&bessel, band.edges[0], r),
        None => [0.0; 2],
    };
    bands.iter().map(move |band| {
        let above = integrals(&bessel, band.edges[1], r);
        let scale = band.curvature / (2.0 * PI);
        let shape = [0, 1].map(|i| scale * (above[i] - below[i]));
        below = above;
        shape
    })
}

/// ∫ k J₀(kr) dk and ∫ k J₂(kr) dk from 0 to `k`, 1/m².
fn integrals(bessel: &Bessel, k: f64, r: f64) -> [f64; 2] {
    let x = k * r;
    // Series for small arguments, where both differences lose their digits.
    if x < 0.1 {
        return [
            0.5 * k * k * (1.0 - x * x / 8.0),
            // k⁴ r²/32 (1 − x²/18 …)
            k * k * x * x / 32.0 * (1.0 - x * x / 18.0),
        ];
    }
    let [j0, j1] = bessel.at(x);
    [k * j1 / r, (2.0 - x * j1 - 2.0 * j0) / (r * r)]
}

/// All bands about one contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Bands {
    /// Bands that swing: the wall oscillators.
    pub(crate) oscillators: Vec<Band>,
    /// Bands that follow the force.
    following: Vec<Band>,
}

impl Bands {
    /// Bands from wave number `first`, 1/m, on, for a contact of this radius, m.
    pub(crate) fn new(
        wall: &WallMaterial,
        first: f64,
        contact_radius: f64,
        spacing: Spacing,
    ) -> Self {
        let last = wall.last_wave_number(contact_radius);
        let mut bands = Self::default();
        // Below the frequency from which on a curved wall bends, it has no waves.
        let has_waves = first > 0.0 && first < last;
        if !has_waves {
            return bands;
        }
        let mut low = first;
        let mut frequency = wall.eigenvalue(first).sqrt();
        let width = (spacing.width)
            .max((spacing.even_to - frequency) / MOST_EVEN)
            .min(2.0 * WIDEST * frequency.max(spacing.even_to));
        let mut step = FIRST_WIDTH * width;
        while low < last && frequency < spacing.follows_from {
            let next = frequency + step;
            let widest = if next < spacing.even_to {
                width
            } else {
                WIDEST * next
            };
            step = (WIDER * step).min(widest.max(step));
            let high = wall.wave_number(next).clamp(low, last);
            bands
                .oscillators
                .push(Band::new(wall, contact_radius, [low, high]));
            (low, frequency) = (high, next);
        }
        while low < last * (1.0 - 1e-9) {
            let high = (low * WAVE_NUMBER_RATIO).min(last);
            bands
                .following
                .push(Band::new(wall, contact_radius, [low, high]));
            low = high;
        }
        bands
    }

    /// Compliance of the contact, m/N, in the waves that follow the force.
    pub(crate) fn compliance(&self) -> f64 {
        let give = |band: &Band| band.give / band.eigenvalue;
        self.following.iter().map(give).sum()
    }

    /// σ_r + σ_θ and σ_θ − σ_r at the far face, Pa per newton, of everything that follows the force, at these distances, m.
    pub(super) fn following_stress(&self, wall: &WallMaterial, radii: &[f64]) -> Vec<[f64; 2]> {
        let bessel = Bessel::new();
        let at = |&r: &f64| {
            let mut sum = [0.0; 2];
            for shape in shapes(&self.following, bessel, r) {
                sum = [sum[0] + shape[0], sum[1] + shape[1]];
            }
            stress(wall, sum)
        };
        radii.iter().map(at).collect()
    }

    /// The oscillators' shares of the same, Pa per newton of ω² q: for each distance those of all oscillators.
    pub(super) fn swinging_stress(&self, wall: &WallMaterial, radii: &[f64]) -> Vec<Vec<[f64; 2]>> {
        let bessel = Bessel::new();
        let at = |&r: &f64| {
            let shapes = shapes(&self.oscillators, bessel, r);
            shapes.map(|shape| stress(wall, shape)).collect()
        };
        radii.iter().map(at).collect()
    }
}

fn stress(wall: &WallMaterial, [sum, difference]: [f64; 2]) -> [f64; 2] {
    [
        sum * wall.stress_of_sum(),
        difference * wall.stress_of_difference(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::SurfaceWall;
    use crate::material::Material;
    use crate::near_field::PlateTheory;

    const RADIUS: f64 = 0.6e-3;

    fn wall(theory: PlateTheory) -> WallMaterial {
        let wall = SurfaceWall {
            thickness: 1e-3,
            stiffening: 0.0,
            margin: f64::INFINITY,
        };
        WallMaterial::new(&Material::preset("glass").unwrap(), &wall, theory)
    }

    fn spacing(wall: &WallMaterial, first: f64) -> Spacing {
        let lowest = wall.eigenvalue(first).sqrt();
        Spacing {
            width: 0.5 * lowest,
            even_to: 10.0 * lowest,
            follows_from: 60.0 * lowest,
        }
    }

    /// The integrals that the bands cut up, by the midpoint rule.
    fn integrated(wall: &WallMaterial, first: f64, r: f64) -> [f64; 2] {
        const STEPS: usize = 200_000;
        let last = wall.last_wave_number(RADIUS);
        let dk = (last - first) / STEPS as f64;
        let mut sum = [0.0; 2];
        for i in 0..STEPS {
            let k = first + (i as f64 + 0.5) * dk;
            let f = k * hertz_disc(k * RADIUS) * wall.curvature(k) * dk / (2.0 * PI);
            sum = [
                sum[0] + f * libm::j0(k * r),
                sum[1] + f * libm::jn(2, k * r),
            ];
        }
        stress(wall, sum)
    }

    #[test]
    fn where_there_are_no_waves_there_is_no_band() {
        let wall = wall(PlateTheory::Layer);
        for first in [0.0, wall.last_wave_number(RADIUS), f64::INFINITY, f64::NAN] {
            let bands = Bands::new(&wall, first, RADIUS, spacing(&wall, 250.0));
            assert_eq!(bands, Bands::default(), "{first}");
        }
    }

    #[test]
    fn bands_add_up_to_the_integral_at_every_distance() {
        for theory in [PlateTheory::Kirchhoff, PlateTheory::Layer] {
            let wall = wall(theory);
            let first = 250.0;
            let bands = Bands::new(&wall, first, RADIUS, spacing(&wall, first));
            assert!(bands.oscillators.len() > 20 && bands.following.len() > 5);
            let radii = [0.0, 1e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2];
            let most = integrated(&wall, first, 0.0)[0];
            let still = bands.following_stress(&wall, &radii);
            let swinging = bands.swinging_stress(&wall, &radii);
            for (i, &r) in radii.iter().enumerate() {
                let expected = integrated(&wall, first, r);
                for part in 0..2 {
                    let swings: f64 = swinging[i].iter().map(|s| s[part]).sum();
                    let found = still[i][part] + swings;
                    assert!(
                        (found - expected[part]).abs() < 0.005 * most,
                        "{theory:?} {r} {part}: {found} {}",
                        expected[part]
                    );
                }
            }
        }
    }

    /// Tension along the far face of an elastic layer under a pressure of wave number k, over that pressure; x = kh. Airy's function
    /// φ = cos(kx) f(kz)/k², f = A cosh ζ + B sinh ζ + C ζ sinh ζ + D ζ cosh ζ, in plane strain: σ_zz = −f cos kx, σ_xz = f' sin kx,
    /// σ_xx = f'' cos kx. At the loaded face f = 1 and f' = 0, at the far one both are zero: four equations, solved as they stand.
    fn far_tension(x: f64) -> f64 {
        let rows = |z: f64| {
            let (s, c) = (z.sinh(), z.cosh());
            [[c, s, z * s, z * c], [s, c, s + z * c, c + z * s]]
        };
        let (top, bottom) = (rows(0.5 * x), rows(-0.5 * x));
        let columns = |m: [[f64; 4]; 4]| glam::DMat4::from_cols_array_2d(&m).transpose();
        let equations = columns([top[0], top[1], bottom[0], bottom[1]]);
        let [a, b, c, d] = (equations.inverse() * glam::DVec4::X).to_array();
        let z = -0.5 * x;
        let (sinh, cosh) = (z.sinh(), z.cosh());
        a * cosh + b * sinh + c * (2.0 * cosh + z * sinh) + d * (2.0 * sinh + z * cosh)
    }

    #[test]
    fn a_narrow_steady_load_bends_the_far_face_as_an_elastic_layer_is_bent() {
        // Contact of 0.2 thicknesses. The layer has no edge, and bends without end in long waves: both have waves from `first` on.
        let wall = wall(PlateTheory::Layer);
        let (h, nu) = (wall.thickness, 0.23);
        assert_eq!(Material::preset("glass").unwrap().poisson_ratio, nu);
        let radius = 0.2 * h;
        for first in [60.0, 250.0] {
            let steady = Spacing {
                width: 1.0,
                even_to: 0.0,
                follows_from: 0.0,
            };
            let bands = Bands::new(&wall, first, radius, steady);
            let radii = [0.2, 0.5, 1.0, 2.0, 4.0, 8.0].map(|r| r * h);
            let found = bands.following_stress(&wall, &radii);
            let most = found[0][0].abs();
            for (r, found) in radii.iter().zip(found) {
                const STEPS: usize = 40_000;
                let last = 30.0 / h;
                let dk = (last - first) / STEPS as f64;
                let mut exact = [0.0; 2];
                for i in 0..STEPS {
                    let k = first + (i as f64 + 0.5) * dk;
                    let wave = far_tension(k * h) * hertz_disc(k * radius) * k * dk / (2.0 * PI);
                    // Plane waves of all directions: σ along each, ν σ across.
                    exact[0] += (1.0 + nu) * wave * libm::j0(k * r);
                    exact[1] += (1.0 - nu) * wave * libm::jn(2, k * r);
                }
                for part in 0..2 {
                    let error = (found[part] - exact[part]).abs() / most;
                    assert!(error < 0.01, "{first} {r} {part}: {found:?} {exact:?}");
                }
            }
        }
    }

    #[test]
    fn oscillators_push_back_as_zeners_dashpot_does() {
        // Under a force that lasts, the contact of an infinite plate moves at F / 8√(Dμ) from the start, whatever the wave numbers:
        // Σ ξ² sin(ωt)/ω of bands that reach from nearly nothing on.
        let wall = wall(PlateTheory::Kirchhoff);
        let spacing = Spacing {
            width: 2e3,
            even_to: 1.2e5,
            follows_from: 4e6,
        };
        let bands = Bands::new(&wall, 0.5, 1e-5, spacing);
        for t in [1e-4, 2e-4, 4e-4] {
            // Of a force held since t = 0: Σ ξ² (1 − cos ωt)/ω², and its mean speed.
            let moved: f64 = bands
                .oscillators
                .iter()
                .map(|b| b.give * (1.0 - (b.eigenvalue.sqrt() * t).cos()) / b.eigenvalue)
                .sum::<f64>()
                + bands.compliance();
            let expected = t / wall.dashpot();
            assert!(
                (moved / expected - 1.0).abs() < 0.03,
                "{t}: {moved} {expected}"
            );
        }
    }
}
