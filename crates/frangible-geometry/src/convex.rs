//! Reduction of the number and complexity of convex parts, for colliders of physics engines.

use glam::Vec3;

/// Merges neighbouring convex parts into at most `most` parts, by recursive median splits along the longest side of the bounding
/// box of their centres.
#[must_use]
pub fn merged_parts(parts: Vec<&[Vec3]>, most: usize) -> Vec<Vec<Vec3>> {
    if parts.len() <= most.max(1) {
        return parts.into_iter().map(<[_]>::to_vec).collect();
    }
    if most <= 1 {
        return vec![parts.concat()];
    }
    let middle = |points: &[Vec3]| points.iter().sum::<Vec3>() / points.len().max(1) as f32;
    let mut parts: Vec<(Vec3, &[Vec3])> = parts.into_iter().map(|p| (middle(p), p)).collect();
    let middles: Vec<Vec3> = parts.iter().map(|(m, _)| *m).collect();
    let (low, high) = bounds(&middles);
    let axis = (high - low).max_position();
    parts.sort_by(|(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    let far = parts.split_off(parts.len() / 2);
    let half = |parts: Vec<(Vec3, &[Vec3])>, most| {
        merged_parts(parts.into_iter().map(|(_, p)| p).collect(), most)
    };
    let mut all = half(parts, most / 2);
    all.extend(half(far, most - most / 2));
    all
}

/// Reduces points to at most `most`: welds them on a grid of 1e-5 of their extent, since nearly coincident points break hull
/// algorithms, then keeps the extreme ones along evenly spread directions.
#[must_use]
pub fn thinned(points: &[Vec3], most: usize) -> Vec<Vec3> {
    let (low, high) = bounds(points);
    let grid = (high - low).max_element() * 1e-5;
    if !(grid.is_finite() && grid > 0.0) {
        return Vec::new();
    }
    let mut cells: Vec<([i32; 3], usize)> = points
        .iter()
        .enumerate()
        .map(|(i, &p)| (((p - low) / grid).round().as_ivec3().to_array(), i))
        .collect();
    cells.sort_unstable();
    cells.dedup_by_key(|(cell, _)| *cell);
    let mut kept: Vec<usize> = cells.into_iter().map(|(_, i)| i).collect();
    if kept.len() > most {
        kept.sort_unstable();
        let candidates = Candidates::of(points, std::mem::take(&mut kept));
        kept.extend((0..most).map(|k| candidates.farthest(spread_direction(k, most))));
    }
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| points[i]).collect()
}

/// Numbers that are compared side by side.
const WIDTH: usize = 8;

/// Points to choose from: their coordinates side by side, and their rising numbers.
struct Candidates {
    coordinates: [Vec<[f32; WIDTH]>; 3],
    numbers: Vec<usize>,
}

impl Candidates {
    fn of(points: &[Vec3], numbers: Vec<usize>) -> Self {
        let coordinates = [0, 1, 2].map(|axis| {
            let block = |block: &[usize]| {
                // The last block is filled up with its last point.
                let last = block.len() - 1;
                std::array::from_fn(|k| points[block[k.min(last)]][axis])
            };
            numbers.chunks(WIDTH).map(block).collect()
        });
        Self {
            coordinates,
            numbers,
        }
    }

    /// Projections of the points of a block on a direction.
    #[inline(always)]
    fn along(&self, block: usize, direction: Vec3) -> [f32; WIDTH] {
        let [x, y, z] = &self.coordinates;
        let (x, y, z) = (&x[block], &y[block], &z[block]);
        let mut along = [0.0; WIDTH];
        for k in 0..WIDTH {
            along[k] = x[k] * direction.x + y[k] * direction.y + z[k] * direction.z;
        }
        along
    }

    /// The point that lies farthest along a direction, the one of the lowest number where several do.
    fn farthest(&self, direction: Vec3) -> usize {
        let (mut largest, mut at) = (f32::NEG_INFINITY, 0);
        for block in 0..self.coordinates[0].len() {
            let mut along = self.along(block, direction);
            for half in [4, 2, 1] {
                for k in 0..half {
                    let other = along[k + half];
                    along[k] = if other > along[k] { other } else { along[k] };
                }
            }
            if along[0] > largest {
                (largest, at) = (along[0], block);
            }
        }
        let along = self.along(at, direction);
        let k = along.iter().position(|&a| a == largest).unwrap_or(0);
        self.numbers[(WIDTH * at + k).min(self.numbers.len() - 1)]
    }
}

/// The k-th of n directions spread evenly over the sphere (golden spiral).
fn spread_direction(k: usize, n: usize) -> Vec3 {
    let z = 1.0 - (2 * k + 1) as f32 / n as f32;
    let (sin, cos) = libm::sincosf(k as f32 * 2.399_963_2);
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * cos, r * sin, z)
}

/// Returns the half-extents if the points form an axis-aligned box about the origin, that is, if `volume` equals that of their
/// bounding box to 1e-5.
#[must_use]
pub fn box_of(points: &[Vec3], volume: f64) -> Option<Vec3> {
    let (low, high) = bounds(points);
    let size = high - low;
    let fills = volume >= (1.0 - 1e-5) * size.as_dvec3().element_product();
    let off = 0.5 * (low + high).abs().max_element();
    (size.is_finite() && fills && off <= 1e-4 * size.max_element()).then_some(0.5 * size)
}

/// Returns the lowest and highest corner of the bounding box of points, infinite without points.
#[must_use]
pub fn bounds(points: &[Vec3]) -> (Vec3, Vec3) {
    points.iter().fold(
        (Vec3::splat(f32::INFINITY), Vec3::splat(f32::NEG_INFINITY)),
        |(low, high), &p| (low.min(p), high.max(p)),
    )
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    use super::{Candidates, spread_direction};
    use glam::Vec3;

    #[test]
    fn the_farthest_point_is_that_of_a_plain_search_the_first_of_equals() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for count in [1, 7, 8, 9, 30, 200] {
            // On a coarse grid, so that several often lie equally far, and every other point may not be chosen.
            let mut number = || (rng.next_u32() % 5) as f32 - 2.0;
            let points: Vec<Vec3> = (0..2 * count)
                .map(|_| Vec3::new(number(), number(), number()))
                .collect();
            let numbers: Vec<usize> = (0..count).map(|i| 2 * i).collect();
            let candidates = Candidates::of(&points, numbers.clone());
            let axes = [Vec3::X, -Vec3::Y, Vec3::Z];
            for direction in (0..40).map(|k| spread_direction(k, 40)).chain(axes) {
                let along = |i: usize| points[i].dot(direction);
                let mut plain = numbers[0];
                for &i in &numbers {
                    plain = if along(i) > along(plain) { i } else { plain };
                }
                assert_eq!(candidates.farthest(direction), plain, "{count} {direction}");
            }
        }
    }
}
