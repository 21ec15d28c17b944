//! Repair of tetrahedra from a file.
//!
//! Imported tetrahedra are repaired, or rejected with the number of the element, but never remeshed, because the user chose them.

use std::fmt;

use frangible_geometry::{EDGES, FACES};
use glam::DVec3;
use thiserror::Error;

use crate::quality::volume;
use crate::slivers::{TooMany, mend_slivers};
use crate::tet_input::TetInput;
use crate::tets::{TetBody, pieces};

/// A middle node farther from the middle of its edge than this share of its length is no middle: from a quarter on a
/// curved element may be folded.
const MOST_CURVED: f64 = 0.25;

/// A middle node nearer than this is where it belongs: f32 and decimal places.
const STRAIGHT: f64 = 1e-4;

/// Smaller pieces than the rest of this share are dropped, as the mesher does.
const MAIN_PIECE: f64 = 0.9;

/// Error of importing tetrahedra from a file. Element numbers are those of the file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TetInputError {
    /// No tetrahedra.
    #[error("the mesh has no tetrahedra; a body needs a volume mesh")]
    Empty,
    /// An index beyond the nodes, or a list of another length than the tetrahedra.
    #[error(
        "tetrahedron {element} refers to a node that does not exist, or lacks an entry in one of the lists"
    )]
    Index {
        /// Its number in the file.
        element: u64,
    },
    /// A coordinate that is not finite.
    #[error("node {node} (from 0) has a coordinate that is not a finite number")]
    NotFinite {
        /// Its index.
        node: usize,
    },
    /// Flat tetrahedra, too many to be mended.
    #[error(
        "{count} of {of} tetrahedra are flat, the first of them element {element} with a volume of {volume:.1e} (in the file's unit); at most a tenth can be repaired: optimise the mesh in the mesher that made it"
    )]
    Flat {
        /// Number of the first in the file.
        element: u64,
        /// Its volume, in the file's unit cubed.
        volume: f64,
        /// Number of flat ones.
        count: usize,
        /// Number of all.
        of: usize,
    },
    /// A face of three tetrahedra.
    #[error(
        "element {element} has a face that two other tetrahedra share; remove the overlapping elements"
    )]
    SharedFace {
        /// Its number in the file.
        element: u64,
    },
    /// Parts joined only along edges.
    #[error("parts of the body are joined only along {edges} edges; merge or separate them there")]
    Pinched {
        /// Number of such edges.
        edges: usize,
    },
    /// Middle nodes that are no middles.
    #[error(
        "a mid-edge node of element {element} lies {share:.0} % of the edge's length away from the midpoint, and at most 25 % can be straightened; use smaller elements there, or first-order elements"
    )]
    Curved {
        /// Its number in the file.
        element: u64,
        /// Distance from the midpoint, per cent of the edge length.
        share: f64,
    },
    /// Several bodies.
    #[error(
        "the mesh consists of {pieces} separate pieces, the largest with {share:.0} % of the volume; put each in its own file, or let them share nodes where they touch"
    )]
    Pieces {
        /// Number of pieces.
        pieces: usize,
        /// Share of the largest in the volume, per cent.
        share: f64,
    },
}

/// Statistics of the repairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct TetMend {
    /// Inverted tetrahedra, which were flipped.
    pub turned: usize,
    /// Tetrahedra without volume that were dropped.
    pub flat: usize,
    /// Flat or folded tetrahedra, which were repaired by moving a node.
    pub lifted: usize,
    /// Largest of these displacements, as a share of the longest edge.
    pub moved: f64,
    /// Duplicate nodes, at exactly the same position as another.
    pub welded: usize,
    /// Unused nodes.
    pub unused: usize,
    /// Nodes that were duplicated because parts of the body touched only there.
    pub parted: usize,
    /// Small disconnected pieces, which were dropped.
    pub dropped: usize,
    /// Largest distance of a mid-edge node from the midpoint of its edge, as a share of the edge length; 0 for straight edges.
    pub curved: f64,
}

impl fmt::Display for TetMend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let mut say = |count: usize, what: &str| {
            if count > 0 {
                parts.push(format!("{count} {what}"));
            }
        };
        say(self.turned, "inverted tetrahedra flipped");
        say(self.flat, "flat tetrahedra dropped");
        let lifted = format!(
            "flat tetrahedra repaired (nodes moved by up to {:.1} % of their edges)",
            100.0 * self.moved
        );
        say(self.lifted, &lifted);
        say(self.welded, "duplicate nodes merged");
        say(self.unused, "unused nodes dropped");
        say(self.parted, "nodes duplicated where parts touch at a point");
        say(self.dropped, "small disconnected pieces dropped");
        if self.curved > 0.0 {
            let most = 100.0 * self.curved;
            parts.push(format!(
                "curved edges straightened (by up to {most:.1} % of their length)"
            ));
        }
        f.write_str(&parts.join(", "))
    }
}

/// Nodes of a named part of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeGroup {
    /// Its name.
    pub name: String,
    /// 2: a surface; 3: a volume.
    pub dimension: u8,
    /// Its nodes, ascending.
    pub nodes: Vec<u32>,
}

/// A body made of tetrahedra from a file.
#[derive(Clone, Debug, Default)]
pub struct MendedTets {
    /// One face-connected piece, right-handed; the tetrahedra in the order of the file.
    pub body: TetBody,
    /// True if the elements of the file were quadratic.
    pub quadratic: bool,
    /// Named parts, as nodes of the body.
    pub groups: Vec<NodeGroup>,
    /// Repairs that were made.
    pub mend: TetMend,
}

/// Repairs and checks tetrahedra: flips inverted ones, merges duplicate nodes, drops flat ones and small pieces.
///
/// # Errors
/// Tetrahedra that do not form one body: see [`TetInputError`].
pub fn mend_tets(input: &TetInput) -> Result<MendedTets, TetInputError> {
    check(input)?;
    let mut mend = TetMend {
        curved: curvature(input)?,
        ..TetMend::default()
    };
    let same = doubles(&input.positions);
    let mut tets: Vec<[u32; 4]> = input
        .tets
        .iter()
        .map(|t| t.map(|v| same[v as usize]))
        .collect();
    let mut positions = input.positions.clone();
    let kept = mend_slivers(&mut positions, &mut tets, &mut mend);
    let kept = kept.map_err(|TooMany { count, first }| TetInputError::Flat {
        element: number(input, first.0),
        volume: first.1,
        count,
        of: tets.len(),
    })?;
    if let Some(e) = overfull_face(&tets, &kept) {
        let element = number(input, e);
        return Err(TetInputError::SharedFace { element });
    }
    let kept = largest_piece(&positions, &tets, &kept, &mut mend)?;
    let mut number_of = vec![u32::MAX; input.positions.len()];
    for (tet, _) in tets.iter().zip(&kept).filter(|(_, kept)| **kept) {
        for &v in tet {
            number_of[v as usize] = 0;
        }
    }
    let mut body = TetBody::default();
    for (v, number) in number_of.iter_mut().enumerate().filter(|n| *n.1 == 0) {
        *number = body.positions.len() as u32;
        body.positions.push(positions[v]);
    }
    let renumbered = tets.iter().zip(&kept).filter(|(_, kept)| **kept);
    body.tets = renumbered
        .map(|(tet, _)| tet.map(|v| number_of[v as usize]))
        .collect();
    count_nodes(input, &same, &mut mend);
    let copies = crate::tets::manifold::part_touching(&mut body);
    mend.parted = copies.len();
    let pinched = crate::tets::manifold::pinched_edges(&body.tets);
    if pinched > 0 {
        return Err(TetInputError::Pinched { edges: pinched });
    }
    let node = |v: u32| number_of[same[v as usize] as usize];
    Ok(MendedTets {
        groups: groups(input, &node, &kept, &copies),
        quadratic: input.mid_edges.is_some(),
        body,
        mend,
    })
}

fn number(input: &TetInput, e: usize) -> u64 {
    input.numbers.get(e).copied().unwrap_or(e as u64)
}

fn check(input: &TetInput) -> Result<(), TetInputError> {
    if input.tets.is_empty() {
        return Err(TetInputError::Empty);
    }
    if let Some(node) = input.positions.iter().position(|p| !p.is_finite()) {
        return Err(TetInputError::NotFinite { node });
    }
    let nodes = input.positions.len();
    let outside = |indices: &[u32]| indices.iter().any(|&v| v as usize >= nodes);
    for (e, tet) in input.tets.iter().enumerate() {
        let mids = input.mid_edges.as_ref().map(|mids| mids.get(e));
        let mids_wrong = mids.is_some_and(|six| six.is_none_or(|six| outside(six)));
        if outside(tet) || mids_wrong {
            let element = number(input, e);
            return Err(TetInputError::Index { element });
        }
    }
    Ok(())
}

/// Largest distance of a middle node from the middle of its edge, as a share of the edge.
fn curvature(input: &TetInput) -> Result<f64, TetInputError> {
    let mut most: f64 = 0.0;
    for (e, six) in input.mid_edges.iter().flatten().enumerate() {
        let at = |v: u32| input.positions[v as usize];
        let x = input.tets[e].map(at);
        let middle = |[i, j]: [usize; 2]| 0.5 * (x[i] + x[j]);
        let off = |v: u32, ends: [usize; 2]| {
            let length = x[ends[0]].distance(x[ends[1]]);
            at(v).distance(middle(ends)) / length
        };
        let usual = six.iter().zip(EDGES).map(|(&v, ends)| off(v, ends));
        let worst = usual.fold(0.0, f64::max);
        if worst.is_nan() || worst > MOST_CURVED {
            let element = number(input, e);
            let share = 100.0 * worst;
            return Err(TetInputError::Curved { element, share });
        }
        most = most.max(worst);
    }
    Ok(if most > STRAIGHT { most } else { 0.0 })
}

/// The first node at the place of each node.
fn doubles(positions: &[DVec3]) -> Vec<u32> {
    // Adding zero makes −0 and 0 alike.
    let key = |v: u32| {
        (positions[v as usize] + DVec3::ZERO)
            .to_array()
            .map(f64::to_bits)
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&v| (key(v), v));
    let mut same: Vec<u32> = (0..positions.len() as u32).collect();
    for place in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &v in place {
            same[v as usize] = place[0];
        }
    }
    same
}

/// A tetrahedron with a face that more than one other has.
fn overfull_face(tets: &[[u32; 4]], kept: &[bool]) -> Option<usize> {
    let mut faces: Vec<([u32; 3], u32)> = Vec::with_capacity(4 * tets.len());
    for (e, tet) in tets.iter().enumerate().filter(|(e, _)| kept[*e]) {
        faces.extend(FACES.iter().map(|face| {
            let mut key = face.map(|i| tet[i]);
            key.sort_unstable();
            (key, e as u32)
        }));
    }
    faces.sort_unstable();
    let three = faces.windows(3).find(|w| w[0].0 == w[2].0)?;
    Some(three[2].1 as usize)
}

fn largest_piece(
    positions: &[DVec3],
    tets: &[[u32; 4]],
    kept: &[bool],
    mend: &mut TetMend,
) -> Result<Vec<bool>, TetInputError> {
    let left = tets.iter().zip(kept).filter(|(_, kept)| **kept);
    let left: Vec<[u32; 4]> = left.map(|(tet, _)| *tet).collect();
    let (label, count) = pieces::label(&left);
    let mut volumes = vec![0.0; count];
    for (tet, &l) in left.iter().zip(&label) {
        volumes[l as usize] += volume(tet.map(|v| positions[v as usize]));
    }
    let largest = (0..count)
        .max_by(|&a, &b| volumes[a].total_cmp(&volumes[b]).then(b.cmp(&a)))
        .unwrap_or(0);
    let share = volumes[largest] / volumes.iter().sum::<f64>();
    if share < MAIN_PIECE {
        return Err(TetInputError::Pieces {
            pieces: count,
            share: 100.0 * share,
        });
    }
    mend.dropped = count - 1;
    let mut labels = label.iter();
    let mut is_of_largest = || labels.next().is_some_and(|&l| l as usize == largest);
    Ok(kept.iter().map(|&kept| kept && is_of_largest()).collect())
}

/// Doubled nodes among those of the tetrahedra, and nodes of no tetrahedron; middles are neither.
fn count_nodes(input: &TetInput, same: &[u32], mend: &mut TetMend) {
    let mut used = vec![false; same.len()];
    let mut middle = vec![false; same.len()];
    for &v in input.tets.iter().flatten() {
        used[v as usize] = true;
    }
    for &v in input.mid_edges.iter().flatten().flatten() {
        middle[v as usize] = true;
    }
    for v in 0..same.len() {
        let double = used[v] && same[v] as usize != v && used[same[v] as usize];
        mend.welded += usize::from(double);
        mend.unused += usize::from(!used[v] && !middle[v]);
    }
}

/// `node`: number in the body, or the largest; `copies`: pairs of a node of the body and its double.
fn groups(
    input: &TetInput,
    node: &impl Fn(u32) -> u32,
    kept: &[bool],
    copies: &[(u32, u32)],
) -> Vec<NodeGroup> {
    let mut groups = Vec::new();
    for group in &input.groups {
        let mut nodes: Vec<u32> = Vec::new();
        for &member in &group.members {
            let member = member as usize;
            let corners: &[u32] = match group.dimension {
                2 => input.faces.get(member).map_or(&[], |f| f),
                _ if kept.get(member) == Some(&true) => &input.tets[member],
                _ => &[],
            };
            let known = corners
                .iter()
                .filter(|&&v| (v as usize) < input.positions.len());
            nodes.extend(known.map(|&v| node(v)).filter(|&v| v != u32::MAX));
        }
        nodes.sort_unstable();
        nodes.dedup();
        let doubled = copies.iter().filter(|c| nodes.binary_search(&c.0).is_ok());
        let doubled: Vec<u32> = doubled.map(|c| c.1).collect();
        nodes.extend(doubled);
        nodes.sort_unstable();
        if !nodes.is_empty() {
            groups.push(NodeGroup {
                name: group.name.clone(),
                dimension: group.dimension,
                nodes,
            });
        }
    }
    groups
}
