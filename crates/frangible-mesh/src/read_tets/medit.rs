//! Medit's .mesh, text.

use glam::DVec3;

use super::builder::{Builder, other_cells};
use super::cursor::Cursor;
use crate::read::ReadError;
use crate::tet_input::TetInput;

pub(super) fn parse(bytes: &[u8]) -> Result<TetInput, ReadError> {
    let mut cursor = Cursor::with_comments(bytes);
    if cursor.word() != Some(b"MeshVersionFormatted") {
        let problem = "a .mesh file begins with MeshVersionFormatted (binary .meshb is not read)";
        return Err(cursor.malformed(problem));
    }
    cursor.integer(4, "MeshVersionFormatted")?;
    let mut builder = Builder::default();
    let mut ended = false;
    while let Some(keyword) = cursor.word() {
        match keyword {
            b"Dimension" => {
                let dimension = cursor.integer(4, "Dimension")?;
                if dimension != 3 {
                    let problem = format!("the mesh has dimension {dimension}; it must have 3");
                    return Err(cursor.malformed(problem));
                }
            }
            b"Vertices" => vertices(&mut cursor, &mut builder)?,
            b"Tetrahedra" => cells(&mut cursor, "Tetrahedra", 4, |number, nodes, groups| {
                builder.tet(number, nodes, groups)
            })?,
            b"TetrahedraP2" => cells(&mut cursor, "TetrahedraP2", 10, |number, nodes, groups| {
                builder.tet(number, nodes, groups)
            })?,
            b"Triangles" => cells(&mut cursor, "Triangles", 3, |_, nodes, groups| {
                builder.face(nodes, groups)
            })?,
            b"TrianglesP2" => cells(&mut cursor, "TrianglesP2", 6, |_, nodes, groups| {
                builder.face(nodes, groups)
            })?,
            b"Hexahedra" | b"Hexaedra" => none(&mut cursor, "hexahedra")?,
            b"Prisms" => none(&mut cursor, "prisms")?,
            b"Pyramids" => none(&mut cursor, "pyramids")?,
            b"End" => {
                ended = true;
                break;
            }
            // Edges, corners, normals …: numbers up to the next keyword.
            _ => {
                while cursor.peek().is_some_and(is_number) {
                    cursor.word();
                }
            }
        }
    }
    if !ended {
        log::warn!("the .mesh file has no “End” and may be truncated");
    }
    builder.finish()
}

fn is_number(word: &[u8]) -> bool {
    word.first().is_some_and(|b| !b.is_ascii_alphabetic())
}

fn vertices(cursor: &mut Cursor<'_>, builder: &mut Builder) -> Result<(), ReadError> {
    let inside = "Vertices";
    for i in 0..cursor.count(4, inside)? {
        let mut next = || cursor.real(8, inside);
        builder.node(i + 1, DVec3::new(next()?, next()?, next()?))?;
        next()?;
    }
    Ok(())
}

fn cells(
    cursor: &mut Cursor<'_>,
    inside: &str,
    size: usize,
    mut add: impl FnMut(u64, &[u64], &[i64]) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let mut nodes = Vec::new();
    for i in 0..cursor.count(4, inside)? {
        nodes.clear();
        for _ in 0..size {
            nodes.push(cursor.count(4, inside)?);
        }
        let group = cursor.integer(4, inside)?;
        add(
            i + 1,
            &nodes,
            if group == 0 {
                &[]
            } else {
                std::slice::from_ref(&group)
            },
        )?;
    }
    Ok(())
}

fn none(cursor: &mut Cursor<'_>, kind: &'static str) -> Result<(), ReadError> {
    match cursor.count(4, kind)? {
        0 => Ok(()),
        _ => Err(other_cells(kind)),
    }
}
