//! Displacement and linear stress of a vibration mode as fields on the body, for visualization.
//!
//! The stresses are averaged at the nodes, since element stresses are discontinuous and look blotchy; the simulation uses the element
//! stresses.

use frangible::glam::{Mat3, Vec3};
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::stress::Symmetric3;
use frangible::{Asset, Material};

/// A mode at the nodes of a mesh, with one entry per node in each list. The sign of the mode and of its stresses is arbitrary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeField {
    /// Displacements, m per unit amplitude (m·√kg): 1/√kg.
    pub displacements: Vec<Vec3>,
    /// Linear stresses, Pa per unit amplitude (m·√kg).
    pub stresses: Vec<Symmetric3>,
}

impl ModeField {
    /// Returns the magnitude of the largest displacement, 1/√kg.
    #[must_use]
    pub fn largest_displacement(&self) -> f32 {
        self.displacements
            .iter()
            .map(|u| u.length())
            .fold(0.0, f32::max)
    }
}

/// Evaluates mode `mode`, from 0, at the nodes of the fracture mesh, which is the mesh that is broken and drawn. Stresses are
/// interpolated from [`mode_on_analysis_mesh`], so that they are continuous.
///
/// # Panics
/// If the asset has no such mode.
#[must_use]
pub fn mode_on_fracture_mesh(asset: &Asset, mode: usize) -> ModeField {
    onto_fracture_mesh(asset, &mode_on_analysis_mesh(asset, mode))
}

/// Evaluates the motion with these modal amplitudes, m·√kg, at the nodes of the fracture mesh: displacements in m, stresses in
/// Pa. Modes beyond the list have amplitude zero.
#[must_use]
pub fn motion_on_fracture_mesh(asset: &Asset, amplitudes: &[f32]) -> ModeField {
    onto_fracture_mesh(asset, &motion_on_analysis_mesh(asset, amplitudes))
}

fn onto_fracture_mesh(asset: &Asset, coarse: &ModeField) -> ModeField {
    let mut field = ModeField::default();
    for point in &asset.embedding().nodes {
        let (value, gradient) = value_and_gradient(asset, &coarse.displacements, point);
        field.displacements.push(value + gradient * point.offset);
        let mut stress = Symmetric3::default();
        let nodes = &asset.analysis().elements[point.element as usize];
        for (&node, weight) in nodes.iter().zip(point.shape_values()) {
            add(&mut stress, weight, &coarse.stresses[node as usize]);
        }
        field.stresses.push(stress);
    }
    field
}

/// Evaluates mode `mode`, from 0, at the nodes of the analysis mesh. Element stresses are discontinuous, so they are averaged over
/// the elements around each node; nodes without elements have zero stress.
///
/// # Panics
/// If the asset has no such mode.
#[must_use]
pub fn mode_on_analysis_mesh(asset: &Asset, mode: usize) -> ModeField {
    with_stresses(asset, mode_displacements(asset, mode))
}

/// Evaluates the motion with these modal amplitudes, m·√kg, at the nodes of the analysis mesh: displacements in m, stresses in
/// Pa, averaged as in [`mode_on_analysis_mesh`]. Modes beyond the list have amplitude zero.
#[must_use]
pub fn motion_on_analysis_mesh(asset: &Asset, amplitudes: &[f32]) -> ModeField {
    let count = asset.modes().count();
    let along = |row: &[f32]| row.iter().zip(amplitudes).map(|(phi, q)| phi * q).sum();
    let rows = asset.modes().shapes.chunks_exact(3 * count);
    let displacements = rows
        .map(|row| {
            let [x, y, z] = [0, 1, 2].map(|axis| along(&row[axis * count..][..count]));
            Vec3::new(x, y, z)
        })
        .collect();
    with_stresses(asset, displacements)
}

fn with_stresses(asset: &Asset, displacements: Vec<Vec3>) -> ModeField {
    let mut stresses = vec![Symmetric3::default(); displacements.len()];
    let mut counts = vec![0.0_f32; displacements.len()];
    for (element, nodes) in (0..).zip(&asset.analysis().elements) {
        for (&node, barycentric) in nodes.iter().zip(NODE_PLACES) {
            let point = EmbeddedPoint {
                element,
                barycentric,
                offset: Vec3::ZERO,
            };
            let gradient = value_and_gradient(asset, &displacements, &point).1;
            let stress = linear_stress(gradient, asset.material());
            add(&mut stresses[node as usize], 1.0, &stress);
            counts[node as usize] += 1.0;
        }
    }
    for (stress, count) in stresses.iter_mut().zip(counts) {
        let sum = std::mem::take(stress);
        add(stress, count.max(1.0).recip(), &sum);
    }
    ModeField {
        displacements,
        stresses,
    }
}

fn mode_displacements(asset: &Asset, mode: usize) -> Vec<Vec3> {
    let count = asset.modes().count();
    assert!(mode < count, "mode {mode} of {count}");
    let rows = asset.modes().shapes.chunks_exact(3 * count);
    rows.map(|row| Vec3::new(row[mode], row[count + mode], row[2 * count + mode]))
        .collect()
}

/// Value and gradient of a field of vectors at the analysis nodes, at the closest point of an element; column j = ∂u/∂x_j.
fn value_and_gradient(asset: &Asset, field: &[Vec3], point: &EmbeddedPoint) -> (Vec3, Mat3) {
    let element = point.element as usize;
    let barycentric_gradients = &asset.analysis().barycentric_gradients[element];
    let gradients = point.shape_gradients(barycentric_gradients);
    let (mut value, mut gradient) = (Vec3::ZERO, Mat3::ZERO);
    for ((&node, n), g) in asset.analysis().elements[element]
        .iter()
        .zip(point.shape_values())
        .zip(gradients)
    {
        let u = field[node as usize];
        value += n * u;
        gradient.x_axis += u * g.x;
        gradient.y_axis += u * g.y;
        gradient.z_axis += u * g.z;
    }
    (value, gradient)
}
/// Returns the von Mises equivalent stress, √(3 J₂).
#[must_use]
pub fn von_mises(stress: &Symmetric3) -> f32 {
    let ([xx, yy, zz], [xy, yz, zx]) = (stress.diagonal, stress.off);
    let differences = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * differences + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
}

/// `to` + `weight` × `stress`, into `to`.
fn add(to: &mut Symmetric3, weight: f32, stress: &Symmetric3) {
    for i in 0..3 {
        to.diagonal[i] += weight * stress.diagonal[i];
        to.off[i] += weight * stress.off[i];
    }
}

/// Barycentric coordinates of an element's ten nodes, in their order.
const NODE_PLACES: [[f32; 4]; 10] = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0, 0.0],
    [0.0, 0.5, 0.5, 0.0],
    [0.5, 0.0, 0.5, 0.0],
    [0.5, 0.0, 0.0, 0.5],
    [0.0, 0.5, 0.0, 0.5],
    [0.0, 0.0, 0.5, 0.5],
];

/// σ = λ tr(ε) I + 2μ ε, ε = ½(∇u + ∇uᵀ). A unit amplitude moves light bodies by metres, so that the quadratic terms
/// of the Green–Lagrange strain would swamp this.
fn linear_stress(gradient: Mat3, material: &Material) -> Symmetric3 {
    let strain = Symmetric3::from_mat3(gradient);
    let (lambda, mu) = (
        material.lame_lambda() as f32,
        material.shear_modulus() as f32,
    );
    let pressure = lambda * strain.diagonal.iter().sum::<f32>();
    Symmetric3 {
        diagonal: strain.diagonal.map(|e| 2.0 * mu * e + pressure),
        off: strain.off.map(|e| 2.0 * mu * e),
    }
}
