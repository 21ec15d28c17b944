//! Data found once for all bodies of a kind, or for a piece: search trees, free surfaces, and the tables of the bounds.

use std::sync::{Arc, OnceLock};

use glam::Vec3;

use super::MeshIndex;
use super::thickness::thickness;
use crate::asset::{Asset, Portion, StressBounds};
use crate::bounds::{PerImpulse, PerNewton, Reaches, quadratic_modulus};
use crate::mesh::{Boundary, RenderIndex, TriangleTree};
use crate::modal::ModalBasis;
use crate::stress::{Places, Skin};

/// Data derived from an asset that every impact needs.
#[derive(Debug)]
pub(crate) struct Prepared {
    /// Prepared data of the body as it was baked, where this is a piece of it.
    pub(crate) root: Option<Arc<Prepared>>,
    /// Adjacency of the fracture mesh.
    pub(crate) index: Arc<MeshIndex>,
    /// Over the triangles of the outer surface.
    pub(crate) surface: TriangleTree,
    /// Index for drawing pieces; none of a piece, which uses that of its root.
    pub(crate) render: Option<RenderIndex>,
    /// Free surfaces: flaws and walls.
    pub(crate) skin: Skin,
    /// Stress bounds of the clusters.
    pub(crate) bounds: StressBounds,
    /// Stress bounds of the whole body: stress and gradient, one number per mode.
    pub(crate) whole: (Vec<f32>, Vec<f32>),
    /// 1/√λ_i of every mode, s.
    pub(crate) periods: Vec<f32>,
    /// Largest amplitude of each mode under an impulse.
    pub(crate) reaches: Reaches,
    /// Largest stress under an impulse, by place and force.
    pub(crate) per_impulse: PerImpulse,
    /// Σ φ_i dm of every mode, √kg: what a held body's weight pushes; empty for a free one, where it is zero.
    pub(crate) weight: Vec<Vec3>,
    /// k of the bounds' quadratic term, Pa.
    pub(crate) quadratic_modulus: f32,
    /// Largest stress under a newton anywhere; computed when it is first asked for.
    pub(crate) per_newton: OnceLock<PerNewton>,
    /// Centroid of each fracture tetrahedron, m.
    pub(crate) centroids: Arc<[Vec3]>,
    /// Local thickness of the body as it was baked at each of these centroids, m.
    pub(crate) thickness: Arc<[f32]>,
    /// Mean edge of the fracture mesh, m.
    pub(crate) edge: f32,
    /// Longest edge of the fracture mesh, m.
    pub(crate) longest_edge: f32,
}

impl Prepared {
    /// Prepares a body as it was baked.
    pub(crate) fn of_whole(asset: &Asset) -> Self {
        let modes = &asset.modes;
        let skin = Skin::of(asset);
        let bounds = if asset.bounds.is_empty() {
            StressBounds::with_skin(asset, &skin, None).0
        } else {
            asset.bounds.clone()
        };
        let whole = bounds.root(modes.count());
        let reaches = Reaches::new(modes);
        let surface = TriangleTree::new(&asset.fracture.positions, &asset.surface.triangles);
        let edge = asset.fracture.mean_edge();
        let boundary = Boundary {
            tree: &surface,
            positions: &asset.fracture.positions,
            triangles: &asset.surface.triangles,
        };
        let render = asset.render.as_ref();
        let centroids = (0..asset.fracture.tets.len()).map(|e| asset.fracture.centroid(e));
        let centroids: Arc<[Vec3]> = centroids.collect();
        let thickness = local_thickness(asset, &skin, &centroids);
        Self {
            root: None,
            index: Arc::new(MeshIndex::new(asset)),
            render: render.map(|render| RenderIndex::new(render, &boundary, edge)),
            surface,
            per_impulse: PerImpulse::new(asset, &whole.0, &reaches),
            reaches,
            whole,
            bounds,
            skin,
            weight: weight(asset),
            periods: periods(modes),
            per_newton: OnceLock::new(),
            quadratic_modulus: quadratic_modulus(&asset.material),
            thickness,
            centroids,
            edge,
            longest_edge: asset.fracture.longest_edge(),
        }
    }

    /// Prepares a piece, whose modes lack only the peak of their stress. `root`: the body as it was baked; `places`: those of its flaws.
    pub(crate) fn of_piece(
        asset: &mut Asset,
        portion: &Portion,
        root: &Arc<Self>,
        places: &Places,
    ) -> Self {
        let skin = Skin::of_piece(asset, portion, &root.skin);
        let (bounds, peak_stress) = StressBounds::with_skin(asset, &skin, Some(places));
        let whole = bounds.root(asset.modes.count());
        asset.modes.peak_stress = peak_stress;
        let reaches = Reaches::new(&asset.modes);
        Self {
            root: Some(Arc::clone(root)),
            index: Arc::clone(&root.index),
            surface: TriangleTree::new(asset.surface_positions(), &asset.surface.triangles),
            render: None,
            skin,
            bounds,
            per_impulse: PerImpulse::new(asset, &whole.0, &reaches),
            reaches,
            whole,
            periods: periods(&asset.modes),
            weight: weight(asset),
            quadratic_modulus: root.quadratic_modulus,
            per_newton: OnceLock::new(),
            centroids: Arc::clone(&root.centroids),
            thickness: Arc::clone(&root.thickness),
            edge: root.edge,
            longest_edge: root.longest_edge,
        }
    }
}

/// Local thickness at each fracture tetrahedron, m; in a wall the distance between its faces.
fn local_thickness(asset: &Asset, skin: &Skin, centroids: &[Vec3]) -> Arc<[f32]> {
    let mut thickness = thickness(&asset.fracture, centroids);
    // Bodies of the core's own tests may have no modes to lie in.
    let embedded = asset.embedding.tets.len();
    for (e, thickness) in thickness.iter_mut().enumerate().take(embedded) {
        if let Some(wall) = skin.wall(asset, e) {
            *thickness = wall.thickness();
        }
    }
    thickness.into()
}

/// 1/√λ_i of every mode, s.
fn periods(modes: &ModalBasis) -> Vec<f32> {
    let eigenvalues = modes.eigenvalues.iter();
    eigenvalues.map(|l| (1.0 / l.sqrt()) as f32).collect()
}

/// Σ φ_i dm of every mode of a held body. Of a piece the divided tetrahedra are left out and the sum scaled to its mass.
fn weight(asset: &Asset) -> Vec<Vec3> {
    let modes = asset.modes.count();
    if !asset.is_supported() {
        return Vec::new();
    }
    let mut mass_of_node = vec![0.0_f32; asset.analysis.nodes.len()];
    let masses = asset
        .tets()
        .map(|tet| asset.material.density * asset.fracture.volume(tet));
    let scale = match asset.portion {
        Some(_) => asset.mass.mass / masses.clone().sum::<f64>(),
        None => 1.0,
    };
    for (mass, point) in masses.zip(&asset.embedding.tets) {
        let mass = (mass * scale) as f32;
        let element = asset.analysis.elements[point.element as usize];
        for (&node, share) in element.iter().zip(point.shape_values()) {
            mass_of_node[node as usize] += mass * share;
        }
    }
    let mut sums = vec![Vec3::ZERO; modes];
    for (node, &mass) in mass_of_node.iter().enumerate() {
        asset.modes.add_shape(node, mass, &mut sums);
    }
    sums
}
