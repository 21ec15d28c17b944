//! The network of all dice of a wall: their corners on both faces, and their neighbours.

use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::seeds::Seeds;
use crate::temper::TemperedWall;

/// No die: beyond the outline.
pub(super) const NONE: u32 = u32::MAX;

/// No point.
const NO_POINT: u32 = u32::MAX;

/// One die: a polygon, star-shaped about its apex, through the thickness of the wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Die {
    /// Its point, the middle of its fans of triangles.
    pub(super) apex: u32,
    /// Its corners in [`Network::corners`], counter-clockwise seen from above. At the outline the apex is the first one.
    pub(super) first: u32,
    pub(super) count: u32,
}

/// All dice of a wall.
#[derive(Clone, Debug)]
pub(super) struct Network {
    /// Each point on the upper and on the lower face, m, frame of the fracture mesh.
    pub(super) points: Vec<[DVec3; 2]>,
    pub(super) dice: Vec<Die>,
    /// Corners of all dice, and the die across the side from each corner to the next.
    pub(super) corners: Vec<[u32; 2]>,
    /// Distance of each die's point from the first crack, m, in the mean plane.
    reach: Vec<f64>,
    /// Mass of the wall over the volume of the dice, kg/m³.
    pub(super) density: f64,
    /// Time of the first crack, s.
    pub(super) since: f64,
    /// Speed of the front, m/s.
    pub(super) speed: f64,
}

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

impl Network {
    /// Cuts a wall into dice of this mean area, m², about a point of the body, m. None where no network could be made.
    pub(super) fn new(wall: &TemperedWall, origin: DVec3, area: f64, seed: u64) -> Option<Self> {
        let origin = wall.plan_of(origin);
        let Seeds { points, edges } = Seeds::scatter(wall, origin, area, seed);
        let reach = points.iter().map(|p| p.distance(origin)).collect();
        let places = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
        let mut conflicts = 0;
        let delaunay = Delaunay::try_bulk_load_cdt(places, edges, |_| conflicts += 1).ok()?;
        if conflicts > 0 || delaunay.num_vertices() != points.len() {
            return None;
        }
        let mut network = Self {
            points: Vec::with_capacity(4 * points.len()),
            dice: Vec::with_capacity(points.len()),
            corners: Vec::with_capacity(7 * points.len()),
            reach,
            density: 0.0,
            since: 0.0,
            speed: 0.0,
        };
        let mut lay = |p: DVec2| {
            let faces = wall.faces_at(p).map(|(_, faces)| faces)?;
            network.points.push(faces);
            Some(network.points.len() as u32 - 1)
        };
        for &p in &points {
            lay(p)?;
        }
        let is_inside = inside(&delaunay);
        let mut middle_of = vec![NO_POINT; delaunay.num_all_faces()];
        for face in delaunay.inner_faces() {
            let f = face.fix().index();
            if is_inside[f] {
                let corners = face.positions().map(|p| DVec2::new(p.x, p.y));
                middle_of[f] = lay(incentre(corners))?;
            }
        }
        let mut on_edge = vec![NO_POINT; delaunay.num_undirected_edges()];
        for edge in delaunay.undirected_edges() {
            if edge.is_constraint_edge() {
                let [a, b] = edge.positions().map(|p| DVec2::new(p.x, p.y));
                on_edge[edge.fix().index()] = lay(0.5 * (a + b))?;
            }
        }
        let mut all = Vec::new();
        for vertex in delaunay.vertices() {
            all.clear();
            all.extend(vertex.out_edges());
            let number = |k: usize| all[k % all.len()].face().fix().index();
            let to = |k: usize| all[k % all.len()].to().fix().index() as u32;
            let apex = vertex.fix().index() as u32;
            let first = network.corners.len() as u32;
            // At the outline begin with the edge behind which the wall begins.
            let begins = |&k: &usize| is_inside[number(k)] && !is_inside[number(k + all.len() - 1)];
            if let Some(start) = (0..all.len()).find(begins) {
                let edge = |k: usize| on_edge[all[k % all.len()].as_undirected().fix().index()];
                network.corners.push([apex, NONE]);
                network.corners.push([edge(start), to(start)]);
                let mut k = start;
                while is_inside[number(k)] && k < start + all.len() {
                    k += 1;
                    network.corners.push([middle_of[number(k - 1)], to(k)]);
                }
                network.corners.push([edge(k), NONE]);
            } else {
                let round = (0..all.len()).map(|k| [middle_of[number(k)], to(k + 1)]);
                network.corners.extend(round);
            }
            let count = network.corners.len() as u32 - first;
            network.dice.push(Die { apex, first, count });
        }
        Some(network)
    }

    /// Corners of a die, and the die across the side from each to the next.
    pub(super) fn corners_of(&self, die: u32) -> &[[u32; 2]] {
        let die = &self.dice[die as usize];
        &self.corners[die.first as usize..][..die.count as usize]
    }

    /// Time at which the front passes a die, s.
    pub(super) fn time(&self, die: u32) -> f64 {
        self.since + self.reach[die as usize] / self.speed
    }

    /// Volume of all dice, m³.
    pub(super) fn volume(&self) -> f64 {
        let all = 0..self.dice.len() as u32;
        let corners = all.flat_map(|die| self.triangles_of(die)).map(|t| {
            let [a, b, c] = t.map(|(point, side)| self.points[point as usize][side]);
            a.cross(b).dot(c) / 6.0
        });
        corners.sum()
    }

    /// Area of the cracks between dice, m².
    pub(super) fn crack_area(&self) -> f64 {
        let mut area = 0.0;
        for die in 0..self.dice.len() as u32 {
            let corners = self.corners_of(die);
            for (k, &[a, neighbour]) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()][0];
                if neighbour != NONE && neighbour > die {
                    let [a, b] = [a, b].map(|point| self.points[point as usize]);
                    area += 0.5 * (b[0] - a[1]).cross(a[0] - b[1]).length();
                }
            }
        }
        area
    }
}

/// Which faces lie within the wall: those that an odd number of outlines separates from the outside.
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
