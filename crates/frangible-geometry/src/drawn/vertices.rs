//! The vertices that a whole surface is drawn with.

use glam::Vec3;

use super::RenderSurface;
use crate::box_projection;

/// Vertices at one place of the surface that are compared with a corner, at most: at the tip of a fan of thousands of flat triangles each has
/// its own.
const COMPARED: usize = 8;

/// A corner as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vertex {
    /// Its vertex of the surface, which has its other attributes.
    pub(super) source: u32,
    /// m, body frame.
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) uv: [f32; 2],
}

/// The vertices of a surface: corners that differ only in their triangle are one, but where very many meet.
#[derive(Debug)]
pub(super) struct Vertices {
    list: Vec<Vertex>,
    /// Vertices of each triangle.
    of: Vec<[u32; 3]>,
}

impl Vertices {
    /// `normals`: at the corners of each triangle; `flat`: of each triangle, for texture coordinates where the surface has none.
    pub(super) fn new(surface: &RenderSurface, normals: &[[Vec3; 3]], flat: &[Vec3]) -> Self {
        const NONE: u32 = u32::MAX;
        let mut list: Vec<Vertex> = Vec::with_capacity(surface.positions.len());
        // The last vertex drawn at each of the surface's, and the one before each.
        let mut last = vec![NONE; surface.positions.len()];
        let mut before: Vec<u32> = Vec::with_capacity(surface.positions.len());
        let mut number = |v: u32, normal: Vec3, flat: Vec3| {
            let v = v as usize;
            let position = surface.positions[v];
            let uv = match surface.uvs.get(v) {
                Some(&uv) => uv,
                None => box_projection(position, flat),
            };
            let vertex = Vertex {
                source: v as u32,
                position,
                normal,
                uv,
            };
            let drawn = |k: u32| (k != NONE).then_some(k);
            let here = std::iter::successors(drawn(last[v]), |&k| drawn(before[k as usize]));
            let known = here.take(COMPARED).find(|&k| list[k as usize] == vertex);
            known.unwrap_or_else(|| {
                list.push(vertex);
                before.push(last[v]);
                last[v] = before.len() as u32 - 1;
                last[v]
            })
        };
        let corners = surface.triangles.iter().zip(normals).zip(flat);
        let of = corners
            .map(|((triangle, normals), &flat)| {
                [0, 1, 2].map(|k| number(triangle[k], normals[k], flat))
            })
            .collect();
        Self { list, of }
    }

    /// Number of vertices.
    pub(super) fn count(&self) -> usize {
        self.list.len()
    }

    /// Numbers of those at the corners of a triangle.
    pub(super) fn of(&self, triangle: u32) -> [u32; 3] {
        self.of[triangle as usize]
    }

    pub(super) fn get(&self, number: u32) -> &Vertex {
        &self.list[number as usize]
    }
}
