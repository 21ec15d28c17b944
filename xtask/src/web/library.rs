//! The standard library for browsers: installed, or its sources, which Debian packs for each release of Rust.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{Folders, make_folder};
use crate::command::{Result, output, root, run, succeeds};

/// Debian's suite that has the sources of many releases.
const SUITE: &str = "trixie-backports";
const PACKAGE: &str = "rust-src";
/// Path of the Debian archive on its server.
const ARCHIVE: &str = "/debian";

/// State of the standard library for the browser's target.
pub(super) enum Library {
    /// Ready to be linked.
    Installed,
    /// To be built, from here if cargo does not know by itself.
    Sources(Option<PathBuf>),
}

/// Finds the standard library, and fetches its sources where there is nothing at all.
pub(super) fn library(folders: &Folders, target: &str) -> Result<Library> {
    let sysroot = said("rustc", &["--print", "sysroot"])?;
    let rustlib = Path::new(&sysroot).join("lib/rustlib");
    if rustlib.join(target).join("lib").is_dir() {
        return Ok(Library::Installed);
    }
    println!("the toolchain has no standard library for {target}; building it");
    if rustlib.join("src/rust/library/Cargo.lock").is_file() {
        return Ok(Library::Sources(None));
    }
    let about = said("rustc", &["-vV"])?;
    let release = about
        .lines()
        .find_map(|line| line.strip_prefix("release: "))
        .ok_or("`rustc -vV` does not name its release; update Rust")?;
    let kept = folders.target.join(format!("library-{release}"));
    if !kept.join("Cargo.lock").is_file() {
        fetch(folders, release, &kept).map_err(|problem| {
            format!(
                "{problem}; alternatively, run `rustup target add {target}` or `rustup component add {PACKAGE}`"
            )
        })?;
    }
    Ok(Library::Sources(Some(kept)))
}

fn said(program: &str, arguments: &[&str]) -> Result<String> {
    let text = output(Command::new(program).args(arguments).current_dir(root()))?;
    Ok(String::from_utf8_lossy(&text).trim().to_owned())
}

/// Fetches the sources of a release from the Debian mirror that this machine uses, checked by its keys. Nothing is installed.
fn fetch(folders: &Folders, release: &str, kept: &Path) -> Result {
    if !succeeds("apt-get", &["--version"]) || !succeeds("dpkg-deb", &["--version"]) {
        return Err("apt-get was not found, which is needed to fetch its sources".into());
    }
    let sources = sources().ok_or("the apt sources list no Debian archive")?;
    let apt = folders.target.join("apt");
    for folder in ["parts", "lists/partial", "cache/archives/partial"] {
        make_folder(&apt.join(folder))?;
    }
    let list = apt.join("parts/backports.sources");
    fs::write(&list, sources)
        .map_err(|error| format!("`{}` cannot be written: {error}", list.display()))?;
    println!("fetching {PACKAGE} {release}");
    run(apt_get(&apt).arg("update"))?;
    let package = format!("{PACKAGE}={release}*");
    run(apt_get(&apt).args(["download", &package]).current_dir(&apt))
        .map_err(|error| format!("{error}: {SUITE} may not have {PACKAGE} {release}"))?;
    let package = downloaded(&apt)?;
    let unpacked = unpack(&package, &apt);
    // The packed sources are not needed again.
    let _ = fs::remove_file(&package);
    unpacked?;
    let library = apt.join(format!("unpacked/usr/src/rustc-{release}/library"));
    fs::rename(&library, kept)
        .map_err(|error| format!("`{}` cannot be moved: {error}", library.display()))
}

/// apt-get with lists and a cache of its own, so that the machine's stay as they are.
fn apt_get(apt: &Path) -> Command {
    let mut command = Command::new("apt-get");
    command.args(["--quiet", "-o", "Dir::Etc::SourceList=/dev/null"]);
    for (key, folder) in [
        ("Dir::Etc::SourceParts", "parts"),
        ("Dir::State::Lists", "lists"),
        ("Dir::Cache", "cache"),
    ] {
        let value = format!("{key}={}", apt.join(folder).display());
        command.args(["-o", &value]);
    }
    // Else apt would fetch as a user who may not write here.
    command.args(["-o", "APT::Sandbox::User=root"]);
    command
}

fn downloaded(apt: &Path) -> Result<PathBuf> {
    let files = fs::read_dir(apt).map_err(|error| format!("`{}`: {error}", apt.display()))?;
    let mut packages = files
        .filter_map(|file| Some(file.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "deb"));
    packages
        .next()
        .ok_or_else(|| format!("apt-get downloaded no package into `{}`", apt.display()))
}

/// Unpacks the library's part of a package.
fn unpack(package: &Path, apt: &Path) -> Result {
    let to = apt.join("unpacked");
    make_folder(&to)?;
    let mut packed = Command::new("dpkg-deb")
        .arg("--fsys-tarfile")
        .arg(package)
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("dpkg-deb could not be run: {error}"))?;
    let mut tar = Command::new("tar");
    tar.arg("-C")
        .arg(&to)
        .args(["-x", "--wildcards", "./usr/src/rustc-*/library/*"]);
    if let Some(stream) = packed.stdout.take() {
        tar.stdin(stream);
    }
    let unpacked = run(&mut tar);
    let status = packed
        .wait()
        .map_err(|error| format!("dpkg-deb failed: {error}"))?;
    unpacked?;
    match status.success() {
        true => Ok(()),
        false => Err(format!("`{}` cannot be unpacked", package.display())),
    }
}

/// Apt's sources for the suite: where this machine has its Debian from, with the keys it checks that with.
fn sources() -> Option<String> {
    let mut files: Vec<PathBuf> = fs::read_dir("/etc/apt/sources.list.d")
        .into_iter()
        .flatten()
        .filter_map(|file| Some(file.ok()?.path()))
        .collect();
    files.sort();
    files.push("/etc/apt/sources.list".into());
    files
        .iter()
        .filter_map(|file| fs::read_to_string(file).ok())
        .find_map(|text| of_stanzas(&text).or_else(|| of_lines(&text)))
}

/// Reads a file of stanzas (`URIs: …`).
fn of_stanzas(text: &str) -> Option<String> {
    text.split("\n\n").find_map(|stanza| {
        let field = |name: &str| {
            let lines = stanza.lines();
            lines
                .filter_map(|line| line.split_once(':'))
                .find(|(key, _)| key.eq_ignore_ascii_case(name))
                .map(|(_, value)| value.trim().to_owned())
        };
        let uris = field("URIs")?;
        let uri = uris.split_whitespace().find(|uri| is_archive(uri))?;
        Some(stanza_of(uri, field("Signed-By").as_deref()))
    })
}

/// Reads a file of lines (`deb [options] URI suite components`).
fn of_lines(text: &str) -> Option<String> {
    text.lines().find_map(|line| {
        let rest = line.trim().strip_prefix("deb ")?.trim();
        let (options, rest) = match rest.strip_prefix('[') {
            Some(rest) => rest.split_once(']')?,
            None => ("", rest),
        };
        let uri = rest
            .split_whitespace()
            .next()
            .filter(|uri| is_archive(uri))?;
        let keys = options
            .split_whitespace()
            .find_map(|option| option.strip_prefix("signed-by="));
        Some(stanza_of(uri, keys))
    })
}

fn is_archive(uri: &str) -> bool {
    uri.contains("://") && uri.trim_end_matches('/').ends_with(ARCHIVE)
}

fn stanza_of(uri: &str, keys: Option<&str>) -> String {
    let keys = keys.map_or(String::new(), |keys| format!("Signed-By: {keys}\n"));
    format!("Types: deb\nURIs: {uri}\nSuites: {SUITE}\nComponents: main\n{keys}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_debian_archive_is_found_in_stanzas_and_lines_and_nothing_else_is() {
        let wanted = "Types: deb\nURIs: http://mirror.example/debian\nSuites: trixie-backports\nComponents: main\n\
                      Signed-By: /keys.gpg\n";
        let stanzas = "# Tools\nTypes: deb\nURIs: https://tools.example/apt\nSuites: stable\n\n\
                       Types: deb\nURIs: http://mirror.example/debian\nSuites: stable\nSigned-By: /keys.gpg\n";
        assert_eq!(of_stanzas(stanzas).as_deref(), Some(wanted));
        let lines = "deb https://tools.example/apt stable main\n\
                     deb [arch=amd64 signed-by=/keys.gpg] http://mirror.example/debian stable main\n";
        assert_eq!(of_lines(lines).as_deref(), Some(wanted));
        let plain = of_lines("deb http://mirror.example/debian/ stable main\n").unwrap();
        assert!(!plain.contains("Signed-By"), "{plain}");
        assert_eq!(
            of_lines("# deb http://mirror.example/debian stable main\n"),
            None
        );
        assert_eq!(
            of_stanzas("URIs: http://mirror.example/debian-security\n"),
            None
        );
    }
}
