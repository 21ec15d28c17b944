//! Zones: regions of a body.

use frangible::InputError;
use frangible::glam::Vec3;
use frangible::internals::Factors;
use frangible::internals::error::{finite, positive};

/// A region of space, m, in the body frame.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Zone {
    /// An axis-aligned box between two corners, in any order.
    Box([Vec3; 2]),
    /// A ball.
    Sphere {
        /// Centre of the ball.
        centre: Vec3,
        /// Radius of the ball.
        radius: f32,
    },
    /// The half-space behind a plane.
    HalfSpace {
        /// A point of the plane.
        point: Vec3,
        /// Normal pointing out of the zone, of any length.
        normal: Vec3,
    },
    /// The neighbourhood of a polyline, such as a score or a seam. A single point gives a ball.
    Tube {
        /// Points of the polyline.
        line: Vec<Vec3>,
        /// Largest distance from the line.
        radius: f32,
    },
}

impl Zone {
    /// Returns true if a point lies in the zone.
    #[must_use]
    pub fn contains(&self, p: Vec3) -> bool {
        match self {
            Self::Box([a, b]) => p.cmpge(a.min(*b)).all() && p.cmple(a.max(*b)).all(),
            Self::Sphere { centre, radius } => p.distance(*centre) <= *radius,
            Self::HalfSpace { point, normal } => (p - point).dot(*normal) <= 0.0,
            Self::Tube { line, radius } => match line.as_slice() {
                [point] => p.distance(*point) <= *radius,
                line => line
                    .windows(2)
                    .any(|piece| distance(p, piece[0], piece[1]) <= *radius),
            },
        }
    }

    /// Checks the values of the zone.
    ///
    /// # Errors
    /// A value is not finite, a radius is not positive, a normal is zero, or a line has no points.
    pub fn check(&self) -> Result<(), InputError> {
        let radius_of = |radius: f32| {
            positive("the radius of a weak zone", f64::from(radius), "m").map_err(InputError::from)
        };
        let place = |p: &Vec3| finite("a point of a weak zone", *p);
        match self {
            Self::Box(corners) => corners.iter().try_for_each(place),
            Self::Sphere { centre, radius } => place(centre).and(radius_of(*radius)),
            Self::HalfSpace { point, normal } => {
                place(point)?;
                finite("the normal of a weak zone", *normal)?;
                let length = f64::from(normal.length());
                Ok(positive("the length of a weak zone's normal", length, "")?)
            }
            Self::Tube { line, radius } => {
                if line.is_empty() {
                    return Err(InputError::Field(
                        "a scored line has no points; give two or more".into(),
                    ));
                }
                line.iter().try_for_each(place).and(radius_of(*radius))
            }
        }
    }
}

/// Distance of p from the piece of a line from a to b.
fn distance(p: Vec3, a: Vec3, b: Vec3) -> f32 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    // A piece without length has no t.
    let t = if t.is_finite() {
        t.clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + along * t)
}

/// A zone with factors on the values of the material.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The zone.
    pub zone: Zone,
    /// Factor on the tensile strength, if it differs.
    pub strength: Option<f32>,
    /// Factor on the fracture energy, if it differs. Default: the square of the strength factor, as in [`Factors::of_strength`].
    pub toughness: Option<f32>,
    /// Factor on the density of weak points, if it differs.
    pub weak_points: Option<f32>,
    /// Depth of a groove in the surface, m. It sets the strength and the toughness of the zone ([`Factors::groove`]) in place of their factors. Let the zone reach through the wall: the groove shortens the path of a crack within the zone only.
    pub groove: Option<f32>,
}

impl Patch {
    /// Makes a patch with a factor on the strength, and the toughness that keeps the flaw size.
    #[must_use]
    pub const fn of_strength(zone: Zone, strength: f32) -> Self {
        Self {
            zone,
            strength: Some(strength),
            toughness: None,
            weak_points: None,
            groove: None,
        }
    }

    /// Makes a patch with a groove of this depth, m.
    #[must_use]
    pub const fn of_groove(zone: Zone, depth: f32) -> Self {
        Self {
            zone,
            strength: None,
            toughness: None,
            weak_points: None,
            groove: Some(depth),
        }
    }

    /// Replaces the factors that the patch names.
    pub(super) fn paint(&self, factors: &mut Factors) {
        if let Some(strength) = self.strength {
            factors.strength = strength;
            factors.toughness = Factors::of_strength(strength).toughness;
        }
        if let Some(toughness) = self.toughness {
            factors.toughness = toughness;
        }
        if let Some(weak_points) = self.weak_points {
            factors.weak_points = weak_points;
        }
        if let Some(groove) = self.groove {
            factors.groove = groove;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_hold_what_brute_force_finds_in_them() {
        let tube = Zone::Tube {
            line: vec![
                Vec3::ZERO,
                Vec3::X,
                Vec3::new(1.0, 2.0, 0.0),
                Vec3::new(1.0, 2.0, 0.0),
            ],
            radius: 0.3,
        };
        let slab = Zone::HalfSpace {
            point: Vec3::splat(0.5),
            normal: Vec3::new(0.0, 0.0, 7.0),
        };
        let turned = Zone::Box([Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 2.0, -1.0)]);
        for k in 0..4000_u32 {
            let at = |stride: u32| f32::from(((k * stride) % 997) as u16) / 997.0 * 3.0 - 0.7;
            let p = Vec3::new(at(31), at(173), at(419));
            let samples = (0..=2000).map(|i| i as f32 / 1000.0);
            let nearest = samples
                .map(|t| {
                    let q = if t <= 1.0 {
                        Vec3::X * t
                    } else {
                        Vec3::X + Vec3::Y * (2.0 * (t - 1.0))
                    };
                    p.distance(q)
                })
                .fold(f32::INFINITY, f32::min);
            if (nearest - 0.3).abs() > 1e-3 {
                assert_eq!(tube.contains(p), nearest < 0.3, "{p}");
            }
            assert_eq!(slab.contains(p), p.z <= 0.5);
            let inside = (0.0..=1.0).contains(&p.x)
                && (0.0..=2.0).contains(&p.y)
                && (-1.0..=1.0).contains(&p.z);
            assert_eq!(turned.contains(p), inside, "{p}");
        }
    }
}
