//! Tetrahedral meshes with fields as VTK unstructured grids (.vtu), for ParaView and similar programs.
//!
//! An XML header followed by raw appended data, little-endian, with 64-bit lengths.

use std::fmt::Write;

use glam::Vec3;

use crate::ExportError;

/// A mesh with one type of elements and data at its nodes.
#[derive(Clone, Copy, Debug)]
pub struct VtuMesh<'a> {
    /// Node positions, m.
    pub points: &'a [Vec3],
    /// Elements.
    pub cells: VtuCells<'a>,
    /// Fields with a value per node.
    pub point_data: &'a [VtuField<'a>],
    /// Named lists of numbers for the whole mesh, such as frequencies or times.
    pub field_data: &'a [(&'a str, &'a [f64])],
}

/// Elements of a [`VtuMesh`].
#[derive(Clone, Copy, Debug)]
pub enum VtuCells<'a> {
    /// Four corners.
    Linear(&'a [[u32; 4]]),
    /// Four corners, then the mid-edge nodes of the edges 01, 12, 02, 03, 13, 23, in VTK's order.
    Quadratic(&'a [[u32; 10]]),
}

/// A field with one value per node.
#[derive(Clone, Copy, Debug)]
pub struct VtuField<'a> {
    /// Name of the field, escaped for XML.
    pub name: &'a str,
    /// The values.
    pub values: VtuValues<'a>,
}

/// Values of a [`VtuField`].
#[derive(Clone, Copy, Debug)]
pub enum VtuValues<'a> {
    /// A number per node.
    Scalars(&'a [f32]),
    /// A vector per node.
    Vectors(&'a [Vec3]),
}

/// VTK's numbers of the elements.
const LINEAR_TETRAHEDRON: u8 = 10;
const QUADRATIC_TETRAHEDRON: u8 = 24;

/// Encodes a mesh as a .vtu file. The same mesh gives the same bytes.
///
/// # Errors
/// [`ExportError::Grid`] for a field of the wrong length, a node that does not exist, a number that is not finite.
pub fn write_vtu(mesh: &VtuMesh<'_>) -> Result<Vec<u8>, ExportError> {
    let nodes = mesh.points.len();
    let (connectivity, per_cell, kind) = match mesh.cells {
        VtuCells::Linear(cells) => (cells.as_flattened(), 4, LINEAR_TETRAHEDRON),
        VtuCells::Quadratic(cells) => (cells.as_flattened(), 10, QUADRATIC_TETRAHEDRON),
    };
    let cells = connectivity.len() / per_cell;
    check(mesh, connectivity)?;

    let mut head = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n",
    );
    let mut data = Appended::default();
    head += "<FieldData>\n";
    for (name, values) in mesh.field_data {
        let tuples = format!("NumberOfTuples=\"{}\"", values.len());
        head += &data.array(
            "Float64",
            name,
            &tuples,
            values.iter().map(|v| v.to_le_bytes()),
        );
    }
    head += "</FieldData>\n";
    // Writing to a string cannot fail.
    let _ = writeln!(
        head,
        "<Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">\n<Points>"
    );
    head += &data.vectors("Points", mesh.points);
    head += "</Points>\n<Cells>\n";
    let bytes = connectivity.iter().map(|&v| i64::from(v).to_le_bytes());
    head += &data.array("Int64", "connectivity", "", bytes);
    let ends = (1..=cells).map(|cell| ((cell * per_cell) as i64).to_le_bytes());
    head += &data.array("Int64", "offsets", "", ends);
    head += &data.array("UInt8", "types", "", (0..cells).map(|_| [kind]));
    head += "</Cells>\n<PointData>\n";
    for field in mesh.point_data {
        head += &match field.values {
            VtuValues::Scalars(values) => {
                let bytes = values.iter().map(|v| v.to_le_bytes());
                data.array("Float32", field.name, "", bytes)
            }
            VtuValues::Vectors(values) => data.vectors(field.name, values),
        };
    }
    head += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    let mut file = head.into_bytes();
    file.append(&mut data.0);
    file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    Ok(file)
}

/// The numbers, each list behind its length.
#[derive(Default)]
struct Appended(Vec<u8>);

impl Appended {
    /// Adds a list. Returns the element that describes it.
    fn array<const N: usize>(
        &mut self,
        kind: &str,
        name: &str,
        more: &str,
        numbers: impl Iterator<Item = [u8; N]>,
    ) -> String {
        let offset = self.0.len();
        self.0.extend_from_slice(&[0; 8]);
        self.0.extend(numbers.flatten());
        let length = (self.0.len() - offset - 8) as u64;
        self.0[offset..offset + 8].copy_from_slice(&length.to_le_bytes());
        format!(
            "<DataArray type=\"{kind}\" Name=\"{}\" {more} format=\"appended\" offset=\"{offset}\"/>\n",
            escaped(name)
        )
    }

    fn vectors(&mut self, name: &str, vectors: &[Vec3]) -> String {
        let numbers = vectors.iter().flat_map(|v| v.to_array());
        let bytes = numbers.map(f32::to_le_bytes);
        self.array("Float32", name, "NumberOfComponents=\"3\"", bytes)
    }
}

fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for letter in name.chars() {
        match letter {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '>' => text += "&gt;",
            '"' => text += "&quot;",
            // Forbidden in XML, however it is written.
            c if c.is_control() => text.push(' '),
            c => text.push(c),
        }
    }
    text
}

fn check(mesh: &VtuMesh<'_>, connectivity: &[u32]) -> Result<(), ExportError> {
    let wrong = |problem: String| Err(ExportError::Grid(problem));
    let nodes = mesh.points.len();
    if let Some(at) = mesh.points.iter().position(|p| !p.is_finite()) {
        return wrong(format!(
            "node {at} lies at {}, which is not finite",
            mesh.points[at]
        ));
    }
    if let Some(&node) = connectivity.iter().find(|&&node| node as usize >= nodes) {
        return wrong(format!(
            "an element refers to node {node}, counted from 0, but there are only {nodes}"
        ));
    }
    for field in mesh.point_data {
        let (count, finite) = match field.values {
            VtuValues::Scalars(values) => (values.len(), values.iter().all(|v| v.is_finite())),
            VtuValues::Vectors(values) => (values.len(), values.iter().all(|v| v.is_finite())),
        };
        if count != nodes {
            let name = field.name;
            return wrong(format!(
                "`{name}` has {count} values, but there are {nodes} nodes"
            ));
        }
        if !finite {
            return wrong(format!("`{}` has a value that is not finite", field.name));
        }
    }
    for (name, values) in mesh.field_data {
        if !values.iter().all(|v| v.is_finite()) {
            return wrong(format!("`{name}` has a value that is not finite"));
        }
    }
    Ok(())
}
