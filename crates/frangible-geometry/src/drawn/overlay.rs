//! One triangle of the render surface laid over the boundary of the fracture mesh and divided as that is.
//!
//! The parts of the boundary near the triangle are projected on it along its normal; where they cover it, it takes
//! their labels, exactly along the projected cracks. What no part covers (beside a sharp edge that the fracture mesh
//! rounds off, inside a shell the fracture mesh does not have) takes the label of the closest part.
//! Polygons are in the triangle's barycentric coordinates: (weight of the second corner, weight of the third).

use glam::{DVec2, DVec3};

use super::parts::Parts;
use super::polygon::{Polygon, area, bounds, centre, halves, overlap, split};
use crate::TriangleTree;

/// Parts that face farther away from the triangle's normal than this are another side of the body (cosine).
const FACING: f64 = 0.3;
/// Parts laid over a polygon one by one; of more, the polygon is halved first.
const FEW: usize = 6;
/// Polygons below this share of the triangle are rounding.
const NOTHING: f64 = 1e-12;
/// Halvings of what no part covers, at most.
const HALVINGS: u32 = 5;
/// The triangle itself.
const WHOLE: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

/// A render triangle and what lies under it.
pub(super) struct Overlay<'a> {
    pub(super) corners: [DVec3; 3],
    /// 1, or −1 for a triangle wound the wrong way round.
    pub(super) facing: f64,
    /// How far under or over the triangle parts are looked for; the fracture mesh's mean edge, m.
    pub(super) reach: f64,
    pub(super) parts: &'a Parts,
    pub(super) boundary: &'a TriangleTree,
}

/// A part projected on the triangle.
struct Shade {
    corners: [DVec2; 3],
    label: u32,
}

impl Shade {
    /// Whether it shares more than a border with a polygon in this box.
    fn meets(&self, polygon: &[DVec2], [low, high]: [DVec2; 2]) -> bool {
        let [l, h] = bounds(&self.corners);
        l.cmplt(high).all() && h.cmpgt(low).all() && overlap(polygon, &self.corners)
    }
}

fn nearest_first(mut shades: Vec<(f64, Shade)>) -> Vec<Shade> {
    shades.sort_by(|x, y| x.0.total_cmp(&y.0));
    shades.into_iter().map(|s| s.1).collect()
}

impl Overlay<'_> {
    /// Convex polygons with their labels that tile the triangle; one polygon when it belongs to one fragment.
    pub(super) fn divide(&self) -> Vec<(Polygon, u32)> {
        let near = self.near();
        let mut labels = near.iter().flat_map(|&t| self.parts.of(t)).map(|p| p.label);
        if let Some(first) = labels.next()
            && labels.all(|label| label == first)
        {
            return vec![(WHOLE.to_vec(), first)];
        }
        let shades = self.shades(&near);
        let whole = WHOLE.to_vec();
        // Most triangles have one label under them.
        if let [first, others @ ..] = &shades[..]
            && others.iter().all(|s| s.1.label == first.1.label)
        {
            return vec![(whole, first.1.label)];
        }
        let shades = nearest_first(shades);
        let all: Vec<u32> = (0..shades.len() as u32).collect();
        let mut divided = Vec::new();
        self.lay(whole, &all, &shades, &mut divided);
        divided
    }

    /// Boundary triangles under or over the triangle, rising, and some beside it.
    fn near(&self) -> Vec<u32> {
        let [a, b, c] = self.corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let up = self.reach * normal.abs();
        let low = (a.min(b).min(c) - up).as_vec3();
        let high = (a.max(b).max(c) + up).as_vec3();
        let mut near = Vec::new();
        self.boundary.in_box(low, high, |t| near.push(t));
        near.sort_unstable();
        near
    }

    /// The parts of some boundary triangles, projected, which lie over or under the triangle, and how far from it.
    fn shades(&self, near: &[u32]) -> Vec<(f64, Shade)> {
        let [a, b, c] = self.corners;
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let square = normal.length_squared();
        let length = square.sqrt();
        let reach = self.reach;
        let mut shades: Vec<(f64, Shade)> = Vec::new();
        for part in near.iter().flat_map(|&t| self.parts.of(t)) {
            let [p, q, r] = part.corners;
            let own = (q - p).cross(r - p);
            let towards = self.facing * own.dot(normal);
            // Parts without area drop out too.
            if towards <= FACING * own.length() * length {
                continue;
            }
            let height = |x: DVec3| ((x - a).dot(normal) / length).abs();
            if part.corners.iter().all(|&x| height(x) > reach) {
                continue;
            }
            let mut corners = part.corners.map(|x| {
                let d = x - a;
                DVec2::new(d.cross(v).dot(normal), u.cross(d).dot(normal)) / square
            });
            if self.facing < 0.0 {
                corners.swap(1, 2);
            }
            let shade = Shade {
                corners,
                label: part.label,
            };
            if shade.meets(&WHOLE, [DVec2::ZERO, DVec2::ONE]) {
                shades.push((height((p + q + r) / 3.0), shade));
            }
        }
        shades
    }

    /// Divides a polygon among the shades `of` it, or what of them meets it.
    fn lay(
        &self,
        polygon: Polygon,
        of: &[u32],
        shades: &[Shade],
        divided: &mut Vec<(Polygon, u32)>,
    ) {
        let within = bounds(&polygon);
        let over: Vec<u32> = of
            .iter()
            .copied()
            .filter(|&s| shades[s as usize].meets(&polygon, within))
            .collect();
        if let Some((&first, others)) = over.split_first() {
            let label = |s: u32| shades[s as usize].label;
            if others.iter().all(|&s| label(s) == label(first)) {
                divided.push((polygon, label(first)));
                return;
            }
        }
        let before = divided.len();
        if over.len() > FEW && self.size(&polygon) > 0.5 * self.reach {
            for half in halves(&polygon) {
                if area(&half) > NOTHING {
                    self.lay(half, &over, shades, divided);
                }
            }
        } else {
            let mut rest = vec![polygon.clone()];
            for &s in &over {
                let shade = &shades[s as usize];
                rest = rest
                    .into_iter()
                    .flat_map(|piece| cover(piece, shade, divided))
                    .collect();
            }
            for piece in rest {
                self.uncovered(piece, HALVINGS, divided);
            }
        }
        // What was divided for nothing becomes whole again.
        if let [(_, label), others @ ..] = &divided[before..]
            && others.iter().all(|o| o.1 == *label)
        {
            let label = *label;
            divided.truncate(before);
            divided.push((polygon, label));
        }
    }

    /// A polygon without a part under it: closest labels, halved where they differ.
    fn uncovered(&self, polygon: Polygon, halvings: u32, divided: &mut Vec<(Polygon, u32)>) {
        let middle = centre(&polygon);
        let label_at = |p: DVec2| self.parts.label_at(self.boundary, self.place(p));
        let label = label_at(middle);
        let differs = |&p: &DVec2| label_at(p.lerp(middle, 0.05)) != label;
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

    fn place(&self, p: DVec2) -> DVec3 {
        let [a, b, c] = self.corners;
        a + (b - a) * p.x + (c - a) * p.y
    }

    /// Longest side of the polygon's box in space, about, m.
    fn size(&self, polygon: &[DVec2]) -> f64 {
        let points = polygon.iter().map(|&p| self.place(p));
        let far = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = points.fold(far, |[l, h], p| [l.min(p), h.max(p)]);
        (high - low).max_element()
    }
}

/// Gives the shade what it covers of the piece, and returns the rest.
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
