//! Access to the parts of an asset. Documented are those that a user of bodies needs; the others serve the sibling crates.

use std::sync::Arc;

use super::{
    AnalysisMesh, Asset, ConvexCell, Embedding, OuterSurface, Portion, RenderSurface, StressBounds,
};
use crate::material::Material;
use crate::mesh::{MassProperties, TetMesh};
use crate::modal::ModalBasis;

impl Asset {
    /// Name shown in reports.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Material that the modes were computed for.
    #[must_use]
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Mass, centre (the origin) and inertia of the whole body, kg, m, kg·m².
    #[must_use]
    pub fn mass(&self) -> MassProperties {
        self.mass
    }
}

/// Declares [`AssetParts`], [`AssetPartsMut`], and the conversions of an asset to and from them.
macro_rules! parts {
    ($($(#[$doc:meta])* $name:ident: $type:ty,)*) => {
        /// All parts of an asset, to make one ([`Asset::from_parts`]).
        #[derive(Clone, Debug)]
        pub struct AssetParts {
            $($(#[$doc])* pub $name: $type,)*
        }

        /// All parts of an asset, to change them in place ([`Asset::parts_mut`]).
        #[derive(Debug)]
        pub struct AssetPartsMut<'a> {
            $($(#[$doc])* pub $name: &'a mut $type,)*
        }

        #[doc(hidden)]
        impl Asset {
            /// Makes an asset of its parts, without checks; [`Asset::validate`] checks it.
            #[must_use]
            pub fn from_parts(parts: AssetParts) -> Self {
                Self { $($name: parts.$name,)* }
            }

            /// The parts of the asset.
            #[must_use]
            pub fn into_parts(self) -> AssetParts {
                AssetParts { $($name: self.$name,)* }
            }

            /// The parts of the asset, to be changed in place.
            #[must_use]
            pub fn parts_mut(&mut self) -> AssetPartsMut<'_> {
                AssetPartsMut { $($name: &mut self.$name,)* }
            }
        }
    };
}

parts! {
    /// Name shown in reports.
    name: String,
    /// Material that the modes were computed for.
    material: Material,
    /// Fine linear tetrahedra that carry cracks and fragments.
    fracture: Arc<TetMesh>,
    /// Outer faces of the fracture mesh with their smooth normals.
    surface: OuterSurface,
    /// Coarse quadratic tetrahedra that carry the modes.
    analysis: AnalysisMesh,
    /// Points of the fracture mesh, located in the analysis mesh.
    embedding: Embedding,
    /// Frequencies, shapes and stress bounds of the vibration modes.
    modes: ModalBasis,
    /// Stress bounds; if empty, they are computed when a body is made.
    bounds: StressBounds,
    /// Mass, centre (the origin) and inertia of the whole body, kg, m, kg·m².
    mass: MassProperties,
    /// Convex cells that cover the body.
    cells: Vec<ConvexCell>,
    /// Convex cell of each fracture tetrahedron.
    cell_of_tet: Vec<u32>,
    /// Nodes of the fracture mesh that are fixed by supports, ascending.
    supported: Vec<u32>,
    /// The authored surface, if there is one.
    render: Option<RenderSurface>,
    /// For a piece that may break again, its part of the broken body.
    portion: Option<Arc<Portion>>,
}

#[doc(hidden)]
impl Asset {
    /// Fine linear tetrahedra that carry cracks and fragments.
    #[must_use]
    pub fn fracture(&self) -> &Arc<TetMesh> {
        &self.fracture
    }

    /// Outer faces of the fracture mesh with their smooth normals.
    #[must_use]
    pub fn surface(&self) -> &OuterSurface {
        &self.surface
    }

    /// Coarse quadratic tetrahedra that carry the modes.
    #[must_use]
    pub fn analysis(&self) -> &AnalysisMesh {
        &self.analysis
    }

    /// Points of the fracture mesh, located in the analysis mesh.
    #[must_use]
    pub fn embedding(&self) -> &Embedding {
        &self.embedding
    }

    /// Frequencies, shapes and stress bounds of the vibration modes.
    #[must_use]
    pub fn modes(&self) -> &ModalBasis {
        &self.modes
    }

    /// Stress bounds, which rule out harmless contacts early.
    #[must_use]
    pub fn bounds(&self) -> &StressBounds {
        &self.bounds
    }

    /// Convex cells that cover the body: its collider, which is divided among the fragments.
    #[must_use]
    pub fn cells(&self) -> &[ConvexCell] {
        &self.cells
    }

    /// Convex cell of each fracture tetrahedron.
    #[must_use]
    pub fn cell_of_tet(&self) -> &[u32] {
        &self.cell_of_tet
    }

    /// Nodes of the fracture mesh that are fixed by supports, ascending; empty for a free body.
    #[must_use]
    pub fn supported(&self) -> &[u32] {
        &self.supported
    }

    /// The authored surface, used only for rendering and clipping; `None` if the surface of the fracture mesh is rendered.
    #[must_use]
    pub fn render(&self) -> Option<&RenderSurface> {
        self.render.as_ref()
    }

    /// For a piece that may break again, its part of the broken body; `None` for a baked body.
    #[must_use]
    pub fn portion(&self) -> Option<&Arc<Portion>> {
        self.portion.as_ref()
    }
}
