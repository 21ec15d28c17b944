//! Where a fragment's share of the author's surface ends, its crack faces go on.
//!
//! The fracture mesh only follows the author's surface, so the two borders are two lines close to each other. The rim of the crack faces is
//! laid on the border of the share, and what stays open between the two lines is closed by triangles which have hardly any area. A border
//! that has none of the other kind beside it is closed by itself: of a speck, say, that one of the two does not have.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use super::assemble::Vertices;

/// Points of a border of which its distance from another is taken.
const SAMPLES: usize = 16;

/// A rim lies no farther than so many reaches from the border that it belongs to, in the mean.
const FAR: f64 = 2.0;

/// How far ahead on the border the next point of a rim is looked for, in lengths of the way to it; and in any case so much beyond where it would be if
/// both were equally long everywhere, in shares of the border.
const AHEAD: f64 = 4.0;
const LEAD: f64 = 0.1;

/// A line without ends.
#[derive(Debug)]
struct Ring {
    /// Its points in order, by number.
    points: Vec<u32>,
    /// How many of its sides are on the border of a hole.
    on_hole: usize,
}

impl Ring {
    /// Whether it is nothing but the border of a hole.
    fn is_hole(&self) -> bool {
        self.on_hole == self.points.len()
    }

    fn places(&self, at: impl Fn(u32) -> DVec3) -> Vec<DVec3> {
        self.points.iter().map(|&v| at(v)).collect()
    }
}

/// What closes a fragment.
#[derive(Debug, Default)]
pub(super) struct Seam {
    /// Points of the rim of the crack faces, and where they are laid, m.
    pub(super) moved: BTreeMap<u32, DVec3>,
    pub(super) triangles: Vertices,
}

/// Closes a fragment between its share of the surface and its crack faces. `sheet`: sides of the share's polygons, and whether they are on the
/// border of a hole; those that run both ways are no border. `may_end`: whether crack faces may end at a point. `reach`: how far the rim is moved at most, m. `closed`: whether the surface is.
/// Where it is not, a rim without a border beside it lies in a hole, and stays open as the hole does.
pub(super) fn close(
    sheet: Vec<([u32; 2], bool)>,
    sheet_at: impl Fn(u32) -> DVec3,
    faces: &[[u32; 3]],
    may_end: impl Fn(u32) -> bool,
    face_at: impl Fn(u32) -> DVec3,
    normal_at: impl Fn(u32) -> Vec3,
    reach: f64,
    closed: bool,
) -> Seam {
    let mut borders = rings(&open(sheet.into_iter()));
    borders.retain(|border| !border.is_hole());
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let sides = sides.filter(|&[a, b]| may_end(a) && may_end(b));
    let mut rims = rings(&open(sides.map(|side| (side, false))));
    // The other way round it runs beside the border.
    rims.iter_mut().for_each(|rim| rim.points.reverse());
    let border_places: Vec<Vec<DVec3>> = borders.iter().map(|r| r.places(&sheet_at)).collect();
    let rim_places: Vec<Vec<DVec3>> = rims.iter().map(|r| r.places(&face_at)).collect();
    let pairs = pairs(&border_places, &rim_places, FAR * reach);
    let mut seam = Seam::default();
    let mut sides = Vec::new();
    for &(b, r) in &pairs {
        let laid = lay(&border_places[b], &rim_places[r]);
        for ((_, laid), (&point, &place)) in
            laid.iter().zip(rims[r].points.iter().zip(&rim_places[r]))
        {
            if laid.distance(place) <= reach {
                // Where two rims touch, a point has one place.
                seam.moved.entry(point).or_insert(*laid);
            }
        }
        sides.push(laid.into_iter().map(|(side, _)| side).collect::<Vec<_>>());
    }
    let laid = |v| seam.moved.get(&v).copied().unwrap_or_else(|| face_at(v));
    let mut triangles = Vertices::new();
    for (&(b, r), sides) in pairs.iter().zip(&sides) {
        let normals: Vec<Vec3> = rims[r].points.iter().map(|&v| normal_at(v)).collect();
        zip(
            &border_places[b],
            &rims[r].places(laid),
            sides,
            &normals,
            &mut triangles,
        );
    }
    for (b, border) in borders.iter().enumerate() {
        if border.on_hole == 0 && pairs.iter().all(|pair| pair.0 != b) {
            cap(border_places[b].iter().copied(), &mut triangles);
        }
    }
    for (r, rim) in rims.iter().enumerate() {
        if closed && pairs.iter().all(|pair| pair.1 != r) {
            cap(rim.places(laid).into_iter().rev(), &mut triangles);
        }
    }
    seam.triangles = triangles;
    seam
}

/// Directed sides that are left where one and its reverse take each other away.
fn open(sides: impl Iterator<Item = ([u32; 2], bool)>) -> Vec<([u32; 2], bool)> {
    // Both ends in one number, the lower one first, are sorted faster than an array.
    let mut sides: Vec<(u64, bool, bool)> = sides
        .filter(|([a, b], _)| a != b)
        .map(|([a, b], on_hole)| {
            (
                u64::from(a.min(b)) << 32 | u64::from(a.max(b)),
                a < b,
                on_hole,
            )
        })
        .collect();
    sides.sort_unstable();
    let mut open = Vec::new();
    for same in sides.chunk_by(|x, y| x.0 == y.0) {
        let (ends, _, on_hole) = same[0];
        let [a, b] = [(ends >> 32) as u32, ends as u32];
        let forward = same.iter().filter(|side| side.1).count();
        let back = same.len() - forward;
        let left = |ends, count| std::iter::repeat_n((ends, on_hole), count);
        open.extend(left([a, b], forward.saturating_sub(back)));
        open.extend(left([b, a], back.saturating_sub(forward)));
    }
    open.sort_unstable();
    open
}

/// Rings of sorted sides, as many of which leave each point as lead to it. None passes a point twice: two that touch are two.
fn rings(sides: &[([u32; 2], bool)]) -> Vec<Ring> {
    const NOT_IN_LINE: usize = usize::MAX;
    let leaving = |point| sides.partition_point(|side| side.0[0] < point);
    let mut used = vec![false; sides.len()];
    let mut rings = Vec::new();
    // Place in the line at hand of the point that each side leaves; kept at the first side of a point.
    let mut place = vec![NOT_IN_LINE; sides.len() + 1];
    for first in 0..sides.len() {
        // Points of the line, and whether the side that leaves each is on a hole.
        let mut line: Vec<(u32, bool)> = Vec::new();
        let mut next = (!used[first]).then_some(first);
        let mut at = leaving(sides[first].0[0]);
        while let Some(side) = next {
            used[side] = true;
            let ([from, to], on_hole) = sides[side];
            place[at] = line.len();
            line.push((from, on_hole));
            at = leaving(to);
            if place[at] != NOT_IN_LINE {
                let ring = line.split_off(place[at]);
                for (point, _) in &ring {
                    place[leaving(*point)] = NOT_IN_LINE;
                }
                rings.push(Ring {
                    on_hole: ring.iter().filter(|point| point.1).count(),
                    points: ring.into_iter().map(|point| point.0).collect(),
                });
            }
            let mut ahead = (at..sides.len()).take_while(|&side| sides[side].0[0] == to);
            next = ahead.find(|&side| !used[side]);
        }
        for (point, _) in line {
            place[leaving(point)] = NOT_IN_LINE;
        }
    }
    rings
}

/// Borders and the rims beside them, no farther away than `most`, m, in the mean; the closest first, each in one pair at most.
fn pairs(borders: &[Vec<DVec3>], rims: &[Vec<DVec3>], most: f64) -> Vec<(usize, usize)> {
    let mut gaps = Vec::new();
    let rim_boxes: Vec<_> = rims.iter().map(|rim| box_of(rim)).collect();
    let rim_sides: Vec<_> = rims.iter().map(|rim| sides_of(rim)).collect();
    for (b, border) in borders.iter().enumerate() {
        let [low, high] = box_of(border);
        let border_sides = sides_of(border);
        for (r, rim) in rims.iter().enumerate() {
            let [l, h] = rim_boxes[r];
            if (l - high).max(low - h).max_element() > most {
                continue;
            }
            // Of a speck beside a long line only the way there is short.
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

fn box_of(points: &[DVec3]) -> [DVec3; 2] {
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
struct Side {
    from: DVec3,
    along: DVec3,
    /// One over the square of its length, 1/m²; 0 of one without length.
    inverse: f64,
}

impl Side {
    fn new(from: DVec3, to: DVec3) -> Self {
        let along = to - from;
        let square = along.length_squared();
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Self {
            from,
            along,
            inverse,
        }
    }

    fn nearest(&self, p: DVec3) -> DVec3 {
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

/// Where a rim that runs along a border is laid on it, point by point: how many of its sides from the first on lie before, and the place. No
/// point is laid before the one before it, so that a border which comes back to itself is followed and not crossed.
fn lay(border: &[DVec3], rim: &[DVec3]) -> Vec<(usize, DVec3)> {
    let count = border.len();
    let begin = nearest(&sides_of(border), rim[0]).0;
    let place = Side::new(border[begin], border[(begin + 1) % count]).nearest(rim[0]);
    let at = |side: usize| border[(begin + side) % count];
    let length_of = |side: usize| at(side).distance(at(side + 1));
    let whole: f64 = (0..count).map(length_of).sum();
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
        for s in side..=count {
            let from = if s == side { laid[j - 1].1 } else { at(s) };
            // The side where it began has a rest.
            let to = if s == count { place } else { at(s + 1) };
            let near = Side::new(from, to).nearest(rim[j]);
            let squared = near.distance_squared(rim[j]);
            if squared < best.0 {
                best = (squared, s, length + from.distance(near), near);
            }
            length += from.distance(to);
            if length > most {
                break;
            }
        }
        (side, passed) = (best.1, best.2);
        laid.push((begin + side, best.3));
    }
    laid
}

/// Triangles between a border and a rim that runs the same way. `sides`: the side of the border that each point of the rim lies beside, counted
/// on where the border begins again. `normals`: of the rim's points.
fn zip(
    border: &[DVec3],
    rim: &[DVec3],
    sides: &[usize],
    normals: &[Vec3],
    triangles: &mut Vertices,
) {
    let at = |i: usize| border[i % border.len()];
    let mut i = sides[0];
    for j in 0..rim.len() {
        let next = (j + 1) % rim.len();
        let until = if next == 0 {
            sides[0] + border.len()
        } else {
            sides[next]
        };
        while i < until {
            add([at(i + 1), at(i), rim[j]], normals[j], triangles);
            i += 1;
        }
        add([rim[j], rim[next], at(i)], normals[j], triangles);
    }
}

/// Triangles that close a ring by itself, on the left of its sides' reverse.
fn cap(ring: impl Iterator<Item = DVec3>, triangles: &mut Vertices) {
    let ring: Vec<DVec3> = ring.collect();
    let fan = || (2..ring.len()).map(|i| [ring[0], ring[i], ring[i - 1]]);
    let normal = fan().map(|[a, b, c]| (b - a).cross(c - a)).sum::<DVec3>();
    let normal = normal.as_vec3().normalize_or(Vec3::Y);
    for corners in fan() {
        add(corners, normal, triangles);
    }
}

/// Adds a triangle, unless it is nothing but a line between two places.
fn add(corners: [DVec3; 3], normal: Vec3, triangles: &mut Vertices) {
    let [a, b, c] = corners;
    if a != b && b != c && c != a {
        triangles.push(corners.map(|corner| (corner, normal)));
    }
}
