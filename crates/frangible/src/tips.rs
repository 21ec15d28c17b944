//! Fronts of existing cracks (an extension of the paper): a cracked body is weaker at its crack fronts.
//!
//! The energy for the growth of an existing crack of length a is not the strain energy of a layer γ (Eq. 12) but the energy released by its
//! opening, `G = π a σ² / E'` per area (Griffith 1921), where σ is the tension across the crack plane without the crack. This is the energy
//! of a layer of depth 2πa. The length is the area of the crack divided by the length of its front, which is a good approximation for all
//! shapes: an edge crack and a crack across a plate have `K = 1.12` and `1.00 σ√(πa)`, a penny-shaped crack of radius R has `a = R/2` and
//! `K = 0.90 σ√(πa)`.
//!
//! Modes that include the crack (those of a piece, or of a body reanalysed with its cracks) resolve part of its stress
//! concentration: ahead of the front, the mean over a distance H is `σ√(1 + 2a/H)` (Novozhilov 1969), where H is the resolution of the
//! elements. Hence the depth `2πa / (1 + 2a/H)`.
//!
//! In a wall, the membrane tension acts fully, and the bending tension with the factor `(1+ν) / 3(3+ν)` (Kirchhoff plate; Zehnder and
//! Viz 2005).

use glam::Vec3;

use crate::asset::Asset;
use crate::material::Material;
use crate::mesh::{EDGES, FACES, NO_NEIGHBOUR};
use crate::state::{BodyState, Cuts, OldCrack, OldCut, nominal_area};
use crate::stress::MARGIN;

/// H over the edge of the analysis' cells. Chosen by measurement: in a bent bar (`frangible-bake/tests/fronts.rs`, 3000 elements,
/// crack a fifth and a third of its depth) the front then gets 0.3 and 0.4 of the energy that the modes lose; with half a cell 0.13 and 0.15.
const RESOLVED: f64 = 2.0;

/// A crack has a section from this area on, in squares of the body's thickness where it starts.
pub(crate) const LARGE: f64 = 0.1;

/// Largest factor of the stress intensity of an edge crack in a section whose stress stays below a bound: F_t + 1.5 F_b at the largest share that
/// counts. Under stresses of at most σ, N ≤ σ A and 6 M / H ≤ 1.5 σ A.
pub(crate) const SECTION: f64 = 330.0;

/// Data of an existing crack for the growth of its front.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tip {
    /// Area, m².
    area: f64,
    /// Length of the front, m; 0 without a front.
    front: f64,
    /// Factor by which the section that the crack lies in may raise the stress at the front.
    section: f64,
    /// Resolution H, m; infinite if the modes do not include the crack.
    resolution: f64,
}

impl Tip {
    /// No front.
    pub(crate) const NONE: Self = Self {
        area: 0.0,
        front: 0.0,
        section: 1.0,
        resolution: f64::INFINITY,
    };

    /// Area, m².
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// Returns the depth of the layer whose strain energy, from the tension across the crack, drives its front, m, after the crack has grown by
    /// this area, m².
    pub(crate) fn depth(&self, grown: f64) -> f64 {
        if self.front <= 0.0 {
            return 0.0;
        }
        let length = (self.area + grown) / self.front;
        std::f64::consts::TAU * length / (1.0 + 2.0 * length / self.resolution)
    }
}

/// The front of an existing crack of a body ([`Body::crack_fronts`](crate::Body::crack_fronts)).
#[derive(Clone, Debug, PartialEq)]
pub struct CrackFront {
    /// Length a of the crack: its area divided by the length of its front, m.
    pub length: f64,
    /// Critical tension across the crack for growth at the material's toughness, Pa, in terms of the stress computed from the body's modes:
    /// Griffith's value, or more if the modes include the crack and resolve part of its stress concentration.
    pub strength: f64,
    /// Fracture tetrahedra ahead of the front, with the crack normal at each.
    pub ahead: Vec<(u32, Vec3)>,
}

/// The old cracks of a body, in the order of its state.
///
/// `room`: thickness of the body at a tetrahedron where cracks may have sections, m.
pub(crate) fn tips(
    asset: &Asset,
    state: &BodyState,
    room: impl Fn(u32) -> Option<f32>,
) -> Vec<Tip> {
    if state.cracks.is_empty() {
        return Vec::new();
    }
    let uncut = Uncut::new(asset, state);
    let resolution = RESOLVED * cell_edge(asset);
    let tip = |crack: &OldCrack| {
        let mut tip = Tip::NONE;
        if crack.settled > 0 {
            tip.resolution = resolution;
        }
        for cut in uncut.inside(crack) {
            let x = asset.fracture.corners(cut.tet as usize);
            tip.area += f64::from(nominal_area(&x, &cut.values, cut.direction));
            tip.front += uncut.ahead(cut).map(|(_, length)| length).sum::<f64>();
        }
        if let Some(room) = room(crack.start).map(f64::from)
            && tip.area > LARGE * room * room
        {
            tip.section = SECTION;
        }
        tip
    };
    state.cracks.iter().map(tip).collect()
}

/// The fronts of a body's cracks, in the order of its state; cracks without one are left out.
pub(crate) fn fronts(asset: &Asset, state: &BodyState, tips: &[Tip]) -> Vec<CrackFront> {
    let uncut = Uncut::new(asset, state);
    let material = &asset.material;
    let mut fronts = Vec::new();
    for (crack, tip) in state.cracks.iter().zip(tips) {
        if tip.front <= 0.0 {
            continue;
        }
        let cuts = uncut.inside(crack);
        let ahead = cuts.flat_map(|cut| uncut.ahead(cut).map(|(n, _)| (n, cut.direction)));
        fronts.push(CrackFront {
            length: tip.area / tip.front,
            strength: tip_limit(material, material.fracture_energy, tip.depth(0.0)),
            ahead: ahead.collect(),
        });
    }
    fronts
}

/// Parts of a body that no crack has cut yet.
struct Uncut<'a> {
    asset: &'a Asset,
    /// True for fracture tetrahedra that are the body's own, and whole.
    tets: Vec<bool>,
    /// Cuts that a piece has had since it came about.
    settled: Cuts,
}

impl<'a> Uncut<'a> {
    fn new(asset: &'a Asset, state: &BodyState) -> Self {
        let mesh = &asset.fracture;
        let mut tets = vec![asset.portion.is_none(); mesh.tets.len()];
        let own = asset.portion.iter().flat_map(|p| p.tets());
        own.for_each(|&e| tets[e as usize] = true);
        for cut in state.cracks.iter().flat_map(|crack| &crack.cuts) {
            tets[cut.tet as usize] = false;
        }
        let settled = asset.portion.as_ref().map_or(&[][..], |p| p.cuts());
        Self {
            asset,
            tets,
            settled: Cuts::of_list(settled, mesh.positions.len()),
        }
    }

    /// Cuts of a crack within the body: a face of a piece is no crack in it, and a cut that a crumb healed is none any more.
    fn inside<'b>(&'b self, crack: &'b OldCrack) -> impl Iterator<Item = &'b OldCut> {
        let is_cut = |tet: u32| {
            let nodes = self.asset.fracture.tets[tet as usize];
            let mut edges = EDGES.iter();
            edges.any(|&[i, j]| self.settled.get(nodes[i], nodes[j]).is_some())
        };
        let inside = move |tet: u32| is_inside(self.asset, tet) && is_cut(tet);
        let cuts = crack.cuts.iter().enumerate();
        cuts.filter_map(move |(i, cut)| {
            (i >= crack.settled as usize || inside(cut.tet)).then_some(cut)
        })
    }

    /// Whole tetrahedra that the crack would enter from one that it has cut, and the length of its front there, m.
    fn ahead(&self, cut: &OldCut) -> impl Iterator<Item = (u32, f64)> {
        let mesh = &self.asset.fracture;
        let x = mesh.corners(cut.tet as usize);
        let faces = FACES.iter().zip(mesh.neighbours[cut.tet as usize]);
        faces.filter_map(move |(face, n)| {
            if n == NO_NEIGHBOUR || !self.tets[n as usize] {
                return None;
            }
            let (x, s) = (face.map(|i| x[i]), face.map(|i| cut.values[i]));
            let length = f64::from(crossing_length(&x, &s));
            (length > 0.0).then_some((n, length))
        })
    }
}

/// Returns true if all nodes of a tetrahedron belong to the body.
pub(crate) fn is_inside(asset: &Asset, tet: u32) -> bool {
    let nodes = &asset.fracture.tets[tet as usize];
    asset
        .portion
        .as_ref()
        .is_none_or(|portion| nodes.iter().all(|&v| portion.has_node(v)))
}

/// Length of the line on which s changes sign in a triangle, m.
pub(crate) fn crossing_length(x: &[Vec3; 3], s: &[f32; 3]) -> f32 {
    let mut ends = [Vec3::ZERO; 2];
    let mut count = 0;
    for [i, j] in [[0, 1], [1, 2], [2, 0]] {
        if (s[i] < 0.0) != (s[j] < 0.0) && count < 2 {
            ends[count] = x[i] + (x[j] - x[i]) * (s[i] / (s[i] - s[j]));
            count += 1;
        }
    }
    ends[0].distance(ends[1])
}

/// Edge of a cube that six of the analysis' elements fill, m.
fn cell_edge(asset: &Asset) -> f64 {
    let analysis = &asset.analysis;
    let volume = |element: &[u32; 10]| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| analysis.nodes[element[k] as usize].as_dvec3());
        (b - a).cross(c - a).dot(d - a).abs() / 6.0
    };
    let whole: f64 = analysis.elements.iter().map(volume).sum();
    libm::cbrt(6.0 * whole / analysis.elements.len().max(1) as f64)
}

/// Least tension that moves a front fed from this depth, m, Pa.
fn tip_limit(material: &Material, least_fracture_energy: f64, depth: f64) -> f64 {
    (2.0 * material.contact_modulus() * least_fracture_energy / depth).sqrt()
}

/// No front of these cracks moves where toughness is at least `least`, J/m², at a stress whose every principal value is below this, Pa: of the
/// strain energy density η ≤ (3 + 6|ν|) σ² / 2E it needs γ η > G_c, or what its [`Tip`] asks for.
pub(crate) fn front_limit(material: &Material, least: f64, tips: &[Tip]) -> f32 {
    let share = 3.0 + 6.0 * material.poisson_ratio.abs();
    let energy_density = least / material.energy_depth;
    let layer = (2.0 * material.youngs_modulus * energy_density / share).sqrt();
    let tips = tips
        .iter()
        .map(|tip| tip_limit(material, least, tip.depth(0.0)) / tip.section);
    tips.fold(layer, f64::min) as f32 * (1.0 - MARGIN)
}
