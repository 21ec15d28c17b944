//! Pieces that break again (beyond the paper, which names ways on `[G12 §7.3.2]`).
//!
//! A piece is a body like any other. It shares the fracture mesh of the body it came from, and what it keeps for itself is
//! a [`Portion`]: its nodes, its uncut tetrahedra, the cuts that part it from its neighbours. A later break cuts the same
//! tetrahedra the same way, so pieces of pieces tile their parent, generation after generation.
//!
//! Its vibration is another matter: its modes are not those of the whole. A [`PieceModel`] finds them
//! (module `pieces` of `frangible-bake` has two), as an [`Elastic`] body; [`Body::piece`](crate::Body::piece) makes a body of both.
//! A body that is cracked but whole can have new modes in the same way ([`Portion::of_cracked`]).
//!
//! Points on faces and in tetrahedra with three labels stay where they were, and new ones lie on the faces that the piece has
//! had. Contacts speak in the piece's frame, cracks in that of the mesh. [`PieceModel`] is a trait, so that a world needs
//! no finite elements.

mod elastic;
mod lists;
mod portion;
mod solid;

pub use crate::asset::Portion;
pub use elastic::{Elastic, PieceModel};
pub use solid::Solid;
