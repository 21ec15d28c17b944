//! Destinations of results: standard output, progress on the terminal, and data with the pages that quote it.

use std::io::{self, ErrorKind, IsTerminal, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};

use frangible_lab::data::{self, Measures};
use frangible_lab::{Result, page};
use frangible_recording::{make_folder, write_atomically};
use serde::Serialize;

use crate::args::Write;

/// Writes text; a reader that has seen enough (`frangible-lab verify | head`) is no error.
pub(crate) fn say(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// A progress line on the error stream; nothing if that is no terminal.
pub(crate) struct Bar {
    shown: bool,
    /// The percentage shown now, so that a thousand calls do not write a thousand lines.
    percent: AtomicU32,
}

impl Bar {
    pub(crate) fn new() -> Self {
        Self {
            shown: io::stderr().is_terminal(),
            percent: AtomicU32::new(u32::MAX),
        }
    }

    /// Shows the current step, and the share of the command that is done.
    pub(crate) fn show(&self, message: &str, share: f64) {
        let percent = (100.0 * share.clamp(0.0, 1.0)) as u32;
        if self.shown && self.percent.swap(percent, Ordering::Relaxed) != percent {
            eprint!("\r\x1b[K{percent:>3} % {message}");
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if self.shown {
            eprint!("\r\x1b[K");
        }
    }
}

/// The place of a measurement: a file of data, or standard output.
pub(crate) struct Place<'a> {
    docs: Option<&'a Path>,
    name: &'static str,
    measures: Measures,
}

impl<'a> Place<'a> {
    /// Makes the folder, so that a place that cannot be written is refused before minutes are spent.
    pub(crate) fn new(args: &'a Write, name: &'static str, measures: Measures) -> Result<Self> {
        let docs = args.write.as_deref();
        if let Some(docs) = docs {
            make_folder(&docs.join("data"), &[format!("{name}.json")], "--write")?;
        }
        Ok(Self {
            docs,
            name,
            measures,
        })
    }

    /// Writes the measurement and fills the pages that quote it, or prints it. `machine`: true if it has times.
    pub(crate) fn put(&self, machine: bool, found: &impl Serialize) -> Result<()> {
        let stored = data::stored(self.measures, machine, found)?;
        let Some(docs) = self.docs else {
            return Ok(say(&format!("{stored:#}\n"))?);
        };
        let path = data::write(docs, self.name, &stored)?;
        say(&format!("wrote {}\n", path.display()))?;
        fill_pages(docs)
    }
}

/// Fills the quotations in all pages of a folder.
pub(crate) fn fill_pages(docs: &Path) -> Result<()> {
    for entry in std::fs::read_dir(docs).map_err(|e| format!("`{}`: {e}", docs.display()))? {
        let path = entry?.path();
        if path.extension().is_none_or(|ending| ending != "md") {
            continue;
        }
        let old = std::fs::read_to_string(&path)?;
        let new = page::filled(&old, docs).map_err(|e| format!("`{}`: {e}", path.display()))?;
        if new != old {
            write_atomically(&path, new.as_bytes())?;
            say(&format!("filled {}\n", path.display()))?;
        }
    }
    Ok(())
}
