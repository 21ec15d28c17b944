//! Thin walls of two faces: found in a closed surface, or made of a sheet without thickness.
//!
//! A lattice has to resolve the thickness of a wall. A [`Wall`] is meshed along one of its faces instead: triangles of the wanted size, and
//! for each of their vertices the place on the other face. Layers of prisms between the two fill the wall.

mod columns;
mod faces;
mod measures;
mod mesh;
mod remesh;

use glam::DVec3;

use crate::repair::RepairReport;
use crate::surface::Surface;
use crate::winding::MeshSolid;
use columns::RimLine;
use measures::{area, bending, compacted, enclosed_volume, is_closed, rim_line, sharp_edges};
pub use mesh::WallMesh;
use remesh::surface::Reference;
use remesh::{NONE, is_manifold};

/// The faces of a wall along a sheet keep this distance from the sheet, in half thicknesses; less shows that the wall overlaps itself.
const CLEAR: f64 = 0.85;

/// Largest difference from 1 of the winding number in the middle of a wall.
const ONCE: f64 = 0.4;

/// A thin wall.
pub struct Wall {
    /// The face that is meshed.
    sheet: Surface,
    reference: Reference,
    /// Rim at each sharp edge of the face, in the order of its edges, or [`NONE`].
    rim_of_line: Vec<u32>,
    back: Back,
    thickness: f64,
    volume: f64,
    bending: f64,
}

/// The other face of a wall.
enum Back {
    /// As drawn, with its edges at the rims.
    Face {
        solid: Box<MeshSolid>,
        face: Reference,
        /// For each triangle of the solid, true if it belongs to the other face.
        is_back: Vec<bool>,
        rims: Vec<RimLine>,
    },
    /// At this distance, m.
    Offset(f64),
}

impl Wall {
    /// Finds the two faces of a closed, repaired surface. Returns `None` if it is no wall: if it has holes or several parts, is thicker than a
    /// sixth of its width, or has thicker or thinner parts.
    #[must_use]
    pub fn of_closed(surface: &Surface, report: &RepairReport) -> Option<Self> {
        let is_shell = report.is_watertight()
            && report.one_sided == 0
            && is_closed(surface)
            && (report.shells == 1 || (report.shells == 2 && report.cavities == 1));
        if !is_shell {
            return None;
        }
        let solid = MeshSolid::new(surface).ok()?;
        let volume = enclosed_volume(surface);
        let faces = faces::find(surface, &solid, volume)?;
        let part = |triangles: &[u32]| compacted(surface, triangles);
        let (sheet, places) = part(&faces.triangles[0]);
        let back = part(&faces.triangles[1]).0;
        if !is_manifold(sheet.positions.len(), &sheet.triangles) {
            return None;
        }
        let rim = |ends: [u32; 2]| {
            let mut ends = ends.map(|v| places[v as usize]);
            ends.sort_unstable();
            let found = faces.rim_of_edge.binary_search_by_key(&ends, |r| r.0);
            found.map_or(NONE, |place| faces.rim_of_edge[place].1)
        };
        let rim_of_line = sharp_edges(&sheet).into_iter().map(rim).collect();
        let mut is_back = vec![false; surface.triangles.len()];
        for &t in &faces.triangles[1] {
            is_back[t as usize] = true;
        }
        let areas = [&sheet, &back].map(area);
        let rims = faces.rims.iter().map(|edges| rim_line(surface, edges));
        Some(Self {
            reference: Reference::new(&sheet).ok()?,
            rim_of_line,
            thickness: 2.0 * volume / (areas[0] + areas[1]),
            volume,
            bending: bending(&sheet),
            back: Back::Face {
                face: Reference::new(&back).ok()?,
                is_back,
                rims: rims.collect(),
                solid: Box::new(solid),
            },
            sheet,
        })
    }

    /// Makes a wall of a sheet without thickness, open or closed: half of `thickness`, m, on each side. Returns `None` if more than two
    /// triangles meet at an edge, or parts only touch at a vertex.
    #[must_use]
    pub fn of_skin(surface: &Surface, thickness: f64) -> Option<Self> {
        let fits = is_manifold(surface.positions.len(), &surface.triangles)
            && thickness.is_finite()
            && thickness > 0.0;
        let area = area(surface);
        let reference = Reference::new(surface).ok()?;
        (fits && area > 0.0).then(|| Self {
            reference,
            rim_of_line: Vec::new(),
            back: Back::Offset(0.5 * thickness),
            thickness,
            volume: thickness * area,
            bending: bending(surface),
            sheet: surface.clone(),
        })
    }

    /// Mean thickness, m.
    #[must_use]
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Volume of the closed surface, or area times thickness of a sheet, m³.
    #[must_use]
    pub const fn volume(&self) -> f64 {
        self.volume
    }

    /// Area of the middle surface, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        self.volume / self.thickness
    }

    /// Mean curvature of the wall over its area, 1/m: 0 for a plate, 1/R for a tube.
    #[must_use]
    pub const fn bending(&self) -> f64 {
        self.bending
    }

    /// Lowest and highest corner of a box that holds the wall, m.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let [low, high] = self.sheet.bounds();
        match &self.back {
            Back::Offset(half) => [low - *half, high + *half],
            Back::Face { solid, .. } => crate::Solid::bounds(&**solid),
        }
    }

    /// Meshes the wall with triangles whose edges are about `edge` metres long, irregular for a seed. Returns `None` where the wall bends so
    /// sharply that its columns would cross.
    #[must_use]
    pub fn mesh(&self, edge: f64, seed: Option<u64>) -> Option<WallMesh> {
        let sheet = remesh::remesh(&self.sheet, &self.reference, edge, seed);
        let back = columns::ends(self, &sheet, 1.0)?;
        let front = match &self.back {
            Back::Face { .. } => sheet.positions.clone(),
            Back::Offset(_) => columns::ends(self, &sheet, -1.0)?,
        };
        let mut columns: Vec<[DVec3; 2]> =
            back.into_iter().zip(front).map(|(b, f)| [b, f]).collect();
        columns::untangle(self, &sheet, &mut columns);
        let mut mesh = WallMesh {
            free: sheet
                .kinds
                .iter()
                .map(|&k| k == remesh::Kind::Free)
                .collect(),
            smallest_angle: sheet.smallest_angle(),
            triangles: sheet.triangles.clone(),
            columns,
        };
        if self.overlaps(&mesh) {
            return None;
        }
        columns::bulge(&sheet, &mut mesh.columns);
        mesh.is_sound().then_some(mesh)
    }

    /// Whether the wall runs into another part of itself.
    fn overlaps(&self, mesh: &WallMesh) -> bool {
        match &self.back {
            Back::Offset(half) => {
                let near = |p: &DVec3| self.reference.closest(*p, CLEAR * half) != *p;
                mesh.columns.iter().flatten().any(near)
            }
            // Inside a body that crosses itself, the surface goes around twice.
            Back::Face { solid, .. } => mesh.triangles.iter().any(|t| {
                let ends = t.iter().flat_map(|&v| mesh.columns[v as usize]);
                let around = solid.winding_number(ends.sum::<DVec3>() / 6.0);
                (around - 1.0).abs() > ONCE
            }),
        }
    }

    /// Distance to the other face along the inward normal, m.
    fn ray(&self, from: DVec3, normal: DVec3) -> Option<f64> {
        let Back::Face { solid, is_back, .. } = &self.back else {
            return None;
        };
        let skin = 1e-6 * self.thickness;
        let reach = 4.0 * self.thickness;
        let (at, face) = solid.first_exit(from - skin * normal, from - (skin + reach) * normal)?;
        is_back[face as usize].then_some(skin + at * reach)
    }
}
