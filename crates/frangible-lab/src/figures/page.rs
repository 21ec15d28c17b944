//! The page of all figures, Markdown.

use crate::figures::figure::{Claim, FIGURES, Figure, Findings, Table};
use crate::page::table_of_words;

/// Start of the part of a figure; the rest of the line is its title.
const HEADING: &str = "\n## ";

/// "agrees" or "does not agree".
#[must_use]
pub fn verdict(claim: &Claim) -> &'static str {
    if claim.holds {
        "agrees"
    } else {
        "**does not agree**"
    }
}

/// The part of one figure; its picture is `folder`/NAME.png.
#[must_use]
pub fn part(figure: &Figure, findings: &Findings, folder: &str) -> String {
    let mut text = format!(
        "{HEADING}{}\n\n![{}]({folder}/{}.png)\n\n*The paper:* {}\n\n{}\n",
        figure.title, findings.picture.caption, figure.name, figure.shows, findings.text
    );
    let mut claims = Table::new(["the paper says", "measured", ""]);
    for claim in &findings.claims {
        claims.row([
            claim.says.clone(),
            claim.measured.clone(),
            verdict(claim).into(),
        ]);
    }
    for table in std::iter::once(&claims).chain(&findings.tables) {
        if !table.rows.is_empty() {
            text.push('\n');
            text += &table_of_words(&table.heading, &table.rows);
        }
    }
    text
}

/// The whole page: these parts, and from an older page those of figures that were not made anew.
#[must_use]
pub fn page(parts: &[(&Figure, String)], older: &str) -> String {
    let mut bodies = String::new();
    for figure in FIGURES {
        match parts.iter().find(|(f, _)| f.name == figure.name) {
            Some((_, part)) => bodies.push_str(part),
            None => bodies.push_str(old_part(older, figure).unwrap_or("")),
        }
    }
    let count = |ending: &str| bodies.lines().filter(|line| line.ends_with(ending)).count();
    let (agree, not) = (count("| agrees |"), count("| **does not agree** |"));
    format!(
        "# The paper's figures, computed\n\nWritten by `frangible-lab figures --write docs`, pictures, numbers and verdicts alike. The figures \
         are those of Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE TVCG 2012. Its shapes, \
         sizes and speeds are not printed: these are ours; materials are its Table 1 where that has them.\n\"The paper's model\" is \
         `FractureConfig::as_in_the_paper()`, \"ours\" the default.\n\n**{agree} of {} claims agree.**\n{bodies}",
        agree + not
    )
}

/// The part of a figure in a page, without the text after it.
fn old_part<'a>(page: &'a str, figure: &Figure) -> Option<&'a str> {
    let start = page.find(&format!("{HEADING}{}\n", figure.title))?;
    let rest = &page[start + HEADING.len()..];
    let end = rest
        .find(HEADING)
        .map_or(page.len(), |i| start + HEADING.len() + i);
    Some(&page[start..end])
}
