//! Numbers of a glTF.

use super::{CORNERS, FACES, glb_of};

/// Accessors, and the bytes that they refer to.
#[derive(Default)]
pub(super) struct Numbers {
    pub(super) accessors: Vec<String>,
    views: Vec<String>,
    bytes: Vec<u8>,
}

impl Numbers {
    /// The positions and indices of the tetrahedron: accessors 0 and 1.
    pub(super) fn tetrahedron() -> Self {
        let mut numbers = Self::default();
        numbers.floats("VEC3", CORNERS.as_flattened());
        let indices = FACES
            .as_flattened()
            .iter()
            .flat_map(|&v| (v as u16).to_le_bytes());
        numbers.push(5123, "SCALAR", 12, &indices.collect::<Vec<u8>>());
        numbers
    }

    pub(super) fn floats(&mut self, shape: &str, values: &[f32]) -> usize {
        let width = match shape {
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.push(5126, shape, values.len() / width, &bytes)
    }

    pub(super) fn push(&mut self, kind: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{kind},"normalized":{},"count":{count},"type":"{shape}"}}"#,
            kind < 5125 && shape != "SCALAR",
        ));
        self.accessors.len() - 1
    }

    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (start, length) = (self.bytes.len(), bytes.len());
        self.bytes.extend(bytes);
        self.views.push(format!(
            r#"{{"buffer":0,"byteOffset":{start},"byteLength":{length}}}"#
        ));
        self.views.len() - 1
    }

    /// A GLB with these numbers; `json` is all else, without the outer braces.
    pub(super) fn glb(&self, json: &str) -> Vec<u8> {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{json},"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}}"#,
            self.accessors.join(","),
            self.views.join(","),
            self.bytes.len()
        );
        glb_of(&json, self.bytes.clone())
    }
}
