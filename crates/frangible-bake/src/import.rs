//! A mesh from a file as a shape to bake.

use std::sync::Arc;

use frangible::internals::asset::{RenderMaterial, RenderSurface};
use frangible_mesh::{
    InputMesh, MeshSolid, RepairReport, Similarity, SkinWall, Solid, Thickness, repair,
    wall_thickness,
};

use crate::error::{BakeError, positive};
use crate::groups::Group;
use crate::shapes::{Shape, SolidShape};

/// Places at which the walls are measured: the twentieth of them that is thinnest is then twenty or so.
const SAMPLES: usize = 400;

/// Settings for taking in a mesh.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportOptions {
    /// Longest side of the body, m; `None` (default): the file's unit is the metre.
    pub size: Option<f64>,
    /// Wanted tetrahedra of the fracture mesh, default 42 000; thin shells take more when they need them.
    pub tets: usize,
    /// Most tetrahedra, default 250 000 or three times `tets`, whichever is more.
    pub most: Option<usize>,
    /// Thickness of a wall along the mesh's surface, m, half of it on each side, instead of a filled inside; `None`
    /// (default): the body is the solid that the mesh encloses. Such a body is not drawn with its author's surface, which lies in the
    /// middle of the wall.
    pub wall: Option<f64>,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            size: None,
            tets: crate::shapes::FRACTURE_TETS as usize,
            most: None,
            wall: None,
        }
    }
}

/// A mesh taken in.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The solid inside the mesh.
    pub shape: Shape,
    /// The mesh as drawn, in the frame of the shape, unless the body is a wall along it: hand it to
    /// [`BakeSpec::render`](crate::BakeSpec::render).
    pub render: Option<RenderSurface>,
    /// Its groups, objects and materials by name, in the frame of the shape: hand them to
    /// [`BakeSpec::groups`](crate::BakeSpec::groups), for supports by name.
    pub groups: Vec<Group>,
    /// Repairs that were made.
    pub mended: RepairReport,
    /// Thickness of the solid that the mesh encloses, m.
    pub thickness: Thickness,
    /// Transform from the file's coordinates to those of the shape.
    pub similarity: Similarity,
}

/// Repairs a mesh, finds its inside and its walls.
///
/// # Errors
/// A mesh that cannot be meant as a solid, or a number that cannot be used.
pub fn import_mesh(mesh: &InputMesh, options: &ImportOptions) -> Result<Imported, BakeError> {
    positive("the number of tetrahedra wanted", options.tets as f64)?;
    let (mut surface, mended) = repair(mesh)?;
    let similarity = match options.size {
        Some(size) => {
            positive("the size, in m,", size)?;
            surface.resize(size)
        }
        None => Similarity::IDENTITY,
    };
    let solid = MeshSolid::new(&surface)?;
    let thickness = wall_thickness(&solid, SAMPLES, 1);
    let (solid, wall): (Arc<dyn Solid>, _) = match options.wall {
        Some(wall) => {
            positive("the thickness of the wall, in m,", wall)?;
            (Arc::new(SkinWall::new(solid, wall)), Some(wall))
        }
        None => (Arc::new(solid), thickness.of_shell()),
    };
    let shape = SolidShape {
        wall,
        tets: options.tets,
        most: options.most.unwrap_or((3 * options.tets).max(250_000)),
        ..SolidShape::new(solid)
    };
    Ok(Imported {
        shape: Shape::Solid(shape),
        render: (options.wall.is_none()).then(|| drawn(mesh, &similarity)),
        groups: Group::of_mesh(mesh, &similarity),
        mended,
        thickness,
        similarity,
    })
}

/// The mesh as drawn, its vertices, texture coordinates, normals, colours and materials kept.
fn drawn(mesh: &InputMesh, similarity: &Similarity) -> RenderSurface {
    RenderSurface {
        positions: mesh
            .positions
            .iter()
            .map(|&p| similarity.apply(p).as_vec3())
            .collect(),
        normals: mesh.normals.clone(),
        uvs: mesh.uvs.iter().map(|uv| uv.to_array()).collect(),
        colors: mesh.colors.clone(),
        triangles: mesh.triangles.clone(),
        material_of_triangle: mesh.material_of_triangle.clone(),
        materials: mesh
            .materials
            .iter()
            .map(|m| RenderMaterial {
                name: m.name.clone(),
                base_color: m.base_color,
                metallic: m.metallic,
                roughness: m.roughness,
            })
            .collect(),
    }
}
