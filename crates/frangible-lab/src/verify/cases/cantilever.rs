//! A bar held at one end.

use std::f64::consts::TAU;

use frangible_bake::eigen::Constraints;
use frangible_bake::fem::{Elements, assemble};
use frangible_bake::{BakeError, Shape};

use crate::verify::case::Findings;
use crate::verify::check::checks;
use crate::verify::models::{TABLES, modes, quadratic_mesh};

const LENGTH: f64 = 0.5;
const SIDE: f64 = 0.02;

const BEAM: &str = "Euler and Bernoulli's beam, cos β cosh β = −1";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let mesh = quadratic_mesh(&Shape::rod(LENGTH, SIDE), SIDE, 2)?;
    let elements = Elements::Quadratic(&mesh.elements);
    let system = assemble(&mesh.positions, elements, &TABLES);
    let held: Vec<[bool; 3]> = mesh.positions.iter().map(|x| [x.x < 1e-9; 3]).collect();
    let found = modes(&system, &Constraints::of_nodes(&mesh.positions, &held), 4)?;
    let speed = (TABLES.youngs_modulus / TABLES.density).sqrt();
    let of = |beta: f64| beta * beta * speed * SIDE / 12.0_f64.sqrt() / (TAU * LENGTH * LENGTH);
    let (first, second) = (of(1.875_104), of(4.694_091));
    Ok(checks![
        "first bending", "Hz", found.frequency(0) => first, 0.01, BEAM;
        "first bending, across", "Hz", found.frequency(1) => first, 0.01, BEAM;
        "second bending", "Hz", found.frequency(2) => second, 0.02, BEAM;
        "rigid motions left", "", found.rigid_motions as f64 => 0.0, 0.0, "a clamped body has none";
    ]
    .into())
}
