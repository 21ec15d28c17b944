//! Primitives of placed meshes to triangles.

use std::collections::BTreeMap;

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Index, Mesh, Root};

use super::accessor::{read, read_colors};
use super::buffers::Buffers;
use super::deform::{morph, skinned};
use crate::InputMesh;
use crate::read::finish::{NO_MATERIAL, WHITE};
use crate::read::{ReadError, check_triangles, check_vertices};

/// Sets of texture coordinates that are kept of a vertex.
pub(super) const UV_SETS: u32 = 8;

/// Placement of a mesh.
#[derive(Clone, Copy)]
pub(super) struct Placed<'a> {
    pub(super) transform: DMat4,
    /// Weights of the morph targets.
    pub(super) weights: &'a [f32],
    /// Transforms of the joints of its skin.
    pub(super) joints: Option<&'a [DMat4]>,
}

/// Numbers of the accessors of a primitive's vertices.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Streams {
    positions: usize,
    normals: Option<usize>,
    colors: Option<usize>,
    uvs: Vec<Option<usize>>,
    /// Joints and their weights, four each.
    joints: Vec<[usize; 2]>,
    /// Displacements of positions and normals by each morph target.
    targets: Vec<[Option<usize>; 2]>,
}

impl Streams {
    fn of(primitive: &Primitive) -> Option<Self> {
        let stream = |semantic| {
            let found = primitive.attributes.get(&Checked::Valid(semantic));
            found.map(|index| index.value())
        };
        let mut uvs: Vec<_> = (0..UV_SETS)
            .map(|set| stream(Semantic::TexCoords(set)))
            .collect();
        uvs.truncate(
            uvs.iter()
                .rposition(Option::is_some)
                .map_or(0, |last| last + 1),
        );
        let joints = (0..).map_while(|set| {
            let weights = stream(Semantic::Weights(set))?;
            Some([stream(Semantic::Joints(set))?, weights])
        });
        let targets = primitive.targets.iter().flatten().map(|target| {
            [target.positions, target.normals].map(|index| index.map(|index| index.value()))
        });
        Some(Self {
            positions: stream(Semantic::Positions)?,
            normals: stream(Semantic::Normals),
            colors: stream(Semantic::Colors(0)),
            uvs,
            joints: joints.collect(),
            targets: targets.collect(),
        })
    }

    /// The displacements that count, with their weights: of positions (0) or of normals (1).
    fn moves(&self, which: usize, weights: &[f32]) -> impl Iterator<Item = (usize, f64)> {
        let targets = self.targets.iter().zip(weights);
        targets.filter_map(move |(target, &weight)| {
            let weight = f64::from(weight);
            Some((target[which]?, weight)).filter(|_| weight.is_finite() && weight != 0.0)
        })
    }
}

/// Vertices that have been added.
#[derive(Clone, Copy)]
struct Added {
    first: u32,
    count: u32,
    /// True if their transform mirrors.
    mirrored: bool,
}

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
    pub(super) fn add(&mut self, index: Index<Mesh>, placed: Placed) -> Result<(), ReadError> {
        let place = || format!("mesh {}", index.value());
        let mesh = self
            .root
            .get(index)
            .ok_or_else(|| ReadError::malformed(place(), "it does not exist"))?;
        // Primitives often share their vertices; those are taken once per instance.
        let mut added: BTreeMap<Streams, Added> = BTreeMap::new();
        for primitive in &mesh.primitives {
            let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) =
                primitive.mode
            else {
                self.mesh.leave_out("points and lines");
                continue;
            };
            let Some(streams) = Streams::of(primitive) else {
                continue;
            };
            let vertices = match added.get(&streams) {
                Some(&vertices) => vertices,
                None => {
                    let vertices = self.add_vertices(&streams, placed)?;
                    added.insert(streams, vertices);
                    vertices
                }
            };
            self.add_triangles(primitive, mode, vertices)?;
        }
        Ok(())
    }

    fn add_vertices(&mut self, streams: &Streams, placed: Placed) -> Result<Added, ReadError> {
        let (root, buffers) = (self.root, self.buffers);
        let rows = |at: usize| read::<3>(root, buffers, Index::new(at as u32));
        let mut positions = rows(streams.positions)?;
        let first = self.mesh.positions.len();
        let count = positions.len();
        check_vertices((first + count) as u64)?;
        morph(
            root,
            buffers,
            streams.moves(0, placed.weights),
            &mut positions,
        )?;
        let skin = match placed.joints {
            Some(joints) if !streams.joints.is_empty() => {
                Some(skinned(root, buffers, &streams.joints, joints, count)?)
            }
            _ => None,
        };
        let transform = |v: usize| skin.as_ref().map_or(placed.transform, |list| list[v]);
        let mirrors = |m: DMat4| m.determinant() < 0.0;
        let mirrored = match &skin {
            Some(list) => 2 * list.iter().filter(|&&m| mirrors(m)).count() > count,
            None => mirrors(placed.transform),
        };
        let moved = positions.into_iter().enumerate();
        self.mesh
            .positions
            .extend(moved.map(|(v, p)| transform(v).transform_point3(DVec3::from(p))));
        if let Some(normals) = streams.normals {
            let mut normals = rows(normals)?;
            morph(
                root,
                buffers,
                streams.moves(1, placed.weights),
                &mut normals,
            )?;
            let turned = normals.into_iter().take(count).enumerate();
            self.mesh.normals.resize(first, Vec3::ZERO);
            self.mesh
                .normals
                .extend(turned.map(|(v, n)| turned_normal(transform(v), DVec3::from(n))));
        }
        for (set, accessor) in streams.uvs.iter().enumerate() {
            let Some(accessor) = accessor else {
                continue;
            };
            let uvs = read::<2>(root, buffers, Index::new(*accessor as u32))?;
            let list = match set.checked_sub(1) {
                None => &mut self.mesh.uvs,
                Some(more) => {
                    let all = &mut self.mesh.more_uvs;
                    all.resize(all.len().max(more + 1), Vec::new());
                    &mut all[more]
                }
            };
            list.resize(first, Vec2::ZERO);
            let uvs = uvs.into_iter().take(count);
            list.extend(uvs.map(|[u, v]| Vec2::new(u as f32, v as f32)));
        }
        if let Some(colors) = streams.colors {
            let colors = read_colors(root, buffers, Index::new(colors as u32))?;
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
        Ok(Added {
            first: first as u32,
            count: count as u32,
            mirrored,
        })
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        mode: Mode,
        added: Added,
    ) -> Result<(), ReadError> {
        let corners: Vec<u32> = match primitive.indices {
            Some(indices) => read::<1>(self.root, self.buffers, indices)?
                .iter()
                .map(|&[i]| i as u32)
                .collect(),
            None => (0..added.count).collect(),
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
            if let Some(&outside) = triangle.iter().find(|&&v| v >= added.count) {
                return Err(ReadError::IndexOutOfRange {
                    face: self.mesh.triangles.len() + 1,
                    index: i64::from(outside),
                    vertices: added.count as usize,
                });
            }
            if added.mirrored {
                triangle.swap(1, 2);
            }
            self.mesh.triangles.push(triangle.map(|v| added.first + v));
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

/// A normal after a transform. Cofactors instead of the inverse's transpose: the same up to a factor, and there for singular ones, too.
fn turned_normal(transform: DMat4, normal: DVec3) -> Vec3 {
    let m = DMat3::from_mat4(transform);
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    let turn = DMat3::from_cols(
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    );
    (sign * (turn * normal)).normalize_or_zero().as_vec3()
}
