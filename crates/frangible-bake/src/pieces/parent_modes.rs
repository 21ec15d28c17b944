//! The parent's modes on the piece's own elements, with the piece's mass.
//!
//! A Ritz method: displacements of the piece are combinations of the parent's mode shapes and of rigid motions. Their small
//! stiffness and mass matrices are integrated over the piece only, with one point per tetrahedron. The eigenvalue problem gives modes
//! that combine the parent's and are orthogonal to the piece's rigid motions. They are too stiff, since they do not satisfy the
//! boundary conditions on the new free faces.

use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::{AnalysisMesh, EmbeddedPoint};
use frangible::internals::modal::ModalBasis;
use frangible::internals::piece::{Elastic, Portion};
use frangible::{Asset, Body};

use crate::eigen::basis::Block;
use crate::pieces::PieceError;
use crate::pieces::dense::{add_product, eigen, product, refused};

/// Shapes that depend on the others to within this share of their mass are left out.
const DEPENDENT: f64 = 1e-7;

/// Most of the parent's modes that are tried.
const MOST: usize = 60;

/// Computes the modes of a piece as combinations of its parent's modes.
///
/// # Errors
/// The piece has no uncut tetrahedra, or the eigenvalue problem has no solution.
pub fn parent_modes(portion: &Arc<Portion>, parent: &Body) -> Result<Elastic, PieceError> {
    if portion.tets().is_empty() {
        return Err(PieceError::NoTetrahedra);
    }
    let asset = &**parent.asset();
    let (analysis, tets, nodes, old) = restricted(portion, asset);
    let held = !portion.supported().is_empty();
    let trial = trial_shapes(asset, &analysis, &old, held, portion.origin());
    let (stiffness, mass) = integrals(portion, asset, &analysis, &tets, &trial);
    let (eigenvalues, combinations) = ritz(&stiffness, &mass, if held { 0 } else { 6 })?;
    let rows = 3 * analysis.nodes.len();
    let count = eigenvalues.len();
    let shapes = product(&trial, &combinations);
    let shapes = (0..rows)
        .flat_map(|row| (0..count).map(move |mode| (row, mode)))
        .map(|at| shapes[at] as f32)
        .collect();
    Ok(Elastic {
        analysis,
        tets,
        nodes,
        modes: ModalBasis {
            eigenvalues,
            shapes,
            peak_stress: Vec::new(),
            ..ModalBasis::default()
        },
    })
}

/// The parent's elements that carry the piece, where its tetrahedra and nodes lie in them, and the numbers their nodes had.
fn restricted(
    portion: &Portion,
    asset: &Asset,
) -> (
    AnalysisMesh,
    Vec<EmbeddedPoint>,
    Vec<EmbeddedPoint>,
    Vec<u32>,
) {
    let whole = asset.analysis();
    let (mut element, mut node) = (
        vec![u32::MAX; whole.elements.len()],
        vec![u32::MAX; whole.nodes.len()],
    );
    let (mut mesh, mut old) = (AnalysisMesh::default(), Vec::new());
    let mut number = |e: u32, mesh: &mut AnalysisMesh| {
        let e = e as usize;
        if element[e] == u32::MAX {
            element[e] = mesh.elements.len() as u32;
            let nodes = whole.elements[e].map(|v| {
                let new = &mut node[v as usize];
                if *new == u32::MAX {
                    *new = old.len() as u32;
                    old.push(v);
                    mesh.nodes.push(whole.nodes[v as usize]);
                }
                *new
            });
            mesh.elements.push(nodes);
            mesh.barycentric_gradients
                .push(whole.barycentric_gradients[e]);
        }
        element[e]
    };
    let mut tets = Vec::with_capacity(portion.tets().len());
    // A node goes with the element of the first tetrahedron around it.
    let mut carrier = vec![u32::MAX; portion.nodes().len()];
    let mut first = u32::MAX;
    for &e in portion.tets() {
        let point = asset.embedded_tet(e as usize);
        let element = number(point.element, &mut mesh);
        tets.push(EmbeddedPoint { element, ..*point });
        first = first.min(element);
        for v in portion.root().fracture().tets[e as usize] {
            if let Ok(place) = portion.nodes().binary_search(&v)
                && carrier[place] == u32::MAX
            {
                carrier[place] = element;
            }
        }
    }
    let positions = &portion.root().fracture().positions;
    let numbered = portion.nodes().iter().zip(&carrier);
    let nodes = numbered.map(|(&v, &element)| {
        // Nodes whose tetrahedra are all cut: few, and beside the others.
        let element = if element == u32::MAX { first } else { element };
        let corner = mesh.nodes[mesh.elements[element as usize][0] as usize];
        let g = &mesh.barycentric_gradients[element as usize];
        let [y, z, w] = [1, 2, 3].map(|k| g[k].dot(positions[v as usize] - corner));
        EmbeddedPoint {
            element,
            barycentric: [1.0 - y - z - w, y, z, w],
            offset: Vec3::ZERO,
        }
    });
    let nodes = nodes.collect();
    (mesh, tets, nodes, old)
}

/// Rigid motions (of a free piece), then the parent's modes: a row per unknown.
fn trial_shapes(
    asset: &Asset,
    analysis: &AnalysisMesh,
    old: &[u32],
    held: bool,
    centre: DVec3,
) -> Block {
    let rigid = if held { 0 } else { 6 };
    let modes = asset.modes().count().min(MOST);
    Block::from_fn(3 * old.len(), rigid + modes, |row, column| {
        let (node, axis) = (row / 3, row % 3);
        if column >= rigid {
            let dof = 3 * old[node] as usize + axis;
            return f64::from(asset.modes().row(dof)[column - rigid]);
        }
        let unit = DVec3::AXES[column % 3];
        if column < 3 {
            return unit[axis];
        }
        unit.cross(analysis.nodes[node].as_dvec3() - centre)[axis]
    })
}

/// Stiffness and mass of the trial shapes over the piece.
fn integrals(
    portion: &Portion,
    asset: &Asset,
    analysis: &AnalysisMesh,
    tets: &[EmbeddedPoint],
    trial: &Block,
) -> (Block, Block) {
    /// Tetrahedra multiplied at once.
    const AT_ONCE: usize = 64;
    /// Most tetrahedra looked at, about.
    const SAMPLES: usize = 2000;
    let m = trial.columns();
    let (mut stiffness, mut mass) = (Block::zeros(m, m), Block::zeros(m, m));
    let mesh = portion.root().fracture();
    // Some tetrahedra stand for many: the shapes vary over the coarse elements only.
    // One of each run, but not always the same: meshes repeat themselves every few tetrahedra.
    let stride = tets.len().div_ceil(SAMPLES).max(1);
    let scattered = |first: usize| {
        // In 64 bits, also where addresses have 32.
        let number = ((first / stride) as u64).wrapping_mul(0x9e37_79b9) >> 7;
        (number % stride as u64) as usize
    };
    let chosen = (0..tets.len()).step_by(stride);
    let chosen = chosen.map(|first| (first + scattered(first)).min(tets.len() - 1));
    let chosen: Vec<usize> = chosen.collect();
    let own = chosen.iter().map(|&i| portion.tets()[i]);
    let volumes: Vec<f64> = own.map(|e| mesh.volume(e as usize)).collect();
    let tets: Vec<EmbeddedPoint> = chosen.iter().map(|&i| tets[i]).collect();
    // Those left out, and those that are cut, count with the others.
    let scale = portion.mass().volume / volumes.iter().sum::<f64>();
    let (lambda, mu) = (
        asset.material().lame_lambda(),
        asset.material().shear_modulus(),
    );
    for (points, volumes) in tets.chunks(AT_ONCE).zip(volumes.chunks(AT_ONCE)) {
        let mut strains = Block::zeros(7 * points.len(), m);
        let mut places = Block::zeros(3 * points.len(), m);
        for (i, (point, volume)) in points.iter().zip(volumes).enumerate() {
            let element = point.element as usize;
            let nodes = &analysis.elements[element];
            let weights = point.shape_values();
            let gradients = point.shape_gradients(&analysis.barycentric_gradients[element]);
            let weight = (volume * scale).sqrt();
            let by_mass = weight * asset.material().density.sqrt();
            let (shear, both) = (weight * mu.sqrt(), weight * (2.0 * mu).sqrt());
            let bulk = weight * lambda.abs().sqrt();
            for column in 0..m {
                let (mut u, mut g) = ([0.0; 3], [[0.0; 3]; 3]);
                for ((&node, w), d) in nodes.iter().zip(weights).zip(gradients) {
                    let d = d.as_dvec3().to_array();
                    for axis in 0..3 {
                        let value = trial[(3 * node as usize + axis, column)];
                        u[axis] += f64::from(w) * value;
                        for k in 0..3 {
                            g[axis][k] += d[k] * value;
                        }
                    }
                }
                for axis in 0..3 {
                    places[(3 * i + axis, column)] = by_mass * u[axis];
                    strains[(7 * i + axis, column)] = both * g[axis][axis];
                    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                    strains[(7 * i + 3 + axis, column)] = shear * (g[j][k] + g[k][j]);
                }
                strains[(7 * i + 6, column)] = bulk * (g[0][0] + g[1][1] + g[2][2]);
            }
        }
        let sign = lambda.signum();
        let signed = Block::from_fn(strains.rows, m, |i, j| {
            strains[(i, j)] * if i % 7 == 6 { sign } else { 1.0 }
        });
        add_product(&mut stiffness, &strains.transposed(), &signed);
        add_product(&mut mass, &places.transposed(), &places);
    }
    (stiffness, mass)
}

/// Eigenvalues and combinations of the trial shapes, without the `rigid` lowest ones.
fn ritz(stiffness: &Block, mass: &Block, rigid: usize) -> Result<(Vec<f64>, Block), PieceError> {
    let m = mass.rows;
    let scale: Vec<f64> = (0..m)
        .map(|i| 1.0 / mass[(i, i)].max(f64::MIN_POSITIVE).sqrt())
        .collect();
    let unit = Block::from_fn(m, m, |i, j| mass[(i, j)] * scale[i] * scale[j]);
    let (values, vectors) = eigen(&unit)?;
    let kept: Vec<usize> = (0..m)
        .filter(|&i| values[i] > DEPENDENT * m as f64)
        .collect();
    if kept.is_empty() {
        return Err(refused("the parent's modes have no motion on the piece"));
    }
    let white = Block::from_fn(m, kept.len(), |i, j| {
        scale[i] * vectors[(i, kept[j])] / values[kept[j]].sqrt()
    });
    let half = product(stiffness, &white);
    let reduced = product(&white.transposed(), &half);
    let (values, vectors) = eigen(&reduced)?;
    let elastic: Vec<usize> = (rigid.min(kept.len())..kept.len())
        .filter(|&i| values[i] > 0.0)
        .collect();
    if elastic.is_empty() {
        return Err(refused(
            "the parent's modes have no deformation on the piece",
        ));
    }
    let chosen = Block::from_fn(kept.len(), elastic.len(), |i, j| vectors[(i, elastic[j])]);
    let eigenvalues = elastic.iter().map(|&i| values[i]).collect();
    Ok((eigenvalues, product(&white, &chosen)))
}
