//! Operators on signed distances. None changes faster than its operands, so a bound stays a bound.

/// Least of two distances, rounded within `blend`, m: at most `blend`/4 below the sharp one, and the sharp one
/// where they differ by `blend` or more. Its gradient is a mean of both operands', so never longer.
pub fn smooth_min(a: f64, b: f64, blend: f64) -> f64 {
    if blend <= 0.0 {
        return a.min(b);
    }
    let share = (1.0 - (a - b).abs() / blend).max(0.0);
    a.min(b) - 0.25 * blend * share * share
}

/// Largest of two distances, rounded within `blend`, m: see [`smooth_min`].
pub fn smooth_max(a: f64, b: f64, blend: f64) -> f64 {
    -smooth_min(-a, -b, blend)
}
