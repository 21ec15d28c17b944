//! Gives a script's commands, each when the one before it is done; pictures are taken when that is drawn, too.

use crate::Command;
use crate::error::ViewError;
use crate::script::Script;
use crate::shown::Shown;

/// Frames drawn after everything is done, before the next command: panels need a second one to settle.
const SETTLE: u32 = 3;

pub(super) struct Director {
    script: Option<Script>,
    last: Option<Command>,
    frames: u32,
    /// Pictures of 1/60 s that are still to be taken and drawn.
    left: u32,
    failed: Option<ViewError>,
}

impl Director {
    pub(super) fn new(script: Option<Script>) -> Self {
        Self {
            script,
            last: None,
            frames: 0,
            left: 0,
            failed: None,
        }
    }

    /// The next command, if it is time.
    pub(super) fn next(
        &mut self,
        shown: &Shown,
        done: bool,
        drawn: bool,
    ) -> Result<Option<Command>, ViewError> {
        let Some(script) = &mut self.script else {
            return Ok(None);
        };
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        // Only pictures have to wait until the scene is drawn.
        let pictured = matches!(script.peek(), Some(Command::Screenshot(_)));
        if !done || pictured && !drawn {
            self.frames = 0;
            return Ok(None);
        }
        // Of `frames N` each is drawn, with whatever shadow there is.
        if self.left > 0 {
            if self.frames == 0 {
                return Ok(None);
            }
            self.left -= 1;
            self.frames = 0;
            if self.left > 0 {
                return Ok(Some(Command::Frames(1)));
            }
        }
        if let Some((problem, true)) = &shown.message {
            let line = self
                .last
                .as_ref()
                .map_or(String::new(), ToString::to_string);
            return Err(ViewError::Command {
                line,
                problem: problem.clone(),
            });
        }
        if pictured && self.frames < SETTLE {
            return Ok(None);
        }
        self.frames = 0;
        let command = script.next_command().unwrap_or(Command::Quit);
        self.last = Some(command.clone());
        if let Command::Frames(count @ 1..) = command {
            self.left = count;
            return Ok(Some(Command::Frames(1)));
        }
        Ok(Some(command))
    }

    pub(super) fn frame_done(&mut self) {
        self.frames += 1;
    }

    /// Takes the result of a command that the window carried out.
    pub(super) fn done(&mut self, result: Result<(), ViewError>) {
        if self.script.is_some() {
            self.failed = result.err();
        }
    }

    /// Somebody closed the window.
    pub(super) fn closed_early(&self) -> Result<(), ViewError> {
        match &self.script {
            Some(script) if !script.is_over() => Err(ViewError::NotNow(
                "the window was closed before the end of the script".into(),
            )),
            _ => Ok(()),
        }
    }
}
