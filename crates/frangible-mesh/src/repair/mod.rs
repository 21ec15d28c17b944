//! Repair: turns the triangles of a file into a surface that a solid can be made of.

pub(crate) mod column;
pub(crate) mod duplicates;
pub(crate) mod edges;
mod patches;
mod report;
mod shells;
mod weld;

use frangible_geometry::DisjointSets;
use glam::DVec3;
use thiserror::Error;

pub use report::RepairReport;

use self::edges::Edges;
use self::patches::Patches;
use crate::{InputMesh, Surface};

/// A mesh whose vertices lie this close to a plane is flat, as a share of the bounding box's diagonal.
const FLAT: f64 = 1e-6;

/// A triangle lower than this share of its longest side has no area.
const NEEDLE: f64 = 1e-10;

/// Coordinates beyond this would overflow in a volume.
const LARGEST: f64 = 1e60;

/// Error of repairing a surface. Faces and vertices are counted from 1.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RepairError {
    /// No triangles to repair.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// Every triangle is a point or a line.
    #[error("none of the mesh's {0} triangles has an area")]
    NoArea(usize),
    /// All in a plane.
    #[error(
        "the mesh is flat: all its vertices lie in one plane; give it a thickness with `--wall METRES`, or extrude it"
    )]
    Flat,
    /// NaN, infinite, or absurdly far away.
    #[error("vertex {vertex} has a coordinate that is not a finite number below 1e60")]
    NotFinite {
        /// Number of the vertex, from 1.
        vertex: usize,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {index} (from 0), but there are only {vertices}")]
    IndexOutOfRange {
        /// Number of the triangle, from 1.
        triangle: usize,
        /// The index, from 0.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
}

/// Makes a surface: welds vertices in one place and closes hairline cracks, drops empty and doubled triangles, winds
/// every shell outwards and every cavity inwards. Holes, crossings and edges of three triangles stay.
///
/// The same mesh gives the same bits. Time grows as n log n.
///
/// # Errors
/// [`RepairError`] if there is nothing that could bound a solid. A bent open sheet is no error here.
pub fn repair(mesh: &InputMesh) -> Result<(Surface, RepairReport), RepairError> {
    mended(mesh, false)
}

/// Like [`repair`], for a surface that need not enclose anything, such as a flat sheet.
///
/// # Errors
/// [`RepairError`] if no triangle has an area.
pub fn repair_skin(mesh: &InputMesh) -> Result<(Surface, RepairReport), RepairError> {
    mended(mesh, true)
}

fn mended(mesh: &InputMesh, may_be_flat: bool) -> Result<(Surface, RepairReport), RepairError> {
    let (bounds, used) = check(mesh)?;
    let diagonal = (bounds[1] - bounds[0]).length();
    let faces_in = mesh.triangles.len();
    let mut report = RepairReport {
        skipped: mesh.skipped_faces,
        loose: mesh.positions.len() - used,
        ..RepairReport::default()
    };
    let Welded {
        positions,
        mut triangles,
        ..
    } = welded(mesh, bounds);
    report.welded = used - positions.len();
    report.degenerate = faces_in - triangles.len();
    if triangles.iter().all(|&t| has_no_area(&positions, t)) {
        return Err(RepairError::NoArea(faces_in));
    }
    report.duplicate = duplicates::drop_duplicates(&mut triangles, positions.len());
    if !may_be_flat && is_flat(&positions, diagonal) {
        return Err(RepairError::Flat);
    }
    wind(&positions, &mut triangles, &mut report);

    // Needles are kept until here because they hold their neighbours together.
    let with_needles = triangles.len();
    triangles.retain(|&t| !has_no_area(&positions, t));
    report.degenerate += with_needles - triangles.len();
    let positions = compact(&positions, &mut triangles);
    if triangles.is_empty() {
        return Err(RepairError::NoArea(faces_in));
    }
    report.vertices_out = positions.len();
    report.faces_out = triangles.len();
    Ok((
        Surface {
            positions,
            triangles,
        },
        report,
    ))
}

/// The box around all vertices that triangles use, and their number.
fn check(mesh: &InputMesh) -> Result<([DVec3; 2], usize), RepairError> {
    if mesh.triangles.is_empty() {
        return Err(RepairError::NoTriangles);
    }
    let mut is_used = vec![false; mesh.positions.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        for &index in triangle {
            let flag = is_used.get_mut(index as usize);
            *flag.ok_or(RepairError::IndexOutOfRange {
                triangle: t + 1,
                index,
                vertices: mesh.positions.len(),
            })? = true;
        }
    }
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let mut used = 0;
    for (v, &p) in mesh
        .positions
        .iter()
        .enumerate()
        .filter(|(v, _)| is_used[*v])
    {
        if !(p.is_finite() && p.abs().max_element() < LARGEST) {
            return Err(RepairError::NotFinite { vertex: v + 1 });
        }
        bounds = [bounds[0].min(p), bounds[1].max(p)];
        used += 1;
    }
    Ok((bounds, used))
}

/// Vertices in use, in their order; the triangles follow.
fn compact(positions: &[DVec3], triangles: &mut [[u32; 3]]) -> Vec<DVec3> {
    let mut place = vec![u32::MAX; positions.len()];
    for &v in triangles.iter().flatten() {
        place[v as usize] = 0;
    }
    let mut kept = Vec::new();
    for (slot, &p) in place
        .iter_mut()
        .zip(positions)
        .filter(|(slot, _)| **slot == 0)
    {
        *slot = kept.len() as u32;
        kept.push(p);
    }
    for v in triangles.iter_mut().flatten() {
        *v = place[*v as usize];
    }
    kept
}

fn has_three_vertices([a, b, c]: [u32; 3]) -> bool {
    a != b && b != c && c != a
}

pub(crate) fn has_no_area(positions: &[DVec3], triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|v| positions[v as usize]);
    let longest = (b - a)
        .length_squared()
        .max((c - b).length_squared())
        .max((a - c).length_squared());
    (b - a).cross(c - a).length() <= NEEDLE * longest
}

/// Triangles of a mesh on vertices that are the same where they lie in one place, cracks closed.
pub(crate) struct Welded {
    /// Vertices in use, in the mesh's unit.
    pub(crate) positions: Vec<DVec3>,
    /// Triangles with three vertices; some may have no area, or repeat another.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The mesh's triangle of each.
    pub(crate) origin: Vec<u32>,
}

/// Welds a mesh that has been checked.
fn welded(mesh: &InputMesh, bounds: [DVec3; 2]) -> Welded {
    let first = weld::same_place(&mesh.positions, bounds);
    let mut welded = Welded {
        positions: Vec::new(),
        triangles: Vec::with_capacity(mesh.triangles.len()),
        origin: Vec::with_capacity(mesh.triangles.len()),
    };
    for (t, triangle) in (0..).zip(&mesh.triangles) {
        welded.triangles.push(triangle.map(|v| first[v as usize]));
        welded.origin.push(t);
    }
    drop(first);
    welded.retain_triangles();
    welded.positions = compact(&mesh.positions, &mut welded.triangles);
    welded.close_cracks((bounds[1] - bounds[0]).length());
    welded
}

/// Checks and welds a mesh.
pub(crate) fn weld_mesh(mesh: &InputMesh) -> Result<Welded, RepairError> {
    let (bounds, _) = check(mesh)?;
    let welded = welded(mesh, bounds);
    let has_area = |&t: &[u32; 3]| !has_no_area(&welded.positions, t);
    match welded.triangles.iter().any(has_area) {
        true => Ok(welded),
        false => Err(RepairError::NoArea(mesh.triangles.len())),
    }
}

impl Welded {
    /// Drops triangles that have fewer than three vertices.
    fn retain_triangles(&mut self) {
        let keep = self.triangles.iter().map(|&t| has_three_vertices(t));
        let keep: Vec<bool> = keep.collect();
        duplicates::retain(&mut self.triangles, &keep);
        duplicates::retain(&mut self.origin, &keep);
    }

    fn close_cracks(&mut self, diagonal: f64) {
        let positions = &self.positions;
        let mut rim_edge = vec![f64::INFINITY; positions.len()];
        for (near, group) in Edges::new(positions.len(), &self.triangles).groups() {
            if let [side] = group {
                let ends = [near as usize, side.far() as usize];
                let length = positions[ends[0]].distance(positions[ends[1]]);
                for end in ends {
                    rim_edge[end] = rim_edge[end].min(length);
                }
            }
        }
        if let Some(onto) = weld::across_cracks(positions, &rim_edge, diagonal) {
            for v in self.triangles.iter_mut().flatten() {
                *v = onto[*v as usize];
            }
            self.retain_triangles();
            self.positions = compact(&self.positions, &mut self.triangles);
        }
    }
}

/// Returns true if all vertices are near the plane through the first, the farthest from it, and the farthest from their line.
fn is_flat(positions: &[DVec3], diagonal: f64) -> bool {
    let Some(&origin) = positions.first() else {
        return true;
    };
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        let far = positions
            .iter()
            .map(|&p| p - origin)
            .max_by(|&p, &q| measure(p).total_cmp(&measure(q)));
        far.unwrap_or_default()
    };
    let along = farthest(&|p| p.length_squared()).normalize_or_zero();
    let aside = farthest(&|p| p.reject_from(along).length_squared());
    let normal = along.cross(aside).normalize_or_zero();
    positions
        .iter()
        .all(|&p| (p - origin).dot(normal).abs() <= FLAT * diagonal)
}

/// Winds all shells and counts open edges and shells.
fn wind(positions: &[DVec3], triangles: &mut [[u32; 3]], report: &mut RepairReport) {
    let edges = Edges::new(positions.len(), triangles);
    count_open_edges(positions.len(), &edges, report);
    let patches = Patches::new(triangles.len(), &edges);
    let turn = |triangle: &mut [u32; 3]| triangle.swap(1, 2);
    for (triangle, _) in triangles
        .iter_mut()
        .zip(&patches.is_flipped)
        .filter(|(_, flipped)| **flipped)
    {
        turn(triangle);
    }
    let (to_turn, nesting) = shells::to_turn(positions, triangles, &patches, &edges);
    for (t, triangle) in triangles.iter_mut().enumerate() {
        let is_turned = to_turn[patches.of[t] as usize];
        if is_turned {
            turn(triangle);
        }
        report.flipped += usize::from(is_turned ^ patches.is_flipped[t]);
    }
    report.shells = patches.is_closed.len();
    report.open_shells = patches.is_closed.iter().filter(|&&closed| !closed).count();
    report.one_sided = patches.is_one_sided.iter().filter(|&&one| one).count();
    report.cavities = nesting.cavities;
    report.nested_alike = nesting.alike;
}

fn count_open_edges(vertices: usize, edges: &Edges, report: &mut RepairReport) {
    let mut rims = DisjointSets::new(vertices);
    let mut rim_vertices = vec![false; vertices];
    let mut joined = 0;
    for (near, group) in edges.groups() {
        match group {
            [side] => {
                report.boundary_edges += 1;
                rim_vertices[near as usize] = true;
                rim_vertices[side.far() as usize] = true;
                joined += usize::from(rims.find(near) != rims.find(side.far()));
                rims.join(near, side.far());
            }
            [_, _] => {}
            _ => report.non_manifold_edges += 1,
        }
    }
    report.boundary_loops = rim_vertices.iter().filter(|&&on| on).count() - joined;
}
