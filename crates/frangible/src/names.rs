//! “Did you mean …?”

/// A name longer than this gets no suggestion, characters.
const LONGEST_NAME: usize = 48;

/// The closest of the known names, if it takes fewer edits than half of the letters; the first of equals.
#[must_use]
pub fn nearest_name<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = wanted.chars().take(LONGEST_NAME + 1).count();
    if length > LONGEST_NAME {
        return None;
    }
    known
        .into_iter()
        .map(|name| (edit_distance(wanted, name), name))
        .min_by_key(|&(distance, _)| distance)
        .filter(|&(distance, _)| 2 * distance <= length)
        .map(|(_, name)| name)
}

/// Levenshtein distance: insertions, deletions and replacements of single characters.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
