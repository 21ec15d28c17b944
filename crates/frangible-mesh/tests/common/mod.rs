//! Solids with known volumes, and independent checks of tetrahedra.

use frangible_mesh::glam::{DMat3, DVec3, EulerRot};
use frangible_mesh::{Solid, TetBody};

/// A ball, perhaps hollow.
pub(crate) struct Ball {
    pub(crate) centre: DVec3,
    pub(crate) radius: f64,
    pub(crate) wall: Option<f64>,
}

impl Ball {
    pub(crate) fn volume(&self) -> f64 {
        let inner = self.wall.map_or(0.0, |t| self.radius - t);
        4.0 / 3.0 * std::f64::consts::PI * (self.radius.powi(3) - inner.powi(3))
    }
}

impl Solid for Ball {
    fn bounds(&self) -> [DVec3; 2] {
        [self.centre - self.radius, self.centre + self.radius]
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        let d = p.distance(self.centre) - self.radius;
        self.wall.map_or(d, |t| d.max(-t - d))
    }
}

/// A box, turned.
pub(crate) struct Block {
    pub(crate) half: DVec3,
    pub(crate) turn: DMat3,
}

impl Block {
    pub(crate) fn turned(half: DVec3) -> Self {
        Self {
            half,
            turn: DMat3::from_euler(EulerRot::XYZ, 0.3, 0.5, 0.7),
        }
    }

    pub(crate) fn volume(&self) -> f64 {
        8.0 * self.half.element_product()
    }
}

impl Solid for Block {
    fn bounds(&self) -> [DVec3; 2] {
        [
            DVec3::splat(-self.half.length()),
            DVec3::splat(self.half.length()),
        ]
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        let q = (self.turn.transpose() * p).abs() - self.half;
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
    }
}

/// Panics unless every face is shared by at most two tetrahedra, the outside is a closed manifold that encloses exactly
/// the tetrahedra's volume (so that none overlap there), all are in one piece, and no dihedral angle is below 10°.
/// Gives the Euler characteristic of the surface.
pub(crate) fn check_sound(body: &TetBody) -> i64 {
    for e in 0..body.tets.len() {
        let (smallest, _) = frangible_mesh::quality::dihedral_range(body.corners(e));
        assert!(
            smallest >= 10.0,
            "tetrahedron {e} has an angle of {smallest}°"
        );
    }
    check_closed(body)
}

/// As [`check_sound`], with tetrahedra of any shape that have a volume.
pub(crate) fn check_closed(body: &TetBody) -> i64 {
    for e in 0..body.tets.len() {
        let volume = frangible_mesh::quality::volume(body.corners(e));
        assert!(volume > 0.0, "tetrahedron {e} has a volume of {volume}");
    }
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for &[a, b, c, d] in &body.tets {
        for mut face in [[b, c, d], [a, c, d], [a, b, d], [a, b, c]] {
            face.sort_unstable();
            faces.push(face);
        }
    }
    faces.sort_unstable();
    assert!(
        faces.chunk_by(|a, b| a == b).all(|c| c.len() <= 2),
        "a face of three tetrahedra"
    );

    let outside: Vec<[u32; 3]> = body.boundary().into_iter().map(|f| f.0).collect();
    let mut edges: Vec<(u32, u32)> = outside
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
        .collect();
    edges.sort_unstable();
    assert!(
        edges.windows(2).all(|w| w[0] != w[1]),
        "an edge with two triangles on one side"
    );
    assert!(
        edges
            .iter()
            .all(|&(a, b)| edges.binary_search(&(b, a)).is_ok()),
        "an open edge"
    );

    // From a corner of the body, or a body far away would lose the digits.
    let p = |v: u32| body.positions[v as usize] - body.positions[0];
    let enclosed: f64 = outside
        .iter()
        .map(|&[a, b, c]| p(a).dot(p(b).cross(p(c))) / 6.0)
        .sum();
    assert!(
        (enclosed / body.volume() - 1.0).abs() < 1e-9,
        "{enclosed} enclosed, {} filled",
        body.volume()
    );

    let mut used: Vec<u32> = body.tets.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used.len(), body.positions.len(), "loose nodes");
    assert_eq!(pieces(body, &faces), 1, "pieces");

    let mut vertices: Vec<u32> = outside.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices.len() as i64 - (edges.len() / 2) as i64 + outside.len() as i64
}

/// Face-connected pieces, by joining the tetrahedra of each shared face.
fn pieces(body: &TetBody, sorted_faces: &[[u32; 3]]) -> usize {
    let mut first: Vec<Option<usize>> = vec![None; sorted_faces.len()];
    let mut root: Vec<usize> = (0..body.tets.len()).collect();
    fn find(root: &mut [usize], mut e: usize) -> usize {
        while root[e] != e {
            root[e] = root[root[e]];
            e = root[e];
        }
        e
    }
    for (e, &[a, b, c, d]) in body.tets.iter().enumerate() {
        for mut face in [[b, c, d], [a, c, d], [a, b, d], [a, b, c]] {
            face.sort_unstable();
            let place = sorted_faces.partition_point(|f| *f < face);
            match first[place] {
                None => first[place] = Some(e),
                Some(other) => {
                    let (i, j) = (find(&mut root, e), find(&mut root, other));
                    root[i] = j;
                }
            }
        }
    }
    (0..root.len()).filter(|&e| root[e] == e).count()
}
