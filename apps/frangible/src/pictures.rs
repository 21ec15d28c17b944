//! Pictures of runs.

use std::error::Error;

use frangible_photo::{SheetOptions, contact_sheet, encode_png, sheet_of_frames};
use frangible_recording::Recording;
use frangible_scenes::Run;

/// File name and PNG bytes.
pub(crate) type Picture = (String, Vec<u8>);

/// Draws the four moments of the first run, and the ends of all of them, each under its file name if it has one.
pub(crate) fn draw(
    runs: &[(u64, Run)],
    moments: Option<&str>,
    seeds: Option<&str>,
) -> Result<Vec<Picture>, Box<dyn Error>> {
    let mut pictures = Vec::new();
    if let (Some(name), Some((_, first))) = (moments, runs.first()) {
        let sheet = contact_sheet(&first.recording, &SheetOptions::default())?;
        pictures.push((name.to_string(), encode_png(&sheet)?));
    }
    if let Some(name) = seeds {
        let labels: Vec<String> = runs
            .iter()
            .map(|(seed, run)| format!("seed {seed}: {}", pieces(run)))
            .collect();
        let cells: Vec<(&Recording, usize, &str)> = runs
            .iter()
            .zip(&labels)
            .map(|((_, run), label)| {
                (
                    &run.recording,
                    run.recording.moments.at_rest,
                    label.as_str(),
                )
            })
            .collect();
        let columns = (cells.len() as f64).sqrt().ceil() as u32;
        let options = SheetOptions {
            cell_width: 480,
            cell_height: 360,
            columns,
        };
        let sheet = sheet_of_frames(&cells, &options)?;
        pictures.push((name.to_string(), encode_png(&sheet)?));
    }
    Ok(pictures)
}

fn pieces(run: &Run) -> String {
    let pieces: usize = run.breaks.iter().map(|b| b.masses.len()).sum();
    if pieces == 0 {
        "held".into()
    } else {
        format!("{pieces} pieces")
    }
}
