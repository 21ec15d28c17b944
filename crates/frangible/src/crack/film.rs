//! Cracks in laminated walls stop at the film (beyond the paper).
//!
//! Each ply cracks by its own stress. Where one has cracked, the others bear what it bore: of n plies that slide on their films each takes n/(n − 1)
//! times as much, and of plies that do not slide more. A crack goes on through the film where that is above the strength, without a weak point, since
//! it loads the next ply all along its line. The near field of a contact is that of the ply that is hit (`near_field`), and takes no part in this: so a
//! stone leaves a star in one ply, and a heavy blow, which bends the whole wall, cracks all of them along the same lines.
//!
//! A cracked ply hangs on its film, which loads it again within the length of shear lag
//! ([`Laminate::shear_lag`](crate::material::Laminate::shear_lag)). However long a crack is, it releases no more than a crack of that half-length.

use super::felt::Felt;
use super::field::StressField;
use super::single::Front;
use super::system::CrackSystem;

impl CrackSystem<'_> {
    /// Returns true if a front goes on to the tetrahedron ahead, where that lies in another ply.
    pub(super) fn passes_film(&self, front: &Front, felt: &Felt, field: &StressField) -> bool {
        let Some(laminate) = &self.asset.material.laminate else {
            return true;
        };
        let cut = &self.cracks[front.crack as usize].elements[front.from as usize];
        let Some((_, faces)) = &felt.wall else {
            return true;
        };
        let ply = field.wall(cut.tet as usize);
        if ply.is_none_or(|ply| ply.holds(self.centroids[front.tet as usize])) {
            return true;
        }
        let across = faces
            .each_ref()
            .map(|face| cut.direction.dot(face.times(cut.direction)));
        // What bends one ply open presses the other together while both are whole, and opens it when it is alone.
        let plies = f64::from(laminate.plies);
        let tension = f64::from(across[0].abs().max(across[1].abs())) * plies / (plies - 1.0);
        tension > self.resistance.painted(front.tet)
    }
}
