//! Faces shared and not shared, tetrahedra around vertices.

use rayon::slice::ParallelSliceMut;

/// No neighbour: the face lies outside.
pub(crate) const OUTSIDE: u32 = u32::MAX;

/// Local nodes of the face opposite node `k`, counter-clockwise seen from outside.
pub(crate) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Neighbour across the face opposite each node, or [`OUTSIDE`].
pub(crate) fn neighbours(tets: &[[u32; 4]]) -> Vec<[u32; 4]> {
    let mut faces: Vec<([u32; 3], u32)> = Vec::with_capacity(4 * tets.len());
    for (e, tet) in tets.iter().enumerate() {
        for (k, face) in FACES.iter().enumerate() {
            let mut key = face.map(|i| tet[i]);
            key.sort_unstable();
            faces.push((key, (4 * e + k) as u32));
        }
    }
    faces.par_sort_unstable();
    let mut neighbours = vec![[OUTSIDE; 4]; tets.len()];
    for pair in faces.windows(2) {
        if pair[0].0 == pair[1].0 {
            let (a, b) = (pair[0].1 as usize, pair[1].1 as usize);
            neighbours[a / 4][a % 4] = (b / 4) as u32;
            neighbours[b / 4][b % 4] = (a / 4) as u32;
        }
    }
    neighbours
}

/// Outside faces, counter-clockwise seen from outside, each with the tetrahedron behind it.
pub(crate) fn boundary(tets: &[[u32; 4]]) -> Vec<([u32; 3], u32)> {
    let neighbours = neighbours(tets);
    let mut faces = Vec::new();
    for (e, near) in neighbours.iter().enumerate() {
        for k in 0..4 {
            if near[k] == OUTSIDE {
                faces.push((FACES[k].map(|i| tets[e][i]), e as u32));
            }
        }
    }
    faces
}

/// Items (tetrahedra, triangles …) around each vertex, rising.
pub(crate) struct Around {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Around {
    pub(crate) fn new<const N: usize>(vertices: usize, groups: &[[u32; N]]) -> Self {
        let mut starts = vec![0_u32; vertices + 1];
        groups
            .iter()
            .flatten()
            .for_each(|&v| starts[v as usize + 1] += 1);
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut items = vec![0; N * groups.len()];
        for (g, group) in groups.iter().enumerate() {
            for &v in group {
                items[next[v as usize] as usize] = g as u32;
                next[v as usize] += 1;
            }
        }
        Self { starts, items }
    }

    pub(crate) fn of(&self, v: u32) -> &[u32] {
        &self.items[self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize]
    }
}
