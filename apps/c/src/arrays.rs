//! Arrays that handles keep, and structs that point into them.

use std::sync::OnceLock;

use frangible::glam::DQuat;
use frangible::internals::MassProperties;
use frangible::internals::mesh::symmetric_eigen;
use frangible::{Asset, Fragment};
use frangible_js::drawn::Drawn;
use frangible_js::hulls::{hulls_of_body, hulls_of_fragment};

use crate::types::{frangible_geometry, frangible_group, frangible_hulls, frangible_solid};

/// Convex parts, one after the other.
#[derive(Debug, Default)]
struct Hulls {
    points: Vec<f32>,
    ends: Vec<usize>,
}

/// A mesh to draw.
#[derive(Debug, Default)]
struct Mesh {
    drawn: Drawn,
    /// Its further texture coordinates, one set after the other.
    more_uvs: Vec<f32>,
    groups: Vec<frangible_group>,
}

impl From<Drawn> for Mesh {
    fn from(drawn: Drawn) -> Self {
        let groups = drawn.groups.iter().map(|group| frangible_group {
            first: group.first,
            count: group.count,
            look: group.material as usize,
        });
        Self {
            more_uvs: drawn.more_uvs.concat(),
            groups: groups.collect(),
            drawn,
        }
    }
}

/// The array, or null if it is empty.
fn or_null<T>(list: &[T]) -> *const T {
    if list.is_empty() {
        std::ptr::null()
    } else {
        list.as_ptr()
    }
}

/// A closed surface.
#[derive(Debug, Default)]
struct Surface {
    positions: Vec<f32>,
    indices: Vec<u32>,
    outer_indices: usize,
}

/// Arrays of a kind or of a fragment. Each is made when it is first asked for, and stays where it is until its handle is freed.
#[derive(Debug, Default)]
pub(crate) struct Arrays {
    mesh: OnceLock<Mesh>,
    hulls: OnceLock<Hulls>,
    surface: OnceLock<Surface>,
}

/// Source of flat arrays.
#[derive(Clone, Copy)]
pub(crate) enum Whose<'a> {
    /// A whole body.
    Body(&'a Asset),
    /// A fragment of a body.
    Fragment(&'a Asset, &'a Fragment),
}

impl Arrays {
    /// The mesh to draw.
    pub(crate) fn geometry(&self, whose: Whose<'_>) -> frangible_geometry {
        let mesh = self.mesh.get_or_init(|| match whose {
            Whose::Body(asset) => Drawn::whole(asset).into(),
            Whose::Fragment(asset, fragment) => Drawn::fragment(asset, fragment).into(),
        });
        let drawn = &mesh.drawn;
        frangible_geometry {
            vertices: drawn.positions.len() / 3,
            positions: drawn.positions.as_ptr(),
            normals: drawn.normals.as_ptr(),
            uvs: drawn.uvs.as_ptr(),
            indices_count: drawn.indices.len(),
            outer_indices: drawn.outer_indices,
            indices: drawn.indices.as_ptr(),
            more_uv_sets: drawn.more_uvs.len(),
            more_uvs: or_null(&mesh.more_uvs),
            colors: or_null(&drawn.colors),
            groups_count: mesh.groups.len(),
            groups: or_null(&mesh.groups),
            ..Default::default()
        }
    }

    /// The convex parts.
    pub(crate) fn hulls(&self, whose: Whose<'_>) -> frangible_hulls {
        let hulls = self.hulls.get_or_init(|| {
            let mut hulls = Hulls::default();
            let parts = match whose {
                Whose::Body(asset) => hulls_of_body(asset),
                Whose::Fragment(_, fragment) => hulls_of_fragment(fragment),
            };
            for part in parts {
                hulls.points.extend(part);
                hulls.ends.push(hulls.points.len() / 3);
            }
            hulls
        });
        frangible_hulls {
            count: hulls.ends.len(),
            points: hulls.points.as_ptr(),
            ends: hulls.ends.as_ptr(),
            ..Default::default()
        }
    }

    /// The closed surface of a fragment, without vertices that are doubled.
    pub(crate) fn surface(&self, fragment: &Fragment) -> frangible_geometry {
        let surface = self.surface.get_or_init(|| {
            let mesh = &fragment.mesh;
            Surface {
                positions: mesh.positions.iter().flat_map(|p| p.to_array()).collect(),
                indices: mesh.triangles.as_flattened().to_vec(),
                outer_indices: 3 * mesh.outer_triangles,
            }
        });
        frangible_geometry {
            vertices: surface.positions.len() / 3,
            positions: surface.positions.as_ptr(),
            indices_count: surface.indices.len(),
            outer_indices: surface.outer_indices,
            indices: surface.indices.as_ptr(),
            ..Default::default()
        }
    }
}

/// Masses as a struct.
pub(crate) fn solid(mass: &MassProperties, supported: bool) -> frangible_solid {
    let (moments, axes) = symmetric_eigen(mass.inertia);
    frangible_solid {
        supported: supported.into(),
        mass: mass.mass,
        volume: mass.volume,
        centre: mass.centre.to_array(),
        inertia: mass.inertia.to_cols_array(),
        moments: moments.to_array(),
        axes: DQuat::from_mat3(&axes).normalize().to_array(),
        ..Default::default()
    }
}
