//! Cell size for a requested number of elements.

use frangible::glam::DVec3;

use crate::fem::cover::lattice::{CELL_VOLUME, Cell, Lattice};
use crate::fem::cover::topology::Topology;
use crate::mesh::BodyMesh;

/// Relative error that will do in counts of sampled points, which take no time.
const SAMPLED: f64 = 0.02;
/// Most attempts: full ones, and counts before each.
const ATTEMPTS: usize = 4;
const COUNTS: usize = 12;
/// Points per wanted element from which a count of the cells that hold them will do.
const ENOUGH: usize = 8;
/// Most cubes along an edge of the body: bounds the parts that one tetrahedron is cut into.
const CUBES_PER_EDGE: f64 = 16.0;

/// Finds the side of the cubes that gives about the wanted number of elements; `near`: relative error in it that will do.
pub(crate) fn choose_lattice(
    body: &BodyMesh,
    faces: &[[u32; 2]],
    volume: f64,
    wanted: usize,
    near: f64,
) -> (Lattice, Topology) {
    let low = body
        .positions
        .iter()
        .fold(DVec3::INFINITY, |low, &p| low.min(p));
    let finest = longest_edge(body) / CUBES_PER_EDGE;
    let attempt = |side: f64| {
        let lattice = Lattice::new(low, side.max(finest));
        let topology = Topology::new(body, faces, &lattice);
        (lattice, topology)
    };
    // Cells that hold a node or a centroid: counted in no time, and nearly as many where there are enough of these.
    let points: Vec<DVec3> = (0..body.tets.len())
        .map(|t| body.corners(t).iter().sum::<DVec3>() / 4.0)
        .chain(body.positions.iter().copied())
        .collect();
    let sampled = |side: f64| {
        let lattice = Lattice::new(low, side.max(finest));
        let cell = |&p: &DVec3| Cell::at(lattice.in_sides(p)).key();
        let mut cells: Vec<u64> = points.iter().map(cell).collect();
        cells.sort_unstable();
        cells.dedup();
        cells.len() as f64
    };
    let counted = |side: f64| attempt(side).1.cells.len() as f64;
    // Elements that fill a solid body; a thin one takes more of them.
    let mut side = libm::cbrt(volume / (CELL_VOLUME * wanted as f64));
    if points.len() < ENOUGH * wanted {
        side = side_for(&counted, side, wanted as f64, near);
        return attempt(side);
    }
    let mut target = wanted as f64;
    side = side_for(&sampled, side, target, near.min(SAMPLED));
    let mut best = attempt(side);
    for _ in 1..ATTEMPTS {
        let excess = best.1.cells.len() as f64 / wanted as f64;
        if (excess - 1.0).abs() <= near {
            break;
        }
        target /= excess;
        side = side_for(&sampled, side, target, near.min(SAMPLED));
        let next = attempt(side);
        let better = next.1.cells.len().abs_diff(wanted) < best.1.cells.len().abs_diff(wanted);
        if !better {
            break;
        }
        best = next;
    }
    best
}

/// Side at which `count` is near `target`, starting from `side`.
fn side_for(count: &dyn Fn(f64) -> f64, side: f64, target: f64, near: f64) -> f64 {
    let excess = |side: f64| libm::log(count(side) / target);
    let (mut best, mut power) = ((side, excess(side)), 2.0);
    let mut last = best;
    for _ in 0..COUNTS {
        if best.1.abs() <= near / 4.0 {
            break;
        }
        // The count falls with a power of the side: about 3 for a solid, 2 for a sheet.
        let side = last.0 * libm::exp(last.1 / power);
        let next = (side, excess(side));
        let measured = (last.1 - next.1) / libm::log(side / last.0);
        if measured.is_finite() {
            power = measured.clamp(1.0, 4.0);
        }
        last = next;
        if next.1.abs() < best.1.abs() {
            best = next;
        }
    }
    best.0
}

fn longest_edge(body: &BodyMesh) -> f64 {
    let longest = |x: [DVec3; 4]| {
        (0..4)
            .flat_map(|i| (0..i).map(move |j| x[i].distance(x[j])))
            .fold(0.0, f64::max)
    };
    (0..body.tets.len())
        .map(|t| longest(body.corners(t)))
        .fold(0.0, f64::max)
}
