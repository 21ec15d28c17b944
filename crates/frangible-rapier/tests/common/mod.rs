//! A glass box of convex cells, and a fake fracture that slices it into blocks.

pub(crate) mod baked;
pub(crate) mod tumble;

use std::sync::Arc;

use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::internals::asset::{
    AnalysisMesh, AssetParts, ConvexCell, EmbeddedPoint, Embedding, OuterSurface,
};
use frangible::internals::modal::ModalBasis;
use frangible::internals::{MassProperties, TetMesh};
use frangible::{
    Asset, Body, Breakable, Contact, Fracture, FractureConfig, Fragment, ImpactReport, InputError,
    Material, Outcome, TriMesh,
};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, WorldConfig};

pub(crate) const DENSITY: f64 = 2500.0;

/// A glass box with `cells` convex cells along each axis.
pub(crate) fn box_asset(half: Vec3, cells: [usize; 3]) -> Arc<Asset> {
    let count = cells.map(|n| n + 1);
    let node = |i: usize, j: usize, k: usize| (i + count[0] * (j + count[1] * k)) as u32;
    let mut positions = Vec::new();
    for k in 0..count[2] {
        for j in 0..count[1] {
            for i in 0..count[0] {
                let s = Vec3::new(
                    i as f32 / cells[0] as f32,
                    j as f32 / cells[1] as f32,
                    k as f32 / cells[2] as f32,
                );
                positions.push((2.0 * s - Vec3::ONE) * half);
            }
        }
    }
    let (mut tets, mut cell_of_tet, mut convex) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..cells[2] {
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                let c: [u32; 8] =
                    std::array::from_fn(|b| node(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2)));
                // Kuhn's six tetrahedra around the diagonal 0–7.
                for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
                    tets.push([c[0], c[a], c[b], c[7]]);
                    cell_of_tet.push(convex.len() as u32);
                }
                convex.push(ConvexCell {
                    points: c.iter().map(|&v| positions[v as usize]).collect(),
                });
            }
        }
    }
    let fracture = TetMesh::new(positions, tets);
    assert!((0..fracture.tets.len()).all(|e| fracture.volume(e) > 0.0));
    let boundary = fracture.boundary();
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| fracture.positions[v as usize]);
        (b - a).cross(c - a).normalize()
    };
    let surface = OuterSurface {
        triangles: boundary.iter().map(|(t, _)| *t).collect(),
        tets: boundary.iter().map(|(_, e)| *e).collect(),
        normals: boundary.iter().map(|(t, _)| [normal(t); 3]).collect(),
        curvature_radius: vec![f32::INFINITY; boundary.len()],
        ..OuterSurface::default()
    };
    let point = EmbeddedPoint {
        element: 0,
        barycentric: [0.25; 4],
        offset: Vec3::ZERO,
    };
    let embedding = Embedding {
        tets: vec![point; fracture.tets.len()],
        nodes: vec![point; fracture.positions.len()],
    };
    let analysis = AnalysisMesh {
        nodes: vec![Vec3::ZERO; 10],
        elements: vec![std::array::from_fn(|i| i as u32)],
        barycentric_gradients: vec![[Vec3::ZERO; 4]],
    };
    Arc::new(Asset::from_parts(AssetParts {
        name: "box".into(),
        material: Material::preset("glass").unwrap(),
        mass: block_mass(Vec3::ZERO, half),
        fracture: fracture.into(),
        surface,
        analysis,
        embedding,
        modes: ModalBasis::default(),
        bounds: Default::default(),
        cells: convex,
        cell_of_tet,
        supported: Vec::new(),
        render: None,
        portion: None,
    }))
}

pub(crate) fn body(asset: &Arc<Asset>) -> Body {
    Breakable::uniform(Arc::clone(asset)).unwrap().body(1)
}

fn block_mass(centre: Vec3, half: Vec3) -> MassProperties {
    let h = half.as_dvec3();
    let volume = 8.0 * h.x * h.y * h.z;
    let mass = DENSITY * volume;
    let squares = DVec3::new(
        h.y * h.y + h.z * h.z,
        h.x * h.x + h.z * h.z,
        h.x * h.x + h.y * h.y,
    );
    let inertia = DMat3::from_diagonal(squares * (mass / 3.0));
    MassProperties {
        mass,
        volume,
        centre: centre.as_dvec3(),
        inertia,
    }
}

fn corners(centre: Vec3, half: Vec3) -> Vec<Vec3> {
    (0..8)
        .map(|b| {
            let sign = |bit: i32| if b >> bit & 1 == 1 { 1.0 } else { -1.0 };
            centre + half * Vec3::new(sign(0), sign(1), sign(2))
        })
        .collect()
}

/// A closed block; `overlap` m wider than the piece it stands for, as the hull of a jagged piece is.
fn block(centre: Vec3, half: Vec3, overlap: f32) -> Fragment {
    let positions = corners(Vec3::ZERO, half + Vec3::splat(overlap));
    let quads: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles: Vec<[u32; 3]> = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let normals = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            [(b - a).cross(c - a).normalize(); 3]
        })
        .collect();
    let mesh = TriMesh {
        outer_triangles: triangles.len(),
        normals,
        triangles,
        cracks: Vec::new(),
        positions,
    };
    assert!(mesh.is_closed() && mesh.volume() > 0.0);
    let cell_shares = vec![(0, mesh.positions.clone())];
    Fragment {
        mesh,
        neighbours: Vec::new(),
        render: None,
        mass: block_mass(centre, half),
        cell_shares,
        supported: false,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
    }
}

/// The box in `slices` blocks along each axis, of uneven width.
pub(crate) fn sliced(
    half: Vec3,
    slices: [usize; 3],
    overlap: f32,
    fracture_energy: f64,
) -> Fracture {
    // Cuts at quadratic positions: pieces differ in size, largest last along each axis.
    let cut = |k: usize, n: usize| {
        let s = k as f32 / n as f32;
        2.0 * (0.7 * s + 0.3 * s * s) - 1.0
    };
    let mut fragments = Vec::new();
    for k in 0..slices[2] {
        for j in 0..slices[1] {
            for i in 0..slices[0] {
                let at = |d: usize, n: usize| (cut(d, n), cut(d + 1, n));
                let (x, y, z) = (at(i, slices[0]), at(j, slices[1]), at(k, slices[2]));
                let low = Vec3::new(x.0, y.0, z.0) * half;
                let high = Vec3::new(x.1, y.1, z.1) * half;
                fragments.push(block(0.5 * (low + high), 0.5 * (high - low), overlap));
            }
        }
    }
    fragments.sort_by(|a, b| b.mass.mass.total_cmp(&a.mass.mass));
    let mut report = ImpactReport::default();
    report.fracture_energy = fracture_energy;
    Fracture::new(fragments, report)
}

pub(crate) type Judge =
    Box<dyn Fn(&Body, &[Contact], &FractureConfig) -> Result<Outcome, InputError> + Send + Sync>;

/// Every impact breaks the box.
pub(crate) fn slicer(half: Vec3, slices: [usize; 3], overlap: f32, fracture_energy: f64) -> Judge {
    Box::new(move |_, _, _| {
        Ok(Outcome::Broke(Box::new(sliced(
            half,
            slices,
            overlap,
            fracture_energy,
        ))))
    })
}

/// No impact breaks anything.
pub(crate) fn unbreakable() -> Judge {
    Box::new(|_, _, _| {
        Ok(Outcome::Held {
            margin: f64::INFINITY,
            report: Default::default(),
            state: None,
        })
    })
}

pub(crate) fn world(gravity: bool) -> BreakableWorld {
    let mut config = WorldConfig::default();
    if !gravity {
        config.gravity = Vector::ZERO;
    }
    config.record_held = true;
    BreakableWorld::new(config).unwrap()
}

pub(crate) fn at(x: f32, y: f32, z: f32) -> Pose {
    Pose::translation(x, y, z)
}

/// Steps until something breaks; `None` after `limit` steps without.
pub(crate) fn step_to_break(
    world: &mut BreakableWorld,
    limit: usize,
) -> Option<frangible_rapier::BreakEvent> {
    (0..limit).find_map(|_| world.step().unwrap().first().cloned())
}

/// Relative distance of two vectors.
pub(crate) fn relative(a: DVec3, b: DVec3) -> f64 {
    (a - b).length() / a.length().max(b.length())
}
