//! Checks that outputs can be written, before long computations.

use std::fs;
use std::path::Path;

/// Creates the output folder, and checks that it is writable and that no folder has the name of an output file. Returns true if the folder already
/// existed. `option` is the command-line option for another folder, for the messages.
///
/// # Errors
/// A message for the user of the command line.
pub fn make_folder(folder: &Path, names: &[String], option: &str) -> Result<bool, String> {
    let was_there = folder.exists();
    let wrong = |e: std::io::Error| {
        format!(
            "cannot write to the folder `{}`: {e}; choose another with {option} DIR",
            folder.display()
        )
    };
    let file = folder
        .ancestors()
        .find(|part| part.exists() && !part.is_dir());
    if let Some(file) = file {
        return Err(format!(
            "{option} is `{}`, but `{}` is not a folder; choose another with {option} DIR",
            folder.display(),
            file.display()
        ));
    }
    fs::create_dir_all(folder).map_err(wrong)?;
    probe(folder).map_err(wrong)?;
    for name in names {
        let path = folder.join(name);
        if path.is_dir() {
            return Err(format!(
                "`{}` is a folder, but a file of that name has to be written; move the folder, or choose another {option} DIR",
                path.display()
            ));
        }
    }
    Ok(was_there)
}

/// Checks that a file with this path can be written.
///
/// # Errors
/// A message for the user of the command line.
pub fn try_file(path: &Path) -> Result<(), String> {
    if path.is_dir() {
        return Err(format!(
            "`{}` is a folder; give the name of a file with -o",
            path.display()
        ));
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    probe(folder).map_err(|e| {
        format!(
            "cannot write `{}`: {e}; choose another place with -o FILE",
            path.display()
        )
    })
}

fn probe(folder: &Path) -> std::io::Result<()> {
    // Named as an unfinished file is, should the program be killed here.
    let probe = folder.join(format!(".frangible-{}.part", std::process::id()));
    fs::write(&probe, b"")?;
    fs::remove_file(&probe)
}
