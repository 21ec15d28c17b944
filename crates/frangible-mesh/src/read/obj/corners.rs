//! Triples of position, texture coordinate and normal to single vertices.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use crate::InputMesh;
use crate::read::ReadError;

/// Indices of one corner of a face, from 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: u32,
    pub(super) normal: u32,
}

impl Corner {
    pub(super) const NONE: u32 = u32::MAX;
}

/// Keeps the file's vertices in their order; the first triple of a position takes its place, further ones (seams) are
/// appended.
pub(super) struct Splitter<'a> {
    positions: &'a [DVec3],
    uvs: &'a [Vec2],
    normals: &'a [Vec3],
    has_uvs: bool,
    has_normals: bool,
    /// The triple of each vertex; unused ones have no attributes.
    vertices: Vec<Corner>,
    is_used: Vec<bool>,
    seams: HashMap<Corner, u32>,
}

impl<'a> Splitter<'a> {
    pub(super) fn new(
        positions: &'a [DVec3],
        uvs: &'a [Vec2],
        normals: &'a [Vec3],
        corners: &[Corner],
    ) -> Self {
        let unused = |position| Corner {
            position,
            uv: Corner::NONE,
            normal: Corner::NONE,
        };
        Self {
            positions,
            uvs,
            normals,
            has_uvs: corners.iter().any(|c| c.uv != Corner::NONE),
            has_normals: corners.iter().any(|c| c.normal != Corner::NONE),
            vertices: (0..positions.len() as u32).map(unused).collect(),
            is_used: vec![false; positions.len()],
            seams: HashMap::new(),
        }
    }

    /// The vertex of a corner of face number `face` (from 0).
    pub(super) fn vertex(&mut self, corner: Corner, face: usize) -> Result<u32, ReadError> {
        let check = |index: u32, vertices: usize| {
            if index != Corner::NONE && index as usize >= vertices {
                let index = i64::from(index) + 1;
                let face = face + 1;
                return Err(ReadError::IndexOutOfRange {
                    face,
                    index,
                    vertices,
                });
            }
            Ok(())
        };
        check(corner.position, self.positions.len())?;
        check(corner.uv, self.uvs.len())?;
        check(corner.normal, self.normals.len())?;
        let own = corner.position as usize;
        if !self.is_used[own] {
            self.is_used[own] = true;
            self.vertices[own] = corner;
        }
        if self.vertices[own] == corner {
            return Ok(corner.position);
        }
        let next = self.vertices.len() as u32;
        let vertex = *self.seams.entry(corner).or_insert(next);
        if vertex == next {
            self.vertices.push(corner);
        }
        Ok(vertex)
    }

    /// `colors` has one per position, or none.
    pub(super) fn finish(self, colors: &[[f32; 4]], mesh: &mut InputMesh) {
        let attribute = |index: u32| (index != Corner::NONE).then_some(index as usize);
        mesh.positions = self
            .vertices
            .iter()
            .map(|c| self.positions[c.position as usize])
            .collect();
        if !colors.is_empty() {
            let of = |c: &Corner| colors[c.position as usize];
            mesh.colors = self.vertices.iter().map(of).collect();
        }
        if self.has_uvs {
            let uv = |c: &Corner| attribute(c.uv).and_then(|i| self.uvs.get(i).copied());
            mesh.uvs = self
                .vertices
                .iter()
                .map(|c| uv(c).unwrap_or_default())
                .collect();
        }
        if self.has_normals {
            let normal =
                |c: &Corner| attribute(c.normal).and_then(|i| self.normals.get(i).copied());
            mesh.normals = self
                .vertices
                .iter()
                .map(|c| normal(c).unwrap_or(Vec3::ZERO))
                .collect();
        }
    }
}
