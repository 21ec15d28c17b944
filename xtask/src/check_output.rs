//! Checks the files of a run of the program: the report adds up, the animation is a whole file, the picture is not empty.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::command::{Result, read};
use crate::glb;

/// Fragments tile the body; the report's sums come from f32 meshes, hence not closer.
const TOLERANCE: f64 = 1e-5;
/// A run that shows the program off breaks something into more pieces than this.
const FEW_FRAGMENTS: u64 = 3;

/// A picture of bodies in light has more colours than this, an empty one with its labels fewer.
const FEW_COLOURS: usize = 150;

/// Checks `report.json` and every `*.glb` and `*.png` in the folder.
pub(crate) fn check_output(folder: &Path) -> Result {
    let report = folder.join("report.json");
    let text = read(&report)?;
    let report: Value = serde_json::from_slice(&text)
        .map_err(|error| format!("`{}` is not JSON: {error}", report.display()))?;
    let fragments = check_report(&report)?;
    for path in files(folder, "glb")? {
        let bytes = read(&path)?;
        let contents =
            glb::parse(&bytes).map_err(|problem| format!("`{}` {problem}", path.display()))?;
        if (contents.nodes as u64) < fragments {
            return Err(format!(
                "`{}` holds {} nodes, fewer than the {fragments} fragments of the report",
                path.display(),
                contents.nodes
            ));
        }
        println!(
            "{}: {} meshes, {} nodes, {} animations",
            path.display(),
            contents.meshes,
            contents.nodes,
            contents.animations
        );
    }
    for path in files(folder, "png")? {
        shows_something(&read(&path)?)
            .map_err(|problem| format!("`{}` {problem}", path.display()))?;
        println!("{}: shows something", path.display());
    }
    Ok(())
}

/// An error if the picture cannot be read, or has few colours.
fn shows_something(png: &[u8]) -> Result {
    let damaged = |error| format!("is not a complete picture: {error}");
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .map_err(damaged)?;
    let bytes = reader.output_buffer_size().ok_or("is too large")?;
    let mut pixels = vec![0; bytes];
    reader.next_frame(&mut pixels).map_err(damaged)?;
    let pixel = reader.info().bytes_per_pixel();
    let colours: BTreeSet<&[u8]> = pixels.chunks_exact(pixel).collect();
    match colours.len() {
        0..=FEW_COLOURS => Err(format!("shows nothing: it has {} colours", colours.len())),
        _ => Ok(()),
    }
}

/// Number of fragments, if the report is sound.
fn check_report(report: &Value) -> Result<u64> {
    let fragments = report["fragments"]
        .as_u64()
        .ok_or("`fragments` is missing in the report or not a whole number")?;
    if fragments <= FEW_FRAGMENTS {
        return Err(format!(
            "the report counts {fragments} fragments, expected more than {FEW_FRAGMENTS}"
        ));
    }
    for (total, sum) in [
        ("mass_kg", "fragment_mass_sum_kg"),
        ("volume_m3", "fragment_volume_sum_m3"),
    ] {
        let number = |name: &str| {
            let value = report[name]
                .as_f64()
                .filter(|value| value.is_finite() && *value > 0.0);
            value.ok_or_else(|| {
                format!(
                    "the report's `{name}` is {}, expected a number above zero",
                    report[name]
                )
            })
        };
        let (whole, parts) = (number(total)?, number(sum)?);
        if (parts - whole).abs() > TOLERANCE * whole {
            return Err(format!(
                "the report's `{sum}` {parts} differs from `{total}` {whole} by {:.1e} of it, more than {TOLERANCE:.0e}",
                (parts / whole - 1.0).abs()
            ));
        }
    }
    println!("report: {fragments} fragments, masses and volumes add up");
    Ok(fragments)
}

/// The files of this ending, of which there must be some.
fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>> {
    let entries = folder
        .read_dir()
        .map_err(|error| format!("`{}` cannot be listed: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == ending)
        })
        .collect();
    paths.sort();
    match paths.is_empty() {
        true => Err(format!(
            "`{}` contains no .{ending} file; did the run use `--out`?",
            folder.display()
        )),
        false => Ok(paths),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(fragments: u64, mass_sum: f64) -> Value {
        serde_json::json!({
            "fragments": fragments, "mass_kg": 0.2, "fragment_mass_sum_kg": mass_sum,
            "volume_m3": 8e-5, "fragment_volume_sum_m3": 8e-5,
        })
    }

    #[test]
    fn a_sound_report_passes() {
        assert_eq!(check_report(&report(17, 0.2 * (1.0 + 5e-6))), Ok(17));
    }

    #[test]
    fn lost_mass_few_fragments_and_missing_numbers_are_refused() {
        assert!(check_report(&report(17, 0.19)).is_err());
        assert!(check_report(&report(3, 0.2)).is_err());
        assert!(check_report(&report(17, f64::NAN)).is_err());
        assert!(check_report(&serde_json::json!({"fragments": 9})).is_err());
    }

    #[test]
    fn a_picture_of_one_colour_is_refused() {
        let picture = |pixels: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, 256, 2);
            encoder.set_color(png::ColorType::Rgb);
            let mut writer = encoder.write_header().unwrap();
            writer.write_image_data(pixels).unwrap();
            writer.finish().unwrap();
            bytes
        };
        let many: Vec<u8> = (0..256 * 2 * 3).map(|i| (i / 3) as u8).collect();
        assert_eq!(shows_something(&picture(&many)), Ok(()));
        assert!(shows_something(&picture(&[9; 256 * 2 * 3])).is_err());
        let whole = picture(&many);
        assert!(shows_something(&whole[..whole.len() / 2]).is_err());
    }
}
