//! The book: the commands of its pages are run, the targets of its links are checked, and mdBook makes it HTML where that is installed.
//!
//! Pages of `book/src` keep these rules; pages from elsewhere, such as those of `docs/`, are only looked through for links and options.
//!
//! | block | rule |
//! |---|---|
//! | `console` | Lines that begin with `$ ` are run in order, in a fresh folder for each page. The lines below a command must occur in its output in this order; `…` stands for anything. |
//! | `console,whole` | The lines are the whole output; `cargo xtask book --write` writes them anew. |
//! | `console,wheel`, `python` | It is run by `cargo xtask python`, where the wheel is. |
//! | any with `file=NAME` | It is saved under that name in the page's folder. |
//! | `rust` | It is an example of a package that a command of the page runs, or what `cargo xtask bevy` runs. |
//! | `html`, `js` | It is a page that `cargo xtask npm` tries. |
//! | `c` | It is a program that `cargo xtask c` runs. |
//! | `sh` | It is a chore that is a step of `cargo xtask ci --all`, or it installs something. |

mod html;
mod links;
mod options;
mod page;
mod run;
mod shown;

use std::fs;
use std::path::{Path, PathBuf};

use crate::command::{self, Result, cargo, root};
use crate::setup::setup;
use page::{Page, chapters};

/// The pages that the wheel's environment runs.
const WHEEL_PAGES: [&str; 2] = ["book/src/start/python.md", "book/src/how-to/kit.md"];

/// Task to do with the book.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Wish<'a> {
    /// Run its commands, check its links, make it HTML.
    All,
    /// Do all of it, and write anew the outputs that the pages show whole.
    Write,
    /// Check its links and make it HTML.
    Html,
    /// Run the commands of this page, by its path from the checkout's root.
    Page(&'a str),
}

/// Does it, and returns the lines that sum it up.
pub(crate) fn book(wish: Wish<'_>) -> Result<Vec<String>> {
    if let Wish::Page(path) = wish {
        let page = Page::read(path)?;
        page.keeps_the_rules()?;
        return run::page(&page, &program()?, false).map(|_| Vec::new());
    }
    let pages = chapters()?;
    for page in &pages {
        page.keeps_the_rules()?;
    }
    let linked = links::check(&pages)?;
    let mut lines = Vec::new();
    if wish != Wish::Html {
        setup();
        let program = program()?;
        let options = options::check(&pages, &program)?;
        let mut commands = 0;
        for page in pages.iter().filter(|page| page.is_ours()) {
            commands += run::page(page, &program, wish == Wish::Write)?;
        }
        lines.push(format!(
            "book: {commands} commands ran; {options} options, links on {} pages and {} linked files checked",
            pages.len(),
            linked.len()
        ));
    }
    lines.push(html::make(&pages, &linked)?);
    for line in &lines {
        println!("{line}");
    }
    Ok(lines)
}

/// Runs the Python of the book with the programs of this folder, in which the wheel is installed.
pub(crate) fn wheel(programs: &Path) -> Result<Vec<String>> {
    let mut count = 0;
    for path in WHEEL_PAGES {
        count += run::wheel(&Page::read(path)?, programs)?;
    }
    Ok(vec![format!("python: {count} parts of the book ran")])
}

/// The program for this machine, built with its window.
fn program() -> Result<PathBuf> {
    command::announced(&mut cargo(&["build", "--release", "--features", "view"]))?;
    Ok(command::program())
}

/// A folder in the checkout's `target`, empty: cargo finds the workspace from it, whatever it builds into.
fn fresh(name: &str) -> Result<PathBuf> {
    let folder = root().join("target/book").join(name);
    let failed = |error| format!("`{}` cannot be made anew: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    Ok(folder)
}
