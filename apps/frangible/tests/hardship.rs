//! The program is killed, has no room on the disk, or meets itself: files are whole or absent.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, text};

/// Kills, at moments from the beginning of a run to its end. `FRANGIBLE_KILLS` asks for more.
const KILLS: u32 = 12;

/// The end of the names of files that are being written.
const PART: &str = ".part";

/// Half a second of a bar that falls and breaks.
const BAR: &str = r#"
name = "bar"
duration = 0.5

[[body]]
name = "bar"
shape = { box = [0.16, 0.02, 0.01] }
material = "porcelain"
modes = 20
resolution = 2000
drop = 1.0
spin = [0, 0, 1]
"#;

/// Arguments that break the bar.
fn body(folder: &Folder) -> Vec<String> {
    let path = folder.0.join("bar.toml");
    fs::write(&path, BAR).expect("a scene file");
    let file = path.to_string_lossy().into_owned();
    vec!["break".into(), file, "--no-pictures".into()]
}

fn begin(args: &[String], out: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frangible"));
    command.args(args).arg("--out").arg(out);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the program starts")
}

/// The files of a folder under their final names.
fn finished(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let Ok(entries) = fs::read_dir(folder) else {
        return BTreeMap::new();
    };
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let named = paths.map(|path| {
        let name = path.file_name().expect("a name").to_string_lossy();
        (name.into_owned(), path)
    });
    named
        .filter(|(name, _)| !name.ends_with(PART))
        .map(|(name, path)| (name, fs::read(path).expect("a file")))
        .collect()
}

/// Runs the program undisturbed. Returns the files that it writes, and the time that it takes.
fn undisturbed(args: &[String], out: &Path) -> (BTreeMap<String, Vec<u8>>, Duration) {
    let clock = Instant::now();
    let status = begin(args, out).wait().expect("the program ends");
    let time = clock.elapsed();
    assert!(status.success());
    let files = finished(out);
    assert_eq!(files.keys().collect::<Vec<_>>(), ["bar.glb", "bar.wav"]);
    (files, time)
}

#[test]
fn a_kill_at_any_moment_leaves_whole_files_or_none() {
    let folder = Folder::new("killed");
    let args = body(&folder);
    let (whole, time) = undisturbed(&args, &folder.0.join("whole"));
    let kills = std::env::var("FRANGIBLE_KILLS").ok();
    let kills = kills.map_or(KILLS, |n| n.parse().expect("a number of kills"));
    let out = folder.0.join("killed");
    for kill in 0..kills {
        let mut child = begin(&args, &out);
        // Most of them towards the end, where it writes.
        let left = 1.0 - f64::from(kill) / f64::from(kills);
        std::thread::sleep(time.mul_f64(1.0 - left * left));
        child.kill().expect("a kill");
        child.wait().expect("an end");
        for (name, bytes) in finished(&out) {
            assert!(whole.get(&name) == Some(&bytes), "kill {kill}: {name}");
        }
    }
    let (again, _) = undisturbed(&args, &out);
    assert!(again == whole, "a run after the kills");
}

#[test]
fn two_runs_into_one_folder_leave_whole_files() {
    let folder = Folder::new("killed-twice");
    let args = body(&folder);
    let (whole, _) = undisturbed(&args, &folder.0.join("whole"));
    let out = folder.0.join("shared");
    let runs = [0, 1, 2].map(|_| begin(&args, &out));
    for mut run in runs {
        assert!(run.wait().expect("an end").success());
    }
    assert!(finished(&out) == whole);
}

#[test]
fn a_disk_without_room_is_told_and_what_was_there_stays() {
    let folder = Folder::new("full");
    let args = body(&folder);
    let out = folder.0.join("out");
    let (whole, _) = undisturbed(&args, &out);
    // No file may grow beyond a few kilobytes, which a program meets as it meets a full disk: the write fails.
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\""])
        .arg(env!("CARGO_BIN_EXE_frangible"))
        .args(&args)
        .args(["--seed", "2", "--out"])
        .arg(&out)
        .output()
        .expect("the program starts");
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("bar.glb"), "{message}");
    let names = fs::read_dir(&out).expect("a folder").count();
    assert_eq!(names, whole.len(), "nothing half-written is left");
    assert!(finished(&out) == whole, "what was there before stays");
}
