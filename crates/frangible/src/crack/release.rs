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

use std::collections::HashMap;

use glam::{Mat3, Vec3};

use super::system::{Crack, CrackSystem};
use crate::config::CrackTiming;
use crate::stress::Symmetric3;

/// What a point knows of one crack.
#[derive(Clone, Debug)]
struct Seen {
    /// How many of the crack's sites it has looked at.
    scanned: usize,
    /// The crack's reach when it last looked, m.
    reach: f32,
    /// Nearest one that has released it: distance, m, and the crack's normal there.
    nearest: (f32, Vec3),
    /// Those to come: nearer means later. Distance, m; arrival of the wave, s; index in the crack.
    pending: Vec<(f32, f64, u32)>,
    /// Earliest of their arrivals still ahead, s.
    next: f64,
}

/// What a point knows of all cracks.
#[derive(Clone, Debug)]
struct Point {
    seen: Vec<Seen>,
    /// P₁ P₂ … of the cracks that have released it.
    projection: Mat3,
    /// Nothing arrives before this time, s …
    next: f64,
    /// … as long as there are this many sites.
    sites: usize,
}

impl Default for Point {
    fn default() -> Self {
        Self {
            seen: Vec::new(),
            projection: Mat3::IDENTITY,
            next: f64::NEG_INFINITY,
            sites: 0,
        }
    }
}

/// Memory of the points that have asked. Looked up only, never iterated.
#[derive(Default)]
pub(crate) struct Releases {
    points: HashMap<u32, Point>,
}

/// What is left of `stress` at the centre of tetrahedron `e` at time `now`, s.
pub(crate) fn released(
    system: &CrackSystem,
    releases: &mut Releases,
    stress: Symmetric3,
    e: u32,
    now: f64,
) -> Symmetric3 {
    let CrackTiming::TimeResolved { release_reach, .. } = system.config.timing else {
        return stress;
    };
    let point = releases.points.entry(e).or_default();
    if point.sites != system.site_count || now > point.next {
        update(point, system, e, now, release_reach as f32);
    }
    let q = point.projection;
    if q == Mat3::IDENTITY {
        stress
    } else {
        Symmetric3::from_mat3(q.transpose() * stress.to_mat3() * q)
    }
}

fn update(point: &mut Point, system: &CrackSystem, e: u32, now: f64, release_reach: f32) {
    let centre = system.centroids[e as usize];
    let wave = system.asset.material.rayleigh_speed();
    point.sites = system.site_count;
    point.next = f64::INFINITY;
    point.projection = Mat3::IDENTITY;
    for (i, crack) in system.cracks.iter().enumerate() {
        if i == point.seen.len() {
            let nearest = (f32::INFINITY, Vec3::ZERO);
            point.seen.push(Seen {
                scanned: 0,
                reach: 0.0,
                nearest,
                pending: Vec::new(),
                next: f64::INFINITY,
            });
        }
        let seen = &mut point.seen[i];
        let reach = release_reach * (2.0 * crack.extent).max(system.edge);
        let grown = seen.scanned != crack.sites.len() || seen.reach != reach;
        // Out of reach of the whole crack: nothing to look at until it grows.
        if grown && centre.distance(crack.frame.origin) > crack.extent + reach {
            continue;
        }
        if grown {
            look(seen, crack, centre, wave);
            seen.reach = reach;
        }
        if grown || now > seen.next {
            arrive(seen, crack, now, reach);
        }
        point.next = point.next.min(seen.next);
        if seen.nearest.0.is_finite() {
            let n = seen.nearest.1;
            point.projection *= Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z);
        }
    }
}

/// Looks at the sites that have joined since the last time.
fn look(seen: &mut Seen, crack: &Crack, point: Vec3, wave: f64) {
    for (k, site) in crack.sites.iter().enumerate().skip(seen.scanned) {
        let distance = site.position.distance(point);
        if seen.nearest.0 <= distance {
            continue;
        }
        let arrival = site.time + f64::from(distance) / wave;
        if seen.pending.iter().all(|p| p.0 > distance || p.1 > arrival) {
            seen.pending.retain(|p| p.0 < distance || p.1 < arrival);
            seen.pending.push((distance, arrival, k as u32));
        }
    }
    seen.scanned = crack.sites.len();
}

/// Lets those arrive whose wave is here and that lie within reach.
fn arrive(seen: &mut Seen, crack: &Crack, now: f64, reach: f32) {
    for &(distance, arrival, k) in &seen.pending {
        if arrival < now && distance < reach && distance < seen.nearest.0 {
            seen.nearest = (distance, crack.sites[k as usize].direction);
        }
    }
    let nearest = seen.nearest.0;
    seen.pending.retain(|p| p.0 < nearest);
    seen.next = seen
        .pending
        .iter()
        .filter(|p| p.1 >= now)
        .map(|p| p.1)
        .fold(f64::INFINITY, f64::min);
}
