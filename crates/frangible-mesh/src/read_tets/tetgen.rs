//! TetGen's .node, .ele and .face.

use glam::DVec3;

use super::builder::Builder;
use super::cursor::Cursor;
use crate::read::ReadError;
use crate::read::text::{number, shown, words};
use crate::tet_input::TetInput;

/// `face` may be missing: then there are no groups of faces.
pub(super) fn parse(node: &[u8], ele: &[u8], face: Option<&[u8]>) -> Result<TetInput, ReadError> {
    let mut builder = Builder::default();
    let named = |file: &'static str| move |error| in_file(file, error);
    nodes(node, &mut builder).map_err(named(".node"))?;
    let quadratic = elements(ele, &mut builder).map_err(named(".ele"))?;
    if let Some(face) = face {
        faces(face, quadratic, &mut builder).map_err(named(".face"))?;
    }
    builder.finish()
}

/// Three files: an error says which.
fn in_file(file: &str, error: ReadError) -> ReadError {
    match error {
        ReadError::Malformed { place, problem } => ReadError::Malformed {
            place: format!("{file}, {place}"),
            problem,
        },
        ReadError::Truncated { inside } => ReadError::Truncated {
            inside: format!("{inside} of the {file} file"),
        },
        other => other,
    }
}

/// The numbers of the next line that has any.
fn row(cursor: &mut Cursor<'_>, out: &mut Vec<f64>, inside: &str) -> Result<(), ReadError> {
    out.clear();
    while out.is_empty() {
        let place = cursor.place();
        let line = cursor
            .rest_of_line()
            .ok_or_else(|| ReadError::truncated(inside))?;
        for word in words(line) {
            let value = number(word).ok_or_else(|| {
                ReadError::malformed(place.clone(), format!("“{}” is not a number", shown(word)))
            })?;
            out.push(value);
        }
    }
    Ok(())
}

/// The first entries of a row as indices.
fn indices(cursor: &Cursor<'_>, row: &[f64], count: usize) -> Result<Vec<u64>, ReadError> {
    let ends = |what: &str| ReadError::malformed(format!("before {}", cursor.place()), what);
    let row = row
        .get(..count)
        .ok_or_else(|| ends("a number is missing at the end of the line"))?;
    row.iter()
        .map(|&x| {
            let index = x as u64;
            if index as f64 == x {
                Ok(index)
            } else {
                Err(ends(&format!("{x} is not a valid node or element number")))
            }
        })
        .collect()
}

fn nodes(bytes: &[u8], builder: &mut Builder) -> Result<(), ReadError> {
    let mut cursor = Cursor::with_comments(bytes);
    let mut values = Vec::new();
    row(&mut cursor, &mut values, "the first line")?;
    if values.get(1).is_some_and(|&dimension| dimension != 3.0) {
        return Err(ReadError::malformed(
            "the first line",
            "the dimension must be 3",
        ));
    }
    for _ in 0..indices(&cursor, &values, 1)?[0] {
        row(&mut cursor, &mut values, "the nodes")?;
        let tag = indices(&cursor, &values, 1)?[0];
        let &[x, y, z] = values
            .get(1..4)
            .and_then(<[f64]>::first_chunk)
            .ok_or_else(|| {
                ReadError::malformed(format!("node {tag}"), "a coordinate is missing")
            })?;
        builder.node(tag, DVec3::new(x, y, z))?;
    }
    Ok(())
}

/// Reads the elements. Returns true if they have ten nodes.
fn elements(bytes: &[u8], builder: &mut Builder) -> Result<bool, ReadError> {
    let mut cursor = Cursor::with_comments(bytes);
    let mut values = Vec::new();
    row(&mut cursor, &mut values, "the first line")?;
    let count = indices(&cursor, &values, 1)?[0];
    let size = match values.get(1) {
        None => 4,
        Some(4.0) => 4,
        Some(10.0) => 10,
        Some(size) => {
            let problem = format!("tetrahedra have {size} nodes; they must have 4 or 10");
            return Err(ReadError::malformed("the first line", problem));
        }
    };
    let has_region = values.get(2).is_some_and(|&n| n > 0.0);
    for _ in 0..count {
        row(&mut cursor, &mut values, "the tetrahedra")?;
        let nodes = indices(&cursor, &values, 1 + size)?;
        let region = values.get(1 + size).filter(|_| has_region);
        builder.tet(nodes[0], &nodes[1..], group(region).as_slice())?;
    }
    Ok(size == 10)
}

fn faces(bytes: &[u8], quadratic: bool, builder: &mut Builder) -> Result<(), ReadError> {
    let mut cursor = Cursor::with_comments(bytes);
    let mut values = Vec::new();
    row(&mut cursor, &mut values, "the first line")?;
    let count = indices(&cursor, &values, 1)?[0];
    if values.get(1).is_none_or(|&markers| markers == 0.0) {
        return Ok(());
    }
    for _ in 0..count {
        row(&mut cursor, &mut values, "the faces")?;
        let nodes = indices(&cursor, &values, 4)?;
        // Faces of second order have the middles of their edges before the marker; neighbours may follow it.
        let marker = if quadratic && values.len() >= 8 { 7 } else { 4 };
        builder.face(&nodes[1..], group(values.get(marker)).as_slice())?;
    }
    Ok(())
}

/// Regions and markers are whole numbers; 0 is none.
fn group(value: Option<&f64>) -> Option<i64> {
    value.map(|&x| x as i64).filter(|&x| x != 0)
}
