//! Material libraries of OBJ files.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use crate::InputMaterial;
use crate::read::read_file;
use crate::read::text::{Lines, in_utf8, lower, number, words};

/// The materials that faces use, in the order of their first use.
#[derive(Default)]
pub(super) struct Materials {
    pub(super) list: Vec<InputMaterial>,
    known: BTreeMap<Vec<u8>, InputMaterial>,
    used: BTreeMap<Vec<u8>, u32>,
}

impl Materials {
    /// Index of the material of this name; one that no library defines has the default look.
    pub(super) fn use_named(&mut self, name: &[u8]) -> u32 {
        if let Some(&index) = self.used.get(name) {
            return index;
        }
        let index = self.list.len() as u32;
        let mut material = self.known.get(name).cloned().unwrap_or_default();
        material.name = String::from_utf8_lossy(name).into_owned();
        self.list.push(material);
        self.used.insert(name.to_vec(), index);
        index
    }

    /// A library that cannot be read costs colours, not the shape: it is logged.
    pub(super) fn read_library(&mut self, name: &[u8], folder: Option<&Path>) {
        let (Some(folder), Ok(name)) = (folder, std::str::from_utf8(name)) else {
            return;
        };
        let name = Path::new(name);
        if name
            .components()
            .any(|part| !matches!(part, Component::Normal(_) | Component::CurDir))
        {
            log::warn!(
                "material library {} is outside the folder of the mesh and is not read",
                name.display()
            );
            return;
        }
        match read_file(&folder.join(name)) {
            Ok(bytes) => self.known.append(&mut parse(&bytes)),
            Err(error) => log::warn!("material library: {error}"),
        }
    }
}

fn parse(bytes: &[u8]) -> BTreeMap<Vec<u8>, InputMaterial> {
    let mut known = BTreeMap::new();
    let mut current: Option<(Vec<u8>, InputMaterial)> = None;
    for (_, text) in Lines::new(&in_utf8(bytes)) {
        let mut words = words(&text);
        let Some(keyword) = words.next().map(lower) else {
            continue;
        };
        if *keyword == b"newmtl"[..] {
            let name = text.get(6..).unwrap_or_default().trim_ascii().to_vec();
            known.extend(current.replace((name, InputMaterial::default())));
            continue;
        }
        let Some((_, material)) = &mut current else {
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
            _ => {}
        }
    }
    known.extend(current);
    known
}
