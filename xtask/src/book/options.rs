//! The program has the options that pages name, also where they show no command that is run.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use super::page::Page;
use crate::command::{Result, output};

/// Starts of a command line that calls the program.
const CALLS: [&str; 2] = ["frangible ", "cargo run --release -- "];
/// A command of the wheel's program alone, which `cargo xtask python` tries.
const OF_THE_WHEEL: &str = "dataset";

/// Checks all calls of the program in code between backticks and in blocks of `sh`. Returns the number of options in them.
pub(super) fn check(pages: &[Page], program: &Path) -> Result<usize> {
    let mut helps = Helps {
        program,
        known: BTreeMap::new(),
    };
    let main = helps.of(None)?;
    let mut count = 0;
    for page in pages {
        for (line, code) in code(page) {
            let Some(call) = CALLS.iter().find_map(|call| code.strip_prefix(call)) else {
                continue;
            };
            // The rest is a remark, or another program.
            let call = call.split(['#', '|', '>']).next().unwrap_or("");
            let words: Vec<&str> = call.split_whitespace().collect();
            let named = words.first().filter(|word| is_command(&main, word));
            if words.first() == Some(&OF_THE_WHEEL) {
                continue;
            }
            let help = helps.of(named.copied())?;
            for word in words {
                let word = word.split('=').next().unwrap_or(word);
                if word.starts_with("--") && word.len() > 2 {
                    if !has(&help, word) {
                        let path = &page.path;
                        return Err(format!(
                            "{path}:{line}: `{code}`: the program has no option `{word}` there"
                        ));
                    }
                    count += 1;
                }
            }
        }
    }
    Ok(count)
}

/// Returns true if the program's help lists this command.
fn is_command(help: &str, word: &str) -> bool {
    let mut lines = help.lines().filter_map(|line| line.strip_prefix("  "));
    lines.any(|line| line.split(' ').next() == Some(word) && !word.is_empty())
}

/// Returns true if a help text has this word.
fn has(help: &str, word: &str) -> bool {
    help.split([' ', '\n', ',']).any(|known| known == word)
}

/// Help texts of the program and its commands, each read once.
struct Helps<'a> {
    program: &'a Path,
    known: BTreeMap<String, String>,
}

impl Helps<'_> {
    fn of(&mut self, command: Option<&str>) -> Result<String> {
        let key = command.unwrap_or("").to_owned();
        if let Some(help) = self.known.get(&key) {
            return Ok(help.clone());
        }
        let mut words = Command::new(self.program);
        words.args(command).arg("--help");
        let help = String::from_utf8_lossy(&output(&mut words)?).into_owned();
        self.known.insert(key, help.clone());
        Ok(help)
    }
}

/// Code between backticks, and the lines of blocks of `sh`.
fn code(page: &Page) -> Vec<(usize, &str)> {
    let mut code = Vec::new();
    for block in page.blocks().iter().filter(|block| block.language == "sh") {
        code.extend(
            block
                .lines
                .iter()
                .map(|(number, line)| (*number, line.as_str())),
        );
    }
    for (number, line) in &page.lines {
        if !line.contains("```") {
            let spans = line.split('`').skip(1).step_by(2);
            code.extend(spans.map(|span| (*number, span)));
        }
    }
    code
}
