//! Small pieces come to rest (beyond the paper).
//!
//! Large pieces move on their own once they have parted (`crate::blow`). A small one moves with the piece that it came from and has the stress of
//! that piece, as if it had not parted, though nothing pulls or bends it any more. The release from its new faces crosses it at the speed of Rayleigh
//! waves; from then on it neither starts cracks nor feeds those that it has.
//!
//! That is so under a blow whose forces are followed with the body, with cracks that take time. The pieces are found while such a blow goes on
//! (`crate::cracking`).

use glam::Vec3;

/// Time from which each node's piece is at rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rest {
    /// Time for each node of the fracture mesh, s, infinite where its piece may crack on; empty while nothing has parted.
    from: Vec<f64>,
}

impl Rest {
    /// Returns true if nothing has parted yet.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.from.is_empty()
    }

    /// Returns true if the piece of a node is at rest.
    #[inline]
    pub(crate) fn has(&self, node: u32, now: f64) -> bool {
        self.from
            .get(node as usize)
            .is_some_and(|&from| from <= now)
    }

    /// Lets pieces come to rest: their release begins now, s, and runs at this speed, m/s. `piece_of_node` has the piece of each node of
    /// the fracture mesh, `positions` those of the nodes, m, and `free` is true for pieces that nothing loads.
    pub(crate) fn release(
        &mut self,
        piece_of_node: &[u32],
        positions: &[Vec3],
        free: &[bool],
        now: f64,
        speed: f64,
    ) {
        let mut extents = vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; free.len()];
        for (&piece, &position) in piece_of_node.iter().zip(positions) {
            // Nodes of other pieces of a body that has parted before have no number here.
            if let Some([low, high]) = extents.get_mut(piece as usize) {
                (*low, *high) = (low.min(position), high.max(position));
            }
        }
        let pieces = free.iter().zip(&extents);
        let rests: Vec<f64> = pieces
            .map(|(free, [low, high])| match free {
                true => now + f64::from(low.distance(*high)) / speed,
                false => f64::INFINITY,
            })
            .collect();
        self.from.resize(positions.len(), f64::INFINITY);
        for (&piece, from) in piece_of_node.iter().zip(&mut self.from) {
            if let Some(rests) = rests.get(piece as usize) {
                *from = from.min(*rests);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_piece_rests_once_its_release_has_crossed_it() {
        let positions = [0.0, 0.3, 0.6, 1.0].map(|x| Vec3::new(x, 0.0, 0.0));
        let mut rest = Rest::default();
        assert!(!rest.has(0, f64::MAX));
        // 0.4 m at 100 m/s; the other piece is pushed on, and one node is of a piece that parted before.
        rest.release(&[0, 0, 1, 1], &positions, &[false, true], 2.0, 100.0);
        assert!(!rest.has(2, 2.0039) && rest.has(2, 2.0041) && rest.has(3, 2.0041));
        assert!(!rest.has(0, f64::MAX) && !rest.has(1, f64::MAX));
        // What has begun goes on, whatever the piece is cut into.
        rest.release(&[0, 0, 1, u32::MAX], &positions, &[true, true], 3.0, 100.0);
        assert!(rest.has(2, 2.0041) && rest.has(3, 2.0041));
        assert!(!rest.has(0, 3.0029) && rest.has(0, 3.0031));
    }
}
