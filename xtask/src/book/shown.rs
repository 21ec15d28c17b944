//! Compares the output that a page shows below its commands with the output that they print.

use super::page::{Block, Page};
use crate::command::Result;

/// Number of a failed command's last lines that are reported.
const TOLD: usize = 25;

/// A command, and the output below it on the page.
pub(super) struct Shown<'a> {
    pub(super) line: usize,
    pub(super) command: &'a str,
    pub(super) output: Vec<(usize, &'a str)>,
}

/// The commands of a block, each with the lines below it.
pub(super) fn commands<'a>(block: &'a Block<'_>) -> Vec<Shown<'a>> {
    let mut all: Vec<Shown<'a>> = Vec::new();
    for (number, line) in block.lines {
        if let Some(command) = line.strip_prefix("$ ") {
            all.push(Shown {
                line: *number,
                command,
                output: Vec::new(),
            });
        } else if let Some(last) = all.last_mut() {
            last.output.push((*number, line));
        }
    }
    all
}

/// Fails where the page shows another output than the one that was printed.
pub(super) fn compare(page: &Page, block: &Block<'_>, shown: &Shown<'_>, printed: &str) -> Result {
    let missing = match block.is("whole") {
        true => differs(&shown.output, printed),
        false => absent(&shown.output, printed),
    };
    let Some(index) = missing else { return Ok(()) };
    let end = (shown.line, "");
    let (number, line) = shown.output.get(index).unwrap_or(&end);
    let advice = match block.is("whole") {
        true => "; `cargo xtask book --write` updates it",
        false => "",
    };
    Err(format!(
        "{}:{number}: `{}` does not print `{line}` here{advice}; it printed\n{}",
        page.path,
        shown.command,
        last_of(printed)
    ))
}

/// The first line that does not occur in the printed output, behind the lines before it.
fn absent(wanted: &[(usize, &str)], printed: &str) -> Option<usize> {
    let mut lines = printed.lines();
    wanted
        .iter()
        .position(|(_, pattern)| *pattern != "…" && !lines.any(|line| fits(pattern, line)))
}

/// Returns true if a line has all parts of a pattern between its `…`, in their order.
fn fits(pattern: &str, line: &str) -> bool {
    let mut rest = line;
    pattern.trim().split('…').all(|part| match rest.find(part) {
        Some(at) => {
            rest = &rest[at + part.len()..];
            true
        }
        None => false,
    })
}

/// The first line that is another than the one that was printed.
fn differs(wanted: &[(usize, &str)], printed: &str) -> Option<usize> {
    let printed: Vec<&str> = whole(printed);
    let count = wanted.len().max(printed.len());
    (0..count).find(|&k| wanted.get(k).map(|(_, line)| line.trim_end()) != printed.get(k).copied())
}

/// The lines of an output, as far as they are compared.
pub(super) fn whole(printed: &str) -> Vec<&str> {
    printed.trim_end().lines().map(str::trim_end).collect()
}

/// The end of an output.
pub(super) fn last_of(printed: &str) -> String {
    let lines: Vec<&str> = printed.lines().collect();
    lines[lines.len().saturating_sub(TOLD)..].join("\n")
}

#[cfg(test)]
mod tests {
    use super::{absent, differs};

    const PRINTED: &str = "scene   pane\nfragments  12 (largest 3 g)\nwrote out/pane.glb\n";

    #[test]
    fn the_snippet_of_the_readme_is_a_doctest() {
        let readme = include_str!("../../../README.md");
        let (_, rest) = readme.split_once("```rust\n").expect("a snippet");
        let (snippet, _) = rest.split_once("```").expect("its end");
        let tested = include_str!("../../../crates/frangible-bake/src/lib.rs");
        let tested = tested.lines().filter_map(|line| line.strip_prefix("//!"));
        let tested: Vec<&str> = tested.map(str::trim).collect();
        let untested = snippet.lines().find(|line| !tested.contains(&line.trim()));
        assert_eq!(untested, None);
    }

    #[test]
    fn shown_lines_occur_in_their_order() {
        assert_eq!(
            absent(&[(1, "scene   pane"), (2, "…"), (3, "wrote …glb")], PRINTED),
            None
        );
        assert_eq!(absent(&[(1, "fragments … (largest … g)")], PRINTED), None);
        assert_eq!(
            absent(&[(1, "wrote out/pane.glb"), (2, "scene   pane")], PRINTED),
            Some(1)
        );
        assert_eq!(absent(&[(1, "fragments … (smallest")], PRINTED), Some(0));
    }

    #[test]
    fn a_whole_output_has_no_line_more_or_less() {
        assert_eq!(differs(&[(1, "a"), (2, "b")], "a\nb \n\n"), None);
        assert_eq!(differs(&[(1, "a")], "a\nb\n"), Some(1));
        assert_eq!(differs(&[(1, "a"), (2, "b")], "a\n"), Some(1));
    }
}
