//! Where cracks are, and how far they release, side by side in blocks: a look at eight of them costs about as much as at one.

use glam::Vec3;

/// Cracks of a block.
const BLOCK: usize = 8;

/// A crack that takes a smaller share than this of the stress counts as taking nothing. It is far away for its length and needs no look,
/// which saves time, since most cracks about a point are short and far.
pub(super) const FAINT: f32 = 0.02;

/// Cracks no farther from a point than so many of their half-lengths are [`Ring::Close`]: they may take more than a quarter of the stress.
const CLOSE: f32 = 2.0;

/// At a distance of so many half-lengths a of a crack its share is below [`FAINT`]. A crack in a stretched body takes the most,
/// 1 − (1 + a²/y²)^-1.5 < 1.5 a²/y² at the distance y, and √(1.5 / 0.02) = 8.66.
const FAR: f32 = 8.67;

/// Where a crack is, and how long.
#[derive(Clone, Copy, Debug)]
struct Extent {
    origin: Vec3,
    /// Largest distance of a fractured tetrahedron from the start, m.
    size: f32,
    /// Two of its tetrahedra that lie far apart.
    ends: [Vec3; 2],
    /// Distance between those two tetrahedra, m.
    chord: f32,
}

/// Cracks about a point, by how much of the stress there they may take. Few of them are close, and they often take enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ring {
    /// Those that may take much.
    Close,
    /// Those that may take anything to speak of, but for the close ones.
    Far,
}

impl Ring {
    /// Both of them: all cracks that may take anything to speak of.
    pub(crate) const ALL: [Self; 2] = [Self::Close, Self::Far];
}

/// Starts of neighbours in the list, and squares of how far from there they release much, and anything to speak of, m²; negative where
/// there is no crack yet.
#[derive(Clone, Copy, Debug)]
struct Block {
    origin: [[f32; BLOCK]; 3],
    close: [f32; BLOCK],
    reach: [f32; BLOCK],
}

/// Where all cracks are.
#[derive(Debug)]
pub(crate) struct Extents {
    /// Mean edge of the fracture mesh, m.
    edge: f32,
    list: Vec<Extent>,
    blocks: Vec<Block>,
}

impl Extents {
    /// No crack, in a mesh of this mean edge, m.
    pub(super) fn new(edge: f32) -> Self {
        Self {
            edge,
            list: Vec::new(),
            blocks: Vec::new(),
        }
    }

    /// Adds a crack that starts here.
    pub(super) fn start(&mut self, origin: Vec3) {
        let k = self.list.len() % BLOCK;
        if k == 0 {
            self.blocks.push(Block {
                origin: [[0.0; BLOCK]; 3],
                close: [-1.0; BLOCK],
                reach: [-1.0; BLOCK],
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
        });
        self.stretch(self.list.len() - 1);
    }

    /// Takes in a tetrahedron more of a crack. Where the place lies beyond both ends, the nearer end moves there.
    pub(super) fn grow(&mut self, crack: usize, centre: Vec3) {
        let extent = &mut self.list[crack];
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
        let (block, k) = (&mut self.blocks[crack / BLOCK], crack % BLOCK);
        (block.close[k], block.reach[k]) = (close * close, reach * reach);
    }

    /// Half the length of a crack, m, no less than that of an edge.
    #[inline(always)]
    pub(super) fn half_length(&self, crack: usize) -> f32 {
        0.5 * self.list[crack].chord.max(self.edge)
    }

    /// How far from its tetrahedra a crack takes anything to speak of, m.
    #[inline(always)]
    pub(super) fn far(&self, crack: usize) -> f32 {
        FAR * self.half_length(crack)
    }

    /// Mean edge of the fracture mesh, m.
    #[inline(always)]
    pub(super) fn edge(&self) -> f32 {
        self.edge
    }

    /// Cracks of a ring about a point, rising.
    #[inline(always)]
    pub(super) fn about(&self, point: Vec3, ring: Ring) -> impl Iterator<Item = usize> {
        self.blocks.iter().enumerate().flat_map(move |(b, block)| {
            let [x, y, z] = &block.origin;
            let mut near = [false; BLOCK];
            for k in 0..BLOCK {
                let (x, y, z) = (point.x - x[k], point.y - y[k], point.z - z[k]);
                let squared = x * x + y * y + z * z;
                let close = squared <= block.close[k];
                near[k] = match ring {
                    Ring::Close => close,
                    Ring::Far => !close && squared <= block.reach[k],
                };
            }
            let mut bits = 0_u32;
            for (k, near) in near.into_iter().enumerate() {
                bits |= u32::from(near) << k;
            }
            std::iter::from_fn(move || {
                let k = bits.trailing_zeros() as usize;
                bits &= bits.wrapping_sub(1);
                (k < BLOCK).then_some(BLOCK * b + k)
            })
        })
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
        let mut extents = Extents::new(1e-3);
        for crack in 0..37 {
            let start = Vec3::new(number(), number(), number());
            extents.start(start);
            for _ in 0..crack % 5 {
                let step = 0.02 * Vec3::new(number(), number(), number());
                extents.grow(crack, start + step);
            }
        }
        let mut found = 0;
        for _ in 0..200 {
            let point = Vec3::new(number(), number(), number());
            let [close, far] = Ring::ALL.map(|ring| extents.about(point, ring));
            let mut about: Vec<usize> = close.chain(far).collect();
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
