//! Which bodies a surface describes, found before it is meshed.
//!
//! A part is a closed shell with the hollows in it, or several shells that overlap: their solid is where the winding number exceeds one
//! half. Shells that merely touch are parts of their own. Where layers share single faces, each layer is a part, and the layers together
//! are one body, because their author drew no surface between them.

mod choice;
mod gaps;
mod links;
mod names;
mod open;
mod regions;
mod subset;
mod words;

use glam::DVec3;

pub use choice::{ChosenBody, ChosenParts, PartChoice, PartError};
pub use gaps::Gap;

use self::links::{Links, Shells};
use self::open::{Cluster, clusters};
use self::regions::{NONE, Regions};
use crate::InputMesh;
use crate::repair::{RepairError, Welded, weld_mesh};

/// A part of a surface.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Part {
    /// Name in the file: an object or group of an OBJ, a node of a glTF, a solid of an STL; empty without one.
    pub name: String,
    /// Volume inside, in the cube of the mesh's unit. Where shells overlap or have holes it is an estimate.
    pub volume: f64,
    /// True if the shells are closed and do not overlap, so that the volume is exact.
    pub is_exact: bool,
    /// Number of shells, hollows included.
    pub shells: usize,
    /// Number of hollows: shells inside another, wound against it.
    pub hollows: usize,
    /// Number of shells inside another and wound like it: solid within solid.
    pub nested: usize,
    /// Lowest and highest corner, in the mesh's unit.
    pub bounds: [DVec3; 2],
    /// Number of the body to which it belongs: parts that share single faces have the same.
    body: u32,
    /// Triangles of the mesh, and whether each has to be turned to face outwards.
    triangles: Vec<(u32, bool)>,
}

/// The parts of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Parts {
    /// The parts, in the order of the file.
    pub list: Vec<Part>,
    /// Number of open sheets that belong to no part.
    pub loose_sheets: usize,
    /// Number of faces that two parts share: they are drawn once and have a part on either side.
    pub shared_faces: usize,
}

impl Parts {
    /// Finds the parts of a mesh. A surface without any closed or hollow shell is one part. The same mesh gives the same parts.
    ///
    /// # Errors
    /// A mesh that cannot be repaired, see [`repair`](crate::repair()).
    pub fn of(mesh: &InputMesh) -> Result<Self, RepairError> {
        let welded = weld_mesh(mesh)?;
        let regions = Regions::new(&welded);
        let (low, high) = welded
            .positions
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &p| {
                (l.min(p), h.max(p))
            });
        let diagonal = (high - low).length();
        let clusters = clusters(&welded, &regions, diagonal);
        let shells = Shells {
            mesh: &welded,
            regions: &regions,
            clusters: &clusters,
            diagonal,
        };
        let links = shells.links();
        let mut parts = Builder {
            mesh: &welded,
            regions: &regions,
            clusters: &clusters,
            links,
        }
        .build();
        if parts.list.is_empty() {
            parts.list.push(whole(mesh, [low, high]));
            parts.loose_sheets = 0;
        }
        names::name(mesh, &mut parts.list);
        Ok(parts)
    }
}

/// A surface that encloses nothing by itself, as one part.
fn whole(mesh: &InputMesh, bounds: [DVec3; 2]) -> Part {
    Part {
        name: String::new(),
        volume: 0.0,
        is_exact: false,
        shells: 1,
        hollows: 0,
        nested: 0,
        bounds,
        body: 0,
        triangles: (0..mesh.triangles.len() as u32)
            .map(|t| (t, false))
            .collect(),
    }
}

/// Puts shells together to parts.
struct Builder<'a> {
    mesh: &'a Welded,
    regions: &'a Regions,
    clusters: &'a [Cluster],
    links: Links,
}

impl Builder<'_> {
    fn build(mut self) -> Parts {
        let (part_of, list) = self.empty_parts();
        let mut parts = Parts {
            list,
            ..Parts::default()
        };
        self.fill(&part_of, &mut parts);
        for part in &mut parts.list {
            part.triangles.sort_unstable();
        }
        parts.list.retain(|part| !part.triangles.is_empty());
        parts
            .list
            .sort_by_key(|part| part.triangles.first().map_or(u32::MAX, |t| t.0));
        number_bodies(&mut parts.list);
        parts
    }

    /// The part of each shell, and parts that have no triangles yet.
    fn empty_parts(&mut self) -> (Vec<u32>, Vec<Part>) {
        let regions = self.regions.count();
        let mut part_of = vec![NONE; regions + self.clusters.len()];
        let mut place = vec![NONE; part_of.len()];
        let mut list: Vec<Part> = Vec::new();
        for shell in 0..part_of.len() {
            let cluster = shell.checked_sub(regions).map(|c| &self.clusters[c]);
            if cluster.is_some_and(Cluster::is_sheet) {
                continue;
            }
            let root = self.links.solids.find(shell as u32) as usize;
            if place[root] == NONE {
                place[root] = list.len() as u32;
                list.push(Part {
                    name: String::new(),
                    volume: 0.0,
                    is_exact: true,
                    shells: 0,
                    hollows: 0,
                    nested: 0,
                    bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
                    body: place[root],
                    triangles: Vec::new(),
                });
            }
            part_of[shell] = place[root];
            let part = &mut list[place[root] as usize];
            part.shells += 1;
            match cluster {
                Some(cluster) => {
                    part.volume += cluster.volume;
                    part.is_exact = false;
                }
                None if self.links.is_cavity[shell] => {
                    part.volume -= self.regions.volumes[shell];
                    part.hollows += 1;
                }
                None if self.links.is_nested[shell] => part.nested += 1,
                None => part.volume += self.regions.volumes[shell],
            }
            part.is_exact &= !self.links.is_crossed[shell];
        }
        (part_of, list)
    }

    /// Gives each triangle to the part that it bounds.
    fn fill(&self, part_of: &[u32], parts: &mut Parts) {
        let regions = self.regions.count();
        let part = |region: u32| match region {
            NONE => NONE,
            region => part_of[region as usize],
        };
        for face in &self.regions.faces {
            let copies = face.copies.start as usize..face.copies.end as usize;
            let copies = &self.regions.copies[copies];
            let [front, back] = face.sides.map(part);
            if face.sides[0] == face.sides[1] {
                continue;
            }
            let is_shared = front != NONE && back != NONE && front != back && !face.is_double;
            parts.shared_faces += usize::from(is_shared);
            for &(triangle, is_alike) in copies {
                let origin = self.mesh.origin[triangle as usize];
                let mut give = |to: u32, turned: bool| {
                    if let Some(part) = parts.list.get_mut(to as usize) {
                        part.triangles.push((origin, turned));
                        for v in face.vertices {
                            let p = self.mesh.positions[v as usize];
                            part.bounds = [part.bounds[0].min(p), part.bounds[1].max(p)];
                        }
                    }
                };
                if is_shared {
                    give(back, !is_alike);
                    give(front, is_alike);
                } else if front == NONE || back == NONE || front == back {
                    give(if back == NONE { front } else { back }, false);
                } else {
                    give(if is_alike { back } else { front }, false);
                }
            }
            if is_shared {
                let body = parts.list[front as usize]
                    .body
                    .min(parts.list[back as usize].body);
                let [a, b] = [front, back].map(|p| parts.list[p as usize].body);
                for part in &mut parts.list {
                    if part.body == a || part.body == b {
                        part.body = body;
                    }
                }
            }
        }
        for (number, cluster) in self.clusters.iter().enumerate() {
            let shell = match self.links.sheet_of[number] {
                NONE => regions + number,
                shell => shell as usize,
            };
            let Some(part) = parts.list.get_mut(part_of[shell] as usize) else {
                parts.loose_sheets += 1;
                continue;
            };
            for &f in &cluster.faces {
                let face = &self.regions.faces[f as usize];
                let copies = face.copies.start as usize..face.copies.end as usize;
                for &(triangle, _) in &self.regions.copies[copies] {
                    let origin = self.mesh.origin[triangle as usize];
                    part.triangles.push((origin, false));
                }
            }
            part.bounds = [
                part.bounds[0].min(cluster.bounds[0]),
                part.bounds[1].max(cluster.bounds[1]),
            ];
        }
    }
}

/// Numbers bodies in the order of their first parts.
fn number_bodies(list: &mut [Part]) {
    let mut known: Vec<u32> = Vec::new();
    for part in list {
        let place = known.iter().position(|&body| body == part.body);
        part.body = place.unwrap_or_else(|| {
            known.push(part.body);
            known.len() - 1
        }) as u32;
    }
}
