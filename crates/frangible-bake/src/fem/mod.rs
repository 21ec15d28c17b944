//! Linear elasticity on tetrahedra: stiffness and mass, in SI units and f64.
//!
//! The modes are computed on quadratic elements (T10), since linear ones (T4) lock in bending: on a thin plate
//! they are 50–200 % too stiff. T4 is kept for comparison with `[G12]`. [`Cover`] is for shapes whose walls are
//! too thin for a conforming mesh of few elements.

mod assembly;
mod cover;
mod element;
mod mass;
mod pattern;
mod quadratic;

pub use assembly::{Elements, System, assemble};
pub use cover::{Cover, assemble_cover, assemble_supported_cover};
pub use element::{Elasticity, stiffness_t4, stiffness_t10};
pub use mass::Mass;
pub(crate) use mass::multiply_symmetric;
pub use quadratic::{MID_EDGES, QuadraticMesh, shape_gradients, shape_values};
