//! Tetrahedra from a file that have no volume, or that a node pushed through a face has folded.
//!
//! At the surface they are dropped: what they leave is closed without them. Inside, that would be a crack between their
//! neighbours, so a node of theirs moves far enough to give them a volume.

use frangible_geometry::{EDGES, FACES, Rows};
use glam::DVec3;

use crate::mend_tets::TetMend;
use crate::quality::volume;

/// Below this share of the longest edge's cube a tetrahedron has no volume: its height is lost in rounding.
const FLAT: f64 = 1e-6;

/// Volumes to give, shares of the longest edge's cube: the first that the neighbours leave room for.
const LIFTED: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// Farthest move of a node, share of the longest edge.
const FARTHEST: f64 = 0.1;

/// Least share of its volume that a neighbour keeps.
const KEPT: f64 = 0.5;

/// Folded tetrahedra of more than this share of the volume are left turned: they are no slip of a mesher.
const FOLDED: f64 = 0.01;

/// Flat tetrahedra that are too many to be mended.
pub(crate) struct TooMany {
    pub(crate) count: usize,
    /// Index of the first, and its volume.
    pub(crate) first: (usize, f64),
}

/// Turns all tetrahedra right side out and mends those without volume. Returns false for each that is dropped.
///
/// # Errors
/// [`TooMany`] where more than one, and more than a tenth of all, have no volume, or all of them.
pub(crate) fn mend_slivers(
    positions: &mut [DVec3],
    tets: &mut [[u32; 4]],
    mend: &mut TetMend,
) -> Result<Vec<bool>, TooMany> {
    let mut slivers = Vec::new();
    let mut turned = vec![false; tets.len()];
    for (e, tet) in tets.iter_mut().enumerate() {
        let x = tet.map(|v| positions[v as usize]);
        let signed = volume(x);
        if signed.is_nan() || signed.abs() <= FLAT * longest(x).powi(3) {
            slivers.push(e);
        } else if signed < 0.0 {
            tet.swap(2, 3);
            turned[e] = true;
        }
    }
    mend.turned = turned.iter().filter(|t| **t).count();
    let count = slivers.len();
    if count == tets.len() || count > 1 && 10 * count > tets.len() {
        let first = (
            slivers[0],
            volume(tets[slivers[0]].map(|v| positions[v as usize])),
        );
        return Err(TooMany { count, first });
    }
    let mut kept = vec![true; tets.len()];
    if count == 0 && (mend.turned == 0 || mend.turned == tets.len()) {
        return Ok(kept);
    }
    let faces = Faces::new(tets);
    let folded = folded(positions, tets, &turned, &faces);
    mend.turned -= folded.iter().filter(|&&e| turned[e]).count();
    slivers.extend(folded);
    slivers.sort_unstable();
    drop_outer(&mut slivers, tets, &faces, &mut kept);
    mend.flat = kept.iter().filter(|kept| !**kept).count();
    if !slivers.is_empty() {
        lift(&slivers, positions, tets, &faces, &mut kept, mend);
    }
    Ok(kept)
}

fn longest(x: [DVec3; 4]) -> f64 {
    let edges = EDGES.iter().map(|&[i, j]| x[i].distance(x[j]));
    edges.fold(0.0, f64::max)
}

/// The faces of all tetrahedra by their nodes, sorted, each with its tetrahedron.
struct Faces(Vec<([u32; 3], u32)>);

impl Faces {
    fn new(tets: &[[u32; 4]]) -> Self {
        let keys =
            |(e, tet): (usize, &[u32; 4])| FACES.map(|f| (sorted(f.map(|i| tet[i])), e as u32));
        let mut faces: Vec<_> = tets.iter().enumerate().flat_map(keys).collect();
        faces.sort_unstable();
        Self(faces)
    }

    /// The other tetrahedra with this face that are kept.
    fn others(&self, key: [u32; 3], e: usize, kept: &[bool]) -> impl Iterator<Item = usize> {
        let first = self.0.partition_point(|face| face.0 < key);
        let same = self.0[first..].iter().take_while(move |face| face.0 == key);
        let others = same.map(|face| face.1 as usize).filter(move |&o| o != e);
        others.filter(|&o| kept[o])
    }
}

fn sorted(mut face: [u32; 3]) -> [u32; 3] {
    face.sort_unstable();
    face
}

/// Returns true if the way around the face is an odd permutation of the rising order.
fn is_odd([a, b, c]: [u32; 3]) -> bool {
    (a > b) ^ (b > c) ^ (a > c)
}

/// Faces on whose other side a neighbour lies, less those on whose same side one lies.
fn agreement(e: usize, tets: &[[u32; 4]], faces: &Faces, kept: &[bool]) -> i32 {
    let mut sum = 0;
    for own in FACES.map(|f| f.map(|i| tets[e][i])) {
        let key = sorted(own);
        for other in faces.others(key, e, kept) {
            let theirs = FACES.map(|f| f.map(|i| tets[other][i]));
            let theirs = theirs.into_iter().find(|&f| sorted(f) == key);
            sum += theirs.map_or(0, |f| if is_odd(f) == is_odd(own) { -1 } else { 1 });
        }
    }
    sum
}

/// Those of the rarer handedness that lie on the same side of their faces as their neighbours, if they are small: their
/// nodes are not only listed in another order.
fn folded(positions: &[DVec3], tets: &[[u32; 4]], turned: &[bool], faces: &Faces) -> Vec<usize> {
    let rarer = 2 * turned.iter().filter(|t| **t).count() <= turned.len();
    let all = vec![true; tets.len()];
    let is_rare = |&e: &usize| turned[e] == rarer;
    let folded = (0..tets.len()).filter(is_rare);
    let folded: Vec<usize> = folded
        .filter(|&e| agreement(e, tets, faces, &all) < 0)
        .collect();
    let size = |e: usize| volume(tets[e].map(|v| positions[v as usize])).abs();
    let share =
        folded.iter().map(|&e| size(e)).sum::<f64>() / (0..tets.len()).map(size).sum::<f64>();
    if share < FOLDED { folded } else { Vec::new() }
}

/// Drops slivers that have a node twice, a face outside, or a face that two others share, until there is none.
fn drop_outer(slivers: &mut Vec<usize>, tets: &[[u32; 4]], faces: &Faces, kept: &mut [bool]) {
    loop {
        let before = slivers.len();
        slivers.retain(|&e| {
            kept[e] = FACES.iter().all(|face| {
                let key = sorted(face.map(|i| tets[e][i]));
                let is_proper = key[0] != key[1] && key[1] != key[2];
                is_proper && faces.others(key, e, kept).count() == 1
            });
            kept[e]
        });
        if slivers.len() == before {
            return;
        }
    }
}

/// Gives each sliver a volume by moving one of its nodes, at best one inside; drops it where there is no room.
fn lift(
    slivers: &[usize],
    positions: &mut [DVec3],
    tets: &mut [[u32; 4]],
    faces: &Faces,
    kept: &mut [bool],
    mend: &mut TetMend,
) {
    let mut is_outer = vec![false; positions.len()];
    for (e, tet) in tets.iter().enumerate().filter(|(e, _)| kept[*e]) {
        for face in FACES.map(|f| f.map(|i| tet[i])) {
            if faces.others(sorted(face), e, kept).next().is_none() {
                face.iter().for_each(|&v| is_outer[v as usize] = true);
            }
        }
    }
    let around = Rows::inverse(positions.len(), tets);
    let mut is_open = vec![false; tets.len()];
    slivers.iter().for_each(|&e| is_open[e] = true);
    for &e in slivers {
        if agreement(e, tets, faces, kept) < 0 {
            tets[e].swap(2, 3);
        }
        is_open[e] = false;
        let has_room = |v: u32, to: DVec3, positions: &[DVec3]| {
            let others = around.of(v).iter().map(|&o| o as usize);
            let mut others = others.filter(|&o| o != e && kept[o] && !is_open[o]);
            others.all(|o| {
                let old = tets[o].map(|w| positions[w as usize]);
                let new = tets[o].map(|w| if w == v { to } else { positions[w as usize] });
                volume(new) >= KEPT * volume(old)
            })
        };
        let mut moves = moves(tets[e], positions);
        moves.sort_by(|a, b| {
            let outer = |m: &Move| is_outer[m.node as usize];
            let order = (outer(a), a.rank).cmp(&(outer(b), b.rank));
            order.then(a.length.total_cmp(&b.length))
        });
        let found = moves
            .into_iter()
            .find(|m| has_room(m.node, m.to, positions));
        match found {
            Some(Move {
                node, to, length, ..
            }) => {
                positions[node as usize] = to;
                mend.lifted += 1;
                mend.moved = mend.moved.max(length);
            }
            None => {
                kept[e] = false;
                mend.flat += 1;
            }
        }
    }
}

/// A move of a node that gives a tetrahedron a volume.
struct Move {
    node: u32,
    to: DVec3,
    /// Share of the longest edge.
    length: f64,
    /// Place of the volume in [`LIFTED`].
    rank: usize,
}

/// All moves of a tetrahedron's nodes that are not too far.
fn moves(tet: [u32; 4], positions: &[DVec3]) -> Vec<Move> {
    let x = tet.map(|v| positions[v as usize]);
    let size = longest(x);
    let mut moves = Vec::new();
    for (k, face) in FACES.iter().enumerate() {
        let [a, b, c] = face.map(|i| x[i]);
        // The volume grows along the inward normal of the face opposite the node, in proportion.
        let slope = (c - a).cross(b - a) / 6.0;
        for (rank, share) in LIFTED.iter().enumerate() {
            let step = slope * ((share * size.powi(3) - volume(x)) / slope.length_squared());
            let length = step.length() / size;
            if length <= FARTHEST {
                let (node, to) = (tet[k], x[k] + step);
                moves.push(Move {
                    node,
                    to,
                    length,
                    rank,
                });
            }
        }
    }
    moves
}
