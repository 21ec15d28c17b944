//! Exact partition of a tetrahedron among the labels of its four nodes `[G12 §6.3, Fig. 11]`.
//!
//! Two labels: one triangle or one quad of interface through the cut points. Three or four labels: a point on each
//! three-label face (mean of its three cut points) and a centre point; the interfaces are fans from face segments to
//! the centre. Both sides use the same triangles and neighbours the same segments on their shared face, so the pieces
//! tile the body: closed, oriented surfaces, no overlap, no gap. (The paper makes an extra fragment of the centre
//! piece of Fig. 11c; the partition needs none.)
//!
//! Orientation is combinatorial, from the order of the nodes: no floating-point test decides it.

use crate::mesh::FACES;

/// A point of the partition, named by the mesh nodes it lies among.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Point {
    /// A mesh node.
    Node(u32),
    /// The cut point of an edge, lower node first.
    Edge(u32, u32),
    /// The point on a face with three labels, nodes ascending.
    Face(u32, u32, u32),
    /// The centre of a tetrahedron.
    Centre(u32),
}

impl Point {
    fn edge(a: u32, b: u32) -> Self {
        Self::Edge(a.min(b), a.max(b))
    }

    fn face(mut nodes: [u32; 3]) -> Self {
        nodes.sort_unstable();
        Self::Face(nodes[0], nodes[1], nodes[2])
    }
}

/// A triangle of the interface between two labels, counter-clockwise seen from `outside`.
pub(crate) struct Interface {
    pub(crate) inside: u32,
    pub(crate) outside: u32,
    pub(crate) points: [Point; 3],
}

/// The interfaces inside tetrahedron number `tet`.
pub(crate) fn interfaces(
    tet: u32,
    nodes: &[u32; 4],
    labels: &[u32; 4],
    mut emit: impl FnMut(Interface),
) {
    let distinct = (0..4)
        .filter(|&i| labels[..i].iter().all(|&l| l != labels[i]))
        .count();
    match distinct {
        1 => {}
        2 => two_labels(nodes, labels, &mut emit),
        _ => fans(tet, nodes, labels, &mut emit),
    }
}

fn two_labels(nodes: &[u32; 4], labels: &[u32; 4], emit: &mut impl FnMut(Interface)) {
    let cut = |i: usize, j: usize| Point::edge(nodes[i], nodes[j]);
    if let Some(lone) = (0..4).find(|&i| (0..4).filter(|&j| labels[j] == labels[i]).count() == 1) {
        // FACES[lone] is counter-clockwise seen from outside, hence seen away from the lone node.
        let [a, b, c] = FACES[lone];
        emit(Interface {
            inside: labels[lone],
            outside: labels[a],
            points: [cut(lone, a), cut(lone, b), cut(lone, c)],
        });
        return;
    }
    // Two and two: (a, b | c, d) as even permutations of (0, 1, 2, 3).
    for [a, b, c, d] in [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2]] {
        if labels[a] == labels[b] {
            let quad = [cut(a, c), cut(a, d), cut(b, d), cut(b, c)];
            for points in split_quad(quad) {
                emit(Interface {
                    inside: labels[a],
                    outside: labels[c],
                    points,
                });
            }
            return;
        }
    }
}

/// Two triangles of a quad, along the diagonal from its smallest corner: the same for whoever asks.
fn split_quad(q: [Point; 4]) -> [[Point; 3]; 2] {
    let smallest = (0..4).min_by_key(|&i| q[i]).unwrap_or(0);
    let [a, b, c, d]: [Point; 4] = std::array::from_fn(|i| q[(smallest + i) % 4]);
    [[a, b, c], [a, c, d]]
}

fn fans(tet: u32, nodes: &[u32; 4], labels: &[u32; 4], emit: &mut impl FnMut(Interface)) {
    let centre = Point::Centre(tet);
    for face in FACES {
        let n = face.map(|i| nodes[i]);
        let l = face.map(|i| labels[i]);
        if l[0] == l[1] && l[1] == l[2] {
            continue;
        }
        if let Some(x) = lone_corner(&l) {
            let (y, z) = ((x + 1) % 3, (x + 2) % 3);
            let points = [Point::edge(n[x], n[z]), Point::edge(n[x], n[y]), centre];
            emit(Interface {
                inside: l[x],
                outside: l[y],
                points,
            });
            continue;
        }
        for x in 0..3 {
            let y = (x + 1) % 3;
            let points = [Point::face(n), Point::edge(n[x], n[y]), centre];
            emit(Interface {
                inside: l[x],
                outside: l[y],
                points,
            });
        }
    }
}

/// The corner of a face whose label differs from the two others', which are equal.
fn lone_corner(l: &[u32; 3]) -> Option<usize> {
    (0..3).find(|&x| l[(x + 1) % 3] == l[(x + 2) % 3] && l[x] != l[(x + 1) % 3])
}

/// The parts of an outer face, each a triangle of one label, counter-clockwise seen from outside.
pub(crate) fn face_parts(
    nodes: &[u32; 3],
    labels: &[u32; 3],
    mut emit: impl FnMut(u32, [Point; 3]),
) {
    let corner = nodes.map(Point::Node);
    let cut = |i: usize, j: usize| Point::edge(nodes[i], nodes[j]);
    if labels[0] == labels[1] && labels[1] == labels[2] {
        emit(labels[0], corner);
    } else if let Some(x) = lone_corner(labels) {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        emit(labels[x], [corner[x], cut(x, y), cut(x, z)]);
        for points in split_quad([cut(x, y), corner[y], corner[z], cut(x, z)]) {
            emit(labels[y], points);
        }
    } else {
        for x in 0..3 {
            let (y, z) = ((x + 1) % 3, (x + 2) % 3);
            emit(labels[x], [corner[x], cut(x, y), Point::face(*nodes)]);
            emit(labels[x], [corner[x], Point::face(*nodes), cut(x, z)]);
        }
    }
}
