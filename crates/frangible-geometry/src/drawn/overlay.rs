//! One triangle of the render surface laid over the boundary of the fracture mesh and divided as that is.
//!
//! The parts of the boundary over and under the triangle are projected on it along its normal, and it is divided along the borders between
//! parts of different labels: the projected cracks. A place that no part covers (beside a sharp edge that the fracture mesh rounds off, inside a
//! shell the fracture mesh does not have) takes the label of the closest part.
//! Polygons are in the triangle's barycentric coordinates: (weight of the second corner, weight of the third).

use glam::{DVec2, DVec3};

use super::parts::{Cracks, MIXED, Part, Parts};
use super::polygon::{
    Polygon, SHORT, area, bounds, centre, halves, has_separating_edge, overlap, split,
};
use crate::TriangleTree;

/// Parts that face farther away from the triangle's normal than this are another side of the body (cosine).
const FACING: f64 = 0.3;
/// Parts laid over a polygon one by one; of more, the polygon is halved first.
const FEW: usize = 6;
/// A polygon that more cracks run through is halved before it is divided along them.
const MANY: usize = 32;
/// Polygons below this share of the triangle are rounding.
const NOTHING: f64 = 1e-12;
/// Halvings of what no part covers, at most.
const HALVINGS: u32 = 5;
/// The label of an uncovered polygon is looked up in its middle, and near each corner at this share of the way to the middle.
pub(super) const TOWARDS_MIDDLE: f64 = 0.05;
/// The triangle itself.
const WHOLE: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

/// A triangle of the author's surface, on which triangles of the boundary are projected along its normal.
#[derive(Debug)]
pub(super) struct Ground {
    a: DVec3,
    u: DVec3,
    v: DVec3,
    /// Unit normal on the side that the body faces there.
    up: DVec3,
    /// Products with these are the weights of the second and the third corner.
    weights: [DVec3; 2],
    /// True if the triangle is wound the wrong way round.
    is_turned: bool,
}

impl Ground {
    /// The ground of a triangle; none without area.
    pub(super) fn new([a, b, c]: [DVec3; 3], is_turned: bool) -> Option<Self> {
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let square = normal.length_squared();
        let facing = if is_turned { -1.0 } else { 1.0 };
        (square > 0.0).then(|| Self {
            a,
            u,
            v,
            up: normal * (facing / square.sqrt()),
            weights: [v.cross(normal) / square, normal.cross(u) / square],
            is_turned,
        })
    }

    /// Box in which triangles no farther than `reach` over or under it lie at least in part, m.
    pub(super) fn near(&self, reach: f64) -> [DVec3; 2] {
        let up = reach * self.up.abs();
        let (b, c) = (self.a + self.u, self.a + self.v);
        [self.a.min(b).min(c) - up, self.a.max(b).max(c) + up]
    }

    /// Projects a triangle of the boundary on this one. Returns the distance of its middle, m, and its projection. Nothing if the two do not overlap,
    /// if it faces another way, or if it is all farther away than `reach`.
    pub(super) fn shade(&self, [p, q, r]: [DVec3; 3], reach: f64) -> Option<(f64, [DVec2; 3])> {
        let shade = [self.on(p), self.on(q), self.on(r)];
        let [low, high] = bounds(&shade);
        let weight = |p: DVec2| 1.0 - p.x - p.y;
        let first = weight(shade[0]).max(weight(shade[1])).max(weight(shade[2]));
        if high.min_element() <= 0.0 || low.max_element() >= 1.0 || first <= 0.0 {
            return None;
        }
        let (p, q, r) = (p - self.a, q - self.a, r - self.a);
        let own = (q - p).cross(r - p);
        let towards = own.dot(self.up);
        // Triangles without area drop out too.
        if towards <= 0.0 || towards * towards <= FACING * FACING * own.length_squared() {
            return None;
        }
        let heights = DVec3::new(p.dot(self.up), q.dot(self.up), r.dot(self.up));
        if heights.min_element() > reach || heights.max_element() < -reach {
            return None;
        }
        let shade = if self.is_turned {
            [shade[0], shade[2], shade[1]]
        } else {
            shade
        };
        let meets = !has_separating_edge(&shade, &WHOLE);
        meets.then(|| ((heights.element_sum() / 3.0).abs(), shade))
    }

    /// Projects a point on the triangle.
    fn on(&self, p: DVec3) -> DVec2 {
        let (d, [u, v]) = (p - self.a, self.weights);
        DVec2::new(d.dot(u), d.dot(v))
    }

    fn place(&self, p: DVec2) -> DVec3 {
        self.a + self.u * p.x + self.v * p.y
    }
}

/// A triangle of the author's surface, and the parts of the boundary under it.
pub(super) struct Overlay<'a> {
    pub(super) ground: Ground,
    /// Distance under and over the triangle in which parts are looked for: the fracture mesh's mean edge, m.
    pub(super) reach: f64,
    pub(super) parts: &'a Parts,
    /// Label of each boundary triangle, [`MIXED`] where it has several.
    pub(super) labels: &'a [u32],
    /// The cracks within each boundary triangle.
    pub(super) cracks: &'a Cracks,
    pub(super) boundary: &'a TriangleTree,
}

/// A part projected on the triangle.
struct Shade {
    corners: [DVec2; 3],
    label: u32,
    /// Distance of the middle of the part from the triangle, m.
    height: f64,
    /// The boundary triangle that it is a part of.
    of: u32,
}

impl Shade {
    fn contains(&self, p: DVec2) -> bool {
        (0..3).all(|k| {
            let from = self.corners[k];
            (self.corners[(k + 1) % 3] - from).perp_dot(p - from) >= 0.0
        })
    }

    /// Returns true if it shares more than a border with a polygon in this box.
    fn meets(&self, polygon: &[DVec2], [low, high]: [DVec2; 2]) -> bool {
        let [l, h] = bounds(&self.corners);
        l.cmplt(high).all() && h.cmpgt(low).all() && overlap(polygon, &self.corners)
    }
}

impl Overlay<'_> {
    /// Convex polygons with their labels that tile the triangle; one polygon when it belongs to one fragment. `under`: boundary triangles that
    /// lie over or under it.
    pub(super) fn divide(&self, under: &[u32]) -> Vec<(Polygon, u32)> {
        let whole = WHOLE.to_vec();
        let mut cracks: Vec<[DVec2; 2]> = self.cracks_through(under).collect();
        let mut shades = Vec::new();
        for &of in under {
            for part in self.parts.of(of) {
                if let Some((height, corners)) = self.ground.shade(part.corners, self.reach) {
                    shades.push(Shade {
                        corners,
                        label: part.label,
                        height,
                        of,
                    });
                }
            }
        }
        let mut divided = Vec::new();
        let shades: Vec<&Shade> = shades.iter().collect();
        self.lay(whole, &shades, (&mut cracks, 0), &mut divided);
        divided
    }

    /// Projections of those cracks in these boundary triangles that run through the triangle.
    fn cracks_through(&self, under: &[u32]) -> impl Iterator<Item = [DVec2; 2]> {
        let cracks = under.iter().flat_map(|&t| self.cracks.of(t));
        cracks
            .map(|ends| ends.map(|p| self.ground.on(p)))
            .filter(|&[from, to]| runs_through(&WHOLE, from, to))
    }

    /// The label of a triangle through which no crack runs, if all boundary triangles that lie over or under it have the same there. Then
    /// [`Overlay::divide`] would find one polygon.
    pub(super) fn only_label(&self, under: &[u32]) -> Option<u32> {
        if self.cracks_through(under).next().is_some() {
            return None;
        }
        // So all parts that a boundary triangle has there are of one label.
        let label = |&t: &u32| match self.labels[t as usize] {
            MIXED => {
                let mut parts = self.parts.of(t).iter();
                let meets = |part: &&Part| self.ground.shade(part.corners, self.reach).is_some();
                parts.find(meets).map(|part| part.label)
            }
            label => Some(label),
        };
        let mut labels = under.iter().filter_map(label);
        let first = labels.next()?;
        labels.all(|label| label == first).then_some(first)
    }

    /// Divides a triangle that has no part of the boundary under it. `closest`: boundary triangles closest to its middle and to its corners.
    pub(super) fn beside(&self, closest: &[u32]) -> Vec<(Polygon, u32)> {
        let middle = centre(&WHOLE);
        let near_corners = WHOLE.map(|p| p.lerp(middle, TOWARDS_MIDDLE));
        let points = [middle].into_iter().chain(near_corners);
        let label_of = |(&t, p)| self.parts.label_near(t, self.ground.place(p));
        let mut labels = closest.iter().zip(points).map(label_of);
        let first = labels.next();
        if let Some(label) = first.filter(|first| labels.all(|label| label == *first)) {
            return vec![(WHOLE.to_vec(), label)];
        }
        let mut divided = Vec::new();
        self.uncovered(WHOLE.to_vec(), HALVINGS, &mut divided);
        make_whole(WHOLE.to_vec(), 0, &mut divided);
        divided
    }

    /// Divides a polygon along cracks. `cracks`: a list, and where in it those begin that run through the polygon; it ends as it began.
    fn lay(
        &self,
        polygon: Polygon,
        shades: &[&Shade],
        (cracks, first): (&mut Vec<[DVec2; 2]>, usize),
        divided: &mut Vec<(Polygon, u32)>,
    ) {
        let before = divided.len();
        let end = cracks.len();
        let is_halved = end - first > MANY && self.is_large(&polygon);
        let parted = if is_halved {
            Some((end, halves(&polygon)))
        } else {
            along_a_crack(&polygon, cracks, first)
        };
        let Some((used, parts)) = parted else {
            self.between_cracks(polygon, shades, divided);
            return;
        };
        for part in parts {
            if area(&part) <= NOTHING {
                continue;
            }
            for i in (first..end).filter(|&i| i != used) {
                let [from, to] = cracks[i];
                if runs_through(&part, from, to) {
                    cracks.push([from, to]);
                }
            }
            if is_halved {
                let over = over(&part, shades);
                self.lay(part, &over, (cracks, end), divided);
            } else {
                self.lay(part, shades, (cracks, end), divided);
            }
            cracks.truncate(end);
        }
        make_whole(polygon, before, divided);
    }

    /// Divides a polygon through which no crack runs, if it lies over or under boundary triangles of different labels, or beside all of them.
    fn between_cracks(
        &self,
        polygon: Polygon,
        shades: &[&Shade],
        divided: &mut Vec<(Polygon, u32)>,
    ) {
        let (within, middle) = (bounds(&polygon), centre(&polygon));
        // All parts that a boundary triangle has here are of one label, but for crumbs that a crack cuts off the polygon's corners.
        let label_of = |parts: &[&Shade]| {
            let around = parts.iter().find(|part| part.contains(middle));
            let part = around.or_else(|| parts.iter().find(|part| part.meets(&polygon, within)));
            part.map(|part| part.label)
        };
        let mut labels = shades.chunk_by(|a, b| a.of == b.of).filter_map(label_of);
        let first = labels.next();
        if let Some(label) = first.filter(|first| labels.all(|label| label == *first)) {
            divided.push((polygon, label));
            return;
        }
        let mut over = over(&polygon, shades);
        let before = divided.len();
        if over.len() > FEW && self.is_large(&polygon) {
            for half in halves(&polygon) {
                if area(&half) > NOTHING {
                    self.between_cracks(half, &over, divided);
                }
            }
        } else {
            over.sort_by(|x, y| x.height.total_cmp(&y.height));
            let mut rest = vec![polygon.clone()];
            for shade in over {
                rest = rest
                    .into_iter()
                    .flat_map(|piece| cover(piece, shade, divided))
                    .collect();
            }
            for piece in rest {
                self.uncovered(piece, HALVINGS, divided);
            }
        }
        make_whole(polygon, before, divided);
    }

    /// Returns true if a polygon is so large that halving it first saves time.
    fn is_large(&self, polygon: &[DVec2]) -> bool {
        self.size(polygon) > 0.5 * self.reach
    }

    /// A polygon without a part under it: closest labels, halved where they differ.
    fn uncovered(&self, polygon: Polygon, halvings: u32, divided: &mut Vec<(Polygon, u32)>) {
        let middle = centre(&polygon);
        let label_at = |p: DVec2| self.parts.label_at(self.boundary, self.ground.place(p));
        let label = label_at(middle);
        let differs = |&p: &DVec2| label_at(p.lerp(middle, TOWARDS_MIDDLE)) != label;
        if halvings > 0 && self.size(&polygon) > 0.1 * self.reach && polygon.iter().any(differs) {
            for half in halves(&polygon) {
                if area(&half) > NOTHING {
                    self.uncovered(half, halvings - 1, divided);
                }
            }
        } else {
            divided.push((polygon, label));
        }
    }

    /// Longest side of the polygon's box in space, about, m.
    fn size(&self, polygon: &[DVec2]) -> f64 {
        let points = polygon.iter().map(|&p| self.ground.place(p));
        let far = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = points.fold(far, |[l, h], p| [l.min(p), h.max(p)]);
        (high - low).max_element()
    }
}

/// Shades that a polygon meets.
fn over<'a>(polygon: &[DVec2], shades: &[&'a Shade]) -> Vec<&'a Shade> {
    let within = bounds(polygon);
    let meets = |shade: &&&Shade| shade.meets(polygon, within);
    shades.iter().filter(meets).copied().collect()
}

/// The first crack from a place of the list on that divides a polygon, and the two parts.
fn along_a_crack(
    polygon: &[DVec2],
    cracks: &[[DVec2; 2]],
    first: usize,
) -> Option<(usize, [Polygon; 2])> {
    let mut parted = (first..cracks.len()).map(|i| {
        let [from, to] = cracks[i];
        (i, split(polygon, from, to - from))
    });
    parted.find(|(_, parts)| parts.iter().all(|part| area(part) > NOTHING))
}

/// Undoes a division for nothing: polygons from a place of the list on become one again if all have the same label.
fn make_whole(polygon: Polygon, before: usize, divided: &mut Vec<(Polygon, u32)>) {
    if let [(_, label), others @ ..] = &divided[before..]
        && others.iter().all(|o| o.1 == *label)
    {
        let label = *label;
        divided.truncate(before);
        divided.push((polygon, label));
    }
}

/// Returns true if a stretch of the line from one point to another lies within a convex polygon.
fn runs_through(polygon: &[DVec2], from: DVec2, to: DVec2) -> bool {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (i, &p) in polygon.iter().enumerate() {
        let side = polygon[(i + 1) % polygon.len()] - p;
        if side.length_squared() <= SHORT * SHORT {
            continue;
        }
        let (begin, end) = (side.perp_dot(from - p), side.perp_dot(to - p));
        match (begin > 0.0, end > 0.0) {
            (true, true) => {}
            (false, false) => return false,
            (false, true) => first = first.max(begin / (begin - end)),
            (true, false) => last = last.min(begin / (begin - end)),
        }
    }
    first < last
}

/// Gives the shade's label to the part of the piece that it covers, and returns the rest.
fn cover(piece: Polygon, shade: &Shade, divided: &mut Vec<(Polygon, u32)>) -> Vec<Polygon> {
    if !overlap(&piece, &shade.corners) {
        return vec![piece];
    }
    let mut rest = Vec::new();
    let mut inside = piece;
    for k in 0..3 {
        let from = shade.corners[k];
        let [left, right] = split(&inside, from, shade.corners[(k + 1) % 3] - from);
        if area(&right) > NOTHING {
            rest.push(right);
        }
        inside = left;
    }
    if area(&inside) > NOTHING {
        divided.push((inside, shade.label));
    }
    rest
}
