//! Fills mesh files with tetrahedra and prints a line of JSON for each: `mesh_file [--out FOLDER] TETRAHEDRA FILE…`
//!
//! With `--out` each mesh is written to FOLDER as a Medit file, `bunny.obj` as `bunny.mesh`.

use std::error::Error;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use frangible_mesh::{
    MeshSolid, Resolution, TetBody, TetOptions, read_mesh, repair, tetrahedralize, wall_thickness,
};

const USAGE: &str = "usage: mesh_file [--out FOLDER] TETRAHEDRA FILE…";

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).peekable();
    let out = match arguments.next_if(|a| a == "--out") {
        Some(_) => Some(PathBuf::from(arguments.next().ok_or(USAGE)?)),
        None => None,
    };
    let tets = arguments.next().ok_or(USAGE)?.parse()?;
    for file in arguments {
        match mesh(Path::new(&file), tets, out.as_deref()) {
            Ok(line) => println!("{line}"),
            Err(error) => println!(
                "{{\"file\": {file:?}, \"failed\": {:?}}}",
                error.to_string()
            ),
        }
    }
    Ok(())
}

fn mesh(file: &Path, tets: usize, out: Option<&Path>) -> Result<String, Box<dyn Error>> {
    let mut clock = Instant::now();
    let mut lap = || {
        std::mem::replace(&mut clock, Instant::now())
            .elapsed()
            .as_secs_f64()
    };
    let input = read_mesh(file)?;
    let read = lap();
    let (surface, mended) = repair(&input)?;
    let repaired = lap();
    let solid = MeshSolid::new(&surface)?;
    let tree = lap();
    let wall = wall_thickness(&solid, 400, 1);
    let walls = lap();
    let mut options = TetOptions::default();
    options.resolution = Resolution::Tets(tets);
    options.wall = wall.of_shell();
    options.irregular = Some(1);
    let (body, report) = tetrahedralize(&solid, &options)?;
    let filled = lap();
    if let Some(folder) = out {
        let mut name = file.file_stem().unwrap_or_default().to_os_string();
        name.push(".mesh");
        fs::create_dir_all(folder)?;
        write_medit(&folder.join(name), &body)?;
    }
    eprintln!("{}: {mended}; {wall:?}; {report}", file.display());
    Ok(format!(
        "{{\"file\": {:?}, \"triangles\": {}, \"tets\": {}, \"nodes\": {}, \"smallest_angle\": {:.2}, \
         \"largest_angle\": {:.2}, \"volume\": {:e}, \"seconds\": {:.4}, \"read\": {read:.4}, \"repair\": {repaired:.4}, \
         \"tree\": {tree:.4}, \"walls\": {walls:.4}, \"fill\": {filled:.4}}}",
        file.to_string_lossy(),
        surface.triangles.len(),
        report.tets,
        report.nodes,
        report.smallest_angle,
        report.largest_angle,
        report.volume,
        repaired + tree + walls + filled
    ))
}

/// ASCII Medit file: one node or tetrahedron per line, counted from 1, each with the reference 0.
fn write_medit(path: &Path, body: &TetBody) -> io::Result<()> {
    let mut to = BufWriter::new(File::create(path)?);
    writeln!(to, "MeshVersionFormatted 2\nDimension\n3")?;
    writeln!(to, "Vertices\n{}", body.positions.len())?;
    for p in &body.positions {
        writeln!(to, "{} {} {} 0", p.x, p.y, p.z)?;
    }
    writeln!(to, "Tetrahedra\n{}", body.tets.len())?;
    for tet in &body.tets {
        let [a, b, c, d] = tet.map(|node| u64::from(node) + 1);
        writeln!(to, "{a} {b} {c} {d} 0")?;
    }
    writeln!(to, "End")?;
    to.flush()
}
