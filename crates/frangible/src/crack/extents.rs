//! Extents of the cracks and the reach of their release, side by side in blocks: a look at eight of them costs about as much as at one.

use glam::Vec3;

/// Cracks of a block.
pub(super) const BLOCK: usize = 8;

/// A crack that takes a smaller share than this of the stress counts as taking nothing. It is far away for its length and needs no look,
/// which saves time, since most cracks about a point are short and far.
pub(super) const FAINT: f32 = 0.02;

/// Cracks no farther from a point than so many of their half-lengths are [`Ring::Close`]: they may take more than a quarter of the stress.
const CLOSE: f32 = 2.0;

/// At a distance of so many half-lengths a of a crack its share is below [`FAINT`]. A crack in a stretched body takes the most,
/// 1 − (1 + a²/y²)^-1.5 < 1.5 a²/y² at the distance y, and √(1.5 / 0.02) = 8.66.
const FAR: f32 = 8.67;

/// Position and size of a crack.
#[derive(Clone, Copy, Debug)]
struct Extent {
    origin: Vec3,
    /// Largest distance of a fractured tetrahedron from the start, m.
    size: f32,
    /// Two of its tetrahedra that lie far apart.
    ends: [Vec3; 2],
    /// Distance between those two tetrahedra, m.
    chord: f32,
    /// Time at which the latest of its tetrahedra joined, s.
    latest: f64,
    change: Change,
}

/// The last change of a crack, or of a block of them.
#[derive(Clone, Copy, Debug)]
struct Change {
    /// Number of the change, counted over all cracks.
    number: u64,
    /// Time at which its waves have gone wherever it takes anything to speak of, s.
    heard: f64,
}

impl Change {
    /// No change yet.
    const NONE: Self = Self {
        number: 0,
        heard: f64::NEG_INFINITY,
    };

    /// Returns true if a look at time `now`, s, hears the same of it as the look `seen`.
    #[inline(always)]
    fn is_known(self, seen: Seen, now: f64) -> bool {
        self.number <= seen.change && self.heard <= seen.now.min(now)
    }
}

/// The last look of a point at the cracks of a ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Number of the last change of a crack before.
    change: u64,
    /// The time of the look, s.
    now: f64,
}

impl Seen {
    /// There was no look yet.
    pub(crate) const NEVER: Self = Self {
        change: 0,
        now: f64::NEG_INFINITY,
    };
}

/// Cracks about a point, by how much of the stress there they may take. Few of them are close, and they often take enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ring {
    /// Cracks that may take much.
    Close,
    /// Cracks that may take anything to speak of, but for the close ones.
    Far,
}

impl Ring {
    /// Both of them: all cracks that may take anything to speak of.
    pub(crate) const ALL: [Self; 2] = [Self::Close, Self::Far];
}

/// Starts of neighbours in the list, and squares of the distances from there within which they release much, and anything to speak of, m²;
/// negative where there is no crack yet.
#[derive(Clone, Copy, Debug)]
struct Block {
    origin: [[f32; BLOCK]; 3],
    close: [f32; BLOCK],
    reach: [f32; BLOCK],
    change: Change,
}

impl Block {
    /// Cracks that have a point in their ring, a bit each.
    #[inline(always)]
    fn near(&self, point: Vec3, ring: Ring) -> u32 {
        let [x, y, z] = &self.origin;
        let mut squared = [0.0; BLOCK];
        for k in 0..BLOCK {
            let (x, y, z) = (point.x - x[k], point.y - y[k], point.z - z[k]);
            squared[k] = x * x + y * y + z * z;
        }
        let close = no_more_than(&squared, &self.close);
        match ring {
            Ring::Close => close,
            Ring::Far => no_more_than(&squared, &self.reach) & !close,
        }
    }
}

/// Numbers that are no larger than their limits, a bit each. Each number that is larger takes its bit away: so compilers keep the
/// numbers side by side, which they do not where each number that is smaller adds its bit.
#[inline(always)]
fn no_more_than(numbers: &[f32; BLOCK], limits: &[f32; BLOCK]) -> u32 {
    let mut without = [0_u32; BLOCK];
    for k in 0..BLOCK {
        let within = numbers[k] <= limits[k];
        without[k] = if within { u32::MAX } else { !(1 << k) };
    }
    let mut bits = (1 << BLOCK) - 1;
    for without in without {
        bits &= without;
    }
    bits
}

/// Extents of all cracks.
#[derive(Debug)]
pub(crate) struct Extents {
    /// Mean edge of the fracture mesh, m.
    edge: f32,
    /// Largest half-length by which a crack releases, m.
    most: f32,
    /// Speed of the waves c_R, m/s.
    wave: f64,
    /// Number of changes so far.
    changes: u64,
    list: Vec<Extent>,
    blocks: Vec<Block>,
}

impl Extents {
    /// No crack, in a mesh of this mean edge, m, and a material of this wave speed, m/s.
    pub(super) fn new(edge: f32, wave: f64) -> Self {
        Self {
            edge,
            most: f32::INFINITY,
            wave,
            changes: 0,
            list: Vec::new(),
            blocks: Vec::new(),
        }
    }

    /// With cracks that release no more than one of this half-length, m, does.
    pub(super) fn no_longer_than(self, most: f32) -> Self {
        Self { most, ..self }
    }

    /// Adds a crack that starts here.
    pub(super) fn start(&mut self, origin: Vec3) {
        let k = self.list.len() % BLOCK;
        if k == 0 {
            self.blocks.push(Block {
                origin: [[0.0; BLOCK]; 3],
                close: [-1.0; BLOCK],
                reach: [-1.0; BLOCK],
                change: Change::NONE,
            });
        }
        if let Some(block) = self.blocks.last_mut() {
            for (places, x) in block.origin.iter_mut().zip(origin.to_array()) {
                places[k] = x;
            }
        }
        self.list.push(Extent {
            origin,
            size: 0.0,
            ends: [origin; 2],
            chord: 0.0,
            latest: f64::NEG_INFINITY,
            change: Change::NONE,
        });
        self.stretch(self.list.len() - 1);
    }

    /// Takes in a tetrahedron more of a crack, which joined it at a time, s. Where the place lies beyond both ends, the nearer end moves
    /// there.
    pub(super) fn grow(&mut self, crack: usize, centre: Vec3, time: f64) {
        let extent = &mut self.list[crack];
        extent.latest = extent.latest.max(time);
        extent.size = extent.size.max(centre.distance(extent.origin));
        let [first, second] = extent.ends.map(|end| end.distance(centre));
        if first.max(second) > extent.chord {
            extent.ends[usize::from(first > second)] = centre;
            extent.chord = first.max(second);
        }
        self.stretch(crack);
    }

    fn stretch(&mut self, crack: usize) {
        let size = self.list[crack].size;
        let reach = size + self.far(crack);
        let close = size + CLOSE * self.half_length(crack);
        self.changes += 1;
        // From any point within reach no place on the crack is farther than this; rounding of places and times is far below the margin.
        let farthest = 1.01 * f64::from(reach + size + self.edge);
        let extent = &mut self.list[crack];
        extent.change = Change {
            number: self.changes,
            heard: extent.latest + farthest / self.wave,
        };
        let (block, k) = (&mut self.blocks[crack / BLOCK], crack % BLOCK);
        (block.close[k], block.reach[k]) = (close * close, reach * reach);
        block.change = Change {
            number: self.changes,
            heard: block.change.heard.max(extent.change.heard),
        };
    }

    /// Record of a look at time `now`, s.
    pub(super) fn seen(&self, now: f64) -> Seen {
        Seen {
            change: self.changes,
            now,
        }
    }

    /// Time at which the latest tetrahedron of a crack joined, s.
    #[inline(always)]
    pub(super) fn latest(&self, crack: usize) -> f64 {
        self.list[crack].latest
    }

    /// Half the length of a crack, m, no less than that of an edge, and no more than it releases by.
    #[inline(always)]
    pub(super) fn half_length(&self, crack: usize) -> f32 {
        (0.5 * self.list[crack].chord.max(self.edge)).min(self.most)
    }

    /// Distance from its tetrahedra beyond which a crack takes nothing to speak of, m.
    #[inline(always)]
    pub(super) fn far(&self, crack: usize) -> f32 {
        FAR * self.half_length(crack)
    }

    /// Mean edge of the fracture mesh, m.
    #[inline(always)]
    pub(super) fn edge(&self) -> f32 {
        self.edge
    }

    /// Number of blocks of cracks.
    #[inline(always)]
    pub(super) fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Cracks of a block, a bit each, that lie in a ring about a point which hears at time `now`, s, what it has not `seen` of them.
    #[inline(always)]
    pub(super) fn about(&self, b: usize, point: Vec3, ring: Ring, seen: Seen, now: f64) -> u32 {
        let block = &self.blocks[b];
        if block.change.is_known(seen, now) {
            return 0;
        }
        let near = block.near(point, ring);
        let (mut left, mut about) = (near, near);
        while left != 0 {
            let k = left.trailing_zeros();
            left &= left - 1;
            let known = self.list[BLOCK * b + k as usize].change.is_known(seen, now);
            about &= !(u32::from(known) << k);
        }
        about
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, stream, uniform};

    #[test]
    fn cracks_about_a_point_are_those_whose_reach_it_is_in() {
        let mut rng = stream(5, Purpose::WeakPoints, 0);
        let mut number = move || uniform(&mut rng) as f32;
        let mut extents = Extents::new(1e-3, 3e3);
        for crack in 0..37 {
            let start = Vec3::new(number(), number(), number());
            extents.start(start);
            for _ in 0..crack % 5 {
                let step = 0.02 * Vec3::new(number(), number(), number());
                extents.grow(crack, start + step, 0.0);
            }
        }
        let mut found = 0;
        for _ in 0..200 {
            let point = Vec3::new(number(), number(), number());
            let mut about = Vec::new();
            for ring in Ring::ALL {
                for b in 0..extents.blocks() {
                    let bits = extents.about(b, point, ring, Seen::NEVER, 1.0);
                    about.extend(
                        (0..BLOCK)
                            .filter(|k| bits >> k & 1 == 1)
                            .map(|k| BLOCK * b + k),
                    );
                }
            }
            about.sort_unstable();
            let plainly: Vec<usize> = (0..37)
                .filter(|&crack| {
                    let extent = &extents.list[crack];
                    let reach = extent.size + extents.far(crack);
                    point.distance_squared(extent.origin) <= reach * reach
                })
                .collect();
            assert_eq!(about, plainly);
            found += about.len();
        }
        assert!((50..200 * 37 / 2).contains(&found), "{found}");
    }
}
