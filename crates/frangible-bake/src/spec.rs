//! Settings of a bake.

use frangible::Material;
use frangible::internals::asset::RenderSurface;

use crate::USUAL_MODES;
use crate::cancel::CancelToken;
use crate::error::BakeError;
use crate::groups::Group;
use crate::shapes::{MeshSize, Shape};
use crate::supports::Support;

/// Settings of a bake.
#[derive(Clone, Debug)]
pub struct BakeSpec {
    /// Name of the asset, shown in reports.
    pub name: String,
    /// Geometry.
    pub shape: Shape,
    /// Material; only E, ν and ρ affect the modes, the other values are stored in the asset.
    pub material: Material,
    /// Element size of the analysis mesh; `None`: about 3 000 elements (5 000 for thin walls). For a solid, the size sets the number of elements
    /// of the lattice, from the volume of the solid.
    pub analysis: Option<MeshSize>,
    /// Element size of the fracture mesh; `None`: about 42 000 elements.
    pub fracture: Option<MeshSize>,
    /// Number of vibration modes of the asset, 1 to [`MOST_MODES`](crate::MOST_MODES), default [`USUAL_MODES`]. More modes make the stress around a sharp impact
    /// more accurate, and cost proportional memory and more than proportional bake time.
    pub modes: usize,
    /// Number of the lowest modes that are integrated through time during a blow, 1 or more; the others respond statically, which costs no
    /// time steps. Default `None`: determined by trial blows, as the smallest number beyond which more modes change no peak tension by 3 %
    /// under a hard blow; all modes if there are 60 or fewer.
    pub followed: Option<usize>,
    /// Random seed for the irregularity of the fracture mesh, default 1.
    pub seed: u64,
    /// Supports of the body, default none. The asset gets the modes of the supported body and the list of its supported nodes.
    pub supports: Vec<Support>,
    /// Named parts of the shape, for supports by name; default none. [`import_mesh`](crate::import_mesh) reads them from a file.
    pub groups: Vec<Group>,
    /// The authored surface, m, in the frame of the shape; stored in the asset for rendering.
    pub render: Option<RenderSurface>,
    /// Token with which another thread can cancel the bake.
    pub cancel: CancelToken,
}

impl BakeSpec {
    /// Makes a specification with default sizes, modes and seed.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape, material: Material) -> Self {
        Self {
            name: name.into(),
            shape,
            material,
            analysis: None,
            fracture: None,
            modes: USUAL_MODES,
            followed: None,
            seed: 1,
            supports: Vec::new(),
            groups: Vec::new(),
            render: None,
            cancel: CancelToken::default(),
        }
    }

    /// Makes a specification for games: a fracture mesh of about 1 500 tetrahedra and 40 modes, so that a break takes about 20 ms instead of
    /// 160. Cracks are coarser than with [`BakeSpec::new`].
    ///
    /// # Errors
    /// A shape without volume; the error names the invalid number or station.
    pub fn for_games(
        name: impl Into<String>,
        shape: Shape,
        material: Material,
    ) -> Result<Self, BakeError> {
        Ok(Self {
            fracture: Some(shape.size_for(GAME_TETS)?),
            modes: GAME_MODES,
            ..Self::new(name, shape, material)
        })
    }
}

/// Tetrahedra of a body for games, about.
const GAME_TETS: f64 = 1500.0;

/// Modes of a body for games.
const GAME_MODES: usize = 40;
