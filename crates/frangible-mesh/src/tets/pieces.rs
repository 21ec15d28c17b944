//! Face-connected pieces.

use crate::quality::volume;
use crate::tets::Draft;
use crate::tets::adjacency::neighbours;
use frangible_geometry::NO_NEIGHBOUR;

/// Report of dropping all pieces of a body but the largest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Dropped {
    /// Pieces in all.
    pub(crate) pieces: usize,
    /// Share of the largest in the volume.
    pub(crate) kept: f64,
}

/// Keeps the largest face-connected piece.
pub(crate) fn keep_largest(draft: &mut Draft) -> Dropped {
    let (label, pieces) = label(&draft.body.tets);
    if pieces <= 1 {
        return Dropped { pieces, kept: 1.0 };
    }
    let mut volumes = vec![0.0; pieces];
    for (e, &l) in label.iter().enumerate() {
        volumes[l as usize] += volume(draft.body.corners(e));
    }
    let largest = (0..pieces)
        .max_by(|&a, &b| volumes[a].total_cmp(&volumes[b]).then(b.cmp(&a)))
        .unwrap_or(0);
    draft.retain(|e| label[e] == largest as u32);
    Dropped {
        pieces,
        kept: volumes[largest] / volumes.iter().sum::<f64>(),
    }
}

/// Piece of each tetrahedron, and their number.
pub(crate) fn label(tets: &[[u32; 4]]) -> (Vec<u32>, usize) {
    let near = neighbours(tets);
    let mut label = vec![u32::MAX; near.len()];
    let mut pieces = 0;
    let mut stack = Vec::new();
    for start in 0..near.len() {
        if label[start] != u32::MAX {
            continue;
        }
        label[start] = pieces;
        stack.push(start);
        while let Some(e) = stack.pop() {
            for &n in near[e].iter().filter(|n| **n != NO_NEIGHBOUR) {
                if label[n as usize] == u32::MAX {
                    label[n as usize] = pieces;
                    stack.push(n as usize);
                }
            }
        }
        pieces += 1;
    }
    (label, pieces as usize)
}
