//! Cost of keeping modes, in seconds and MB, and the number of them that a blow follows.
//!
//! `cargo run --release -p frangible-bake --example modes_kept [MODES …]`

use frangible::Material;
use frangible_bake::{BakeSpec, Baked, Shape, bake_with};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<usize> = std::env::args()
        .skip(1)
        .map(|a| a.parse())
        .collect::<Result<_, _>>()?;
    let counts = if asked.is_empty() {
        vec![120, 200, 400]
    } else {
        asked
    };
    let bodies = [
        ("glass", Shape::drinking_glass(), "glass"),
        ("pane", Shape::plate(0.4, 0.4, 0.004), "glass"),
        ("plate", Shape::dinner_plate(), "porcelain"),
        ("bowl", Shape::bowl(), "porcelain"),
        ("vase", Shape::vase(), "porcelain"),
        ("brick", Shape::block([0.21, 0.1, 0.05]), "brick"),
    ];
    println!(
        "| body | kept | followed | top of kept, kHz | top of followed, kHz | modes, s | choice, s | bake, s | file, MB |"
    );
    println!("|---|---:|---:|---:|---:|---:|---:|---:|---:|");
    for (name, shape, material) in bodies {
        for &modes in &counts {
            let spec = BakeSpec {
                modes,
                ..BakeSpec::new(name, shape.clone(), Material::preset(material)?)
            };
            let Baked { asset, report } = bake_with(&spec, |_| {})?;
            let of = |stage: &str| -> f64 {
                let found = report.seconds.iter().find(|(s, _)| s.to_string() == stage);
                found.map_or(0.0, |s| s.1)
            };
            let whole: f64 = report.seconds.iter().map(|s| s.1).sum();
            println!(
                "| {name} | {modes} | {} | {:.1} | {:.1} | {:.2} | {:.2} | {whole:.2} | {:.1} |",
                report.followed,
                1e-3 * asset.modes().frequency(modes - 1),
                1e-3 * asset.modes().frequency(report.followed - 1),
                of("finding modes"),
                of("modes to follow"),
                1e-6 * asset.to_bytes().len() as f64
            );
        }
    }
    Ok(())
}
