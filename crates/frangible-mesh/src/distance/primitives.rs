//! Signed distances of simple bodies, m, negative inside. All are exact or, where said, lower bounds of the true
//! magnitude; all change by no more than the way gone.
//!
//! The forms of the round cone, box and torus follow Inigo Quilez' collection of distance functions.

use glam::{DVec2, DVec3};

/// Distance to a ball's surface. `p` from its centre, m; `radius`, m.
pub fn sphere(p: DVec3, radius: f64) -> f64 {
    p.length() - radius
}

/// Distance to an ellipsoid along the axes around the origin; exact to rounding. `radii`: half its lengths, m.
///
/// The closest point of the surface is x_i = r_i² p_i / (t + r_i²) with the largest t for which
/// Σ (r_i p_i / (t + r_i²))² = 1 (Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid").
pub fn ellipsoid(p: DVec3, radii: DVec3) -> f64 {
    let (t, scaled) = ellipsoid_root(p, radii);
    t * scaled.length()
}

/// Distance to an ellipsoid with its gradient, which is the normal at the closest point.
pub(super) fn sloped_ellipsoid(p: DVec3, radii: DVec3) -> (f64, DVec3) {
    let (t, scaled) = ellipsoid_root(p, radii);
    let gradient = scaled.normalize_or_zero().copysign(p);
    (t * scaled.length(), gradient)
}

/// t, and |p_i| / (t + r_i²): normal to the surface at the closest point.
fn ellipsoid_root(p: DVec3, radii: DVec3) -> (f64, DVec3) {
    let radii = radii.max(DVec3::splat(f64::MIN_POSITIVE.sqrt()));
    // Off the planes of symmetry, where the closest point is not unique; moving there shortens no way.
    let p = p.abs().max(1e-9 * radii);
    let squares = radii * radii;
    let scaled = radii * p;
    // Here one term of the sum is 1: left of the root, by little.
    let mut t = (scaled - squares).max_element();
    for _ in 0..40 {
        let inverse = 1.0 / (t + squares);
        let terms = scaled * inverse;
        let sum = terms.length_squared();
        let norm = sum.sqrt();
        // Newton's step on 1/√sum = 1: increasing and concave, so that it never passes the root.
        let step = (norm - 1.0) * sum / (terms * terms).dot(inverse);
        t += step;
        if step.abs() <= 1e-15 * squares.max_element() || step.is_nan() {
            break;
        }
    }
    (t, p / (t + squares))
}

/// Distance to the hull of two balls at `a` and `b`, m, with radii `radius_a` and `radius_b`, m. A capsule where
/// they are equal.
pub fn round_cone(p: DVec3, a: DVec3, radius_a: f64, b: DVec3, radius_b: f64) -> f64 {
    let axis = b - a;
    let length2 = axis.length_squared();
    let taper = radius_a - radius_b;
    let slant2 = length2 - taper * taper;
    if slant2 <= 0.0 {
        // One ball holds the other.
        return if taper > 0.0 {
            (p - a).length() - radius_a
        } else {
            (p - b).length() - radius_b
        };
    }
    let from_a = p - a;
    let along = from_a.dot(axis);
    let past = along - length2;
    let radial2 = (from_a * length2 - axis * along).length_squared();
    let limit = taper.signum() * taper * taper * radial2;
    if past.signum() * slant2 * past * past * length2 > limit {
        return (p - b).length() - radius_b;
    }
    if along.signum() * slant2 * along * along * length2 < limit {
        return from_a.length() - radius_a;
    }
    ((radial2 * slant2 / length2).sqrt() + along * taper) / length2 - radius_a
}

/// The distance of [`round_cone`] with its gradient.
pub(super) fn sloped_round_cone(
    p: DVec3,
    a: DVec3,
    radius_a: f64,
    b: DVec3,
    radius_b: f64,
) -> (f64, DVec3) {
    let value = round_cone(p, a, radius_a, b, radius_b);
    let axis = b - a;
    let length2 = axis.length_squared();
    let taper = radius_a - radius_b;
    // The nearest ball of those along the axis: exact for either end and for the slant between.
    let slant2 = length2 - taper * taper;
    if slant2 <= 0.0 {
        let centre = if taper > 0.0 { a } else { b };
        return (value, (p - centre).normalize_or_zero());
    }
    let from_a = p - a;
    let along = from_a.dot(axis) / length2;
    let radial = (from_a - along * axis).length();
    let nearest = (along - radial * taper / (slant2 * length2).sqrt()).clamp(0.0, 1.0);
    (value, (p - a - nearest * axis).normalize_or_zero())
}

/// Distance to a box around the origin. `half`: half its edges, m; `rounding`: radius of edges and corners within
/// those, m.
pub fn rounded_box(p: DVec3, half: DVec3, rounding: f64) -> f64 {
    let q = p.abs() - half + DVec3::splat(rounding);
    q.max(DVec3::ZERO).length() + q.max_element().min(0.0) - rounding
}

/// Distance to a cylinder around the z axis and the origin. `radius` and `half_height`, m; `rounding`: radius of its
/// rims within those, m.
pub fn cylinder(p: DVec3, radius: f64, half_height: f64, rounding: f64) -> f64 {
    let q = DVec2::new(
        p.truncate().length() - radius + rounding,
        p.z.abs() - half_height + rounding,
    );
    q.max(DVec2::ZERO).length() + q.max_element().min(0.0) - rounding
}

/// Distance to a torus around the z axis and the origin. `ring`: radius of its centre line, m; `tube`: radius of its
/// section, m.
pub fn torus(p: DVec3, ring: f64, tube: f64) -> f64 {
    DVec2::new(p.truncate().length() - ring, p.z).length() - tube
}

/// Distance to the half-space on the side of the origin that `normal` (unit) points away from, up to `offset` along
/// it, m.
pub fn half_space(p: DVec3, normal: DVec3, offset: f64) -> f64 {
    p.dot(normal) - offset
}

/// Distance in the plane to a closed polygon. `points` in either sense, m; infinite for less than three. An edge
/// for which `seam` holds bounds nothing: it lies inside the body of which the polygon is a part.
pub fn polygon(p: DVec2, points: &[DVec2], seam: impl Fn(DVec2, DVec2) -> bool) -> f64 {
    let Some(&last) = points.last().filter(|_| points.len() > 2) else {
        return f64::INFINITY;
    };
    let mut nearest2 = f64::INFINITY;
    let mut inside = false;
    let mut from = last;
    for &to in points {
        let edge = to - from;
        let way = p - from;
        if !seam(from, to) {
            let at = (way.dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            nearest2 = nearest2.min((way - at * edge).length_squared());
        }
        if (from.y > p.y) != (to.y > p.y) && p.x < from.x + (p.y - from.y) / edge.y * edge.x {
            inside = !inside;
        }
        from = to;
    }
    if inside {
        -nearest2.sqrt()
    } else {
        nearest2.sqrt()
    }
}

/// Distance to the body that a closed polygon of (radius, height) points sweeps around the z axis. `profile`, m.
pub fn revolved(p: DVec3, profile: &[DVec2]) -> f64 {
    let q = DVec2::new(p.truncate().length(), p.z);
    polygon(q, profile, |a, b| a.x <= 0.0 && b.x <= 0.0)
}

/// Distance to a prism: a closed polygon in x and y, from -`half_height` to `half_height` along z. All m.
pub fn prism(p: DVec3, outline: &[DVec2], half_height: f64) -> f64 {
    let q = DVec2::new(
        polygon(p.truncate(), outline, |_, _| false),
        p.z.abs() - half_height,
    );
    q.max(DVec2::ZERO).length() + q.max_element().min(0.0)
}
