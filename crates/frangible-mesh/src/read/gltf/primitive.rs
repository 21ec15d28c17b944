//! Primitives of placed meshes to triangles.

use std::collections::BTreeMap;

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Mesh, Root};

use super::accessor::{read, read_colors};
use super::buffers::Buffers;
use crate::InputMesh;
use crate::read::finish::{NO_MATERIAL, WHITE};
use crate::read::{ReadError, check_triangles, check_vertices};

/// The vertices of a primitive: its accessors of normals, texture coordinates and colours.
type Attributes = [Option<Index<Accessor>>; 3];

/// The numbers of the accessors, that of the positions first.
type Streams = [Option<usize>; 4];

/// Collects the triangles of all meshes that are added.
pub(super) struct Meshes<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    pub(super) mesh: InputMesh,
}

impl<'a> Meshes<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a Buffers<'a>) -> Self {
        let mesh = InputMesh::default();
        Self {
            root,
            buffers,
            mesh,
        }
    }

    /// Adds a mesh, transformed. Transforms that mirror turn the winding, so that outside stays outside.
    pub(super) fn add(&mut self, index: Index<Mesh>, transform: DMat4) -> Result<(), ReadError> {
        let place = || format!("mesh {}", index.value());
        let mesh = self
            .root
            .get(index)
            .ok_or_else(|| ReadError::malformed(place(), "it does not exist"))?;
        // Primitives often share their vertices; those are taken once per instance.
        let mut added: BTreeMap<Streams, (u32, u32)> = BTreeMap::new();
        for primitive in &mesh.primitives {
            let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) =
                primitive.mode
            else {
                continue;
            };
            let stream = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
            let Some(positions) = stream(Semantic::Positions) else {
                continue;
            };
            let attributes = [
                stream(Semantic::Normals),
                stream(Semantic::TexCoords(0)),
                stream(Semantic::Colors(0)),
            ];
            let [normals, uvs, colors] = attributes.map(|a| a.map(|a| a.value()));
            let key = [Some(positions.value()), normals, uvs, colors];
            let vertices = match added.get(&key) {
                Some(&vertices) => vertices,
                None => {
                    let vertices = self.add_vertices(positions, attributes, transform)?;
                    added.insert(key, vertices);
                    vertices
                }
            };
            self.add_triangles(primitive, mode, vertices, transform.determinant() < 0.0)?;
        }
        Ok(())
    }

    /// Their first index and count.
    fn add_vertices(
        &mut self,
        positions: Index<Accessor>,
        [normals, uvs, colors]: Attributes,
        transform: DMat4,
    ) -> Result<(u32, u32), ReadError> {
        let positions = read::<3>(self.root, self.buffers, positions)?;
        let first = self.mesh.positions.len();
        let count = positions.len();
        check_vertices((first + count) as u64)?;
        self.mesh.positions.extend(
            positions
                .into_iter()
                .map(|p| transform.transform_point3(DVec3::from(p))),
        );
        if let Some(normals) = normals {
            let normals = read::<3>(self.root, self.buffers, normals)?;
            // Cofactors instead of the inverse's transpose: the same up to a factor, and there for singular ones, too.
            let m = DMat3::from_mat4(transform);
            let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
            let turn = DMat3::from_cols(
                m.y_axis.cross(m.z_axis),
                m.z_axis.cross(m.x_axis),
                m.x_axis.cross(m.y_axis),
            );
            let turned = normals.into_iter().take(count);
            self.mesh.normals.resize(first, Vec3::ZERO);
            self.mesh.normals.extend(turned.map(|n| {
                (sign * (turn * DVec3::from(n)))
                    .normalize_or_zero()
                    .as_vec3()
            }));
        }
        if let Some(uvs) = uvs {
            let uvs = read::<2>(self.root, self.buffers, uvs)?;
            self.mesh.uvs.resize(first, Vec2::ZERO);
            self.mesh.uvs.extend(
                uvs.into_iter()
                    .take(count)
                    .map(|[u, v]| Vec2::new(u as f32, v as f32)),
            );
        }
        if let Some(colors) = colors {
            let colors = read_colors(self.root, self.buffers, colors)?;
            self.mesh.colors.resize(first, WHITE);
            self.mesh.colors.extend(colors.into_iter().take(count));
        }
        if !self.mesh.colors.is_empty() {
            self.mesh.colors.resize(first + count, WHITE);
        }
        if !self.mesh.normals.is_empty() {
            self.mesh.normals.resize(first + count, Vec3::ZERO);
        }
        if !self.mesh.uvs.is_empty() {
            self.mesh.uvs.resize(first + count, Vec2::ZERO);
        }
        Ok((first as u32, count as u32))
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        mode: Mode,
        (first, count): (u32, u32),
        mirrored: bool,
    ) -> Result<(), ReadError> {
        let corners: Vec<u32> = match primitive.indices {
            Some(indices) => read::<1>(self.root, self.buffers, indices)?
                .iter()
                .map(|&[i]| i as u32)
                .collect(),
            None => (0..count).collect(),
        };
        let number = match mode {
            Mode::Triangles => corners.len() / 3,
            _ => corners.len().saturating_sub(2),
        };
        check_triangles((self.mesh.triangles.len() + number) as u64)?;
        for t in 0..number {
            let places = match mode {
                Mode::Triangles => [3 * t, 3 * t + 1, 3 * t + 2],
                Mode::TriangleFan => [0, t + 1, t + 2],
                _ if t % 2 == 0 => [t, t + 1, t + 2],
                _ => [t + 1, t, t + 2],
            };
            let mut triangle = places.map(|place| corners[place]);
            if let Some(&outside) = triangle.iter().find(|&&v| v >= count) {
                return Err(ReadError::IndexOutOfRange {
                    face: self.mesh.triangles.len() + 1,
                    index: i64::from(outside),
                    vertices: count as usize,
                });
            }
            if mirrored {
                triangle.swap(1, 2);
            }
            self.mesh.triangles.push(triangle.map(|v| first + v));
        }
        let material = primitive.material.map_or(NO_MATERIAL, |m| m.value() as u32);
        if material != NO_MATERIAL && material as usize >= self.root.materials.len() {
            return Err(ReadError::malformed(
                format!("material {material}"),
                "it does not exist",
            ));
        }
        self.mesh
            .material_of_triangle
            .resize(self.mesh.triangles.len(), material);
        Ok(())
    }
}
