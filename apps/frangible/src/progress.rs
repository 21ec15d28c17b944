//! Progress on the terminal's error stream; nothing when it is no terminal.

use std::cell::RefCell;
use std::io::{IsTerminal, stderr};
use std::time::Instant;

/// A progress line: the current step, and the share that is done.
pub(crate) struct Bar {
    begun: Instant,
    /// The line as it stands there, without the time; none where nothing is shown.
    line: Option<RefCell<String>>,
}

/// Length of the bar, letters.
const LENGTH: usize = 30;

impl Bar {
    pub(crate) fn new(quiet: bool) -> Self {
        Self {
            begun: Instant::now(),
            line: (!quiet && stderr().is_terminal()).then(RefCell::default),
        }
    }

    /// Shows a message and a share of 0 to 1.
    pub(crate) fn show(&self, message: &str, share: f64) {
        let Some(line) = &self.line else { return };
        let text = text(message, share);
        if *line.borrow() != text {
            eprint!("\r\x1b[K{text} ({} s)", self.begun.elapsed().as_secs());
            line.replace(text);
        }
    }
}

fn text(message: &str, share: f64) -> String {
    let share = share.clamp(0.0, 1.0);
    let full = (share * LENGTH as f64) as usize;
    let (full, empty) = ("█".repeat(full), "░".repeat(LENGTH - full));
    format!("{full}{empty} {:>3.0} % {message}", 100.0 * share)
}

impl Drop for Bar {
    fn drop(&mut self) {
        if self.line.is_some() {
            eprint!("\r\x1b[K");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::text;

    #[test]
    fn the_bar_is_as_long_for_any_share() {
        for share in [-1.0, 0.0, 0.333, 1.0, 7.0, f64::NAN] {
            let bar = text("glass: modes", share);
            let letters = bar.chars().filter(|letter| "█░".contains(*letter));
            assert_eq!(letters.count(), 30, "{bar}");
            assert!(bar.ends_with("% glass: modes"), "{bar}");
        }
    }
}
