//! Solids: inside tests and distance to the surface.

use glam::DVec3;

/// The closest point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position, m.
    pub position: DVec3,
    /// Unit normal there, outwards.
    pub normal: DVec3,
}

/// A solid, defined by an inside test. Implemented for mesh surfaces (winding number) and signed distance functions.
pub trait Solid: Send + Sync {
    /// Lowest and highest corner of a box that holds the body, m.
    fn bounds(&self) -> [DVec3; 2];

    /// Distance to the surface, m, negative inside. Its magnitude may be smaller than the true distance, never larger.
    fn signed_distance(&self, p: DVec3) -> f64;

    /// Returns true if `p` lies inside the body.
    fn inside(&self, p: DVec3) -> bool {
        self.signed_distance(p) < 0.0
    }

    /// Point at which the segment from a point inside to one outside leaves the body, to 1e-9 of its length.
    fn crossing(&self, inside: DVec3, outside: DVec3) -> DVec3 {
        let at = |t: f64| inside.lerp(outside, t);
        at(sign_change(|t| self.signed_distance(at(t)), 1e-9))
    }

    /// Closest point of the surface, with its normal. Exact for mesh surfaces; for distances, by Newton steps along
    /// the gradient.
    fn closest(&self, p: DVec3) -> SurfacePoint {
        let (position, _, normal) = newton(p, f64::INFINITY, self.bounds(), |x| self.gradient(x));
        SurfacePoint { position, normal }
    }

    /// Signed distance and its gradient; by central differences unless the body knows better.
    fn gradient(&self, p: DVec3) -> (f64, DVec3) {
        let [low, high] = self.bounds();
        let h = 1e-6 * (high - low).max_element();
        let along = |e: DVec3| self.signed_distance(p + h * e) - self.signed_distance(p - h * e);
        let gradient = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)) / (2.0 * h);
        (self.signed_distance(p), gradient)
    }

    /// Position of [`Solid::closest`] if it is no farther than `within`, m: a bound that makes it quick.
    fn foot(&self, p: DVec3, within: f64) -> Option<DVec3> {
        let position = self.closest(p).position;
        (position.distance(p) <= within).then_some(position)
    }

    /// Distance that a ray from a point inside runs until it leaves the body, m; `None` if it starts outside. `direction` is
    /// a unit vector. Found by sphere tracing: steps as long as the distance allows.
    fn exit(&self, from: DVec3, direction: DVec3) -> Option<f64> {
        let [low, high] = self.bounds();
        let size = (high - low).length();
        let least = 1e-5 * size;
        let mut t = 0.0;
        let mut distance = self.signed_distance(from);
        if distance >= 0.0 {
            return None;
        }
        while t <= size {
            let next = t + least.max(-distance);
            distance = self.signed_distance(from + next * direction);
            if distance >= 0.0 {
                let out = self.crossing(from + t * direction, from + next * direction);
                return Some((out - from).dot(direction));
            }
            t = next;
        }
        None
    }
}

/// Newton steps along the gradient to the surface: the place reached, the distance left and the unit normal there.
/// None are gone where the distance says that the surface is farther than `within`, m.
pub(crate) fn newton(
    p: DVec3,
    within: f64,
    [low, high]: [DVec3; 2],
    gradient: impl Fn(DVec3) -> (f64, DVec3),
) -> (DVec3, f64, DVec3) {
    let h = 1e-6 * (high - low).max_element();
    let mut x = p;
    let (mut d, mut g) = gradient(x);
    let steps = if d.abs() > within { 0 } else { 8 };
    for _ in 0..steps {
        if d.abs() < h {
            break;
        }
        x -= d / g.length_squared().max(0.25) * g;
        (d, g) = gradient(x);
    }
    (x, d, g.normalize_or(DVec3::Y))
}

/// A place in 0..1 where `f`, negative at 0 and not at 1, changes its sign, to `tolerance`; a jump will do. By
/// interpolation, truncation and projection: as quick as a secant where `f` is smooth, and never more than one step
/// slower than bisection [Oliveira & Takahashi 2020, Algorithm 1].
pub(crate) fn sign_change(f: impl Fn(f64) -> f64, tolerance: f64) -> f64 {
    let (mut a, mut b) = (0.0_f64, 1.0_f64);
    let (mut at_a, mut at_b) = (f(a).min(-f64::MIN_POSITIVE), f(b).max(0.0));
    let bisections = (0.5 / tolerance).log2().ceil().max(0.0) as i32 + 1;
    for step in 0..=bisections {
        if b - a <= 2.0 * tolerance {
            break;
        }
        let middle = 0.5 * (a + b);
        let secant = (at_b * a - at_a * b) / (at_b - at_a);
        let truncation = (0.2 * (b - a).powi(2)).min((middle - secant).abs());
        let truncated = secant + truncation.copysign(middle - secant);
        let room = (tolerance * 2.0_f64.powi(bisections - step) - 0.5 * (b - a)).max(0.0);
        let offset = truncated - middle;
        let t = middle + offset.abs().min(room).copysign(offset);
        let value = f(t);
        if value < 0.0 {
            (a, at_a) = (t, value);
        } else {
            (b, at_b) = (t, value);
        }
    }
    0.5 * (a + b)
}
