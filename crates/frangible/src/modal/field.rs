//! A vibration mode as fields on the body, for those who look at it: displacement and linear stress at points.

use glam::{Mat3, Vec3};

use crate::asset::{Asset, EmbeddedPoint};
use crate::material::Material;
use crate::stress::{ShapeWeights, Symmetric3};

/// A mode at the nodes of a mesh, one entry per node in each list. Its sign, and so that of its stresses, is arbitrary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeField {
    /// Displacements, m per unit amplitude (m·√kg): 1/√kg.
    pub displacements: Vec<Vec3>,
    /// Linear stresses, Pa per unit amplitude (m·√kg).
    pub stresses: Vec<Symmetric3>,
}

impl ModeField {
    /// Length of the largest displacement, 1/√kg.
    #[must_use]
    pub fn largest_displacement(&self) -> f32 {
        self.displacements
            .iter()
            .map(|u| u.length())
            .fold(0.0, f32::max)
    }
}

impl Asset {
    /// Mode number `mode`, from 0, at the nodes of the fracture mesh: the body as it is broken and drawn.
    ///
    /// # Panics
    /// If the asset has no such mode.
    #[must_use]
    pub fn mode_on_fracture_mesh(&self, mode: usize) -> ModeField {
        let motion = self.mode_displacements(mode);
        let mut field = ModeField::default();
        for point in &self.embedding.nodes {
            let (displacement, stress) = self.mode_at(&motion, point);
            field.displacements.push(displacement);
            field.stresses.push(stress);
        }
        field
    }

    /// Mode number `mode`, from 0, at the nodes of the analysis mesh. Stresses jump from element to element; these are
    /// the means over the elements around each node. Nodes of no element have none.
    ///
    /// # Panics
    /// If the asset has no such mode.
    #[must_use]
    pub fn mode_on_analysis_mesh(&self, mode: usize) -> ModeField {
        let displacements = self.mode_displacements(mode);
        let mut sums = vec![(Symmetric3::default(), 0.0_f32); displacements.len()];
        for (element, nodes) in (0..).zip(&self.analysis.elements) {
            for (&node, barycentric) in nodes.iter().zip(NODE_PLACES) {
                let point = EmbeddedPoint {
                    element,
                    barycentric,
                    offset: Vec3::ZERO,
                };
                let stress = self.mode_at(&displacements, &point).1;
                let (sum, count) = &mut sums[node as usize];
                for i in 0..3 {
                    sum.diagonal[i] += stress.diagonal[i];
                    sum.off[i] += stress.off[i];
                }
                *count += 1.0;
            }
        }
        let stresses = sums.iter().map(|(sum, count)| {
            let share = count.max(1.0).recip();
            Symmetric3 {
                diagonal: sum.diagonal.map(|s| share * s),
                off: sum.off.map(|s| share * s),
            }
        });
        ModeField {
            stresses: stresses.collect(),
            displacements,
        }
    }

    fn mode_displacements(&self, mode: usize) -> Vec<Vec3> {
        let count = self.modes.count();
        assert!(mode < count, "mode {mode} of {count}");
        let rows = self.modes.shapes.chunks_exact(3 * count);
        rows.map(|row| Vec3::new(row[mode], row[count + mode], row[2 * count + mode]))
            .collect()
    }

    fn mode_at(&self, displacements: &[Vec3], point: &EmbeddedPoint) -> (Vec3, Symmetric3) {
        let element = point.element as usize;
        let barycentric_gradients = &self.analysis.barycentric_gradients[element];
        let gradients = ShapeWeights::gradients(point, barycentric_gradients);
        let (mut value, mut gradient) = (Vec3::ZERO, Mat3::ZERO);
        for ((&node, n), g) in self.analysis.elements[element]
            .iter()
            .zip(ShapeWeights::values(point))
            .zip(gradients)
        {
            let u = displacements[node as usize];
            value += n * u;
            gradient.x_axis += u * g.x;
            gradient.y_axis += u * g.y;
            gradient.z_axis += u * g.z;
        }
        let displacement = value + gradient * point.offset;
        (displacement, linear_stress(gradient, &self.material))
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
