//! Vertices in 16 and 8 bits, `KHR_mesh_quantization`.

use glam::Vec3;
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use json::buffer::Target::ArrayBuffer;

use super::binary::{Layout, push};

pub(super) const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Place of a mesh of quantised positions: they are scaled, then moved.
#[derive(Clone, Copy)]
pub(super) struct Dequantized {
    pub(super) center: Vec3,
    pub(super) scale: f32,
}

impl Dequantized {
    /// The place in which all positions lie within −1 to 1.
    fn of(positions: &[Vec3]) -> Self {
        let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let all = positions.iter();
        let (low, high) = all.fold(nothing, |(low, high), &p| (low.min(p), high.max(p)));
        let half = 0.5 * (high - low).max_element();
        Self {
            center: 0.5 * (low + high),
            // A mesh without extent must not vanish.
            scale: half.max(f32::MIN_POSITIVE),
        }
    }
}

/// Appends positions as signed shares of their box, and says where it is.
pub(super) fn push_positions(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    positions: &[Vec3],
) -> (json::Index<json::Accessor>, Dequantized) {
    let place = Dequantized::of(positions);
    let full = f32::from(i16::MAX);
    let rows: Vec<[i16; 3]> = (positions.iter())
        .map(|&p| {
            let share = (p - place.center) / place.scale;
            share.to_array().map(|x| (full * x).round() as i16)
        })
        .collect();
    let column = |pick: fn(i16, i16) -> i16| {
        let start = rows.first().copied().unwrap_or_default();
        let bound = rows.iter().fold(start, |best, row| {
            std::array::from_fn(|axis| pick(best[axis], row[axis]))
        });
        Some(serde_json::json!(bound))
    };
    let bounds = (column(Ord::min), column(Ord::max));
    // Rows begin on multiples of four bytes.
    let bytes = rows.iter().flat_map(|&[x, y, z]| [x, y, z, 0]);
    let bytes = bytes.flat_map(i16::to_le_bytes);
    let layout = (ComponentType::I16, Type::Vec3, 8);
    let accessor = push_rows(root, binary, bytes, rows.len(), layout, bounds);
    (accessor, place)
}

/// Appends unit vectors.
pub(super) fn push_normals(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    normals: &[[f32; 3]],
) -> json::Index<json::Accessor> {
    let bytes = normals.iter().flat_map(|n| {
        let [x, y, z] = n.map(|x| (127.0 * x).round() as i8 as u8);
        [x, y, z, 0]
    });
    let layout = (ComponentType::I8, Type::Vec3, 4);
    push_rows(root, binary, bytes, normals.len(), layout, (None, None))
}

/// Appends colours.
pub(super) fn push_colors(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    colors: &[[f32; 4]],
) -> json::Index<json::Accessor> {
    // Linear shares: dark ones would show steps in 8 bits.
    let bytes = colors.iter().flatten().flat_map(|x| {
        let whole = (65535.0 * x.clamp(0.0, 1.0)).round() as u16;
        whole.to_le_bytes()
    });
    let layout = (ComponentType::U16, Type::Vec4, 8);
    push_rows(root, binary, bytes, colors.len(), layout, (None, None))
}

fn push_rows(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    bytes: impl Iterator<Item = u8>,
    count: usize,
    (component, kind, stride): (ComponentType, Type, usize),
    bounds: (Option<serde_json::Value>, Option<serde_json::Value>),
) -> json::Index<json::Accessor> {
    let offset = binary.len();
    binary.extend(bytes);
    let layout = Layout {
        component,
        kind,
        stride: Some(stride),
        normalized: true,
    };
    let target = Some(ArrayBuffer);
    push(root, binary, (offset, count), layout, target, bounds)
}
