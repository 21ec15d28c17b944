//! Marks on the faces of cracks in glass.
//!
//! Around its origin the face of a crack is a mirror. Where the stress intensity σ√r has reached the mirror constant of the glass, mist begins: a fine
//! frosting. Farther on are ridges along the crack's way, hackle, and then the crack forks ([`branching`](super::branching)). The distance counts as it
//! does for forks, from where the crack started or forked last, and a wall is taken into account as it is there.
//!
//! A place gets the distance at which the mirror of a crack under its own tension would end. A crack that waited for energy is slow and leaves a mirror.

use glam::Vec3;

use super::branching::{Run, SLOWEST, nearest_start};
use super::felt::Felt;
use super::single::ElementCut;
use super::system::CrackSystem;
use crate::body::Body;
use crate::state::crossing_middle;

/// Least run that a mirror is computed from, m.
const LEAST_RUN: f64 = 1e-4;

/// A place on the face of a crack in glass, and what says how it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackMark {
    /// The place, m, body frame.
    pub place: Vec3,
    /// Unit normal of the crack.
    pub normal: Vec3,
    /// Start of the straight line along which the crack came: its origin or its last fork, m, body frame.
    pub start: Vec3,
    /// Distance from there at which the mirror ends, m; infinite where the crack leaves nothing but a mirror.
    pub mirror: f32,
}

impl CrackSystem<'_> {
    /// A cut of a crack with the radius of the crack's mirror.
    pub(super) fn marked(&self, crack: u32, cut: ElementCut, felt: &Felt) -> ElementCut {
        let mirror = self.mirror(crack, &cut, felt).unwrap_or(f32::INFINITY);
        ElementCut { mirror, ..cut }
    }

    /// Radius of the mirror of a crack that cuts a tetrahedron, m; none where it leaves nothing else.
    fn mirror(&self, crack: u32, cut: &ElementCut, felt: &Felt) -> Option<f32> {
        let [constant, _] = self.asset.material.mirror_constants()?;
        let speed = self.config.crack_speed()?;
        let place = crossing_middle(&self.asset.fracture.corners(cut.tet as usize), &cut.values);
        let material = &self.asset.material;
        let (run, since) = nearest_start(&self.cracks[crack as usize], place);
        let length = f64::from(run).max(LEAST_RUN);
        let free = length / (speed * material.rayleigh_speed());
        let (run, tension) = Run::of(felt, cut, length, material.poisson_ratio);
        let is_slow = since.is_finite() && cut.time - since > SLOWEST * free;
        let mirror = length * (constant / run.intensity(tension)).powi(2);
        (tension > 0.0 && !is_slow).then_some(mirror as f32)
    }

    /// The marks of all cuts that this impact added; none in materials that leave no marks.
    pub(crate) fn marks(&self, body: &Body) -> Vec<CrackMark> {
        if self.asset.material.mirror_constants().is_none() {
            return Vec::new();
        }
        let origin = body.origin().as_vec3();
        let of = |crack: &super::Crack| {
            let starts: Vec<Vec3> = std::iter::once(crack.frame.origin)
                .chain(crack.forks.iter().map(|fork| fork.0))
                .collect();
            let cuts = &crack.elements[crack.restored..];
            // The cut in which a crack starts has the mirror of the next.
            let first = cuts.get(1).or(cuts.first());
            let mirrors = first.into_iter().chain(cuts.iter().skip(1));
            let mark = |(cut, next): (&ElementCut, &ElementCut)| {
                let corners = self.asset.fracture.corners(cut.tet as usize);
                let place = crossing_middle(&corners, &cut.values);
                let start = starts.iter().copied().reduce(|a, b| {
                    let nearer = b.distance_squared(place) < a.distance_squared(place);
                    if nearer { b } else { a }
                });
                CrackMark {
                    place: place - origin,
                    normal: cut.direction,
                    start: start.unwrap_or(place) - origin,
                    mirror: next.mirror,
                }
            };
            cuts.iter().zip(mirrors).map(mark).collect::<Vec<_>>()
        };
        self.cracks.iter().flat_map(of).collect()
    }
}
