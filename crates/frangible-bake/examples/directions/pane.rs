//! Panes of several meshes.

use frangible::glam::{DVec3, Vec3};
use frangible::{Asset, Material};
use frangible_bake::frangible_mesh::InputMesh;
use frangible_bake::{BakeSpec, ImportOptions, PaneShape, Shape, bake, import_mesh};

use crate::{Options, Result, SIDE, THICKNESS};

/// Sides of the polygon of a round plate.
const ROUND: usize = 96;

/// Bakes the pane of the options.
pub(crate) fn pane(options: &Options) -> Result<Asset> {
    let round = options.get("round", 0.0) > 0.0;
    let shape = if options.get("file", 0.0) > 0.0 {
        let turned = options.get("turned", 0.0).to_radians();
        let mesh = sheet(if round { ROUND } else { 4 }, turned);
        let mut import = ImportOptions::default();
        if let Some(&tets) = options.0.get("tets") {
            import.tets = tets as usize;
        }
        import_mesh(&mesh, &import)?.shape
    } else if round {
        Shape::Pane(PaneShape {
            size: [SIDE, SIDE, THICKNESS],
            corner: 0.5 * SIDE,
            bow: 0.0,
        })
    } else {
        Shape::plate(SIDE, SIDE, THICKNESS)
    };
    let mut spec = BakeSpec::new("pane", shape, Material::preset("glass")?);
    spec.seed = options.get("mesh", 1.0) as u64;
    spec.modes = options.get("modes", 60.0) as usize;
    if let Some(&tets) = options.0.get("tets")
        && !matches!(spec.shape, Shape::Wall(_))
    {
        spec.fracture = Some(spec.shape.size_for(tets)?);
    }
    Ok(bake(&spec)?)
}

/// A prism over a polygon of so many corners, the first of them at `turned`, rad, from the diagonal: a square of the side [`SIDE`], or
/// nearly the circle inside it.
fn sheet(corners: usize, turned: f64) -> InputMesh {
    let radius = 0.5 * SIDE / (std::f64::consts::PI / corners as f64).cos();
    let corner = |k: usize, z: f64| {
        let part = k as f64 / corners as f64;
        let angle = turned + std::f64::consts::TAU * part + std::f64::consts::FRAC_PI_4;
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    let n = corners as u32;
    let mut positions: Vec<DVec3> = [0.0, THICKNESS]
        .iter()
        .flat_map(|&z| (0..corners).map(move |k| corner(k, z)))
        .collect();
    positions.extend([0.0, THICKNESS].map(|z| DVec3::new(0.0, 0.0, z)));
    let mut triangles = Vec::new();
    for k in 0..n {
        let next = (k + 1) % n;
        triangles.push([2 * n, next, k]);
        triangles.push([2 * n + 1, n + k, n + next]);
        triangles.push([k, next, n + next]);
        triangles.push([k, n + next, n + k]);
    }
    InputMesh {
        positions,
        triangles,
        ..InputMesh::default()
    }
}

/// The pane with six motions of its own in place of its modes: stretched along x, along y and sheared, and bent the same ways, each by the
/// same strain of its face.
pub(crate) fn uniform(mut asset: Asset) -> Asset {
    let half = 0.5 * THICKNESS as f32;
    let shapes = |p: Vec3| {
        let (x, y, z) = (p.x, p.y, p.z);
        let stretch = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.5 * y, 0.5 * x, 0.0]];
        let bend = [
            [x * z, 0.0, -0.5 * x * x],
            [0.0, y * z, -0.5 * y * y],
            [0.5 * y * z, 0.5 * x * z, -0.5 * x * y],
        ];
        (stretch, bend.map(|u| u.map(|c| c / half)))
    };
    let parts = asset.parts_mut();
    parts.modes.shapes.clear();
    for &node in &parts.analysis.nodes {
        let (stretch, bend) = shapes(node);
        for axis in 0..3 {
            let row = stretch.iter().chain(&bend).map(|u| u[axis]);
            parts.modes.shapes.extend(row);
        }
    }
    asset.parts_mut().modes.eigenvalues = vec![1e6; 6];
    asset.parts_mut().modes.residual_modes = 0;
    asset.parts_mut().modes.peak_stress = vec![0.0; 6];
    *asset.parts_mut().bounds = Default::default();
    asset
}
