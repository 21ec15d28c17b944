//! Places on a crack, side by side in blocks: a look at a block costs about as much as at one place.

use glam::Vec3;

/// Places of a block.
const BLOCK: usize = 8;

/// A place on a crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub(crate) position: Vec3,
    pub(crate) direction: Vec3,
    /// Time at which the crack was there, s.
    pub(crate) time: f64,
}

/// Positions and times of neighbours in the order of growth; where there is no place yet, it is infinitely far away.
#[derive(Clone, Copy, Debug)]
struct Block {
    position: [[f32; BLOCK]; 3],
    time: [f32; BLOCK],
}

impl Block {
    const EMPTY: Self = Self {
        position: [[f32::INFINITY; BLOCK]; 3],
        time: [0.0; BLOCK],
    };

    /// Squared distances from a point, m².
    #[inline(always)]
    fn distances(&self, point: Vec3) -> [f32; BLOCK] {
        let [x, y, z] = &self.position;
        let mut squared = [0.0; BLOCK];
        for k in 0..BLOCK {
            let (x, y, z) = (x[k] - point.x, y[k] - point.y, z[k] - point.z);
            squared[k] = x * x + y * y + z * z;
        }
        squared
    }

    /// Squares of the distances that waves of this speed, m/s, have come from each place by `now`, s: m².
    #[inline(always)]
    fn heard_within(&self, now: f32, wave: f32) -> [f32; BLOCK] {
        let mut squared = [0.0; BLOCK];
        for k in 0..BLOCK {
            let way = wave * (now - self.time[k]);
            let way = if way > 0.0 { way } else { 0.0 };
            squared[k] = way * way;
        }
        squared
    }
}

/// The smaller of two numbers, neither of which is NaN.
#[inline(always)]
fn smaller<T: Copy + PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// The least of a block's numbers, none of which is NaN. Halves are compared side by side: three comparisons follow each other, and not seven.
#[inline(always)]
fn least<T: Copy + PartialOrd>(mut numbers: [T; BLOCK]) -> T {
    let mut half = BLOCK / 2;
    while half > 0 {
        for k in 0..half {
            numbers[k] = smaller(numbers[k + half], numbers[k]);
        }
        half /= 2;
    }
    numbers[0]
}

/// Places on a crack in the order of growth.
#[derive(Default)]
pub(crate) struct Sites {
    list: Vec<Site>,
    blocks: Vec<Block>,
}

impl Sites {
    pub(crate) fn list(&self) -> &[Site] {
        &self.list
    }

    pub(super) fn push(&mut self, site: Site) {
        let k = self.list.len() % BLOCK;
        if k == 0 {
            self.blocks.push(Block::EMPTY);
        }
        if let Some(block) = self.blocks.last_mut() {
            for (places, x) in block.position.iter_mut().zip(site.position.to_array()) {
                places[k] = x;
            }
            block.time[k] = site.time as f32;
        }
        self.list.push(site);
    }

    /// Returns true if a place lies no farther than this from a point, m.
    pub(super) fn any_within(&self, distance: f32, point: Vec3) -> bool {
        let squared = distance * distance;
        // The latest first: a new place is next to them.
        let mut blocks = self.blocks.iter().rev();
        blocks.any(|block| least(block.distances(point)) <= squared)
    }

    /// The nearest place whose wave, of this speed, m/s, has reached a point at time `now`, s.
    #[inline(always)]
    pub(super) fn nearest_heard(&self, point: Vec3, now: f64, wave: f64) -> Option<&Site> {
        let (now, wave) = (now as f32, wave as f32);
        let mut nearest = [f32::INFINITY; BLOCK];
        let mut of_block = [0_u32; BLOCK];
        for (number, block) in (0..).zip(&self.blocks) {
            let distances = block.distances(point);
            let limits = block.heard_within(now, wave);
            for k in 0..BLOCK {
                let limit = smaller(limits[k], nearest[k]);
                let nearer = distances[k] < limit;
                nearest[k] = if nearer { distances[k] } else { nearest[k] };
                of_block[k] = if nearer { number } else { of_block[k] };
            }
        }
        let distance = least(nearest);
        if distance == f32::INFINITY {
            return None;
        }
        // Of equals the first.
        let mut numbers = [u32::MAX; BLOCK];
        for k in 0..BLOCK {
            let number = (BLOCK as u32) * of_block[k] + k as u32;
            numbers[k] = if nearest[k] == distance {
                number
            } else {
                u32::MAX
            };
        }
        self.list.get(least(numbers) as usize)
    }
}
