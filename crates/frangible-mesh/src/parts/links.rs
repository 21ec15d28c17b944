//! Which shells are parts of one body: those that cross, and those that lie inside another.

use frangible_geometry::DisjointSets;
use glam::DVec3;
use rayon::prelude::*;

use super::open::{Cluster, apart};
use super::regions::{NONE, Regions};
use crate::repair::Welded;
use crate::repair::column::Columns;
use crate::surface::Surface;
use crate::winding::{FaceTree, MeshSolid};

/// Depth below a shell's surface at which other shells are looked for, as a share of the mesh's diagonal: bodies that touch, and overlap by
/// rounding, are not one.
const DEPTH: f64 = 1e-5;

/// Distance of the tested segments from the edges of their triangle, in depths: at edges of 20° or more they lie inside the shell.
const FROM_EDGES: f64 = 3.0;

/// Points of a shell that are looked for inside others.
const SAMPLES: usize = 8;

/// Shells whose boxes are compared with each segment; of more, one box around all is.
const MOST_BOXES: usize = 16;

/// Winding number of open shells at which a point lies inside.
const INSIDE_OPEN: f64 = 0.3;

/// Shells and how they belong together. Closed regions come first, then clusters of open faces.
pub(super) struct Links {
    /// Sets of shells that are one solid.
    pub(super) solids: DisjointSets,
    /// True for each closed region that is a hollow.
    pub(super) is_cavity: Vec<bool>,
    /// True for each closed region that lies inside another and is wound like it.
    pub(super) is_nested: Vec<bool>,
    /// True for each shell that meets another.
    pub(super) is_crossed: Vec<bool>,
    /// Shells whose sheets have been given to them, by cluster; [`NONE`] for shells of their own.
    pub(super) sheet_of: Vec<u32>,
}

/// The mesh and its shells.
pub(super) struct Shells<'a> {
    pub(super) mesh: &'a Welded,
    pub(super) regions: &'a Regions,
    pub(super) clusters: &'a [Cluster],
    pub(super) diagonal: f64,
}

impl Shells<'_> {
    fn count(&self) -> usize {
        self.regions.count() + self.clusters.len()
    }

    fn corners(&self, f: u32) -> [DVec3; 3] {
        self.regions.faces[f as usize]
            .vertices
            .map(|v| self.mesh.positions[v as usize])
    }

    /// Faces of each shell, and true for those whose front is inside.
    fn members(&self) -> Vec<Vec<(u32, bool)>> {
        let mut members = vec![Vec::new(); self.count()];
        for (f, face) in (0..).zip(&self.regions.faces) {
            for region in face.regions() {
                members[region as usize].push((f, face.sides[0] == region));
            }
        }
        for (cluster, members) in self
            .clusters
            .iter()
            .zip(&mut members[self.regions.count()..])
        {
            members.extend(cluster.faces.iter().map(|&f| (f, false)));
        }
        members
    }

    /// Finds out which shells belong together.
    pub(super) fn links(&self) -> Links {
        let (regions, count) = (self.regions.count(), self.count());
        let mut links = Links {
            solids: DisjointSets::new(count),
            is_cavity: vec![false; regions],
            is_nested: vec![false; regions],
            is_crossed: vec![false; count],
            sheet_of: vec![NONE; self.clusters.len()],
        };
        if count < 2 {
            return links;
        }
        let members = self.members();
        let boxes: Vec<[DVec3; 2]> = members.iter().map(|m| self.bounds(m)).collect();
        let near = neighbours(&boxes);
        if near.iter().all(Vec::is_empty) {
            return links;
        }
        for (a, b) in self.crossings(&members, &boxes, &near) {
            // What a sheet cuts stays what it is.
            if !self.is_sheet(a) && !self.is_sheet(b) {
                links.solids.join(a, b);
                links.is_crossed[a as usize] = true;
                links.is_crossed[b as usize] = true;
            }
        }
        self.nest(&members, &near, &mut links);
        self.join_open(&members, &near, &mut links);
        links
    }

    fn bounds(&self, members: &[(u32, bool)]) -> [DVec3; 2] {
        let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let corners = members.iter().flat_map(|&(f, _)| self.corners(f));
        corners.fold(nothing, |[low, high], p| [low.min(p), high.max(p)])
    }

    fn is_sheet(&self, shell: u32) -> bool {
        let cluster = (shell as usize).checked_sub(self.regions.count());
        cluster.is_some_and(|cluster| self.clusters[cluster].is_sheet())
    }

    /// The shells whose faces a shell meets just below its own surface.
    fn crossings(
        &self,
        members: &[Vec<(u32, bool)>],
        boxes: &[[DVec3; 2]],
        near: &[Vec<u32>],
    ) -> Vec<(u32, u32)> {
        let faces: Vec<(u32, [DVec3; 3])> = (0..self.regions.faces.len() as u32)
            .map(|f| (f, self.corners(f)))
            .collect();
        let tree = FaceTree::new(&faces);
        drop(faces);
        let mut shell_of_open = vec![NONE; self.regions.faces.len()];
        for (shell, cluster) in (self.regions.count() as u32..).zip(self.clusters) {
            for &f in &cluster.faces {
                shell_of_open[f as usize] = shell;
            }
        }
        let mut found = Vec::new();
        for (shell, members) in (0..).zip(members) {
            let others: Vec<[DVec3; 2]> = near[shell as usize]
                .iter()
                .map(|&other| boxes[other as usize])
                .collect();
            if others.is_empty() {
                continue;
            }
            let others = if others.len() > MOST_BOXES {
                let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
                vec![
                    others
                        .iter()
                        .fold(nothing, |[l, h], b| [l.min(b[0]), h.max(b[1])]),
                ]
            } else {
                others
            };
            let is_open = shell as usize >= self.regions.count();
            let met = |&(f, front_inside): &(u32, bool)| {
                let mut met = Vec::new();
                for [from, to] in self.inner_edges(f, front_inside, is_open) {
                    let segment = [from.min(to), from.max(to)];
                    if others.iter().all(|other| apart(&segment, other) > 0.0) {
                        continue;
                    }
                    for hit in tree.met(from, to) {
                        let mut owners = self.regions.faces[hit as usize].regions();
                        let open = shell_of_open[hit as usize];
                        if open != shell && owners.all(|owner| owner != shell) {
                            met.extend(self.regions.faces[hit as usize].regions());
                            met.extend((open != NONE).then_some(open));
                        }
                    }
                }
                met
            };
            let mut all: Vec<u32> = members.par_iter().flat_map_iter(met).collect();
            all.sort_unstable();
            all.dedup();
            found.extend(all.into_iter().map(|other| (shell, other)));
        }
        found
    }

    /// The edges of a face, moved a little into it and below it.
    fn inner_edges(&self, f: u32, front_inside: bool, is_open: bool) -> [[DVec3; 2]; 3] {
        let corners = self.corners(f);
        let below = self.below(corners, front_inside);
        let depth = below.length();
        let [a, b, c] = corners;
        let middle = (a + b + c) / 3.0;
        let around = (b - a).length() + (c - b).length() + (a - c).length();
        // Radius of the circle that touches the sides.
        let radius = (b - a).cross(c - a).length() / around;
        let inwards = if is_open {
            1e-3
        } else {
            FROM_EDGES * depth / radius
        }
        .min(0.3);
        let below = if is_open { DVec3::ZERO } else { below };
        let moved = corners.map(|p| p.lerp(middle, inwards) + below);
        [
            [moved[0], moved[1]],
            [moved[1], moved[2]],
            [moved[2], moved[0]],
        ]
    }

    /// The way into the shell, as long as the depth.
    fn below(&self, [a, b, c]: [DVec3; 3], front_inside: bool) -> DVec3 {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let depth = DEPTH * self.diagonal;
        if front_inside {
            depth * normal
        } else {
            -depth * normal
        }
    }

    /// Points just inside a shell.
    fn samples(&self, members: &[(u32, bool)]) -> Vec<DVec3> {
        let stride = members.len().div_ceil(SAMPLES).max(1);
        let samples = members.iter().step_by(stride);
        samples
            .map(|&(f, front_inside)| {
                let corners = self.corners(f);
                let [a, b, c] = corners;
                (a + b + c) / 3.0 + self.below(corners, front_inside)
            })
            .collect()
    }

    /// Shells inside closed ones: hollows, solids within solids, and loose bodies in hollows.
    fn nest(&self, members: &[Vec<(u32, bool)>], near: &[Vec<u32>], links: &mut Links) {
        let regions = self.regions.count();
        let mut triangles = Vec::new();
        let mut labels = Vec::new();
        for (shell, members) in (0..).zip(&members[..regions]) {
            for &(f, front_inside) in members {
                let [a, b, c] = self.regions.faces[f as usize].vertices;
                triangles.push(if front_inside { [a, c, b] } else { [a, b, c] });
                labels.push(shell);
            }
        }
        let order = (0..triangles.len() as u32).collect();
        let columns = Columns::new(&self.mesh.positions, &triangles, &labels, order);
        let volume = |shell: u32| self.regions.volumes[shell as usize];
        let mut by_size: Vec<u32> = (0..members.len() as u32).collect();
        // Clusters of open faces come last; they hold no other here.
        by_size.sort_by(|&a, &b| {
            let size = |shell: u32| match (shell as usize) < regions {
                true => volume(shell),
                false => 0.0,
            };
            size(b).total_cmp(&size(a)).then(a.cmp(&b))
        });
        let mut rank = vec![0; members.len()];
        for (place, &shell) in by_size.iter().enumerate() {
            rank[shell as usize] = place;
        }
        let mut is_solid = vec![true; regions];
        for shell in by_size {
            let own = shell as usize;
            if near[own].is_empty() {
                continue;
            }
            let samples = self.samples(&members[own]);
            let mut times: Vec<u32> = Vec::new();
            for &sample in &samples {
                let around = columns.around(sample).into_iter().map(|(other, _)| other);
                times.extend(around.filter(|&other| rank[other as usize] < rank[own]));
            }
            times.sort_unstable();
            let mut holders = Vec::new();
            for same in times.chunk_by(|a, b| a == b) {
                if same.len() == samples.len() {
                    holders.push(same[0]);
                } else if !self.is_sheet(shell) {
                    links.solids.join(shell, same[0]);
                    links.is_crossed[own] = true;
                    links.is_crossed[same[0] as usize] = true;
                }
            }
            let outermost = holders.iter().copied().min_by_key(|&h| rank[h as usize]);
            let innermost = holders.iter().copied().max_by_key(|&h| rank[h as usize]);
            let (Some(outermost), Some(innermost)) = (outermost, innermost) else {
                continue;
            };
            if own >= regions {
                match self.is_sheet(shell) {
                    true => links.sheet_of[own - regions] = innermost,
                    false => _ = links.solids.join(shell, innermost),
                }
                continue;
            }
            let depth: i32 = holders
                .iter()
                .map(|&h| if is_solid[h as usize] { 1 } else { -1 })
                .sum();
            if depth > 0 {
                let outward = &self.regions.is_outward;
                is_solid[own] = outward[own] == outward[outermost as usize];
                links.is_cavity[own] = !is_solid[own];
                links.is_nested[own] = is_solid[own];
                links.solids.join(shell, innermost);
            }
        }
    }

    /// Closed shells inside shells that have holes, and sheets beside shells.
    fn join_open(&self, members: &[Vec<(u32, bool)>], near: &[Vec<u32>], links: &mut Links) {
        let regions = self.regions.count();
        for (number, cluster) in self.clusters.iter().enumerate() {
            let shell = regions + number;
            if cluster.is_sheet() {
                if links.sheet_of[number] == NONE {
                    let reached = near[shell].iter().filter(|&&other| !self.is_sheet(other));
                    let first = reached.min().copied();
                    links.sheet_of[number] = first.unwrap_or(NONE);
                }
                continue;
            }
            let Some(solid) = self.open_solid(cluster) else {
                continue;
            };
            for &other in near[shell].iter().filter(|&&o| (o as usize) < regions) {
                let samples = self.samples(&members[other as usize]);
                let inside = |p: &DVec3| solid.winding_number(*p).abs() > INSIDE_OPEN;
                if samples.iter().any(inside) {
                    links.solids.join(shell as u32, other);
                }
            }
        }
    }

    fn open_solid(&self, cluster: &Cluster) -> Option<MeshSolid> {
        let triangles = cluster.faces.iter();
        let surface = Surface {
            positions: self.mesh.positions.clone(),
            triangles: triangles
                .map(|&f| self.regions.faces[f as usize].vertices)
                .collect(),
        };
        MeshSolid::new(&surface).ok()
    }
}

/// For each box the others that touch it.
fn neighbours(boxes: &[[DVec3; 2]]) -> Vec<Vec<u32>> {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let low = |i: u32| boxes[i as usize][0].x;
    order.sort_by(|&a, &b| low(a).total_cmp(&low(b)).then(a.cmp(&b)));
    let mut near = vec![Vec::new(); boxes.len()];
    for (place, &i) in order.iter().enumerate() {
        let own = &boxes[i as usize];
        for &j in order[place + 1..]
            .iter()
            .take_while(|&&j| low(j) <= own[1].x)
        {
            if apart(own, &boxes[j as usize]) <= 0.0 {
                near[i as usize].push(j);
                near[j as usize].push(i);
            }
        }
    }
    near
}
