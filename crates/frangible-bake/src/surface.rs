//! Outer surface of the fracture mesh: smooth normals and radii of curvature.

use frangible::glam::{DVec3, Vec3};
use frangible::internals::TetMesh;
use frangible::internals::asset::OuterSurface;

pub use frangible::internals::asset::SMALLEST_CURVATURE_RADIUS as SMALLEST_RADIUS;

/// Largest angle between the normals of faces that are shaded smoothly across their edge, degrees.
pub const CREASE: f64 = 35.0;
/// Largest angle between the normals of smoothly shaded faces of a lattice mesh, degrees. Its triangles deviate more on curved surfaces.
pub const SOLID_CREASE: f64 = 50.0;
/// Radii above this many body diagonals count as flat: they are the rounding of f32 positions.
const FLAT: f64 = 50.0;

/// Extracts the boundary, oriented outwards; edges of more than `crease` degrees stay sharp.
#[must_use]
pub fn outer_surface(mesh: &TetMesh, crease: f64) -> OuterSurface {
    let boundary = mesh.boundary();
    let triangles: Vec<[u32; 3]> = boundary.iter().map(|b| b.0).collect();
    let x: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    let face: Vec<DVec3> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| x[v as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    let corners = Corners::new(&triangles, x.len());
    let smooth = crease.to_radians().cos();
    let normals = (0..triangles.len()).map(|t| {
        triangles[t].map(|v| {
            let own = face[t];
            let near = corners
                .of(v)
                .iter()
                .filter(|c| face[c.0 as usize].dot(own) > smooth);
            let sum: DVec3 = near
                .map(|&(f, k)| angle(&x, triangles[f as usize], k) * face[f as usize])
                .sum();
            sum.normalize_or(own).as_vec3()
        })
    });
    let normals: Vec<[Vec3; 3]> = normals.collect();
    let radius = vertex_radii(&triangles, &face, &corners, &x, smooth);
    let smallest = |t: &[u32; 3]| {
        t.iter()
            .map(|&v| radius[v as usize])
            .fold(f64::INFINITY, f64::min) as f32
    };
    let curvature_radius = triangles.iter().map(smallest).collect();
    OuterSurface {
        tets: boundary.iter().map(|b| b.1).collect(),
        triangles,
        normals,
        curvature_radius,
        ..OuterSurface::default()
    }
}

/// Triangle corners around each vertex, in rising order.
struct Corners {
    starts: Vec<usize>,
    items: Vec<(u32, usize)>,
}

impl Corners {
    fn new(triangles: &[[u32; 3]], vertices: usize) -> Self {
        let mut all: Vec<(u32, u32, usize)> = triangles
            .iter()
            .enumerate()
            .flat_map(|(f, t)| [0, 1, 2].map(|k| (t[k], f as u32, k)))
            .collect();
        all.sort_unstable();
        let starts = (0..=vertices as u32)
            .map(|v| all.partition_point(|c| c.0 < v))
            .collect();
        Self {
            starts,
            items: all.into_iter().map(|c| (c.1, c.2)).collect(),
        }
    }

    fn of(&self, v: u32) -> &[(u32, usize)] {
        &self.items[self.starts[v as usize]..self.starts[v as usize + 1]]
    }
}

fn angle(x: &[DVec3], t: [u32; 3], k: usize) -> f64 {
    let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]].map(|v| x[v as usize]);
    (b - a).angle_between(c - a)
}

/// Radius of the sharpest bend at each vertex: 1 / max over its edges of 2 n·(x_i − x_j)/|x_i − x_j|²,
/// the curvature of the circle through both ends with normal n at the vertex; convex is positive.
fn vertex_radii(
    triangles: &[[u32; 3]],
    face: &[DVec3],
    corners: &Corners,
    x: &[DVec3],
    smooth: f64,
) -> Vec<f64> {
    let everything = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = x.iter().fold(everything, |(l, h), &p| (l.min(p), h.max(p)));
    let flat = FLAT * low.distance(high);
    (0..x.len())
        .map(|v| {
            let around = corners.of(v as u32);
            let sum: DVec3 = around
                .iter()
                .map(|&(f, k)| angle(x, triangles[f as usize], k) * face[f as usize])
                .sum();
            let n = sum.normalize_or_zero();
            let (mut curvature, mut sharp) = (0.0_f64, false);
            for &(f, k) in around {
                let t = triangles[f as usize];
                let d = x[v] - x[t[(k + 1) % 3] as usize];
                curvature = curvature.max(2.0 * n.dot(d) / d.length_squared());
                // A sharp convex edge: its faces diverge, and each lies below the vertex normal's plane.
                sharp |= around
                    .iter()
                    .any(|g| face[g.0 as usize].dot(face[f as usize]) < smooth)
                    && n.dot(d) > 0.0;
            }
            let radius = if curvature > 0.0 {
                1.0 / curvature
            } else {
                f64::INFINITY
            };
            match (sharp, radius > flat) {
                (true, false) => SMALLEST_RADIUS,
                (_, true) => f64::INFINITY,
                _ => radius.max(SMALLEST_RADIUS),
            }
        })
        .collect()
}
