//! Files are whole or absent.

use std::fs;
use std::path::PathBuf;

use frangible_recording::write_atomically;

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn names(folder: &PathBuf) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_replaced_and_nothing_else_is_left() {
    let folder = folder("replaced");
    let path = folder.join("break.glb");
    write_atomically(&path, b"first").unwrap();
    write_atomically(&path, b"second").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"second");
    assert_eq!(names(&folder), ["break.glb"]);
}

#[test]
fn a_failure_names_the_path_and_leaves_no_part() {
    let folder = folder("failed");
    // A folder stands where the file should go, so the renaming fails.
    let path = folder.join("taken");
    fs::create_dir(&path).unwrap();
    fs::write(path.join("inside"), b"").unwrap();
    let message = write_atomically(&path, b"bytes").unwrap_err().to_string();
    assert!(
        message.contains("taken") && message.contains("writable"),
        "{message}"
    );
    assert_eq!(names(&folder), ["taken"]);

    let missing = folder.join("no such folder").join("break.glb");
    let message = write_atomically(&missing, b"bytes")
        .unwrap_err()
        .to_string();
    assert!(message.contains("no such folder"), "{message}");
}
