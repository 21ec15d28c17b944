//! Faces shared and not shared.

use frangible_geometry::{FACES, NO_NEIGHBOUR};
use rayon::slice::ParallelSliceMut;

/// Neighbour across the face opposite each node, or [`NO_NEIGHBOUR`].
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
    let mut neighbours = vec![[NO_NEIGHBOUR; 4]; tets.len()];
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
            if near[k] == NO_NEIGHBOUR {
                faces.push((FACES[k].map(|i| tets[e][i]), e as u32));
            }
        }
    }
    faces
}
