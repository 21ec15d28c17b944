//! Baked assets: the immutable data of a kind of object.

mod access;
mod bounds;
mod embedding;
mod file;
mod half;
mod portion;
mod rescale;
mod validate;

use std::sync::Arc;

use glam::Vec3;

use crate::material::Material;
use crate::mesh::{MassProperties, TetMesh};
use crate::modal::ModalBasis;

pub use crate::mesh::{
    Blending, Image, ImageKind, Placement, RenderMaterial, RenderSurface, Texture, TextureSlot,
    Wrap, linear_color,
};
pub use access::{AssetParts, AssetPartsMut};
pub use bounds::StressBounds;
pub(crate) use embedding::carriers;
#[doc(hidden)]
pub use embedding::each_row;
pub use embedding::{EmbeddedPoint, Embedding};
#[doc(hidden)]
pub use file::seal;
pub use file::{AssetFileError, FORMAT_VERSION, SaveOptions};
pub use portion::Portion;
pub(crate) use portion::{FOREIGN, FixedPoints, NOBODY, Trace};
pub use rescale::{RescaleError, SMALLEST_CURVATURE_RADIUS, scaled, with_material};
pub(crate) use validate::{analysis, embedded, modes};

/// The baked data of one kind of object. Share it (`Arc`) among all bodies of that kind.
///
/// All positions are in the **body frame**: metres, origin at the centre of mass.
///
/// A piece that can break again has its own asset, which shares the fracture mesh of its parent body; [`Asset::portion`] describes the
/// differences.
#[derive(Clone, Debug)]
pub struct Asset {
    /// Name shown in reports.
    pub(crate) name: String,
    /// Material that the modes were computed for.
    pub(crate) material: Material,
    /// Fine linear tetrahedra that carry cracks and fragments.
    pub(crate) fracture: Arc<TetMesh>,
    /// Outer faces of the fracture mesh with their smooth normals.
    pub(crate) surface: OuterSurface,
    /// Coarse quadratic tetrahedra that carry the modes.
    pub(crate) analysis: AnalysisMesh,
    /// Points of the fracture mesh, located in the analysis mesh.
    pub(crate) embedding: Embedding,
    /// Frequencies, shapes and stress bounds of the vibration modes.
    pub(crate) modes: ModalBasis,
    /// Stress bounds, which rule out harmless contacts early; if empty, they are computed when a body is made.
    pub(crate) bounds: StressBounds,
    /// Mass, centre (the origin) and inertia of the whole body, kg, m, kg·m².
    pub(crate) mass: MassProperties,
    /// Convex cells that cover the body: its collider, which is divided among the fragments.
    pub(crate) cells: Vec<ConvexCell>,
    /// Convex cell of each fracture tetrahedron: one index into [`Asset::cells`] per tetrahedron.
    pub(crate) cell_of_tet: Vec<u32>,
    /// Nodes of the fracture mesh that are fixed by supports, ascending; empty for a free body. The modes are those of the supported body,
    /// and a fragment with such a node stays in place.
    pub(crate) supported: Vec<u32>,
    /// The authored surface, used only for rendering and clipping, never for physics. `None` if the surface of the fracture mesh is
    /// rendered.
    pub(crate) render: Option<RenderSurface>,
    /// For a piece that may break again, its part of the broken body; `None` for a baked body. A piece keeps the broken
    /// body's fracture mesh, in that body's frame; its surface has vertices of its own, in the piece's frame
    /// ([`Asset::surface_positions`]); [`Embedding::tets`] and [`StressBounds::cluster_of_tet`] have an entry for each of
    /// [`Portion::tets`], [`Embedding::nodes`] for each vertex of the surface; cells are empty.
    pub(crate) portion: Option<Arc<Portion>>,
}

impl Asset {
    /// Returns true if the body has supports, such as a pane in its frame or a shelf in a wall.
    #[must_use]
    pub fn is_supported(&self) -> bool {
        !self.supported.is_empty()
    }

    /// Radius of the ball of the body's volume, m.
    pub(crate) fn ball_radius(&self) -> f64 {
        libm::cbrt(self.mass.volume * 0.75 / std::f64::consts::PI)
    }

    /// Returns the baked asset: the asset itself, or for a piece the asset of the baked body it comes from.
    #[doc(hidden)]
    #[must_use]
    pub fn root(&self) -> &Self {
        match &self.portion {
            Some(portion) => portion.root(),
            None => self,
        }
    }

    /// Returns the positions of the vertices of [`Asset::surface`], m, in the body frame.
    #[doc(hidden)]
    #[must_use]
    pub fn surface_positions(&self) -> &[Vec3] {
        match &self.portion {
            Some(portion) => portion.surface_positions(),
            None => &self.fracture.positions,
        }
    }

    /// Returns the index of a fracture tetrahedron in per-tetrahedron lists of the body: its number in a baked body, its position in
    /// [`Portion::tets`] in a piece.
    #[doc(hidden)]
    #[must_use]
    pub fn place(&self, tet: usize) -> usize {
        match &self.portion {
            Some(portion) => portion.place(tet as u32),
            None => tet,
        }
    }

    /// Returns the centroid of a fracture tetrahedron, located in the analysis mesh. In a piece, `tet` must be in [`Portion::tets`].
    #[doc(hidden)]
    #[must_use]
    pub fn embedded_tet(&self, tet: usize) -> &EmbeddedPoint {
        &self.embedding.tets[self.place(tet)]
    }

    /// Fracture tetrahedra, by their [places](Self::place).
    pub(crate) fn tets(&self) -> impl Iterator<Item = usize> + Clone {
        let of_piece = self.portion.iter().flat_map(|p| p.tets()).copied();
        let all = match self.portion {
            Some(_) => 0,
            None => self.fracture.tets.len(),
        };
        (0..all).chain(of_piece.map(|t| t as usize))
    }
}

/// Outer boundary of the fracture mesh, oriented outwards.
#[derive(Clone, Debug, Default)]
pub struct OuterSurface {
    /// Node indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Tetrahedron behind each triangle.
    pub tets: Vec<u32>,
    /// Unit normals at the three corners: smooth except at sharp edges.
    pub normals: Vec<[Vec3; 3]>,
    /// Radius of curvature of each triangle for contacts, m; infinite if flat.
    pub curvature_radius: Vec<f32>,
    /// Thin walls behind the triangles.
    pub walls: SurfaceWalls,
}

/// Thin walls behind the outer surface, for the local stress under a contact that the modes do not resolve (`near_field`). Each list has
/// one number per surface triangle; all lists are empty for a body without walls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceWalls {
    /// Thickness of the wall, m; infinite if there is no wall.
    pub thickness: Vec<f32>,
    /// Stiffening of the wall by its curvature against bending waves of all directions, 1/m²: the mean over the angle θ of
    /// (κ₁ sin²θ + κ₂ cos²θ)², κ₁ and κ₂ the principal curvatures of the wall's middle surface. 1/R² of a dome, 3/(8R²) of a
    /// tube, 0 of a flat wall.
    pub stiffening: Vec<f32>,
    /// Distance along the wall to its nearest edge, m: its end, a support, a fold, or a change of thickness by a third; infinite without an
    /// edge.
    pub margin: Vec<f32>,
}

impl SurfaceWalls {
    /// Returns true if there is no wall anywhere.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.thickness.is_empty() && self.stiffening.is_empty() && self.margin.is_empty()
    }

    /// Returns the wall behind a triangle of the surface, if there is one.
    #[must_use]
    pub fn at(&self, triangle: u32) -> Option<SurfaceWall> {
        let i = triangle as usize;
        let thickness = *self.thickness.get(i)?;
        thickness.is_finite().then(|| SurfaceWall {
            thickness: f64::from(thickness),
            stiffening: f64::from(self.stiffening[i]),
            margin: f64::from(self.margin[i]),
        })
    }
}

/// The wall behind one triangle of the surface: the numbers of [`SurfaceWalls`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceWall {
    /// Thickness, m.
    pub thickness: f64,
    /// Stiffening by curvature, 1/m².
    pub stiffening: f64,
    /// Distance to the wall's nearest edge, m.
    pub margin: f64,
}

/// Quadratic tetrahedra with straight edges: four corners, then mid-edge nodes in the order
/// 01, 12, 02, 03, 13, 23.
#[derive(Clone, Debug, Default)]
pub struct AnalysisMesh {
    /// Node positions, m.
    pub nodes: Vec<Vec3>,
    /// Ten node indices per element.
    pub elements: Vec<[u32; 10]>,
    /// Gradients of the four barycentric coordinates of each element, 1/m.
    pub barycentric_gradients: Vec<[Vec3; 4]>,
}

/// A convex part of the body for collision.
#[derive(Clone, Debug, Default)]
pub struct ConvexCell {
    /// Points whose convex hull is the part, m, body frame.
    pub points: Vec<Vec3>,
}
