//! Import of meshes as shapes to bake.

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

/// Settings for importing a mesh.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportOptions {
    /// Length of the longest side of the body, m; `None` (default): the file is in metres.
    pub size: Option<f64>,
    /// Requested number of tetrahedra of the fracture mesh, default 42 000; thin shells get more if needed.
    pub tets: usize,
    /// Largest number of tetrahedra; default 250 000 or three times `tets`, whichever is larger.
    pub most: Option<usize>,
    /// Thickness of a wall centred on the surface of the mesh, m; `None` (default): the body is the solid that the mesh encloses. A wall is
    /// not rendered with the authored surface, which lies in its middle.
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

/// An imported mesh.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The solid inside the mesh.
    pub shape: Shape,
    /// The authored surface in the frame of the shape, for [`BakeSpec::render`](crate::BakeSpec::render); `None` if the body is a wall along
    /// the mesh.
    pub render: Option<RenderSurface>,
    /// Groups, objects and materials by name, in the frame of the shape, for [`BakeSpec::groups`](crate::BakeSpec::groups) and supports by
    /// name.
    pub groups: Vec<Group>,
    /// Repairs that were made.
    pub mended: RepairReport,
    /// Thickness of the solid that the mesh encloses, m.
    pub thickness: Thickness,
    /// Transform from the file's coordinates to those of the shape.
    pub similarity: Similarity,
}

/// Repairs a mesh and determines its interior and wall thickness.
///
/// # Errors
/// The mesh does not describe a solid, or a value is invalid.
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
