//! Pairs of borders and rims that lie beside each other, and the positions on a border at which the points of its rim are laid.

use glam::DVec3;

/// Points of a line at which its distance from another is measured, at most.
const SAMPLES: usize = 16;

/// Distance ahead on the border in which the next point of a rim is looked for, in lengths of the way to it. The search reaches at least
/// `LEAD` beyond the point's place if both lines were equally long everywhere, in shares of the border.
const AHEAD: f64 = 4.0;
const LEAD: f64 = 0.1;

/// Borders and the rims beside them, no farther away than `most`, m, in the mean; the closest first, each in one pair at most.
pub(super) fn pairs(borders: &[Vec<DVec3>], rims: &[Vec<DVec3>], most: f64) -> Vec<(usize, usize)> {
    let mut gaps = Vec::new();
    let rim_boxes: Vec<_> = rims.iter().map(|rim| bounds(rim)).collect();
    let rim_sides: Vec<_> = rims.iter().map(|rim| sides_of(rim)).collect();
    for (b, border) in borders.iter().enumerate() {
        let [low, high] = bounds(border);
        let border_sides = sides_of(border);
        for (r, rim) in rims.iter().enumerate() {
            let [l, h] = rim_boxes[r];
            if (l - high).max(low - h).max_element() > most {
                continue;
            }
            // From a speck the way to a long line is short, but not the way back.
            let there = gap(border, &rim_sides[r], most);
            let gap = there.and_then(|there| Some(gap(rim, &border_sides, most)?.max(there)));
            gaps.extend(gap.map(|gap| (gap, b, r)));
        }
    }
    gaps.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for (_, b, r) in gaps {
        if pairs.iter().all(|pair| pair.0 != b && pair.1 != r) {
            pairs.push((b, r));
        }
    }
    pairs
}

fn bounds(points: &[DVec3]) -> [DVec3; 2] {
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    points.iter().fold(none, |[l, h], &p| [l.min(p), h.max(p)])
}

/// Mean distance of points of one line from another, m, unless it is more than `most`.
fn gap(from: &[DVec3], to: &[Side], most: f64) -> Option<f64> {
    let every = from.len().div_ceil(SAMPLES);
    let samples = from.iter().step_by(every);
    let count = samples.len() as f64;
    let mut sum = 0.0;
    for p in samples {
        sum += nearest(to, *p).1.sqrt();
        if sum > most * count {
            return None;
        }
    }
    Some(sum / count)
}

/// A side of a ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    from: DVec3,
    along: DVec3,
    /// m.
    length: f64,
    /// One over the square of its length, 1/m²; 0 of one without length.
    inverse: f64,
}

impl Side {
    pub(super) fn new(from: DVec3, to: DVec3) -> Self {
        let along = to - from;
        let square = along.length_squared();
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Self {
            from,
            along,
            length: square.sqrt(),
            inverse,
        }
    }

    pub(super) fn nearest(&self, p: DVec3) -> DVec3 {
        let share = (p - self.from).dot(self.along) * self.inverse;
        self.from + self.along * share.clamp(0.0, 1.0)
    }
}

/// The sides of a ring, from each point to the next.
fn sides_of(ring: &[DVec3]) -> Vec<Side> {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(&from, &to)| Side::new(from, to))
        .collect()
}

/// The side of a ring nearest to a point, and how far away it is, squared, m².
fn nearest(ring: &[Side], p: DVec3) -> (usize, f64) {
    let mut best = (0, f64::INFINITY);
    for (i, side) in ring.iter().enumerate() {
        let squared = side.nearest(p).distance_squared(p);
        if squared < best.1 {
            best = (i, squared);
        }
    }
    best
}

/// Lays a rim that runs along a border on it. For each point, returns its side of the border, counted from the first, and its position. No
/// point is laid before the one before it, so that a border which comes back to itself is followed and not crossed.
pub(super) fn lay(border: &[DVec3], rim: &[DVec3], at_corner: f64) -> Vec<(usize, DVec3)> {
    let count = border.len();
    let mut sides = sides_of(border);
    let begin = nearest(&sides, rim[0]).0;
    sides.rotate_left(begin);
    let at = |side: usize| border[(begin + side) % count];
    let snapped = |place: DVec3, side: usize| {
        let near = |end: &DVec3| end.distance(place) <= at_corner;
        let ends = [at(side), at(side + 1)];
        ends.into_iter().find(near).unwrap_or(place)
    };
    let place = snapped(sides[0].nearest(rim[0]), 0);
    let whole: f64 = sides.iter().map(|side| side.length).sum();
    // The side where it begins has a rest.
    sides.push(Side::new(border[begin], place));
    let rim_length = |j: usize| rim[j].distance(rim[(j + 1) % rim.len()]);
    let rim_whole: f64 = (0..rim.len()).map(rim_length).sum();
    let mut laid = vec![(begin, place)];
    // Sides that have been passed, their length, and the length of the rim.
    let (mut side, mut passed, mut run) = (0, 0.0, 0.0);
    for j in 1..rim.len() {
        let step = rim_length(j - 1);
        run += step;
        let ahead = AHEAD * (step + rim[j].distance(laid[j - 1].1));
        let most = (passed + ahead).max(whole * (run / rim_whole + LEAD));
        let mut best = (f64::INFINITY, side, passed, laid[j - 1].1);
        let mut length = passed;
        let end = if side == count { place } else { at(side + 1) };
        let rest = Side::new(laid[j - 1].1, end);
        let ahead = [&rest].into_iter().chain(&sides[side + 1..]);
        for (s, on) in (side..).zip(ahead) {
            let near = on.nearest(rim[j]);
            let squared = near.distance_squared(rim[j]);
            if squared < best.0 {
                best = (squared, s, length + on.from.distance(near), near);
            }
            length += on.length;
            if length > most {
                break;
            }
        }
        (side, passed) = (best.1, best.2);
        laid.push((begin + side, snapped(best.3, side)));
    }
    laid
}
