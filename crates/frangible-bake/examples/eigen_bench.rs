//! Eigenproblems for comparison with other solvers: builds them, times ours on one thread, and writes the matrices.
//!
//! `eigen_bench FOLDER CASE [--modes 100] [--runs 3] [--no-matrices]` writes K.mtx and M.mtx (Matrix Market, lower
//! triangles) and eigenvalues.txt to FOLDER and prints a line of JSON. Without arguments it lists the cases.

use std::fmt::Write as _;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use faer::sparse::SparseColMat;
use frangible::Material;
use frangible_bake::eigen::{Modes, Phase, lowest_modes};
use frangible_bake::fem::{
    Cover, Elasticity, Elements, Mass, QuadraticMesh, System, assemble, assemble_cover,
};
use frangible_bake::{BodyMesh, MeshSize, Shape};

type Failure = Box<dyn std::error::Error>;

/// Name of each case, and its description.
const CASES: [(&str, &str); 10] = [
    ("cube-2k", "T4 cube"),
    ("slab-8k", "T4 slab"),
    ("slab-20k", "T4 slab"),
    ("slab-40k", "T4 slab"),
    ("slab-175k", "T4 slab"),
    ("plate-t10", "T10 plate"),
    ("block-t10", "T10 block"),
    ("glass-t10", "T10 drinking glass"),
    ("rabbit-cover", "T10 cover of a rabbit, consistent mass"),
    ("pig-cover", "T10 cover of a piggy bank, consistent mass"),
];

fn main() -> Result<(), Failure> {
    let mut words = std::env::args().skip(1);
    let (Some(folder), Some(case)) = (words.next(), words.next()) else {
        for (name, what) in CASES {
            println!("{name}: {what}");
        }
        return Ok(());
    };
    let (mut wanted, mut runs, mut matrices) = (100, 3, true);
    while let Some(word) = words.next() {
        let mut number = || {
            words
                .next()
                .ok_or("a number is missing")?
                .parse()
                .map_err(Failure::from)
        };
        match word.as_str() {
            "--modes" => wanted = number()?,
            "--runs" => runs = number()?,
            "--no-matrices" => matrices = false,
            _ => return Err(format!("unknown option {word}").into()),
        }
    }
    let system = system(&case)?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    if matrices {
        write_matrix(&folder.join("K.mtx"), &system.stiffness, 1)?;
        match &system.mass {
            Mass::Lumped(mass) => write_diagonal(&folder.join("M.mtx"), mass)?,
            Mass::Consistent(matrix) => write_matrix(&folder.join("M.mtx"), matrix, 3)?,
        }
    }
    let mut timed = Vec::new();
    for _ in 0..runs {
        let (started, before) = (Instant::now(), processor_seconds());
        let modes = lowest_modes(&system, wanted, &mut |_| ControlFlow::Continue(()))?;
        let wall = started.elapsed().as_secs_f64();
        let used = processor_seconds()
            .zip(before)
            .map(|(now, then)| now - then);
        timed.push((used.unwrap_or(wall), modes));
    }
    timed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (seconds, modes) = &timed[timed.len() / 2];
    let text: String = modes
        .eigenvalues
        .iter()
        .map(|v| format!("{v:.17e}\n"))
        .collect();
    fs::write(folder.join("eigenvalues.txt"), text)?;
    println!("{}", json(&case, &system, *seconds, modes));
    Ok(())
}

/// Processor time of this process so far, s, where the system tells: load does not count.
fn processor_seconds() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}

fn system(case: &str) -> Result<System, Failure> {
    let material = Elasticity::from(&Material::preset("glass")?);
    let linear = |shape: Shape, edge: f64, layers: usize| -> Result<System, Failure> {
        let mesh = shape.analysis_mesh(MeshSize { edge, layers })?;
        let elements = Elements::Linear(&mesh.tets);
        Ok(assemble(&mesh.positions, elements, &material))
    };
    let quadratic = |mesh: BodyMesh| {
        let mesh = QuadraticMesh::new(&mesh);
        assemble(
            &mesh.positions,
            Elements::Quadratic(&mesh.elements),
            &material,
        )
    };
    let slab = || Shape::plate(0.4, 0.4, 0.01);
    let at_default = |shape: &Shape| shape.analysis_mesh(shape.analysis_size()?);
    let cover = |name: &str, elements: usize| -> Result<System, Failure> {
        let shape = Shape::ready(name).ok_or("no such solid")?;
        let body = shape.fracture_mesh(shape.fracture_size()?, 1)?;
        Ok(assemble_cover(&Cover::new(&body, elements)?, &material))
    };
    match case {
        "cube-2k" => linear(Shape::block([0.1; 3]), 0.0143, 0),
        "slab-8k" => linear(slab(), 0.4 / 26.0, 2),
        "slab-20k" => linear(slab(), 0.4 / 41.0, 2),
        "slab-40k" => linear(slab(), 0.4 / 58.0, 2),
        "slab-175k" => linear(slab(), 0.4 / 104.0, 3),
        "plate-t10" => Ok(quadratic(at_default(&Shape::plate(0.4, 0.4, 0.004))?)),
        "block-t10" => Ok(quadratic(at_default(&Shape::block([0.1, 0.08, 0.06]))?)),
        "glass-t10" => Ok(quadratic(at_default(&Shape::drinking_glass())?)),
        "rabbit-cover" => cover("rabbit", 3000),
        "pig-cover" => cover("piggy_bank", 5000),
        _ => Err(format!("no case {case}; without arguments the cases are listed").into()),
    }
}

/// The lower triangle whose entries stand for the `axes` diagonal ones of a block.
fn write_matrix(path: &Path, lower: &SparseColMat<usize, f64>, axes: usize) -> Result<(), Failure> {
    let (n, mut entries, mut text) = (axes * lower.ncols(), 0, String::new());
    for j in 0..lower.ncols() {
        for (i, value) in lower.as_ref().row_idx_of_col(j).zip(lower.val_of_col(j)) {
            for axis in 0..axes {
                let (row, column) = (axes * i + axis + 1, axes * j + axis + 1);
                writeln!(text, "{row} {column} {value:.17e}")?;
                entries += 1;
            }
        }
    }
    write_file(path, n, entries, &text)
}

fn write_diagonal(path: &Path, mass: &[f64]) -> Result<(), Failure> {
    let mut text = String::new();
    for i in 0..3 * mass.len() {
        writeln!(text, "{0} {0} {1:.17e}", i + 1, mass[i / 3])?;
    }
    write_file(path, 3 * mass.len(), 3 * mass.len(), &text)
}

fn write_file(path: &Path, n: usize, entries: usize, text: &str) -> Result<(), Failure> {
    let head = "%%MatrixMarket matrix coordinate real symmetric";
    fs::write(path, format!("{head}\n{n} {n} {entries}\n{text}"))?;
    Ok(())
}

fn json(case: &str, system: &System, seconds: f64, modes: &Modes) -> String {
    let phase = |(phase, seconds): &(Phase, f64)| format!("\"{phase}\": {seconds:.4}");
    let phases: Vec<String> = modes.seconds.iter().map(phase).collect();
    format!(
        "{{\"case\": \"{case}\", \"unknowns\": {}, \"entries\": {}, \"modes\": {}, \"seconds\": {seconds:.4}, \
         \"residual\": {:.3e}, \"rigid\": {}, \"phases\": {{{}}}}}",
        system.unknowns(),
        system.stiffness.compute_nnz(),
        modes.eigenvalues.len(),
        modes.max_residual,
        modes.rigid_motions,
        phases.join(", ")
    )
}
