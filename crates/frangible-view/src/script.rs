//! Scripts: files with one command per line, and comments after `#`.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use crate::command::Command;
use crate::error::ViewError;

/// A sequence of commands. Each waits for the jobs of the one before it, such as bakes, steps or a repeated impact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    commands: VecDeque<Command>,
}

impl Script {
    /// Reads a script; `path` is its name in messages.
    ///
    /// # Errors
    /// The first line that is not a command.
    pub fn parse(text: &str, path: &Path) -> Result<Self, ViewError> {
        let mut commands = VecDeque::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split_once('#').map_or(line, |(before, _)| before);
            if line.trim().is_empty() {
                continue;
            }
            commands.push_back(Command::parse(line).map_err(|error| ViewError::Script {
                path: path.to_path_buf(),
                line: number,
                problem: error.to_string(),
            })?);
        }
        Ok(Self { commands })
    }

    /// Reads a script's file.
    ///
    /// # Errors
    /// A file that cannot be read, or the first line that is not a command.
    pub fn read(path: &Path) -> Result<Self, ViewError> {
        let text = std::fs::read_to_string(path).map_err(|source| ViewError::File {
            path: path.to_path_buf(),
            doing: "read",
            source,
        })?;
        Self::parse(&text, path)
    }

    /// Resolves relative file names to this folder.
    #[must_use]
    pub fn into_folder(mut self, folder: &Path) -> Self {
        let place = |path: &mut PathBuf| *path = folder.join(&path);
        for command in &mut self.commands {
            if let Command::Save(_, path) | Command::Screenshot(path) | Command::Film(_, path, _) =
                command
            {
                place(path);
            }
        }
        self
    }

    /// Removes and returns the next command.
    pub fn next_command(&mut self) -> Option<Command> {
        self.commands.pop_front()
    }

    /// Returns the next command without removing it.
    #[must_use]
    pub fn peek(&self) -> Option<&Command> {
        self.commands.front()
    }

    /// Returns true if no commands are left.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.commands.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remarks_and_blank_lines_are_passed_over_and_mistakes_have_their_line() {
        let text = "# a pane\nscene pane\n\nstep 10 # a while\nsave glb x.glb\n";
        let script = Script::parse(text, Path::new("s.txt")).unwrap();
        let mut script = script.into_folder(Path::new("out"));
        assert_eq!(script.next_command(), Some(Command::Scene("pane".into())));
        assert_eq!(script.next_command(), Some(Command::Step(10)));
        let last = script.next_command().unwrap().to_string();
        assert_eq!(last, "save glb out/x.glb");
        assert!(script.is_over());
        let error = Script::parse("run\nstop\n", Path::new("s.txt")).unwrap_err();
        assert!(error.to_string().starts_with("s.txt line 2: "), "{error}");
    }
}
