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

use super::suspects::Suspect;
use super::system::{Crack, CrackSystem};
use crate::config::CrackTiming;
use crate::stress::{MARGIN, STRIDE, Symmetric3, lane};

/// Rounding of what is left, relative to the whole stress.
const ROUNDING: f32 = 1e-5;

/// What a point knows of one crack near it.
#[derive(Clone, Debug)]
struct Seen {
    crack: u32,
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
    /// Cracks near it, by number.
    seen: Vec<Seen>,
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
    let mut refresh = |i: u32| {
        let crack = &system.cracks[i as usize];
        let reach = release_reach * (2.0 * crack.extent).max(system.edge);
        // Out of reach of the whole crack: nothing to look at until it grows.
        if centre.distance_squared(crack.frame.origin) > (crack.extent + reach).powi(2) {
            return;
        }
        changed |= look_again(&mut point.seen, i, crack, centre, reach, now, system);
    };
    if grown.len() < system.cracks.len() {
        grown.iter().for_each(|&i| refresh(i));
    } else {
        (0..system.cracks.len() as u32).for_each(refresh);
    }
    for seen in &mut point.seen {
        if now > seen.next {
            changed |= seen.arrive(&system.cracks[seen.crack as usize], now);
        }
    }
    let next = point.seen.iter().map(|seen| seen.next);
    point.next = next.fold(f64::INFINITY, f64::min);
    if changed {
        point.projection = projection(&point.seen);
        point.held_in = None;
    }
}

/// Looks at a crack that has grown, from a point within its reach; whether it releases the point more, or otherwise.
fn look_again(
    seen: &mut Vec<Seen>,
    number: u32,
    crack: &Crack,
    centre: Vec3,
    reach: f32,
    now: f64,
    system: &CrackSystem,
) -> bool {
    let i = match seen.binary_search_by_key(&number, |s| s.crack) {
        Ok(i) => i,
        Err(i) => {
            let new = Seen {
                crack: number,
                scanned: 0,
                reach: -1.0,
                nearest: (f32::INFINITY, Vec3::ZERO),
                pending: Vec::new(),
                next: f64::INFINITY,
            };
            seen.insert(i, new);
            i
        }
    };
    let seen = &mut seen[i];
    if seen.scanned == crack.sites.len() && seen.reach == reach {
        return false;
    }
    seen.look(crack, centre, system.asset.material.rayleigh_speed());
    seen.reach = reach;
    seen.arrive(crack, now)
}

/// In crack order: projections do not commute.
fn projection(seen: &[Seen]) -> Option<Mat3> {
    let released = seen.iter().filter(|s| s.nearest.0.is_finite());
    let across = released.map(|s| {
        let n = s.nearest.1;
        Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z)
    });
    across.reduce(|product, next| product * next)
}

impl Seen {
    /// Looks at the sites that have joined since the last time.
    fn look(&mut self, crack: &Crack, point: Vec3, wave: f64) {
        for (k, site) in crack.sites.iter().enumerate().skip(self.scanned) {
            let distance = site.position.distance(point);
            if self.nearest.0 <= distance {
                continue;
            }
            let arrival = site.time + f64::from(distance) / wave;
            if self.pending.iter().all(|p| p.0 > distance || p.1 > arrival) {
                self.pending.retain(|p| p.0 < distance || p.1 < arrival);
                self.pending.push((distance, arrival, k as u32));
            }
        }
        self.scanned = crack.sites.len();
    }

    /// Lets those arrive whose wave is here and that lie within reach; whether one is nearer than what was.
    fn arrive(&mut self, crack: &Crack, now: f64) -> bool {
        let before = self.nearest.0;
        for &(distance, arrival, k) in &self.pending {
            if arrival < now && distance < self.reach && distance < self.nearest.0 {
                self.nearest = (distance, crack.sites[k as usize].direction);
            }
        }
        let nearest = self.nearest.0;
        self.pending.retain(|p| p.0 < nearest);
        let ahead = self.pending.iter().filter(|p| p.1 >= now);
        self.next = ahead.map(|p| p.1).fold(f64::INFINITY, f64::min);
        nearest < before
    }
}
