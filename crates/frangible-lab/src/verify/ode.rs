//! An integrator of ordinary differential equations that shares nothing with the code that it judges.
//!
//! Dormand and Prince's pair of orders 5 and 4 with adaptive steps: J. R. Dormand, P. J. Prince, *A family of embedded
//! Runge–Kutta formulae*, J. Comp. Appl. Math. 6, 19 (1980).

/// Coefficients a_ij of the stages; the last row is the solution of order 5.
const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ],
    &[
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// Times c_i of the stages after the first, in steps.
const TIMES: [f64; 6] = [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
/// Weights of the error: order 5 less order 4.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// y at `end` from y at `start` with y' = `rate`(t, y). Each step errs by at most `tolerance` of the largest entry of
/// y, so the entries should be of like size: velocity and frequency × displacement.
pub(crate) fn integrate<const N: usize>(
    rate: impl Fn(f64, [f64; N]) -> [f64; N],
    start: f64,
    mut y: [f64; N],
    end: f64,
    tolerance: f64,
) -> [f64; N] {
    let largest = |y: &[f64; N]| y.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut t = start;
    let mut step = 1e-3 * (end - start);
    while t < end {
        // Not a rounding error short of the end.
        let last = t + step * (1.0 + 1e-9) >= end;
        let h = if last { end - t } else { step };
        let mut k = [[0.0; N]; 7];
        k[0] = rate(t, y);
        let mut next = y;
        for (stage, coefficients) in STAGES.iter().enumerate() {
            next = std::array::from_fn(|i| {
                let sum: f64 = coefficients.iter().zip(&k).map(|(a, k)| a * k[i]).sum();
                y[i] + h * sum
            });
            k[stage + 1] = rate(t + TIMES[stage] * h, next);
        }
        let error: [f64; N] =
            std::array::from_fn(|i| h * ERROR.iter().zip(&k).map(|(e, k)| e * k[i]).sum::<f64>());
        let scale = tolerance * largest(&y).max(largest(&next));
        let ratio = largest(&error) / scale.max(f64::MIN_POSITIVE);
        if ratio <= 1.0 {
            t = if last { end } else { t + h };
            y = next;
        }
        step = h * (0.9 * ratio.max(1e-12).powf(-0.2)).clamp(0.2, 5.0);
    }
    y
}

#[cfg(test)]
mod tests {
    use super::integrate;

    #[test]
    fn a_swing_comes_back_after_a_hundred_periods() {
        let end = 100.0 * std::f64::consts::TAU;
        let [q, v] = integrate(|_, [q, v]| [v, -q], 0.0, [1.0, 0.0], end, 1e-10);
        assert!((q - 1.0).abs() < 1e-7 && v.abs() < 1e-7, "{q}, {v}");
    }

    #[test]
    fn the_error_falls_with_the_tolerance() {
        let error = |tolerance| {
            let [y] = integrate(|t, [y]| [y * t.cos()], 0.0, [1.0], 5.0, tolerance);
            (y / 5.0_f64.sin().exp() - 1.0).abs()
        };
        assert!(error(1e-4) < 1e-3);
        assert!(error(1e-7) < 1e-6);
        assert!(error(1e-10) < 1e-9);
    }
}
