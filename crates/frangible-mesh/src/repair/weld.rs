//! Welding of vertices that are the same.

use std::collections::HashMap;

use glam::DVec3;
use rayon::slice::ParallelSliceMut as _;

/// Largest distance between the two banks of a crack, as a share of the bounding box's diagonal. Files with six digits
/// put them up to 1e-6 apart.
const CRACK: f64 = 1e-5;

/// Largest distance between them as a share of the rim's shortest edge there, so that finely divided rims do not shrink.
const CRACK_PER_EDGE: f64 = 0.25;

/// Vertices of one cell that others may move onto; more means a rim far finer than any crack that is closed.
const MOST_LEADERS: usize = 32;

/// For each vertex the lowest index of those at exactly the same place.
pub(super) fn same_place(positions: &[DVec3], [low, high]: [DVec3; 2]) -> Vec<u32> {
    const CELLS: f64 = ((1 << 21) - 1) as f64;
    let per_unit = CELLS / (high - low).max_element().max(f64::MIN_POSITIVE);
    let cell = |p: DVec3| {
        // Vertices outside the box (loose ones) land in the outermost cells.
        let cell = ((p - low) * per_unit).clamp(DVec3::ZERO, DVec3::splat(CELLS));
        (cell.x as u64) << 42 | (cell.y as u64) << 21 | cell.z as u64
    };
    let mut order: Vec<(u64, u32)> = positions
        .iter()
        .zip(0..)
        .map(|(&p, v)| (cell(p), v))
        .collect();
    order.par_sort_unstable();
    let mut first: Vec<u32> = (0..positions.len() as u32).collect();
    let exact = |v: u32| {
        (positions[v as usize] + DVec3::ZERO)
            .to_array()
            .map(f64::to_bits)
    };
    for run in order
        .chunk_by_mut(|a, b| a.0 == b.0)
        .filter(|run| run.len() > 1)
    {
        run.sort_unstable_by_key(|&(_, v)| (exact(v), v));
        for same in run.chunk_by(|a, b| exact(a.1) == exact(b.1)) {
            for &(_, v) in same {
                first[v as usize] = same[0].1;
            }
        }
    }
    first
}

/// For each vertex the one to replace it. `rim_edge` is the length of the shortest open edge at each vertex, infinite
/// where there is none: only such vertices move, onto an earlier one across a crack. What is closed already is never
/// pinched, however thin.
pub(super) fn across_cracks(
    positions: &[DVec3],
    rim_edge: &[f64],
    diagonal: f64,
) -> Option<Vec<u32>> {
    let reach = CRACK * diagonal;
    let cell = |p: DVec3| (p / reach).floor().to_array().map(|x| x as i64);
    // Looked up only, never iterated.
    let mut leaders: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut onto: Vec<u32> = (0..positions.len() as u32).collect();
    let mut any = false;
    for v in 0..positions.len() {
        if rim_edge[v] == f64::INFINITY {
            continue;
        }
        let p = positions[v];
        let [x, y, z] = cell(p);
        let nearest = (-1..=1)
            .flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| (i, j, k))))
            .filter_map(|(i, j, k)| {
                let neighbour = [
                    x.saturating_add(i),
                    y.saturating_add(j),
                    z.saturating_add(k),
                ];
                leaders.get(&neighbour)
            })
            .flatten()
            .map(|&leader| (p.distance(positions[leader as usize]), leader))
            .filter(|&(distance, leader)| {
                let shortest = rim_edge[v].min(rim_edge[leader as usize]);
                distance <= reach.min(CRACK_PER_EDGE * shortest)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        match nearest {
            Some((_, leader)) => {
                onto[v] = leader;
                any = true;
            }
            None => {
                let cell = leaders.entry([x, y, z]).or_default();
                if cell.len() < MOST_LEADERS {
                    cell.push(v as u32);
                }
            }
        }
    }
    any.then_some(onto)
}
