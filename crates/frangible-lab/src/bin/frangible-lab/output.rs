//! Destinations of results: standard output, progress on the terminal, and pages with their pictures.

use std::error::Error;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};

use frangible_recording::{make_folder, write_atomically};
use serde_json::json;

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
    pub(crate) fn new(quiet: bool) -> Self {
        let shown = !quiet && io::stderr().is_terminal();
        let percent = AtomicU32::new(u32::MAX);
        Self { shown, percent }
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

/// A page of the documentation and the folder of its pictures beside it.
pub(crate) struct Page<'a> {
    folder: Option<&'a Path>,
    name: &'static str,
    pictures: &'static str,
}

impl<'a> Page<'a> {
    /// Makes the folders, so that a place that cannot be written is refused before minutes are spent.
    pub(crate) fn new(
        folder: Option<&'a Path>,
        name: &'static str,
        pictures: &'static str,
    ) -> Result<Self, String> {
        if let Some(folder) = folder {
            make_folder(folder, &[name.into()], "--write")?;
            make_folder(&folder.join(pictures), &[], "--write")?;
        }
        Ok(Self {
            folder,
            name,
            pictures,
        })
    }

    /// Writes the page and its pictures, by name and PNG bytes, where a folder was asked for. Returns the files.
    pub(crate) fn write(
        &self,
        text: &str,
        pictures: &[(String, Vec<u8>)],
    ) -> Result<Vec<String>, Box<dyn Error>> {
        let Some(folder) = self.folder else {
            return Ok(Vec::new());
        };
        let mut files = Vec::new();
        let mut put = |name: String, bytes: &[u8]| -> Result<(), Box<dyn Error>> {
            let path = folder.join(name);
            write_atomically(&path, bytes)?;
            files.push(path.display().to_string());
            Ok(())
        };
        put(self.name.into(), text.as_bytes())?;
        for (name, png) in pictures {
            put(format!("{}/{name}.png", self.pictures), png)?;
        }
        Ok(files)
    }

    /// Writes the page, and reports its contents and the written files, with `json` for programs.
    pub(crate) fn tell(
        &self,
        page: frangible_lab::page::Page,
        json: bool,
    ) -> Result<(), Box<dyn Error>> {
        let files = self.write(&page.text, &page.pictures)?;
        if json {
            let told = json!({ "page": page.text, "files": files });
            return Ok(say(&format!("{told:#}\n"))?);
        }
        let mut text = page.text;
        for file in files {
            text.push_str(&format!("wrote {file}\n"));
        }
        Ok(say(&text)?)
    }
}
