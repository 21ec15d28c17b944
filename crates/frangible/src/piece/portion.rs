//! Creates the portions of broken and cracked bodies.

use std::sync::Arc;

use glam::DVec3;

use super::lists::Lists;
use crate::asset::{OuterSurface, Portion, SurfaceWalls, Trace};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::crack::CrackSystem;
use crate::error::InputError;
use crate::fragment::{self, Breakup};
use crate::mesh::{AlongSurface, MassProperties};
use crate::outcome::{Fracture, Fragment};

impl Portion {
    /// Creates the portion of a whole body with its present cracks, for recomputing its modes with them.
    ///
    /// `config` determines how cracks end and which crumbs are kept; use the settings of the impact that caused the cracks.
    ///
    /// # Errors
    /// The errors of [`FractureConfig::validate`].
    pub fn of_cracked(body: &Body, config: &FractureConfig) -> Result<Self, InputError> {
        config.validate()?;
        let system = CrackSystem::new(body, config, 0.0);
        let labels = fragment::label(&system, &body.prepared.index, config.crumb_share, None);
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
        let supported = root.supported.iter().copied();
        let supported = supported.filter(|v| lists.nodes.binary_search(v).is_ok());
        Self {
            supported: supported.collect(),
            whole: body.root().index.volume_of(&lists.nodes),
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
}

impl Fracture {
    /// Returns the portion of each requested fragment, for [`Body::piece`]; `None` for other fragments, and for a fracture that was not
    /// computed by this crate. `body` is the body that broke.
    #[doc(hidden)]
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
