//! Properties that any modal basis must have.

use faer::{Mat, Side};
use frangible_bake::eigen::{residual, rigid_motions};
use frangible_bake::fem::{Cover, System, assemble_cover};
use frangible_bake::{BakeError, MeshSize, Shape};

use crate::verify::case::Findings;
use crate::verify::check::{Check, check, checks};
use crate::verify::models::{GLASS, free_modes, linear, norm, quadratic};

/// Modes of the bowl.
const WANTED: usize = 60;

const DEFINITION: &str = "definition";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let system = quadratic(&Shape::bowl(), 0.012, 1, &GLASS)?;
    let modes = free_modes(&system, WANTED)?;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let motions = rigid_motions(&system);
    let (mut off_identity, mut rigid, mut worst) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..WANTED {
        let inertia = system.mass.multiply(modes.shape(i));
        for j in 0..=i {
            let expected = if i == j { 1.0 } else { 0.0 };
            off_identity = off_identity.max((dot(modes.shape(j), &inertia) - expected).abs());
        }
        for motion in &motions {
            let mass = dot(motion, &system.mass.multiply(motion));
            rigid = rigid.max(dot(motion, &inertia).abs() / mass.sqrt());
        }
        let (residual, limit) = residual(&system, modes.eigenvalues[i], modes.shape(i));
        worst = worst.max(residual / limit);
    }
    let mut checks = checks![
        "largest entry of Φᵀ M Φ − I", "", off_identity => 0.0, 1e-8, DEFINITION;
        "largest rigid share of a mode", "", rigid => 0.0, 1e-9, DEFINITION;
        "largest residual, in limits", "", worst => 0.0, 1.0, "backward error in f64";
    ];
    let block = Shape::block([0.1, 0.08, 0.05]);
    let body = block.analysis_mesh(MeshSize {
        edge: 0.03,
        layers: 2,
    })?;
    let systems = [
        ("T10", quadratic(&block, 0.03, 1, &GLASS)?),
        ("T4", linear(&block, 0.02, 2, &GLASS)?),
        (
            "covering lattice",
            assemble_cover(&Cover::new(&body, 40)?, &GLASS),
        ),
    ];
    for (name, system) in &systems {
        checks.push(null_modes(name, system));
    }
    Ok(checks.into())
}

/// Counts the null eigenvalues of K, scaled to unit diagonal so that nodes with little of the body weigh as much.
fn null_modes(name: &str, system: &System) -> Check {
    let n = system.unknowns();
    let mut matrix = Mat::<f64>::zeros(n, n);
    for j in 0..n {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        for (i, value) in system.multiply(&unit).into_iter().enumerate() {
            matrix[(i, j)] = value;
        }
    }
    let root: Vec<f64> = (0..n).map(|i| matrix[(i, i)].sqrt()).collect();
    let scaled = Mat::from_fn(n, n, |i, j| matrix[(i, j)] / (root[i] * root[j]));
    let values = scaled.self_adjoint_eigenvalues(Side::Lower);
    let values = values.unwrap_or_default();
    let largest = norm(&values);
    let null = values.iter().filter(|v| v.abs() < 1e-9 * largest).count();
    let source = "three shifts and three turns";
    check(
        format!("null modes, {name}"),
        "",
        [null as f64, 6.0],
        0.0,
        source,
    )
}
