//! A grid over a part of a plane, with a list of numbers in each square.

use glam::DVec2;

/// Most squares along a side: of larger ones there are fewer.
const MOST: f64 = 1024.0;

/// Lists of numbers by the squares of a grid.
#[derive(Clone, Debug)]
pub struct Grid {
    low: DVec2,
    square: f64,
    counts: [usize; 2],
    of_square: Vec<Vec<u32>>,
}

impl Grid {
    /// An empty grid of squares of about this size, m, from `low` to `high`, m.
    #[must_use]
    pub fn new([low, high]: [DVec2; 2], square: f64) -> Self {
        let size = high - low;
        let square = square.max(size.max_element() / MOST).max(f64::MIN_POSITIVE);
        let counts = [size.x, size.y].map(|length| (length / square) as usize + 1);
        Self {
            low,
            square,
            counts,
            of_square: vec![Vec::new(); counts[0] * counts[1]],
        }
    }

    /// Column and row of a place; of one outside, those of the nearest square.
    fn at(&self, p: DVec2) -> [usize; 2] {
        let [x, y] = ((p - self.low) / self.square).to_array();
        [
            (x.max(0.0) as usize).min(self.counts[0] - 1),
            (y.max(0.0) as usize).min(self.counts[1] - 1),
        ]
    }

    /// Adds a number to all squares that a box touches.
    pub fn add(&mut self, [low, high]: [DVec2; 2], number: u32) {
        let ([x0, y0], [x1, y1]) = (self.at(low), self.at(high));
        for y in y0..=y1 {
            for x in x0..=x1 {
                self.of_square[y * self.counts[0] + x].push(number);
            }
        }
    }

    /// Numbers in the squares that a box touches; one that lies in several of them comes as often.
    pub fn near(&self, [low, high]: [DVec2; 2]) -> impl Iterator<Item = u32> + '_ {
        let ([x0, y0], [x1, y1]) = (self.at(low), self.at(high));
        let rows = (y0..=y1).map(move |y| y * self.counts[0]);
        rows.flat_map(move |row| {
            self.of_square[row + x0..=row + x1]
                .iter()
                .flatten()
                .copied()
        })
    }
}
