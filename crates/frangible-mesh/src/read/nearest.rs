//! “Did you mean …?” for file names.

use std::path::Path;

/// A longer name, or one of more neighbours than [`MOST_NEIGHBOURS`], gets no suggestion, characters.
const LONGEST_NAME: usize = 64;

/// How many names of a folder are looked at.
const MOST_NEIGHBOURS: usize = 10_000;

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
    names
        .into_iter()
        .map(|name| (edit_distance(wanted, &name), name))
        .min_by_key(|&(distance, _)| distance)
        .filter(|(distance, _)| 3 * distance <= wanted.chars().count())
        .map(|(_, name)| name)
}

/// Insertions, deletions and replacements of single characters, whatever their case.
fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.to_lowercase().chars().collect();
    let b: Vec<char> = b.to_lowercase().chars().collect();
    if a.len().max(b.len()) > LONGEST_NAME {
        return usize::MAX / 4;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::edit_distance;

    #[test]
    fn edits_are_counted_whatever_the_case() {
        assert_eq!(edit_distance("bunny.obj", "Bunny.OBJ"), 0);
        assert_eq!(edit_distance("buny.obj", "bunny.obj"), 1);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }
}
