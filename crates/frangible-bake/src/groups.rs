//! Named parts of a body's surface from its mesh file.
//!
//! A group contains the outer nodes within a fifth of their shortest edge of it, since the fine mesh approximates curved walls by
//! chords.

use frangible::glam::DVec3;
use frangible::internals::mesh::closest_on_triangle;
use frangible_mesh::{InputMesh, Similarity};

/// Distance from a group up to which a node lies on it, in its shortest edges: the fine mesh rounds edges off and follows
/// curved walls by chords, while the next layer of nodes is most of an edge away.
const SHARE_OF_EDGE: f64 = 0.2;

/// A named part of a body, in m and in the frame of the shape, for use with [`Region::Group`](crate::Region::Group).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Name of the group.
    pub name: String,
    /// Triangles of the surface: nodes on them belong to the group.
    pub triangles: Vec<[DVec3; 3]>,
    /// Single points: nodes at them belong to the group.
    pub points: Vec<DVec3>,
}

impl Group {
    /// Returns all named parts of a mesh: its groups, objects and materials. Parts with the same name are merged.
    #[must_use]
    pub fn of_mesh(mesh: &InputMesh, similarity: &Similarity) -> Vec<Self> {
        let corners = |t: u32| {
            let corners = mesh.triangles.get(t as usize).copied().unwrap_or_default();
            corners.map(|v| {
                let p = mesh.positions.get(v as usize).copied().unwrap_or_default();
                similarity.apply(p)
            })
        };
        mesh.named_parts()
            .into_iter()
            .map(|(name, triangles)| Self {
                name,
                triangles: triangles.into_iter().map(corners).collect(),
                points: Vec::new(),
            })
            .collect()
    }
}

/// Finds the nodes of a mesh that lie on a group.
pub(crate) struct Reach {
    /// Nodes that can lie on a group, sorted by x.
    nodes: Vec<Near>,
    /// Largest reach of a node, m.
    largest: f64,
}

struct Near {
    /// Position in the frame of the shape, m.
    position: DVec3,
    /// Largest distance at which the node counts as lying on a group, m.
    reach: f64,
    node: u32,
}

impl Reach {
    /// `elements`: tetrahedra, whose outer nodes are taken, or quadratic ones, whose nodes are all taken.
    pub(crate) fn new<const N: usize>(
        points: &[DVec3],
        elements: &[[u32; N]],
        origin: DVec3,
    ) -> Self {
        let mut shortest = vec![f64::INFINITY; points.len()];
        for element in elements {
            for (k, &a) in element.iter().enumerate() {
                for &b in &element[..k] {
                    let (a, b) = (a as usize, b as usize);
                    let length = points[a].distance(points[b]);
                    shortest[a] = shortest[a].min(length);
                    shortest[b] = shortest[b].min(length);
                }
            }
        }
        let outer = (N == 4).then(|| outer_nodes(points.len(), elements));
        let mut nodes: Vec<Near> = points
            .iter()
            .zip(&shortest)
            .enumerate()
            .filter(|&(v, (_, shortest))| {
                shortest.is_finite() && outer.as_ref().is_none_or(|outer| outer[v])
            })
            .map(|(v, (&p, shortest))| Near {
                position: p + origin,
                reach: SHARE_OF_EDGE * shortest,
                node: v as u32,
            })
            .collect();
        nodes.sort_by(|a, b| {
            let by_x = a.position.x.total_cmp(&b.position.x);
            by_x.then(a.node.cmp(&b.node))
        });
        let largest = nodes.iter().map(|n| n.reach).fold(0.0, f64::max);
        Self { nodes, largest }
    }

    /// The nodes on a group; some may be named more than once.
    pub(crate) fn nodes_on(&self, group: &Group) -> Vec<u32> {
        let mut found = Vec::new();
        let points = group.points.iter().map(|&p| [p; 3]);
        for [a, b, c] in group.triangles.iter().copied().chain(points) {
            let low = a.min(b).min(c) - self.largest;
            let high = a.max(b).max(c) + self.largest;
            let first = self.nodes.partition_point(|n| n.position.x < low.x);
            for near in &self.nodes[first..] {
                let p = near.position;
                if p.x > high.x {
                    break;
                }
                let in_box = p.cmpge(low).all() && p.cmple(high).all();
                if in_box && distance_to_triangle(p, [a, b, c]) <= near.reach {
                    found.push(near.node);
                }
            }
        }
        found
    }
}

/// For each node, true if it lies on a face of one tetrahedron only.
fn outer_nodes<const N: usize>(nodes: usize, tets: &[[u32; N]]) -> Vec<bool> {
    let mut faces: Vec<[u32; 3]> = Vec::with_capacity(4 * tets.len());
    for tet in tets {
        for apart in 0..4 {
            let mut face = [0, 1, 2].map(|k| tet[if k < apart { k } else { k + 1 }]);
            face.sort_unstable();
            faces.push(face);
        }
    }
    faces.sort_unstable();
    let mut outer = vec![false; nodes];
    for same in faces.chunk_by(|a, b| a == b) {
        if let [face] = same {
            for &v in face {
                outer[v as usize] = true;
            }
        }
    }
    outer
}

/// Distance of a point from a triangle, m.
fn distance_to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let [u, v, w] = closest_on_triangle([a, b, c], p);
    p.distance(u * a + v * b + w * c)
}
