//! Pieces that break again, an extension of the paper suggested in `[G12 §7.3.2]`.
//!
//! A piece is a body like any other. It shares the fracture mesh of the body it came from and stores only its
//! [`Portion`]: its nodes, its uncut tetrahedra and the cuts that separate it from its neighbours. A later break cuts the same
//! tetrahedra in the same way, so pieces of pieces tile their parent in every generation.
//!
//! The modes of a piece differ from those of the whole body. A [`PieceModel`] computes them as an [`Elastic`] model (the module
//! `pieces` of `frangible-bake` has two implementations), and [`Body::piece`](crate::Body::piece) creates a body from the portion and
//! this model. A cracked body in one piece can get new modes in the same way ([`Portion::of_cracked`]).
//!
//! Existing points on faces and in tetrahedra with three labels keep their positions, and new ones lie on the existing faces of the
//! piece. Contacts are given in the piece's frame, cracks in that of the mesh. [`PieceModel`] is a trait, so that a physics world
//! does not depend on finite elements.

mod elastic;
mod lists;
mod portion;
mod solid;

pub use crate::asset::Portion;
pub use elastic::{Elastic, PieceModel};
pub use solid::Solid;
