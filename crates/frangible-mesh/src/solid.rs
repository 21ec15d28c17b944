//! What the mesher asks of a body: where is inside, how far is the surface.

use glam::DVec3;

/// The surface's point closest to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where, m.
    pub position: DVec3,
    /// Unit normal there, outwards.
    pub normal: DVec3,
}

/// A body given by its inside. Implemented by mesh surfaces (winding number) and by signed distances.
pub trait Solid: Send + Sync {
    /// Lowest and highest corner of a box that holds the body, m.
    fn bounds(&self) -> [DVec3; 2];

    /// Distance to the surface, m, negative inside. Its magnitude may be smaller than the true distance, never larger.
    fn signed_distance(&self, p: DVec3) -> f64;

    /// Whether the body holds `p`.
    fn inside(&self, p: DVec3) -> bool {
        self.signed_distance(p) < 0.0
    }

    /// Where the segment from a point inside to one outside leaves the body.
    fn crossing(&self, inside: DVec3, outside: DVec3) -> DVec3 {
        // The bracket always holds a change of sign; a secant step inside it, kept off the ends, halves it at least
        // every other time.
        let (mut a, mut b) = (0.0_f64, 1.0_f64);
        let at = |t: f64| inside + t * (outside - inside);
        let (mut fa, mut fb) = (self.signed_distance(inside), self.signed_distance(outside));
        for step in 0..40 {
            if b - a < 1e-9 {
                break;
            }
            let secant = if step % 3 == 2 || fb <= fa {
                0.5
            } else {
                (-fa / (fb - fa)).clamp(0.02, 0.98)
            };
            let t = a + secant * (b - a);
            let f = self.signed_distance(at(t));
            if f < 0.0 {
                (a, fa) = (t, f);
            } else {
                (b, fb) = (t, f);
            }
            if f.abs() < 1e-9 * (outside - inside).length() {
                break;
            }
        }
        at(if -fa < fb { a } else { b })
    }

    /// Closest point of the surface, with its normal. Exact for mesh surfaces; for distances, by Newton steps along
    /// the gradient.
    fn closest(&self, p: DVec3) -> SurfacePoint {
        let [low, high] = self.bounds();
        let h = 1e-6 * (high - low).max_element();
        let gradient = |x: DVec3| {
            DVec3::new(
                self.signed_distance(x + h * DVec3::X) - self.signed_distance(x - h * DVec3::X),
                self.signed_distance(x + h * DVec3::Y) - self.signed_distance(x - h * DVec3::Y),
                self.signed_distance(x + h * DVec3::Z) - self.signed_distance(x - h * DVec3::Z),
            ) / (2.0 * h)
        };
        let mut x = p;
        for _ in 0..8 {
            let d = self.signed_distance(x);
            if d.abs() < h {
                break;
            }
            let g = gradient(x);
            x -= d / g.length_squared().max(0.25) * g;
        }
        SurfacePoint {
            position: x,
            normal: gradient(x).normalize_or(DVec3::Y),
        }
    }
}
