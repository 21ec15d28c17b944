//! STL, binary and text. Its facet normals are not kept: the winding says the same.

use glam::DVec3;

use super::format::is_exactly_binary_stl;
use super::polygon::triangulate;
use super::runs::Runs;
use super::text::{Lines, next_number, words};
use super::{ReadError, check_triangles};
use crate::InputMesh;

/// Bytes of a binary file before its facets, and of each facet.
const HEADER: usize = 84;
const FACET: usize = 50;

const NO_STL: &str = "this is text, but no STL: a text STL begins with the word “solid”";

pub(crate) fn parse(bytes: &[u8]) -> Result<InputMesh, ReadError> {
    // Binary files, too, may begin with “solid”: the length decides, then the bytes after the word.
    if is_exactly_binary_stl(bytes) {
        parse_binary(bytes)
    } else if is_text(bytes) {
        parse_text(bytes)
    } else if looks_written(bytes) {
        Err(ReadError::malformed("line 1", NO_STL))
    } else {
        parse_binary(bytes)
    }
}

fn is_text(bytes: &[u8]) -> bool {
    let text = bytes
        .strip_prefix(b"\xef\xbb\xbf")
        .unwrap_or(bytes)
        .trim_ascii_start();
    let start = text.get(..1024).unwrap_or(text);
    let solid = start
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    solid && !start.contains(&0)
}

/// Returns true if the start is made of letters: a binary file has zero bytes in its header or its count.
fn looks_written(bytes: &[u8]) -> bool {
    let start = bytes.get(..1024).unwrap_or(bytes);
    start
        .iter()
        .all(|&b| b >= b' ' && b != 0x7f || b.is_ascii_whitespace())
}

fn parse_binary(bytes: &[u8]) -> Result<InputMesh, ReadError> {
    let count: [u8; 4] = bytes
        .get(80..HEADER)
        .and_then(|count| count.try_into().ok())
        .ok_or_else(|| ReadError::truncated("the 84 bytes before the facets of a binary STL"))?;
    let count = u32::from_le_bytes(count);
    let there = (bytes.len() - HEADER) / FACET;
    if (there as u64) < u64::from(count) {
        return Err(ReadError::truncated(format!(
            "facet {} of {count}",
            there + 1
        )));
    }
    check_triangles(u64::from(count))?;
    let facets = bytes[HEADER..].chunks_exact(FACET).take(count as usize);
    let mut mesh = InputMesh {
        positions: Vec::with_capacity(3 * count as usize),
        ..InputMesh::default()
    };
    for facet in facets {
        for corner in facet[12..48].chunks_exact(12) {
            let at = |k: usize| {
                f64::from(f32::from_le_bytes([
                    corner[k],
                    corner[k + 1],
                    corner[k + 2],
                    corner[k + 3],
                ]))
            };
            mesh.positions.push(DVec3::new(at(0), at(4), at(8)));
        }
    }
    mesh.triangles = (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Ok(mesh)
}

fn parse_text(bytes: &[u8]) -> Result<InputMesh, ReadError> {
    let mut mesh = InputMesh::default();
    let mut corners: Vec<DVec3> = Vec::new();
    let mut triangles = Vec::new();
    let (mut solid, mut groups) = (Runs::default(), Vec::new());
    let (mut in_facet, mut ended) = (false, false);
    for (line, text) in Lines::new(bytes) {
        let mut words = words(&text);
        let Some(keyword) = words.next() else {
            continue;
        };
        if keyword.eq_ignore_ascii_case(b"vertex") {
            let mut next = || next_number(&mut words, line);
            corners.push(DVec3::new(next()?, next()?, next()?));
            check_triangles(corners.len() as u64)?;
        } else if keyword.eq_ignore_ascii_case(b"facet") {
            if in_facet {
                return Err(ReadError::malformed(
                    format!("line {line}"),
                    "a facet begins inside another",
                ));
            }
            in_facet = true;
            corners.clear();
        } else if keyword.eq_ignore_ascii_case(b"endfacet") {
            if corners.len() < 3 {
                let problem = format!("the facet has {} vertices, it needs three", corners.len());
                return Err(ReadError::malformed(format!("line {line}"), problem));
            }
            triangulate(&corners, &mut triangles);
            let first = mesh.positions.len() as u32;
            mesh.positions.append(&mut corners);
            let shifted = triangles.iter().map(|t| t.map(|v| first + v));
            mesh.triangles.extend(shifted);
            check_triangles(mesh.triangles.len() as u64)?;
            in_facet = false;
        } else if keyword.eq_ignore_ascii_case(b"solid") {
            let name = text.trim_ascii().get(5..).unwrap_or_default().trim_ascii();
            let name = String::from_utf8_lossy(name).into_owned();
            solid.change([name], mesh.triangles.len() as u32, &mut groups);
        } else if keyword.eq_ignore_ascii_case(b"endsolid") {
            ended = true;
            solid.change([], mesh.triangles.len() as u32, &mut groups);
        }
    }
    if in_facet {
        let facet = mesh.triangles.len() + 1;
        return Err(ReadError::truncated(format!("facet {facet}")));
    }
    if !ended {
        log::warn!("the STL has no “endsolid”: it may be cut off");
    }
    solid.change([], mesh.triangles.len() as u32, &mut groups);
    mesh.groups = groups;
    Ok(mesh)
}
