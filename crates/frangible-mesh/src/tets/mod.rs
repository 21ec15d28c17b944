//! Tetrahedra and their improvement once they are cut: topology, sharp features, angles.

pub(crate) mod adjacency;
pub(crate) mod features;
pub(crate) mod fill;
pub(crate) mod improve;
pub(crate) mod jitter;
pub(crate) mod local;
pub(crate) mod manifold;
pub(crate) mod pieces;

use glam::DVec3;

/// Tetrahedra of a solid: one face-connected piece, its surface a closed manifold.
#[derive(Clone, Debug, Default)]
pub struct TetBody {
    /// Node positions, m.
    pub positions: Vec<DVec3>,
    /// Node indices of each tetrahedron, right-handed: det(x1−x0, x2−x0, x3−x0) > 0.
    pub tets: Vec<[u32; 4]>,
}

impl TetBody {
    /// Corner positions of tetrahedron `e`, m.
    #[must_use]
    pub fn corners(&self, e: usize) -> [DVec3; 4] {
        self.tets[e].map(|v| self.positions[v as usize])
    }

    /// Volume, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        (0..self.tets.len())
            .map(|e| crate::quality::volume(self.corners(e)))
            .sum()
    }

    /// Outside faces, counter-clockwise seen from outside, each with the tetrahedron behind it.
    #[must_use]
    pub fn boundary(&self) -> Vec<([u32; 3], u32)> {
        adjacency::boundary(&self.tets)
    }
}

/// A body while it is worked on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) body: TetBody,
    /// For each vertex, true if it was put on the surface.
    pub(crate) on_surface: Vec<bool>,
}

impl Draft {
    /// Keeps the tetrahedra for which `keep` holds, and the vertices they use.
    pub(crate) fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let mut e = 0;
        self.body.tets.retain(|_| {
            e += 1;
            keep(e - 1)
        });
        self.compact();
    }

    /// Drops vertices that no tetrahedron uses.
    pub(crate) fn compact(&mut self) {
        let mut used = vec![false; self.body.positions.len()];
        self.body
            .tets
            .iter()
            .flatten()
            .for_each(|&v| used[v as usize] = true);
        let mut number = vec![0; used.len()];
        let mut next = 0;
        for v in 0..used.len() {
            if used[v] {
                number[v] = next;
                self.body.positions[next as usize] = self.body.positions[v];
                self.on_surface[next as usize] = self.on_surface[v];
                next += 1;
            }
        }
        self.body.positions.truncate(next as usize);
        self.on_surface.truncate(next as usize);
        self.body
            .tets
            .iter_mut()
            .flatten()
            .for_each(|v| *v = number[*v as usize]);
    }
}
