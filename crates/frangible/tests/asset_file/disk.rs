//! Files on the disk.

use super::*;

/// A folder of this test's own, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join("frangible")
            .join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn what_was_saved_is_loaded() {
    let folder = Folder::new("saved");
    let path = folder.0.join("vase.frangible");
    let asset = tiny();
    asset.save(&path).unwrap();
    assert!(same(&asset, &Asset::load(&path).unwrap()));
    // Over an older file, too.
    let renamed = Asset::from_parts(AssetParts {
        name: "another".into(),
        ..asset.into_parts()
    });
    renamed.save(&path).unwrap();
    assert_eq!(Asset::load(&path).unwrap().name(), "another");
    assert_eq!(folder.names(), ["vase.frangible"]);
}

#[test]
fn a_failed_save_names_the_path_and_leaves_what_was_there() {
    let folder = Folder::new("failed");
    let asset = tiny();
    let occupied = folder.0.join("folder.frangible");
    fs::create_dir(&occupied).unwrap();
    fs::write(occupied.join("inside"), "kept").unwrap();
    for path in [
        occupied,
        folder.0.join("missing/vase.frangible"),
        folder.0.join(".."),
    ] {
        let error = asset.save(&path).unwrap_err();
        assert!(
            matches!(&error, AssetFileError::Io { path: p, .. } if *p == path),
            "{error}"
        );
    }
    assert_eq!(folder.names(), ["folder.frangible"]);
    let good = folder.0.join("good.frangible");
    asset.save(&good).unwrap();
    let mut unsound = asset.clone();
    unsound.parts_mut().mass.mass = f64::NAN;
    let error = unsound.save(&good).unwrap_err().to_string();
    assert!(
        error.contains("good.frangible") && error.contains("mass"),
        "{error}"
    );
    assert!(same(&asset, &Asset::load(&good).unwrap()));
}

#[test]
fn a_failed_load_names_the_path() {
    let folder = Folder::new("unloadable");
    let mesh = folder.0.join("vase.obj");
    fs::write(&mesh, "v 0 0 0\n").unwrap();
    let error = Asset::load(&mesh).unwrap_err().to_string();
    assert!(
        error.contains("vase.obj") && error.contains("OBJ mesh"),
        "{error}"
    );
    for path in [folder.0.join("none.frangible"), folder.0.clone()] {
        let error = Asset::load(&path).unwrap_err();
        assert!(
            matches!(&error, AssetFileError::Io { path: p, .. } if *p == path),
            "{error}"
        );
    }
}
