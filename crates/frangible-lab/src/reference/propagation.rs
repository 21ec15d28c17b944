//! Algorithm 2: one fracture surface runs through the mesh `[G12 §5.2]`.

use std::collections::VecDeque;

use frangible::glam::DVec3;

use crate::reference::body::Solid;
use crate::reference::options::EnergyTest;
use crate::reference::stress::stress;
use crate::reference::surface::{Surface, area};

/// A crack: the elements of one fracture surface.
#[derive(Clone, Debug, Default)]
pub struct Crack {
    /// Time step at which it started, from 0.
    pub step: usize,
    /// Time at which it started, in steps: at that step's end, or between the two.
    pub time: f64,
    /// Its elements in the order they joined.
    pub elements: Vec<Element>,
    /// E_f, J.
    pub spent: f64,
    /// E_s, J.
    pub available: f64,
    /// Area of one side, m².
    pub area: f64,
    /// Relative change of the stress at its start that would choose other axes for its surface.
    pub frame_margin: f64,
    /// Every look at a neighbour, in order.
    pub visits: Vec<Visit>,
}

/// An element cut by a crack.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Number of the tetrahedron.
    pub tet: u32,
    /// s at its nodes, m.
    pub values: [f64; 4],
    /// Relative change of the stress at the crack's start that would alter the sign of each.
    pub sign_margins: [f64; 4],
}

/// A look at a neighbour that was not yet marked.
#[derive(Clone, Copy, Debug)]
pub struct Visit {
    /// Number of the tetrahedron.
    pub tet: u32,
    /// Number of elements in the crack at that time.
    pub elements: usize,
    /// True if it joined.
    pub joined: bool,
    /// Relative change, of an energy or of the stress that set the surface, that would have decided otherwise.
    pub margin: f64,
}

/// Intersection of an element with a surface.
struct Crossing {
    element: Element,
    crossed: bool,
    margin: f64,
    area: f64,
    /// η, J/m³.
    energy: f64,
}

/// Runs a crack from `start`; `marked`: number of the crack that each element is marked with, if any.
pub(crate) fn propagate(
    solid: &Solid,
    u: &[DVec3],
    surface: &Surface,
    start: usize,
    id: u32,
    test: EnergyTest,
    marked: &mut [Option<u32>],
) -> Crack {
    let (toughness, depth) = (solid.material.fracture_energy, solid.material.energy_depth);
    let mut crack = Crack {
        frame_margin: surface.margin,
        ..Crack::default()
    };
    let mut set = VecDeque::from([start]); // line 2
    let mut waiting = vec![false; marked.len()];
    let add = |crack: &mut Crack, marked: &mut [Option<u32>], e: usize, c: &Crossing| {
        crack.spent += c.area * toughness; // line 6, Eq. 11
        crack.available += c.area * depth * c.energy; // line 7, Eq. 12
        crack.area += c.area;
        marked[e] = Some(id); // line 8
        crack.elements.push(c.element);
    };
    if test == EnergyTest::Text {
        // Of the text the sums are over all of 𝓔; as printed, over those taken out of the queue.
        add(
            &mut crack,
            marked,
            start,
            &crossing(solid, u, surface, start),
        );
    }
    while let Some(e) = set.pop_front() {
        // lines 5, 9
        if test == EnergyTest::AsPrinted {
            add(&mut crack, marked, e, &crossing(solid, u, surface, e));
        }
        for n in solid.neighbours(e) {
            // line 10
            if marked[n].is_some() || waiting[n] {
                continue;
            }
            let c = crossing(solid, u, surface, n);
            let mut visit = Visit {
                tet: n as u32,
                elements: crack.elements.len(),
                joined: false,
                margin: c.margin,
            };
            if c.crossed {
                let (cost, gain) = match test {
                    EnergyTest::Text => (
                        crack.spent + c.area * toughness,
                        crack.available + c.area * depth * c.energy,
                    ),
                    EnergyTest::AsPrinted => (crack.spent, crack.available),
                };
                let margin = (cost - gain).abs() / cost.max(gain);
                visit.joined = cost < gain; // line 11
                visit.margin = if visit.joined {
                    margin.min(c.margin)
                } else {
                    margin
                };
            }
            crack.visits.push(visit);
            if visit.joined {
                set.push_back(n); // line 12
                match test {
                    EnergyTest::Text => add(&mut crack, marked, n, &c),
                    EnergyTest::AsPrinted => waiting[n] = true,
                }
            }
        }
    }
    crack
}

/// Intersects an element with S. It is crossed if it has a node at s < 0 and one at s ≥ 0 `[G12 §5.2.2]`.
fn crossing(solid: &Solid, u: &[DVec3], surface: &Surface, e: usize) -> Crossing {
    let x = solid.corners(e);
    let values = x.map(|p| surface.s(p));
    let sign_margins = std::array::from_fn(|k| surface.margin_of(x[k], values[k]));
    let (_, energy) = stress(solid.material, &solid.gradient(u, e), solid.strain);
    let side = |negative: bool| (0..4).filter(move |&k| (values[k] < 0.0) == negative);
    let crossed = side(true).count() > 0 && side(false).count() > 0;
    // Uncrossed when all nodes of one side change over; crossed when one does.
    let farthest = |negative: bool| side(negative).fold(0.0_f64, |m, k| m.max(sign_margins[k]));
    let margin = if crossed {
        farthest(true).min(farthest(false))
    } else {
        sign_margins.iter().copied().fold(f64::INFINITY, f64::min)
    };
    Crossing {
        element: Element {
            tet: e as u32,
            values,
            sign_margins,
        },
        crossed,
        margin,
        area: area(x, values),
        energy,
    }
}
