//! Triangles around each edge.

/// One side of a triangle, filed under the lower vertex of its edge.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The higher vertex of the edge.
    far: u32,
    /// Twice the triangle, plus one if it runs from the lower to the higher vertex.
    code: u32,
}

impl Side {
    pub(crate) fn triangle(self) -> usize {
        (self.code >> 1) as usize
    }

    pub(crate) fn is_forward(self) -> bool {
        self.code & 1 == 1
    }

    pub(crate) fn far(self) -> u32 {
        self.far
    }
}

/// The sides of all triangles, by edge.
pub(crate) struct Edges {
    starts: Vec<u32>,
    sides: Vec<Side>,
}

impl Edges {
    /// Triangles must not repeat a vertex.
    pub(crate) fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let directed = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
        let mut starts = vec![0_u32; vertices + 1];
        for (a, b) in triangles.iter().flat_map(directed) {
            starts[a.min(b) as usize + 1] += 1;
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut sides = vec![Side::default(); 3 * triangles.len()];
        for (t, triangle) in triangles.iter().enumerate() {
            for (a, b) in directed(triangle) {
                let slot = &mut next[a.min(b) as usize];
                sides[*slot as usize] = Side {
                    far: a.max(b),
                    code: 2 * t as u32 + u32::from(a < b),
                };
                *slot += 1;
            }
        }
        for v in 0..vertices {
            sides[starts[v] as usize..starts[v + 1] as usize].sort_unstable();
        }
        Self { starts, sides }
    }

    /// Each edge's lower vertex and sides, by vertices.
    pub(crate) fn groups(&self) -> impl Iterator<Item = (u32, &[Side])> {
        self.starts.windows(2).enumerate().flat_map(|(v, range)| {
            let sides = &self.sides[range[0] as usize..range[1] as usize];
            sides
                .chunk_by(|a, b| a.far == b.far)
                .map(move |group| (v as u32, group))
        })
    }
}
