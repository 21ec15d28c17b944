//! A page: its lines with the included files, and its fenced blocks.

use std::path::{Component, Path, PathBuf};

use crate::command::{Result, read, root};

/// Folder of the book's own pages.
const OURS: &str = "book/src/";

/// A page of the book.
pub(super) struct Page {
    /// Path from the checkout's root, for example `book/src/limits.md`.
    pub(super) path: String,
    /// Each line with its number in the file; an included line has the number of the line that includes it.
    pub(super) lines: Vec<(usize, String)>,
    /// Included files, each with the line that includes it.
    included: Vec<(usize, String)>,
}

/// Lines between two fences of three backticks.
pub(super) struct Block<'a> {
    /// Number of its first fence in the file.
    pub(super) line: usize,
    pub(super) language: &'a str,
    /// Marks after the language, which commas separate.
    pub(super) marks: Vec<&'a str>,
    pub(super) lines: &'a [(usize, String)],
    /// The file that it includes.
    included: Option<&'a str>,
}

impl Page {
    /// Reads a page and the files that it includes.
    pub(super) fn read(path: &str) -> Result<Self> {
        let mut page = Self {
            path: path.to_owned(),
            lines: Vec::new(),
            included: Vec::new(),
        };
        for (number, line) in (1..).zip(text(path)?.lines()) {
            let wish = line.trim().strip_prefix("{{#include ");
            let Some(wish) = wish.and_then(|wish| wish.strip_suffix("}}")) else {
                page.lines.push((number, line.to_owned()));
                continue;
            };
            let (file, anchor) = match wish.split_once(':') {
                Some((file, anchor)) => (file, Some(anchor)),
                None => (wish, None),
            };
            let file = beside(path, file);
            let all = text(&file).map_err(|error| format!("{path}:{number}: {error}"))?;
            let lines = part(&all, anchor).ok_or_else(|| {
                format!(
                    "{path}:{number}: `{file}` has no line `ANCHOR: {}`",
                    anchor.unwrap_or("")
                )
            })?;
            page.lines
                .extend(lines.into_iter().map(|line| (number, line)));
            page.included.push((number, file));
        }
        Ok(page)
    }

    /// Returns true if the page is written for the book alone.
    pub(super) fn is_ours(&self) -> bool {
        self.path.starts_with(OURS)
    }

    /// Its fenced blocks.
    pub(super) fn blocks(&self) -> Vec<Block<'_>> {
        let mut blocks = Vec::new();
        let mut open: Option<usize> = None;
        for (index, (_, line)) in self.lines.iter().enumerate() {
            let Some(words) = line.trim_start().strip_prefix("```") else {
                continue;
            };
            match open {
                None => open = Some(index),
                // A fence with words does not close.
                Some(_) if !words.trim().is_empty() => {}
                Some(begin) => {
                    blocks.push(self.block(begin, index));
                    open = None;
                }
            }
        }
        blocks
    }

    fn block(&self, begin: usize, end: usize) -> Block<'_> {
        let (line, fence) = &self.lines[begin];
        let mut words = fence.trim_start().trim_start_matches('`').trim().split(',');
        let last = self.lines[end].0;
        let mut included = self.included.iter();
        Block {
            line: *line,
            language: words.next().unwrap_or(""),
            marks: words.map(str::trim).collect(),
            lines: &self.lines[begin + 1..end],
            included: included
                .find(|(number, _)| (*line..=last).contains(number))
                .map(|(_, file)| file.as_str()),
        }
    }

    /// A page of ours shows no code that nothing runs.
    pub(super) fn keeps_the_rules(&self) -> Result {
        if !self.is_ours() {
            return Ok(());
        }
        let blocks = self.blocks();
        let shells = blocks.iter().filter(|block| block.language == "console");
        let commands: Vec<&str> = shells.flat_map(Block::commands).collect();
        for block in &blocks {
            let runs = match (block.language, block.included) {
                ("console" | "text" | "sh" | "toml", _) => true,
                ("python", None) => super::WHEEL_PAGES.contains(&self.path.as_str()),
                ("rust", Some("bevy_frangible/README.md")) => true,
                ("rust", Some(file)) => example(file).is_some_and(|(package, name)| {
                    let words = format!("-p {package} --example {name}");
                    commands.iter().any(|command| command.contains(&words))
                }),
                ("html" | "js", Some(file)) => file.starts_with("apps/npm/pages/"),
                ("c", Some(file)) => file.starts_with("apps/c/examples/"),
                _ => false,
            };
            if !runs {
                return Err(format!(
                    "{}:{}: this block of `{}` is not run; xtask/src/book/mod.rs lists the blocks that are run",
                    self.path, block.line, block.language
                ));
            }
        }
        Ok(())
    }
}

impl Block<'_> {
    /// Value of `file=` among the marks.
    pub(super) fn file(&self) -> Option<&str> {
        self.marks
            .iter()
            .find_map(|mark| mark.strip_prefix("file="))
    }

    pub(super) fn is(&self, mark: &str) -> bool {
        self.marks.contains(&mark)
    }

    fn commands(&self) -> impl Iterator<Item = &str> {
        let lines = self.lines.iter();
        lines.filter_map(|(_, line)| line.strip_prefix("$ "))
    }
}

/// Package and name of an example, by its file `crates/PACKAGE/examples/NAME.rs`.
fn example(file: &str) -> Option<(&str, &str)> {
    let (package, name) = file.strip_prefix("crates/")?.split_once("/examples/")?;
    Some((package, name.strip_suffix(".rs")?))
}

/// The pages that the table of contents names, in its order.
pub(super) fn chapters() -> Result<Vec<Page>> {
    let summary = format!("{OURS}SUMMARY.md");
    let text = text(&summary)?;
    let targets = text.lines().filter_map(target);
    targets
        .map(|target| Page::read(&beside(&summary, target)))
        .collect()
}

/// Link target in a line of the table of contents.
pub(super) fn target(line: &str) -> Option<&str> {
    Some(line.split_once("](")?.1.split_once(')')?.0)
}

/// The file that a page names by its way from the page, as its way from the checkout's root.
pub(super) fn beside(page: &str, target: &str) -> String {
    let folder = Path::new(page).parent().unwrap_or(Path::new(""));
    let mut way = PathBuf::new();
    for part in folder.join(target).components() {
        match part {
            Component::ParentDir => drop(way.pop()),
            Component::CurDir => {}
            part => way.push(part),
        }
    }
    way.to_string_lossy().replace('\\', "/")
}

pub(super) fn text(path: &str) -> Result<String> {
    let bytes = read(&root().join(path))?;
    String::from_utf8(bytes).map_err(|_| format!("`{path}` is not UTF-8 text"))
}

/// The lines of a text between `ANCHOR: name` and `ANCHOR_END: name`, or all, without such lines themselves.
fn part(text: &str, anchor: Option<&str>) -> Option<Vec<String>> {
    let is_mark = |line: &str| line.contains("ANCHOR: ") || line.contains("ANCHOR_END: ");
    let names = |line: &str, mark: &str, name: &str| {
        let behind = line.split_once(mark).map(|(_, behind)| behind);
        behind.and_then(|behind| behind.split_whitespace().next()) == Some(name)
    };
    let mut lines = text.lines();
    if let Some(name) = anchor {
        lines.find(|line| names(line, "ANCHOR: ", name))?;
    }
    let ends = |line: &&str| anchor.is_none_or(|name| !names(line, "ANCHOR_END: ", name));
    let lines = lines.take_while(ends).filter(|line| !is_mark(line));
    Some(lines.map(str::to_owned).collect())
}

#[cfg(test)]
mod tests {
    use super::{beside, part};

    #[test]
    fn a_way_from_a_page_becomes_one_from_the_root() {
        assert_eq!(
            beside("book/src/start/web.md", "../../../docs/viewer.md"),
            "docs/viewer.md"
        );
        assert_eq!(
            beside("README.md", "docs/bevy/../paper.md"),
            "docs/paper.md"
        );
    }

    #[test]
    fn an_anchor_gives_the_lines_between_its_marks() {
        let text = "a\n<!-- ANCHOR: x -->\nb\n// ANCHOR: y\nc\n<!-- ANCHOR_END: x -->\nd";
        assert_eq!(part(text, Some("x")), Some(vec!["b".into(), "c".into()]));
        assert_eq!(part(text, None).map(|lines| lines.len()), Some(4));
        assert_eq!(part(text, Some("z")), None);
    }
}
