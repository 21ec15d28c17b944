//! Places on a crack, in blocks: whoever knows a nearer place than any of a block's passes over it unseen.

use std::ops::{Deref, Range};

use glam::Vec3;

/// Places of a block: a look at a block costs about as much as at one place.
const BLOCK: usize = 8;

/// Rounding of distances, relative.
const ROUNDING: f32 = 1e-5;

/// A place on a crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub(crate) position: Vec3,
    pub(crate) direction: Vec3,
    pub(crate) time: f64,
}

/// Neighbours in the order of growth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    centre: Vec3,
    radius: f32,
    /// When the crack was at the first of them, s.
    pub(super) since: f64,
}

impl Block {
    /// No place of it is nearer to a point than this, m.
    #[inline]
    pub(super) fn nearest(&self, point: Vec3) -> f32 {
        let distance = self.centre.distance(point);
        (distance - self.radius - ROUNDING * (distance + self.radius)).max(0.0)
    }
}

/// Places on a crack in the order of growth.
#[derive(Default)]
pub(crate) struct Sites {
    list: Vec<Site>,
    blocks: Vec<Block>,
}

impl Sites {
    pub(super) fn push(&mut self, site: Site) {
        if self.list.len().is_multiple_of(BLOCK) {
            self.blocks.push(Block {
                centre: site.position,
                radius: 0.0,
                since: site.time,
            });
        }
        if let Some(block) = self.blocks.last_mut() {
            block.radius = block.radius.max(block.centre.distance(site.position));
            block.since = block.since.min(site.time);
        }
        self.list.push(site);
    }

    /// Whether a place lies no farther than this from a point, m.
    pub(super) fn any_within(&self, distance: f32, point: Vec3) -> bool {
        let squared = distance * distance;
        // The latest first: a new place is next to them.
        let mut near = self.blocks_from(0).rev();
        near.any(|(places, block)| {
            block.nearest(point) <= distance
                && (self.list[places].iter())
                    .any(|site| site.position.distance_squared(point) <= squared)
        })
    }

    /// Places from number `first` on, block by block.
    pub(super) fn blocks_from(
        &self,
        first: usize,
    ) -> impl DoubleEndedIterator<Item = (Range<usize>, &Block)> {
        let blocks = first / BLOCK..self.blocks.len();
        blocks.map(move |i| {
            let end = (BLOCK * (i + 1)).min(self.list.len());
            ((BLOCK * i).max(first)..end, &self.blocks[i])
        })
    }
}

impl Deref for Sites {
    type Target = [Site];

    fn deref(&self) -> &[Site] {
        &self.list
    }
}

impl<'a> IntoIterator for &'a Sites {
    type Item = &'a Site;
    type IntoIter = std::slice::Iter<'a, Site>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}
