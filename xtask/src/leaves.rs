//! Leaves: packages that `cargo clippy` of the workspace does not compile, because they have a workspace or a target of their own. The gate gives
//! them to `cargo check` where that takes seconds.
//!
//! A leaf is warm if its check has passed before in its build folder, with this compiler: then the packages of others lie there. A file in the folder
//! says so, `checked-NAME`, which holds the output of `rustc -vV`.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::command::{Result, announced, cargo, output, root, target};
use crate::setup::cpp_compiler;
use crate::web;

struct Leaf {
    name: &'static str,
    /// Folder of its manifest.
    folder: &'static str,
    /// Its build folder within the target folder, which is that of its own chore.
    build: &'static str,
    words: &'static [&'static str],
}

const LEAVES: [Leaf; 5] = [
    Leaf {
        name: "fuzz",
        folder: "fuzz",
        build: "fuzz",
        words: &[],
    },
    Leaf {
        name: "python",
        folder: "apps/python",
        build: "",
        words: &["--release", "--all-targets"],
    },
    Leaf {
        name: "bevy",
        folder: "bevy_frangible",
        build: "bevy",
        words: &["--release", "--all-features", "--all-targets"],
    },
    Leaf {
        name: "bevy drawn",
        folder: "bevy_frangible",
        build: "bevy",
        words: &["--release", "--package=drawn", "--all-targets"],
    },
    Leaf {
        name: BROWSERS,
        folder: "",
        build: "web",
        words: &[
            "--profile=npm",
            "--package=frangible-js",
            "--package=frangible-js-bake",
            "--package=frangible-web",
            "--package=frangible-web-session",
        ],
    },
];
/// The packages of the workspace that run in browsers, for their target.
const BROWSERS: &str = "browsers";

/// Checks the leaves that are warm, and says which are not.
pub(crate) fn warm() -> Result<Vec<String>> {
    let compiler = compiler()?;
    let (warm, cold): (Vec<&Leaf>, Vec<&Leaf>) =
        LEAVES.iter().partition(|leaf| leaf.is_warm(&compiler));
    for leaf in warm {
        leaf.check(&compiler)?;
    }
    if cold.is_empty() {
        return Ok(Vec::new());
    }
    let names: Vec<&str> = cold.iter().map(|leaf| leaf.name).collect();
    let line = format!(
        "leaves: not checked because they have not been built yet: {}; build them with `cargo xtask ci 'all leaves'`",
        names.join(", ")
    );
    println!("{line}");
    Ok(vec![line])
}

/// Checks all leaves, which makes them warm.
pub(crate) fn all() -> Result<Vec<String>> {
    cpp_compiler();
    let compiler = compiler()?;
    LEAVES.iter().try_for_each(|leaf| leaf.check(&compiler))?;
    Ok(Vec::new())
}

impl Leaf {
    fn mark(&self) -> PathBuf {
        target()
            .join(self.build)
            .join(format!("checked-{}", self.name))
    }

    fn is_warm(&self, compiler: &[u8]) -> bool {
        fs::read(self.mark()).is_ok_and(|known| known == compiler)
    }

    fn check(&self, compiler: &[u8]) -> Result {
        // A lock file that no longer fits is an error here, not a change of the checkout.
        let mut command = cargo(&["check", "--locked"]);
        command
            .args(self.words)
            .current_dir(root().join(self.folder));
        if self.name == BROWSERS {
            web::for_browsers(&mut command)?;
        } else {
            command.env("CARGO_TARGET_DIR", target().join(self.build));
        }
        println!("leaf `{}`", self.name);
        announced(&mut command).map_err(|error| format!("leaf `{}`: {error}", self.name))?;
        let mark = self.mark();
        fs::write(&mark, compiler)
            .map_err(|error| format!("`{}` cannot be written: {error}", mark.display()))
    }
}

fn compiler() -> Result<Vec<u8>> {
    output(Command::new("rustc").arg("-vV").current_dir(root()))
}
