//! Beyond the paper: the stress of a weak element at its flaw on the free surface, and in thin walls.
//!
//! The place of a surface point in the analysis mesh, the place of a flaw on its face, and the elements that are walls are taken from `frangible`, as
//! its embedded centroids are. The face that holds the flaw, and the stress there, are found anew.

use frangible::glam::DVec3;
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::stress::Skin;
use frangible::{Body, FractureConfig, Material};

use crate::reference::body::Solid;
use crate::reference::stress::{Matrix, hooke, strain};

/// Points at which the weak elements of a body are tested.
pub(crate) enum Look {
    /// At their centres.
    Centres,
    /// At their flaws; `pressed`: surface triangles under a contact.
    Flaws {
        skin: Box<Skin>,
        pressed: Vec<u32>,
        /// Place of each flaw in the analysis mesh, on its face, drawn by the seed of the body.
        points: Vec<EmbeddedPoint>,
    },
}

impl Look {
    pub(crate) fn new(solid: &Solid, body: &Body, surface_flaws: bool, pressed: &[u32]) -> Self {
        if surface_flaws {
            let config = FractureConfig::default();
            let tets = 0..solid.asset.fracture().tets.len() as u32;
            Self::Flaws {
                points: tets
                    .map(|e| body.weak_place(e, &config, pressed).0)
                    .collect(),
                skin: Box::new(Skin::of(solid.asset)),
                pressed: pressed.to_vec(),
            }
        } else {
            Self::Centres
        }
    }

    /// Stress (Pa) and energy density (J/m³) of a weak element.
    pub(crate) fn stress(&self, solid: &Solid, u: &[DVec3], e: usize) -> (Matrix, f64) {
        let Self::Flaws {
            skin,
            pressed,
            points,
        } = self
        else {
            return crate::reference::stress::stress(
                solid.material,
                &solid.gradient(u, e),
                solid.strain,
            );
        };
        let wall = skin.wall(solid.asset, e);
        let across = wall.map(|w| w.normal.as_dvec3().normalize());
        let face = largest_free_face(solid, e);
        let flaw = face.filter(|(triangle, _)| !pressed.contains(triangle));
        match (flaw.zip(skin.flaw(e)), across) {
            (Some(((_, n), _)), across) => {
                let strain = strain(&solid.gradient_at(u, &points[e]), solid.strain);
                match across.filter(|a| a.dot(n).abs() < 0.5) {
                    Some(a) => free_of_two(solid.material, &strain, n, a),
                    None => free_of_one(solid.material, &strain, n),
                }
            }
            (None, Some(a)) => {
                let strain = strain(&solid.gradient(u, e), solid.strain);
                free_of_one(solid.material, &strain, a)
            }
            (None, None) => crate::reference::stress::stress(
                solid.material,
                &solid.gradient(u, e),
                solid.strain,
            ),
        }
    }
}

/// Number of the surface triangle and outward normal.
fn largest_free_face(solid: &Solid, e: usize) -> Option<(u32, DVec3)> {
    let (mesh, surface) = (solid.asset.fracture(), solid.asset.surface());
    let held = |v: &u32| solid.asset.supported().binary_search(v).is_ok();
    let mut best = None;
    let mut most = 0.0;
    for k in 0..4 {
        let mut nodes = mesh.tets[e].to_vec();
        let opposite = solid.nodes[nodes.remove(k) as usize];
        if mesh.neighbours[e][k] != NO_NEIGHBOUR || nodes.iter().all(held) {
            continue;
        }
        let [a, b, c] = [0, 1, 2].map(|i| solid.nodes[nodes[i] as usize]);
        let mut across = (b - a).cross(c - a);
        if across.dot(opposite - a) > 0.0 {
            across = -across;
        }
        // Of two of one size the first in the surface's order, which is that of the tetrahedron's nodes.
        if across.length() > most * (1.0 + 1e-7) {
            most = across.length();
            let triangle = (0..surface.tets.len()).find(|&t| {
                surface.tets[t] as usize == e
                    && nodes.iter().all(|v| surface.triangles[t].contains(v))
            });
            best = triangle.map(|t| (t as u32, across.normalize()));
        }
    }
    best
}

/// Stress at a free surface of this normal: the strain across it is such that no traction is left.
fn free_of_one(material: &Material, strain: &Matrix, n: DVec3) -> (Matrix, f64) {
    let nu = material.poisson_ratio;
    let frame = frame(n, n.any_orthonormal_vector());
    let mut local = turned(strain, frame);
    for i in 0..2 {
        (local[i][2], local[2][i]) = (0.0, 0.0);
    }
    local[2][2] = -nu / (1.0 - nu) * (local[0][0] + local[1][1]);
    back(material, &local, frame)
}

/// Stress at an edge between two free surfaces of these normals, where only the tension along it is left.
fn free_of_two(material: &Material, strain: &Matrix, n: DVec3, m: DVec3) -> (Matrix, f64) {
    let frame = frame(n.cross(m).normalize(), n);
    let along = turned(strain, frame)[2][2];
    let aside = -material.poisson_ratio * along;
    let local = [[aside, 0.0, 0.0], [0.0, aside, 0.0], [0.0, 0.0, along]];
    back(material, &local, frame)
}

/// Axes of a frame: third along `n`, first perpendicular to it near `a`.
fn frame(n: DVec3, a: DVec3) -> [DVec3; 3] {
    let first = (a - a.dot(n) * n).normalize();
    [first, n.cross(first), n]
}

fn turned(a: &Matrix, axes: [DVec3; 3]) -> Matrix {
    let of = |u: DVec3, v: DVec3| {
        let mut sum = 0.0;
        for i in 0..3 {
            for j in 0..3 {
                sum += u[i] * a[i][j] * v[j];
            }
        }
        sum
    };
    std::array::from_fn(|i| std::array::from_fn(|j| of(axes[i], axes[j])))
}

fn back(material: &Material, local: &Matrix, axes: [DVec3; 3]) -> (Matrix, f64) {
    let (sigma, energy) = hooke(material, local);
    let transposed = std::array::from_fn(|i| DVec3::new(axes[0][i], axes[1][i], axes[2][i]));
    (turned(&sigma, transposed), energy)
}
