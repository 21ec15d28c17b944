//! Local thickness of a body: the diameter of the largest ball within the body that holds a place (T. Hildebrand,
//! P. Rüegsegger, J. Microscopy 185 (1997) 67).

use std::collections::VecDeque;

use glam::Vec3;

use crate::mesh::{NO_NEIGHBOUR, TetMesh, closest_on_triangle};

/// A ball is left out whose centre lies so deep in a larger one that it sticks out of it by no more than this share of the larger radius.
const SPARED: f32 = 0.15;

/// Local thickness at the centroid of each tetrahedron, m. It takes one pass over the mesh per ball, and few balls are needed: most
/// lie in a larger one.
pub(super) fn thickness(mesh: &TetMesh, centroids: &[Vec3]) -> Vec<f32> {
    let depths = depths(mesh, centroids);
    let mut order: Vec<u32> = (0..depths.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        let deeper = depths[b as usize].total_cmp(&depths[a as usize]);
        deeper.then(a.cmp(&b))
    });
    let mut found = vec![0.0_f32; depths.len()];
    // The first ball that holds each centroid, which is the largest one.
    let mut holder = vec![NO_NEIGHBOUR; depths.len()];
    let mut reached_by = vec![NO_NEIGHBOUR; depths.len()];
    let mut alone = vec![false; depths.len()];
    let mut waiting = Vec::new();
    for centre in order {
        let (at, radius) = (centroids[centre as usize], depths[centre as usize]);
        let larger = holder[centre as usize];
        if larger != NO_NEIGHBOUR {
            let (other, most) = (centroids[larger as usize], depths[larger as usize]);
            if at.distance(other) + radius <= (1.0 + SPARED) * most {
                continue;
            }
        }
        waiting.push(centre);
        reached_by[centre as usize] = centre;
        alone[centre as usize] = larger == NO_NEIGHBOUR;
        while let Some(e) = waiting.pop() {
            if holder[e as usize] == NO_NEIGHBOUR {
                holder[e as usize] = centre;
                found[e as usize] = 2.0 * radius;
            }
            for n in mesh.neighbours[e as usize] {
                if n != NO_NEIGHBOUR
                    && reached_by[n as usize] != centre
                    && centroids[n as usize].distance_squared(at) <= radius * radius
                {
                    reached_by[n as usize] = centre;
                    alone[centre as usize] = false;
                    waiting.push(n);
                }
            }
        }
    }
    spread_into_corners(mesh, &alone, &mut found);
    found
}

/// Gives a corner whose own ball holds nothing else the thickness of the place beside it.
fn spread_into_corners(mesh: &TetMesh, is_corner: &[bool], found: &mut [f32]) {
    let tets = 0..found.len() as u32;
    let mut queue: VecDeque<u32> = tets.filter(|&e| !is_corner[e as usize]).collect();
    while let Some(e) = queue.pop_front() {
        for n in mesh.neighbours[e as usize] {
            if n != NO_NEIGHBOUR && is_corner[n as usize] && found[n as usize] < found[e as usize] {
                found[n as usize] = found[e as usize];
                queue.push_back(n);
            }
        }
    }
}

/// Distance from the centroid of each tetrahedron to the outer surface, m: to the nearest of the triangles that are handed on from neighbour
/// to neighbour.
fn depths(mesh: &TetMesh, centroids: &[Vec3]) -> Vec<f32> {
    let boundary = mesh.boundary();
    let distance = |triangle: usize, e: u32| {
        let corners = boundary[triangle].0.map(|v| mesh.positions[v as usize]);
        let p = centroids[e as usize];
        let weights = closest_on_triangle(corners.map(Vec3::as_dvec3), p.as_dvec3());
        let shares = corners.iter().zip(weights).map(|(&x, w)| x * w as f32);
        shares.sum::<Vec3>().distance(p)
    };
    let mut depths = vec![f32::INFINITY; centroids.len()];
    let mut nearest = vec![usize::MAX; centroids.len()];
    let mut queue = VecDeque::new();
    for (triangle, &(_, e)) in boundary.iter().enumerate() {
        let depth = distance(triangle, e);
        if depth < depths[e as usize] {
            (depths[e as usize], nearest[e as usize]) = (depth, triangle);
        }
        queue.push_back(e);
    }
    while let Some(e) = queue.pop_front() {
        let triangle = nearest[e as usize];
        for n in mesh.neighbours[e as usize] {
            if n == NO_NEIGHBOUR || nearest[n as usize] == triangle {
                continue;
            }
            let depth = distance(triangle, n);
            if depth < depths[n as usize] {
                (depths[n as usize], nearest[n as usize]) = (depth, triangle);
                queue.push_back(n);
            }
        }
    }
    depths
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of cubes of 1, each of six tetrahedra.
    fn block(counts: [u32; 3]) -> TetMesh {
        let [nx, ny, nz] = counts;
        let node = |x: u32, y: u32, z: u32| (z * (ny + 1) + y) * (nx + 1) + x;
        let nodes =
            (0..=nz).flat_map(|z| (0..=ny).flat_map(move |y| (0..=nx).map(move |x| [x, y, z])));
        let positions = nodes.map(|p| Vec3::from_array(p.map(|x| x as f32)));
        let mut tets = Vec::new();
        for (z, y, x) in
            (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| (z, y, x))))
        {
            // Along each path from the first corner to the last.
            for path in [
                [0, 1, 2],
                [1, 2, 0],
                [2, 0, 1],
                [0, 2, 1],
                [2, 1, 0],
                [1, 0, 2],
            ] {
                let mut at = [x, y, z];
                let mut tet = [node(x, y, z); 4];
                for (k, axis) in path.into_iter().enumerate() {
                    at[axis] += 1;
                    tet[k + 1] = node(at[0], at[1], at[2]);
                }
                let even = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].contains(&path);
                if !even {
                    tet.swap(2, 3);
                }
                tets.push(tet);
            }
        }
        TetMesh::new(positions.collect(), tets)
    }

    #[test]
    fn a_slab_is_as_thick_as_its_shortest_side_and_a_bar_as_its_width() {
        for (counts, least) in [([24, 24, 8], 8.0_f32), ([30, 6, 6], 6.0)] {
            let mesh = block(counts);
            let centroids: Vec<Vec3> = (0..mesh.tets.len()).map(|e| mesh.centroid(e)).collect();
            let found = thickness(&mesh, &centroids);
            let most = found.iter().copied().fold(0.0, f32::max);
            let mean = found.iter().sum::<f32>() / found.len() as f32;
            assert!(most <= least && most > 0.9 * least, "{counts:?}: {most}");
            assert!(mean > 0.75 * least, "{counts:?}: {mean}");
        }
    }
}
