//! The network of all dice of a wall: their corners on both faces, and their neighbours.

use glam::DVec3;

use super::seeds::Seeds;
use crate::mesh::{PlaneCells, WallFaces};

/// No die: beyond the outline.
pub(super) const NONE: u32 = PlaneCells::OUTSIDE;

/// All dice of a wall.
#[derive(Clone, Debug)]
pub(super) struct Network {
    /// Each point on the upper and on the lower face, m, frame of the fracture mesh.
    pub(super) points: Vec<[DVec3; 2]>,
    /// Corners of all dice, each seen from above, and the die across the side from each to the next. The point of a die has its number, and is the
    /// middle of its fans of triangles; at the outline it is its first corner.
    corners: Vec<[u32; 2]>,
    /// Range of each die in the corners.
    pub(super) dice: Vec<[u32; 2]>,
    /// Distance of each die's point from the first crack, m, in the mean plane.
    reach: Vec<f64>,
    /// Mass of the wall over the volume of the dice, kg/m³.
    pub(super) density: f64,
    /// Time of the first crack, s.
    pub(super) since: f64,
    /// Speed of the front, m/s.
    pub(super) speed: f64,
}

impl Network {
    /// Cuts a wall into dice of this mean area, m², about a point of the body, m. None where no network could be made.
    pub(super) fn new(wall: &WallFaces, origin: DVec3, area: f64, seed: u64) -> Option<Self> {
        let origin = wall.plan_of(origin);
        let Seeds { points, edges } = Seeds::scatter(wall, origin, area, seed);
        let reach = points.iter().map(|p| p.distance(origin)).collect();
        let cells = PlaneCells::new(points, edges)?;
        let faces = |p| wall.faces_at(p).map(|(_, faces)| faces);
        Some(Self {
            points: cells.points.into_iter().map(faces).collect::<Option<_>>()?,
            corners: cells.corners,
            dice: cells.ranges,
            reach,
            density: 0.0,
            since: 0.0,
            speed: 0.0,
        })
    }

    /// Corners of a die, and the die across the side from each to the next.
    pub(super) fn corners_of(&self, die: u32) -> &[[u32; 2]] {
        let [first, count] = self.dice[die as usize];
        &self.corners[first as usize..][..count as usize]
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
