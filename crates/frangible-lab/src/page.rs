//! Quotations of data in pages.
//!
//! A page says which file a number comes from in a comment, followed by the quotation and `<!-- end -->`. Within a line:
//!
//! ```text
//! <!-- from near-field: {commit} -->17b0acf4<!-- end -->
//! ```
//!
//! A table, whose last line is the pattern of each element of a list:
//!
//! ```text
//! <!-- from near-field /measured/residual:
//! | body | with | without |
//! |---|---:|---:|
//! | {name} | {with:.3} | {without*100:.1} % |
//! -->
//! …
//! <!-- end -->
//! ```
//!
//! In braces stands the path of a value (`points.0.1`), a factor if there is one, and a format: `.3` for three decimals, `3` for three significant digits.
//! A value that is null, or below one that is, is shown as a dash.

use std::path::Path;

use serde_json::Value;

use crate::{Result, data};

const BEGIN: &str = "<!-- from ";
const CLOSE: &str = "-->";
const END: &str = "<!-- end -->";

/// The page with every quotation taken anew from the data in the folder of the pages.
///
/// # Errors
/// A quotation that is not closed, or that names data that does not exist.
pub fn filled(page: &str, docs: &Path) -> Result<String> {
    let (mut text, mut rest) = (String::new(), page);
    while let Some(at) = rest.find(BEGIN) {
        let (before, after) = rest.split_at(at);
        let comment = after.find(CLOSE).map(|at| after.split_at(at + CLOSE.len()));
        let (comment, after) = comment.ok_or("a comment that begins a quotation is not closed")?;
        let end = after.find(END);
        let end = end.ok_or_else(|| format!("no `{END}` follows `{comment}`"))?;
        let about = comment[BEGIN.len()..].trim_end_matches(CLOSE);
        text.extend([before, comment]);
        text += &quoted(about, docs).map_err(|e| format!("`{comment}`: {e}"))?;
        rest = &after[end..];
    }
    Ok(text + rest)
}

fn quoted(about: &str, docs: &Path) -> Result<String> {
    let (source, pattern) = about.split_once(':').ok_or("`:` is missing")?;
    let (name, pointer) = source.split_once(' ').unwrap_or((source, ""));
    let data = data::read(docs, name)?;
    let value = data.pointer(pointer);
    let value = value.ok_or_else(|| format!("the data has no `{pointer}`"))?;
    let Some(lines) = pattern.strip_prefix('\n') else {
        return line(pattern.trim(), value);
    };
    let table = lines.trim_end().rsplit_once('\n');
    let (head, pattern) = table.ok_or("a table needs a heading, a rule and a pattern")?;
    let mut text = format!("\n{head}\n");
    let rows = value.as_array();
    for row in rows.ok_or_else(|| format!("`{pointer}` is not a list"))? {
        text += &line(pattern, row)?;
        text.push('\n');
    }
    Ok(text)
}

/// A pattern with its values in place of the braces.
fn line(pattern: &str, value: &Value) -> Result<String> {
    let (mut text, mut rest) = (String::new(), pattern);
    while let Some((before, after)) = rest.split_once('{') {
        let (about, after) = after.split_once('}').ok_or("`}` is missing")?;
        text += before;
        let (path, format) = about.split_once(':').unwrap_or((about, ""));
        let (path, factor) = path.split_once('*').unwrap_or((path, "1"));
        let found = at(value, path).ok_or_else(|| format!("there is no `{path}` in {value}"))?;
        text += &match found {
            Value::Null => "–".into(),
            Value::String(words) => words.replace('|', "\\|"),
            Value::Number(n) if n.is_f64() || factor != "1" => {
                let factor: f64 = factor.parse()?;
                number(factor * n.as_f64().unwrap_or(f64::NAN), format)?
            }
            other => other.to_string(),
        };
        rest = after;
    }
    Ok(text + rest)
}

/// The value at a path; below a null everything is null.
fn at<'a>(value: &'a Value, path: &str) -> Option<&'a Value> {
    path.split('.').try_fold(value, |value, key| match value {
        Value::Null => Some(value),
        Value::Array(items) => items.get(key.parse::<usize>().ok()?),
        _ => value.get(key),
    })
}

/// A number with decimals (`.3`) or significant digits (`3`); of the latter, trailing zeros go.
fn number(x: f64, format: &str) -> Result<String> {
    if let Some(decimals) = format.strip_prefix('.') {
        let decimals: usize = decimals.parse()?;
        return Ok(format!("{x:.decimals$}"));
    }
    let digits: usize = format.parse().unwrap_or(6);
    // The decade after rounding: 9.999996 is 10.
    let rounded = format!("{x:.*e}", digits.saturating_sub(1));
    let (mantissa, decade) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let decade: i32 = decade.parse()?;
    let short = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if !(-4..=7).contains(&decade) {
        return Ok(format!("{}e{decade}", short(mantissa)));
    }
    let decimals = (digits as i32 - 1 - decade).max(0) as usize;
    Ok(short(&format!("{x:.decimals$}")))
}

#[cfg(test)]
mod tests {
    use super::{filled, line, number};
    use serde_json::json;

    #[test]
    fn numbers_keep_their_digits() {
        let five = [5291.123, 0.0, 13.47, 9.999_996, 1.234_56e-7, 1_234_567.0];
        let shown = five.map(|x| number(x, "5").unwrap());
        assert_eq!(
            shown,
            ["5291.1", "0", "13.47", "10", "1.2346e-7", "1234567"]
        );
        assert_eq!(number(2.0 / 3.0, ".2").unwrap(), "0.67");
    }

    #[test]
    fn a_line_takes_paths_factors_and_formats() {
        let row = json!({ "name": "a|b", "of": [[1, 0.25]], "none": null, "n": 12 });
        let text = line("{name}: {of.0.1*100:.0} %, {none}, {n}", &row).unwrap();
        assert_eq!(text, "a\\|b: 25 %, –, 12");
        assert_eq!(line("{none.of.it:.1}", &row).unwrap(), "–");
        for missing in ["{missing}", "{of.0.7}", "{name.of}"] {
            assert!(line(missing, &row).is_err(), "{missing}");
        }
    }

    #[test]
    fn a_quotation_follows_its_data() {
        let docs = std::env::temp_dir().join(format!("frangible-lab-page-{}", std::process::id()));
        let data = json!({ "commit": "abc", "measured": { "rows": [{ "x": 1.5 }, { "x": 2.0 }] } });
        crate::data::write(&docs, "some", &data).unwrap();
        let page = "At <!-- from some: {commit} -->old<!-- end -->.\n\n\
            <!-- from some /measured/rows:\n| x |\n|---|\n| {x:.1} |\n-->\n| gone |\n<!-- end -->\n";
        let new = filled(page, &docs).unwrap();
        assert!(
            new.contains("-->abc<!--") && new.contains("| 1.5 |\n| 2.0 |\n<!-- end -->\n"),
            "{new}"
        );
        assert!(!new.contains("old") && !new.contains("gone"));
        assert_eq!(filled(&new, &docs).unwrap(), new);
        for wrong in [
            "<!-- from some: {commit} -->",
            "<!-- from other: {x} --><!-- end -->",
        ] {
            assert!(filled(wrong, &docs).is_err(), "{wrong}");
        }
        std::fs::remove_dir_all(&docs).unwrap();
    }
}
