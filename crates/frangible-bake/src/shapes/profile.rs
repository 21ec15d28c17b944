//! Profile of a body of revolution with a wall: an outer and an inner curve.

use crate::error::BakeError;

/// One station of a profile: a point of the outer and a point of the inner surface, each (r, z) in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Outer point: distance from the axis and height, m.
    pub outer: [f64; 2],
    /// Inner point: distance from the axis and height, m.
    pub inner: [f64; 2],
    /// True for a sharp corner: the curve is straight up to this station and starts again; mesh vertices lie exactly on it.
    pub corner: bool,
}

impl Station {
    /// A smooth station.
    #[must_use]
    pub const fn smooth(outer: [f64; 2], inner: [f64; 2]) -> Self {
        Self {
            outer,
            inner,
            corner: false,
        }
    }

    /// A sharp station.
    #[must_use]
    pub const fn sharp(outer: [f64; 2], inner: [f64; 2]) -> Self {
        Self {
            outer,
            inner,
            corner: true,
        }
    }
}

/// Samples per span between stations: fine enough that no element sees the chords.
const SAMPLES: usize = 48;

/// A sampled profile, by arc length of the curve midway between outer and inner.
#[derive(Clone, Debug)]
pub(crate) struct Profile {
    /// Arc length of each sample, m.
    pub(crate) arc: Vec<f64>,
    /// Outer and inner point of each sample: `[r, z, r, z]`, m.
    pub(crate) points: Vec<[f64; 4]>,
    /// Arc lengths of the corners, both ends included, m.
    pub(crate) corners: Vec<f64>,
}

impl Profile {
    /// Checks the stations and samples the curves: a monotone cubic through smooth stations.
    pub(crate) fn new(stations: &[Station]) -> Result<Self, BakeError> {
        validate(stations)?;
        let p: Vec<[f64; 4]> = stations
            .iter()
            .map(|s| [s.outer[0], s.outer[1], s.inner[0], s.inner[1]])
            .collect();
        let n = p.len();
        // Knots by the length of the mid-line's chords keep the spline from overshooting.
        let chord: Vec<f64> = (0..n - 1)
            .map(|i| distance(middle(p[i]), middle(p[i + 1])))
            .collect();
        let slope =
            |i: usize| -> [f64; 4] { std::array::from_fn(|k| (p[i + 1][k] - p[i][k]) / chord[i]) };
        let tangent = |i: usize, span: usize| -> [f64; 4] {
            if i == 0 {
                // The surface meets the axis at a right angle: heights are level there.
                let s = slope(0);
                [s[0], 0.0, s[2], 0.0]
            } else if i + 1 == n || stations[i].corner {
                slope(span)
            } else {
                let (before, after, total) = (slope(i - 1), slope(i), chord[i - 1] + chord[i]);
                std::array::from_fn(|k| {
                    // Fritsch and Carlson's limit: the curve never overshoots, a flat foot stays flat.
                    let mean = (before[k] * chord[i] + after[k] * chord[i - 1]) / total;
                    let most = 3.0 * before[k].abs().min(after[k].abs());
                    if before[k] * after[k] > 0.0 {
                        mean.clamp(-most, most)
                    } else {
                        0.0
                    }
                })
            }
        };
        let (mut points, mut breaks) = (vec![p[0]], vec![0]);
        for i in 0..n - 1 {
            let (m0, m1, h) = (tangent(i, i), tangent(i + 1, i), chord[i]);
            for step in 1..=SAMPLES {
                let t = step as f64 / SAMPLES as f64;
                let (t2, t3) = (t * t, t * t * t);
                points.push(std::array::from_fn(|k| {
                    (2.0 * t3 - 3.0 * t2 + 1.0) * p[i][k]
                        + (t3 - 2.0 * t2 + t) * h * m0[k]
                        + (3.0 * t2 - 2.0 * t3) * p[i + 1][k]
                        + (t3 - t2) * h * m1[k]
                }));
            }
            if stations[i + 1].corner || i + 2 == n {
                breaks.push(points.len() - 1);
            }
        }
        if let Some(at) = points
            .iter()
            .skip(1)
            .position(|q| q[0] <= 0.0 || q[2] <= 0.0)
        {
            return Err(BakeError::Profile {
                station: at / SAMPLES,
                problem: "the curve after it crosses the axis; add a station or mark a corner",
            });
        }
        let mut arc = vec![0.0];
        for w in points.windows(2) {
            arc.push(arc[arc.len() - 1] + distance(middle(w[0]), middle(w[1])));
        }
        let corners = breaks.iter().map(|&b| arc[b]).collect();
        Ok(Self {
            arc,
            points,
            corners,
        })
    }

    /// Length of the mid-line, m.
    pub(crate) fn length(&self) -> f64 {
        self.arc[self.arc.len() - 1]
    }

    /// Outer and inner point at arc length `s`, extended straight beyond the ends.
    pub(crate) fn at(&self, s: f64) -> [f64; 4] {
        let i = self
            .arc
            .partition_point(|&a| a <= s)
            .clamp(1, self.arc.len() - 1)
            - 1;
        let t = (s - self.arc[i]) / (self.arc[i + 1] - self.arc[i]);
        std::array::from_fn(|k| self.points[i][k] + t * (self.points[i + 1][k] - self.points[i][k]))
    }

    /// Point (r, z) midway between the surfaces at arc length `s`, m.
    pub(crate) fn middle(&self, s: f64) -> [f64; 2] {
        middle(self.at(s))
    }

    /// Area of the mid-surface (m²) and volume (m³) of the whole body of revolution.
    pub(crate) fn area_and_volume(&self) -> (f64, f64) {
        let (mut area, mut volume) = (0.0, 0.0);
        let tau = std::f64::consts::TAU;
        for (w, s) in self.points.windows(2).zip(self.arc.windows(2)) {
            area += tau * 0.5 * (middle(w[0])[0] + middle(w[1])[0]) * (s[1] - s[0]);
            // Two triangles of the quadrilateral outer–outer–inner–inner, swept (Pappus).
            let [a, b] = [[w[0][0], w[0][1]], [w[1][0], w[1][1]]];
            let [d, c] = [[w[0][2], w[0][3]], [w[1][2], w[1][3]]];
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let double = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
                volume += tau * 0.5 * double * (p[0] + q[0] + r[0]) / 3.0;
            }
        }
        (area, volume.abs())
    }
}

fn middle(p: [f64; 4]) -> [f64; 2] {
    [0.5 * (p[0] + p[2]), 0.5 * (p[1] + p[3])]
}

pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn validate(stations: &[Station]) -> Result<(), BakeError> {
    let fail = |station: usize, problem: &'static str| Err(BakeError::Profile { station, problem });
    if stations.len() < 2 {
        return fail(0, "a profile needs at least two stations");
    }
    for (i, s) in stations.iter().enumerate() {
        if s.outer.iter().chain(&s.inner).any(|x| !x.is_finite()) {
            return fail(i, "every number must be finite");
        }
        let on_axis = s.outer[0] == 0.0 && s.inner[0] == 0.0;
        if i == 0 && !on_axis {
            return fail(
                i,
                "the first station must lie on the axis: r = 0 for both points",
            );
        }
        if i > 0 && (s.outer[0] <= 0.0 || s.inner[0] <= 0.0) {
            return fail(
                i,
                "only the first station may lie on the axis; give both points r > 0",
            );
        }
        if distance(s.outer, s.inner) <= 0.0 {
            return fail(
                i,
                "outer and inner point coincide; give the wall a thickness",
            );
        }
    }
    for (i, w) in stations.windows(2).enumerate() {
        let m = |s: &Station| middle([s.outer[0], s.outer[1], s.inner[0], s.inner[1]]);
        if distance(m(&w[0]), m(&w[1])) <= 0.0 {
            return fail(
                i + 1,
                "it coincides with the station before it; remove one of them",
            );
        }
    }
    Ok(())
}
