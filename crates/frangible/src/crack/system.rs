//! All cracks of one impact and what they have cut.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

use glam::Vec3;

use super::release::Releases;
use super::surface::CrackFrame;
use crate::asset::Asset;
use crate::config::{CrackTiming, FractureConfig};

/// No crack has fractured this tetrahedron.
pub(crate) const UNCUT: u32 = u32::MAX;

/// One crack.
pub(crate) struct Crack {
    pub(crate) frame: CrackFrame,
    /// s at the nodes it has met, m. Looked up only, never iterated.
    pub(crate) values: HashMap<u32, f32>,
    /// Fractured tetrahedra in the order they joined.
    pub(crate) elements: Vec<ElementCut>,
    /// Fracture energy spent E_f, J `[G12 Eq. 11]`.
    pub(crate) spent: f64,
    /// Strain energy available E_s, J `[G12 Eq. 12]`.
    pub(crate) available: f64,
    /// Area, m².
    pub(crate) area: f64,
    /// Largest distance of a fractured tetrahedron from the start, m.
    pub(crate) extent: f32,
    /// Its tetrahedra thinned to one per place: what releases the stress around it.
    pub(crate) sites: Vec<Site>,
    /// Where it ran into another crack (or into itself).
    pub(crate) junctions: Vec<Junction>,
}

/// A tetrahedron fractured by a crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementCut {
    pub(crate) tet: u32,
    /// s at its four nodes, m.
    pub(crate) values: [f32; 4],
    /// Unit ∇s: the crack's normal there.
    pub(crate) direction: Vec3,
    /// When it joined, s after the contact began.
    pub(crate) time: f64,
}

/// A place on a crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub(crate) position: Vec3,
    pub(crate) direction: Vec3,
    pub(crate) time: f64,
}

/// A crack's front that met a tetrahedron it may not enter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Junction {
    /// Index of the crack's own tetrahedron at the front, into [`Crack::elements`].
    pub(crate) from: u32,
    /// Whether the crack met an older part of itself.
    pub(crate) own: bool,
}

/// The front of a crack at the face of a tetrahedron it may enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Front {
    /// When it gets there, s; of instant cracks only the order counts.
    pub(crate) arrival: f64,
    pub(crate) tet: u32,
    pub(crate) crack: u32,
    /// Index into the crack's elements of the one it comes from.
    pub(crate) from: u32,
}

impl Eq for Front {}

impl Ord for Front {
    /// Reversed, so that a max-heap yields the earliest arrival, then the lowest element.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .arrival
            .total_cmp(&self.arrival)
            .then(other.tet.cmp(&self.tet))
            .then(other.crack.cmp(&self.crack))
            .then(other.from.cmp(&self.from))
    }
}

impl PartialOrd for Front {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// All cracks of one impact.
pub(crate) struct CrackSystem<'a> {
    pub(crate) asset: &'a Asset,
    pub(crate) config: &'a FractureConfig,
    pub(crate) seed: u64,
    pub(crate) cracks: Vec<Crack>,
    /// Crack that fractured each tetrahedron, or [`UNCUT`].
    pub(crate) fractured_by: Vec<u32>,
    /// Fronts on their way.
    pub(crate) fronts: BinaryHeap<Front>,
    /// Fronts that lacked energy; tried again at the next step.
    pub(crate) stalled: Vec<Front>,
    /// What has released the weak points so far.
    pub(crate) releases: Releases,
    /// Number of sites of all cracks.
    pub(crate) site_count: usize,
    /// Centroid of each fracture tetrahedron, m.
    pub(crate) centroids: Vec<Vec3>,
    /// Mean edge of the fracture mesh, m.
    pub(crate) edge: f32,
}

impl<'a> CrackSystem<'a> {
    pub(crate) fn new(asset: &'a Asset, config: &'a FractureConfig, seed: u64) -> Self {
        Self {
            asset,
            config,
            seed,
            cracks: Vec::new(),
            fractured_by: vec![UNCUT; asset.fracture.tets.len()],
            fronts: BinaryHeap::new(),
            stalled: Vec::new(),
            releases: Releases::default(),
            site_count: 0,
            centroids: (0..asset.fracture.tets.len())
                .map(|e| asset.fracture.centroid(e))
                .collect(),
            edge: asset.fracture.mean_edge(),
        }
    }

    /// Adds a fractured tetrahedron to a crack and sends the crack's front to its neighbours.
    pub(crate) fn fracture(&mut self, crack: u32, cut: ElementCut, area: f32, energy_density: f32) {
        let material = &self.asset.material;
        let tet = cut.tet as usize;
        self.fractured_by[tet] = crack;
        let c = &mut self.cracks[crack as usize];
        c.spent += f64::from(area) * material.fracture_energy;
        c.available += f64::from(area) * material.energy_depth * f64::from(energy_density);
        c.area += f64::from(area);
        let centre = self.centroids[tet];
        c.extent = c.extent.max(centre.distance(c.frame.origin));
        for (&node, &s) in self.asset.fracture.tets[tet].iter().zip(&cut.values) {
            c.values.entry(node).or_insert(s);
        }
        // Latest first: a new place is next to the latest ones.
        let apart = self.edge * self.edge;
        if c.sites
            .iter()
            .rev()
            .all(|s| s.position.distance_squared(centre) > apart)
        {
            c.sites.push(Site {
                position: centre,
                direction: cut.direction,
                time: cut.time,
            });
            self.site_count += 1;
        }
        let from = c.elements.len() as u32;
        c.elements.push(cut);
        for &neighbour in &self.asset.fracture.neighbours[tet] {
            if neighbour == crate::mesh::NO_NEIGHBOUR
                || self.fractured_by[neighbour as usize] == crack
            {
                continue;
            }
            let distance = centre.distance(self.centroids[neighbour as usize]);
            let arrival = match self.config.timing {
                CrackTiming::TimeResolved { speed, .. } => {
                    cut.time + f64::from(distance) * (1.0 / (speed * material.rayleigh_speed()))
                }
                // Breadth-first: neighbours of the earlier tetrahedron first [G12 §5.2.2].
                CrackTiming::Instant => f64::from(from),
            };
            self.fronts.push(Front {
                arrival,
                tet: neighbour,
                crack,
                from,
            });
        }
    }
}
