//! Baked bodies of the scenes that the page offers.

use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use super::program::within;
use super::{Clock, Folders, make_folder};
use crate::command::{Result, cargo, output, program, run};

/// A scene that the page offers, of one body.
struct Light {
    scene: &'static str,
    /// Vibration modes and tetrahedra of its body: fewer than the scene has, so that it is fetched in no time.
    modes: u32,
    tetrahedra: u32,
    /// Whether half precision serves: where walls are thin it does not, as `frangible bake --compact` says.
    compact: bool,
}

/// The one that the page opens with first.
const SCENES: [Light; 2] = [
    Light {
        scene: "pane",
        modes: 20,
        tetrahedra: 10_000,
        compact: false,
    },
    Light {
        scene: "brick",
        modes: 14,
        tetrahedra: 5_000,
        compact: true,
    },
];

/// A scene in the page's folder.
pub(super) struct Packed {
    pub(super) scene: &'static str,
    /// The scene, TOML.
    pub(super) text: String,
    /// The scene as a file.
    pub(super) toml: PathBuf,
    /// The packed body, in the page's folder.
    pub(super) file: String,
}

/// Bakes and packs them.
pub(super) fn bodies(folders: &Folders, packer: &Path, clock: Clock) -> Result<Vec<Packed>> {
    let program = frangible(clock)?;
    make_folder(&folders.out.join("bodies"))?;
    // What another program baked may be another body.
    let kept = folders.target.join("bodies").join(hash_of(&program)?);
    make_folder(&kept)?;
    SCENES
        .iter()
        .map(|light| {
            let text = light.text(&program)?;
            let name = format!("{}-{}-{}", light.scene, light.modes, light.tetrahedra);
            let toml = kept.join(format!("{name}.toml"));
            fs::write(&toml, &text)
                .map_err(|error| format!("`{}` cannot be written: {error}", toml.display()))?;
            let body = kept.join(format!("{name}.frangible"));
            if !body.is_file() {
                light.bake(&program, &toml, &body, clock)?;
            }
            let packed = format!("bodies/{}.gz", light.scene);
            run(Command::new(packer)
                .arg("body")
                .arg(&body)
                .arg(folders.out.join(&packed)))?;
            Ok(Packed {
                scene: light.scene,
                text,
                toml,
                file: packed,
            })
        })
        .collect()
}

impl Light {
    /// The scene with a lighter body, TOML.
    fn text(&self, program: &Path) -> Result<String> {
        let text = output(Command::new(program).args(["scenes", self.scene]))?;
        let text = String::from_utf8_lossy(&text);
        let lines = text.lines().map(|line| {
            if line.starts_with("modes = ") {
                format!("modes = {}\nresolution = {}\n", self.modes, self.tetrahedra)
            } else {
                format!("{line}\n")
            }
        });
        Ok(lines.collect())
    }

    fn bake(&self, program: &Path, scene: &Path, body: &Path, clock: Clock) -> Result {
        let mut command = Command::new(program);
        command.arg("bake").arg(scene).arg("-o").arg(body);
        if self.compact {
            command.arg("--compact");
        }
        within(&mut command, clock)
    }
}

/// The program for this machine.
pub(super) fn frangible(clock: Clock) -> Result<PathBuf> {
    within(&mut cargo(&["build", "--release"]), clock)?;
    Ok(program())
}

fn hash_of(file: &Path) -> Result<String> {
    let bytes =
        fs::read(file).map_err(|error| format!("`{}` cannot be read: {error}", file.display()))?;
    let mut hasher = DefaultHasher::new();
    hasher.write(&bytes);
    Ok(format!("{:016x}", hasher.finish()))
}
