//! STL, binary and text. Its facet normals are not kept: the winding says the same.

use glam::DVec3;

use super::format::is_exactly_binary_stl;
use super::polygon::triangulate;
use super::runs::Runs;
use super::text::{number, shown, words};
use super::{ReadError, check_triangles};
use crate::InputMesh;
use crate::read_tets::cursor::Cursor;

/// Bytes of a binary file before its facets, and of each facet.
const HEADER: usize = 84;
const FACET: usize = 50;

/// Count with all bits set: like 0 it stands for one that was never filled in.
const VOID: u32 = u32::MAX;

const NO_STL: &str = "the file is text but not an STL; a text STL begins with the word “solid”";

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
    let text = bytes.trim_ascii_start();
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

/// Count of facets where the header's is void or too small: as many as there are bytes for.
fn counted(there: usize) -> Result<u32, ReadError> {
    check_triangles(there as u64)?;
    if there > 0 {
        log::warn!(
            "the facet count of the binary STL does not match its length, which holds {there} facets; reading {there}"
        );
    }
    Ok(there as u32)
}

fn parse_binary(bytes: &[u8]) -> Result<InputMesh, ReadError> {
    let count: [u8; 4] = bytes
        .get(80..HEADER)
        .and_then(|count| count.try_into().ok())
        .ok_or_else(|| ReadError::truncated("the 84-byte header of a binary STL"))?;
    let there = (bytes.len() - HEADER) / FACET;
    let is_whole = (bytes.len() - HEADER).is_multiple_of(FACET);
    let is_padding = |count: u32| {
        bytes[HEADER + FACET * count as usize..]
            .iter()
            .all(|&b| b == 0)
    };
    let count = match u32::from_le_bytes(count) {
        // The writer did not come back to fill it in.
        VOID if there > 0 => counted(there)?,
        0 => counted(there)?,
        // No writer adds whole facets behind those it counts, unless as padding.
        count if is_whole && (count as usize) < there && !is_padding(count) => counted(there)?,
        count => count,
    };
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
        // Some programs keep a colour there, each in its own way.
        if facet[48..] != [0, 0] {
            mesh.leave_out("attributes of facets");
        }
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
    let mut facet = 0;
    // The format goes by words; its names alone end with their line.
    let mut cursor = Cursor::new(bytes);
    while let Some(word) = cursor.word() {
        let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
        let place = |cursor: &Cursor| format!("{}, facet {facet}", cursor.place());
        if is(b"vertex") {
            let mut next = || {
                let word = cursor.word().ok_or_else(|| cut_off(facet))?;
                let problem = || format!("“{}” is not a number", shown(word));
                number(word).ok_or_else(|| ReadError::malformed(place(&cursor), problem()))
            };
            corners.push(DVec3::new(next()?, next()?, next()?));
            check_triangles(corners.len() as u64)?;
        } else if is(b"facet") {
            if in_facet {
                let problem = "a facet begins inside another";
                return Err(ReadError::malformed(place(&cursor), problem));
            }
            in_facet = true;
            facet += 1;
            corners.clear();
        } else if is(b"endfacet") {
            if corners.len() < 3 {
                let problem = format!(
                    "the facet has {} vertices; it must have three",
                    corners.len()
                );
                return Err(ReadError::malformed(place(&cursor), problem));
            }
            triangulate(&corners, &mut triangles);
            let first = mesh.positions.len() as u32;
            mesh.positions.append(&mut corners);
            let shifted = triangles.iter().map(|t| t.map(|v| first + v));
            mesh.triangles.extend(shifted);
            check_triangles(mesh.triangles.len() as u64)?;
            in_facet = false;
        } else if is(b"solid") {
            let name = cursor.rest_of_line_before(begins_facets);
            let name = String::from_utf8_lossy(name).into_owned();
            solid.change([name], mesh.triangles.len() as u32, &mut groups);
        } else if is(b"endsolid") {
            ended = true;
            solid.change([], mesh.triangles.len() as u32, &mut groups);
            cursor.rest_of_line_before(|rest| first_is(rest, b"solid"));
        }
    }
    if in_facet {
        return Err(cut_off(facet));
    }
    if !ended {
        log::warn!("the STL has no “endsolid” and may be truncated");
    }
    solid.change([], mesh.triangles.len() as u32, &mut groups);
    mesh.groups = groups;
    Ok(mesh)
}

fn cut_off(facet: usize) -> ReadError {
    ReadError::truncated(format!("facet {facet}"))
}

fn first_is(line: &[u8], keyword: &[u8]) -> bool {
    words(line)
        .next()
        .is_some_and(|word| word.eq_ignore_ascii_case(keyword))
}

/// Returns true where the name of a solid ends though its line does not: a name may have the word “facet” in it.
fn begins_facets(line: &[u8]) -> bool {
    let second = line
        .iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(line.len());
    let second = &line[second..];
    first_is(line, b"endsolid")
        || first_is(line, b"facet") && (first_is(second, b"normal") || first_is(second, b"outer"))
}
