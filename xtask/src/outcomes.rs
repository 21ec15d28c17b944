//! Compares the outcomes of the built-in scenes with earlier ones: a change that moves or renames must leave all bits as they were, and one that
//! changes the physics shows pieces, areas and energies before and after.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::command::{Result, cargo, output, run, target};

const PROGRAM: &str = "outcomes";

/// Task to do with the outcomes.
pub(crate) enum Wish<'a> {
    /// Print them.
    Print,
    /// Store them in this file.
    Write(&'a Path),
    /// Compare them with this file; an outcome that differs is an error.
    Against(&'a Path),
}

/// One line of the program `outcomes`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Outcome {
    /// Scene and body, the latter `whole` for the scene.
    of: String,
    /// Pieces, area in cm² and energy in J, as printed.
    figures: [String; 3],
    bits: String,
}

/// Breaks all scenes and does the task.
pub(crate) fn outcomes(wish: &Wish<'_>) -> Result {
    // An unreadable file is reported before minutes are spent.
    let before = match wish {
        Wish::Against(path) => parse(&read(path)?)?,
        _ => Vec::new(),
    };
    // All of the workspace, so that the features are those of every other build.
    let arguments = ["build", "--release", "--workspace", "--example", PROGRAM];
    run(&mut cargo(&arguments))?;
    let program = target().join("release/examples").join(PROGRAM);
    let text = output(&mut Command::new(&program))?;
    let text = String::from_utf8_lossy(&text);
    let after = parse(&text)?;
    match wish {
        Wish::Print => print!("{text}"),
        Wish::Write(path) => fs::write(path, text.as_bytes())
            .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))?,
        Wish::Against(path) => {
            let lines = differences(&before, &after);
            if !lines.is_empty() {
                return Err(format!(
                    "{} of {} outcomes differ from `{}`:\n{}",
                    lines.len(),
                    after.len(),
                    path.display(),
                    lines.join("\n")
                ));
            }
            println!("all {} outcomes are the same, bit for bit", after.len());
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).map_err(|error| {
        format!(
            "`{}` cannot be read: {error}; create it with `cargo xtask outcomes --write FILE`",
            path.display()
        )
    })
}

fn parse(text: &str) -> Result<Vec<Outcome>> {
    let outcome = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [scene, body, pieces, area, energy, bits] = words[..] else {
            return Err(format!(
                "the line `{line}` must have the form scene, body, pieces, area, energy, bits"
            ));
        };
        Ok(Outcome {
            of: format!("{scene} {body}"),
            figures: [pieces, area, energy].map(String::from),
            bits: bits.into(),
        })
    };
    text.lines().map(outcome).collect()
}

/// A line for each outcome that is not in both with the same bits.
fn differences(before: &[Outcome], after: &[Outcome]) -> Vec<String> {
    let find = |all: &[Outcome], of: &str| all.iter().find(|o| o.of == of).cloned();
    let told = |o: &Outcome| {
        let [pieces, area, energy] = &o.figures;
        format!("{pieces} pieces, {area} cm², {energy} J")
    };
    let mut lines = Vec::new();
    for now in after {
        match find(before, &now.of) {
            None => lines.push(format!("{}: new: {}", now.of, told(now))),
            Some(old) if old.bits == now.bits => {}
            Some(old) if old.figures == now.figures => {
                lines.push(format!("{}: {}, but the bits differ", now.of, told(now)));
            }
            Some(old) => lines.push(format!("{}: {} → {}", now.of, told(&old), told(now))),
        }
    }
    for old in before {
        if find(after, &old.of).is_none() {
            lines.push(format!("{}: gone: {}", old.of, told(old)));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{differences, parse};

    #[test]
    fn each_kind_of_difference_is_told() {
        let before =
            parse("glass 0 14 29.3 0.02 aa\nglass whole 14 29.3 0.02 ab\nvase 0 3 1 1 cc\npane 0 2 1 1 dd").unwrap();
        let after =
            parse("glass 0 14 29.3 0.02 aa\nglass whole 14 29.3 0.02 ff\nvase 0 4 1 1 ce\nbrick 0 2 1 1 ee").unwrap();
        assert!(differences(&before, &before).is_empty());
        let lines = differences(&before, &after);
        let starts = [
            "glass whole: 14 pieces",
            "vase 0: 3 pieces",
            "brick 0: new",
            "pane 0: gone",
        ];
        assert_eq!(lines.len(), starts.len(), "{lines:?}");
        for (line, start) in lines.iter().zip(starts) {
            assert!(line.starts_with(start), "{line}");
        }
    }

    #[test]
    fn a_line_of_another_kind_is_refused() {
        assert!(parse("glass 0 14").is_err());
    }
}
