//! Makes the surface a closed manifold: every edge between two triangles, every vertex in one fan.
//!
//! If two parts of the body touch along an edge only, the smaller fan of tetrahedra at that edge goes. If they
//! touch at a vertex only, each part gets its own.

use frangible_geometry::{FACES, NO_NEIGHBOUR, Rows};

use crate::error::TetError;
use crate::quality::volume;
use crate::tets::adjacency::neighbours;
use crate::tets::{Draft, TetBody};

/// Rounds after which the rest is given up; two have always been enough.
const ROUNDS: usize = 40;

/// Makes the surface of a body manifold. Returns the number of tetrahedra removed.
///
/// # Errors
/// [`TetError::Pinched`] when pinches remain after many rounds.
pub(crate) fn make_manifold(draft: &mut Draft) -> Result<usize, TetError> {
    let mut removed = 0;
    for _ in 0..ROUNDS {
        let doomed = pinched_fans(draft);
        if doomed.is_empty() {
            split_vertices(draft);
            return Ok(removed);
        }
        removed += doomed.len();
        draft.retain(|e| doomed.binary_search(&(e as u32)).is_err());
    }
    Err(TetError::Pinched)
}

/// Gives each part of a body its own copy of a node at which it touches others. Returns pairs of a node and its copy.
pub(crate) fn part_touching(body: &mut TetBody) -> Vec<(u32, u32)> {
    let mut draft = Draft {
        on_surface: vec![true; body.positions.len()],
        body: std::mem::take(body),
    };
    let copies = split_vertices(&mut draft);
    *body = draft.body;
    copies
}

/// Edges with more than two triangles of the surface.
pub(crate) fn pinched_edges(tets: &[[u32; 4]]) -> usize {
    surface_edges(tets, &neighbours(tets))
        .chunk_by(|a, b| a == b)
        .filter(|c| c.len() > 2)
        .count()
}

/// Edges of the triangles of the surface, sorted.
fn surface_edges(tets: &[[u32; 4]], near: &[[u32; 4]]) -> Vec<(u32, u32)> {
    let mut edges: Vec<(u32, u32)> = Vec::new();
    for (e, n) in near.iter().enumerate() {
        for k in (0..4).filter(|&k| n[k] == NO_NEIGHBOUR) {
            let f = FACES[k].map(|i| tets[e][i]);
            edges.extend(
                [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])].map(|(a, b)| (a.min(b), a.max(b))),
            );
        }
    }
    edges.sort_unstable();
    edges
}

/// Tetrahedra of the smaller fans at edges with more than two boundary triangles, rising.
fn pinched_fans(draft: &Draft) -> Vec<u32> {
    let tets = &draft.body.tets;
    let near = neighbours(tets);
    let edges = surface_edges(tets, &near);
    let pinched: Vec<(u32, u32)> = edges
        .chunk_by(|a, b| a == b)
        .filter(|c| c.len() > 2)
        .map(|c| c[0])
        .collect();
    if pinched.is_empty() {
        return Vec::new();
    }
    let around = Rows::inverse(draft.body.positions.len(), tets);
    let mut doomed = Vec::new();
    for (a, b) in pinched {
        let ring: Vec<u32> = around
            .of(a)
            .iter()
            .copied()
            .filter(|&e| tets[e as usize].contains(&b))
            .collect();
        let fans = fans(&ring, &near, |e, k| {
            // The face opposite node k holds the edge when k is neither of its ends.
            tets[e as usize][k] != a && tets[e as usize][k] != b
        });
        let size = |fan: &Vec<u32>| -> f64 {
            fan.iter()
                .map(|&e| volume(draft.body.corners(e as usize)))
                .sum()
        };
        let largest = (0..fans.len())
            .max_by(|&i, &j| size(&fans[i]).total_cmp(&size(&fans[j])).then(j.cmp(&i)));
        for (i, fan) in fans.into_iter().enumerate() {
            if Some(i) != largest {
                doomed.extend(fan);
            }
        }
    }
    doomed.sort_unstable();
    doomed.dedup();
    doomed
}

/// Groups of `ring` connected through faces for which `shared(tetrahedron, face)` holds.
fn fans(ring: &[u32], near: &[[u32; 4]], shared: impl Fn(u32, usize) -> bool) -> Vec<Vec<u32>> {
    let mut seen = vec![false; ring.len()];
    let mut groups = Vec::new();
    for start in 0..ring.len() {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let mut group = vec![ring[start]];
        let mut next = 0;
        while next < group.len() {
            let e = group[next];
            next += 1;
            for k in (0..4).filter(|&k| shared(e, k)) {
                let n = near[e as usize][k];
                if let Ok(place) = ring.binary_search(&n)
                    && !seen[place]
                {
                    seen[place] = true;
                    group.push(n);
                }
            }
        }
        groups.push(group);
    }
    groups
}

/// Gives each face-connected fan of tetrahedra around a vertex its own copy of the vertex. Returns pairs of the two.
fn split_vertices(draft: &mut Draft) -> Vec<(u32, u32)> {
    let mut copies = Vec::new();
    let near = neighbours(&draft.body.tets);
    let vertices = draft.body.positions.len();
    let around = Rows::inverse(vertices, &draft.body.tets);
    let mut outer = vec![false; vertices];
    for (e, n) in near.iter().enumerate() {
        for k in (0..4).filter(|&k| n[k] == NO_NEIGHBOUR) {
            FACES[k]
                .iter()
                .for_each(|&i| outer[draft.body.tets[e][i] as usize] = true);
        }
    }
    for v in (0..vertices as u32).filter(|&v| outer[v as usize]) {
        let tets = &draft.body.tets;
        let groups = fans(around.of(v), &near, |e, k| tets[e as usize][k] != v);
        for group in groups.iter().skip(1) {
            let copy = draft.body.positions.len() as u32;
            draft.body.positions.push(draft.body.positions[v as usize]);
            draft.on_surface.push(true);
            copies.push((v, copy));
            for &e in group {
                for x in &mut draft.body.tets[e as usize] {
                    if *x == v {
                        *x = copy;
                    }
                }
            }
        }
    }
    copies
}
