//! Laws fitted to counts, with standard errors.

use serde::Serialize;

/// y = k x^p through points, by least squares of the logarithms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PowerLaw {
    /// k.
    pub factor: f64,
    /// p.
    pub exponent: f64,
    /// Standard error of p, from the scatter of the points about the line.
    pub exponent_error: f64,
    /// Number of points.
    pub points: usize,
}

impl PowerLaw {
    /// Fits points; `None` when fewer than three have both numbers above zero, or all have the same x.
    #[must_use]
    pub fn fit(points: &[(f64, f64)]) -> Option<Self> {
        let logs: Vec<(f64, f64)> = points
            .iter()
            .filter(|(x, y)| *x > 0.0 && *y > 0.0)
            .map(|(x, y)| (x.ln(), y.ln()))
            .collect();
        let n = logs.len() as f64;
        if logs.len() < 3 {
            return None;
        }
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = logs.iter().map(|p| (p.0 - x).powi(2)).sum();
        if spread <= 0.0 {
            return None;
        }
        let exponent = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
        let off = |p: &(f64, f64)| p.1 - y - exponent * (p.0 - x);
        let scatter: f64 = logs.iter().map(|p| off(p).powi(2)).sum();
        Some(Self {
            factor: (y - exponent * x).exp(),
            exponent,
            exponent_error: (scatter / (n - 2.0) / spread).sqrt(),
            points: logs.len(),
        })
    }

    /// k x^p.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

/// N(> m) ∝ m^−(τ−1) exp(−m/m₀) above a least mass: a power law with an exponential cut-off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CutOffLaw {
    /// Smallest mass that counts.
    pub least: f64,
    /// τ: of the density of masses, where the cut-off does not matter yet.
    pub exponent: f64,
    /// Standard error of τ, from the spread between the samples.
    pub exponent_error: f64,
    /// m₀; infinite when the masses show no cut-off.
    pub cut_off: f64,
    /// Number of masses.
    pub masses: usize,
    /// Largest difference between the counted share of heavier pieces and the law (Kolmogorov and Smirnov's distance).
    pub distance: f64,
}

impl CutOffLaw {
    /// The likeliest law for masses of `least` and more. Each sample is one broken body: its pieces are not independent
    /// of each other, so the error comes from the sums over samples, not over pieces.
    ///
    /// `None` with fewer than ten masses or two samples.
    #[must_use]
    pub fn fit(samples: &[Vec<f64>], least: f64) -> Option<Self> {
        let samples: Vec<Vec<f64>> = samples
            .iter()
            .map(|s| s.iter().map(|m| m / least).filter(|x| *x >= 1.0).collect())
            .filter(|s: &Vec<f64>| !s.is_empty())
            .collect();
        let mut all: Vec<f64> = samples.iter().flatten().copied().collect();
        if all.len() < 10 || samples.len() < 2 {
            return None;
        }
        all.sort_by(f64::total_cmp);
        let [mut slope, mut decay] = likeliest(&all)?;
        let mut variance = robust_variance(&samples, [slope, decay], [true, true]);
        if decay <= 0.0 {
            // No cut-off: a power law alone, whose likelihood has its maximum in closed form.
            slope = all.len() as f64 / all.iter().map(|x| x.ln()).sum::<f64>();
            decay = 0.0;
            variance = robust_variance(&samples, [slope, decay], [true, false]);
        }
        let mut law = Self {
            least,
            exponent: 1.0 + slope,
            exponent_error: variance.sqrt(),
            cut_off: least / decay,
            masses: all.len(),
            distance: 0.0,
        };
        let n = all.len() as f64;
        law.distance = all
            .iter()
            .enumerate()
            .map(|(i, x)| {
                let heavier = law.share_above(x * least);
                let counted = |i: usize| 1.0 - i as f64 / n;
                (counted(i) - heavier)
                    .abs()
                    .max((counted(i + 1) - heavier).abs())
            })
            .fold(0.0, f64::max);
        Some(law)
    }

    /// Share of the masses that are above `mass`, of those above the least.
    #[must_use]
    pub fn share_above(&self, mass: f64) -> f64 {
        let x = mass / self.least;
        x.powf(1.0 - self.exponent) * (-(mass - self.least) / self.cut_off).exp()
    }
}

/// First and second derivatives of one mass' log-likelihood ln(a/x + b) − a ln x − b (x − 1) by a and b.
fn derivatives(x: f64, [a, b]: [f64; 2]) -> ([f64; 2], [f64; 3]) {
    let hazard = a / x + b;
    let (u, v) = (1.0 / (x * hazard), 1.0 / hazard);
    ([u - x.ln(), v - (x - 1.0)], [-(u * u), -(u * v), -(v * v)])
}

/// a and b of largest likelihood. It is concave, so Newton's steps, halved while they lead out of a/x + b > 0, get there.
fn likeliest(all: &[f64]) -> Option<[f64; 2]> {
    let allowed = |[a, b]: [f64; 2]| all.iter().all(|x| a / x + b > 0.0);
    let likelihood = |[a, b]: [f64; 2]| -> f64 {
        all.iter()
            .map(|x| (a / x + b).ln() - a * x.ln() - b * (x - 1.0))
            .sum()
    };
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let mut at = [0.5, 0.5 / mean];
    for _ in 0..100 {
        let (g, h) = sums(all, at);
        let det = h[0] * h[2] - h[1] * h[1];
        if det.abs() <= f64::MIN_POSITIVE {
            return None;
        }
        let step = [
            (h[1] * g[1] - h[2] * g[0]) / det,
            (h[1] * g[0] - h[0] * g[1]) / det,
        ];
        let (mut share, now) = (1.0, likelihood(at));
        let to = |share: f64| [at[0] + share * step[0], at[1] + share * step[1]];
        while share > 1e-9 && !(allowed(to(share)) && likelihood(to(share)) >= now) {
            share *= 0.5;
        }
        let next = to(share);
        let moved = (next[0] - at[0]).abs() + (next[1] - at[1]).abs() * mean;
        if share <= 1e-9 || moved < 1e-12 {
            return Some(at);
        }
        at = next;
    }
    Some(at)
}

fn sums(masses: &[f64], at: [f64; 2]) -> ([f64; 2], [f64; 3]) {
    let mut total = ([0.0; 2], [0.0; 3]);
    for &x in masses {
        let (g, h) = derivatives(x, at);
        (0..2).for_each(|i| total.0[i] += g[i]);
        (0..3).for_each(|i| total.1[i] += h[i]);
    }
    total
}

/// Variance of a: H⁻¹ (Σ g gᵀ) H⁻¹ with one gradient g per sample; b stays where it is unless `free`.
fn robust_variance(samples: &[Vec<f64>], at: [f64; 2], free: [bool; 2]) -> f64 {
    let mut hessian = [0.0; 3];
    let mut outer = [0.0; 3];
    for sample in samples {
        let (g, h) = sums(sample, at);
        (0..3).for_each(|i| hessian[i] += h[i]);
        outer[0] += g[0] * g[0];
        outer[1] += g[0] * g[1];
        outer[2] += g[1] * g[1];
    }
    let n = samples.len() as f64;
    let few = n / (n - 1.0);
    if !free[1] {
        return few * outer[0] / (hessian[0] * hessian[0]);
    }
    let det = hessian[0] * hessian[2] - hessian[1] * hessian[1];
    // The first row of H⁻¹.
    let row = [hessian[2] / det, -hessian[1] / det];
    few * (row[0] * row[0] * outer[0]
        + 2.0 * row[0] * row[1] * outer[1]
        + row[1] * row[1] * outer[2])
}
