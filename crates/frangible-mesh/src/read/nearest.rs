//! “Did you mean …?” for names, and for those of files.

use std::path::Path;

use strsim::levenshtein;

/// A name longer than this gets no suggestion, characters.
const LONGEST_NAME: usize = 48;

/// A file's name longer than this gets no suggestion, nor is one suggested, characters.
const LONGEST_FILE_NAME: usize = 64;

/// Largest number of names of a folder that are looked at.
const MOST_NEIGHBOURS: usize = 10_000;

/// The closest of the known names, if it takes fewer edits than half of the letters; the first of equals.
#[must_use]
pub fn nearest_name<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = wanted.chars().take(LONGEST_NAME + 1).count();
    if length > LONGEST_NAME {
        return None;
    }
    known
        .into_iter()
        .map(|name| (levenshtein(wanted, name), name))
        .min_by_key(|&(distance, _)| distance)
        .filter(|&(distance, _)| 2 * distance <= length)
        .map(|(_, name)| name)
}

/// “, did you mean …?” with the [nearest](nearest_name) of the known names, or nothing.
#[must_use]
pub fn did_you_mean<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest_name(wanted, known).map_or(String::new(), |name| format!(", did you mean `{name}`?"))
}

/// The name in the same folder that takes fewest edits, if that is at most a third of its letters.
#[must_use]
pub fn nearest_file(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_str()?;
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let mut names: Vec<String> = std::fs::read_dir(folder.unwrap_or(Path::new(".")))
        .ok()?
        .take(MOST_NEIGHBOURS)
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort_unstable();
    let (length, folded) = (wanted.chars().count(), wanted.to_lowercase());
    let short = |name: &str| name.chars().count() <= LONGEST_FILE_NAME;
    names
        .into_iter()
        .filter(|name| short(&folded) && short(name))
        .map(|name| (levenshtein(&folded, &name.to_lowercase()), name))
        .min_by_key(|&(distance, _)| distance)
        .filter(|(distance, _)| 3 * distance <= length)
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::nearest_name;

    #[test]
    fn a_name_like_no_other_gets_no_suggestion() {
        let known = ["glass", "porcelain", "pmma"];
        assert_eq!(nearest_name("porcelan", known), Some("porcelain"));
        assert_eq!(nearest_name("pma", known), Some("pmma"));
        for name in ["", "unobtainium", "\u{1F9CA}", &"x".repeat(100_000)] {
            assert_eq!(nearest_name(name, known), None, "{name:.20}");
        }
    }
}
