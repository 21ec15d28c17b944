//! Memory of a point: the cracks whose release waves have reached it.

use glam::Vec3;

use super::super::extents::{BLOCK, Extents, FAINT, Ring, Seen};
use super::super::single::Crack;
use super::super::sites::Site;
use super::super::system::CrackSystem;
use crate::config::CRACK_SPEED;
use crate::stress::{STRETCHED, Shadow, length, share_beside, share_in_solid, share_left};

/// Smallest fall of a share that is noted.
const LEAST: f32 = 5e-3;

/// The cracks, as release waves leave them.
#[derive(Clone, Copy)]
pub(super) struct Sources<'a> {
    pub(super) cracks: &'a [Crack],
    pub(super) extents: &'a Extents,
    /// Speed of the waves c_R, m/s.
    pub(super) wave: f64,
}

impl<'a> Sources<'a> {
    pub(super) fn of(system: &'a CrackSystem) -> Self {
        Self {
            cracks: &system.cracks,
            extents: &system.extents,
            wave: system.asset.material.rayleigh_speed(),
        }
    }

    /// Shares of the stress that a crack leaves at a point at time `now`, s; none if it takes nothing to speak of. `bent`: β of bending in a wall,
    /// none in a solid.
    ///
    /// A crack that is as long as another one beside it does not release the other's front: it releases what lies behind its own. At a front in a solid
    /// it is therefore taken to be as wide as it has run since it passed there, if that is less than its half-width.
    #[inline(always)]
    fn cast(&self, crack: usize, memory: (Vec3, Option<f32>, bool), now: f64) -> Option<Shadow> {
        let (point, bent, at_front) = memory;
        let site = self.cracks[crack]
            .sites
            .nearest_heard(point, now, self.wave)?;
        let radius = 0.5 * self.extents.edge();
        let beyond = self.extents.far(crack) + radius;
        if point.distance_squared(site.position) > beyond * beyond {
            return None;
        }
        let to_crack = nearest_place(site, point, radius);
        let half_length = self.extents.half_length(crack);
        let normal = site.direction;
        let endless = |beta| share_left(to_crack, normal, |y| share_beside(y, half_length, beta));
        let (stretched, bent) = match bent {
            Some(beta) => (endless(STRETCHED), endless(beta)),
            None => {
                let share = if at_front {
                    let run = CRACK_SPEED * self.wave * (self.extents.latest(crack) - site.time);
                    let half_width = self.cracks[crack].half_width(half_length).min(run as f32);
                    share_left(to_crack, normal, |y| {
                        share_in_solid(y, half_width, half_length)
                    })
                } else {
                    endless(STRETCHED)
                };
                (share, share)
            }
        };
        let shadow = Shadow {
            normal,
            stretched,
            bent,
        };
        (shadow.bent.min(shadow.stretched) <= 1.0 - FAINT).then_some(shadow)
    }
}

/// Shares of the stress at a point that the cracks have left.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    place: Vec3,
    /// β of the stress that bends, in a wall.
    pub(super) bent: Option<f32>,
    /// True at the front of a crack.
    at_front: bool,
    /// Shares that each crack has left, by the crack's number, rising; cracks that have taken nothing are left out.
    shadows: Vec<(u32, Shadow)>,
    /// The last look at each ring.
    seen: [Seen; 2],
}

impl Memory {
    /// The memory of a point at this place that no crack has released. `bent`: β of the stress that bends, in a wall.
    pub(super) fn new(place: Vec3, bent: Option<f32>) -> Self {
        Self {
            place,
            bent,
            at_front: false,
            shadows: Vec::new(),
            seen: [Seen::NEVER; 2],
        }
    }

    /// The memory of a place at the front of a crack that no other crack has released. `bent`: β of the stress that bends, in a wall.
    pub(super) fn of_front(place: Vec3, bent: Option<f32>) -> Self {
        Self {
            at_front: true,
            ..Self::new(place, bent)
        }
    }

    /// Returns true if any crack has released it.
    pub(super) fn is_dark(&self) -> bool {
        !self.shadows.is_empty()
    }

    /// Shares of the stress that the cracks have left, crack after crack.
    #[inline(always)]
    pub(super) fn shadows(&self) -> impl Iterator<Item = &Shadow> {
        self.shadows.iter().map(|(_, shadow)| shadow)
    }

    /// Takes in what all cracks of a ring about the point, but for one, which is always the same, leave at the time `now`, s. Returns true if
    /// any crack releases the point more than before.
    pub(super) fn update(
        &mut self,
        sources: Sources,
        ring: Ring,
        but: Option<u32>,
        now: f64,
    ) -> bool {
        update(self, sources, ring, but, now)
    }
}

widest! {
    /// The look of a point at all cracks of a ring.
    fn update(
        memory: &mut Memory,
        sources: Sources<'_>,
        ring: Ring,
        but: Option<u32>,
        now: f64,
    ) -> bool {
        let Memory {
            place,
            bent,
            at_front,
            shadows,
            seen,
        } = memory;
        let of = (*place, *bent, *at_front);
        let mut falls = false;
        let mut i = 0;
        let Sources { extents, .. } = sources;
        // Cracks that have not changed, and were heard to the end, leave what they left.
        let seen = std::mem::replace(&mut seen[ring as usize], extents.seen(now));
        // Loops and no closures, which would be compiled for the plain processor.
        for b in 0..extents.blocks() {
            let mut about = extents.about(b, *place, ring, seen, now);
            while about != 0 {
                let crack = BLOCK * b + about.trailing_zeros() as usize;
                about &= about - 1;
                let number = crack as u32;
                if but == Some(number) {
                    continue;
                }
                let Some(new) = sources.cast(crack, of, now) else {
                    continue;
                };
                i += shadows[i..].partition_point(|(of, _)| *of < number);
                if shadows.get(i).is_some_and(|(of, _)| *of == number) {
                    falls |= darken(&mut shadows[i].1, new);
                } else {
                    shadows.insert(i, (number, new));
                    falls = true;
                }
            }
        }
        falls
    }
}

/// Takes over those of the new shares that are smaller, and returns true if any is. The normal is that of the smallest share of bending: in
/// a wall it is bending that breaks, and elsewhere both shares are the same.
fn darken(old: &mut Shadow, new: Shadow) -> bool {
    let falls = new.bent <= old.bent - LEAST || new.stretched <= old.stretched - LEAST;
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
    let length = length(along);
    if length <= radius {
        across
    } else {
        across + along * (1.0 - radius / length)
    }
}

#[cfg(test)]
mod tests;
