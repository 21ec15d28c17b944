//! Medians and percentiles of times.

use serde::Serialize;

/// Times of equal runs, s, ascending.
#[derive(Clone, Debug, Default)]
pub struct Times(Vec<f64>);

impl Times {
    /// Statistics of these times, s, in any order.
    #[must_use]
    pub fn new(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        Self(times)
    }

    /// Number of times.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The smallest time that at least this share of all are not above, s (nearest rank); zero of none.
    #[must_use]
    pub fn quantile(&self, share: f64) -> f64 {
        let rank = (share * self.0.len() as f64).ceil() as usize;
        let last = self.0.len().saturating_sub(1);
        self.0
            .get(rank.saturating_sub(1).min(last))
            .copied()
            .unwrap_or(0.0)
    }

    /// The middle one, s; of an even number the lower of the two.
    #[must_use]
    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// Sum of all times, s.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    /// Returns the distribution of the times.
    #[must_use]
    pub fn spread(&self) -> Spread {
        Spread {
            calls: self.count(),
            mean_s: self.sum() / self.count().max(1) as f64,
            p50_s: self.median(),
            p99_s: self.quantile(0.99),
            p999_s: self.quantile(0.999),
            max_s: self.quantile(1.0),
        }
    }
}

/// Distribution of the times of calls, s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Number of calls.
    pub calls: usize,
    /// Mean.
    pub mean_s: f64,
    /// Median.
    pub p50_s: f64,
    /// 99 of 100 took no longer.
    pub p99_s: f64,
    /// 999 of 1000 took no longer.
    pub p999_s: f64,
    /// The longest.
    pub max_s: f64,
}

#[cfg(test)]
mod tests {
    use super::Times;

    #[test]
    fn quantiles_are_nearest_ranks() {
        let times = Times::new((1..=1000).rev().map(f64::from).collect());
        assert_eq!(times.median(), 500.0);
        assert_eq!(times.quantile(0.99), 990.0);
        assert_eq!(times.quantile(0.999), 999.0);
        assert_eq!(times.quantile(1.0), 1000.0);
        assert_eq!(times.quantile(0.0), 1.0);
        assert_eq!(times.spread().mean_s, 500.5);
        assert_eq!(Times::new(vec![3.0]).quantile(0.999), 3.0);
        assert_eq!(Times::default().spread().max_s, 0.0);
    }
}
