//! Which part of a broken body a piece is.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::lists::Lists;
use super::{Breakup, FixedPoints, Trace};
use crate::asset::{Asset, OuterSurface, SurfaceWalls};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::crack::{CrackSystem, EdgeCut};
use crate::error::InputError;
use crate::fragment;
use crate::mesh::{AlongSurface, MassProperties};
use crate::outcome::{Fracture, Fragment};
use crate::prepared::Prepared;
use crate::state::BodyState;

/// A part of a body that has broken, or a whole body with its cracks: which nodes and tetrahedra of the fracture mesh are
/// its own, and what parts it from the rest.
#[derive(Debug)]
pub struct Portion {
    pub(super) root: Arc<Asset>,
    pub(crate) prepared: Arc<Prepared>,
    generation: u32,
    origin: DVec3,
    mass: MassProperties,
    supported: Vec<u32>,
    nodes: Vec<u32>,
    tets: Vec<u32>,
    cracked: Vec<u32>,
    divided: Vec<u32>,
    rim: Vec<(u32, u32)>,
    pub(super) next_foreign: u32,
    cuts: Vec<EdgeCut>,
    fixed: Arc<FixedPoints>,
    first_nodes: Vec<u32>,
    whole: u64,
    pub(super) state: BodyState,
    /// Vertices of its surface, m, in its own frame.
    pub(super) positions: Vec<Vec3>,
    pub(super) surface: OuterSurface,
    pub(super) trace: Trace,
}

impl Portion {
    /// The whole of a body, with the cracks that it has so far: for modes that feel them. `config` says how cracks end and which crumbs
    /// stay, as in the impact that left them.
    ///
    /// # Errors
    /// What [`FractureConfig::validate`] refuses.
    pub fn of_cracked(body: &Body, config: &FractureConfig) -> Result<Self, InputError> {
        config.validate()?;
        let system = CrackSystem::new(body, config, 0.0);
        let labels = fragment::label(&system, &body.prepared.index, config.crumb_share);
        let asset = &*body.asset;
        let trace = match &asset.portion {
            Some(portion) => portion.trace.clone(),
            None => Trace {
                label: 0,
                outer_of: (0..asset.surface.triangles.len() as u32).collect(),
                inner_of: Vec::new(),
                anchors: (0..asset.fracture.positions.len() as u32).collect(),
            },
        };
        let fixed = match &asset.portion {
            Some(portion) => Arc::clone(&portion.fixed),
            None => Arc::default(),
        };
        let breakup = Breakup::new(&system, labels, Vec::new(), fixed);
        let lists = Lists::of(body, &breakup, &[0]).pop().unwrap_or_default();
        let mut portion = Self::new(body, &breakup, lists, trace, body.generation());
        portion.origin = body.origin();
        portion.mass = asset.mass;
        portion.positions = asset.surface_positions().to_vec();
        portion.surface = asset.surface.clone();
        portion.surface.walls = portion.walls();
        Ok(portion)
    }

    fn new(body: &Body, breakup: &Breakup, lists: Lists, trace: Trace, generation: u32) -> Self {
        let root = match &body.asset.portion {
            Some(portion) => Arc::clone(&portion.root),
            None => Arc::clone(&body.asset),
        };
        let prepared = body.prepared.root.as_ref().unwrap_or(&body.prepared);
        let supported = root.supported.iter().copied();
        let supported = supported.filter(|v| lists.nodes.binary_search(v).is_ok());
        Self {
            supported: supported.collect(),
            whole: prepared.index.volume_of(&lists.nodes),
            prepared: Arc::clone(prepared),
            root,
            generation,
            origin: DVec3::ZERO,
            mass: body.asset.mass,
            nodes: lists.nodes,
            tets: lists.tets,
            cracked: lists.cracked,
            divided: lists.divided,
            rim: lists.rim,
            next_foreign: lists.next_foreign,
            cuts: lists.cuts,
            first_nodes: lists.first_nodes,
            fixed: Arc::clone(&breakup.fixed),
            state: lists.state,
            positions: Vec::new(),
            surface: OuterSurface::default(),
            trace,
        }
    }

    /// The body as it was baked.
    #[must_use]
    pub fn root(&self) -> &Asset {
        &self.root
    }

    /// How many breaks it comes from: 1 for a piece of a baked body.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// Its centre of mass in the frame of the fracture mesh, m: where its own frame has its origin.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Mass properties about its own centre, in its own frame.
    #[must_use]
    pub fn mass(&self) -> &MassProperties {
        &self.mass
    }

    /// Nodes of the fracture mesh that are its own, rising.
    #[must_use]
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Fracture tetrahedra that are its own and that no crack has cut, rising: where cracks can start and run.
    #[must_use]
    pub fn tets(&self) -> &[u32] {
        &self.tets
    }

    /// Nodes of its own that something outside holds, rising.
    #[must_use]
    pub fn supported(&self) -> &[u32] {
        &self.supported
    }

    /// Where the vertices of its surface are, m, in its own frame.
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

    /// Nodes of the tetrahedra that it shares which are not its own, rising, with labels that tell apart whose they are.
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

    /// The walls behind its surface: those of the baked body, which end where a crack has passed. None behind crack faces.
    fn walls(&self) -> SurfaceWalls {
        let root = &self.root.surface.walls;
        if root.thickness.is_empty() {
            return SurfaceWalls::default();
        }
        let triangles = &self.surface.triangles;
        let outer = self.trace.outer_of.len();
        let broken =
            |&t: &usize| t >= outer || self.cracked.binary_search(&self.surface.tets[t]).is_ok();
        let edges = (0..triangles.len()).filter(broken);
        let edges: Vec<u32> = edges.flat_map(|t| triangles[t]).collect();
        let along = AlongSurface::new(&self.positions, triangles);
        let distances = along.at_triangles(&along.distances(&edges, |t| t < outer));
        let inherited = |numbers: &[f32]| {
            let own = self.trace.outer_of.iter().map(|&t| numbers[t as usize]);
            own.chain(self.trace.inner_of.iter().map(|_| f32::INFINITY))
                .collect()
        };
        let mut walls = SurfaceWalls {
            thickness: inherited(&root.thickness),
            stiffening: inherited(&root.stiffening),
            margin: inherited(&root.margin),
        };
        for (margin, distance) in walls.margin.iter_mut().zip(distances) {
            *margin = margin.min(distance as f32);
        }
        walls
    }

    /// Whether a node is its own.
    pub(crate) fn has_node(&self, node: u32) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }

    /// Whether any of these nodes of a tetrahedron is its own.
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

impl Fracture {
    /// Which part of the body each wanted fragment is, for [`Body::piece`]. `body`: the one that broke. `None` for the others,
    /// and for a fracture that was not computed here.
    #[must_use]
    pub fn portions(
        &self,
        body: &Body,
        wanted: impl Fn(usize, &Fragment) -> bool,
    ) -> Vec<Option<Arc<Portion>>> {
        let mut portions: Vec<Option<Arc<Portion>>> = vec![None; self.fragments.len()];
        let Some(breakup) = &self.breakup else {
            return portions;
        };
        let all = self.fragments.iter().enumerate();
        let wanted: Vec<usize> = all
            .filter(|&(k, fragment)| wanted(k, fragment))
            .map(|(k, _)| k)
            .collect();
        let labels: Vec<u32> = wanted.iter().map(|&k| breakup.traces[k].label).collect();
        let lists = Lists::of(body, breakup, &labels);
        let edge = body.prepared.edge;
        for (k, lists) in wanted.into_iter().zip(lists) {
            let (fragment, trace) = (&self.fragments[k], breakup.traces[k].clone());
            let mut portion = Portion::new(body, breakup, lists, trace, body.generation() + 1);
            portion.origin = body.origin() + fragment.mass.centre;
            portion.mass = MassProperties {
                centre: DVec3::ZERO,
                ..fragment.mass
            };
            portion.positions = fragment.mesh.positions.clone();
            portion.surface = surface(fragment, &portion.root.surface, &portion.trace, edge);
            portion.surface.walls = portion.walls();
            portions[k] = Some(Arc::new(portion));
        }
        portions
    }
}

/// A fragment's surface as that of a body. Crack faces are rough: their radius of curvature is half an edge of the mesh.
fn surface(fragment: &Fragment, root: &OuterSurface, trace: &Trace, edge: f32) -> OuterSurface {
    let outer = trace.outer_of.iter().map(|&t| t as usize);
    let tets = outer.clone().map(|t| root.tets[t]);
    let radii = outer.map(|t| root.curvature_radius[t]);
    let rough = std::iter::repeat_n(0.5 * edge, trace.inner_of.len());
    OuterSurface {
        triangles: fragment.mesh.triangles.clone(),
        normals: fragment.mesh.normals.clone(),
        tets: tets.chain(trace.inner_of.iter().copied()).collect(),
        curvature_radius: radii.chain(rough).collect(),
        ..OuterSurface::default()
    }
}
