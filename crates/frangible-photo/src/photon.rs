//! Light of the lamp on its way through glass.

use frangible_recording::glam::{Vec2, Vec3A};

use crate::optics::{at_crack, at_glass, bumpy, mirror, outward};
use crate::random::Random;
use crate::set::{Met, Set};

/// Faces that light may meet on its way.
const LONGEST: u32 = 10;

/// Light of the lamp on its way through glass.
pub(crate) struct Photon {
    from: Vec3A,
    along: Vec3A,
    /// Remaining light, of 1.
    pub(crate) light: Vec3A,
}

impl Photon {
    /// Sends light of this direction onto one of these faces, each with the sum of areas up to its own: onto that whose area holds `pick`.
    /// Follows it until no glass is in its way; none where something opaque is.
    pub(crate) fn through(
        set: &Set,
        faces: &[(u32, f32)],
        along: Vec3A,
        pick: f32,
        random: &mut Random,
    ) -> Option<Self> {
        let chosen = faces.partition_point(|&(_, sum)| sum < pick);
        let (face, _) = *faces.get(chosen)?;
        let met = set.point_of(face, [random.next(), random.next()]);
        // Only the first face in the way of the lamp's light.
        if set.meet(met.at, -along, face).is_some() {
            return None;
        }
        let mut photon = Self {
            from: met.at,
            along,
            light: Vec3A::ONE,
        };
        let mut leaves = photon.cross(&met, random)?;
        for _ in 0..LONGEST {
            let Some(met) = set.meet(photon.from, photon.along, leaves) else {
                return Some(photon);
            };
            leaves = photon.cross(&met, random)?;
        }
        None
    }

    fn cross(&mut self, met: &Met<'_>, random: &mut Random) -> Option<u32> {
        let look = met.look;
        self.from = met.at;
        if !look.bends() {
            // A surface with some opacity lets the rest through.
            return (random.next() >= look.opacity).then_some(met.face);
        }
        if self.along.dot(met.flat) > 0.0 && !look.thin {
            self.light *= (-look.swallows * met.distance).exp();
        }
        let skin = met.skin();
        if skin.cloud > 0.0 && random.next() < skin.cloud {
            return None;
        }
        let normal = bumpy(met, skin.bump);
        let (reflected, bent) = if look.thin {
            at_crack(self.along, normal, look.ior)
        } else {
            at_glass(self.along, normal, look.ior)
        };
        self.along = match bent {
            Some(bent) if random.next() >= reflected => bent,
            _ => outward(mirror(self.along, normal), met.flat, self.along),
        };
        Some(met.face)
    }

    /// Point at which it meets a floor of this height (x, z).
    pub(crate) fn on_floor(&self, height: f32) -> Option<Vec2> {
        if self.along.y >= -1e-3 {
            return None;
        }
        let at = self.from + self.along * ((height - self.from.y) / self.along.y);
        Some(Vec2::new(at.x, at.z))
    }
}
