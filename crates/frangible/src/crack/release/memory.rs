//! What a point remembers of the cracks whose release waves have reached it.

use glam::Vec3;

use super::super::arrivals::{Arrivals, Queue};
use super::super::single::{Crack, Extent};
use super::super::sites::Site;
use super::super::system::CrackSystem;
use crate::stress::{STRETCHED, Shadow, share_beside, share_left};

/// A smaller fall of a share than this is passed over.
const LEAST: f32 = 5e-3;

/// A crack that takes a smaller share than this of the stress counts as taking nothing. It is far away for its length and needs no look,
/// which saves time, since most cracks about a point are short and far.
const FAINT: f32 = 0.02;

/// At a distance of so many half-lengths a of a crack its share is below [`FAINT`]. A crack in a stretched body takes the most,
/// 1 − (1 + a²/y²)^-1.5 < 1.5 a²/y² at the distance y, and √(1.5 / 0.02) = 8.66.
const FAR: f32 = 8.67;

/// What a point knows of one crack near it.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Nearest of the crack's sites whose wave has reached the point, or [`NONE`].
    site: u32,
    /// Distance of that site, m; infinite without one.
    distance: f32,
    /// Half the crack's length when the point looked at it last, m.
    half_length: f32,
    /// How many of the crack's sites the point has looked at.
    looked_at: u32,
    /// Sites whose waves have still to arrive.
    pending: Queue,
    /// What the crack has left of the stress.
    shadow: Shadow,
}

/// No site.
const NONE: u32 = u32::MAX;

impl Seen {
    const NOTHING: Self = Self {
        site: NONE,
        distance: f32::INFINITY,
        half_length: 0.0,
        looked_at: 0,
        pending: Queue::EMPTY,
        shadow: Shadow {
            normal: Vec3::ZERO,
            stretched: 1.0,
            bent: 1.0,
        },
    };
}

/// The cracks, as release waves leave them.
#[derive(Clone, Copy)]
pub(super) struct Sources<'a> {
    pub(super) cracks: &'a [Crack],
    pub(super) extents: &'a [Extent],
    /// The number of the crack that grew, for each growth in order.
    pub(super) growth: &'a [u32],
    /// Mean edge of the fracture mesh, m.
    pub(super) edge: f32,
    /// Speed of the waves c_R, m/s.
    pub(super) wave: f64,
}

impl<'a> Sources<'a> {
    pub(super) fn of(system: &'a CrackSystem) -> Self {
        Self {
            cracks: &system.cracks,
            extents: &system.extents,
            growth: &system.growth,
            edge: system.edge,
            wave: system.asset.material.rayleigh_speed(),
        }
    }

    /// Half a crack's present length, m.
    fn half_length(&self, crack: u32) -> f32 {
        0.5 * self.extents[crack as usize].chord.max(self.edge)
    }

    /// Whether a site of a crack this far away, m, certainly leaves as much as is left already.
    fn takes_no_more(&self, left: &Shadow, crack: u32, distance: f32, beta: f32) -> bool {
        const ROUNDING: f32 = 1e-5;
        let distance = (distance - 0.5 * self.edge).max(0.0);
        let half_length = self.half_length(crack);
        let least = |beta| share_beside(distance, half_length, beta) - ROUNDING;
        least(STRETCHED) > left.stretched - LEAST && least(beta) > left.bent - LEAST
    }

    /// What a crack of the present length leaves at a point beside one of its sites; `beta`: of the stress that bends.
    fn cast(&self, crack: u32, site: u32, point: Vec3, beta: f32) -> Shadow {
        let site = &self.cracks[crack as usize].sites[site as usize];
        let half_length = self.half_length(crack);
        let to_crack = nearest_place(site, point, 0.5 * self.edge);
        let share = |beta| share_left(to_crack, site.direction, half_length, beta);
        let stretched = share(STRETCHED);
        Shadow {
            normal: site.direction,
            stretched,
            bent: if beta == STRETCHED {
                stretched
            } else {
                share(beta)
            },
        }
    }
}

/// What a point knows of all cracks.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    place: Vec3,
    /// β of the stress that bends; where nothing does, that of the stress that stretches.
    pub(super) beta: f32,
    /// Cracks near the point, rising.
    cracks: Vec<u32>,
    /// What is known of each of those cracks.
    seen: Vec<Seen>,
    /// Sites whose wave is on its way.
    pending: Arrivals,
    /// Whether any crack has released it.
    pub(super) dark: bool,
    /// Nothing arrives before this time, s, as long as the cracks have grown as often as `growths` says.
    next: f64,
    /// How many times the cracks had grown when `next` was found.
    growths: usize,
}

impl Memory {
    /// The memory of a point at this place that no crack has released.
    pub(super) fn new(place: Vec3, beta: f32) -> Self {
        Self {
            place,
            beta,
            cracks: Vec::new(),
            seen: Vec::new(),
            pending: Arrivals::default(),
            dark: false,
            next: f64::INFINITY,
            growths: 0,
        }
    }

    /// What the cracks have left of the stress, crack after crack.
    #[inline(always)]
    pub(super) fn shadows(&self) -> impl Iterator<Item = &Shadow> {
        let shadows = self.seen.iter().map(|seen| &seen.shadow);
        shadows.filter(|shadow| shadow.bent < 1.0 || shadow.stretched < 1.0)
    }

    /// What all cracks but one have left of the stress.
    pub(super) fn shadows_of_others(&self, crack: u32) -> impl Iterator<Item = &Shadow> {
        let of = self.cracks.iter().zip(&self.seen);
        of.filter(move |&(&of, _)| of != crack)
            .map(|(_, seen)| &seen.shadow)
    }

    /// Brings the memory to the time `now`, s. Returns whether any crack releases the point more than before.
    pub(super) fn update(&mut self, sources: Sources, now: f64) -> bool {
        let known = self.growths;
        if known == sources.growth.len() && now <= self.next {
            return false;
        }
        let grown = &sources.growth[known..];
        self.growths = sources.growth.len();
        let mut falls = false;
        if grown.len() < 4 * sources.cracks.len() {
            for (growth, &crack) in (known..).zip(grown) {
                // A look at a crack that grew several times is a look at all of it.
                if sources.extents[crack as usize].latest_growth == growth as u32 {
                    falls |= self.look(sources, crack, now);
                }
            }
        } else {
            for crack in 0..sources.cracks.len() as u32 {
                falls |= self.look(sources, crack, now);
            }
        }
        if now > self.next {
            for i in 0..self.seen.len() {
                if !self.seen[i].pending.is_empty() {
                    falls |= self.arrive(sources, i, now);
                }
            }
            let queues = self.seen.iter().map(|seen| seen.pending);
            self.next = queues
                .map(|queue| self.pending.next(queue, now))
                .fold(f64::INFINITY, f64::min);
        }
        self.dark |= falls;
        falls
    }

    /// Looks at a crack that has grown; whether it releases the point more.
    fn look(&mut self, sources: Sources, crack: u32, now: f64) -> bool {
        let extent = &sources.extents[crack as usize];
        // Far for its length: nothing to look at until it grows. Of one that was seen this is never so.
        let far = extent.size + FAR * sources.half_length(crack);
        if self.place.distance_squared(extent.origin) > far * far {
            return false;
        }
        let i = match self.cracks.binary_search(&crack) {
            Ok(i) => i,
            Err(i) => {
                self.cracks.insert(i, crack);
                self.seen.insert(i, Seen::NOTHING);
                i
            }
        };
        let seen = &mut self.seen[i];
        let sites = &sources.cracks[crack as usize].sites;
        let first = std::mem::replace(&mut seen.looked_at, sites.len() as u32);
        for (places, block) in sites.blocks_from(first as usize) {
            let nearest = block.nearest(self.place);
            let soonest = block.since + f64::from(nearest) / sources.wave;
            if seen.distance <= nearest || (self.pending).precedes(seen.pending, nearest, soonest) {
                continue;
            }
            for (site, place) in (places.start as u32..).zip(&sites[places]) {
                let distance = place.position.distance(self.place);
                if seen.distance <= distance {
                    continue;
                }
                let arrival = place.time + f64::from(distance) / sources.wave;
                let added = self.pending.add(&mut seen.pending, site, distance, arrival);
                if added && arrival >= now {
                    self.next = self.next.min(arrival);
                }
            }
        }
        let before = seen.site;
        let mut falls = self.arrive(sources, i, now);
        let seen = &mut self.seen[i];
        // The crack is longer than when it was seen last.
        let half_length = sources.half_length(crack);
        if seen.site == before && before != NONE && seen.half_length != half_length {
            seen.half_length = half_length;
            let new = sources.cast(crack, before, self.place, self.beta);
            falls |= darken(&mut seen.shadow, new);
        }
        falls
    }

    /// Takes in the sites of one crack whose waves have arrived; `i` is the crack's place among those seen.
    /// Each site is the nearest when its wave arrives. Returns whether the crack then leaves less than before.
    fn arrive(&mut self, sources: Sources, i: usize, now: f64) -> bool {
        let (crack, seen) = (self.cracks[i], &mut self.seen[i]);
        let (shadow, mut falls) = (&mut seen.shadow, false);
        let mut too_far = false;
        let arrived = self
            .pending
            .arrive(&mut seen.pending, now, |site, distance| {
                // They come the nearest first, and the farther a site, the more it leaves at least.
                too_far = too_far || sources.takes_no_more(shadow, crack, distance, self.beta);
                if !too_far {
                    falls |= darken(shadow, sources.cast(crack, site, self.place, self.beta));
                }
            });
        if let Some((site, distance)) = arrived {
            (seen.site, seen.distance) = (site, distance);
            seen.half_length = sources.half_length(crack);
        }
        falls
    }
}

/// Takes over what of the new shares is smaller, and returns whether anything is. The normal is that of the smallest share of bending: in
/// a wall it is bending that breaks, and elsewhere both shares are the same.
fn darken(old: &mut Shadow, new: Shadow) -> bool {
    let falls = new.bent <= old.bent - LEAST || new.stretched <= old.stretched - LEAST;
    let falls = falls && new.bent.min(new.stretched) <= 1.0 - FAINT;
    if falls {
        if new.bent <= old.bent {
            old.normal = new.normal;
        }
        old.bent = old.bent.min(new.bent);
        old.stretched = old.stretched.min(new.stretched);
    }
    falls
}

/// The way from a point to the nearest place of the part of a crack that a site stands for: a disc of this radius, m, around the site.
fn nearest_place(site: &Site, point: Vec3, radius: f32) -> Vec3 {
    let to_site = site.position - point;
    let across = site.direction * site.direction.dot(to_site);
    let along = to_site - across;
    let length = along.length();
    if length <= radius {
        across
    } else {
        across + along * (1.0 - radius / length)
    }
}

#[cfg(test)]
mod tests;
