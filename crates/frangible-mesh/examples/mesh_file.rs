//! Fills mesh files with tetrahedra and prints a line of JSON for each: `mesh_file TETRAHEDRA FILE…`

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use frangible_mesh::{
    MeshSolid, Resolution, TetOptions, read_mesh, repair, tetrahedralize, wall_thickness,
};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let tets = arguments
        .next()
        .ok_or("usage: mesh_file TETRAHEDRA FILE…")?
        .parse()?;
    for file in arguments {
        match mesh(Path::new(&file), tets) {
            Ok(line) => println!("{line}"),
            Err(error) => println!("{{\"file\": \"{file}\", \"failed\": \"{error}\"}}"),
        }
    }
    Ok(())
}

fn mesh(file: &Path, tets: usize) -> Result<String, Box<dyn Error>> {
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
    options.check_volume = std::env::var_os("CHECK").is_some();
    options.irregular = Some(1);
    let (_, report) = tetrahedralize(&solid, &options)?;
    let filled = lap();
    eprintln!("{}: {mended}; {wall:?}; {report}", file.display());
    Ok(format!(
        "{{\"file\": \"{}\", \"triangles\": {}, \"tets\": {}, \"nodes\": {}, \"smallest_angle\": {:.2}, \
         \"largest_angle\": {:.2}, \"volume\": {:e}, \"seconds\": {:.4}, \"read\": {read:.4}, \"repair\": {repaired:.4}, \
         \"tree\": {tree:.4}, \"walls\": {walls:.4}, \"fill\": {filled:.4}}}",
        file.display(),
        surface.triangles.len(),
        report.tets,
        report.nodes,
        report.smallest_angle,
        report.largest_angle,
        report.volume,
        repaired + tree + walls + filled
    ))
}
