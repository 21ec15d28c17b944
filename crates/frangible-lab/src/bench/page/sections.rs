//! `docs/performance.md` as sections, each of which is measured and replaced for itself.

use std::fmt::Write;

use crate::bench::machine::Machine;

/// A section: its heading and its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    title: String,
    text: String,
}

/// Headings of the sections that are measured, in their order on the page.
pub const TABLE1: &str = "The paper's Table 1";
/// See [`TABLE1`].
pub const GALLERY: &str = "The bodies of the gallery";
/// See [`TABLE1`].
pub const CONTACTS: &str = "Refused contacts";
/// See [`TABLE1`].
pub const HAPTIC: &str = "A plate under a hand, a thousand times a second";
/// See [`TABLE1`].
pub const SHOP: &str = "A bull in a china shop";
/// See [`TABLE1`].
pub const AGAIN: &str = "Scenes whose pieces break again";
/// See [`TABLE1`].
pub const GPU: &str = "Many impacts on a GPU";
/// See [`TABLE1`].
pub const MEMORY: &str = "Memory";
/// The last one, which is always written anew.
const HOW: &str = "How to measure it again";

const ORDER: [&str; 9] = [
    TABLE1, GALLERY, CONTACTS, HAPTIC, SHOP, AGAIN, GPU, MEMORY, HOW,
];

const INTRO: &str = "# Performance

Each section is written for itself by its command at the end of the page with `--write docs`, and says on what machine. Times are
wall-clock times, so the machine should have nothing else to do. Machines of one name differ: contacts refused by their size took 0.70 µs on
one AMD EPYC and 0.92 µs on another, with the same instructions. One machine differs from day to day: in the paper's model, which reads mode
shapes from a cache that neighbours share, breaks of Table 1's bodies took 1.0 to 1.5 times as long on another day.

Breaks beside three-pinata's and Blender's: [peers.md](peers.md). How near the initiation comes to the machine's peaks, and flame graphs:
[roofline.md](roofline.md). What made breaks faster, and what did not: [speed.md](speed.md). How pieces that break again vibrate: [recursive.md](recursive.md).
";

const HOW_TO: &str = "```sh
cargo run --release -p frangible-lab -- bench all --write docs       # this page but for the memory: on a machine with nothing else to do
cargo run --release -p frangible-lab -- bench table1 --write docs    # one section; the others stay as they are
cargo run --release -p frangible-lab -- bench table1 --body glass    # one body; --json, --runs N, --no-reference
cargo run --release -p frangible-lab -- bench gallery                # also: --body pane, --runs N, --json
cargo run --release -p frangible-lab -- bench contacts --json
cargo run --release -p frangible-lab -- bench haptic                 # also: cargo run --release -p frangible-lab --example haptic
cargo run --release -p frangible-lab -- bench shop                   # also: cargo run --release -p frangible-lab --example china_shop
cargo run --release -p frangible-lab -- bench again
cargo run --release -p frangible-lab -- bench gpu
cargo run --release -p frangible-lab --example memory -- --write docs
cargo bench -p frangible-lab                                         # each stage on a small body
cargo xtask counts                                                   # instructions of each stage beside the stored ones
```

Bodies are baked once into `target/bench`, or where `--cache DIR` says; `--rebake` bakes them anew, and so does `--write`.

Instructions are counted by valgrind's callgrind on a baked pane in half precision, so that the last bits of another processor's bake
decide nothing. `cargo xtask counts` fails where one is 5 % above `crates/frangible-lab/counts.txt`, which names the rustc and the
valgrind it was made with, and compares nothing with any other; `cargo xtask counts --write` makes it anew.
";

impl Section {
    /// A section measured on a machine.
    #[must_use]
    pub fn new(title: &str, machine: &Machine, text: &str) -> Self {
        let Machine {
            processor,
            cores,
            system,
            busy,
        } = machine;
        let busy = busy.as_ref().map_or(String::new(), |load| {
            format!(" **It had other things to do, load {load}: the times are too long.**")
        });
        Self {
            title: title.into(),
            text: format!(
                "Measured on: {processor}, {cores} threads, {system}.{busy}\n\n{}\n",
                text.trim_end()
            ),
        }
    }

    /// Heading and text.
    #[must_use]
    pub fn to_markdown(&self) -> String {
        format!("## {}\n\n{}\n", self.title, self.text.trim())
    }
}

/// Puts these sections in their places on the page; `known` is the page so far. Sections that are not measured anew stay, and so do sections of other
/// headings, where they stand.
#[must_use]
pub fn with_sections(known: Option<&str>, new: &[Section]) -> String {
    let mut sections = split(known.unwrap_or_default());
    let how = Section {
        title: HOW.into(),
        text: HOW_TO.into(),
    };
    for section in new.iter().chain([&how]) {
        match sections.iter_mut().find(|s| s.title == section.title) {
            Some(old) => *old = section.clone(),
            None => sections.insert(place(&sections, &section.title), section.clone()),
        }
    }
    let mut page = String::from(INTRO);
    for section in sections {
        let _ = write!(page, "\n{}", section.to_markdown());
    }
    page
}

/// The sections of a page, without the text before the first.
fn split(page: &str) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for line in page.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            sections.push(Section {
                title: title.into(),
                text: String::new(),
            });
        } else if let Some(last) = sections.last_mut() {
            last.text.push_str(line);
            last.text.push('\n');
        }
    }
    sections
}

/// Place of a new section: before the first of those that come after it.
fn place(sections: &[Section], title: &str) -> usize {
    let rank = |title: &str| ORDER.iter().position(|known| *known == title);
    let own = rank(title);
    sections
        .iter()
        .position(|section| rank(&section.title).is_some_and(|other| Some(other) > own))
        .unwrap_or(sections.len())
}

#[cfg(test)]
mod tests {
    use super::{CONTACTS, HOW, SHOP, Section, TABLE1, with_sections};
    use crate::bench::machine::Machine;

    fn section(title: &str, text: &str) -> Section {
        let machine = Machine {
            processor: "P".into(),
            cores: 2,
            system: "S".into(),
            busy: None,
        };
        Section::new(title, &machine, text)
    }

    fn headings(page: &str) -> Vec<&str> {
        page.lines().filter_map(|l| l.strip_prefix("## ")).collect()
    }

    #[test]
    fn a_section_is_replaced_and_the_others_stay() {
        let page = with_sections(None, &[section(TABLE1, "old"), section(CONTACTS, "kept")]);
        let page = page.replace("## How", "## Peers\n\nby hand\n\n## How");
        let page = with_sections(Some(&page), &[section(TABLE1, "new")]);
        assert_eq!(headings(&page), [TABLE1, CONTACTS, "Peers", HOW]);
        for part in ["new", "kept", "by hand", "Measured on: P, 2 threads, S."] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(!page.contains("old"));
    }

    #[test]
    fn writing_the_same_again_changes_nothing() {
        let new = [section(SHOP, "### Sub\n\ntext\n")];
        let once = with_sections(Some("# Old\n\nIntro\n\n## Refused contacts\n\nx\n"), &new);
        assert_eq!(headings(&once), [CONTACTS, SHOP, HOW]);
        assert_eq!(with_sections(Some(&once), &new), once);
    }
}
