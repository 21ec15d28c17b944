//! Prints the numbers of all materials, and where they come from: `cargo run --release -p frangible --example materials`.

use frangible::Material;

/// Lines of text are at most so long, characters.
const WIDTH: usize = 110;

fn main() {
    println!(
        "name                     E, GPa     ν   density  strength     K_Ic      G_c  crushed at  splits at"
    );
    println!(
        "                                         kg/m³       MPa    MPa√m     J/m²         MPa  σ√r/K_Ic"
    );
    for preset in Material::presets() {
        let m = preset.material();
        let toughness = match preset.fracture_toughness {
            0.0 => "–".to_owned(),
            known => format!("{:.3}", 1e-6 * known),
        };
        let crushed = match m.crushing_pressure {
            f64::INFINITY => "–".to_owned(),
            known => format!("{:.0}", 1e-6 * known),
        };
        println!(
            "{:23} {:7.3} {:5.2} {:9.0} {:9.2} {toughness:>8} {:8.1} {crushed:>11} {:10.2}",
            m.name,
            1e-9 * m.youngs_modulus,
            m.poisson_ratio,
            m.density,
            1e-6 * m.strength,
            m.fracture_energy,
            m.branching_constant
        );
    }
    for preset in Material::presets() {
        println!("\n{}", preset.name);
        let mut line = String::new();
        for word in preset.source.split_whitespace() {
            if line.chars().count() + 1 + word.chars().count() > WIDTH {
                println!(" {line}");
                line.clear();
            }
            line = line + " " + word;
        }
        println!(" {line}");
    }
}
