//! What a push on a piece comes to bear on: pressure passes through the faces of cracks, pull and shear do not.

use std::cell::OnceCell;

use glam::{DVec3, Vec3};

use super::draft::divided_tets;
use super::label::Labels;
use crate::asset::FOREIGN;
use crate::body::MeshIndex;
use crate::mesh::{EDGES, FACES, TetMesh};

/// A face passes a push on if its mean direction, over all of its area, runs along the push by at least this share. A flat face
/// square to the push would have 1, one that is tilted by 60° or a crater that is half a ball 1/2; faces along the push have nothing. Faces
/// that run from tetrahedron to tetrahedron are rough, which takes a fifth.
const PASSES: f64 = 0.4;

/// The face of a piece that another lies behind.
#[derive(Clone, Copy)]
struct Face {
    /// The other piece.
    behind: u32,
    /// Its area with the direction to the other piece, m².
    across: DVec3,
    /// Its area, m².
    area: f64,
}

/// Volumes of the pieces of a body, or of a portion of it, in the unit of the mesh's index.
pub(crate) struct Volumes {
    of_piece: Vec<u64>,
    /// Half of the volume of them all.
    half: u64,
}

impl Volumes {
    /// The volumes of these pieces.
    pub(crate) fn of(labels: &Labels, index: &MeshIndex) -> Self {
        let mut of_piece = vec![0; labels.count];
        for (&label, volume) in labels.of_node.iter().zip(&index.volumes) {
            if label < FOREIGN {
                of_piece[label as usize] += volume;
            }
        }
        Self {
            half: of_piece.iter().sum::<u64>() / 2,
            of_piece,
        }
    }

    /// For each piece, whether nothing but its neighbours presses on it: it has no more than half of the volume, and is not among the `pushed`.
    pub(crate) fn free(&self, pushed: &[u32]) -> Vec<bool> {
        let is_small = |volume: &u64| *volume <= self.half;
        let mut free: Vec<bool> = self.of_piece.iter().map(is_small).collect();
        for &piece in pushed {
            free[piece as usize] = false;
        }
        free
    }
}

/// Which pieces lean on which.
pub(crate) struct Bearing<'a> {
    volumes: &'a Volumes,
    labels: &'a Labels,
    index: &'a MeshIndex,
    mesh: &'a TetMesh,
    /// The faces of each piece, once anything asks for them: what is more than half of the body needs none.
    faces: OnceCell<Vec<Vec<Face>>>,
}

impl<'a> Bearing<'a> {
    /// How the pieces of a body, or of a portion of it, lean on each other.
    pub(crate) fn new(
        volumes: &'a Volumes,
        labels: &'a Labels,
        index: &'a MeshIndex,
        mesh: &'a TetMesh,
    ) -> Self {
        Self {
            volumes,
            labels,
            index,
            mesh,
            faces: OnceCell::new(),
        }
    }

    /// Whether what pushes on a piece in this direction pushes on more than half of the body: on the piece itself and all that lie behind
    /// it, face on face.
    pub(crate) fn bears(&self, piece: u32, push: Vec3) -> bool {
        let push = push.as_dvec3();
        let mut pushed = vec![false; self.volumes.of_piece.len()];
        let (mut waiting, mut volume) = (vec![piece], 0);
        pushed[piece as usize] = true;
        while let Some(piece) = waiting.pop() {
            volume += self.volumes.of_piece[piece as usize];
            if volume > self.volumes.half {
                return true;
            }
            let faces = (self.faces).get_or_init(|| faces(self.labels, self.index, self.mesh));
            for face in &faces[piece as usize] {
                let passes = push.dot(face.across) >= PASSES * face.area;
                if passes && !std::mem::replace(&mut pushed[face.behind as usize], true) {
                    waiting.push(face.behind);
                }
            }
        }
        false
    }
}

/// The faces of each piece. Let χ be 1 at the nodes of a piece and 0 at others: then volume × ∇χ of a tetrahedron is the area with which the
/// piece's side passes through it.
fn faces(labels: &Labels, index: &MeshIndex, mesh: &TetMesh) -> Vec<Vec<Face>> {
    let mut faces: Vec<Vec<Face>> = vec![Vec::new(); labels.count];
    for e in divided_tets(&mesh.tets, index, labels) {
        let tet = mesh.tets[e as usize];
        let pieces = tet.map(|v| labels.of_node[v as usize]);
        let corners = tet.map(|v| mesh.positions[v as usize].as_dvec3());
        let gradients = FACES.map(|face| {
            let [a, b, c] = face.map(|i| corners[i]);
            (b - a).cross(c - a) / -6.0
        });
        let side = |piece: u32| -> DVec3 {
            let own = (0..4).filter(|&n| pieces[n] == piece);
            own.map(|n| gradients[n]).sum()
        };
        let is_first = |n: usize| pieces[n] < FOREIGN && !pieces[..n].contains(&pieces[n]);
        for [i, j] in EDGES {
            if is_first(i) && is_first(j) {
                let across = 0.5 * (side(pieces[j]) - side(pieces[i]));
                grow(&mut faces[pieces[i] as usize], pieces[j], across);
                grow(&mut faces[pieces[j] as usize], pieces[i], -across);
            }
        }
    }
    faces
}

/// Adds a part to the face that a piece has towards another.
fn grow(faces: &mut Vec<Face>, behind: u32, across: DVec3) {
    let area = across.length();
    match faces.iter_mut().find(|face| face.behind == behind) {
        Some(face) => {
            face.across += across;
            face.area += area;
        }
        None => faces.push(Face {
            behind,
            across,
            area,
        }),
    }
}
