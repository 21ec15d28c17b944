//! The pages quote the data, and say how old it is.

use std::fs;
use std::path::{Path, PathBuf};

use frangible_lab::data::{commit_of, read};
use frangible_lab::page::filled;

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

/// Names, without the ending, and texts of the files of a folder that have this ending.
fn files(folder: &Path, ending: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let wanted = paths.filter(|path| path.extension().is_some_and(|e| e == ending));
    let mut files: Vec<_> = wanted
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into();
            (name, fs::read_to_string(&path).expect("a text"))
        })
        .collect();
    files.sort();
    files
}

#[test]
fn every_quotation_is_what_the_data_says() {
    let mut quotations = 0;
    for (name, page) in files(&docs(), "md") {
        quotations += page.matches("<!-- from ").count();
        let new = filled(&page, &docs()).unwrap_or_else(|e| panic!("docs/{name}.md: {e}"));
        assert!(
            new == page,
            "docs/{name}.md does not say what its data says; run `frangible-lab pages`"
        );
    }
    assert!(quotations > 0, "no page quotes any data");
}

/// The first line below a page's title names the commit of the data that the page quotes: whoever reads it sees if the code has changed since.
#[test]
fn the_first_line_of_a_page_names_the_commit_of_its_data() {
    let pages = files(&docs(), "md");
    for (name, _) in files(&docs().join("data"), "json") {
        let data = read(&docs(), &name).expect("JSON");
        let commit = data["commit"].as_str().expect("a commit");
        let quote = format!("data/{name}.json");
        let quoting = pages.iter().filter(|(_, page)| page.contains(&quote));
        let mut count = 0;
        for (page, text) in quoting {
            let first = text.lines().skip(1).find(|line| !line.is_empty());
            let first = first.unwrap_or_default();
            assert!(
                first.contains(commit) && first.contains(&quote),
                "the first line of docs/{page}.md does not name {quote} and its commit {commit}: {first}"
            );
            count += 1;
        }
        assert!(count > 0, "no page links to docs/{quote}");
        let crates = data["crates"].as_array().expect("crates");
        let crates: Vec<&str> = crates.iter().filter_map(|c| c.as_str()).collect();
        let now = commit_of(&crates);
        match now.as_str() {
            "unknown" => {
                println!("SKIPPED: without a history the age of docs/{quote} is not known");
            }
            now if now == commit => {}
            now => println!(
                "docs/{quote} was measured at {commit}; {} are at {now}",
                crates.join(", ")
            ),
        }
    }
}
