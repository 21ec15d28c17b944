//! Checks what a run of the program wrote: the report adds up, the animation is a whole file.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::command::Result;
use crate::glb;

/// Fragments tile the body; the report's sums come from f32 meshes, hence not closer.
const TOLERANCE: f64 = 1e-5;
/// A run that shows the program off breaks something into more pieces than this.
const FEW_FRAGMENTS: u64 = 3;

/// Checks `report.json` and every `*.glb` in the folder.
pub(crate) fn check_output(folder: &Path) -> Result {
    let report = folder.join("report.json");
    let text = std::fs::read(&report).map_err(|error| {
        format!(
            "`{}` cannot be read: {error}; did the run have `--json`?",
            report.display()
        )
    })?;
    let report: Value = serde_json::from_slice(&text)
        .map_err(|error| format!("`{}` is no JSON: {error}", report.display()))?;
    let fragments = check_report(&report)?;
    let scenes = scenes(folder)?;
    if scenes.is_empty() {
        return Err(format!(
            "`{}` holds no .glb file; did the run have `--out`?",
            folder.display()
        ));
    }
    for path in scenes {
        let bytes = std::fs::read(&path)
            .map_err(|error| format!("`{}` cannot be read: {error}", path.display()))?;
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
    Ok(())
}

/// Number of fragments, if the report is sound.
fn check_report(report: &Value) -> Result<u64> {
    let fragments = report["fragments"]
        .as_u64()
        .ok_or("the report has no whole number `fragments`")?;
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

fn scenes(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = folder
        .read_dir()
        .map_err(|error| format!("`{}` cannot be listed: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "glb"));
    paths.sort();
    Ok(paths)
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
}
