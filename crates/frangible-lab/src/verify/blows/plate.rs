//! A simply supported plate as the double series of all its modes, driven by a given force.

use std::f64::consts::PI;

/// Modes in each direction, odd and even: waves down to 2 L / 460, beyond which Hertz' pressure shows none of a contact wider than 0.6 mm.
const MOST: u32 = 460;

/// Kind of the terms of the series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Terms {
    /// Kirchhoff's plate.
    Thin,
    /// Mindlin's frequencies, and at the far face the tension of an elastic layer.
    Layer,
}

/// A plate, simply supported all round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plate {
    /// Length of each side, m.
    pub(crate) side: f64,
    /// Thickness, m.
    pub(crate) thickness: f64,
    /// Young's modulus, Pa.
    pub(crate) youngs_modulus: f64,
    pub(crate) poisson_ratio: f64,
    /// Density, kg/m³.
    pub(crate) density: f64,
}

/// Stress in the plane of a face: along x, along y, shear, Pa.
pub(crate) type InPlane = [f64; 3];

impl Plate {
    /// D, N·m.
    pub(crate) fn bending_stiffness(&self) -> f64 {
        self.youngs_modulus * self.thickness.powi(3) / (12.0 * (1.0 - self.poisson_ratio.powi(2)))
    }

    /// μ, kg/m².
    pub(crate) fn mass_per_area(&self) -> f64 {
        self.density * self.thickness
    }

    /// Zener's 8 √(Dμ), N·s/m.
    pub(crate) fn dashpot(&self) -> f64 {
        8.0 * (self.bending_stiffness() * self.mass_per_area()).sqrt()
    }

    /// ω² of the wave number k, 1/s².
    fn eigenvalue(&self, k: f64, terms: Terms) -> f64 {
        let (d, mu, h) = (
            self.bending_stiffness(),
            self.mass_per_area(),
            self.thickness,
        );
        let thin = d * k.powi(4) / mu;
        if terms == Terms::Thin {
            return thin;
        }
        // Mindlin (1951): with c = κ G/ρ and r² = h²/12, ω⁴ − ω² (c k² (1 + D/(μ r² c)) + c/r²) + D c k⁴/(μ r²) = 0.
        let c = PI * PI / 12.0 * self.youngs_modulus
            / (2.0 * (1.0 + self.poisson_ratio))
            / self.density;
        let r2 = h * h / 12.0;
        let half = 0.5 * (c * k * k + d / (mu * r2) * k * k + c / r2);
        let product = thin * c / r2;
        product / (half + (half * half - product).sqrt())
    }

    /// Stress of the far face at points (m from the plate's middle) at the ends of these steps, of a force on `centre` that is linear
    /// between samples `step` apart, starts from nothing and is spread as Hertz' pressure over a disc. For each step, for each point.
    pub(crate) fn stress(
        &self,
        terms: Terms,
        centre: [f64; 2],
        load: (&[f32], f64, f64),
        points: &[[f64; 2]],
        steps: &[usize],
    ) -> Vec<Vec<InPlane>> {
        let (force, step, radius) = load;
        let (l, nu, h) = (self.side, self.poisson_ratio, self.thickness);
        let mut curvature = vec![vec![[0.0; 3]; points.len()]; steps.len()];
        let waves = |x: f64| -> Vec<[f64; 2]> {
            (0..=MOST)
                .map(|i| {
                    let (sin, cos) = (f64::from(i) * PI / l * (0.5 * l + x)).sin_cos();
                    [sin, cos]
                })
                .collect()
        };
        let load = centre.map(waves);
        let at: Vec<[Vec<[f64; 2]>; 2]> = points.iter().map(|p| p.map(waves)).collect();
        for i in 1..=MOST as usize {
            for j in 1..=MOST as usize {
                let pushed = load[0][i][0] * load[1][j][0];
                let (a, b) = (i as f64 * PI / l, j as f64 * PI / l);
                let k = (a * a + b * b).sqrt();
                // A mode that is not pushed, or shorter than any wave of the disc.
                if pushed.abs() < 1e-9 || k > f64::from(MOST) * PI / l {
                    continue;
                }
                let eigenvalue = self.eigenvalue(k, terms);
                let ahead = swing(eigenvalue.sqrt(), force, step, steps);
                let far = match terms {
                    Terms::Thin => 1.0,
                    Terms::Layer => far_face(k * h),
                };
                let still = 4.0 / (l * l) * pushed * disc(k * radius) * far
                    / (self.bending_stiffness() * k.powi(4));
                for (sums, swing) in curvature.iter_mut().zip(ahead) {
                    let q = still * swing;
                    for (sum, [x, y]) in sums.iter_mut().zip(&at) {
                        sum[0] += q * a * a * x[i][0] * y[j][0];
                        sum[1] += q * b * b * x[i][0] * y[j][0];
                        sum[2] -= q * a * b * x[i][1] * y[j][1];
                    }
                }
            }
        }
        let scale = 0.5 * h * self.youngs_modulus / (1.0 - nu * nu);
        for [x, y, xy] in curvature.iter_mut().flatten() {
            (*x, *y, *xy) = (
                scale * (*x + nu * *y),
                scale * (*y + nu * *x),
                scale * (1.0 - nu) * *xy,
            );
        }
        curvature
    }
}

/// ω² q of q̈ + ω² q = F at the ends of these steps.
fn swing(w: f64, force: &[f32], step: f64, steps: &[usize]) -> Vec<f64> {
    let (sin, cos) = (w * step).sin_cos();
    // ω² q and ω q̇; F is linear within a step, and the motion swings about it.
    let (mut q, mut v, mut f) = (0.0, 0.0, 0.0);
    let mut found = Vec::with_capacity(steps.len());
    let last = steps.iter().copied().max().unwrap_or(0);
    for (i, &next) in force.iter().enumerate().take(last + 1) {
        let slope = (f64::from(next) - f) / (step * w);
        let (e, g) = (q - f, v - slope);
        f = f64::from(next);
        q = f + e * cos + g * sin;
        v = slope - e * sin + g * cos;
        if steps.contains(&i) {
            found.push(q);
        }
    }
    found
}

/// Transform of Hertz' pressure on a disc of radius a, of unit force; `x` = ka.
pub(crate) fn disc(x: f64) -> f64 {
    if x < 1e-2 {
        return 1.0 - x * x / 10.0;
    }
    3.0 * (x.sin() - x * x.cos()) / x.powi(3)
}

/// Tension of the far face of an elastic layer under a pressure of wave number k over that of a thin plate; `x` = kh.
fn far_face(x: f64) -> f64 {
    if x < 0.05 {
        return 1.0 + x * x / 30.0;
    }
    let x = x.min(60.0);
    x.powi(3) * x.sinh() / (3.0 * (x.sinh().powi(2) - x * x))
}
