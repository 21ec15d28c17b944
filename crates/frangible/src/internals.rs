//! Everything that is not needed to break a body and use its pieces: the parts that the sibling crates are built from, and that the laboratory
//! and the viewer look into.
//!
//! **Names in here may change in any release**, the patch releases included, and so may members that are hidden from the documentation of the
//! root. What is documented at the root does not.
//!
//! The modules follow the way of a contact through the crate: [`asset`] and [`mesh`] (results of a bake), [`body`], [`contact`],
//! [`blow`], [`modal`] and [`near_field`] (the motion), [`stress`], [`loads`] (other ways to move a body), [`piece`] (a fragment as
//! a body), [`rigid`] (motion of bodies after a break).

/// Baked assets, their files and their checks.
pub mod asset {
    pub use crate::asset::*;
}

/// The force of a blow, integrated against the body.
pub mod blow {
    pub use crate::blow::*;
}

/// Breakable kinds, and their bodies.
pub mod body {
    pub use crate::body::*;
}

/// The switches of the fracture.
pub mod config {
    pub use crate::config::*;
}

/// Contacts: their points, forces and durations.
pub mod contact {
    pub use crate::contact::*;
}

/// Errors of the input.
pub mod error {
    pub use crate::error::*;
}

/// Strength and toughness that vary over a body.
pub mod fields {
    pub use crate::fields::*;
}

/// Loads other than contacts: rest, blast, script.
pub mod loads {
    pub use crate::loads::*;
}

/// Materials.
pub mod material {
    pub use frangible_material::*;
}

/// Dispatch to the widest vectors of the processor.
#[doc(hidden)]
pub mod vectors {
    pub use crate::vectors::*;
    pub use pulp::NullaryFnOnce;
}

/// Tetrahedra and surfaces.
pub mod mesh {
    pub use frangible_geometry::*;
}

/// The modes and their motion.
pub mod modal {
    pub use crate::modal::*;
    pub use crate::motion::{Motion, respond};
}

/// Near fields: the motion near a contact that the modes leave out.
pub mod near_field {
    pub use crate::near_field::*;
}

/// Outcomes of impacts, and their reports.
pub mod outcome {
    pub use crate::outcome::*;
}

/// Fragments that are bodies again.
pub mod piece {
    pub use crate::piece::*;
}

/// Motion of bodies after a break.
pub mod rigid {
    pub use crate::rigid::*;
}

/// The cracks that a body remembers.
pub mod state {
    pub use crate::state::*;
}

/// Stresses at weak points.
pub mod stress {
    pub use crate::asset::StressBounds;
    pub use crate::motion::DisplacementBatch;
    pub use crate::stress::*;
}

pub use crate::asset::AssetFileError;
pub use crate::config::{DurationModel, Model};
pub use crate::crack::{CrackMark, ShownStress};
pub use crate::fields::{Factors, Fields};
#[doc(hidden)]
pub use crate::fragment::{CutEdge, interfaces_of_labels, pieces_of_cuts};
pub use crate::impact::{Drive, Stage, Vibration, impact_traced};
pub use crate::loads::{Blast, Force, LoadClock, blast, follow, follow_traced, fracture_at, rest};
pub use crate::mesh::{
    FineFaces, MassProperties, Pool, RenderMesh, TetMesh, Threads, box_projection,
};
pub use crate::outcome::{LookedAt, StageTimings};
pub use crate::piece::{Elastic, PieceModel, Portion};
pub use crate::refuse::{is_harmless, rest_margin_at_least};
pub use crate::state::BodyState;
pub use crate::tips::CrackFront;
pub use crate::trace::{CrackTrace, ElementTrace};
pub use frangible_material::{Fatigue, Laminate, Preset, UnknownMaterial};
