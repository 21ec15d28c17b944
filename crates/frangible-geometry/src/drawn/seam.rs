//! Seam between a fragment's share of the author's surface and its crack faces.
//!
//! The fracture mesh only follows the author's surface, so the two borders are two lines close to each other. The rim of the crack faces is
//! laid on the border of the share, and crack faces take in the corners that the border has between two points of the rim. If a rim is too
//! far away to be laid there, triangles close the gap between the two lines. A border that has no rim beside it, or a rim without a border, is
//! closed by itself, as that of a speck which only one of the two has.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use super::assemble::Face;
use super::lines::{Side, lay, pairs};
use super::rings::{Ring, open, rings};

/// Largest mean distance of a rim from the border that it belongs to, in reaches.
const FAR: f64 = 2.0;

/// A rim's point that is laid no farther than this from a corner of a border, in reaches, is laid on the corner: drawn corners are rounded, and
/// sides as short would be lost.
const AT_CORNER: f64 = 2e-6;

/// A crack face follows a border that lies no farther than this from its side, in reaches: where the border makes a detour, as in a fold of the
/// surface, the face would become a fin.
const BULGE: f64 = 0.5;

/// Changes that close a fragment.
#[derive(Debug, Default)]
pub(super) struct Seam {
    /// Points of the rim of the crack faces, and the positions on the border at which they are laid, m.
    moved: BTreeMap<u32, DVec3>,
    /// Places on a side of a crack face, from its first point to its second, m. Of several faces with that side each takes its own.
    between: BTreeMap<[u32; 2], Vec<Vec<DVec3>>>,
    triangles: Vec<Face>,
}

impl Seam {
    /// Number of crack faces and triangles, without those that dividing faces makes.
    pub(super) fn count(&self, cracks: CrackFaces<'_>) -> usize {
        cracks.faces.len() + self.triangles.len()
    }

    /// Calls `found` with the crack faces, sewn to the border, and the triangles that close the fragment. `normals`: at the corners of each face.
    /// `laid`: where the points of the cracks are; it is changed meanwhile and put back.
    pub(super) fn faces(
        mut self,
        cracks: CrackFaces<'_>,
        normals: &[[Vec3; 3]],
        laid: &mut [DVec3],
        mut found: impl FnMut(&Face),
    ) {
        let index = |point: u32| point as usize - cracks.first;
        for (&v, &place) in &self.moved {
            laid[index(v)] = place;
        }
        for (face, normals) in cracks.faces.iter().zip(normals) {
            let corner = |k: usize| (laid[index(face[k])], normals[k]);
            let corners = [corner(0), corner(1), corner(2)];
            let on_rim = [0, 1, 2].map(|k: usize| cracks.is_on_rim[index(face[k])]);
            let mut between = |k: usize| {
                let next = (k + 1) % 3;
                let side = [face[k], face[next]];
                let is_outer = on_rim[k] && on_rim[next];
                let places = is_outer.then(|| self.between.get_mut(&side)?.pop());
                places.flatten().unwrap_or_default()
            };
            let between = [between(0), between(1), between(2)];
            if between.iter().all(Vec::is_empty) {
                found(&corners);
            } else {
                add_face(corners, on_rim, &between, &mut found);
            }
        }
        self.triangles.iter().for_each(found);
        for &v in self.moved.keys() {
            laid[index(v)] = cracks.place(v);
        }
    }
}

/// A point of a rim that runs along a border.
#[derive(Clone, Copy, Debug)]
struct RimPoint {
    number: u32,
    /// Its position, m.
    place: DVec3,
    /// Side of the border that it lies beside, counted on where the border begins again.
    side: usize,
    /// Position on that side, m.
    beside: DVec3,
    normal: Vec3,
}

impl RimPoint {
    fn is_on_border(&self) -> bool {
        self.place == self.beside
    }
}

/// Crack faces of a fragment, with places and normals of the points of all fragments' crack faces, which are numbered from `first` on.
#[derive(Clone, Copy)]
pub(super) struct CrackFaces<'a> {
    pub(super) faces: &'a [[u32; 3]],
    pub(super) first: usize,
    /// Positions of the points, m, body frame.
    pub(super) places: &'a [DVec3],
    pub(super) normals: &'a [Vec3],
    /// For each point, true if the faces may end there.
    pub(super) is_on_rim: &'a [bool],
}

impl CrackFaces<'_> {
    fn place(&self, point: u32) -> DVec3 {
        self.places[point as usize - self.first]
    }

    /// Sides that are not within the body.
    fn outer_sides(&self) -> impl Iterator<Item = [u32; 2]> {
        let is_on_rim = |point: u32| self.is_on_rim[point as usize - self.first];
        let of_face = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
        let sides = self.faces.iter().flat_map(of_face);
        sides.filter(move |&[a, b]| is_on_rim(a) && is_on_rim(b))
    }
}

/// Closes a fragment between its share of the surface and its crack faces. `sheet`: sides of the share's polygons, and whether they are on the
/// border of a hole; those that run both ways are no border. `reach`: how far the rim is moved at most, m. `closed`: whether the surface is.
/// Where it is not, a rim without a border beside it lies in a hole, and stays open as the hole does.
pub(super) fn close(
    sheet: Vec<([u32; 2], bool)>,
    sheet_at: impl Fn(u32) -> DVec3,
    cracks: CrackFaces<'_>,
    reach: f64,
    closed: bool,
) -> Seam {
    let mut borders = rings(&open(sheet.into_iter()));
    borders.retain(|border| !border.is_hole());
    let mut rims = rings(&open(cracks.outer_sides().map(|side| (side, false))));
    // The other way round it runs beside the border.
    rims.iter_mut().for_each(|rim| rim.points.reverse());
    let border_places: Vec<Vec<DVec3>> = borders.iter().map(|r| r.places(&sheet_at)).collect();
    let places_of = |rim: &Ring| rim.places(|v| cracks.place(v));
    let rim_places: Vec<Vec<DVec3>> = rims.iter().map(places_of).collect();
    let pairs = pairs(&border_places, &rim_places, FAR * reach);
    let mut seam = Seam::default();
    let mut beside = Vec::new();
    for &(b, r) in &pairs {
        let laid = lay(&border_places[b], &rim_places[r], AT_CORNER * reach);
        let points = rims[r].points.iter().zip(&rim_places[r]);
        for (&(_, laid), (&point, &place)) in laid.iter().zip(points) {
            if laid.distance(place) <= reach {
                // Where two rims touch, a point has one place.
                seam.moved.entry(point).or_insert(laid);
            }
        }
        beside.push(laid);
    }
    let laid = |v| {
        seam.moved
            .get(&v)
            .copied()
            .unwrap_or_else(|| cracks.place(v))
    };
    let (mut between, mut triangles) = (BTreeMap::new(), Vec::new());
    for (&(b, r), beside) in pairs.iter().zip(&beside) {
        let points = rims[r].points.iter().zip(beside);
        let rim = points.map(|(&number, &(side, beside))| RimPoint {
            number,
            place: laid(number),
            side,
            beside,
            normal: cracks.normals[number as usize - cracks.first],
        });
        let rim: Vec<RimPoint> = rim.collect();
        divide_sides(&border_places[b], &rim, &mut triangles);
        let most = BULGE * reach;
        join(&border_places[b], &rim, most, &mut between, &mut triangles);
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
    (seam.between, seam.triangles) = (between, triangles);
    seam
}

/// Divides sides of a border where points of a rim lie on them, by triangles between the ends of a side and those points. These triangles are
/// nothing but lines.
fn divide_sides(border: &[DVec3], rim: &[RimPoint], triangles: &mut Vec<Face>) {
    let count = border.len();
    // The last ones may lie on the first side again, and come before the first ones there.
    let again = rim.partition_point(|point| point.side < rim[0].side + count);
    let in_order: Vec<RimPoint> = [&rim[again..], &rim[..again]].concat();
    for on_side in in_order.chunk_by(|a, b| a.side % count == b.side % count) {
        let side = on_side[0].side;
        let (mut from, to) = (border[side % count], border[(side + 1) % count]);
        for point in on_side {
            add([to, from, point.beside], point.normal, triangles);
            from = point.beside;
        }
    }
}

/// Joins each side of a rim to the border beside it: the crack face takes in the corners of the border, unless they lie farther away than `most`,
/// m. There triangles lie between the two.
fn join(
    border: &[DVec3],
    rim: &[RimPoint],
    most: f64,
    between: &mut BTreeMap<[u32; 2], Vec<Vec<DVec3>>>,
    triangles: &mut Vec<Face>,
) {
    for (j, point) in rim.iter().enumerate() {
        let (next, until) = match rim.get(j + 1) {
            Some(next) => (next, next.side),
            None => (&rim[0], rim[0].side + border.len()),
        };
        let corners = (point.side + 1..=until).map(|i| border[i % border.len()]);
        let mut along: Vec<DVec3> = [point.beside].into_iter().chain(corners).collect();
        along.push(next.beside);
        along.dedup();
        let straight = Side::new(point.place, next.place);
        let is_near = |p: &DVec3| straight.nearest(*p).distance(*p) <= most;
        if point.is_on_border() && next.is_on_border() && along.iter().all(is_near) {
            if let [_, corners @ .., _] = &along[..]
                && !corners.is_empty()
            {
                // Crack faces run the other way round.
                let side = [next.number, point.number];
                let corners = corners.iter().rev().copied().collect();
                between.entry(side).or_default().push(corners);
            }
            continue;
        }
        for w in along.windows(2) {
            add([w[1], w[0], point.place], point.normal, triangles);
        }
        add(
            [point.place, next.place, next.beside],
            point.normal,
            triangles,
        );
    }
}

/// Adds a crack face that takes in the places between its corners. `on_rim`: whether its corners lie on the border.
fn add_face(
    face: Face,
    on_rim: [bool; 3],
    between: &[Vec<DVec3>; 3],
    found: &mut impl FnMut(&Face),
) {
    let mut around = Vec::new();
    for (k, places) in between.iter().enumerate() {
        around.push(face[k]);
        // The normal goes over from one corner's to the other's.
        let (from, until) = (face[k].1, face[(k + 1) % 3].1);
        let step = 1.0 / (places.len() + 1) as f32;
        let normal = |i: usize| from.lerp(until, step * (i + 1) as f32).normalize_or(from);
        around.extend(
            places
                .iter()
                .enumerate()
                .map(|(i, &place)| (place, normal(i))),
        );
    }
    let mut divided = (0..3).filter(|&k| !between[k].is_empty());
    // From the corner across the only divided side, or from the middle: between two places of the border the surface may have a side.
    let apex = match (divided.next(), divided.next()) {
        (Some(k), None) if !on_rim[(k + 2) % 3] => face[(k + 2) % 3],
        _ => {
            let sum = around.iter().map(|corner| corner.0).sum::<DVec3>();
            let normal = face.iter().map(|corner| corner.1).sum::<Vec3>();
            let normal = normal.normalize_or(face[0].1);
            (sum / around.len() as f64, normal)
        }
    };
    for (i, &from) in around.iter().enumerate() {
        let until = around[(i + 1) % around.len()];
        if has_three_corners([apex.0, from.0, until.0]) {
            found(&[apex, from, until]);
        }
    }
}

/// Triangles that close a ring; their sides run against the ring's. They meet in a place of their own, neither on the ring nor in its middle: the
/// surface that they close may have the same sides there.
fn cap(ring: impl Iterator<Item = DVec3>, triangles: &mut Vec<Face>) {
    let ring: Vec<DVec3> = ring.collect();
    let middle = ring.iter().sum::<DVec3>() / ring.len() as f64;
    let middle = middle.lerp(ring[0], 0.25);
    let triangle = |i: usize| [middle, ring[(i + 1) % ring.len()], ring[i]];
    let fan: Vec<_> = (0..ring.len()).map(triangle).collect();
    let area = fan.iter().map(|&[a, b, c]| (b - a).cross(c - a));
    let normal = area.sum::<DVec3>().as_vec3().normalize_or(Vec3::Y);
    for corners in fan {
        add(corners, normal, triangles);
    }
}

/// Adds a triangle, unless it is nothing but a line between two places.
fn add(corners: [DVec3; 3], normal: Vec3, triangles: &mut Vec<Face>) {
    if has_three_corners(corners) {
        triangles.push(corners.map(|corner| (corner, normal)));
    }
}

fn has_three_corners([a, b, c]: [DVec3; 3]) -> bool {
    a != b && b != c && c != a
}
