//! Messages about faults of a scene file, in words, with their lines.

use frangible_mesh::nearest_name;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use crate::check::Fault;

/// Longest message taken over from the parser, characters: keys and texts of a file stand in it.
const LONGEST: usize = 400;

/// Line, from 1, and words for a mistake found while reading.
pub(super) fn parse_error(text: &str, error: &Error) -> (usize, String) {
    let line = error.span().map_or(1, |span| line_at(text, span.start));
    let message: String = error.message().chars().take(LONGEST).collect();
    (line, in_our_words(&message))
}

/// Serde lists what it expected; the nearest of these is what was meant.
fn in_our_words(message: &str) -> String {
    for (start, what) in [("unknown field `", "key"), ("unknown variant `", "name")] {
        let Some(rest) = message.strip_prefix(start) else {
            continue;
        };
        let Some((wrong, expected)) = rest.split_once('`') else {
            continue;
        };
        let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
        let hint = nearest_name(wrong, known.iter().copied()).map_or_else(
            || format!("; known here: {}", known.join(", ")),
            |name| format!(", did you mean `{name}`?"),
        );
        return format!("unknown {what} `{wrong}`{hint}");
    }
    [
        ("missing field", "missing key"),
        ("duplicate key", "this key occurs twice"),
        ("expected f64", "expected a number"),
        ("expected usize", "expected a whole number, zero or above"),
        ("expected u64", "expected a whole number, zero or above"),
        ("expected a boolean", "expected true or false"),
        ("expected a sequence", "expected a list in [ ]"),
        ("expected struct SceneTable", "expected a scene"),
        ("expected struct BodyTable", "expected a table"),
        ("expected struct ProjectileTable", "expected a table"),
        ("expected struct FractureTable", "expected a table"),
        ("expected struct OutputTable", "expected a table"),
        (
            "expected struct StationTable",
            "expected { outer = [r, z], inner = [r, z] }",
        ),
        (
            "wanted string or table",
            "expected a name in quotes or a table",
        ),
    ]
    .iter()
    .fold(message.replace('\n', " "), |text, (theirs, ours)| {
        text.replace(theirs, ours)
    })
}

/// Line, from 1, on which the key at fault stands, or else the table it should stand in.
pub(super) fn fault_line(text: &str, fault: &Fault) -> usize {
    let Ok(document) = DeTable::parse(text) else {
        return 1;
    };
    let mut table = document.get_ref();
    let mut offset = 0;
    if let Some((list, index)) = fault.item
        && let Some(item) = entry(table, list).and_then(|(_, list)| match list.get_ref() {
            DeValue::Array(items) => items.get(index),
            _ => None,
        })
    {
        offset = item.span().start;
        if let DeValue::Table(inner) = item.get_ref() {
            table = inner;
        }
    }
    for key in fault.key.split('.') {
        let Some((start, value)) = entry(table, key) else {
            break;
        };
        offset = start;
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => break,
        }
    }
    line_at(text, offset)
}

/// Start of a key in the text, and its value.
fn entry<'a, 'i>(
    table: &'a DeTable<'i>,
    wanted: &str,
) -> Option<(usize, &'a Spanned<DeValue<'i>>)> {
    table
        .iter()
        .find(|(key, _)| &**key.get_ref() == wanted)
        .map(|(key, value)| (key.span().start, value))
}

fn line_at(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|&b| b == b'\n').count()
}
