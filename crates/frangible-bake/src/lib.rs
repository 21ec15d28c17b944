//! Bakes shapes for `frangible`: tetrahedra, quadratic finite elements, vibration modes.
//!
//! A bake runs once per kind of object, in f64, and makes the immutable [`frangible::Asset`] that all bodies of that kind share.
//! [`bake()`] is the main entry point, [`bake_with`] the same with progress and a report; its stages can be used separately: [`shapes`] makes tetrahedra, [`fem`] stiffness and mass,
//! [`eigen`] the modes, [`embed`] locates points in the analysis mesh, and [`surface`] computes normals and curvature.
//!
//! Every shape gets two meshes: a coarse analysis mesh of quadratic elements for the modes, and a fine, deliberately irregular fracture
//! mesh of linear elements for the cracks. A general solid (a mesh file by [`import_mesh`], a signed distance function,
//! [`Shape::ready`]) is filled with tetrahedra by `frangible-mesh`, and its analysis mesh is a lattice that covers it ([`fem::Cover`]).
//!
//! ```
//! use frangible::{Body, Contact, FractureConfig, Material, Outcome, Striker, glam::Vec3, impact};
//! use frangible_bake::{BakeSpec, Shape, bake};
//!
//! let spec = BakeSpec { modes: 40, ..BakeSpec::new("glass", Shape::drinking_glass(), Material::preset("glass")?) };
//! let asset = bake(&spec)?; // once per kind of object: tetrahedra and vibration modes
//! let body = Body::new(asset.into(), 1)?; // seed of its weak points
//! let stone = Striker::fixed(&Material::preset("stone")?); // what it lands on
//! let hit = Contact::strike(Vec3::new(-0.038, 0.0, 0.068), Vec3::X, 5.0, stone); // where, direction, m/s, by what
//! let Outcome::Broke(fracture) = impact(&body, &[hit], &FractureConfig::default())? else { panic!("it held") };
//! assert!(fracture.fragments.len() > 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Without the solver nobody calls the meshers of shapes.
#![cfg_attr(not(feature = "solver"), allow(dead_code))]

#[cfg(feature = "solver")]
mod analysis;
#[cfg(feature = "solver")]
mod bake;
#[cfg(feature = "solver")]
mod bake_file;
mod cancel;
#[cfg(feature = "solver")]
mod cells;
mod clusters;
#[cfg(feature = "solver")]
pub mod eigen;
#[cfg(feature = "solver")]
pub mod embed;
mod error;
mod extrude;
#[cfg(feature = "solver")]
pub mod fem;
#[cfg(feature = "solver")]
mod followed;
mod groups;
mod import;
mod import_tets;
mod import_walls;
#[cfg(feature = "solver")]
mod laminate;
mod mesh;
pub mod mode_field;
mod phase;
pub mod pieces;
use frangible_mesh::random;
mod report;
pub mod shapes;
mod sheet;
#[cfg(feature = "solver")]
mod spec;
mod supports;
#[cfg(feature = "solver")]
pub mod surface;
#[cfg(feature = "solver")]
mod walls;
pub mod weakness;

#[cfg(feature = "solver")]
pub use bake::{Baked, bake, bake_with};
#[cfg(feature = "solver")]
pub use bake_file::{bake_file, bake_file_with};
pub use cancel::CancelToken;
pub use error::BakeError;
#[cfg(feature = "solver")]
#[doc(hidden)]
pub use followed::stress_rows;
pub use frangible::internals::asset::{RescaleError, scaled, with_material};
pub use frangible_mesh;
pub use groups::Group;
pub use import::{ImportOptions, Imported, ImportedPart, ImportedParts, import_mesh, import_parts};
pub use import_tets::{ImportedTets, import_tets};
pub use mesh::BodyMesh;
pub use mode_field::ModeField;
pub use report::{BakeReport, MeshReport, Progress, Stage};
pub use shapes::{
    AnalysisChoice, MeshSize, PaneShape, READY_SHAPES, Shape, SolidShape, Station, TetShape,
    WallShape,
};
#[cfg(feature = "solver")]
pub use spec::BakeSpec;
pub use supports::{Region, Support, check_groups, check_supports};

/// Largest number of modes of an asset. With this many, the bake of a drinking glass takes twice as long as with 120, and its file has 36 MB.
pub const MOST_MODES: usize = 400;

/// Default number of modes of an asset. Measured (`cargo run --release -p frangible-bake --example modes_kept`): a drinking glass bakes 1.4
/// times as long as with 120. A blow on it integrates 123 of them through time, and 90 of 400; a blow on a brick only 20, and 30 of 120.
pub const USUAL_MODES: usize = 200;
