//! Bakes the built-in shapes and prints what each bake reports.

use frangible::Material;
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let shapes = [
        ("glass", Shape::drinking_glass()),
        ("bowl", Shape::bowl()),
        ("vase", Shape::vase()),
        ("dinner plate", Shape::dinner_plate()),
        ("pane", Shape::plate(0.3, 0.3, 0.004)),
        ("rod", Shape::rod(0.25, 0.01)),
        ("block", Shape::block([0.1, 0.1, 0.1])),
    ];
    let mut specs = Vec::new();
    for (name, shape) in shapes {
        specs.push(BakeSpec::new(name, shape, Material::preset("glass")?));
    }
    // As fine as the finest slab of the paper: about 175 000 tetrahedra.
    let slab = Shape::plate(1.0, 1.0, 0.05);
    let mut fine = BakeSpec::new("very high slab", slab, Material::preset("glass")?);
    fine.fracture = Some(MeshSize {
        edge: 0.0126,
        layers: 4,
    });
    specs.push(fine);
    for spec in specs {
        let (name, volume) = (&spec.name, spec.shape.volume()?);
        match bake(&spec, &mut |_| {}) {
            Ok((_, report)) => println!("{name}: exact volume {volume:.4e} m³\n{report:#?}"),
            Err(error) => println!("{name}: {error}"),
        }
    }
    Ok(())
}
