//! The two faces of a body that is one thin wall, such as a pane, as functions of a place in its mean plane.

mod grid;
mod outline;

use glam::{DMat3, DVec2, DVec3, Vec3};

pub use grid::Grid;
use outline::{corners, loops};

use crate::{MassProperties, TriangleTree, symmetric_eigen};

/// Cosine between a face and the mean plane, at least; what is steeper is the wall's edge.
const FACE: f64 = 0.5;
/// Differences of the wall's thickness from its mean, as a share of it, at most.
const UNEVEN: f64 = 0.2;
/// Width of a wall over its thickness, at least.
const SLENDER: f64 = 6.0;
/// Share of the body's volume that may lie elsewhere than between the two faces.
const ELSEWHERE: f64 = 0.01;
/// A corner of a triangle opposite a point is taken for its opposite if it is farther than the nearest point by no more than this factor.
const OPPOSITE_CORNER: f64 = 1.02;

/// A wall between two faces that are height fields over its mean plane.
#[derive(Clone, Debug)]
pub struct WallFaces {
    /// Two axes of the mean plane, and its normal.
    axes: [DVec3; 3],
    /// Vertices of the upper face, m, in the mean plane.
    plan: Vec<DVec2>,
    /// Each of them, and the point of the lower face opposite it, m, frame of the fracture mesh.
    faces: Vec<[DVec3; 2]>,
    triangles: Vec<[u32; 3]>,
    of_square: Grid,
    /// Corners of the outlines, m, in the mean plane, the wall on the left.
    pub outlines: Vec<Vec<DVec2>>,
    /// Mean thickness, m.
    pub thickness: f64,
    /// Corners of the smallest box about it, m, in the mean plane.
    pub bounds: [DVec2; 2],
}

impl WallFaces {
    /// Finds the faces of a body in its closed outer surface. `mass`: of the body.
    ///
    /// # Errors
    /// A clause that says why the body is no such wall.
    pub fn of(
        positions: &[Vec3],
        surface: &[[u32; 3]],
        mass: &MassProperties,
    ) -> Result<Self, String> {
        let (moments, directions): (DVec3, DMat3) = symmetric_eigen(mass.inertia);
        let largest = (0..3).max_by(|&a, &b| moments[a].total_cmp(&moments[b]));
        let normal = directions.col(largest.unwrap_or(0)).normalize();
        let first = normal.any_orthonormal_vector();
        let axes = [first, normal.cross(first), normal];
        let place = |v: u32| positions[v as usize].as_dvec3();
        let (mut upper, mut lower) = (Vec::new(), Vec::new());
        for triangle in surface {
            let [a, b, c] = triangle.map(place);
            let slope = (b - a).cross(c - a).normalize_or_zero().dot(normal);
            match slope {
                _ if slope > FACE => upper.push(*triangle),
                _ if slope < -FACE => lower.push(*triangle),
                _ => {}
            }
        }
        if upper.is_empty() || lower.is_empty() {
            return Err("it has no two faces along its mean plane".into());
        }
        let mut number = vec![u32::MAX; positions.len()];
        let mut vertices = Vec::new();
        for v in upper.iter_mut().flatten() {
            let own = &mut number[*v as usize];
            if *own == u32::MAX {
                *own = vertices.len() as u32;
                vertices.push(*v);
            }
            *v = *own;
        }
        let behind = Behind::new(positions, &lower);
        let faces: Vec<[DVec3; 2]> = vertices
            .iter()
            .map(|&v| [place(v), behind.of(place(v))])
            .collect();
        let plan: Vec<DVec2> = faces
            .iter()
            .map(|f| DVec2::new(f[0].dot(axes[0]), f[0].dot(axes[1])))
            .collect();
        let bounds = [
            plan.iter().copied().reduce(DVec2::min).unwrap_or_default(),
            plan.iter().copied().reduce(DVec2::max).unwrap_or_default(),
        ];
        let lengths = || faces.iter().map(|f| f[0].distance(f[1]));
        let thickness = lengths().sum::<f64>() / faces.len() as f64;
        let (least, most) =
            lengths().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        if most - thickness > UNEVEN * thickness || thickness - least > UNEVEN * thickness {
            return Err(format!(
                "its thickness is between {:.3} and {:.3} mm",
                1e3 * least,
                1e3 * most
            ));
        }
        let across = (bounds[1] - bounds[0]).min_element();
        if across < SLENDER * thickness {
            return Err(format!(
                "it is {:.1} mm thick and {:.1} mm across",
                1e3 * thickness,
                1e3 * across
            ));
        }
        let volume = volume(&faces, &upper);
        let whole = mass.volume;
        if (volume / whole - 1.0).abs() > ELSEWHERE {
            return Err(format!(
                "{:.1} cm³ lie between its two faces, but it has {:.1} cm³",
                1e6 * volume,
                1e6 * whole
            ));
        }
        let rounds = loops(&upper, plan.len()).ok_or("the outline of its face meets itself")?;
        let size = (bounds[1] - bounds[0]).max_element();
        let outlines = rounds.iter().map(|round| {
            let places: Vec<DVec2> = round.iter().map(|&v| plan[v as usize]).collect();
            corners(&places, size)
        });
        let outlines = outlines.collect();
        let mut of_square = Grid::new(bounds, size / (upper.len() as f64).sqrt());
        for (t, triangle) in (0..).zip(&upper) {
            let [a, b, c] = triangle.map(|v| plan[v as usize]);
            of_square.add([a.min(b).min(c), a.max(b).max(c)], t);
        }
        Ok(Self {
            axes,
            plan,
            faces,
            triangles: upper,
            of_square,
            outlines,
            thickness,
            bounds,
        })
    }

    /// Place in the mean plane of a point of the body, m.
    pub fn plan_of(&self, p: DVec3) -> DVec2 {
        DVec2::new(p.dot(self.axes[0]), p.dot(self.axes[1]))
    }

    /// The points of the upper and the lower face at a place of the mean plane, m; just outside the outline those of the nearest triangle. With the
    /// least share of a corner of the triangle there, which is below zero outside.
    pub fn faces_at(&self, p: DVec2) -> Option<(f64, [DVec3; 2])> {
        let mut best: Option<(f64, u32, [f64; 3])> = None;
        for t in self.of_square.near([p, p]) {
            let [a, b, c] = self.triangles[t as usize].map(|v| self.plan[v as usize]);
            let area = (b - a).perp_dot(c - a);
            let (u, v) = (
                (p - a).perp_dot(c - a) / area,
                (b - a).perp_dot(p - a) / area,
            );
            let shares = [1.0 - u - v, u, v];
            let least = shares[0].min(u).min(v);
            if best.is_none_or(|(known, ..)| least > known) {
                best = Some((least, t, shares));
            }
            if least >= 0.0 {
                break;
            }
        }
        let (least, t, shares) = best?;
        let corners = self.triangles[t as usize].map(|v| self.faces[v as usize]);
        let face = |k: usize| (0..3).map(|i| corners[i][k] * shares[i]).sum();
        Some((least, [face(0), face(1)]))
    }
}

/// Volume between two faces of triangles, m³.
fn volume(faces: &[[DVec3; 2]], triangles: &[[u32; 3]]) -> f64 {
    let prism = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| faces[v as usize]);
        let tets = [
            [a[1], b[1], c[1], c[0]],
            [a[1], b[1], c[0], b[0]],
            [a[1], b[0], c[0], a[0]],
        ];
        let solid = MassProperties::of_tetrahedra(1.0, tets.into_iter());
        solid.volume.abs()
    };
    triangles.iter().map(prism).sum()
}

/// Finds the points of a face that lie opposite others.
struct Behind<'a> {
    positions: &'a [Vec3],
    lower: &'a [[u32; 3]],
    tree: TriangleTree,
}

impl<'a> Behind<'a> {
    fn new(positions: &'a [Vec3], lower: &'a [[u32; 3]]) -> Self {
        let tree = TriangleTree::new(positions, lower);
        Self {
            positions,
            lower,
            tree,
        }
    }

    /// The point of the face nearest to this one; a corner of its mesh, where that is as near.
    fn of(&self, p: DVec3) -> DVec3 {
        let nearest = self.tree.closest(p.as_vec3());
        let corners = self.lower[nearest.triangle as usize];
        let corners = corners.map(|v| self.positions[v as usize].as_dvec3());
        let by_distance = |a: &&DVec3, b: &&DVec3| a.distance(p).total_cmp(&b.distance(p));
        let corner = corners.iter().min_by(by_distance);
        let distance = nearest.position.as_dvec3().distance(p);
        match corner.filter(|c| c.distance(p) <= OPPOSITE_CORNER * distance) {
            Some(corner) => *corner,
            None => nearest.position.as_dvec3(),
        }
    }
}
