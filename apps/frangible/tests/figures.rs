//! `frangible figures`: a figure is written with its text, and a name that none has is refused.
#![cfg(feature = "draw")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for a test, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let name = format!("frangible-figures-{}-{test}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn figures(write: &Path, names: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frangible"));
    command.args(["figures", "--write"]).arg(write).args(names);
    command.output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_figure_is_written_with_its_text_and_others_keep_theirs() {
    let folder = Folder::new("fig3");
    fs::create_dir_all(&folder.0).expect("a folder");
    let page = folder.0.join("figures.md");
    let other = "## Fig. 7: the slab at three fracture toughnesses\n\nan older text | agrees |\n";
    fs::write(&page, format!("# a page\n\n{other}")).expect("a page");
    let output = figures(&folder.0, &["fig3"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        text(&output.stdout).contains("agrees"),
        "{}",
        text(&output.stdout)
    );
    let png = fs::read(folder.0.join("figures/fig3.png")).expect("the picture");
    assert!(
        png.starts_with(b"\x89PNG") && png.len() < 150_000,
        "{}",
        png.len()
    );
    let written = fs::read_to_string(&page).expect("the page");
    let [rod, slab] = ["\n## Fig. 3", other].map(|part| written.find(part).expect(part));
    assert!(rod < slab, "{written}");
    assert!(written.contains("figures/fig3.png") && !written.contains("# a page"));
}

#[test]
fn an_unknown_figure_is_refused_with_those_there_are() {
    let folder = Folder::new("unknown");
    let output = figures(&folder.0, &["fig33"]);
    assert!(!output.status.success());
    let message = text(&output.stderr);
    assert!(
        message.starts_with("error: there is no figure `fig33`, did you mean `fig3`?")
            && message.contains("fig12"),
        "{message}"
    );
    assert!(!folder.0.exists(), "a folder was made");
}
