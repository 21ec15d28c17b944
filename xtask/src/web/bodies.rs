//! The scenes that the page offers, and their baked bodies.

use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::{Folders, make_folder, size_of};
use crate::command::{Result, announced, cargo, target};

/// The one that the page opens with.
pub(super) const FIRST: &str = "pane";

/// Folder of the bodies within the page's folder.
const FOLDER: &str = "bodies";

/// Baked bodies of all scenes.
pub(super) struct Bodies {
    /// Entry of each scene in the page's list: its text, the packed files of its bodies with their sizes, and which is whose.
    pub(super) list: serde_json::Map<String, Value>,
    /// Folder of the bodies as they were baked.
    pub(super) kept: PathBuf,
}

/// Bakes and packs them.
pub(super) fn bodies(folders: &Folders, packer: &Path) -> Result<Bodies> {
    let baker = example("bodies")?;
    let out = folders.out.join(FOLDER);
    make_folder(&out)?;
    let kept = folders.target.join(FOLDER).join("baked");
    make_folder(&kept)?;
    let list = kept.join("list.json");
    // The bake of another program may be another body.
    let (stamp, hash) = (kept.join("baker"), hash_of(&baker)?);
    if fs::read_to_string(&stamp).is_ok_and(|known| known == hash) && list.is_file() {
        println!("the bodies are baked already");
    } else {
        announced(Command::new(&baker).arg(&kept))?;
        fs::write(&stamp, hash)
            .map_err(|error| format!("`{}` cannot be written: {error}", stamp.display()))?;
    }
    let text = fs::read_to_string(&list)
        .map_err(|error| format!("`{}` cannot be read: {error}", list.display()))?;
    let baked: Vec<Value> = serde_json::from_str(&text)
        .map_err(|error| format!("`{}` is damaged: {error}; delete it", list.display()))?;
    clear(&out)?;
    let mut list = serde_json::Map::new();
    for scene in baked {
        let name = scene["scene"].as_str().unwrap_or_default();
        let files = scene["files"].as_array().into_iter().flatten();
        let mut packed = Vec::new();
        for file in files.filter_map(Value::as_str) {
            packed.push(pack(&kept.join(file), &out, packer)?);
        }
        let bodies = serde_json::json!({ "files": packed, "of": scene["of"] });
        let about = serde_json::json!({ "text": scene["text"], "bodies": bodies });
        list.insert(name.into(), about);
    }
    Ok(Bodies { list, kept })
}

/// Packs a body, unless one of these bytes was packed before, and puts it into the page's folder; its name there and its size.
fn pack(body: &Path, out: &Path, packer: &Path) -> Result<Value> {
    let (packed, stamp) = (body.with_extension("gz"), body.with_extension("packed"));
    let hash = hash_of(body)?;
    if !fs::read_to_string(&stamp).is_ok_and(|known| known == hash) {
        announced(Command::new(packer).arg("body").arg(body).arg(&packed))?;
        fs::write(&stamp, hash)
            .map_err(|error| format!("`{}` cannot be written: {error}", stamp.display()))?;
    }
    let name = packed.file_name().unwrap_or_default();
    let to = out.join(name);
    fs::copy(&packed, &to)
        .map_err(|error| format!("`{}` cannot be written: {error}", to.display()))?;
    let name = format!("{FOLDER}/{}", name.to_string_lossy());
    Ok(serde_json::json!({ "name": name, "size": size_of(&to)? }))
}

/// Removes the packed bodies of a page that was made before.
fn clear(out: &Path) -> Result {
    let failed = |error: std::io::Error| format!("`{}` cannot be emptied: {error}", out.display());
    for entry in fs::read_dir(out).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|ending| ending == "gz") {
            fs::remove_file(path).map_err(failed)?;
        }
    }
    Ok(())
}

/// Builds one of the examples of the session's program, for this machine.
pub(super) fn example(name: &str) -> Result<PathBuf> {
    let arguments = ["build", "--release", "-p", "frangible-web-session"];
    announced(cargo(&arguments).args(["--example", name]))?;
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    Ok(target().join("release/examples").join(file))
}

fn hash_of(file: &Path) -> Result<String> {
    let bytes =
        fs::read(file).map_err(|error| format!("`{}` cannot be read: {error}", file.display()))?;
    let mut hasher = DefaultHasher::new();
    hasher.write(&bytes);
    Ok(format!("{:016x}", hasher.finish()))
}
