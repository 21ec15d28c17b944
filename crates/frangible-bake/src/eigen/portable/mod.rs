//! Sums that are rounded alike on every machine: each in an order of its own, with no fused product, however wide the vectors are.
//!
//! Modes of pieces are found while others wait, by a browser as well as by the server that it plays against, and those two
//! have to agree on what breaks next. `faer` is faster where its vectors are wide, and rounds otherwise where they are not.

mod factor;
mod panel;
mod substitution;
mod symmetric;

pub(crate) use factor::{factorise, factorise_panel};
pub(crate) use panel::{inner, multiply, subtract};
pub(crate) use substitution::solve;
pub(crate) use symmetric::symmetric;

/// Method of summation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sums {
    /// The widest instructions of this machine: fastest, with its own rounding.
    Fast,
    /// With the same bits everywhere.
    Portable,
}

/// Rows and columns of the product that are summed at once: what the registers of a machine with four f64 to a vector hold.
const TALL: usize = 8;
const WIDE: usize = 4;

/// A matrix that is read entry by entry.
#[derive(Clone, Copy)]
pub(crate) struct Entries<'a> {
    pub(crate) data: &'a [f64],
    /// Distance from an entry to the one below it.
    pub(crate) down: usize,
    /// Distance from an entry to the one beside it.
    pub(crate) across: usize,
}

impl Entries<'_> {
    #[inline(always)]
    fn at(self, row: usize, column: usize) -> f64 {
        self.data[row * self.down + column * self.across]
    }

    /// The matrix from this column on.
    #[inline(always)]
    fn after(self, column: usize) -> Self {
        Self {
            data: &self.data[(column * self.across).min(self.data.len())..],
            ..self
        }
    }
}

/// to += sign · a b, where `a` has `rows` × `inner` numbers; `to` and `a` are stored column after column, this far apart.
#[inline(always)]
pub(crate) fn add_product(
    (to, to_stride): (&mut [f64], usize),
    (a, a_stride): (&[f64], usize),
    b: Entries<'_>,
    [rows, inner, columns]: [usize; 3],
    sign: f64,
) {
    for first in (0..columns).step_by(WIDE) {
        let to = &mut to[first * to_stride..];
        let b = b.after(first);
        let wide = WIDE.min(columns - first);
        let tall = rows - rows % TALL;
        for row in (0..tall).step_by(TALL) {
            let (to, a) = (&mut to[row..], &a[row..]);
            if wide == WIDE {
                tile::<TALL, WIDE>(to, to_stride, a, a_stride, b, inner, sign);
                continue;
            }
            for column in 0..wide {
                let (to, b) = (&mut to[column * to_stride..], b.after(column));
                tile::<TALL, 1>(to, 0, a, a_stride, b, inner, sign);
            }
        }
        for row in tall..rows {
            for column in 0..wide {
                let (to, b) = (&mut to[column * to_stride + row..], b.after(column));
                tile::<1, 1>(to, 0, &a[row..], a_stride, b, inner, sign);
            }
        }
    }
}

/// M rows and N columns of the product.
#[inline(always)]
fn tile<const M: usize, const N: usize>(
    to: &mut [f64],
    to_stride: usize,
    a: &[f64],
    a_stride: usize,
    b: Entries<'_>,
    inner: usize,
    sign: f64,
) {
    let mut sums = [[0.0; M]; N];
    for p in 0..inner {
        let column = &a[p * a_stride..][..M];
        for (c, sums) in sums.iter_mut().enumerate() {
            let factor = b.at(p, c);
            for (sum, x) in sums.iter_mut().zip(column) {
                *sum += x * factor;
            }
        }
    }
    for (c, sums) in sums.iter().enumerate() {
        for (x, sum) in to[c * to_stride..][..M].iter_mut().zip(sums) {
            *x += sign * sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Entries, add_product};
    use crate::random;

    #[test]
    fn a_product_is_that_of_the_definition_whatever_the_size() {
        let numbers = |seed: u64, count: usize| -> Vec<f64> {
            (0..count)
                .map(|i| random::symmetric(seed, i as u64))
                .collect()
        };
        for [rows, inner, columns] in [[1, 1, 1], [8, 3, 4], [19, 7, 6], [33, 40, 3], [5, 2, 9]] {
            let (a, b) = (numbers(1, (rows + 2) * inner), numbers(2, inner * columns));
            let start = numbers(3, (rows + 1) * columns);
            let mut to = start.clone();
            let right = Entries {
                data: &b,
                down: columns,
                across: 1,
            };
            let sizes = [rows, inner, columns];
            add_product((&mut to, rows + 1), (&a, rows + 2), right, sizes, -1.0);
            for j in 0..columns {
                for i in 0..rows {
                    let terms = (0..inner).map(|p| a[p * (rows + 2) + i] * b[p * columns + j]);
                    let at = j * (rows + 1) + i;
                    // The same sum in the same order.
                    assert_eq!(to[at], start[at] - terms.fold(0.0, |sum, x| sum + x));
                }
                let beside = j * (rows + 1) + rows;
                assert_eq!(to[beside], start[beside]);
            }
        }
    }
}
