//! Gmsh's MSH, versions 2.2 and 4.1, text and binary.

use super::builder::{Builder, other_cells};
use super::cursor::{Coding, Cursor};
use super::{msh2, msh4};
use crate::read::ReadError;
use crate::read::text::shown;
use crate::tet_input::TetInput;

pub(super) fn parse(bytes: &[u8]) -> Result<TetInput, ReadError> {
    let mut cursor = Cursor::new(bytes);
    if cursor.word() != Some(b"$MeshFormat") {
        return Err(cursor.malformed("an MSH file begins with $MeshFormat"));
    }
    let fourth = format(&mut cursor)?;
    let coding = cursor.coding;
    let mut builder = Builder::default();
    let mut entities = msh4::Entities::default();
    // Names of sections are text in binary files as well.
    while let Some(section) = {
        cursor.coding = Coding::Text;
        cursor.word()
    } {
        match section {
            b"$PhysicalNames" => names(&mut cursor, &mut builder)?,
            b"$Entities" if fourth => {
                start(&mut cursor, coding);
                entities = msh4::entities(&mut cursor)?;
            }
            b"$Nodes" if fourth => {
                start(&mut cursor, coding);
                msh4::nodes(&mut cursor, &mut builder)?;
            }
            b"$Nodes" => msh2::nodes(&mut cursor, coding, &mut builder)?,
            b"$Elements" if fourth => {
                start(&mut cursor, coding);
                msh4::elements(&mut cursor, &entities, &mut builder)?;
            }
            b"$Elements" => msh2::elements(&mut cursor, coding, &mut builder)?,
            _ if section.starts_with(b"$End") => {}
            _ if section.starts_with(b"$") => {
                let mark = [b"$End", &section[1..]].concat();
                cursor.skip_past(&mark);
            }
            _ => {
                let problem = format!("expected a section ($…), found “{}”", shown(section));
                return Err(cursor.malformed(problem));
            }
        }
    }
    builder.finish()
}

fn start(cursor: &mut Cursor<'_>, coding: Coding) {
    if coding != Coding::Text {
        cursor.rest_of_line();
    }
    cursor.coding = coding;
}

/// Reads the format and sets the coding. Returns true if it is version 4.
fn format(cursor: &mut Cursor<'_>) -> Result<bool, ReadError> {
    let inside = "$MeshFormat";
    let version = cursor.real(8, inside)?;
    let binary = cursor.integer(4, inside)? != 0;
    let size = cursor.integer(4, inside)?;
    if !(version == 4.1 || (2.0..3.0).contains(&version)) {
        let asked =
            format!("MSH version {version} is not supported; save the mesh as version 2.2 or 4.1");
        return Err(cursor.malformed(asked));
    }
    if size != 8 {
        return Err(cursor.malformed(format!("numbers have {size} bytes; they must have 8")));
    }
    if binary {
        cursor.rest_of_line();
        cursor.coding = Coding::Little;
        let one = cursor.integer(4, inside)?;
        cursor.coding = match one {
            1 => Coding::Little,
            0x0100_0000 => Coding::Big,
            _ => return Err(cursor.malformed("the byte-order marker is not 1")),
        };
    }
    Ok(version > 4.0)
}

fn names(cursor: &mut Cursor<'_>, builder: &mut Builder) -> Result<(), ReadError> {
    let inside = "$PhysicalNames";
    for _ in 0..cursor.count(4, inside)? {
        let dimension = cursor.count(4, inside)?;
        let tag = cursor.integer(4, inside)?;
        let line = cursor
            .rest_of_line()
            .ok_or_else(|| ReadError::truncated(inside))?;
        let name = line.strip_prefix(b"\"").unwrap_or(line);
        let name = name.strip_suffix(b"\"").unwrap_or(name);
        if let Ok(dimension @ 2..=3) = u8::try_from(dimension) {
            builder.name(dimension, tag, String::from_utf8_lossy(name).into_owned());
        }
    }
    Ok(())
}

/// Use of an element of one of Gmsh's types.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    Tet,
    Face,
    Skip,
}

/// Number of nodes of an element, and its use.
///
/// # Errors
/// Solid elements that are no tetrahedra of first or second order, and types that are not known.
pub(super) fn kind(cursor: &Cursor<'_>, kind: i64) -> Result<(usize, Use), ReadError> {
    Ok(match kind {
        4 => (4, Use::Tet),
        11 => (10, Use::Tet),
        2 => (3, Use::Face),
        9 => (6, Use::Face),
        15 => (1, Use::Skip),
        1 => (2, Use::Skip),
        8 => (3, Use::Skip),
        3 => (4, Use::Skip),
        10 => (9, Use::Skip),
        16 => (8, Use::Skip),
        5 | 12 | 17 => return Err(other_cells("hexahedra")),
        6 | 13 | 18 => return Err(other_cells("prisms")),
        7 | 14 | 19 => return Err(other_cells("pyramids")),
        20..=31 => {
            let needs = "elements of third or higher order";
            return Err(ReadError::Unsupported(needs.into()));
        }
        _ => return Err(cursor.malformed(format!("element type {kind} is unknown"))),
    })
}

/// Adds an element; Gmsh has the middles of 13 and 23 the other way round.
pub(super) fn add(
    builder: &mut Builder,
    number: u64,
    usage: Use,
    nodes: &mut [u64],
    groups: &[i64],
) -> Result<(), ReadError> {
    match usage {
        Use::Tet => {
            if nodes.len() == 10 {
                nodes.swap(8, 9);
            }
            builder.tet(number, nodes, groups)
        }
        Use::Face => builder.face(nodes, groups),
        Use::Skip => Ok(()),
    }
}
