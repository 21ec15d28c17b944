//! Distances between bodies.

use glam::DVec3;

use super::Parts;
use super::open::apart;
use crate::InputMesh;
use crate::winding::FaceTree;

/// Places of a body from which the way to another is looked for; of more triangles every second, third, … is.
const MOST_PLACES: usize = 20_000;

/// Steps to and fro between two bodies: on convex ones they end at the nearest places.
const STEPS: usize = 40;

/// Gap between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Numbers of the two bodies.
    pub bodies: [usize; 2],
    /// Width, in the mesh's unit; 0 where they touch.
    pub width: f64,
}

/// A body, to measure from.
pub(super) struct Outline {
    bounds: [DVec3; 2],
    tree: FaceTree,
    places: Vec<DVec3>,
}

impl Outline {
    /// Of a body that consists of these parts.
    pub(super) fn new(parts: &Parts, mesh: &InputMesh, body: &[usize]) -> Self {
        let members = || body.iter().flat_map(|&part| &parts.list[part].triangles);
        let corners = |t: u32| mesh.triangles[t as usize].map(|v| mesh.positions[v as usize]);
        let faces: Vec<(u32, [DVec3; 3])> = members().map(|&(t, _)| (t, corners(t))).collect();
        let stride = faces.len().div_ceil(MOST_PLACES).max(1);
        let places = faces.iter().step_by(stride);
        let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        Self {
            bounds: body.iter().fold(nothing, |[low, high], &part| {
                let [l, h] = parts.list[part].bounds;
                [low.min(l), high.max(h)]
            }),
            places: places
                .flat_map(|(_, [a, b, c])| [*a, (*a + *b + *c) / 3.0])
                .collect(),
            tree: FaceTree::new(&faces),
        }
    }

    /// Distance to another body, if it is below a bound.
    fn distance(&self, other: &Self, mut least: f64) -> f64 {
        for (one, two) in [(self, other), (other, self)] {
            for &start in &one.places {
                let Some(mut there) = two.tree.nearest(start, least) else {
                    continue;
                };
                least = least.min(start.distance(there));
                for _ in 0..STEPS {
                    // A little more than the bound, which the way back equals.
                    let within = least * (1.0 + 1e-9);
                    let Some(here) = one.tree.nearest(there, within) else {
                        break;
                    };
                    let Some(next) = two.tree.nearest(here, within) else {
                        break;
                    };
                    let width = here.distance(next);
                    let is_still = width >= least * (1.0 - 1e-9);
                    least = least.min(width);
                    there = next;
                    if is_still {
                        break;
                    }
                }
            }
        }
        least
    }
}

/// The narrowest gap of each body to another, in the order of the bodies.
pub(super) fn narrowest(outlines: &[Outline]) -> Vec<Gap> {
    let mut gaps = Vec::new();
    for (i, one) in outlines.iter().enumerate() {
        let mut others: Vec<(f64, usize)> = outlines
            .iter()
            .enumerate()
            .filter(|&(j, _)| j != i)
            .map(|(j, other)| (apart(&one.bounds, &other.bounds).max(0.0), j))
            .collect();
        others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut best: Option<Gap> = None;
        for (boxes, j) in others {
            let least = best.map_or(f64::INFINITY, |gap: Gap| gap.width);
            if boxes >= least {
                break;
            }
            let width = one.distance(&outlines[j], least);
            if width < least {
                best = Some(Gap {
                    bodies: [i, j],
                    width,
                });
            }
        }
        gaps.extend(best);
    }
    gaps
}

/// The gap that keeps the bodies from being one when all of at most this width are bridged, or none: the narrowest between those that can be
/// reached from the first and the rest.
pub(super) fn unbridged(outlines: &[Outline], width: f64) -> Option<Gap> {
    let mut gaps: Vec<Gap> = (0..outlines.len())
        .map(|j| Gap {
            bodies: [0, j],
            width: f64::INFINITY,
        })
        .collect();
    let mut waiting: Vec<usize> = (1..outlines.len()).collect();
    let mut reached = 0;
    while !waiting.is_empty() {
        for &j in &waiting {
            let gap = &mut gaps[j];
            let boxes = apart(&outlines[reached].bounds, &outlines[j].bounds);
            if boxes < gap.width {
                let found = outlines[reached].distance(&outlines[j], gap.width);
                if found < gap.width {
                    (gap.bodies[0], gap.width) = (reached, found);
                }
            }
        }
        let next = (0..waiting.len())
            .min_by(|&a, &b| gaps[waiting[a]].width.total_cmp(&gaps[waiting[b]].width))?;
        reached = waiting.remove(next);
        if gaps[reached].width > width {
            return Some(gaps[reached]);
        }
    }
    None
}
