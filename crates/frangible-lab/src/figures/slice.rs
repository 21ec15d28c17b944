//! Intersections of cracks with tetrahedra.

use frangible::glam::Vec3;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::{ElementTrace, TetMesh};

/// Local nodes of the face opposite each node.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Point between two nodes at which s is zero.
fn cut(x: &[Vec3; 4], s: &[f32; 4], i: usize, j: usize) -> Vec3 {
    x[i].lerp(x[j], s[i] / (s[i] - s[j]))
}

/// The crack inside a tetrahedron, as one or two triangles.
pub(crate) fn crossing(mesh: &TetMesh, element: &ElementTrace) -> Vec<[Vec3; 3]> {
    let x = mesh.corners(element.tet as usize);
    let s = &element.values;
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for (i, &value) in s.iter().enumerate() {
        if value < 0.0 {
            below.push(i);
        } else {
            above.push(i);
        }
    }
    match (&below[..], &above[..]) {
        (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => {
            vec![[cut(&x, s, a, b), cut(&x, s, a, c), cut(&x, s, a, d)]]
        }
        (&[a, b], &[c, d]) => {
            let [p, q, r, t] = [(a, c), (a, d), (b, d), (b, c)].map(|(i, j)| cut(&x, s, i, j));
            vec![[p, q, r], [p, r, t]]
        }
        _ => Vec::new(),
    }
}

/// Trace of a crack's element on the body's outside: a line on each outer face that it crosses.
pub(crate) fn surface_trace(mesh: &TetMesh, element: &ElementTrace) -> Vec<[Vec3; 2]> {
    let e = element.tet as usize;
    let (x, s) = (mesh.corners(e), &element.values);
    let mut lines = Vec::new();
    for (face, &neighbour) in FACES.iter().zip(&mesh.neighbours[e]) {
        if neighbour != NO_NEIGHBOUR {
            continue;
        }
        let edges = [[0, 1], [1, 2], [2, 0]].map(|[a, b]| [face[a], face[b]]);
        let cut_edges = edges.iter().filter(|[i, j]| (s[*i] < 0.0) != (s[*j] < 0.0));
        let ends: Vec<Vec3> = cut_edges.map(|&[i, j]| cut(&x, s, i, j)).collect();
        if let [a, b] = ends[..] {
            lines.push([a, b]);
        }
    }
    lines
}
