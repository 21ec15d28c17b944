//! All cracks of one impact and their cuts.

use std::collections::BinaryHeap;

use glam::Vec3;

use super::arrival::{Entered, Source};
use super::extents::Extents;
use super::ledger::{Ledger, Unpaid};
use super::node_values::NodeValues;
use super::release::Releases;
use super::rest::Rest;
use super::section::Section;
use super::single::{Crack, ElementCut, Front, Junction};
use super::sites::Site;
use super::surface::CrackFrame;
use super::waiting::Waiting;
use crate::asset::Asset;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::fields::Resistance;
use crate::state::{OldCrack, crossing_area, crossing_middle, nominal_area};
use crate::tips::{Tip, front_limit, is_inside};

/// Mark of a tetrahedron that no crack has fractured.
pub(crate) const UNCUT: u32 = u32::MAX;

/// Mark of a tetrahedron that belongs to another piece than the one that cracks: no front goes there.
pub(crate) const ELSEWHERE: u32 = u32::MAX - 1;

/// The ledger is spent when it lacks the energy of this area in squares of the mean edge: a fiftieth of what a crack cuts of a
/// tetrahedron on average.
const SPENT: f64 = 0.01;

/// All cracks of one impact.
pub(crate) struct CrackSystem<'a> {
    pub(crate) asset: &'a Asset,
    pub(crate) config: &'a FractureConfig,
    pub(crate) resistance: &'a Resistance,
    pub(crate) seed: u64,
    pub(crate) cracks: Vec<Crack>,
    /// Sections in which large cracks lie.
    pub(super) sections: Vec<Section>,
    /// s of steered cracks at the nodes that they have met.
    pub(crate) values: NodeValues,
    /// Crack that fractured each tetrahedron, or [`UNCUT`].
    pub(crate) fractured_by: Vec<u32>,
    /// Place of each fractured tetrahedron in its crack's list.
    pub(super) cut_at: Vec<u32>,
    /// Local thickness of the body at each tetrahedron, m.
    pub(super) thickness: &'a [f32],
    /// Fronts on their way.
    pub(crate) fronts: BinaryHeap<Front>,
    /// Fronts that lacked energy; tried again at the next step.
    pub(crate) stalled: Vec<Front>,
    /// Data of the fronts that have ever waited, by [`Front::waiting`].
    pub(super) waiting: Vec<Waiting>,
    /// Fronts of the cracks from earlier impacts, asleep until the stress can move them.
    pub(crate) dormant: Vec<Front>,
    /// Stress below which none of them moves, Pa.
    front_limit: f32,
    /// Number of cracks from earlier impacts; they come first.
    pub(crate) old_cracks: usize,
    /// Number of the others that branched off another one at a fork.
    pub(crate) forks: usize,
    /// Area of all cracks that this impact added, m².
    pub(crate) area: f64,
    /// Release of the weak points so far.
    pub(crate) releases: Releases,
    /// Energy that the ledger lacked for cracks that were about to start.
    pub(crate) unpaid: Unpaid,
    /// Pieces that have come to rest.
    pub(crate) rest: Rest,
    /// Position and size of each crack.
    pub(crate) extents: Extents,
    /// Centroid of each fracture tetrahedron, m.
    pub(crate) centroids: &'a [Vec3],
    /// Mean edge of the fracture mesh, m.
    pub(crate) edge: f32,
    /// Ledger of the energy that all cracks together may spend.
    pub(crate) ledger: Ledger,
    /// True if a crack that starts leaves dice.
    pub(super) dices: bool,
    /// Place, m, and time, s, at which a crack has reached the tension of a wall that dices, and its tetrahedron.
    pub(crate) gone: Option<(Vec3, f64, u32)>,
}

impl<'a> CrackSystem<'a> {
    /// A system without cracks yet; all that come may together spend `budget` J.
    pub(crate) fn new(body: &'a Body, config: &'a FractureConfig, budget: f64) -> Self {
        let asset = &*body.asset;
        let mut system = Self {
            dormant: Vec::new(),
            front_limit: front_limit(
                &body.asset.material,
                body.resistance.toughness.least,
                &body.tips,
            ),
            old_cracks: 0,
            forks: 0,
            area: 0.0,
            asset,
            config,
            resistance: &body.resistance,
            seed: body.seed(),
            ledger: Ledger::new(!config.is_paper(), budget),
            cracks: Vec::new(),
            sections: Vec::new(),
            values: NodeValues::new(asset.fracture.positions.len()),
            fractured_by: match &asset.portion {
                None => vec![UNCUT; asset.fracture.tets.len()],
                Some(portion) => {
                    let mut by = vec![ELSEWHERE; asset.fracture.tets.len()];
                    let own = portion.tets().iter();
                    own.for_each(|&tet| by[tet as usize] = UNCUT);
                    by
                }
            },
            cut_at: vec![0; asset.fracture.tets.len()],
            thickness: &body.prepared.thickness,
            fronts: BinaryHeap::new(),
            stalled: Vec::new(),
            waiting: Vec::new(),
            releases: Releases::default(),
            unpaid: Unpaid::default(),
            rest: Rest::default(),
            extents: Extents::new(body.prepared.edge, asset.material.rayleigh_speed())
                .no_longer_than(body.shear_lag()),
            centroids: &body.prepared.centroids,
            edge: body.prepared.edge,
            dices: !config.is_paper() && body.dicing_wall().is_some(),
            gone: None,
        };
        for (old, &tip) in body.state().cracks.iter().zip(&body.tips) {
            system.restore(old, (!config.is_paper()).then_some(tip));
        }
        system
    }

    /// A crack from an earlier impact: its energy is spent, its fronts sleep.
    fn restore(&mut self, old: &OldCrack, tip: Option<Tip>) {
        let material = &self.asset.material;
        let id = self.cracks.len() as u32;
        self.old_cracks += 1;
        let frame = CrackFrame::new(
            old.origin,
            old.normal,
            material.roughness_amplitude,
            material.roughness_wavelength,
            self.seed,
            old.start,
        );
        self.add(frame, old.start);
        self.cracks[id as usize].settled = old.settled as usize;
        for cut in &old.cuts {
            let cut = ElementCut {
                tet: cut.tet,
                values: cut.values,
                direction: cut.direction,
                opens: Vec3::ZERO,
                mirror: f32::INFINITY,
                time: f64::NEG_INFINITY,
            };
            self.join(id, cut, 0.0);
        }
        for from in 0..old.cuts.len() {
            let cut = self.cracks[id as usize].elements[from];
            let mut ahead: Vec<u32> = self.ahead(id, &cut).map(|(_, tet)| tet).collect();
            if from < old.settled as usize {
                // What it met before is settled, too.
                ahead.retain(|&n| self.fractured_by[n as usize] == UNCUT);
            }
            self.dormant.extend(ahead.into_iter().map(|tet| Front {
                source: Source::WAITED,
                arrival: 0.0,
                tet,
                crack: id,
                from: from as u32,
                lacks: 0.0,
                refused: 0.0,
                waiting: None,
            }));
        }
        let crack = &mut self.cracks[id as usize];
        (crack.tip, crack.restored) = (tip, old.cuts.len());
        let junction = |&(from, own): &(u32, bool)| Junction { from, own };
        self.cracks[id as usize].junctions = old.junctions.iter().map(junction).collect();
    }

    /// Tetrahedra that the cracks cut in this impact, and the times, s: crack after crack, those that did not move left out.
    pub(crate) fn arrivals(&self) -> Vec<Vec<(u32, f64)>> {
        let new = |crack: &Crack| -> Vec<(u32, f64)> {
            let cuts = crack.elements[crack.restored..].iter();
            cuts.map(|cut| (cut.tet, cut.time)).collect()
        };
        let cracks = self.cracks.iter().map(new);
        cracks.filter(|crack| !crack.is_empty()).collect()
    }

    /// Neighbours of a tetrahedron, and the faces before them, that this crack does not cut yet, in the same body, and that it crosses if it goes on
    /// there. A steered crack crosses the shared face; a planar one any part of the neighbour `[G12 §5.2.2]`. `cut`: its cut of the tetrahedron.
    fn ahead(&self, crack: u32, cut: &ElementCut) -> impl Iterator<Item = (usize, u32)> + use<'a> {
        let mesh = &self.asset.fracture;
        let nodes = &mesh.tets[cut.tet as usize];
        let frame = &self.cracks[crack as usize].frame;
        let crosses = |face: usize, neighbour: u32| {
            let mut sides = [false; 2];
            for k in (0..4).filter(|&k| k != face) {
                sides[usize::from(cut.values[k] < 0.0)] = true;
            }
            if self.config.is_paper() && sides != [true; 2] {
                let nodes_beyond = mesh.tets[neighbour as usize].iter();
                for &node in nodes_beyond.filter(|node| !nodes.contains(node)) {
                    let s = frame.planar(mesh.positions[node as usize]);
                    sides[usize::from(s < 0.0)] = true;
                }
            }
            sides == [true; 2]
        };
        let mut ahead = mesh.neighbours[cut.tet as usize].map(Some);
        for (face, slot) in ahead.iter_mut().enumerate() {
            *slot = slot.filter(|&n| {
                n != crate::mesh::NO_NEIGHBOUR
                    && ![crack, ELSEWHERE].contains(&self.fractured_by[n as usize])
                    && crosses(face, n)
            });
        }
        let faces = ahead.into_iter().enumerate();
        faces.filter_map(|(face, tet)| Some((face, tet?)))
    }

    /// Wakes the old fronts when there can be stress enough to move them.
    pub(crate) fn wake(&mut self, stress_bound: f32) {
        if !self.dormant.is_empty() && stress_bound > self.front_limit {
            self.stalled.append(&mut self.dormant);
        }
    }

    /// Returns true if the piece of an unfractured tetrahedron is at rest. Its first node tells which piece that is: only where a crack ends do its
    /// nodes lie in two pieces.
    #[inline]
    pub(crate) fn rests(&self, tet: u32, now: f64) -> bool {
        !self.rest.is_empty()
            && self
                .rest
                .has(self.asset.fracture.tets[tet as usize][0], now)
    }

    /// Returns true if nothing can happen in a tetrahedron any more: a crack has fractured it, or its piece is at rest.
    #[inline]
    pub(crate) fn is_over(&self, tet: u32, now: f64) -> bool {
        self.fractured_by[tet as usize] != UNCUT || self.rests(tet, now)
    }

    /// Returns true if no front is on its way or waits for energy.
    pub(crate) fn is_quiet(&self) -> bool {
        self.fronts.is_empty() && self.stalled.is_empty()
    }

    /// Numbers of the tetrahedra that all cracks have fractured, and of their junctions: the cuts follow from these.
    pub(crate) fn progress(&self) -> [usize; 2] {
        let of = |crack: &Crack| [crack.elements.len(), crack.junctions.len()];
        let add = |[a, b]: [usize; 2], [c, d]: [usize; 2]| [a + c, b + d];
        self.cracks.iter().map(of).fold([0; 2], add)
    }

    /// Returns true if the ledger has nothing left to speak of: no crack runs any more.
    pub(crate) fn is_spent(&self) -> bool {
        self.gone.is_some() || self.ledger.is_spent_to(self.least_cost())
    }

    /// A crack has reached the tension of a wall that dices: no other matters any more.
    pub(super) fn let_go(&mut self, tet: u32, place: Vec3, time: f64) {
        self.gone.get_or_insert((place, time, tet));
    }

    /// Energy, J, below which nothing to speak of can be paid for.
    fn least_cost(&self) -> f64 {
        SPENT * f64::from(self.edge * self.edge) * self.resistance.toughness.least
    }

    /// Returns true if the ledger may have the energy to start a crack at a weak point, by its place among them.
    pub(crate) fn may_pay(&self, place: u32) -> bool {
        self.ledger
            .has(self.unpaid.of(place).max(self.least_cost()))
    }

    /// Area of a crack in a tetrahedron, m²: that of its smooth surface, for which toughness is measured. A planar crack counts its roughness
    /// `[G12 Eq. 11]`.
    pub(super) fn area(&self, x: &[Vec3; 4], values: &[f32; 4], direction: Vec3) -> f32 {
        match self.config.is_paper() {
            true => crossing_area(x, values),
            false => nominal_area(x, values, direction),
        }
    }

    /// Fracture energy of this area, m², in a tetrahedron, J.
    pub(crate) fn cost(&self, tet: u32, area: f32) -> f64 {
        f64::from(area) * self.resistance.toughness.of(tet)
    }

    /// Depth of the layer that feeds an old crack's front with the strain energy of the tension across it, m; none where the
    /// front is fed as that of a new crack.
    pub(crate) fn tip_depth(&self, front: &Front) -> Option<f64> {
        let crack = &self.cracks[front.crack as usize];
        let tip = crack.tip?;
        // A face of the piece that the crack parted is no front.
        let from = front.from as usize;
        let sharp = from >= crack.restored || is_inside(self.asset, crack.elements[from].tet);
        sharp.then(|| tip.depth(crack.area))
    }

    /// A crack's front ran into what is cut already, its own crack or another.
    pub(crate) fn meet(&mut self, front: &Front, own: bool) {
        let crack = &mut self.cracks[front.crack as usize];
        crack.junctions.push(Junction {
            from: front.from,
            own,
        });
    }

    /// Adds a fractured tetrahedron to a crack, whose area sets so much energy free, J, and sends the crack's front to its
    /// neighbours. `entered`: the tetrahedron as the front entered it.
    pub(super) fn fracture(
        &mut self,
        crack: u32,
        cut: ElementCut,
        entered: &Entered,
        area: f32,
        gain: f64,
    ) {
        let material = &self.asset.material;
        let cost = self.cost(cut.tet, area);
        self.ledger.spend(cost);
        let c = &mut self.cracks[crack as usize];
        c.spent += cost;
        c.available += gain;
        self.area += f64::from(area);
        self.join(crack, cut, area);
        let from = self.cracks[crack as usize].elements.len() as u32 - 1;
        for (face, neighbour) in self.ahead(crack, &cut) {
            let (arrival, source) = match self.config.crack_speed() {
                Some(speed) => {
                    let speed = speed * material.rayleigh_speed();
                    self.leaves(crack, &cut, entered, face, speed)
                }
                // Breadth-first: neighbours of the earlier tetrahedron first [G12 §5.2.2].
                None => (f64::from(from), Source::WAITED),
            };
            self.fronts.push(Front {
                arrival,
                source,
                tet: neighbour,
                crack,
                from,
                lacks: 0.0,
                refused: 0.0,
                waiting: None,
            });
        }
    }

    /// Adds a crack without tetrahedra yet, which starts in this one.
    pub(crate) fn add(&mut self, frame: CrackFrame, start: u32) {
        self.extents.start(frame.origin);
        self.cracks.push(Crack::new(frame, start));
    }

    /// Adds a fractured tetrahedron to a crack.
    fn join(&mut self, crack: u32, cut: ElementCut, area: f32) {
        let tet = cut.tet as usize;
        self.move_front(crack, &cut);
        self.fractured_by[tet] = crack;
        self.cut_at[tet] = self.cracks[crack as usize].elements.len() as u32;
        let c = &mut self.cracks[crack as usize];
        c.area += f64::from(area);
        let centre = self.centroids[tet];
        if let Some(k) = c.section {
            let middle = crossing_middle(&self.asset.fracture.corners(tet), &cut.values);
            self.sections[k as usize].cut(middle, cut.direction, area);
        }
        self.extents.grow(crack as usize, centre, cut.time);
        // The surface of a planar crack is the same everywhere.
        if !self.config.is_paper() {
            for (&node, &s) in self.asset.fracture.tets[tet].iter().zip(&cut.values) {
                self.values.keep(crack, node, s);
            }
        }
        // The modes know what is settled: it releases nothing more.
        if c.elements.len() >= c.settled && !c.sites.any_within(self.edge, centre) {
            c.sites.push(Site {
                position: centre,
                direction: cut.direction,
                time: cut.time,
            });
        }
        c.elements.push(cut);
    }
}
