//! Bakes the built-in shapes and prints what each bake reports.

use frangible::Material;
use frangible_bake::{BakeSpec, Shape, bake};

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
    for (name, shape) in shapes {
        let volume = shape.volume()?;
        match bake(
            &BakeSpec::new(name, shape, Material::preset("glass")?),
            &mut |_| {},
        ) {
            Ok((_, report)) => println!("{name}: exact volume {volume:.4e} m³\n{report:#?}"),
            Err(error) => println!("{name}: {error}"),
        }
    }
    Ok(())
}
