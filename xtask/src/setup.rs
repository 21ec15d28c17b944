//! System packages: the pictures need a Vulkan driver, the viewer's test a display, fuzzing a C++ compiler, counting instructions
//! valgrind, the test of the page a browser, and the wheel Python; nothing else is needed beyond a C linker.

use std::path::Path;
use std::process::Command;

use crate::command::{run, succeeds};

/// Software Vulkan: draws the pictures on machines without a graphics card.
const DRIVER: &str = "mesa-vulkan-drivers";
/// A display without a screen, and the parts of X that a window needs: the viewer is tested on it.
const DISPLAY: [&str; 7] = [
    "xvfb",
    "libx11-6",
    "libx11-xcb1",
    "libxcursor1",
    "libxi6",
    "libxkbcommon0",
    "libxkbcommon-x11-0",
];
/// Compiles libFuzzer, which comes as C++.
const COMPILER: &str = "g++";
/// Counts instructions.
const COUNTER: &str = "valgrind";
/// Browser that shows the page in its test, and the test's runner.
const BROWSER: &str = "chromium";
const NODE: [&str; 2] = ["nodejs", "npm"];
/// Makes the environment in which the wheel is built and tried.
const PYTHON: [&str; 2] = ["python3", "python3-venv"];
/// Folders in which Vulkan drivers register on Linux.
const DRIVER_FOLDERS: [&str; 3] = [
    "/usr/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
];

/// Installs missing things where that is possible; otherwise names them and says how to get them. Never fails: most tests need no picture, and those
/// that do say so themselves.
pub(crate) fn setup() {
    if !succeeds("cargo", &["nextest", "--version"]) {
        println!(
            "note: `cargo xtask test --fast` needs cargo-nextest; install it with `cargo install cargo-nextest --locked`"
        );
    }
    if !cfg!(target_os = "linux") {
        return;
    }
    if !has_vulkan_driver() {
        let advice = format!(
            "no Vulkan driver was found, so pictures cannot be drawn: install `{DRIVER}` (Debian, Ubuntu: `sudo apt-get install {DRIVER}`)"
        );
        install(&[DRIVER], &advice);
    }
    if !succeeds("Xvfb", &["-help"]) {
        let packages = DISPLAY.join(" ");
        let advice = format!(
            "Xvfb is missing, so the viewer's window is not tested: install `xvfb` (Debian, Ubuntu: `sudo apt-get install {packages}`)"
        );
        install(&DISPLAY, &advice);
    }
}

/// True if there is a C++ compiler, which is installed where it is missing and that is possible.
pub(crate) fn cpp_compiler() -> bool {
    let there = || std::env::var_os("CXX").is_some() || succeeds("c++", &["--version"]);
    if !there() && cfg!(target_os = "linux") {
        install(
            &[COMPILER],
            &format!("fuzzing needs a C++ compiler: install `{COMPILER}`"),
        );
    }
    there()
}

/// True if there is valgrind, which is installed where it is missing and that is possible.
pub(crate) fn valgrind() -> bool {
    let there = || succeeds(COUNTER, &["--version"]);
    if !there() && cfg!(target_os = "linux") {
        install(
            &[COUNTER],
            &format!("counting instructions needs `{COUNTER}`: install it"),
        );
    }
    there()
}

/// Name of the browser's program, if there is Node with npm; missing things are installed where that is possible.
pub(crate) fn browser() -> Option<&'static str> {
    const NAMES: [&str; 4] = [BROWSER, "chromium-browser", "google-chrome", "chrome"];
    let found = || {
        let mut names = NAMES.into_iter();
        names.find(|name| succeeds(name, &["--version"]))
    };
    let node = || succeeds("node", &["--version"]) && succeeds("npm", &["--version"]);
    if cfg!(target_os = "linux") {
        if found().is_none() {
            install(
                &[BROWSER],
                &format!("the page's test needs `{BROWSER}`: install it"),
            );
        }
        if !node() {
            let advice = "the page's test needs Node 20 and npm: install them";
            install(&NODE, advice);
        }
    }
    found().filter(|_| node())
}

/// A Python of 3.10 or later that can make environments, which is installed where it is missing and that is possible.
pub(crate) fn python() -> Option<&'static str> {
    const QUESTION: &str = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))";
    let found = || {
        let mut names = ["python3", "python"].into_iter();
        names.find(|name| succeeds(name, &["-c", QUESTION]))
    };
    if found().is_none() && cfg!(target_os = "linux") {
        install(&PYTHON, "the wheel needs Python 3.10 or later with `venv`");
    }
    found()
}

/// Installs Debian packages; where that cannot be, prints the advice.
fn install(packages: &[&str], advice: &str) {
    if !succeeds("apt-get", &["--version"]) {
        println!("note: {advice}, or your distribution's counterpart");
        return;
    }
    let Some(prefix) = privileges() else {
        println!("note: {advice}");
        return;
    };
    println!("installing {}", packages.join(" "));
    let words = [&["install", "--yes", "--no-install-recommends"], packages].concat();
    if !(apt(prefix, &words) || apt(prefix, &["update"]) && apt(prefix, &words)) {
        println!("note: the installation failed; {advice}");
    }
}

fn has_vulkan_driver() -> bool {
    if std::env::var_os("VK_ICD_FILENAMES").is_some()
        || std::env::var_os("VK_DRIVER_FILES").is_some()
    {
        return true;
    }
    DRIVER_FOLDERS.iter().any(|folder| {
        Path::new(folder).read_dir().is_ok_and(|mut files| {
            files.any(|file| {
                file.is_ok_and(|file| file.path().extension().is_some_and(|e| e == "json"))
            })
        })
    })
}

/// Words to put before a command that needs root: nothing for root itself, else a sudo that asks no password. None if neither works.
fn privileges() -> Option<&'static [&'static str]> {
    let root = Command::new("id")
        .arg("-u")
        .output()
        .is_ok_and(|id| id.stdout.trim_ascii() == b"0");
    if root {
        Some(&[])
    } else if succeeds("sudo", &["-n", "true"]) {
        Some(&["sudo", "-n"])
    } else {
        None
    }
}

fn apt(prefix: &[&str], arguments: &[&str]) -> bool {
    let words: Vec<&str> = [
        prefix,
        &[
            "env",
            "DEBIAN_FRONTEND=noninteractive",
            "apt-get",
            "--quiet",
        ],
        arguments,
    ]
    .concat();
    run(Command::new(words[0]).args(&words[1..])).is_ok()
}
