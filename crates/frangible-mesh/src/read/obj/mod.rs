//! Wavefront OBJ: polygons with textures and normals. Curves, lines and points are passed over.

mod corners;
mod maps;
mod mtl;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

use self::corners::{Corner, Splitter};
use self::mtl::Materials;
use super::finish::{NO_MATERIAL, WHITE};
use super::polygon::triangulate;
use super::runs::Runs;
use super::text::{Lines, lower, next_number, number, shown, words};
use super::{ReadError, check_triangles, check_vertices};
use crate::InputMesh;

/// The file as it stands: faces keep their triples of indices until all vertices are known.
#[derive(Default)]
struct Obj {
    positions: Vec<DVec3>,
    /// Colour of each position; empty where no line has one.
    colors: Vec<[f32; 4]>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    corners: Vec<Corner>,
    /// End of each face's corners, and its material.
    faces: Vec<(u32, u32)>,
    triangles: u64,
    /// Faces of fewer than three corners: some programs write edges so.
    skipped_faces: usize,
    /// True once something that is no colour was reported.
    warned: bool,
}

pub(crate) fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<InputMesh, ReadError> {
    let mut obj = Obj::default();
    let mut materials = Materials::default();
    let mut material = NO_MATERIAL;
    let mut groups = Vec::new();
    let (mut object, mut group) = (Runs::default(), Runs::default());
    let mut left_out = ["", ""];
    for (line, text) in Lines::new(bytes) {
        let mut words = words(&text);
        // Some programs write capitals.
        let keyword = words.next().map(lower);
        match keyword.as_deref() {
            Some(b"v") => {
                obj.positions.push(vector(&mut words, line)?);
                obj.color(&mut words, line);
            }
            Some(b"vn") => obj.normals.push(vector(&mut words, line)?.as_vec3()),
            Some(b"vt") => {
                let u = next_number(&mut words, line)?;
                let v = words.next().and_then(number).unwrap_or(0.0);
                // The file's origin is the lower left corner of the picture.
                obj.uvs.push(Vec2::new(u as f32, 1.0 - v as f32));
            }
            Some(b"f" | b"fo") => obj.face(&mut words, line, material)?,
            Some(b"usemtl") => material = materials.use_named(rest_of(&text, b"usemtl")),
            Some(b"o") => {
                let name = name_of(rest_of(&text, b"o"));
                object.change([name], obj.triangles as u32, &mut groups);
            }
            Some(b"g") => {
                // A face may be in several groups at once; `g` alone ends them.
                let names: Vec<String> = words.map(name_of).collect();
                group.change(names, obj.triangles as u32, &mut groups);
            }
            Some(b"mtllib") => materials.read_library(rest_of(&text, b"mtllib"), folder),
            Some(b"l" | b"p") => left_out[0] = "points and lines",
            Some(b"curv" | b"curv2" | b"surf") => left_out[1] = "curves and curved surfaces",
            _ => {}
        }
        check_vertices(
            obj.positions
                .len()
                .max(obj.uvs.len())
                .max(obj.normals.len()) as u64,
        )?;
    }
    for names in [&mut object, &mut group] {
        names.change([], obj.triangles as u32, &mut groups);
    }
    let mut mesh = obj.assemble()?;
    mesh.groups = groups;
    mesh.srgb_colors = true;
    materials.give(&mut mesh);
    for what in left_out.into_iter().filter(|what| !what.is_empty()) {
        mesh.leave_out(what);
    }
    Ok(mesh)
}

fn vector<'a>(words: &mut impl Iterator<Item = &'a [u8]>, line: usize) -> Result<DVec3, ReadError> {
    let mut next = || next_number(words, line);
    Ok(DVec3::new(next()?, next()?, next()?))
}

/// Names may hold spaces.
fn rest_of<'a>(text: &'a [u8], keyword: &[u8]) -> &'a [u8] {
    text.get(keyword.len()..).unwrap_or_default().trim_ascii()
}

fn name_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

impl Obj {
    /// Three numbers behind a position are its colour, an extension that modellers and scanners share. One alone is a
    /// weight of curves.
    fn color<'a>(&mut self, words: &mut impl Iterator<Item = &'a [u8]>, line: usize) {
        let words: Vec<&[u8]> = words
            .take_while(|word| !word.starts_with(b"#"))
            .take(5)
            .collect();
        let read = |word: &[u8]| number(word).map(|x| x as f32);
        let color = match words.as_slice() {
            [] | [_] => None,
            &[r, g, b] => match (read(r), read(g), read(b)) {
                (Some(r), Some(g), Some(b)) => Some([r, g, b, 1.0]),
                _ => self.no_color(line),
            },
            _ => self.no_color(line),
        };
        if let Some(color) = color {
            self.colors.resize(self.positions.len() - 1, WHITE);
            self.colors.push(color);
        }
    }

    /// Says so once.
    fn no_color(&mut self, line: usize) -> Option<[f32; 4]> {
        if !std::mem::replace(&mut self.warned, true) {
            log::warn!(
                "line {line}: the values after the coordinates are not a colour “r g b”; they are ignored"
            );
        }
        None
    }

    fn face<'a>(
        &mut self,
        words: &mut impl Iterator<Item = &'a [u8]>,
        line: usize,
        material: u32,
    ) -> Result<(), ReadError> {
        let first = self.corners.len();
        for word in words {
            if word.starts_with(b"#") {
                break;
            }
            let corner = self.corner(word, line)?;
            self.corners.push(corner);
        }
        let count = self.corners.len() - first;
        if count < 3 {
            self.corners.truncate(first);
            self.skipped_faces += 1;
            return Ok(());
        }
        self.triangles += count as u64 - 2;
        check_triangles(self.triangles)?;
        self.faces.push((self.corners.len() as u32, material));
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8], line: usize) -> Result<Corner, ReadError> {
        let not_a_corner = || {
            let problem = format!("“{}” is not a valid vertex of a face", shown(word));
            ReadError::malformed(format!("line {line}"), problem)
        };
        let mut parts = word.split(|&b| b == b'/');
        let mut index = |there: usize| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(digits) => {
                let index = std::str::from_utf8(digits)
                    .ok()
                    .and_then(|d| d.parse::<i64>().ok());
                let index = index.ok_or_else(not_a_corner)?;
                self.resolve(index, there).map(Some)
            }
        };
        let corner = Corner {
            position: index(self.positions.len())?.ok_or_else(not_a_corner)?,
            uv: index(self.uvs.len())?.unwrap_or(Corner::NONE),
            normal: index(self.normals.len())?.unwrap_or(Corner::NONE),
        };
        Ok(corner)
    }

    /// Index from 0, from that of the file, which counts from 1, or backwards from the latest.
    fn resolve(&self, index: i64, there: usize) -> Result<u32, ReadError> {
        let from_zero = if index > 0 {
            Some(index - 1)
        } else {
            (there as i64)
                .checked_add(index)
                .filter(|&i| i >= 0 && index != 0)
        };
        from_zero
            .and_then(|i| u32::try_from(i).ok())
            .filter(|&i| i != Corner::NONE)
            .ok_or(ReadError::IndexOutOfRange {
                face: self.faces.len() + self.skipped_faces + 1,
                index,
                vertices: there,
            })
    }

    fn assemble(mut self) -> Result<InputMesh, ReadError> {
        if !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), WHITE);
        }
        let mut splitter = Splitter::new(&self.positions, &self.uvs, &self.normals, &self.corners);
        let mut mesh = InputMesh {
            skipped_faces: self.skipped_faces,
            ..InputMesh::default()
        };
        let mut vertices = Vec::new();
        let mut points = Vec::new();
        let mut local = Vec::new();
        let mut first = 0;
        for (face, &(end, material)) in self.faces.iter().enumerate() {
            vertices.clear();
            points.clear();
            for &corner in self.corners.get(first..end as usize).unwrap_or_default() {
                vertices.push(splitter.vertex(corner, face)?);
                points.push(self.positions[corner.position as usize]);
            }
            first = end as usize;
            triangulate(&points, &mut local);
            mesh.triangles
                .extend(local.iter().map(|t| t.map(|k| vertices[k as usize])));
            mesh.material_of_triangle
                .resize(mesh.triangles.len(), material);
        }
        splitter.finish(&self.colors, &mut mesh);
        Ok(mesh)
    }
}
