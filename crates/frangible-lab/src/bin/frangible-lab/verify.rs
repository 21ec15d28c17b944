//! `frangible-lab verify`: the physics against closed forms.

use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

use frangible_lab::verify::report::{
    error, markdown, number, tolerance, value, verdict, with_unit,
};
use frangible_lab::verify::{CASES, Case, Check, Findings};
use serde_json::json;

use crate::args::PageArgs;
use crate::output::{Bar, Page, say};

/// The page, and the folder of its plots.
const PAGE: &str = "verification.md";
const PLOTS: &str = "verification";
/// Size of a plot, pixels.
const SIZE: (u32, u32) = (800, 600);

/// A case that was computed, and the seconds it took.
type Computed = (&'static Case, Findings, f64);

pub(crate) fn run(args: &PageArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.write.as_deref(), PAGE, PLOTS)?;
    let bar = Bar::new(args.json);
    let mut found: Vec<Computed> = Vec::new();
    for (i, case) in CASES.iter().enumerate() {
        let clock = Instant::now();
        let show = |share: f64| {
            bar.show(case.title, (i as f64 + share) / CASES.len() as f64);
        };
        show(0.0);
        let findings = case.run(&mut |share| show(share))?;
        found.push((case, findings, clock.elapsed().as_secs_f64()));
    }
    drop(bar);
    let pages: Vec<(&Case, Findings)> = found.iter().map(|f| (f.0, f.1.clone())).collect();
    let mut plots = Vec::new();
    for plot in found.iter().flat_map(|f| &f.1.plots) {
        plots.push((plot.name.to_owned(), plot.png(SIZE.0, SIZE.1)?));
    }
    let files = place.write(&markdown(&pages, PLOTS), &plots)?;
    if args.json {
        say(&format!("{:#}\n", as_json(&found, &files)))?;
    } else {
        say(&table(&found, &files))?;
    }
    Ok(conclude(found.iter().flat_map(|f| &f.1.checks))?)
}

/// An error when a check failed.
fn conclude<'a>(checks: impl Iterator<Item = &'a Check>) -> Result<(), String> {
    let (mut all, mut failed) = (0, 0);
    for check in checks {
        all += 1;
        failed += usize::from(!check.passes());
    }
    if failed > 0 {
        return Err(format!("{failed} of {all} checks failed"));
    }
    Ok(())
}

fn table(found: &[Computed], files: &[String]) -> String {
    let rows = found.iter().flat_map(|f| &f.1.checks);
    let widest = |cell: fn(&Check) -> String| {
        let widths = rows.clone().map(|c| cell(c).chars().count());
        widths.max().unwrap_or(0)
    };
    let name = widest(|c| c.name.clone());
    let reference = widest(|c| with_unit(number(c.reference), c.unit)).max("reference".len());
    let computed = widest(|c| with_unit(value(c), c.unit)).max("value".len());
    let mut text = format!(
        "  {:name$}  {:>reference$}  {:>computed$}  {:>7}  {:>9}\n",
        "case", "reference", "value", "error", "tolerance"
    );
    for (case, findings, seconds) in found {
        let _ = writeln!(text, "{} ({seconds:.2} s)", case.title);
        for check in &findings.checks {
            let _ = writeln!(
                text,
                "  {:name$}  {:>reference$}  {:>computed$}  {:>7}  {:>9}  {}",
                check.name,
                with_unit(number(check.reference), check.unit),
                with_unit(value(check), check.unit),
                error(check),
                tolerance(check),
                verdict(check)
            );
        }
    }
    let checks = rows.clone().count();
    let passed = rows.clone().filter(|c| c.passes()).count();
    let seconds: f64 = found.iter().map(|f| f.2).sum();
    let _ = writeln!(text, "{passed} of {checks} checks pass ({seconds:.1} s)");
    for file in files {
        let _ = writeln!(text, "wrote {file}");
    }
    text
}

fn as_json(found: &[Computed], files: &[String]) -> serde_json::Value {
    let cases: Vec<serde_json::Value> = found
        .iter()
        .map(|(case, findings, seconds)| {
            let checks: Vec<serde_json::Value> = findings
                .checks
                .iter()
                .map(|check| {
                    json!({
                        "name": check.name,
                        "reference": check.reference,
                        "value": check.value,
                        "error": check.error(),
                        "tolerance": check.tolerance,
                        "unit": check.unit,
                        "source": check.source,
                        "pass": check.passes(),
                    })
                })
                .collect();
            json!({ "name": case.name, "title": case.title, "seconds": seconds, "checks": checks })
        })
        .collect();
    let pass = found.iter().flat_map(|f| &f.1.checks).all(Check::passes);
    json!({ "pass": pass, "cases": cases, "files": files })
}

#[cfg(test)]
mod tests {
    use super::{Check, conclude};

    #[test]
    fn one_check_that_fails_is_an_error() {
        let good = Check {
            name: "ten".into(),
            reference: 10.0,
            value: 10.001,
            tolerance: 1e-3,
            unit: "Hz",
            source: "",
        };
        let bad = Check {
            value: 10.1,
            ..good.clone()
        };
        assert_eq!(conclude([&good, &good].into_iter()), Ok(()));
        let said = conclude([&good, &bad].into_iter()).unwrap_err();
        assert_eq!(said, "1 of 2 checks failed");
    }
}
