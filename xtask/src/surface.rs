//! The public surface of the core: what a user of `frangible` sees, and what its versions promise.
//!
//! The list is read off the documentation as rustdoc writes it, without `internals`: whatever is hidden there is promised no more than
//! `internals` is. It has every type and function at the root, and of the crate's own types every public field, method and constant. Implementations
//! of traits do not count, and neither do the members of errors or of types that come from a sibling crate, which has documentation of its own.

use std::collections::BTreeSet;

use crate::command::{Result, announced, cargo, read, target};

/// Largest number of names.
const MOST: usize = 120;

/// Kinds of items at the root, by the first word of their pages' names.
const ITEMS: [&str; 6] = ["struct.", "enum.", "fn.", "trait.", "type.", "constant."];

/// Kinds of members, by the marks of their places in a page.
const MEMBERS: [&str; 5] = [
    "<span id=\"structfield.",
    "<section id=\"method.",
    "<section id=\"tymethod.",
    "<section id=\"associatedconstant.",
    "<div class=\"sub-variant-field\"><span id=\"variant.",
];

/// Kinds of types that signatures link to.
const TYPES: [&str; 4] = ["struct", "enum", "trait", "type"];

/// Builds the documentation of the core and checks its surface.
pub(crate) fn surface() -> Result<Vec<String>> {
    announced(&mut cargo(&[
        "doc",
        "--release",
        "--no-deps",
        "--package=frangible",
    ]))?;
    let names = documented()?;
    names.iter().for_each(|name| println!("{name}"));
    Ok(vec![counted(&names)?])
}

/// Checks the surface in documentation that has been built.
pub(crate) fn check() -> Result<Vec<String>> {
    Ok(vec![counted(&documented()?)?])
}

fn counted(names: &[String]) -> Result<String> {
    let count = names.len();
    if count > MOST {
        return Err(format!(
            "the root of `frangible` has {count} names, more than {MOST}; hide one (#[doc(hidden)]), or move it to `internals`"
        ));
    }
    Ok(format!("surface: {count} names, at most {MOST}"))
}

fn documented() -> Result<Vec<String>> {
    let folder = target().join("doc/frangible");
    let page = |name: &str| {
        let bytes = read(&folder.join(name))?;
        Ok::<_, String>(own_part(&String::from_utf8_lossy(&bytes)).to_owned())
    };
    let index = page("index.html")?;
    let pages: BTreeSet<&str> = values(&index, "href=\"")
        .filter(|link| !link.contains(['/', '#']))
        .filter(|link| ITEMS.iter().any(|kind| link.starts_with(kind)))
        .collect();
    let mut names = Vec::new();
    for link in &pages {
        let item = name_of(link);
        let text = page(link)?;
        names.push(item.to_owned());
        names.extend(members(&text, item));
        if let Some(foreign) = foreign_type(&text, &pages) {
            return Err(format!(
                "`{item}` of `frangible` names the type at `{foreign}`, which is not at the root; re-export it there, or hide the member that names it (#[doc(hidden)])"
            ));
        }
    }
    if names.len() < ITEMS.len() {
        return Err(format!(
            "`{}` lists no items; this check does not understand the pages of this version of rustdoc",
            folder.display()
        ));
    }
    Ok(names)
}

/// A page without its frame and the implementations of traits.
fn own_part(page: &str) -> &str {
    let begin = page.find("<section id=\"main-content\"").unwrap_or(0);
    let page = &page[begin..];
    let marks = [
        "id=\"trait-implementations\"",
        "id=\"synthetic-implementations\"",
        "id=\"blanket-implementations\"",
    ];
    let ends = marks.iter().filter_map(|mark| page.find(mark));
    &page[..ends.min().unwrap_or(page.len())]
}

/// The texts that follow a mark, up to the next quotation mark.
fn values<'a>(text: &'a str, mark: &str) -> impl Iterator<Item = &'a str> {
    text.split(mark)
        .skip(1)
        .filter_map(|part| part.split('"').next())
}

/// Name of the item on the page `struct.Name.html`.
fn name_of(link: &str) -> &str {
    let file = link.rsplit('/').next().unwrap_or(link);
    file.split('.').nth(1).unwrap_or(file)
}

/// Names of the members that count.
fn members(page: &str, item: &str) -> Vec<String> {
    // A type of a sibling crate has a link to its source only if that crate was documented first.
    let is_own = values(page, "href=\"../src/")
        .next()
        .is_some_and(|source| source.starts_with("frangible/"));
    if !is_own || item.ends_with("Error") {
        return Vec::new();
    }
    let all = MEMBERS.iter().flat_map(|mark| values(page, mark));
    all.map(|name| format!("{item}::{}", name.replace(".field.", "::")))
        .collect()
}

/// The first type in a signature that is neither of the standard library, nor of glam, nor at the root.
fn foreign_type<'a>(page: &'a str, pages: &BTreeSet<&str>) -> Option<&'a str> {
    let known = |link: &str| {
        let name = name_of(link);
        link.starts_with("https://")
            || link.contains("/glam/")
            || pages.iter().any(|page| name_of(page) == name)
    };
    TYPES
        .iter()
        .flat_map(|kind| values(page, &format!("<a class=\"{kind}\" href=\"")).collect::<Vec<_>>())
        .find(|link| !known(link.split('#').next().unwrap_or(link)))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{foreign_type, members, name_of, own_part};

    const PAGE: &str = "<a href=\"nav\"><section id=\"main-content\">\
        <a class=\"src\" href=\"../src/frangible/body.rs.html#1\">Source</a>\
        <pre><a class=\"struct\" href=\"struct.Asset.html\">Asset</a></pre>\
        <span id=\"structfield.mass\" class=\"structfield\"></span>\
        <section id=\"method.new\" class=\"method\">\
        <a class=\"struct\" href=\"internals/mesh/glam/struct.Vec3.html\">Vec3</a></section>\
        <div id=\"trait-implementations\"><section id=\"method.clone\">";

    #[test]
    fn fields_and_methods_count_and_implementations_of_traits_do_not() {
        let page = own_part(PAGE);
        assert_eq!(members(page, "Body"), ["Body::mass", "Body::new"]);
        let sibling = page.replace("src/frangible/", "src/frangible_material/");
        assert!(members(&sibling, "Material").is_empty());
        let without_link = page.replace("../src/frangible/", "");
        assert!(members(&without_link, "Material").is_empty());
        assert!(members(page, "InputError").is_empty());
    }

    #[test]
    fn a_type_that_is_only_in_internals_is_found() {
        let root = BTreeSet::from(["struct.Asset.html"]);
        assert_eq!(foreign_type(own_part(PAGE), &root), None);
        let leak = PAGE.replace("struct.Asset.html", "internals/struct.Portion.html");
        let found = foreign_type(own_part(&leak), &root);
        assert_eq!(found, Some("internals/struct.Portion.html"));
        assert_eq!(name_of("internals/struct.Portion.html"), "Portion");
    }
}
