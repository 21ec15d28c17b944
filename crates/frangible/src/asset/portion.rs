//! Portions: the parts of a broken body that form its pieces.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::{Asset, OuterSurface};
use crate::mesh::MassProperties;
use crate::state::{BodyState, EdgeCut};

/// Labels from here on are those of a piece's neighbours.
pub(crate) const FOREIGN: u32 = 1 << 31;

/// Label of nodes that lie in none of a piece's tetrahedra.
pub(crate) const NOBODY: u32 = u32::MAX;

/// A part of a broken body, or a whole body with its cracks: its nodes and tetrahedra in the fracture mesh, and the cuts that
/// separate it from the rest.
#[derive(Debug)]
pub struct Portion {
    pub(crate) root: Arc<Asset>,
    pub(crate) generation: u32,
    pub(crate) origin: DVec3,
    pub(crate) mass: MassProperties,
    pub(crate) supported: Vec<u32>,
    pub(crate) nodes: Vec<u32>,
    pub(crate) tets: Vec<u32>,
    pub(crate) cracked: Vec<u32>,
    pub(crate) divided: Vec<u32>,
    pub(crate) rim: Vec<(u32, u32)>,
    pub(crate) next_foreign: u32,
    pub(crate) cuts: Vec<EdgeCut>,
    pub(crate) fixed: Arc<FixedPoints>,
    pub(crate) first_nodes: Vec<u32>,
    pub(crate) whole: u64,
    pub(crate) state: BodyState,
    /// Vertices of its surface, m, in its own frame.
    pub(crate) positions: Vec<Vec3>,
    pub(crate) surface: OuterSurface,
    pub(crate) trace: Trace,
}

impl Portion {
    /// Returns the asset of the baked body.
    #[must_use]
    pub fn root(&self) -> &Asset {
        &self.root
    }

    /// Returns the number of breaks since the baked body: 1 for a piece of a baked body.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// Returns the centre of mass in the frame of the fracture mesh, m, which is the origin of the portion's own frame.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Returns the mass properties about the portion's centre of mass, in its own frame.
    #[must_use]
    pub fn mass(&self) -> &MassProperties {
        &self.mass
    }

    /// Returns the portion's nodes in the fracture mesh, in ascending order.
    #[must_use]
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Returns the portion's uncut fracture tetrahedra, in ascending order; cracks can start and grow in them.
    #[must_use]
    pub fn tets(&self) -> &[u32] {
        &self.tets
    }

    /// Returns the portion's supported nodes, in ascending order.
    #[must_use]
    pub fn supported(&self) -> &[u32] {
        &self.supported
    }

    /// Returns the positions of the vertices of the portion's surface, m, in its own frame.
    #[must_use]
    pub fn surface_positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Place of a tetrahedron among [`Portion::tets`]; that of the next one where it is none of them.
    pub(crate) fn place(&self, tet: u32) -> usize {
        match self.tets.binary_search(&tet) {
            Ok(place) | Err(place) => place,
        }
    }

    /// Tetrahedra that are its own and have been cut, rising.
    pub(crate) fn cracked(&self) -> &[u32] {
        &self.cracked
    }

    /// Tetrahedra that it shares with its neighbours, rising.
    pub(crate) fn divided(&self) -> &[u32] {
        &self.divided
    }

    /// Cuts between its nodes and those of its neighbours, and among its own.
    pub(crate) fn cuts(&self) -> &[EdgeCut] {
        &self.cuts
    }

    /// Nodes of the tetrahedra that it shares which are not its own, rising, each with the label of its owner.
    pub(crate) fn rim(&self) -> &[(u32, u32)] {
        &self.rim
    }

    /// Points of its surface that stay.
    pub(crate) fn fixed(&self) -> &FixedPoints {
        &self.fixed
    }

    /// Lowest node of each part of it that its tetrahedra do not join to the others; one for a sound body.
    pub(crate) fn first_nodes(&self) -> &[u32] {
        &self.first_nodes
    }

    /// Sum of its nodes' volumes, in the unit of the mesh's index.
    pub(crate) fn whole(&self) -> u64 {
        self.whole
    }

    /// Returns true if a node is its own.
    pub(crate) fn has_node(&self, node: u32) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }

    /// Returns true if any of these nodes of a tetrahedron is its own.
    pub(crate) fn has_tet(&self, nodes: &[u32; 4]) -> bool {
        nodes.iter().any(|&v| self.has_node(v))
    }

    /// The first triangle of its surface that lies on this one of the baked body's.
    pub(crate) fn surface_triangle(&self, of_root: u32) -> Option<u32> {
        let found = self.trace.outer_of.binary_search(&of_root).ok()?;
        let before = self.trace.outer_of[..found].iter().rev();
        let same = before.take_while(|&&t| t == of_root).count();
        Some((found - same) as u32)
    }
}

/// Origin of a piece and of its surface in the baked body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    /// Label of its nodes.
    pub(crate) label: u32,
    /// Triangle of the baked body's surface that each of its outer triangles lies on, rising.
    pub(crate) outer_of: Vec<u32>,
    /// Tetrahedron in which each of its crack faces lies.
    pub(crate) inner_of: Vec<u32>,
    /// For each vertex of its surface, a node of its own beside it.
    pub(crate) anchors: Vec<u32>,
}

/// Points of a partition within faces and tetrahedra, in the frame of the fracture mesh, m: later breaks must not move them.
#[derive(Clone, Debug, Default)]
pub(crate) struct FixedPoints {
    /// Points on faces, ordered by the nodes of the face, which rise.
    pub(crate) faces: Vec<([u32; 3], DVec3)>,
    /// Points in tetrahedra, ordered by the tetrahedron.
    pub(crate) centres: Vec<(u32, DVec3)>,
}

impl FixedPoints {
    pub(crate) fn sorted(mut self) -> Self {
        self.faces.sort_unstable_by_key(|f| f.0);
        self.centres.sort_unstable_by_key(|c| c.0);
        self
    }

    /// The point on a face with three labels.
    pub(crate) fn face(&self, nodes: [u32; 3]) -> Option<DVec3> {
        let found = self.faces.binary_search_by_key(&nodes, |f| f.0);
        found.ok().map(|i| self.faces[i].1)
    }

    /// The centre of a tetrahedron with three labels or more.
    pub(crate) fn centre(&self, tet: u32) -> Option<DVec3> {
        let found = self.centres.binary_search_by_key(&tet, |c| c.0);
        found.ok().map(|i| self.centres[i].1)
    }
}
