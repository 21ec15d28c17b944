//! Linear elasticity on tetrahedra: stiffness and mass, SI units, f64.
//!
//! Quadratic elements (T10) carry the modes, since linear ones (T4) lock in bending: on a thin plate
//! they are 50–200 % too stiff. T4 stays for comparison with `[G12]`. [`Cover`] carries shapes whose walls are
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
