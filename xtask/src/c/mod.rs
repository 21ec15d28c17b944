//! The library for C and C++: its header, made by cbindgen and checked in; the shared and the static library, installed in a folder with files for
//! pkg-config and CMake; and programs that are compiled against that folder and run.

mod bullet;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{
    Result, announced, cargo, copy, output, read, root, shown, skipped, succeeds, target,
};

/// The cbindgen that the header is made with.
const CBINDGEN_VERSION: &str = "0.29.4";
/// Prefix of every name that the shared library exports.
const PREFIX: &str = "frangible_";
/// Strict C99.
const C_FLAGS: [&str; 5] = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];
/// Ends a program at the first read or write outside of its memory, and at the first undefined operation.
const SANITIZERS: &str = "-fsanitize=address,undefined";
/// A baked body that the repository has.
const PANE: &str = "crates/frangible/tests/bodies/pane.frangible";

/// What is wanted besides the installed library.
#[derive(PartialEq)]
pub(crate) enum Wish {
    /// All trials, with the header that is checked in.
    Try,
    /// All trials, with a new header.
    Header,
    /// The section of docs/engines.md.
    Engines,
}

/// Builds and installs the library in `target/c/install`, does what is wanted, and returns the lines that sum it up.
pub(crate) fn library(wish: &Wish) -> Result<Vec<String>> {
    let folder = target().join("c");
    fs::create_dir_all(&folder)
        .map_err(|error| format!("`{}` cannot be made: {error}", folder.display()))?;
    header(&folder, wish)?;
    let built = Built::new()?;
    let prefix = folder.join("install");
    built.install(&prefix)?;
    if *wish == Wish::Engines {
        return bullet::section(&folder, &prefix);
    }
    let mut lines = built.about(&prefix)?;
    lines.extend(c_programs(&folder, &prefix)?);
    lines.extend(with_cmake(&folder, &prefix)?);
    lines.extend(bullet::example(&folder, &prefix)?);
    Ok(lines)
}

/// Makes the header, and compares the one that is checked in, or writes it.
fn header(folder: &Path, wish: &Wish) -> Result {
    let version = output(&mut cbindgen(&["--version"])).unwrap_or_default();
    if !String::from_utf8_lossy(&version).contains(CBINDGEN_VERSION) {
        let install = ["install", "cbindgen", "--locked", "--version"];
        announced(cargo(&install).arg(CBINDGEN_VERSION))?;
    }
    let (here, made) = (root().join("apps/c"), folder.join("frangible.h"));
    let kept = here.join("include/frangible.h");
    let mut make = cbindgen(&["--quiet", "--config", "cbindgen.toml", "--output"]);
    announced(make.arg(&made).arg(".").current_dir(&here))?;
    if *wish == Wish::Header {
        return copy(&made, &kept);
    }
    if read(&made)? == read(&kept)? {
        return Ok(());
    }
    Err(
        "apps/c/include/frangible.h is not what cbindgen makes of the code; run `cargo xtask c --write`"
            .into(),
    )
}

fn cbindgen(words: &[&str]) -> Command {
    let mut command = Command::new("cbindgen");
    command.args(words);
    command
}

/// The libraries that cargo has built.
struct Built {
    shared: PathBuf,
    archive: PathBuf,
    /// What a program needs besides the static library, as words for a linker.
    private: String,
}

impl Built {
    fn new() -> Result<Self> {
        let mut build = cargo(&["rustc", "--release", "--package=frangible-c", "--lib"]);
        build.args(["--crate-type=cdylib,staticlib", "--"]);
        // Else a program remembers the name of the file that it was linked with, or its whole path.
        if cfg!(target_os = "linux") {
            build.args(["-C", "link-arg=-Wl,-soname,libfrangible.so"]);
        } else if cfg!(target_os = "macos") {
            build.args(["-C", "link-arg=-Wl,-install_name,@rpath/libfrangible.dylib"]);
        }
        announced(&mut build)?;
        let names = match std::env::consts::OS {
            "windows" => ["frangible_c.dll", "frangible_c.lib"],
            "macos" => ["libfrangible_c.dylib", "libfrangible_c.a"],
            _ => ["libfrangible_c.so", "libfrangible_c.a"],
        };
        let [shared, archive] = names.map(|name| target().join("release").join(name));
        Ok(Self {
            shared,
            archive,
            private: private()?,
        })
    }

    /// Name of a library's file where it is installed.
    fn name(path: &Path) -> String {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.replace("frangible_c", "frangible")
    }

    fn install(&self, prefix: &Path) -> Result {
        if prefix.exists() {
            fs::remove_dir_all(prefix)
                .map_err(|error| format!("`{}` cannot be emptied: {error}", prefix.display()))?;
        }
        let from = root().join("apps/c");
        copy(&from.join("include"), &prefix.join("include"))?;
        for library in [&self.shared, &self.archive] {
            copy(library, &prefix.join("lib").join(Self::name(library)))?;
        }
        for (name, to) in [
            ("frangible.pc", "lib/pkgconfig"),
            ("FrangibleConfig.cmake", "lib/cmake/Frangible"),
            ("FrangibleConfigVersion.cmake", "lib/cmake/Frangible"),
        ] {
            let text = self.filled(&read(&from.join("install").join(name))?);
            let to = prefix.join(to);
            fs::create_dir_all(&to)
                .and_then(|()| fs::write(to.join(name), text))
                .map_err(|error| format!("`{name}` cannot be written: {error}"))?;
        }
        Ok(())
    }

    /// A template with its words filled in.
    fn filled(&self, template: &[u8]) -> String {
        let version = env!("CARGO_PKG_VERSION");
        let line = version.rsplit_once('.').map_or(version, |(line, _)| line);
        let mut text = String::from_utf8_lossy(template).into_owned();
        for (word, value) in [
            ("@version@", version),
            ("@line@", line),
            ("@private@", &self.private),
            ("@shared@", &Self::name(&self.shared)),
            ("@static@", &Self::name(&self.archive)),
        ] {
            text = text.replace(word, value);
        }
        text
    }

    /// The size and the names of the shared library, which all have the prefix.
    fn about(&self, prefix: &Path) -> Result<Vec<String>> {
        let name = Self::name(&self.shared);
        let library = prefix.join("lib").join(&name);
        let size = fs::metadata(&library).map_or(0, |data| data.len());
        let size = size as f64 / 1e6;
        if !succeeds("nm", &["--version"]) || !cfg!(target_os = "linux") {
            let why = "the exported names are read with `nm` of the GNU binutils, on Linux";
            return skipped("c: exported names", why);
        }
        let mut nm = Command::new("nm");
        nm.args(["-D", "--defined-only"]).arg(&library);
        println!("$ {}", shown(&nm));
        let listed = output(&mut nm)?;
        let listed = String::from_utf8_lossy(&listed);
        let names: Vec<&str> = listed
            .lines()
            .filter_map(|line| line.rsplit(' ').next())
            .collect();
        match names.iter().find(|name| !name.starts_with(PREFIX)) {
            Some(other) => Err(format!(
                "{name} exports `{other}`, whose name does not begin with {PREFIX}"
            )),
            None => Ok(vec![format!(
                "c: {name} has {size:.1} MB and exports {} names, all of them {PREFIX}*",
                names.len()
            )]),
        }
    }
}

/// The system's libraries that the static one needs, as the compiler names them.
fn private() -> Result<String> {
    let mut ask = Command::new("rustc");
    ask.args(["--crate-type=staticlib", "--print=native-static-libs", "-"]);
    ask.arg("--out-dir").arg(target().join("c"));
    ask.stdin(std::process::Stdio::null()).current_dir(root());
    let said = ask
        .output()
        .map_err(|error| format!("`{}` could not be run: {error}", shown(&ask)))?;
    let said = String::from_utf8_lossy(&said.stderr).into_owned();
    let words = said
        .lines()
        .find_map(|line| line.split_once("native-static-libs: "));
    let (_, words) = words.ok_or("rustc does not name the libraries that a static one needs")?;
    Ok(words.trim().to_owned())
}

/// A compiler that the environment names, or the usual one.
fn compiler(variable: &str, usual: &str) -> Command {
    Command::new(std::env::var_os(variable).unwrap_or_else(|| usual.into()))
}

/// What pkg-config says of these packages.
fn packages(prefix: &Path, words: &[&str]) -> Result<Vec<String>> {
    let mut ask = Command::new("pkg-config");
    ask.args(words);
    ask.env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig"));
    println!("$ {}", shown(&ask));
    let said = output(&mut ask)?;
    let said = String::from_utf8_lossy(&said);
    Ok(said.split_whitespace().map(str::to_owned).collect())
}

/// Compiles the small program against the shared library, the static one, and with sanitizers, and runs it.
fn c_programs(folder: &Path, prefix: &Path) -> Result<Vec<String>> {
    if !succeeds("pkg-config", &["--version"]) {
        return skipped("c: programs", "pkg-config is not installed");
    }
    let source = root().join("apps/c/examples/minimal.c");
    let place = format!("-Wl,-rpath,{}", prefix.join("lib").display());
    let mut lines = Vec::new();
    let shared = packages(prefix, &["--cflags", "--libs", "frangible"])?;
    let mut linked_in = packages(prefix, &["--cflags", "--libs", "--static", "frangible"])?;
    for word in &mut linked_in {
        if word == "-lfrangible" {
            *word = prefix.join("lib/libfrangible.a").display().to_string();
        }
    }
    for (name, flags, libraries) in [
        ("minimal", &[][..], &shared),
        ("minimal-static", &[], &linked_in),
        ("minimal-sanitized", &["-g", SANITIZERS], &shared),
    ] {
        let program = folder.join(name);
        let mut compile = compiler("CC", "cc");
        compile.args(C_FLAGS).args(flags).arg(&source);
        compile.args(libraries).arg(&place).arg("-o").arg(&program);
        announced(&mut compile)?;
        announced(Command::new(&program).arg(root().join(PANE)))?;
        lines.push(format!("c: {name} compiled and ran"));
    }
    Ok(lines)
}

/// Builds the same program with CMake, and runs it.
fn with_cmake(folder: &Path, prefix: &Path) -> Result<Vec<String>> {
    if !succeeds("cmake", &["--version"]) {
        return skipped("c: CMake", "it is not installed");
    }
    let build = folder.join("cmake");
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(root().join("apps/c/examples"));
    configure.arg("-B").arg(&build);
    configure.arg(format!("-DCMAKE_PREFIX_PATH={}", prefix.display()));
    configure.arg("--log-level=WARNING");
    announced(&mut configure)?;
    announced(Command::new("cmake").arg("--build").arg(&build))?;
    for name in ["minimal", "minimal_static"] {
        announced(Command::new(build.join(name)).arg(root().join(PANE)))?;
    }
    Ok(vec!["c: found by CMake, and ran".into()])
}
