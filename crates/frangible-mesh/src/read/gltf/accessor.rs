//! Typed numbers in buffer views, every range checked.

use gltf_json::accessor::{Accessor, ComponentType, Type};
use gltf_json::buffer::View;
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use super::buffers::Buffers;
use crate::read::{ReadError, check_vertices};

/// Rows of equal width in a buffer.
struct Rows<'a> {
    bytes: &'a [u8],
    stride: usize,
    kind: ComponentType,
}

impl<'a> Rows<'a> {
    /// `count` rows of `width` numbers from `offset` on in a view.
    fn new(
        (root, buffers): (&'a Root, &'a Buffers),
        view: Index<View>,
        (offset, count): (u64, usize),
        (kind, width): (ComponentType, usize),
        place: &str,
    ) -> Result<Self, ReadError> {
        let (bytes, view) = buffers.view(root, view)?;
        let size = kind.size() * width;
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            return Err(ReadError::malformed(
                place,
                "its stride is less than its size",
            ));
        }
        let range = || {
            let start = usize::try_from(offset).ok()?;
            let length = count
                .checked_sub(1)?
                .checked_mul(stride)?
                .checked_add(size)?;
            bytes.get(start..start.checked_add(length)?)
        };
        let bytes = if count == 0 {
            &[]
        } else {
            range().ok_or_else(|| ReadError::truncated(place))?
        };
        Ok(Self {
            bytes,
            stride,
            kind,
        })
    }

    fn number(&self, row: usize, k: usize) -> f64 {
        let bytes = self
            .bytes
            .get(row * self.stride + k * self.kind.size()..)
            .unwrap_or_default();
        let two = || bytes.first_chunk::<2>().copied().unwrap_or_default();
        let four = || bytes.first_chunk::<4>().copied().unwrap_or_default();
        let one = || bytes.first().copied().unwrap_or_default();
        match self.kind {
            ComponentType::I8 => f64::from(one() as i8),
            ComponentType::U8 => f64::from(one()),
            ComponentType::I16 => f64::from(i16::from_le_bytes(two())),
            ComponentType::U16 => f64::from(u16::from_le_bytes(two())),
            ComponentType::U32 => f64::from(u32::from_le_bytes(four())),
            ComponentType::F32 => f64::from(f32::from_le_bytes(four())),
        }
    }

    fn row<const N: usize>(&self, row: usize) -> [f64; N] {
        std::array::from_fn(|k| self.number(row, k))
    }
}

/// Number of rows of an accessor.
pub(super) fn row_count(root: &Root, index: Index<Accessor>) -> Result<usize, ReadError> {
    let missing =
        || ReadError::malformed(format!("accessor {}", index.value()), "it does not exist");
    let count = root.get(index).ok_or_else(missing)?.count.0;
    check_vertices(count)?;
    Ok(count as usize)
}

/// All rows of an accessor of `N` numbers each.
pub(super) fn read<const N: usize>(
    root: &Root,
    buffers: &Buffers,
    index: Index<Accessor>,
) -> Result<Vec<[f64; N]>, ReadError> {
    let place = format!("accessor {}", index.value());
    let bad = |problem: &str| ReadError::malformed(place.clone(), problem);
    let accessor = root.get(index).ok_or_else(|| bad("it does not exist"))?;
    let (Checked::Valid(kind), Checked::Valid(shape)) = (accessor.component_type, accessor.type_)
    else {
        return Err(bad("its type is unknown"));
    };
    // Columns of smaller ones are padded.
    let is_matrix = matches!(shape, Type::Mat2 | Type::Mat3);
    if is_matrix || shape.multiplicity() != N {
        return Err(bad(&format!("its elements must have {N} components")));
    }
    check_vertices(accessor.count.0)?;
    let count = accessor.count.0 as usize;
    let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
    let mut values: Vec<[f64; N]> = match accessor.buffer_view {
        Some(view) => {
            let rows = Rows::new((root, buffers), view, (offset, count), (kind.0, N), &place)?;
            (0..count).map(|i| rows.row(i)).collect()
        }
        // Zeros that others replace. A few bytes must not ask for gigabytes.
        None if accessor.sparse.is_some() && count <= buffers.bytes() => vec![[0.0; N]; count],
        None if accessor.sparse.is_some() => {
            let problem = format!(
                "it has {count} elements, more than the buffers have bytes; export the file again"
            );
            return Err(bad(&problem));
        }
        None => return Err(bad("it has no data; export it with its buffer")),
    };
    replace_sparse(root, buffers, accessor, kind.0, &mut values, &place)?;
    if accessor.normalized {
        normalize(kind.0, &mut values);
    }
    Ok(values)
}

/// All rows of an accessor of colours: three or four numbers each, whole ones standing for shares, as the format has it.
pub(super) fn read_colors(
    root: &Root,
    buffers: &Buffers,
    index: Index<Accessor>,
) -> Result<Vec<[f32; 4]>, ReadError> {
    let place = || format!("accessor {}", index.value());
    let accessor = root
        .get(index)
        .ok_or_else(|| ReadError::malformed(place(), "it does not exist"))?;
    let mut rows = match accessor.type_ {
        Checked::Valid(Type::Vec3) => read::<3>(root, buffers, index)?
            .into_iter()
            .map(|[r, g, b]| [r, g, b, 0.0])
            .collect(),
        Checked::Valid(Type::Vec4) => read::<4>(root, buffers, index)?,
        _ => {
            let problem = "it holds colours, so its elements must have 3 or 4 components";
            return Err(ReadError::malformed(place(), problem));
        }
    };
    if let (Checked::Valid(kind), false) = (accessor.component_type, accessor.normalized) {
        normalize(kind.0, &mut rows);
    }
    let is_opaque = matches!(accessor.type_, Checked::Valid(Type::Vec3));
    Ok(rows
        .into_iter()
        .map(|[r, g, b, a]| [r, g, b, if is_opaque { 1.0 } else { a }].map(|x| x as f32))
        .collect())
}

fn replace_sparse<const N: usize>(
    root: &Root,
    buffers: &Buffers,
    accessor: &Accessor,
    kind: ComponentType,
    values: &mut [[f64; N]],
    place: &str,
) -> Result<(), ReadError> {
    let Some(sparse) = &accessor.sparse else {
        return Ok(());
    };
    let count = sparse.count.0.min(values.len() as u64) as usize;
    let Checked::Valid(index_kind) = sparse.indices.component_type else {
        return Err(ReadError::malformed(
            place,
            "the type of its sparse indices is unknown",
        ));
    };
    let start = sparse.indices.byte_offset.0;
    let at = Rows::new(
        (root, buffers),
        sparse.indices.buffer_view,
        (start, count),
        (index_kind.0, 1),
        place,
    )?;
    let start = sparse.values.byte_offset.0;
    let new = Rows::new(
        (root, buffers),
        sparse.values.buffer_view,
        (start, count),
        (kind, N),
        place,
    )?;
    for i in 0..count {
        let target = values.get_mut(at.number(i, 0) as usize);
        *target.ok_or_else(|| ReadError::malformed(place, "a sparse index is out of range"))? =
            new.row(i);
    }
    Ok(())
}

/// Integers that stand for 0..=1 or -1..=1.
fn normalize<const N: usize>(kind: ComponentType, values: &mut [[f64; N]]) {
    let full = match kind {
        ComponentType::I8 => f64::from(i8::MAX),
        ComponentType::U8 => f64::from(u8::MAX),
        ComponentType::I16 => f64::from(i16::MAX),
        ComponentType::U16 => f64::from(u16::MAX),
        ComponentType::U32 => f64::from(u32::MAX),
        ComponentType::F32 => return,
    };
    for value in values.iter_mut().flatten() {
        *value = (*value / full).max(-1.0);
    }
}
