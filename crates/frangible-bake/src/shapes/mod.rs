//! Shapes of bodies and their meshes. Boxes and bodies of revolution are triangulated sheets extruded through the thickness, coarse and
//! regular for the modes, fine and irregular for the cracks. Thin walls from files are meshed alike, along one of their faces. Other solids
//! are filled by the lattice mesher of `frangible-mesh`.

mod block;
mod pane;
mod profile;
mod ready;
mod revolution;
pub(crate) mod solid;
pub(crate) mod tets;
pub(crate) mod wall;

pub use frangible_mesh::READY_SHAPES;
pub use pane::PaneShape;
pub use profile::Station;
pub use solid::SolidShape;
pub use tets::{AnalysisChoice, TetShape};
pub use wall::WallShape;

use crate::error::{BakeError, positive};
use crate::mesh::BodyMesh;
use profile::Profile;

/// Most tetrahedra a mesh may have.
const LIMIT: usize = 2_000_000;
/// Tetrahedra of a default analysis mesh: 10–18 thousand unknowns.
const ANALYSIS_TETS: f64 = 3000.0;
/// Tetrahedra of a default fracture mesh: elements about as long as a wall is thick.
pub(crate) const FRACTURE_TETS: f64 = 42_000.0;

/// Resolution of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSize {
    /// Edge length of the elements, m. Halving it gives four to eight times as many elements.
    pub edge: f64,
    /// Number of elements through the thickness; 0 derives it from `edge`, at least one.
    pub layers: usize,
}

/// The shape of a body, in metres.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A box from the origin to `size`, m; put the thinnest side last.
    Box {
        /// Sides along x, y, z, m.
        size: [f64; 3],
    },
    /// A pane with round corners, bent or flat.
    Pane(PaneShape),
    /// A body of revolution about the z-axis; the profile runs from the axis at the bottom to the rim.
    Revolution {
        /// Stations; the first has r = 0 for both points.
        profile: Vec<Station>,
    },
    /// A general solid: a closed mesh or a signed distance function.
    Solid(SolidShape),
    /// Tetrahedra from a file, used unchanged.
    Tets(TetShape),
    /// A thin wall: a closed mesh with two parallel faces, or a sheet with a thickness.
    Wall(WallShape),
}

impl Shape {
    /// A block of any proportions, m.
    #[must_use]
    pub const fn block(size: [f64; 3]) -> Self {
        Self::Box { size }
    }

    /// Makes a pane or plate of `width` × `depth` × `thickness`, m.
    #[must_use]
    pub const fn plate(width: f64, depth: f64, thickness: f64) -> Self {
        Self::Box {
            size: [width, depth, thickness],
        }
    }

    /// Makes a square rod along x, m.
    #[must_use]
    pub const fn rod(length: f64, side: f64) -> Self {
        Self::Box {
            size: [length, side, side],
        }
    }

    /// Drinking glass: Ø 70–76 mm, 105 mm high, wall 2 mm, base 6 mm.
    #[must_use]
    pub fn drinking_glass() -> Self {
        Self::Revolution {
            profile: ready::drinking_glass(),
        }
    }

    /// Round bowl: Ø 154 mm, 59 mm high, wall 4 mm.
    #[must_use]
    pub fn bowl() -> Self {
        Self::Revolution {
            profile: ready::bowl(),
        }
    }

    /// Bottle of 0.33 l: Ø 61 mm, 230 mm high, wall 3 mm.
    #[must_use]
    pub fn bottle() -> Self {
        Self::Revolution {
            profile: ready::bottle(),
        }
    }

    /// Vase: 210 mm high, Ø 100 mm at the belly, wall 4 mm.
    #[must_use]
    pub fn vase() -> Self {
        Self::Revolution {
            profile: ready::vase(),
        }
    }

    /// Dinner plate: Ø 240 mm, 5 mm thick, rim 22 mm high.
    #[must_use]
    pub fn dinner_plate() -> Self {
        Self::Revolution {
            profile: ready::dinner_plate(),
        }
    }

    /// Returns a predefined solid by its name in [`READY_SHAPES`], such as a rabbit or a piggy bank, in metres with z up.
    #[must_use]
    pub fn ready(name: &str) -> Option<Self> {
        solid::ready(name).map(Self::Solid)
    }

    /// Returns the volume of the exact shape, m³; for a solid, computed on a grid to about one per cent.
    ///
    /// # Errors
    /// A value or a station of the profile is invalid.
    pub fn volume(&self) -> Result<f64, BakeError> {
        match self {
            Self::Box { size } => block::validate(*size).map(|()| size.iter().product()),
            Self::Pane(pane) => pane.volume(),
            Self::Revolution { profile } => Ok(Profile::new(profile)?.area_and_volume().1),
            Self::Solid(shape) => solid::volume(shape),
            Self::Tets(shape) => Ok(shape.body.volume()),
            Self::Wall(shape) => Ok(shape.wall.volume()),
        }
    }

    /// Returns the element size of the default analysis mesh (quadratic, about 3 000 elements).
    ///
    /// # Errors
    /// A value or a station of the profile is invalid.
    pub fn analysis_size(&self) -> Result<MeshSize, BakeError> {
        if let Self::Wall(shape) = self {
            return Ok(wall::analysis_size(shape));
        }
        self.size_for(ANALYSIS_TETS)
    }

    /// Returns the element size of the default fracture mesh (linear, about 42 000 elements).
    ///
    /// # Errors
    /// A value or a station of the profile is invalid.
    pub fn fracture_size(&self) -> Result<MeshSize, BakeError> {
        self.size_for(FRACTURE_TETS)
    }

    /// Returns the largest element size, to a few per cent, that gives at least `tets` tetrahedra; for a solid, the size for about that
    /// many.
    ///
    /// # Errors
    /// A value or a station of the profile is invalid.
    pub fn size_for(&self, tets: f64) -> Result<MeshSize, BakeError> {
        if let Self::Solid(shape) = self {
            return Ok(solid::size_for(solid::volume(shape)?, tets));
        }
        if let Self::Tets(shape) = self {
            return Ok(solid::size_for(shape.body.volume(), tets));
        }
        if let Self::Wall(shape) = self {
            positive("the number of tetrahedra wanted", tets)?;
            return Ok(wall::size_for(shape, tets));
        }
        let mut edge = self.volume()?.cbrt();
        while self.estimate(MeshSize { edge, layers: 0 })? < tets {
            edge *= 0.98;
        }
        Ok(MeshSize { edge, layers: 0 })
    }

    fn estimate(&self, size: MeshSize) -> Result<f64, BakeError> {
        Ok(match self {
            Self::Box { size: sides } | Self::Pane(PaneShape { size: sides, .. }) => {
                block::estimate(*sides, size)
            }
            Self::Revolution { profile } => revolution::estimate(&Profile::new(profile)?, size),
            Self::Solid(shape) => solid::estimate(solid::volume(shape)?, size),
            Self::Tets(shape) => shape.body.tets.len() as f64,
            Self::Wall(shape) => wall::estimate(shape, size),
        })
    }

    /// Generates the regular mesh for the modal analysis.
    ///
    /// # Errors
    /// The size or profile cannot be meshed.
    pub fn analysis_mesh(&self, size: MeshSize) -> Result<BodyMesh, BakeError> {
        self.check(size)?;
        match self {
            Self::Box { size: sides } => block::regular(*sides, size, &block::straight),
            Self::Pane(pane) => block::regular(pane.size, size, &|p| pane.place(p)),
            Self::Revolution { profile } => revolution::mesh(&Profile::new(profile)?, size, None),
            Self::Solid(shape) => {
                solid::mesh(shape, Some(size.edge), None, &mut solid::unwatched).map(|m| m.0)
            }
            Self::Tets(shape) => tets::mesh(shape),
            Self::Wall(shape) => wall::analysis_mesh(shape, size)?.ok_or(BakeError::Fold {
                thickness: shape.wall.thickness(),
                edge: size.edge,
            }),
        }
    }

    /// Generates the irregular fracture mesh, which depends only on the seed.
    ///
    /// # Errors
    /// The size or profile cannot be meshed.
    pub fn fracture_mesh(&self, size: MeshSize, seed: u64) -> Result<BodyMesh, BakeError> {
        self.check(size)?;
        match self {
            Self::Box { size: sides } => block::irregular(*sides, size, seed, &block::straight),
            Self::Pane(pane) => block::irregular(pane.size, size, seed, &|p| pane.place(p)),
            Self::Revolution { profile } => {
                revolution::mesh(&Profile::new(profile)?, size, Some(seed))
            }
            Self::Solid(shape) => {
                solid::mesh(shape, Some(size.edge), Some(seed), &mut solid::unwatched).map(|m| m.0)
            }
            Self::Tets(shape) => tets::mesh(shape),
            Self::Wall(shape) => wall::mesh(shape, size, seed),
        }
    }

    fn check(&self, size: MeshSize) -> Result<(), BakeError> {
        self.volume()?;
        positive("the element edge, in m,", size.edge)?;
        let tets = self.estimate(size)?;
        if tets > LIMIT as f64 {
            return Err(BakeError::TooFine {
                edge: size.edge,
                tets: tets as usize,
                limit: LIMIT,
            });
        }
        Ok(())
    }
}
