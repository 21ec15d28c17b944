//! Material libraries of OBJ files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::maps::{Map, map};
use crate::read::images::{is_inside, read_image};
use crate::read::read_file;
use crate::read::text::{Lines, in_utf8, lower, number, shown, words};
use crate::{Image, InputMaterial, InputMesh, TextureSlot};

/// Keywords of looks that the metallic-roughness model does not have, and words for them.
const LEFT_OUT: [(&[u8], &str); 4] = [
    (b"ks", "specular colours"),
    (b"tf", "transmission filters"),
    (b"refl", "reflection maps"),
    (b"disp", "displacement maps"),
];

/// A material of a library, with its textures.
#[derive(Clone, Default)]
struct Known {
    material: InputMaterial,
    maps: Vec<(TextureSlot, Map)>,
    left_out: Vec<String>,
    folder: PathBuf,
}

/// The materials that faces use, in the order of their first use.
#[derive(Default)]
pub(super) struct Materials {
    list: Vec<InputMaterial>,
    known: BTreeMap<Vec<u8>, Known>,
    used: BTreeMap<Vec<u8>, u32>,
    images: Vec<Image>,
    /// Number of each image file that was read; `None` if it cannot be kept.
    files: BTreeMap<PathBuf, Option<u32>>,
    left_out: Vec<String>,
}

impl Materials {
    /// Index of the material of this name; one that no library defines has the default look.
    pub(super) fn use_named(&mut self, name: &[u8]) -> u32 {
        if let Some(&index) = self.used.get(name) {
            return index;
        }
        let index = self.list.len() as u32;
        let known = self.known.get(name).cloned().unwrap_or_default();
        let mut material = known.material;
        material.name = String::from_utf8_lossy(name).into_owned();
        self.left_out.extend(known.left_out);
        for (slot, map) in known.maps {
            let image = self.image(&known.folder, &map.file);
            material
                .textures
                .extend(image.map(|image| map.texture(slot, image)));
        }
        self.list.push(material);
        self.used.insert(name.to_vec(), index);
        index
    }

    /// Gives the materials to a mesh. Textures need coordinates.
    pub(super) fn give(mut self, mesh: &mut InputMesh) {
        let has_textures = self.list.iter().any(|m| !m.textures.is_empty());
        if mesh.uvs.is_empty() && has_textures {
            self.left_out
                .push("textures without texture coordinates".into());
            for material in &mut self.list {
                material.textures.clear();
            }
            self.images.clear();
        }
        mesh.materials = self.list;
        mesh.images = self.images;
        for what in self.left_out {
            mesh.leave_out(what);
        }
    }

    /// A library that cannot be read costs colours, not the shape: it is taken down.
    pub(super) fn read_library(&mut self, name: &[u8], folder: Option<&Path>) {
        let Ok(name) = std::str::from_utf8(name) else {
            return;
        };
        let called = format!("the material library {}", shown(name.as_bytes()));
        let Some(folder) = folder else {
            self.left_out.push(called);
            return;
        };
        let name = Path::new(name);
        if !is_inside(name) {
            self.left_out
                .push(format!("{called}, which is outside the folder of the mesh"));
            return;
        }
        let path = folder.join(name);
        match read_file(&path) {
            Ok(bytes) => self
                .known
                .append(&mut parse(&bytes, path.parent().unwrap_or(folder))),
            Err(error) => self.left_out.push(format!("{called} ({error})")),
        }
    }

    fn image(&mut self, folder: &Path, file: &str) -> Option<u32> {
        let path = folder.join(file);
        if let Some(&known) = self.files.get(&path) {
            return known;
        }
        let kept = match read_image(file, folder) {
            Ok(image) => {
                self.images.push(image);
                Some(self.images.len() as u32 - 1)
            }
            Err(problem) => {
                self.left_out.push(problem);
                None
            }
        };
        self.files.insert(path, kept);
        kept
    }
}

fn parse(bytes: &[u8], folder: &Path) -> BTreeMap<Vec<u8>, Known> {
    let mut known = BTreeMap::new();
    let mut current: Option<(Vec<u8>, Known)> = None;
    for (_, text) in Lines::new(&in_utf8(bytes)) {
        let mut words = words(&text);
        let Some(keyword) = words.next().map(lower) else {
            continue;
        };
        if *keyword == b"newmtl"[..] {
            let name = text.get(6..).unwrap_or_default().trim_ascii().to_vec();
            let next = Known {
                folder: folder.to_owned(),
                ..Known::default()
            };
            known.extend(current.replace((name, next)).map(finished));
            continue;
        }
        let Some((
            _,
            Known {
                material,
                maps,
                left_out,
                ..
            },
        )) = &mut current
        else {
            continue;
        };
        let mut value = || {
            words
                .next()
                .and_then(number)
                .map(|v| v.clamp(0.0, 1000.0) as f32)
        };
        let share = |v: Option<f32>| v.filter(|v| v.is_finite()).map(|v| v.min(1.0));
        match &*keyword {
            b"kd" => {
                for k in 0..3 {
                    material.base_color[k] = share(value()).unwrap_or(material.base_color[k]);
                }
            }
            b"ke" => {
                for k in 0..3 {
                    let light = value().filter(|v| v.is_finite());
                    material.emission[k] = light.unwrap_or(material.emission[k]);
                }
            }
            b"d" => material.base_color[3] = share(value()).unwrap_or(1.0),
            b"tr" => material.base_color[3] = 1.0 - share(value()).unwrap_or(0.0),
            b"pm" => material.metallic = share(value()).unwrap_or(0.0),
            b"pr" => material.roughness = share(value()).unwrap_or(0.7),
            // Blinn's exponent to the roughness of equal highlight width: α² = 2 / (n + 2).
            b"ns" => {
                if let Some(exponent) = value().filter(|n| n.is_finite()) {
                    material.roughness = (2.0 / (exponent + 2.0)).powf(0.25);
                }
            }
            b"map_kd" | b"map_ke" | b"norm" => {
                let slot = match &*keyword {
                    b"map_kd" => TextureSlot::BaseColor,
                    b"map_ke" => TextureSlot::Emission,
                    _ => TextureSlot::Normal,
                };
                let rest = text.get(keyword.len()..).unwrap_or_default();
                maps.extend(map(rest).map(|map| (slot, map)));
            }
            other if other.starts_with(b"map_") || other == b"bump" || other == b"decal" => {
                left_out.push(format!("{} of materials", shown(&text[..other.len()])));
            }
            other => {
                let known = LEFT_OUT.iter().find(|(word, _)| *word == other);
                // Black is none.
                let is_black = [value(), value(), value()].iter().all(|v| *v == Some(0.0));
                left_out.extend(known.filter(|_| !is_black).map(|(_, what)| (*what).into()));
            }
        }
    }
    known.extend(current.map(finished));
    known
}

/// The first texture of each slot counts, and one of emission needs a colour that it multiplies.
fn finished((name, mut known): (Vec<u8>, Known)) -> (Vec<u8>, Known) {
    known.maps.sort_by_key(|(slot, _)| *slot);
    known.maps.dedup_by_key(|(slot, _)| *slot);
    let emits = known.maps.iter().any(|(s, _)| *s == TextureSlot::Emission);
    if emits && known.material.emission == [0.0; 3] {
        known.material.emission = [1.0; 3];
    }
    (name, known)
}
