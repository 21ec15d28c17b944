//! Checks that the targets of the pages' links exist: files, chapters, headings.

use std::collections::{BTreeMap, BTreeSet};

use super::page::{Page, beside};
use crate::command::{Result, root};

/// Checks the links of all pages, and returns the files other than pages that they link.
pub(super) fn check(pages: &[Page]) -> Result<BTreeSet<String>> {
    let headings: BTreeMap<&str, BTreeSet<String>> = pages
        .iter()
        .map(|page| (page.path.as_str(), headings(page)))
        .collect();
    let (mut files, mut faults) = (BTreeSet::new(), Vec::new());
    for page in pages {
        for (line, target) in links(page) {
            if target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            let (way, heading) = target.split_once('#').unwrap_or((&target, ""));
            let file = match way {
                "" => page.path.clone(),
                way => beside(&page.path, way),
            };
            let fault = match headings.get(file.as_str()) {
                Some(known) if heading.is_empty() || known.contains(heading) => None,
                Some(_) => Some(format!("`{file}` has no heading `#{heading}`")),
                None if !root().join(&file).exists() => Some(format!("there is no `{file}`")),
                None if file.ends_with(".md") => Some(format!(
                    "`{file}` is not a chapter; add it to book/src/SUMMARY.md"
                )),
                None => {
                    files.insert(file);
                    None
                }
            };
            faults.extend(fault.map(|fault| format!("{}:{line}: {fault}", page.path)));
        }
    }
    match faults.is_empty() {
        true => Ok(files),
        false => Err(format!("broken links:\n{}", faults.join("\n"))),
    }
}

/// The targets of a page's links and pictures, with the lines in which they stand.
fn links(page: &Page) -> Vec<(usize, String)> {
    let mut links = Vec::new();
    for (number, line) in prose(page) {
        // Text between backticks is code.
        let words: String = line.split('`').step_by(2).collect::<Vec<_>>().join("code");
        for part in words.split("](").skip(1) {
            let target = part.split(')').next().unwrap_or("");
            links.push((number, target.to_owned()));
        }
    }
    links
}

/// The names by which a page's headings are linked: in lower case, with hyphens for spaces, without punctuation.
fn headings(page: &Page) -> BTreeSet<String> {
    let titles = prose(page).filter(|(_, line)| line.starts_with('#'));
    titles
        .map(|(_, line)| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter_map(|c| match c {
                ' ' => Some('-'),
                c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
                _ => None,
            });
            kept.collect()
        })
        .collect()
}

/// The lines outside fenced blocks.
fn prose(page: &Page) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    page.lines.iter().filter_map(move |(number, line)| {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
            return None;
        }
        (!fenced).then_some((*number, line.as_str()))
    })
}
