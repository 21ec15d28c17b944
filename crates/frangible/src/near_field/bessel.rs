//! Bessel's functions J₀ and J₁, from a table: thousands of values for every contact.

use std::sync::LazyLock;

/// Entries per unit of the argument. Cubic pieces of 1/16 are within 1e-7.
const PER_UNIT: f64 = 16.0;

/// Beyond this argument the functions count as zero: the waves of a band have cancelled long before.
const END: f64 = 256.0;

static TABLE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    (0..=(END * PER_UNIT) as usize + 1)
        .map(|i| {
            let x = i as f64 / PER_UNIT;
            [libm::j0(x), libm::j1(x)]
        })
        .collect()
});

/// The functions at many arguments.
#[derive(Clone, Copy)]
pub(super) struct Bessel {
    table: &'static [[f64; 2]],
}

impl Bessel {
    pub(super) fn new() -> Self {
        Self { table: &TABLE }
    }

    /// J₀ and J₁ of x ≥ 0; zero beyond 256.
    #[inline]
    pub(super) fn at(&self, x: f64) -> [f64; 2] {
        if x >= END {
            return [0.0, 0.0];
        }
        let i = (x * PER_UNIT) as usize;
        let step = 1.0 / PER_UNIT;
        let t = x * PER_UNIT - i as f64;
        let slopes = |i: usize| {
            let [j0, j1] = self.table[i];
            let x = i as f64 * step;
            // J₁' = J₀ − J₁/x, ½ at 0.
            [-j1, if i == 0 { 0.5 } else { j0 - j1 / x }]
        };
        let (a, b) = (self.table[i], self.table[i + 1]);
        let (da, db) = (slopes(i), slopes(i + 1));
        let (t2, t3) = (t * t, t * t * t);
        let (h1, h2) = (3.0 * t2 - 2.0 * t3, t3 - 2.0 * t2 + t);
        let h3 = t3 - t2;
        [0, 1].map(|f| a[f] + (b[f] - a[f]) * h1 + step * (da[f] * h2 + db[f] * h3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_gives_the_functions() {
        let bessel = Bessel::new();
        for i in 0..4000 {
            let x = f64::from(i) * 0.0637;
            let [j0, j1] = bessel.at(x);
            let expected = if x < END {
                [libm::j0(x), libm::j1(x)]
            } else {
                [0.0; 2]
            };
            assert!((j0 - expected[0]).abs() < 1e-7, "J0({x})");
            assert!((j1 - expected[1]).abs() < 1e-7, "J1({x})");
        }
    }
}
