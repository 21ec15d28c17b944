//! Breaks the bodies that the package's test breaks. Writes the hashes of all numbers of the pieces, which the test compares with its own, and the
//! time that it took.

use std::path::Path;

use frangible::{Asset, Breakable, FractureConfig, Outcome, impact};
use frangible_js::drawn::Drawn;
use frangible_js::plain;

/// File, and the contact that the test describes in its own words.
fn blows() -> [(&'static str, [f64; plain::CONTACT]); 2] {
    let steel = frangible::Material::preset("steel").expect("it is built in");
    let (modulus, bounce) = (steel.contact_modulus(), steel.restitution);
    let radius = (0.13 / steel.density * 0.75 / std::f64::consts::PI).cbrt();
    let surface = [modulus, steel.crushing_pressure, bounce];
    let ball = [1.0 / 0.13, radius];
    let block = [0.0, f64::INFINITY];
    let row = |place: [f64; 7], striker: [f64; 2]| {
        let numbers = [&place[..], &striker, &surface, &[0.0; 4]].concat();
        std::array::from_fn(|i| numbers[i])
    };
    [
        ("pane", row([0.0, 0.0, 0.002, 0.0, 0.0, -1.0, 12.0], ball)),
        (
            "block",
            row([0.105, 0.05, -0.025, -0.105, -0.05, 0.025, 20.0], block),
        ),
    ]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bodies = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/frangible/tests/bodies");
    let mut lines = Vec::new();
    for (name, row) in blows() {
        let asset = Asset::load(bodies.join(format!("{name}.frangible")))?;
        let kind = Breakable::new(asset)?;
        // The third outcome, as in the test: a body's first break computes data that its later ones reuse.
        let mut outcome = None;
        for _ in 0..3 {
            let body = kind.body(3);
            let broken = impact(&body, &plain::contacts(&row), &FractureConfig::default())?;
            outcome = Some(broken);
        }
        let Some(Outcome::Broke(fracture)) = outcome else {
            return Err(format!("{name} held").into());
        };
        let mut bytes: Vec<u8> = Vec::new();
        for fragment in &fracture.fragments {
            let drawn = Drawn::fragment(kind.asset(), fragment);
            bytes.extend(drawn.positions.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend(drawn.indices.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend(fragment.mass.mass.to_le_bytes());
        }
        // FNV-1a, which both languages have in a line.
        let hash = bytes.iter().fold(0x811c_9dc5_u32, |hash, &byte| {
            (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
        });
        let bytes = bytes.len();
        let pieces = fracture.fragments.len();
        let seconds = fracture.report.timings.total();
        lines.push(format!(
            "  \"{name}\": {{ \"pieces\": {pieces}, \"bytes\": {bytes}, \"hash\": \"{hash:08x}\", \"seconds\": {seconds:.6} }}"
        ));
    }
    let text = format!("{{\n{}\n}}\n", lines.join(",\n"));
    match std::env::var_os("OUT") {
        Some(path) => std::fs::write(path, text)?,
        None => print!("{text}"),
    }
    Ok(())
}
