//! A crack's implicit surface `[G12 Eq. 6-10]`.
//!
//! The roughness takes the noise crate and the random streams of `frangible`, so that surfaces are the same: a ChaCha
//! stream per purpose and element, two offsets and a seed for the noise.

use frangible::Material;
use frangible::glam::DVec3;
use noise_functions::{Noise, Simplex};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::reference::stress::principal;

/// Numbers of the streams in `frangible`.
const DIRECTION: u64 = 2;
const ROUGHNESS: u64 = 3;

/// Below this relative gap of the two largest stresses a seeded direction between them is taken.
const ISOTROPIC: f64 = 1e-3;

/// S of Eq. 6, by its s.
pub(crate) struct Surface {
    /// p₀ of Eq. 9, m.
    origin: DVec3,
    /// R of Eq. 10: d⊥1, d, d⊥2.
    axes: [DVec3; 3],
    amplitude: f64,
    wavelength: f64,
    offset: [f64; 2],
    noise_seed: i32,
    /// Relative change of the stress that would turn the surface by a radian: small where two stresses are nearly equal.
    pub(crate) gap: f64,
    /// Relative change of the stress that would choose other axes.
    pub(crate) margin: f64,
}

impl Surface {
    pub(crate) fn new(
        centre: DVec3,
        sigma: &[[f64; 3]; 3],
        material: &Material,
        seed: u64,
        e: usize,
    ) -> Self {
        // "open the fracture in the direction d of the maximum principal stress" [G12 §5.2.1].
        let (value, direction) = principal(sigma);
        let largest = value[0].max(f64::MIN_POSITIVE);
        let relative = (value[0] - value[1]) / largest;
        let mut margin = (relative - ISOTROPIC).abs();
        let (d, gap);
        if relative >= ISOTROPIC {
            gap = relative;
            d = signed(direction[0], gap, &mut margin);
        } else {
            gap = (value[1] - value[2]) / largest;
            let third = signed(direction[2], gap, &mut margin);
            let (a, b) = perpendicular(third, gap, &mut margin);
            let angle = uniform(&mut stream(seed, DIRECTION, e)) * std::f64::consts::PI;
            d = a * angle.cos() + b * angle.sin();
        }
        let rough = material.roughness_amplitude > 0.0;
        let mut unimportant = 1.0;
        let (first, second) =
            perpendicular(d, gap, if rough { &mut margin } else { &mut unimportant });
        let mut rng = stream(seed, ROUGHNESS, e);
        let offset = [uniform(&mut rng) * 64.0, uniform(&mut rng) * 64.0];
        Self {
            origin: centre,
            axes: [first, d, second],
            amplitude: material.roughness_amplitude,
            wavelength: material.roughness_wavelength,
            offset,
            noise_seed: (uniform(&mut rng) * f64::from(i32::MAX)) as i32,
            gap: gap.clamp(0.0, 1.0),
            margin,
        }
    }

    /// s(p) = bump(R⁻¹ (p − p₀)), m `[G12 Eq. 7]`.
    pub(crate) fn s(&self, p: DVec3) -> f64 {
        let local = p - self.origin;
        let [x, y, z] = self.axes.map(|axis| axis.dot(local));
        self.bump(x, y, z)
    }

    /// p_y − noise(p_x, p_z) `[G12 Eq. 8]`, in metres, less the noise at the start, which the surface must pass.
    fn bump(&self, x: f64, y: f64, z: f64) -> f64 {
        y - (self.noise(x, z) - self.noise(0.0, 0.0))
    }

    fn noise(&self, x: f64, z: f64) -> f64 {
        if self.amplitude == 0.0 {
            return 0.0;
        }
        let at = [
            x / self.wavelength + self.offset[0],
            z / self.wavelength + self.offset[1],
        ];
        let noise = Simplex.seed(self.noise_seed).sample2(at.map(|v| v as f32));
        self.amplitude * f64::from(noise)
    }

    /// Relative change of the stress that would carry the surface to `p`, where s is known.
    pub(crate) fn margin_of(&self, p: DVec3, s: f64) -> f64 {
        s.abs() * self.gap / p.distance(self.origin)
    }
}

/// The sign with the largest component positive.
fn signed(d: DVec3, gap: f64, margin: &mut f64) -> DVec3 {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| d[j].abs().total_cmp(&d[i].abs()));
    for &other in &order[1..] {
        if d[other] * d[order[0]] < 0.0 {
            *margin = margin.min((d[order[0]].abs() - d[other].abs()) * gap);
        }
    }
    if d[order[0]] < 0.0 { -d } else { d }
}

/// Two directions across `d`: the first across the coordinate axis least along it as well.
fn perpendicular(d: DVec3, gap: f64, margin: &mut f64) -> (DVec3, DVec3) {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs()));
    *margin = margin.min((d[order[1]].abs() - d[order[0]].abs()) * gap);
    let mut axis = DVec3::ZERO;
    axis[order[0]] = 1.0;
    let first = d.cross(axis).normalize();
    (first, first.cross(d))
}

fn stream(seed: u64, purpose: u64, e: usize) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((purpose << 32) | e as u64);
    rng
}

fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 * 0.5_f64.powi(53)
}

/// Area of s = 0 in a tetrahedron with these values at its corners, m²: the fan of its cut points about their mean.
pub(crate) fn area(x: [DVec3; 4], s: [f64; 4]) -> f64 {
    let cut = |i: usize, j: usize| x[i] + (x[j] - x[i]) * (s[i] / (s[i] - s[j]));
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for k in 0..4 {
        if s[k] < 0.0 {
            below.push(k);
        } else {
            above.push(k);
        }
    }
    let points = match (&below[..], &above[..]) {
        (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => vec![cut(a, b), cut(a, c), cut(a, d)],
        (&[a, b], &[c, d]) => vec![cut(a, c), cut(a, d), cut(b, d), cut(b, c)],
        _ => return 0.0,
    };
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut sum = 0.0;
    for k in 0..points.len() {
        let (p, q) = (points[k], points[(k + 1) % points.len()]);
        sum += 0.5 * (p - middle).cross(q - middle).length();
    }
    sum
}
