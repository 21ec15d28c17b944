//! Volumes of the pieces of a break.

use super::label::Labels;
use crate::asset::FOREIGN;
use crate::body::MeshIndex;

/// Volumes of the pieces of a body, or of a portion of it, in the unit of the mesh's index.
pub(crate) struct Volumes {
    of_piece: Vec<u64>,
    /// Half of the volume of them all.
    half: u64,
}

impl Volumes {
    /// The volumes of these pieces.
    pub(crate) fn of(labels: &Labels, index: &MeshIndex) -> Self {
        let mut of_piece = vec![0; labels.count];
        for (&label, volume) in labels.of_node.iter().zip(&index.volumes) {
            if label < FOREIGN {
                of_piece[label as usize] += volume;
            }
        }
        Self {
            half: of_piece.iter().sum::<u64>() / 2,
            of_piece,
        }
    }

    /// For each piece, true if it has no more than half of the volume and does not move on its own.
    pub(crate) fn free(&self, acts: &[bool]) -> Vec<bool> {
        let pieces = self.of_piece.iter().zip(acts);
        pieces
            .map(|(&volume, &acts)| volume <= self.half && !acts)
            .collect()
    }
}
