//! Numbers into the binary chunk, and the accessors that find them again.

use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::validation::Checked::Valid;

type Accessor = json::Index<json::Accessor>;

/// Appends rows of `f32`, `WIDTH` numbers each. `bounded` adds the least and
/// the greatest of each column, which glTF asks for of positions and key times.
pub(super) fn push_rows<const WIDTH: usize>(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    rows: &[[f32; WIDTH]],
    target: Option<json::buffer::Target>,
    bounded: bool,
) -> Accessor {
    let offset = binary.len();
    binary.extend(rows.iter().flatten().flat_map(|value| value.to_le_bytes()));
    let kind = match WIDTH {
        1 => Type::Scalar,
        2 => Type::Vec2,
        3 => Type::Vec3,
        _ => Type::Vec4,
    };
    let column = |pick: fn(f32, f32) -> f32| {
        let start = rows.first().copied().unwrap_or([0.0; WIDTH]);
        let value = rows.iter().fold(start, |best, row| {
            std::array::from_fn(|axis| pick(best[axis], row[axis]))
        });
        bounded.then(|| value.to_vec().into())
    };
    let bounds = (column(f32::min), column(f32::max));
    push(
        root,
        binary,
        (offset, rows.len()),
        Layout::of(ComponentType::F32, kind),
        target,
        bounds,
    )
}

/// Appends triangle indices, in 16 bits where the vertices allow it.
pub(super) fn push_indices(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    indices: &[u32],
    vertex_count: usize,
) -> Accessor {
    let offset = binary.len();
    // 65535 itself is reserved: it restarts a strip.
    let component = if vertex_count <= usize::from(u16::MAX) {
        binary.extend(
            indices
                .iter()
                .flat_map(|&index| (index as u16).to_le_bytes()),
        );
        ComponentType::U16
    } else {
        binary.extend(indices.iter().flat_map(|&index| index.to_le_bytes()));
        ComponentType::U32
    };
    let target = Some(json::buffer::Target::ElementArrayBuffer);
    push(
        root,
        binary,
        (offset, indices.len()),
        Layout::of(component, Type::Scalar),
        target,
        (None, None),
    )
}

/// Layout of the rows of an accessor.
pub(super) struct Layout {
    pub(super) component: ComponentType,
    pub(super) kind: Type,
    /// Bytes from one row to the next, if the view states them.
    pub(super) stride: Option<usize>,
    /// True if integers stand for −1 to 1 or 0 to 1.
    pub(super) normalized: bool,
}

impl Layout {
    /// Rows without gaps, as they are.
    fn of(component: ComponentType, kind: Type) -> Self {
        Self {
            component,
            kind,
            stride: None,
            normalized: false,
        }
    }
}

/// Appends a view of what the binary chunk has from `offset` on, and its accessor.
pub(super) fn push(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    (offset, count): (usize, usize),
    layout: Layout,
    target: Option<json::buffer::Target>,
    (min, max): (Option<serde_json::Value>, Option<serde_json::Value>),
) -> Accessor {
    let view = root.push(json::buffer::View {
        buffer: json::Index::new(0),
        byte_length: (binary.len() - offset).into(),
        byte_offset: Some(offset.into()),
        byte_stride: layout.stride.map(json::buffer::Stride),
        name: None,
        target: target.map(Valid),
        extensions: None,
        extras: None,
    });
    // Every view starts on a multiple of the widest component.
    binary.resize(binary.len().next_multiple_of(4), 0);
    root.push(json::Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: count.into(),
        component_type: Valid(GenericComponentType(layout.component)),
        extensions: None,
        extras: None,
        type_: Valid(layout.kind),
        min,
        max,
        name: None,
        normalized: layout.normalized,
        sparse: None,
    })
}
