//! Contents of the packages to publish: each has its licences, its page and nothing else.

use crate::command::{Result, announced, cargo, output, read, root};
use crate::test::packages;

const LICENCES: [&str; 2] = ["LICENSE-MIT", "LICENSE-APACHE"];

/// Checks that each published package carries its licences and nothing that does not belong there.
pub(crate) fn package_lists() -> Result<Vec<String>> {
    for (name, _) in packages()?.iter().filter(|(_, published)| *published) {
        let list = output(&mut cargo(&[
            "package",
            "--list",
            "--allow-dirty",
            "-p",
            name,
        ]))?;
        let list = String::from_utf8_lossy(&list);
        let files: Vec<&str> = list.lines().collect();
        if let Some(missing) = LICENCES.iter().find(|licence| !files.contains(licence)) {
            return Err(format!(
                "package `{name}` lacks {missing}; copy it from the workspace's root into the package"
            ));
        }
        if let Some(stray) = files.iter().find(|file| !belongs(file)) {
            return Err(format!(
                "package `{name}` would publish `{stray}`; delete it, exclude it in Cargo.toml, or allow it in xtask/src/packages.rs"
            ));
        }
        if !files.contains(&"README.md") {
            return Err(format!(
                "package `{name}` has no README.md for its page in the registry"
            ));
        }
        println!("{name}: {} files", files.len());
    }
    // Their manifests are complete, and each finds the others in the versions that it asks for. Earlier builds have left the necessary part of the
    // registry's index here; otherwise the registry is asked.
    let mut words = vec!["package", "--workspace", "--no-verify", "--allow-dirty"];
    let all = packages()?;
    for (name, _) in all.iter().filter(|(_, published)| !*published) {
        words.extend(["--exclude", name.as_str()]);
    }
    if announced(cargo(&words).arg("--offline")).is_err() {
        announced(&mut cargo(&words))?;
    }
    same_licences()
}

fn belongs(file: &str) -> bool {
    const FILES: [&str; 12] = [
        ".cargo_vcs_info.json",
        "Cargo.lock",
        "Cargo.toml",
        "Cargo.toml.orig",
        "LICENSE-APACHE",
        "LICENSE-MIT",
        "README.md",
        "CHANGELOG.md",
        "build.rs",
        // Its licence travels with it.
        "font/LICENSE",
        "font/README.md",
        "font/Roboto-Latin.ttf",
    ];
    const FOLDERS: [&str; 4] = ["src/", "tests/", "benches/", "examples/"];
    const KINDS: [&str; 8] = [
        ".rs",
        ".md",
        ".wgsl",
        ".json",
        ".msh",
        ".obj",
        ".png",
        ".frangible",
    ];
    FILES.contains(&file)
        || FOLDERS.iter().any(|folder| file.starts_with(folder))
            && KINDS.iter().any(|kind| file.ends_with(kind))
}

/// The licence files of published packages are copies, as links do not survive a checkout on Windows: they must not drift.
fn same_licences() -> Result<Vec<String>> {
    for licence in LICENCES {
        let original = read(&root().join(licence))?;
        for folder in ["crates", "apps"] {
            let entries = root()
                .join(folder)
                .read_dir()
                .map_err(|error| format!("`{folder}` cannot be listed: {error}"))?;
            for package in entries
                .filter_map(|entry| Some(entry.ok()?.path()))
                .filter(|path| path.join("Cargo.toml").is_file())
            {
                let copy = package.join(licence);
                // A published package without one was refused above; the wheel's package stands outside the workspace.
                if !copy.is_file() && !package.ends_with("apps/python") {
                    continue;
                }
                if read(&copy)? != original {
                    return Err(format!(
                        "`{}` differs from the workspace's {licence}; copy that over it",
                        copy.display()
                    ));
                }
            }
        }
    }
    Ok(Vec::new())
}
