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

use glam::{Mat3, Vec3};

use super::arrivals::{Arrivals, Queue};
use super::suspects::Suspect;
use super::system::CrackSystem;
use crate::config::CrackTiming;
use crate::stress::{MARGIN, STRIDE, Symmetric3, lane};

/// Rounding of what is left, relative to the whole stress.
const ROUNDING: f32 = 1e-5;

/// What has released a point of one crack near it.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Nearest site that has, or [`NONE`].
    site: u32,
    /// Its distance, m; infinite without one.
    distance: f32,
    /// How many of its sites were looked at.
    looked_at: u32,
    /// Those still to come.
    pending: Queue,
}

/// No site.
const NONE: u32 = u32::MAX;

/// What a point knows of all cracks.
#[derive(Clone, Debug)]
struct Point {
    /// Cracks near it, rising …
    cracks: Vec<u32>,
    /// … and what is known of each.
    seen: Vec<Seen>,
    /// Sites whose wave is on its way, or that lie beyond their crack's reach.
    pending: Arrivals,
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
                cracks: Vec::new(),
                seen: Vec::new(),
                pending: Arrivals::default(),
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
    let known = point.growths;
    let grown = &system.growth[known..];
    point.growths = system.growth.len();
    let mut changed = false;
    if grown.len() < 4 * system.cracks.len() {
        for (growth, &crack) in (known..).zip(grown) {
            // A look at a crack that grew several times is a look at all of it.
            if system.extents[crack as usize].latest_growth == growth as u32 {
                changed |= look(point, system, crack, centre, now, release_reach);
            }
        }
    } else {
        for crack in 0..system.cracks.len() as u32 {
            changed |= look(point, system, crack, centre, now, release_reach);
        }
    }
    if now > point.next {
        for i in 0..point.seen.len() {
            if !point.seen[i].pending.is_empty() {
                let reach = reach(system, point.cracks[i], release_reach);
                changed |= arrive(point, i, now, reach);
            }
        }
        let queues = point.seen.iter().map(|seen| seen.pending);
        point.next = queues
            .map(|queue| point.pending.next(queue, now))
            .fold(f64::INFINITY, f64::min);
    }
    if changed {
        point.projection = projection(system, point);
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
    crack: u32,
    centre: Vec3,
    now: f64,
    release_reach: f32,
) -> bool {
    let reach = reach(system, crack, release_reach);
    let extent = &system.extents[crack as usize];
    // Out of reach of the whole crack: nothing to look at until it grows. Of one that was seen this is never so.
    if centre.distance_squared(extent.origin) > (extent.size + reach).powi(2) {
        return false;
    }
    let i = match point.cracks.binary_search(&crack) {
        Ok(i) => i,
        Err(i) => {
            let new = Seen {
                site: NONE,
                distance: f32::INFINITY,
                looked_at: 0,
                pending: Queue::default(),
            };
            point.cracks.insert(i, crack);
            point.seen.insert(i, new);
            i
        }
    };
    let seen = &mut point.seen[i];
    let wave = system.asset.material.rayleigh_speed();
    let sites = &system.cracks[crack as usize].sites;
    let first = std::mem::replace(&mut seen.looked_at, sites.len() as u32);
    for (site, place) in (first..).zip(&sites[first as usize..]) {
        let distance = place.position.distance(centre);
        if seen.distance <= distance {
            continue;
        }
        let arrival = place.time + f64::from(distance) / wave;
        let added = point
            .pending
            .add(&mut seen.pending, site, distance, arrival);
        if added && arrival >= now {
            point.next = point.next.min(arrival);
        }
    }
    arrive(point, i, now, reach)
}

/// Lets those sites of the crack at place `i` of those seen arrive whose wave is here and that lie within reach; whether one is
/// nearer than what was.
fn arrive(point: &mut Point, i: usize, now: f64, reach: f32) -> bool {
    let seen = &mut point.seen[i];
    let Some((site, distance)) = point.pending.arrive(&mut seen.pending, now, reach) else {
        return false;
    };
    (seen.site, seen.distance) = (site, distance);
    true
}

/// In crack order: projections do not commute.
fn projection(system: &CrackSystem, point: &Point) -> Option<Mat3> {
    let seen = point.cracks.iter().zip(&point.seen);
    let released = seen.filter(|(_, s)| s.site != NONE);
    let across = released.map(|(&crack, s)| {
        let n = system.cracks[crack as usize].sites[s.site as usize].direction;
        Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z)
    });
    across.reduce(|product, next| product * next)
}
