//! Arrival times of a crack's front at the tetrahedra ahead.
//!
//! A front spreads over the crack's own surface at one speed, from where the crack started or waited last: its *source*. It gets to a place at
//! the straight distance from there, whichever tetrahedra it passes on its way: hops from one centre to the next are longer, by more than a
//! third in a mesh of one layer. Distances are along the surface: where the crack bends between two tetrahedra the source is turned about the
//! line between them into the plane of the next (J. S. B. Mitchell, D. M. Mount, C. H. Papadimitriou, SIAM J. Comput. 16 (1987) 647). What the source
//! does not see past the end of that line, because the crack does not go there, is reached round that end.

use glam::Vec3;

use super::single::ElementCut;
use super::system::CrackSystem;
use crate::mesh::FACES;

/// Origin of a front that runs in a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Source {
    /// The place, m, in the plane of the crack where the front is.
    pub(crate) place: Vec3,
    /// Time at which the front was there, s.
    pub(crate) since: f64,
}

impl Source {
    /// Source of a front that waited: it comes from where it is.
    pub(super) const WAITED: Self = Self {
        place: Vec3::ZERO,
        since: f64::NEG_INFINITY,
    };
}

/// An end of the line on which a crack crosses a face.
#[derive(Clone, Copy)]
struct End {
    at: Vec3,
    /// The other face of the tetrahedron that the crack crosses up to there.
    beside: usize,
}

/// The line on which a crack of these values, m, crosses a face of a tetrahedron; none where it misses it.
fn line(x: &[Vec3; 4], s: &[f32; 4], face: usize) -> Option<[End; 2]> {
    let nodes = FACES[face];
    let negative = nodes.map(|i| s[i] < 0.0);
    let count = negative.iter().filter(|&&n| n).count();
    let lone = negative.iter().position(|&n| n == (count == 1))?;
    if count % 3 == 0 {
        return None;
    }
    let [i, j, k] = [0, 1, 2].map(|turn| nodes[(lone + turn) % 3]);
    let end = |to: usize, beside: usize| End {
        at: x[i] + (x[to] - x[i]) * (s[i] / (s[i] - s[to])),
        beside,
    };
    Some([end(j, k), end(k, j)])
}

/// Middle of the line on which a crack crosses a face, m; that of the face where there is no such line.
pub(super) fn gate(x: &[Vec3; 4], s: &[f32; 4], face: usize) -> Vec3 {
    match line(x, s, face) {
        Some([a, b]) => 0.5 * (a.at + b.at),
        None => FACES[face].iter().map(|&i| x[i]).sum::<Vec3>() / 3.0,
    }
}

/// A tetrahedron that a front has entered.
pub(super) struct Entered {
    /// Source of the front.
    source: Source,
    /// The line on which it came in, and on which side of that the tetrahedron lies; none where the crack starts.
    line: Option<([End; 2], Vec3)>,
}

impl Entered {
    /// The tetrahedron where a crack starts.
    pub(super) fn at_start(source: Source) -> Self {
        Self { source, line: None }
    }

    /// A tetrahedron, `x` its corners, m, entered through a face by the front from this source.
    pub(super) fn through(x: &[Vec3; 4], cut: &ElementCut, face: usize, source: Source) -> Self {
        let Some(ends) = line(x, &cut.values, face) else {
            return Self::at_start(source);
        };
        let along = (ends[1].at - ends[0].at).normalize_or_zero();
        let across = cut.direction.cross(along).normalize_or_zero();
        let [p, q, r] = FACES[face].map(|i| x[i]);
        let normal = (q - p).cross(r - p);
        let across = across * (normal.dot(across) * normal.dot(x[face] - p)).signum();
        let from = source.place - ends[0].at;
        let t = from.dot(along);
        let away = (from.length_squared() - t * t).max(0.0).sqrt();
        let place = ends[0].at + along * t - across * away;
        Self {
            source: Source { place, ..source },
            line: Some((ends, across)),
        }
    }

    /// The source of the front that leaves at a place, m, at this speed, m/s. `is_open`: whether the crack has cut what lies behind a face.
    fn seen_from(&self, gate: Vec3, speed: f64, is_open: impl Fn(usize) -> bool) -> Source {
        let Some(([a, b], across)) = &self.line else {
            return self.source;
        };
        let place = self.source.place;
        let [before, after] = [place, gate].map(|p| (p - a.at).dot(*across));
        if after <= before {
            return self.source;
        }
        let crossing = place + (gate - place) * (-before / (after - before)).clamp(0.0, 1.0);
        let line = b.at - a.at;
        let share = (crossing - a.at).dot(line) / line.length_squared();
        let corner = match share {
            share if share < 0.0 => a,
            share if share > 1.0 => b,
            _ => return self.source,
        };
        if is_open(corner.beside) {
            return self.source;
        }
        let way = f64::from(place.distance(corner.at));
        Source {
            place: corner.at,
            since: self.source.since + way / speed,
        }
    }
}

impl CrackSystem<'_> {
    /// Time at which the front of a crack that has cut a tetrahedron leaves it through a face, s, at this speed, m/s, and the front's source.
    pub(super) fn leaves(
        &self,
        crack: u32,
        cut: &ElementCut,
        entered: &Entered,
        face: usize,
        speed: f64,
    ) -> (f64, Source) {
        let mesh = &self.asset.fracture;
        let gate = gate(&mesh.corners(cut.tet as usize), &cut.values, face);
        let source = entered.seen_from(gate, speed, |beside| {
            let beyond = mesh.neighbours[cut.tet as usize][beside];
            self.fractured_by.get(beyond as usize) == Some(&crack)
        });
        let arrival = source.since + f64::from(gate.distance(source.place)) / speed;
        (arrival.max(cut.time), source)
    }
}
