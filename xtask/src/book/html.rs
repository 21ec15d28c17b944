//! The book as HTML: pages, and the files that they link, in a folder laid out as the checkout is, so that links hold; from it mdBook makes
//! `target/book/html`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::fresh;
use super::page::{Page, beside, target as link, text};
use crate::command::{Result, announced, copy, root, succeeds, target};

/// The mdBook that the book was made with.
const VERSION: &str = "0.5.4";
/// Paths of the table of contents and of the first page.
const SUMMARY: &str = "book/src/SUMMARY.md";
const FIRST: &str = "book/src/introduction.html";

/// Makes it where there is mdBook, and returns a line that says where it is or how to get mdBook.
pub(super) fn make(pages: &[Page], linked: &BTreeSet<String>) -> Result<String> {
    let folder = fresh("source")?;
    let source = folder.join("src");
    put(&folder.join("book.toml"), &text("book/book.toml")?)?;
    put(&source.join("SUMMARY.md"), &summary()?)?;
    for page in pages {
        let lines: Vec<&str> = page.lines.iter().map(|(_, line)| line.as_str()).collect();
        put(&source.join(&page.path), &(lines.join("\n") + "\n"))?;
    }
    for file in linked {
        copy(&root().join(file), &source.join(file))?;
    }
    if !succeeds("mdbook", &["--version"]) {
        return Ok(format!(
            "book: HTML skipped, because mdBook is missing; install it with `cargo install mdbook --locked --version {VERSION}`"
        ));
    }
    let html = fresh("html")?;
    announced(
        Command::new("mdbook")
            .arg("build")
            .arg(&folder)
            .arg("--dest-dir")
            .arg(&html),
    )?;
    put(&html.join("index.html"), &goes_to(FIRST))?;
    live(&html.join("live"))?;
    Ok(format!("book: {}", html.join("index.html").display()))
}

/// The table of contents, with the ways of the files from the checkout's root.
fn summary() -> Result<String> {
    let text = text(SUMMARY)?;
    let lines = text.lines().map(|line| match link(line) {
        Some(way) => line.replace(
            &format!("]({way})"),
            &format!("]({})", beside(SUMMARY, way)),
        ),
        None => line.to_owned(),
    });
    Ok(lines.map(|line| line + "\n").collect())
}

/// A page that leads to another at once.
fn goes_to(page: &str) -> String {
    format!(
        "<!doctype html>\n<meta charset=\"utf-8\"><title>Frangible</title>\n<meta http-equiv=\"refresh\" content=\"0; url={page}\">\n\
         <a href=\"{page}\">The book of Frangible</a>\n"
    )
}

/// The viewer's page, or a page that says how to make it.
fn live(folder: &Path) -> Result {
    let made = target().join("web/page");
    if made.join("index.html").is_file() {
        return copy(&made, folder);
    }
    let advice = "<!doctype html>\n<meta charset=\"utf-8\"><title>The viewer</title>\n<p>The web viewer had not been built when this book was made. Build it with <code>cargo xtask web</code>, then run <code>cargo xtask book</code> again.\n";
    put(&folder.join("index.html"), advice)
}

fn put(path: &Path, text: &str) -> Result {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(path, text))
        .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))
}
