//! Bodies and impacts for the comparison.

use std::ops::ControlFlow;
use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::{AnalysisMesh, AssetParts, ConvexCell, EmbeddedPoint, Embedding};
use frangible::internals::modal::ModalBasis;
use frangible::internals::stress::StressBounds;
use frangible::internals::{MassProperties, TetMesh};
use frangible::{Asset, Body, Breakable, Contact, InputError, Material, Striker};
use frangible_bake::eigen::lowest_modes;
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, assemble};
use frangible_bake::surface::{CREASE, outer_surface};
use frangible_bake::{BakeError, BakeSpec, BodyMesh, MeshSize, Shape, bake};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::reference::options::Strain;
use crate::reference::stress::{principal, stress};

/// The paper's case: the linear elements that crack carry the modes as well.
///
/// `frangible` stores quadratic elements: each mid-edge node gets the mean of its two corners, which is the same
/// linear field.
///
/// # Errors
/// More modes than the mesh has, or a mesh that cannot be solved.
pub fn linear_asset(
    name: &str,
    mut mesh: BodyMesh,
    material: Material,
    modes: usize,
) -> Result<Asset, BakeError> {
    let corners = (0..mesh.tets.len()).map(|e| mesh.corners(e));
    let mut mass = MassProperties::of_tetrahedra(material.density, corners);
    mesh.translate(-mass.centre);
    mass.centre = DVec3::ZERO;
    let elasticity = Elasticity::from(&material);
    let system = assemble(&mesh.positions, Elements::Linear(&mesh.tets), &elasticity);
    let found = lowest_modes(&system, modes, &mut |_| ControlFlow::Continue(()))?;

    let quadratic = QuadraticMesh::new(&mesh);
    let corner_count = mesh.positions.len();
    let mut ends = vec![[0_u32; 2]; quadratic.positions.len()];
    for v in 0..corner_count {
        ends[v] = [v as u32; 2];
    }
    for element in &quadratic.elements {
        for (a, [i, j]) in [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]
            .into_iter()
            .enumerate()
        {
            ends[element[4 + a] as usize] = [element[i], element[j]];
        }
    }
    let mut shapes = Vec::with_capacity(3 * ends.len() * modes);
    for [i, j] in ends {
        for axis in 0..3 {
            for mode in 0..modes {
                let at = |v: u32| f64::from(found.shape(mode)[3 * v as usize + axis] as f32);
                shapes.push((0.5 * (at(i) + at(j))) as f32);
            }
        }
    }
    let positions = |p: &[DVec3]| p.iter().map(|p| p.as_vec3()).collect::<Vec<Vec3>>();
    let fracture = TetMesh::new(positions(&mesh.positions), mesh.tets.clone());
    let own = |e: usize, barycentric: [f32; 4]| EmbeddedPoint {
        element: e as u32,
        barycentric,
        offset: Vec3::ZERO,
    };
    let mut nodes = vec![own(0, [0.25; 4]); corner_count];
    for (e, tet) in mesh.tets.iter().enumerate() {
        for k in 0..4 {
            let corner = std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
            nodes[tet[k] as usize] = own(e, corner);
        }
    }
    let mut asset = Asset::from_parts(AssetParts {
        name: name.into(),
        material,
        surface: outer_surface(&fracture, CREASE),
        analysis: AnalysisMesh {
            nodes: positions(&quadratic.positions),
            barycentric_gradients: barycentric_gradients(&mesh),
            elements: quadratic.elements,
        },
        embedding: Embedding {
            tets: (0..mesh.tets.len()).map(|e| own(e, [0.25; 4])).collect(),
            nodes,
        },
        modes: ModalBasis {
            eigenvalues: found.eigenvalues,
            shapes,
            peak_stress: vec![0.0; modes],
            ..ModalBasis::default()
        },
        bounds: StressBounds::default(),
        mass,
        cells: vec![ConvexCell {
            points: fracture.positions.clone(),
        }],
        cell_of_tet: vec![0; mesh.tets.len()],
        supported: Vec::new(),
        render: None,
        portion: None,
        fracture: fracture.into(),
    });
    asset.parts_mut().modes.peak_stress = peak_stress(&asset);
    Ok(asset)
}

/// ∇L of every element from the inverse of its edges.
fn barycentric_gradients(mesh: &BodyMesh) -> Vec<[Vec3; 4]> {
    let of = |e: usize| {
        let x = mesh.corners(e);
        let edges = frangible::glam::DMat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0]);
        let rows = edges.inverse().transpose();
        let rest = [rows.x_axis, rows.y_axis, rows.z_axis];
        let first = -(rest[0] + rest[1] + rest[2]);
        [first, rest[0], rest[1], rest[2]].map(|g| g.as_vec3())
    };
    (0..mesh.tets.len()).map(of).collect()
}

/// Largest principal stress, either sign, of each mode at amplitudes so small that strain is linear.
fn peak_stress(asset: &Asset) -> Vec<f32> {
    const SMALL: f64 = 1e-9;
    let modes = asset.modes().count();
    let mut peak = vec![0.0_f32; modes];
    for (e, tet) in asset.fracture().tets.iter().enumerate() {
        for (mode, peak) in peak.iter_mut().enumerate() {
            let mut gradient = [[0.0; 3]; 3];
            for (a, g) in asset.analysis().barycentric_gradients[e].iter().enumerate() {
                for i in 0..3 {
                    let u = f64::from(asset.modes().row(3 * tet[a] as usize + i)[mode]) * SMALL;
                    for j in 0..3 {
                        gradient[i][j] += u * f64::from(g[j]);
                    }
                }
            }
            let (sigma, _) =
                principal(&stress(asset.material(), &gradient, Strain::GreenLagrange).0);
            let largest = sigma[0].abs().max(sigma[2].abs()) / SMALL;
            *peak = peak.max(largest as f32);
        }
    }
    peak
}

/// A body and how hard it is hit: about half of the generated impacts break it.
#[derive(Clone, Debug)]
pub struct Case {
    /// The body.
    pub asset: Arc<Asset>,
    /// Largest speed of an impact, m/s.
    pub speed: f64,
}

fn brittle(strength: f64, spacing: f64, roughness: [f64; 2]) -> Material {
    // Present by the presets' own tests.
    let mut material = Material::preset("glass").unwrap_or_else(|e| panic!("{e}"));
    material.strength = strength;
    material.fracture_energy = 8.0;
    material.energy_depth = 2.0 * 8.0 * material.youngs_modulus / (strength * strength);
    material.weak_point_density = 1.0 / spacing.powi(3);
    [material.roughness_amplitude, material.roughness_wavelength] = roughness;
    material
}

/// Shapes of the comparison: a block, a rod, a plate, and a bowl.
fn shapes() -> [(&'static str, Shape, f64, usize, Material); 4] {
    [
        (
            "block",
            Shape::block([0.06, 0.05, 0.04]),
            0.0065,
            0,
            brittle(40e6, 8e-3, [2e-4, 0.01]),
        ),
        (
            "rod",
            Shape::rod(0.16, 0.02),
            0.006,
            0,
            brittle(40e6, 5e-3, [0.0, 0.01]),
        ),
        (
            "plate",
            Shape::plate(0.12, 0.1, 0.008),
            0.006,
            2,
            brittle(40e6, 5e-3, [1e-4, 0.005]),
        ),
        (
            "bowl",
            Shape::bowl(),
            0.009,
            2,
            brittle(40e6, 5e-3, [1e-4, 0.005]),
        ),
    ]
}

/// Bodies whose linear elements carry the modes: a block, a rod, a plate, a hollow bowl.
///
/// # Errors
/// None with these shapes, by their tests.
pub fn linear_cases() -> Result<Vec<Case>, BakeError> {
    let mut cases = Vec::new();
    for (name, shape, edge, layers, material) in shapes() {
        let mesh = shape.fracture_mesh(MeshSize { edge, layers }, 1)?;
        cases.push(Case {
            asset: Arc::new(linear_asset(name, mesh, material, 40)?),
            speed: 50.0,
        });
    }
    Ok(cases)
}

/// The bodies as `frangible_bake` bakes them, with quadratic elements of their own.
///
/// # Errors
/// None with these shapes, by their tests.
pub fn baked_cases() -> Result<Vec<Case>, BakeError> {
    let mut cases = Vec::new();
    for (name, shape, edge, layers, material) in shapes() {
        let spec = BakeSpec {
            analysis: Some(MeshSize {
                edge: 2.5 * edge,
                layers: 1,
            }),
            fracture: Some(MeshSize { edge, layers }),
            modes: 40,
            ..BakeSpec::new(name, shape, material)
        };
        cases.push(Case {
            asset: Arc::new(bake(&spec)?),
            speed: 50.0,
        });
    }
    Ok(cases)
}

/// Impact `number` on a body: its own weak points, one contact or two, anywhere, rigid or elastic strikers.
///
/// # Errors
/// An asset that does not validate.
pub fn impact(case: &Case, number: u64) -> Result<(Body, Vec<Contact>), InputError> {
    let mut rng = ChaCha8Rng::seed_from_u64(number);
    let mut random = move || (rng.next_u64() >> 11) as f64 * 0.5_f64.powi(53);
    let body = Breakable::uniform(case.asset.clone())?.body(number);
    let asset = &case.asset;
    let count = if random() < 0.75 { 1 } else { 2 };
    let mut contacts = Vec::new();
    for _ in 0..count {
        let triangles = &asset.surface().triangles;
        let triangle = triangles[(random() * triangles.len() as f64) as usize];
        let x = triangle.map(|v| asset.fracture().positions[v as usize].as_dvec3());
        let outward = (x[1] - x[0]).cross(x[2] - x[0]).normalize();
        // Well inside the triangle, a little off it; up to about 40° from its normal.
        let l = [0.15 + random(), 0.15 + random(), 0.15 + random()];
        let on = (x[0] * l[0] + x[1] * l[1] + x[2] * l[2]) / (l[0] + l[1] + l[2]);
        let aside = DVec3::new(random() - 0.5, random() - 0.5, random() - 0.5);
        let normal = (-outward + aside).normalize();
        let speed = case.speed * (0.1_f64).powf(random());
        let (modulus, radius, inverse_mass) = if random() < 0.5 {
            (f64::INFINITY, f64::INFINITY, 0.0)
        } else {
            (2e11, 0.005 + 0.03 * random(), 2.0 + 20.0 * random())
        };
        let give = asset.mass().inverse_effective_mass(on, normal) + inverse_mass;
        let mut striker = Striker::rigid()
            .with_contact_modulus(modulus)
            .with_curvature_radius(radius)
            .with_restitution(0.3);
        striker.inverse_effective_mass = inverse_mass as f32;
        contacts.push(Contact {
            point: (on + 1e-4 * outward * random()).as_vec3(),
            normal: normal.as_vec3(),
            impulse: (1.3 * speed / give) as f32,
            friction: Vec3::ZERO,
            approach_speed: speed as f32,
            duration: 0.0,
            striker,
        });
    }
    Ok((body, contacts))
}
