//! The body as plain numbers in f64.

use frangible::glam::DVec3;
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::{Asset, Material};
use thiserror::Error;

use crate::reference::options::Strain;

/// Interpolation of displacements within an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// The paper's: the elements that carry the modes are those that crack, linear, with the displacements at their nodes.
    Linear,
    /// The asset's: quadratic elements, evaluated where the centre of each fracture element lies in them.
    Embedded,
}

/// Error of an asset that cannot be used.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum ReferenceError {
    /// The modes do not live on the fracture mesh.
    #[error(
        "the analysis mesh is not the fracture mesh (element {element} differs); take `Field::Embedded`, or an asset whose \
         elements are the same"
    )]
    OtherMesh {
        /// The first element that differs.
        element: usize,
    },
}

/// A body and its modes.
pub(crate) struct Solid<'a> {
    pub(crate) asset: &'a Asset,
    pub(crate) material: &'a Material,
    pub(crate) field: Field,
    pub(crate) strain: Strain,
    pub(crate) nodes: Vec<DVec3>,
    pub(crate) centres: Vec<DVec3>,
    /// ∇L of the four barycentric coordinates of the element that carries the displacement, 1/m.
    gradients: Vec<[DVec3; 4]>,
}

impl<'a> Solid<'a> {
    pub(crate) fn new(asset: &'a Asset, field: Field) -> Result<Self, ReferenceError> {
        let mesh = asset.fracture();
        if field == Field::Linear {
            for (e, tet) in mesh.tets.iter().enumerate() {
                if asset.analysis().elements.get(e).map(|n| &n[..4]) != Some(&tet[..]) {
                    return Err(ReferenceError::OtherMesh { element: e });
                }
            }
        }
        let nodes: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
        let corners = |tet: &[u32; 4]| tet.map(|v| nodes[v as usize]);
        let gradients = match field {
            Field::Linear => mesh.tets.iter().map(|t| gradients(corners(t))).collect(),
            Field::Embedded => asset
                .analysis()
                .elements
                .iter()
                .map(|n| {
                    gradients(std::array::from_fn(|k| {
                        asset.analysis().nodes[n[k] as usize].as_dvec3()
                    }))
                })
                .collect(),
        };
        let centre = |tet: &[u32; 4]| corners(tet).iter().sum::<DVec3>() / 4.0;
        Ok(Self {
            asset,
            material: asset.material(),
            field,
            strain: Strain::GreenLagrange,
            centres: mesh.tets.iter().map(centre).collect(),
            gradients,
            nodes,
        })
    }

    pub(crate) fn corners(&self, e: usize) -> [DVec3; 4] {
        self.asset.fracture().tets[e].map(|v| self.nodes[v as usize])
    }

    /// Face neighbours of an element, by rising number: the paper gives no order.
    pub(crate) fn neighbours(&self, e: usize) -> Vec<usize> {
        let mut all: Vec<usize> = self.asset.fracture().neighbours[e]
            .iter()
            .filter(|&&n| n != NO_NEIGHBOUR)
            .map(|&n| n as usize)
            .collect();
        all.sort_unstable();
        all
    }

    /// Nodes that carry displacements.
    fn carriers(&self) -> usize {
        match self.field {
            Field::Linear => self.nodes.len(),
            Field::Embedded => self.asset.analysis().nodes.len(),
        }
    }

    /// u = Φ q at all nodes that carry displacements, m.
    pub(crate) fn displacements(&self, q: &[f64]) -> Vec<DVec3> {
        let mut all = Vec::with_capacity(self.carriers());
        for v in 0..self.carriers() {
            let mut u = DVec3::ZERO;
            for axis in 0..3 {
                for (i, &phi) in self.asset.modes().row(3 * v + axis).iter().enumerate() {
                    u[axis] += f64::from(phi) * q[i];
                }
            }
            all.push(u);
        }
        all
    }

    /// φ_i(b) · n of every mode for the point with weights `l` in a triangle of fracture nodes, 1/√kg.
    pub(crate) fn modal_shape(&self, triangle: [u32; 3], l: [f64; 3], n: DVec3) -> Vec<f64> {
        let modes = self.asset.modes();
        let mut xi = vec![0.0; modes.count()];
        let mut add = |node: usize, weight: f64| {
            for axis in 0..3 {
                for (i, &phi) in modes.row(3 * node + axis).iter().enumerate() {
                    xi[i] += weight * n[axis] * f64::from(phi);
                }
            }
        };
        for k in 0..3 {
            match self.field {
                Field::Linear => add(triangle[k] as usize, l[k]),
                Field::Embedded => {
                    let at = &self.asset.embedding().nodes[triangle[k] as usize];
                    let element = self.asset.analysis().elements[at.element as usize];
                    let values = quadratic_values(at.barycentric.map(f64::from));
                    for a in 0..10 {
                        add(element[a] as usize, l[k] * values[a]);
                    }
                }
            }
        }
        xi
    }

    /// ∇u in fracture element `e`, `[i][j]` = ∂u_i/∂x_j.
    pub(crate) fn gradient(&self, u: &[DVec3], e: usize) -> [[f64; 3]; 3] {
        match self.field {
            Field::Linear => {
                let tet = self.asset.fracture().tets[e];
                sum((0..4).map(|a| (u[tet[a] as usize], self.gradients[e][a])))
            }
            Field::Embedded => self.gradient_at(u, &self.asset.embedding().tets[e]),
        }
    }

    /// The gradient of the displacement at a point of the analysis mesh.
    pub(crate) fn gradient_at(&self, u: &[DVec3], at: &EmbeddedPoint) -> [[f64; 3]; 3] {
        let element = at.element as usize;
        if self.field == Field::Linear {
            return self.gradient(u, element);
        }
        let g = quadratic_gradients(at.barycentric.map(f64::from), self.gradients[element]);
        let nodes = self.asset.analysis().elements[element];
        sum((0..10).map(|a| (u[nodes[a] as usize], g[a])))
    }
}

/// Σ u ⊗ ∇N.
fn sum(terms: impl Iterator<Item = (DVec3, DVec3)>) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (u, g) in terms {
        for i in 0..3 {
            for j in 0..3 {
                sum[i][j] += u[i] * g[j];
            }
        }
    }
    sum
}

/// Gradients of the barycentric coordinates: of L_k, the area vector of the face opposite k over three volumes.
fn gradients(x: [DVec3; 4]) -> [DVec3; 4] {
    std::array::from_fn(|k| {
        let [a, b, c] = [(k + 1) % 4, (k + 2) % 4, (k + 3) % 4].map(|i| x[i]);
        let normal = (b - a).cross(c - a);
        normal / normal.dot(x[k] - a)
    })
}

/// End corners of the mid-edge nodes 4 … 9.
const ENDS: [(usize, usize); 6] = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)];

fn quadratic_values(l: [f64; 4]) -> [f64; 10] {
    let mut n = [0.0; 10];
    for a in 0..4 {
        n[a] = 2.0 * l[a] * l[a] - l[a];
    }
    for (a, (i, j)) in ENDS.into_iter().enumerate() {
        n[4 + a] = 4.0 * l[i] * l[j];
    }
    n
}

fn quadratic_gradients(l: [f64; 4], g: [DVec3; 4]) -> [DVec3; 10] {
    let mut n = [DVec3::ZERO; 10];
    for a in 0..4 {
        n[a] = g[a] * (4.0 * l[a] - 1.0);
    }
    for (a, (i, j)) in ENDS.into_iter().enumerate() {
        n[4 + a] = 4.0 * (l[i] * g[j] + l[j] * g[i]);
    }
    n
}
