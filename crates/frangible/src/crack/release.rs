//! Release waves (Mott 1947; beyond the paper): a new free surface unloads the material around it at wave speed.
//!
//! At a point x and time t every crack that has a fractured tetrahedron e' with
//! `|x − x_e'| < min(c_R (t − t_e'), κ a)` takes away the stress across it: σ ← P σ P, P = I − n nᵀ, n the crack's
//! normal at the nearest such tetrahedron, a the crack's present length. In crack order: projections do not commute.
//!
//! A crack's tetrahedra are thinned to *sites* about one mean edge apart, the first of each place: some ten tetrahedra
//! lie in one such place, and the difference in distance is below what the mesh resolves.
//!
//! Both limits only grow with time, so what has released a point once releases it for good. A point therefore looks at
//! each fractured tetrahedron once: it keeps the nearest one that has released it and, of those still to come, only
//! the ones that no nearer one will precede. The product of all its projections is kept until something arrives.

use std::ops::Range;

use glam::{Mat3, Vec3};

use super::suspects::Suspect;
use super::system::{CrackSystem, Growth};
use crate::config::CrackTiming;
use crate::stress::{MARGIN, STRIDE, Symmetric3, lane};

/// Rounding of what is left, relative to the whole stress.
const ROUNDING: f32 = 1e-5;

/// What has released a point of one crack near it.
#[derive(Clone, Copy, Debug)]
struct Seen {
    crack: u32,
    /// Nearest site that has, or [`NONE`].
    site: u32,
    /// Its distance, m; infinite without one.
    distance: f32,
    /// How many of its sites are pending.
    pending: u32,
}

/// No site.
const NONE: u32 = u32::MAX;

/// A site whose wave is on its way, or that lies beyond its crack's reach; of one crack, nearer means later.
#[derive(Clone, Copy, Debug)]
struct Pending {
    crack: u32,
    site: u32,
    /// m.
    distance: f32,
    /// s.
    arrival: f64,
}

/// What a point knows of all cracks.
#[derive(Clone, Debug)]
struct Point {
    /// Cracks near it, by number.
    seen: Vec<Seen>,
    pending: Vec<Pending>,
    /// P₁ P₂ … of the cracks that have released it, if any has.
    projection: Option<Mat3>,
    /// Nothing arrives before this time, s …
    next: f64,
    /// … as long as the cracks have grown this many times.
    growths: usize,
    /// Batch of steps that `held` is about, under this projection.
    held_in: Option<usize>,
    /// Bit k: at step k of the batch what is left stays below the strength.
    held: u8,
}

/// Memory of the points that have asked, by their place among the weak points.
#[derive(Default)]
pub(crate) struct Releases {
    points: Vec<Point>,
}

impl Releases {
    /// Whether what is left of a suspect's stress at a step may pass its strength, Pa; a no is certain.
    pub(crate) fn may_crack(
        &mut self,
        system: &CrackSystem,
        suspect: &Suspect,
        step: usize,
        strength: f32,
        now: f64,
    ) -> bool {
        let Some(point) = self.at_time(system, suspect, now) else {
            return true;
        };
        let Some(q) = point.projection else {
            return true;
        };
        // All steps of the batch at once, until the projection changes.
        let batch = step / STRIDE;
        if point.held_in != Some(batch) {
            point.held_in = Some(batch);
            let left = suspect.state.projected(&q).tension_bounds();
            point.held = 0;
            for (k, (left, whole)) in left.iter().zip(&suspect.bounds).enumerate() {
                let holds = left + ROUNDING * whole.abs() <= strength * (1.0 - MARGIN);
                point.held |= u8::from(holds) << k;
            }
        }
        point.held >> lane(step) & 1 == 0
    }

    /// What is left of a suspect's stress at step k of the batch, at time `now`, s.
    pub(crate) fn released(
        &mut self,
        system: &CrackSystem,
        suspect: &Suspect,
        k: usize,
        now: f64,
    ) -> Symmetric3 {
        let stress = suspect.state.stress(k);
        let point = self.at_time(system, suspect, now);
        match point.and_then(|point| point.projection) {
            Some(q) => Symmetric3::from_mat3(q.transpose() * stress.to_mat3() * q),
            None => stress,
        }
    }

    /// A point's memory as of `now`, s; none with cracks that release nothing.
    fn at_time(&mut self, system: &CrackSystem, suspect: &Suspect, now: f64) -> Option<&mut Point> {
        let CrackTiming::TimeResolved { release_reach, .. } = system.config.timing else {
            return None;
        };
        let place = suspect.place as usize;
        if place >= self.points.len() {
            let untouched = Point {
                seen: Vec::new(),
                pending: Vec::new(),
                projection: None,
                next: f64::INFINITY,
                growths: 0,
                held_in: None,
                held: 0,
            };
            self.points.resize(place + 1, untouched);
        }
        let point = &mut self.points[place];
        if point.growths != system.growth.len() || now > point.next {
            update(point, system, suspect.tet, now, release_reach as f32);
        }
        Some(point)
    }
}

fn update(point: &mut Point, system: &CrackSystem, e: u32, now: f64, release_reach: f32) {
    let centre = system.centroids[e as usize];
    let grown = &system.growth[point.growths..];
    point.growths = system.growth.len();
    let mut changed = false;
    if grown.len() < 4 * system.cracks.len() {
        for growth in grown {
            changed |= look(point, system, growth, centre, now, release_reach);
        }
    } else {
        for crack in 0..system.cracks.len() as u32 {
            let growth = Growth { crack, sites: 0 };
            changed |= look(point, system, &growth, centre, now, release_reach);
        }
    }
    if now > point.next {
        for i in 0..point.seen.len() {
            if point.seen[i].pending > 0 {
                let reach = reach(system, point.seen[i].crack, release_reach);
                changed |= arrive(point, i, now, reach);
            }
        }
        let arrivals = point.pending.iter().map(|p| p.arrival);
        point.next = arrivals.filter(|&t| t >= now).fold(f64::INFINITY, f64::min);
    }
    if changed {
        point.projection = projection(system, &point.seen);
        point.held_in = None;
    }
}

/// How far a crack releases, m.
fn reach(system: &CrackSystem, crack: u32, release_reach: f32) -> f32 {
    release_reach * (2.0 * system.extents[crack as usize].size).max(system.edge)
}

/// Looks at a crack that has grown; whether it releases the point more, or otherwise.
fn look(
    point: &mut Point,
    system: &CrackSystem,
    growth: &Growth,
    centre: Vec3,
    now: f64,
    release_reach: f32,
) -> bool {
    let crack = growth.crack;
    let reach = reach(system, crack, release_reach);
    let (i, first) = match point.seen.binary_search_by_key(&crack, |s| s.crack) {
        Ok(i) => (i, growth.sites as usize),
        Err(i) => {
            let extent = &system.extents[crack as usize];
            // Out of reach of the whole crack: nothing to look at until it grows.
            if centre.distance_squared(extent.origin) > (extent.size + reach).powi(2) {
                return false;
            }
            let new = Seen {
                crack,
                site: NONE,
                distance: f32::INFINITY,
                pending: 0,
            };
            point.seen.insert(i, new);
            (i, 0)
        }
    };
    let nearest = point.seen[i].distance;
    let wave = system.asset.material.rayleigh_speed();
    let sites = &system.cracks[crack as usize].sites;
    for (site, place) in sites.iter().enumerate().skip(first) {
        let distance = place.position.distance(centre);
        if nearest <= distance {
            continue;
        }
        let arrival = place.time + f64::from(distance) / wave;
        let own = of_crack(&point.pending, &point.seen[i]);
        let precedes = |p: &Pending| p.distance <= distance && p.arrival <= arrival;
        if point.pending[own.clone()].iter().any(precedes) {
            continue;
        }
        let own = keep(&mut point.pending, own, |p| {
            p.distance < distance || p.arrival < arrival
        });
        let new = Pending {
            crack,
            site: site as u32,
            distance,
            arrival,
        };
        point.pending.insert(own.end, new);
        point.seen[i].pending = own.len() as u32 + 1;
        if arrival >= now {
            point.next = point.next.min(arrival);
        }
    }
    arrive(point, i, now, reach)
}

/// Lets those sites of the crack at place `i` of those seen arrive whose wave is here and that lie within reach; whether one is
/// nearer than what was.
fn arrive(point: &mut Point, i: usize, now: f64, reach: f32) -> bool {
    let seen = &mut point.seen[i];
    if seen.pending == 0 {
        return false;
    }
    let own = of_crack(&point.pending, seen);
    let waiting = point.pending[own.clone()].iter();
    let here = waiting.filter(|p| p.arrival < now && p.distance < reach);
    let Some(nearest) = here
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
        .copied()
    else {
        return false;
    };
    if nearest.distance >= seen.distance {
        return false;
    }
    seen.site = nearest.site;
    seen.distance = nearest.distance;
    let left = keep(&mut point.pending, own, |p| p.distance < nearest.distance);
    seen.pending = left.len() as u32;
    true
}

/// Where a crack's sites stand among those pending, which are in crack order.
fn of_crack(pending: &[Pending], seen: &Seen) -> Range<usize> {
    let start = pending.partition_point(|p| p.crack < seen.crack);
    start..start + seen.pending as usize
}

/// Keeps those of a range that pass; returns what is left of the range.
fn keep(
    pending: &mut Vec<Pending>,
    range: Range<usize>,
    passes: impl Fn(&Pending) -> bool,
) -> Range<usize> {
    let mut end = range.start;
    for i in range.clone() {
        if passes(&pending[i]) {
            pending[end] = pending[i];
            end += 1;
        }
    }
    pending.drain(end..range.end);
    range.start..end
}

/// In crack order: projections do not commute.
fn projection(system: &CrackSystem, seen: &[Seen]) -> Option<Mat3> {
    let released = seen.iter().filter(|s| s.site != NONE);
    let across = released.map(|s| {
        let n = system.cracks[s.crack as usize].sites[s.site as usize].direction;
        Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z)
    });
    across.reduce(|product, next| product * next)
}
