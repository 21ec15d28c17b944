//! Results of the cases, as text.

use std::fmt::Write;

use crate::verify::case::{Case, Findings};
use crate::verify::check::Check;

/// Errors below this are rounding, which differs from machine to machine.
const ROUNDING: f64 = 1e-9;

/// A number to five digits, as the tables show it; trailing zeros go.
#[must_use]
pub fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".into() } else { x.to_string() };
    }
    // The decade after rounding to five digits: 9.99999 is 10.
    let rounded = format!("{x:.4e}");
    let Some((mantissa, exponent)) = rounded.split_once('e') else {
        return rounded;
    };
    let decade: i32 = exponent.parse().unwrap_or(0);
    if !(-4..=7).contains(&decade) {
        let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
        return format!("{mantissa}e{decade}");
    }
    let text = format!("{x:.*}", (4 - decade).max(0) as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

/// A share in per cent to two digits; rounding errors as such.
#[must_use]
pub fn error(check: &Check) -> String {
    let error = check.error();
    if error.is_nan() {
        return "–".into();
    }
    if error == 0.0 {
        return "0".into();
    }
    if error < ROUNDING {
        return "< 1e-9".into();
    }
    in_kind(check, error)
}

/// The tolerance in the same form as the error.
#[must_use]
pub fn tolerance(check: &Check) -> String {
    if check.tolerance == 0.0 {
        "0".into()
    } else {
        in_kind(check, check.tolerance)
    }
}

/// Formats an error in per cent if the tolerance is relative and 0.01 % or more, else as it is.
fn in_kind(check: &Check, error: f64) -> String {
    let decade = error.log10().floor();
    if check.reference != 0.0 && check.tolerance >= 0.99e-4 {
        let decimals = (-1.0 - decade).max(0.0) as usize;
        let text = format!("{:.decimals$}", 100.0 * error);
        let short = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        format!("{short} %")
    } else if check.reference == 0.0 && error >= 1e-3 {
        number((error * 100.0).round() / 100.0)
    } else {
        // Mere orders of magnitude: the digits are rounding.
        format!("{error:.0e}")
    }
}

/// The value of a check, without digits that are only rounding.
#[must_use]
pub fn value(check: &Check) -> String {
    if check.reference == 0.0 {
        return error(check);
    }
    if check.error() < ROUNDING {
        return number(check.reference);
    }
    number(check.value)
}

/// Number and unit.
#[must_use]
pub fn with_unit(number: String, unit: &str) -> String {
    if unit.is_empty() {
        number
    } else {
        format!("{number} {unit}")
    }
}

/// "pass" or "FAIL".
#[must_use]
pub fn verdict(check: &Check) -> &'static str {
    if check.passes() { "pass" } else { "FAIL" }
}

/// The report as a page: every case with its explanation, its table and its plots (`FOLDER/NAME.png`). Without
/// timings, so that the same build writes the same page.
#[must_use]
pub fn markdown(found: &[(&Case, Findings)], folder: &str) -> String {
    let checks = || found.iter().flat_map(|(_, f)| &f.checks);
    let passed = checks().filter(|c| c.passes()).count();
    let mut text = format!(
        "# Verification\n\nWritten by `frangible-lab verify --write docs`, which computes it anew; `cargo test -p frangible-lab` \
         holds this page to it.\nEach value was computed by the code that bakes and breaks, each reference by other means. The error is \
         relative to the reference, or absolute where that is 0.\nHow cracks and pieces compare with published experiments is told \
         in [experiments.md](experiments.md).\n\n**{passed} of {} checks pass.**\n",
        checks().count()
    );
    for (case, findings) in found {
        let _ = write!(
            text,
            "\n## {}\n\n{}\n\n| case | reference | value | error | tolerance | | source |\n|---|---:|---:|---:|---:|---|---:|\n",
            case.title, case.about
        );
        let mut sources: Vec<&str> = Vec::new();
        for check in &findings.checks {
            if !sources.contains(&check.source) {
                sources.push(check.source);
            }
            let source = sources.iter().position(|s| *s == check.source);
            let cells = [
                check.name.replace('|', "\\|"),
                with_unit(number(check.reference), check.unit),
                with_unit(value(check), check.unit),
                error(check),
                tolerance(check),
                verdict(check).into(),
                source.map_or_else(String::new, |i| (i + 1).to_string()),
            ];
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
        text.push_str("\nReferences:\n\n");
        for (i, source) in sources.iter().enumerate() {
            let _ = writeln!(text, "{}. {source}", i + 1);
        }
        for plot in &findings.plots {
            let _ = write!(
                text,
                "\n![{}]({folder}/{}.png)\n\n{}\n",
                plot.chart.title, plot.name, plot.caption
            );
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{error, number, tolerance, value};
    use crate::verify::check;

    #[test]
    fn numbers_have_five_digits() {
        let shown = [
            5291.123,
            0.0,
            13.47,
            9.999_996,
            1.234_56e-7,
            828.0,
            1_234_567.0,
        ]
        .map(number);
        assert_eq!(
            shown,
            ["5291.1", "0", "13.47", "10", "1.2346e-7", "828", "1234567"]
        );
    }

    #[test]
    fn errors_say_what_they_are_relative_to() {
        let check =
            |value, reference, tolerance| check::number("", value, reference, tolerance, "");
        let relative = check(1.012, 1.0, 0.015);
        assert_eq!(error(&relative), "1.2 %");
        assert_eq!(tolerance(&relative), "1.5 %");
        let absolute = check(0.12, 0.0, 1.0);
        assert_eq!(
            (error(&absolute), tolerance(&absolute)),
            ("0.12".into(), "1".into())
        );
        let rounding = check(1.0 + 1e-14, 1.0, 1e-8);
        assert_eq!(error(&rounding), "< 1e-9");
        assert_eq!(value(&rounding), "1");
        assert_eq!(tolerance(&rounding), "1e-8");
        let none = check(f64::NAN, 1.0, 1.0);
        assert!(!none.passes());
        assert_eq!(error(&none), "–");
    }
}
