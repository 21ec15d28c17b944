//! Fourier's transform of Cooley and Tukey. Spectrograms of one page need no library of a thousand cases.

use std::f64::consts::TAU;

/// Transforms complex numbers (real, imaginary) in place: Σ x_k e^{−2πi jk/n}. Their number is a power of two.
pub(super) fn transform(values: &mut [[f32; 2]]) {
    let n = values.len();
    if n < 2 {
        return;
    }
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits);
        if i < j {
            values.swap(i, j);
        }
    }
    let mut half = 1;
    while half < n {
        let turns: Vec<[f32; 2]> = (0..half)
            .map(|k| {
                let (sin, cos) = (0.5 * TAU * k as f64 / half as f64).sin_cos();
                [cos as f32, -sin as f32]
            })
            .collect();
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for ((a, b), [c, s]) in low.iter_mut().zip(high).zip(&turns) {
                let turned = [b[0] * c - b[1] * s, b[0] * s + b[1] * c];
                *b = [a[0] - turned[0], a[1] - turned[1]];
                *a = [a[0] + turned[0], a[1] + turned[1]];
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::transform;

    #[test]
    fn it_is_the_sum_that_defines_it() {
        let values: Vec<[f32; 2]> = (0..16)
            .map(|k| [((k * 7) % 5) as f32, (k % 3) as f32])
            .collect();
        let mut fast = values.clone();
        transform(&mut fast);
        for (j, found) in fast.iter().enumerate() {
            let mut sum = [0.0_f32; 2];
            for (k, [re, im]) in values.iter().enumerate() {
                let angle = -std::f32::consts::TAU * (j * k) as f32 / 16.0;
                let (s, c) = angle.sin_cos();
                sum = [sum[0] + re * c - im * s, sum[1] + re * s + im * c];
            }
            assert!((sum[0] - found[0]).abs() < 1e-3 && (sum[1] - found[1]).abs() < 1e-3);
        }
    }
}
