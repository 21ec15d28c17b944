//! One crack: its cuts, its surface and its fronts.

use std::cmp::Ordering;

use glam::Vec3;

use super::arrival::Source;
use super::sites::Sites;
use super::surface::CrackFrame;
use crate::state::{BodyState, OldCrack, OldCut};
use crate::tips::Tip;

/// One crack.
pub(crate) struct Crack {
    pub(crate) frame: CrackFrame,
    /// Tetrahedron where it started.
    pub(crate) start: u32,
    /// Fractured tetrahedra in the order they joined.
    pub(crate) elements: Vec<ElementCut>,
    /// Number of them, from the first, that were cut before the piece came about: these cuts are settled
    /// ([`Portion`](crate::piece::Portion)).
    pub(crate) settled: usize,
    /// Fracture energy spent E_f, J `[G12 Eq. 11]`.
    pub(crate) spent: f64,
    /// Strain energy available E_s, J `[G12 Eq. 12]`.
    pub(crate) available: f64,
    /// Area, m².
    pub(crate) area: f64,
    /// Length of its front where it may still grow, m.
    pub(super) front: f64,
    /// Depth of the layer that feeds it while it is no larger than the flaw that it started from, m.
    pub(super) flaw: f64,
    /// True if that flaw lies on a free surface.
    pub(super) at_surface: bool,
    /// Its tetrahedra thinned to one per place, which release the stress around it.
    pub(crate) sites: Sites,
    /// Fronts that ran into another crack (or into itself).
    pub(crate) junctions: Vec<Junction>,
    /// Places where it forked, m, and the times, s.
    pub(crate) forks: Vec<(Vec3, f64)>,
    /// The section of the body in which it lies, once it is large.
    pub(super) section: Option<u32>,
    /// Middle, m, and area, m², of its cuts, from the first, as far as a section has asked for them.
    pub(super) polygons: Vec<(Vec3, f32)>,
    /// Area up to which no section is looked for, m².
    pub(super) unsought: f64,
    /// Tip that feeds its front, if it was there before this impact.
    pub(crate) tip: Option<Tip>,
    /// Number of its tetrahedra, from the first, that were cut before this impact.
    pub(super) restored: usize,
}

impl Crack {
    /// A crack without tetrahedra yet.
    pub(crate) fn new(frame: CrackFrame, start: u32) -> Self {
        Self {
            frame,
            start,
            elements: Vec::new(),
            settled: 0,
            spent: 0.0,
            available: 0.0,
            area: 0.0,
            front: 0.0,
            flaw: 0.0,
            at_surface: false,
            sites: Sites::default(),
            junctions: Vec::new(),
            forks: Vec::new(),
            section: None,
            polygons: Vec::new(),
            unsought: 0.0,
            tip: None,
            restored: 0,
        }
    }

    /// Area with that from before this impact, m².
    pub(super) fn whole_area(&self) -> f64 {
        self.area + self.tip.map_or(0.0, |tip| tip.area())
    }

    /// Half-width, m, of an ellipse with its area and this half-length, m; of half an ellipse at a free surface.
    pub(super) fn half_width(&self, half_length: f32) -> f32 {
        let part = if self.at_surface { 2.0 } else { 1.0 };
        part * self.whole_area() as f32 / (std::f32::consts::PI * half_length)
    }

    /// Its cuts that are not settled.
    pub(super) fn unsettled(&self) -> &[ElementCut] {
        &self.elements[self.settled.min(self.elements.len())..]
    }

    /// The crack as a body remembers it.
    fn left(&self) -> OldCrack {
        let cut = |e: &ElementCut| OldCut {
            tet: e.tet,
            values: e.values,
            direction: e.direction,
        };
        let junction = |j: &Junction| (j.from, j.own);
        OldCrack {
            start: self.start,
            origin: self.frame.origin,
            normal: self.frame.normal,
            cuts: self.elements.iter().map(cut).collect(),
            settled: self.settled as u32,
            junctions: self.junctions.iter().map(junction).collect(),
        }
    }
}

impl BodyState {
    /// These cracks as a body remembers them.
    pub(crate) fn of(cracks: &[Crack]) -> Self {
        Self {
            cracks: cracks.iter().map(Crack::left).collect(),
        }
    }
}

/// A tetrahedron fractured by a crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementCut {
    pub(crate) tet: u32,
    /// s at its four nodes, m.
    pub(crate) values: [f32; 4],
    /// Unit ∇s: the crack's normal there.
    pub(crate) direction: Vec3,
    /// Outward normal of the face of the wall that the crack opens from; zero in a solid, and of a crack that was there before.
    pub(crate) opens: Vec3,
    /// [Radius of its mirror](super::marks::CrackMark), m; infinite of a crack that leaves none, and where one starts.
    pub(crate) mirror: f32,
    /// Time at which it joined, s after the contact began.
    pub(crate) time: f64,
}

/// A crack's front that met a tetrahedron it may not enter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Junction {
    /// Index of the crack's own tetrahedron at the front, into [`Crack::elements`].
    pub(crate) from: u32,
    /// True if the crack met an older part of itself.
    pub(crate) own: bool,
}

/// The front of a crack at the face of a tetrahedron it may enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Front {
    /// Time of arrival, s; of instant cracks only the order counts.
    pub(crate) arrival: f64,
    pub(crate) tet: u32,
    pub(crate) crack: u32,
    /// Index into the crack's elements of the one it comes from.
    pub(crate) from: u32,
    /// Energy that all cracks together had no more left for it when it was last asked, J; zero where it was not asked, or lacked nothing
    /// but stress.
    pub(crate) lacks: f64,
    /// Source that it comes from in a straight line; [`Source::WAITED`] if it waited, and comes from where it is.
    pub(crate) source: Source,
    /// Area that it would have cut when the stress last did not pay for it, m²; zero where it was not asked.
    pub(crate) refused: f32,
    /// Index into [`CrackSystem::waiting`](super::system::CrackSystem::waiting), if it has ever waited.
    pub(crate) waiting: Option<u32>,
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
