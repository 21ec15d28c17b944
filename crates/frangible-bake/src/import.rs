//! Import of meshes as shapes to bake.

use std::borrow::Cow;
use std::sync::Arc;

use frangible::glam::DVec3;
use frangible::internals::asset::RenderSurface;
use frangible_mesh::{
    InputMesh, MeshSolid, PartChoice, Parts, RepairReport, Similarity, SkinWall, Solid, Surface,
    Thickness, VolumeAim, Wall, WeldedSolid, repair, repair_skin, wall_thickness,
};

use crate::error::{BakeError, positive};
use crate::groups::Group;
use crate::import_walls::{layered, measures, sheet};
use crate::shapes::{Shape, SolidShape};

/// Places at which the walls are measured: the twentieth of them that is thinnest is then twenty or so.
const SAMPLES: usize = 400;

/// Tetrahedra that a body among others gets at least, unless fewer are wanted in all.
const LEAST_TETS: usize = 1000;

/// Points along the longest side of a body whose centre is counted.
const GRID: f64 = 48.0;

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
    /// What becomes of several parts, default [`PartChoice::Auto`]: each is a body. A wall is always one body.
    pub parts: PartChoice,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            size: None,
            tets: crate::shapes::FRACTURE_TETS as usize,
            most: None,
            wall: None,
            parts: PartChoice::Auto,
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

/// A body of a mesh that has several.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ImportedPart {
    /// Name in the file, different from those of the other parts; empty if the mesh is one part.
    pub name: String,
    /// Centre of the volume inside, m, in the frame of the shape, which all parts share. The body frame of the asset has its origin there, but
    /// for the error of its tetrahedra.
    pub centre: DVec3,
    /// Requested number of tetrahedra of its fracture mesh: its share of [`ImportOptions::tets`].
    pub tets: usize,
    /// The body, in the frame of the whole mesh.
    pub body: Imported,
}

/// The bodies of a mesh.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ImportedParts {
    /// The bodies, in the order of the file; at least one.
    pub parts: Vec<ImportedPart>,
    /// What was found and chosen, in one line; `None` for a mesh of a single part.
    pub note: Option<String>,
}

/// Repairs a mesh of one body and determines its interior and wall thickness.
///
/// A thin wall, given by its two faces or as a sheet with [`ImportOptions::wall`], becomes a [`Shape::Wall`]. Anything else is filled by a
/// lattice, as a [`Shape::Solid`].
///
/// # Errors
/// The mesh does not describe a solid, or describes several and [`ImportOptions::parts`] does not choose one, or a value is invalid.
pub fn import_mesh(mesh: &InputMesh, options: &ImportOptions) -> Result<Imported, BakeError> {
    let ImportedParts { mut parts, note } = import_parts(mesh, options)?;
    match (parts.pop(), parts.is_empty()) {
        (Some(only), true) => Ok(only.body),
        _ => Err(BakeError::SeveralParts {
            found: note.unwrap_or_default(),
        }),
    }
}

/// Finds the parts of a mesh, and imports those that [`ImportOptions::parts`] chooses. Each is meshed alone, so that no gap between them is
/// closed. They share the requested tetrahedra by their volumes.
///
/// # Errors
/// The mesh does not describe a solid, its parts cannot be chosen so, or a value is invalid.
pub fn import_parts(mesh: &InputMesh, options: &ImportOptions) -> Result<ImportedParts, BakeError> {
    positive("the number of tetrahedra wanted", options.tets as f64)?;
    let similarity = match options.size {
        Some(size) => {
            positive("the size, in m,", size)?;
            Similarity::resizing(used_bounds(mesh), size)
        }
        None => Similarity::IDENTITY,
    };
    if let Some(wall) = options.wall {
        positive("the thickness of the wall, in m,", wall)?;
        if options.parts != PartChoice::Auto {
            return Err(BakeError::PartsOfWall);
        }
        let (mut surface, mended) = repair_skin(mesh)?;
        if similarity != Similarity::IDENTITY {
            surface.transform(&similarity);
        }
        let layers = (mended.shells == 1)
            .then(|| Wall::of_skin(&surface, wall))
            .flatten();
        let body = Solved {
            thickness: measures(layers.as_ref(), wall),
            solid: Arc::new(SkinWall::new(MeshSolid::skin(&surface)?, wall)),
            wall: Some(wall),
            volume: VolumeAim::Lattice,
            layers,
            mended,
            centre: centre_of(&surface),
        };
        return Ok(ImportedParts {
            parts: vec![ImportedPart {
                name: String::new(),
                centre: body.centre,
                tets: options.tets,
                body: body.imported((mesh, ""), similarity, options, options.tets),
            }],
            note: None,
        });
    }
    let mut moved = Cow::Borrowed(mesh);
    if similarity != Similarity::IDENTITY {
        moved.to_mut().transform(&similarity);
    }
    let found = Parts::of(&moved)?;
    let chosen = found.choose(&moved, &options.parts)?;
    let total: f64 = chosen.bodies.iter().map(|body| body.volume).sum();
    let mut parts = Vec::with_capacity(chosen.bodies.len());
    for body in &chosen.bodies {
        let tets = match chosen.bodies.len() {
            1 => options.tets,
            _ => {
                let share = (options.tets as f64 * body.volume / total) as usize;
                share.max(LEAST_TETS.min(options.tets))
            }
        };
        let own = found.mesh(mesh, &body.parts);
        let solved = match chosen.weld {
            Some(gap) => welded(mesh, &similarity, &found, gap)?,
            None => {
                let exact = body.is_exact.then_some(VolumeAim::Exact(body.volume));
                solved(&own, &similarity, exact.unwrap_or(VolumeAim::Counted))?
            }
        };
        let first = body.parts.first().and_then(|&part| found.list.get(part));
        let name = match (&body.name[..], first) {
            ("", Some(first)) => &first.name,
            (name, _) => name,
        };
        parts.push(ImportedPart {
            name: body.name.clone(),
            centre: solved.centre,
            tets,
            body: solved.imported((&own, name), similarity, options, tets),
        });
    }
    let note = chosen.note;
    Ok(ImportedParts { parts, note })
}

/// Lowest and highest corner of the vertices that triangles use.
fn used_bounds(mesh: &InputMesh) -> [DVec3; 2] {
    let used = mesh.triangles.iter().flatten();
    let places = used.filter_map(|&v| mesh.positions.get(v as usize));
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    places.fold(nothing, |[low, high], &p| [low.min(p), high.max(p)])
}

fn repaired(
    mesh: &InputMesh,
    similarity: &Similarity,
) -> Result<(Surface, RepairReport), BakeError> {
    let (mut surface, mended) = repair(mesh)?;
    if *similarity != Similarity::IDENTITY {
        surface.transform(similarity);
    }
    Ok((surface, mended))
}

/// A solid, and what is known of it.
struct Solved {
    solid: Arc<dyn Solid>,
    /// The wall that it is, to be meshed in layers if that succeeds.
    layers: Option<Wall>,
    wall: Option<f64>,
    volume: VolumeAim,
    mended: RepairReport,
    thickness: Thickness,
    centre: DVec3,
}

/// The solid inside one part.
fn solved(
    mesh: &InputMesh,
    similarity: &Similarity,
    volume: VolumeAim,
) -> Result<Solved, BakeError> {
    let (surface, mended) = repaired(mesh, similarity)?;
    sheet(&surface, &mended)?;
    let solid = MeshSolid::new(&surface)?;
    let thickness = wall_thickness(&solid, SAMPLES, 1);
    Ok(Solved {
        layers: Wall::of_closed(&surface, &mended),
        wall: thickness.of_shell(),
        centre: match volume {
            VolumeAim::Exact(_) => centre_of(&surface),
            _ => counted_centre(&solid),
        },
        solid: Arc::new(solid),
        volume,
        mended,
        thickness,
    })
}

/// All parts as one solid, gaps of at most this width filled.
fn welded(
    mesh: &InputMesh,
    similarity: &Similarity,
    parts: &Parts,
    gap: f64,
) -> Result<Solved, BakeError> {
    let (_, mended) = repaired(mesh, similarity)?;
    let mut solids = Vec::with_capacity(parts.list.len());
    let mut thinnest: Option<Thickness> = None;
    for part in 0..parts.list.len() {
        let (surface, _) = repaired(&parts.mesh(mesh, &[part]), similarity)?;
        let solid = MeshSolid::new(&surface)?;
        let thickness = wall_thickness(&solid, SAMPLES, 1);
        let of = |t: &Thickness| t.of_shell().unwrap_or(f64::INFINITY);
        if thinnest.as_ref().is_none_or(|t| of(&thickness) < of(t)) {
            thinnest = Some(thickness);
        }
        solids.push(solid);
    }
    let thickness = match thinnest {
        Some(thickness) => thickness,
        None => return solved(mesh, similarity, VolumeAim::Counted),
    };
    let bounds = used_bounds(mesh).map(|p| similarity.apply(p));
    Ok(Solved {
        wall: thickness.of_shell(),
        solid: Arc::new(WeldedSolid::new(solids, gap)),
        layers: None,
        // In narrow gaps the count is too low.
        volume: VolumeAim::Lattice,
        mended,
        centre: 0.5 * (bounds[0] + bounds[1]),
        thickness,
    })
}

/// Centre of the volume inside a closed surface.
fn centre_of(surface: &Surface) -> DVec3 {
    let [low, high] = surface.bounds();
    let middle = 0.5 * (low + high);
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for t in 0..surface.triangles.len() {
        let [a, b, c] = surface.corners(t).map(|p| p - middle);
        let volume = a.dot(b.cross(c));
        sum += 0.25 * volume * (a + b + c);
        total += volume;
    }
    let centre = middle + sum / total;
    if centre.is_finite() { centre } else { middle }
}

/// Centre of the points of a grid that lie inside, for surfaces that overlap or have holes.
fn counted_centre(solid: &MeshSolid) -> DVec3 {
    let [low, high] = solid.bounds();
    let step = (high - low).max_element() / GRID;
    let counts = ((high - low) / step).to_array().map(|n| n.ceil() as usize);
    let extent = step * DVec3::from_array(counts.map(|n| n as f64));
    let first = 0.5 * (low + high) - 0.5 * extent + 0.5 * step;
    let points = (0..counts.iter().product::<usize>()).map(|i| {
        let place = [
            i % counts[0],
            i / counts[0] % counts[1],
            i / counts[0] / counts[1],
        ];
        first + step * DVec3::from_array(place.map(|n| n as f64))
    });
    let points: Vec<DVec3> = points.collect();
    let inside = solid.inside_many(&points);
    let (mut sum, mut number) = (DVec3::ZERO, 0.0);
    for (p, _) in points.iter().zip(inside).filter(|(_, inside)| *inside) {
        sum += *p;
        number += 1.0;
    }
    if number > 0.0 {
        sum / number
    } else {
        0.5 * (low + high)
    }
}

impl Solved {
    fn imported(
        self,
        (mesh, name): (&InputMesh, &str),
        similarity: Similarity,
        options: &ImportOptions,
        tets: usize,
    ) -> Imported {
        let lattice = SolidShape {
            wall: self.wall,
            tets,
            most: options.most.unwrap_or((3 * options.tets).max(250_000)),
            volume: self.volume,
            ..SolidShape::new(self.solid)
        };
        let layers = self.layers.and_then(|wall| layered(wall, tets));
        Imported {
            shape: layers.unwrap_or(Shape::Solid(lattice)),
            render: (options.wall.is_none()).then(|| drawn(mesh, name, &similarity)),
            groups: Group::of_mesh(mesh, &similarity),
            mended: self.mended,
            thickness: self.thickness,
            similarity,
        }
    }
}

/// The mesh as drawn, its vertices, texture coordinates, normals, colours and materials kept.
fn drawn(mesh: &InputMesh, name: &str, similarity: &Similarity) -> RenderSurface {
    RenderSurface {
        name: name.to_owned(),
        positions: mesh
            .positions
            .iter()
            .map(|&p| similarity.apply(p).as_vec3())
            .collect(),
        normals: mesh.normals.clone(),
        uvs: mesh.uvs.iter().map(|uv| uv.to_array()).collect(),
        more_uvs: mesh
            .more_uvs
            .iter()
            .map(|uvs| uvs.iter().map(|uv| uv.to_array()).collect())
            .collect(),
        colors: mesh.colors.clone(),
        srgb_colors: mesh.srgb_colors,
        triangles: mesh.triangles.clone(),
        material_of_triangle: mesh.material_of_triangle.clone(),
        materials: mesh.materials.clone(),
        images: mesh.images.clone(),
    }
}
