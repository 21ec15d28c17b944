//! Builder to which the readers of tetrahedra hand over nodes and elements one by one, in the numbers of their files.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::read::{ReadError, check_triangles, check_vertices};
use crate::tet_input::{TetGroup, TetInput};

/// The error for a kind of element that cannot be broken.
pub(super) fn other_cells(kind: &'static str) -> ReadError {
    ReadError::OtherCells { kind }
}

/// A mesh while it is read.
#[derive(Default)]
pub(super) struct Builder {
    /// Numbers of the nodes in the file.
    tags: Vec<u64>,
    positions: Vec<DVec3>,
    tets: Vec<[u64; 4]>,
    mids: Vec<[u64; 6]>,
    numbers: Vec<u64>,
    faces: Vec<[u64; 3]>,
    /// Members of each group, by its dimension and number: tetrahedra or faces, rising.
    members: BTreeMap<(u8, i64), Vec<u32>>,
    names: BTreeMap<(u8, i64), String>,
}

impl Builder {
    pub(super) fn node(&mut self, tag: u64, position: DVec3) -> Result<(), ReadError> {
        self.tags.push(tag);
        self.positions.push(position);
        check_vertices(self.positions.len() as u64)
    }

    /// Four corners, then, if there are six more, the middles of the edges 01, 12, 02, 03, 13, 23.
    pub(super) fn tet(
        &mut self,
        number: u64,
        nodes: &[u64],
        groups: &[i64],
    ) -> Result<(), ReadError> {
        if let Some(corners) = nodes.first_chunk() {
            self.join(3, self.tets.len(), groups);
            self.tets.push(*corners);
            self.numbers.push(number);
            self.mids
                .extend(nodes.get(4..10).and_then(<[u64]>::first_chunk));
        }
        check_triangles(self.tets.len() as u64)
    }

    /// Its three corners come first; only faces of a group are kept.
    pub(super) fn face(&mut self, nodes: &[u64], groups: &[i64]) -> Result<(), ReadError> {
        if let (Some(corners), Some(_)) = (nodes.first_chunk(), groups.first()) {
            self.join(2, self.faces.len(), groups);
            self.faces.push(*corners);
        }
        check_triangles(self.faces.len() as u64)
    }

    fn join(&mut self, dimension: u8, member: usize, groups: &[i64]) {
        for &group in groups {
            let members = self.members.entry((dimension, group)).or_default();
            if members.last() != Some(&(member as u32)) {
                members.push(member as u32);
            }
        }
    }

    /// The name of a group of faces (2) or tetrahedra (3).
    pub(super) fn name(&mut self, dimension: u8, group: i64, name: String) {
        self.names.insert((dimension, group), name);
    }

    /// Turns numbers of the file to indices, and merges tetrahedra written once per group.
    pub(super) fn finish(self) -> Result<TetInput, ReadError> {
        if self.tets.is_empty() {
            return Err(ReadError::NoTetrahedra);
        }
        if !self.mids.is_empty() && self.mids.len() != self.tets.len() {
            let problem = "tetrahedra with four and with ten nodes are mixed; save all elements with the same order";
            return Err(ReadError::malformed("the elements", problem));
        }
        if let Some(at) = self.positions.iter().position(|p| !p.is_finite()) {
            let vertex = usize::try_from(self.tags[at]).unwrap_or(at);
            return Err(ReadError::NotFinite { vertex });
        }
        let index = Numbers::new(&self.tags)?;
        let resolve = |kind: &str, number: u64, tag: u64| {
            index.of(tag).ok_or_else(|| {
                let problem = format!("it refers to node {tag}, which is not in the file");
                ReadError::malformed(format!("{kind} {number}"), problem)
            })
        };
        let mut tets = Vec::with_capacity(self.tets.len());
        let mut mids = Vec::with_capacity(self.mids.len());
        for (e, tet) in self.tets.iter().enumerate() {
            tets.push(all(tet, |tag| resolve("element", self.numbers[e], tag))?);
        }
        for (e, six) in self.mids.iter().enumerate() {
            mids.push(all(six, |tag| resolve("element", self.numbers[e], tag))?);
        }
        for (tet, six) in tets.iter().zip(&mut mids) {
            *six = in_order(&self.positions, *tet, *six);
        }
        let mut faces = Vec::with_capacity(self.faces.len());
        for (f, face) in self.faces.iter().enumerate() {
            faces.push(all(face, |tag| resolve("face", f as u64 + 1, tag))?);
        }
        let names = self.names;
        let groups = self.members.into_iter().map(|((dimension, tag), members)| {
            let usual = || {
                format!(
                    "{} {tag}",
                    if dimension == 2 { "surface" } else { "volume" }
                )
            };
            let name = names.get(&(dimension, tag)).cloned();
            TetGroup {
                name: name.filter(|n| !n.is_empty()).unwrap_or_else(usual),
                dimension,
                members,
            }
        });
        Ok(merged(TetInput {
            positions: self.positions,
            mid_edges: (!mids.is_empty()).then_some(mids),
            tets,
            numbers: self.numbers,
            faces,
            groups: groups.collect(),
        }))
    }
}

/// TetGen and Medit have orders of their own for the middles: where the usual one is far off, each edge takes the
/// nearest, if that gives each of them an edge.
fn in_order(positions: &[DVec3], tet: [u32; 4], six: [u32; 6]) -> [u32; 6] {
    const ENDS: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];
    let x = tet.map(|v| positions[v as usize]);
    let off = |v: u32, [i, j]: [usize; 2]| positions[v as usize].distance(0.5 * (x[i] + x[j]));
    let length = |[i, j]: [usize; 2]| x[i].distance(x[j]);
    if (0..6).all(|k| off(six[k], ENDS[k]) <= 0.25 * length(ENDS[k])) {
        return six;
    }
    let mut free = six.to_vec();
    let nearest = ENDS.map(|ends| {
        let near = |&a: &usize, &b: &usize| off(free[a], ends).total_cmp(&off(free[b], ends));
        let at = (0..free.len()).min_by(near).unwrap_or(0);
        free.swap_remove(at)
    });
    if (0..6).all(|k| off(nearest[k], ENDS[k]) <= 0.25 * length(ENDS[k])) {
        nearest
    } else {
        six
    }
}

fn all<const N: usize>(
    tags: &[u64; N],
    resolve: impl Fn(u64) -> Result<u32, ReadError>,
) -> Result<[u32; N], ReadError> {
    let mut out = [0; N];
    for (out, &tag) in out.iter_mut().zip(tags) {
        *out = resolve(tag)?;
    }
    Ok(out)
}

/// Index of each number of the file.
enum Numbers {
    /// The first, and how many follow it without a gap.
    Run(u64, u64),
    /// Pairs of number and place, ordered by number.
    Sorted(Vec<(u64, u32)>),
}

impl Numbers {
    fn new(tags: &[u64]) -> Result<Self, ReadError> {
        let first = tags.first().copied().unwrap_or(0);
        if tags.iter().zip(first..).all(|(&tag, next)| tag == next) {
            return Ok(Self::Run(first, tags.len() as u64));
        }
        let mut sorted: Vec<(u64, u32)> = tags.iter().copied().zip(0..).collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let problem = format!("two nodes have the number {}", pair[0].0);
            return Err(ReadError::malformed("the nodes", problem));
        }
        Ok(Self::Sorted(sorted))
    }

    fn of(&self, tag: u64) -> Option<u32> {
        match self {
            Self::Run(first, count) => {
                let index = tag.checked_sub(*first)?;
                (index < *count).then_some(index as u32)
            }
            Self::Sorted(sorted) => {
                let at = sorted.binary_search_by_key(&tag, |s| s.0).ok()?;
                Some(sorted[at].1)
            }
        }
    }
}

/// An element of several groups is written once for each of them by Gmsh 2.2: one is kept, in all its groups.
fn merged(mut mesh: TetInput) -> TetInput {
    let key = |e: usize| {
        let mut key = mesh.tets[e];
        key.sort_unstable();
        key
    };
    let mut order: Vec<([u32; 4], u32)> =
        (0..mesh.tets.len()).map(|e| (key(e), e as u32)).collect();
    order.sort_unstable();
    let mut first: Vec<u32> = (0..mesh.tets.len() as u32).collect();
    let mut doubled = false;
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        for other in &same[1..] {
            first[other.1 as usize] = same[0].1;
            doubled = true;
        }
    }
    if !doubled {
        return mesh;
    }
    let kept: Vec<bool> = (0..first.len()).map(|e| first[e] as usize == e).collect();
    let mut place = vec![0; first.len()];
    let mut next = 0;
    for e in 0..first.len() {
        place[e] = next;
        next += u32::from(kept[e]);
    }
    for group in mesh.groups.iter_mut().filter(|g| g.dimension == 3) {
        for e in &mut group.members {
            *e = place[first[*e as usize] as usize];
        }
        group.members.sort_unstable();
        group.members.dedup();
    }
    keep(&mut mesh.tets, &kept);
    keep(&mut mesh.numbers, &kept);
    if let Some(mids) = &mut mesh.mid_edges {
        keep(mids, &kept);
    }
    mesh
}

fn keep<T>(items: &mut Vec<T>, kept: &[bool]) {
    let mut each = kept.iter();
    items.retain(|_| each.next().copied().unwrap_or(false));
}
