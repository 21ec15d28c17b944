//! Boundary triangles of the fracture mesh under each triangle of the author's surface. They stay the same when the body breaks.

use glam::{DVec3, Vec3};

use super::RenderSurface;
use super::overlay::{Ground, TOWARDS_MIDDLE};
use crate::TriangleTree;

/// The outer surface of a fracture mesh.
#[derive(Clone, Copy, Debug)]
pub struct Boundary<'a> {
    /// Over its triangles.
    pub tree: &'a TriangleTree,
    /// Nodes, m, body frame.
    pub positions: &'a [Vec3],
    /// Its triangles, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
}

impl Boundary<'_> {
    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize].as_dvec3())
    }
}

/// Boundary triangles under or over each triangle of a surface, or close to it where there are none.
#[derive(Debug, Default)]
pub(super) struct Under {
    list: Vec<u32>,
    /// End of the list of each triangle.
    end: Vec<u32>,
    /// Position of each triangle relative to the boundary.
    lies: Vec<Lie>,
}

/// Position of a triangle of a surface relative to the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lie {
    /// Over triangles of the boundary, or under them, and facing as they do.
    Over,
    /// Over or under triangles of the boundary, but wound the wrong way round.
    Turned,
    /// Beside a sharp edge, or in a shell that the fracture mesh does not have.
    Beside,
}

impl Under {
    /// `reach`: how far under or over a triangle is looked, m.
    pub(super) fn new(surface: &RenderSurface, boundary: &Boundary<'_>, reach: f32) -> Self {
        let mut under = Self::default();
        let mut near = Vec::new();
        for triangle in &surface.triangles {
            let corners = triangle.map(|v| surface.positions[v as usize].as_dvec3());
            let [a, b, c] = corners;
            let middle = (a + b + c) / 3.0;
            let home = boundary.tree.closest(middle.as_vec3()).triangle;
            let [p, q, r] = boundary.corners(home);
            let towards = (q - p).cross(r - p).dot((b - a).cross(c - a));
            let mut lie = if towards < 0.0 {
                Lie::Turned
            } else {
                Lie::Over
            };
            near.clear();
            let first = under.list.len();
            if let Some(ground) = Ground::new(corners, lie == Lie::Turned) {
                let [low, high] = ground.near(f64::from(reach)).map(|x| x.as_vec3());
                boundary.tree.in_box(low, high, |t| near.push(t));
                near.sort_unstable();
                let shades = |t: &u32| {
                    ground
                        .shade(boundary.corners(*t), f64::from(reach))
                        .is_some()
                };
                under.list.extend(near.iter().copied().filter(shades));
            }
            if under.list.len() == first {
                lie = Lie::Beside;
                let closest = |p: DVec3| boundary.tree.closest(p.as_vec3()).triangle;
                let corners = corners.map(|p| closest(p.lerp(middle, TOWARDS_MIDDLE)));
                under.list.extend([home].into_iter().chain(corners));
            }
            under.end.push(under.list.len() as u32);
            under.lies.push(lie);
        }
        under
    }

    pub(super) fn lie(&self, triangle: usize) -> Lie {
        self.lies[triangle]
    }

    /// Boundary triangles over or under a triangle of the surface; where that lies beside the boundary, the closest to its middle and then those
    /// to its corners.
    pub(super) fn of(&self, triangle: usize) -> &[u32] {
        let first = triangle.checked_sub(1).map_or(0, |t| self.end[t]);
        &self.list[first as usize..self.end[triangle] as usize]
    }
}
