//! Checks that the cracks in a saved state can belong to a body.

use crate::asset::Asset;
use crate::error::InputError;
use crate::state::{BodyState, OldCut};

impl BodyState {
    /// Checks that the state can belong to a body of this asset.
    pub(crate) fn check(&self, asset: &Asset) -> Result<(), InputError> {
        let tets = asset.fracture.tets.len();
        let mut cut = vec![false; tets];
        for crack in &self.cracks {
            let first = crack.cuts.first();
            // What a piece keeps of a crack need not hold its start.
            let starts = crack.settled > 0 || first.is_some_and(|c| c.tet == crack.start);
            let there = first.is_some() && (crack.start as usize) < tets;
            if !(starts && there && crack.origin.is_finite() && crack.normal.is_normalized()) {
                return Err(InputError::State("a crack has no start, or no direction"));
            }
            let settled = crack.settled as usize;
            if settled > crack.cuts.len() || (settled > 0 && asset.portion.is_none()) {
                return Err(InputError::State(
                    "it is the state of a piece and belongs to another body",
                ));
            }
            if let Some(portion) = &asset.portion {
                let own = |c: &OldCut| portion.has_tet(&asset.fracture.tets[c.tet as usize]);
                let known = |c: &&OldCut| (c.tet as usize) < tets;
                if !crack.cuts.iter().filter(known).all(own) {
                    return Err(InputError::State(
                        "it cuts tetrahedra of other pieces, so it belongs to another body",
                    ));
                }
            }
            for c in &crack.cuts {
                let there = cut.get_mut(c.tet as usize);
                if there.is_none_or(|cut| std::mem::replace(cut, true)) {
                    return Err(InputError::State(
                        "it cuts a tetrahedron twice, or one that the body does not have, so it belongs to another body",
                    ));
                }
                if !(c.values.iter().all(|x| x.is_finite()) && c.direction.is_finite()) {
                    return Err(InputError::State("it has a number that is not finite"));
                }
            }
            if crack
                .junctions
                .iter()
                .any(|&(from, _)| from as usize >= crack.cuts.len())
            {
                return Err(InputError::State(
                    "a junction refers to a cut that does not exist",
                ));
            }
        }
        Ok(())
    }
}
