//! Checks of the names of scenes and files.

use super::quantity::quantity;
use super::{Fault, LONGEST_NAME};
use crate::output::Output;

/// Most seeds on a sheet.
const MOST_SEEDS: usize = 36;

pub(super) fn check_output(output: &Output, scene: &str) -> Result<(), Fault> {
    if !(1..=MOST_SEEDS).contains(&output.seeds) {
        return Err(quantity(
            "output.seeds",
            "the number of seeds",
            output.seeds,
            "1 to 36",
        ));
    }
    let keys = [
        "output.glb",
        "output.wav",
        "output.picture",
        "output.contact_sheet",
        "output.json",
    ];
    let names = output.file_names(scene);
    for (i, (key, name)) in keys.into_iter().zip(&names).enumerate() {
        let Some(name) = name else { continue };
        file_name(key, "the name of a file", name)?;
        if names[..i].contains(&Some(name.clone())) {
            let must = "different from the other files'";
            return Err(quantity(
                key,
                "the name of a file",
                format!("`{name}`"),
                must,
            ));
        }
    }
    Ok(())
}

/// A name that cannot leave the output folder, on any system.
pub(super) fn file_name(key: &'static str, what: &'static str, name: &str) -> Result<(), Fault> {
    let blank = name.trim() != name || name.is_empty();
    if blank || name.starts_with('.') || name.len() > LONGEST_NAME || name.contains(is_odd) {
        let shown: String = name.chars().take(LONGEST_NAME).collect();
        let must = "a plain file name without folders, leading dots or special characters";
        return Err(quantity(
            key,
            what,
            format!("`{}`", shown.escape_debug()),
            must,
        ));
    }
    Ok(())
}

/// Characters that no file name may hold on some system.
fn is_odd(c: char) -> bool {
    c.is_control() || r#"/\:*?"<>|"#.contains(c)
}

/// The nearest name that a scene and its files may have.
#[must_use]
pub fn tame(name: &str) -> String {
    let mut tame = String::new();
    for c in name.chars() {
        let in_front = tame.is_empty() && (c == '.' || c.is_whitespace());
        if tame.len() + c.len_utf8() <= LONGEST_NAME && !in_front {
            tame.push(if is_odd(c) { '_' } else { c });
        }
    }
    let tame = tame.trim_end();
    if tame.is_empty() {
        "body".into()
    } else {
        tame.into()
    }
}
