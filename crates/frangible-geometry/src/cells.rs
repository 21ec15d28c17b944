//! Cells that divide a part of a plane, one around each of some points.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// No point.
const NO_POINT: u32 = u32::MAX;

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Polygons around points that divide the area within closed outlines: they share their corners, do not overlap and leave nothing out.
///
/// The points and the outlines are joined into a constrained Delaunay triangulation. A cell is the polygon of the incentres of the triangles around its
/// point; on an outline it is closed by the middles of the two edges there, and by the point itself. Two incentres are joined across the edge between
/// their triangles, since both incircles touch it within. Three cells meet at each corner inside. Each is star-shaped about its point.
#[derive(Clone, Debug, Default)]
pub struct PlaneCells {
    /// The points of the cells, then the other corners.
    pub points: Vec<DVec2>,
    /// Corners of all cells, each counter-clockwise, and the cell across the side from each to the next, or [`PlaneCells::OUTSIDE`]. On an outline the
    /// first corner is the cell's own point.
    pub corners: Vec<[u32; 2]>,
    /// Range of each cell in the corners: its first, and their number.
    pub ranges: Vec<[u32; 2]>,
}

impl PlaneCells {
    /// Neighbour of a side on an outline.
    pub const OUTSIDE: u32 = u32::MAX;

    /// Makes a cell around each point. `edges`: the sides of the outlines, between points on them. None where points coincide or outlines cross.
    #[must_use]
    pub fn new(points: Vec<DVec2>, edges: Vec<[usize; 2]>) -> Option<Self> {
        let places = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
        let mut conflicts = 0;
        let delaunay = Delaunay::try_bulk_load_cdt(places, edges, |_| conflicts += 1).ok()?;
        if conflicts > 0 || delaunay.num_vertices() != points.len() {
            return None;
        }
        let mut cells = Self {
            corners: Vec::with_capacity(7 * points.len()),
            ranges: Vec::with_capacity(points.len()),
            points,
        };
        let mut lay = |p: DVec2| {
            cells.points.push(p);
            cells.points.len() as u32 - 1
        };
        let is_inside = inside(&delaunay);
        let mut middle_of = vec![NO_POINT; delaunay.num_all_faces()];
        for face in delaunay.inner_faces() {
            let f = face.fix().index();
            if is_inside[f] {
                middle_of[f] = lay(incentre(face.positions().map(|p| DVec2::new(p.x, p.y))));
            }
        }
        let mut on_edge = vec![NO_POINT; delaunay.num_undirected_edges()];
        for edge in delaunay.undirected_edges() {
            if edge.is_constraint_edge() {
                let [a, b] = edge.positions().map(|p| DVec2::new(p.x, p.y));
                on_edge[edge.fix().index()] = lay(0.5 * (a + b));
            }
        }
        let mut all = Vec::new();
        for vertex in delaunay.vertices() {
            all.clear();
            all.extend(vertex.out_edges());
            let number = |k: usize| all[k % all.len()].face().fix().index();
            let to = |k: usize| all[k % all.len()].to().fix().index() as u32;
            let first = cells.corners.len() as u32;
            // On an outline begin with the edge behind which the inside begins.
            let begins = |&k: &usize| is_inside[number(k)] && !is_inside[number(k + all.len() - 1)];
            if let Some(start) = (0..all.len()).find(begins) {
                let edge = |k: usize| on_edge[all[k % all.len()].as_undirected().fix().index()];
                let own = vertex.fix().index() as u32;
                cells.corners.push([own, Self::OUTSIDE]);
                cells.corners.push([edge(start), to(start)]);
                let mut k = start;
                while is_inside[number(k)] && k < start + all.len() {
                    k += 1;
                    cells.corners.push([middle_of[number(k - 1)], to(k)]);
                }
                cells.corners.push([edge(k), Self::OUTSIDE]);
            } else {
                let round = (0..all.len()).map(|k| [middle_of[number(k)], to(k + 1)]);
                cells.corners.extend(round);
            }
            let count = cells.corners.len() as u32 - first;
            cells.ranges.push([first, count]);
        }
        Some(cells)
    }
}

/// Marks the faces within the outlines: those that an odd number of outlines separates from the outside.
fn inside(delaunay: &Delaunay) -> Vec<bool> {
    let mut known: Vec<Option<bool>> = vec![None; delaunay.num_all_faces()];
    let outside = delaunay.outer_face().fix().index();
    known[outside] = Some(false);
    let mut waiting = Vec::new();
    for edge in delaunay.convex_hull() {
        for edge in [edge, edge.rev()] {
            let f = edge.face().fix().index();
            if known[f].is_none() {
                known[f] = Some(edge.is_constraint_edge());
                waiting.push(edge);
            }
        }
    }
    while let Some(entered) = waiting.pop() {
        let within = known[entered.face().fix().index()] == Some(true);
        for edge in [entered.next(), entered.prev()] {
            let beyond = edge.rev();
            let f = beyond.face().fix().index();
            if known[f].is_none() {
                known[f] = Some(within != edge.is_constraint_edge());
                waiting.push(beyond);
            }
        }
    }
    known.into_iter().map(|known| known == Some(true)).collect()
}

/// Middle of the circle that touches all sides of a triangle.
fn incentre([a, b, c]: [DVec2; 3]) -> DVec2 {
    let [opposite_a, opposite_b, opposite_c] = [b.distance(c), c.distance(a), a.distance(b)];
    (opposite_a * a + opposite_b * b + opposite_c * c) / (opposite_a + opposite_b + opposite_c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_a_square_with_a_hole_fill_it_and_share_their_sides() {
        let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
        let mut points: Vec<DVec2> = square(0.0, 1.0).map(DVec2::from_array).to_vec();
        points.extend(square(0.4, 0.6).map(DVec2::from_array));
        let edges = (0..8).map(|i| [i, i / 4 * 4 + (i + 1) % 4]).collect();
        let scattered = (0..400).map(|i| {
            let at = |golden: f64| (0.013 + f64::from(i) * golden).fract();
            DVec2::new(at(0.754_877_666), at(0.569_840_296))
        });
        let hole =
            |p: &DVec2| p.cmpgt(DVec2::splat(0.39)).all() && p.cmplt(DVec2::splat(0.61)).all();
        points.extend(scattered.filter(|p| !hole(p)));
        let count = points.len();
        let cells = PlaneCells::new(points, edges).unwrap();
        assert_eq!(cells.ranges.len(), count);
        let mut area = 0.0;
        let mut sides = std::collections::BTreeMap::new();
        for (cell, &[first, count]) in (0..).zip(&cells.ranges) {
            let corners = &cells.corners[first as usize..][..count as usize];
            let mut own = 0.0;
            for (k, &[a, beside]) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()][0];
                own += 0.5 * cells.points[a as usize].perp_dot(cells.points[b as usize]);
                if beside != PlaneCells::OUTSIDE {
                    sides.insert((a, b), (cell, beside));
                }
            }
            assert!(own > 0.0, "cell {cell} has {own}");
            area += own;
        }
        assert!((area - 0.96).abs() < 1e-12, "{area}");
        for (&(a, b), &(cell, beside)) in &sides {
            assert_eq!(sides[&(b, a)], (beside, cell));
        }
        // Points that coincide, and outlines that cross.
        let twice = vec![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::X];
        assert!(PlaneCells::new(twice, Vec::new()).is_none());
        let crossing = square(0.0, 1.0).map(DVec2::from_array).to_vec();
        assert!(PlaneCells::new(crossing, vec![[0, 2], [1, 3]]).is_none());
    }
}
