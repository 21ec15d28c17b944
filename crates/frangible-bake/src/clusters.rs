//! Compact face-connected clusters of tetrahedra: the collision cells of a body of any shape.
//!
//! Lloyd's algorithm on the graph of neighbouring tetrahedra, as used on surfaces by Cohen-Steiner, Alliez and Desbrun (2004):
//! each tetrahedron belongs to the seed with the shortest path through the body, so that a cluster never joins two walls that
//! are merely close in space.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use frangible::glam::DVec3;
use frangible::internals::TetMesh;
use frangible::internals::mesh::NO_NEIGHBOUR;

/// Moves of the seeds to the middle of their clusters; more change little.
const ROUNDS: usize = 4;

/// Cluster of each tetrahedron, 0..`wanted`, and their number (fewer for a mesh of fewer tetrahedra).
pub(crate) fn cluster(mesh: &TetMesh, wanted: usize) -> (Vec<u32>, usize) {
    let centroids: Vec<DVec3> = (0..mesh.tets.len())
        .map(|e| mesh.centroid(e).as_dvec3())
        .collect();
    let volumes: Vec<f64> = (0..mesh.tets.len()).map(|e| mesh.volume(e)).collect();
    let mut front = Front::new(mesh, &centroids);
    let mut seeds = vec![0];
    front.grow(0, 0);
    while seeds.len() < wanted.min(centroids.len()) {
        // The tetrahedron farthest from all seeds is the next one.
        let farthest = (0..centroids.len())
            .max_by(|&a, &b| {
                front.distance[a]
                    .total_cmp(&front.distance[b])
                    .then(b.cmp(&a))
            })
            .unwrap_or(0);
        front.grow(farthest, seeds.len() as u32);
        seeds.push(farthest);
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![(DVec3::ZERO, 0.0); seeds.len()];
        for (e, &cell) in front.owner.iter().enumerate() {
            let sum = &mut sums[cell as usize];
            sum.0 += volumes[e] * centroids[e];
            sum.1 += volumes[e];
        }
        let mut best = vec![(f64::INFINITY, 0); seeds.len()];
        for (e, &cell) in front.owner.iter().enumerate() {
            let (sum, volume) = sums[cell as usize];
            let distance = centroids[e].distance_squared(sum / volume);
            if distance < best[cell as usize].0 {
                best[cell as usize] = (distance, e);
            }
        }
        seeds = best.into_iter().map(|b| b.1).collect();
        front = Front::new(mesh, &centroids);
        front.grow_all(&seeds);
    }
    (front.owner, seeds.len())
}

/// Distances through the body from the nearest seed.
struct Front<'a> {
    mesh: &'a TetMesh,
    centroids: &'a [DVec3],
    distance: Vec<f64>,
    owner: Vec<u32>,
}

/// Nearest first; ties by number, so that the order never depends on the heap.
#[derive(PartialEq)]
struct Visit(f64, u32);

impl Eq for Visit {}

impl PartialOrd for Visit {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Visit {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}

impl<'a> Front<'a> {
    fn new(mesh: &'a TetMesh, centroids: &'a [DVec3]) -> Self {
        let n = centroids.len();
        Self {
            mesh,
            centroids,
            distance: vec![f64::INFINITY; n],
            owner: vec![0; n],
        }
    }

    /// Adds a seed: takes over the tetrahedra nearer to it than to the seeds before [Dijkstra 1959].
    fn grow(&mut self, seed: usize, cell: u32) {
        self.distance[seed] = 0.0;
        self.owner[seed] = cell;
        self.spread(BinaryHeap::from([Visit(0.0, seed as u32)]));
    }

    /// Adds all seeds at once: each tetrahedron is reached from its own seed only.
    fn grow_all(&mut self, seeds: &[usize]) {
        let mut heap = BinaryHeap::new();
        for (cell, &seed) in seeds.iter().enumerate() {
            self.distance[seed] = 0.0;
            self.owner[seed] = cell as u32;
            heap.push(Visit(0.0, seed as u32));
        }
        self.spread(heap);
    }

    fn spread(&mut self, mut heap: BinaryHeap<Visit>) {
        while let Some(Visit(distance, e)) = heap.pop() {
            let e = e as usize;
            if distance > self.distance[e] {
                continue;
            }
            for &n in self.mesh.neighbours[e]
                .iter()
                .filter(|n| **n != NO_NEIGHBOUR)
            {
                let through = distance + self.centroids[e].distance(self.centroids[n as usize]);
                if through < self.distance[n as usize] {
                    self.distance[n as usize] = through;
                    self.owner[n as usize] = self.owner[e];
                    heap.push(Visit(through, n));
                }
            }
        }
    }
}
