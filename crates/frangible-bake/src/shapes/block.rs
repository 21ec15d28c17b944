//! Boxes, plates and rods, and shapes made by bending a box.

use frangible::glam::DVec3;

use crate::error::{BakeError, positive};
use crate::extrude::extrude;
use crate::mesh::BodyMesh;
use crate::random;
use crate::shapes::MeshSize;
use crate::sheet::{FREE, Sheet};

/// Divisions of an edge of `length` by elements of `edge`, at least one.
fn divisions(length: f64, edge: f64) -> usize {
    ((length / edge).round() as usize).max(1)
}

/// Estimated tetrahedra of a box meshed with `size`.
pub(crate) fn estimate(size: [f64; 3], mesh: MeshSize) -> f64 {
    6.0 * (size[0] / mesh.edge).max(1.0)
        * (size[1] / mesh.edge).max(1.0)
        * layers(size, mesh) as f64
}

fn layers(size: [f64; 3], mesh: MeshSize) -> usize {
    if mesh.layers > 0 {
        mesh.layers
    } else {
        divisions(size[2], mesh.edge)
    }
}

/// All three sides must be finite and above zero.
pub(crate) fn validate(size: [f64; 3]) -> Result<(), BakeError> {
    size.iter()
        .try_for_each(|&s| positive("a side of the box, in m,", s))
}

/// Map from a place of the box to its place in the body, m.
pub(crate) type Warp<'a> = &'a dyn Fn(DVec3) -> DVec3;

/// The box as it is.
pub(crate) fn straight(p: DVec3) -> DVec3 {
    p
}

/// Regular mesh for the analysis: `size[0] × size[1]` grid of squares, two triangles each.
pub(crate) fn regular(
    size: [f64; 3],
    mesh: MeshSize,
    warp: Warp<'_>,
) -> Result<BodyMesh, BakeError> {
    let (nx, ny) = (divisions(size[0], mesh.edge), divisions(size[1], mesh.edge));
    let mut sheet = Sheet::default();
    for j in 0..=ny {
        for i in 0..=nx {
            sheet.push(
                [
                    i as f64 * size[0] / nx as f64,
                    j as f64 * size[1] / ny as f64,
                ],
                [false; 2],
                FREE,
            );
        }
    }
    let v = |i: usize, j: usize| (j * (nx + 1) + i) as u32;
    for j in 0..ny {
        for i in 0..nx {
            sheet
                .triangles
                .push([v(i, j), v(i + 1, j), v(i + 1, j + 1)]);
            sheet
                .triangles
                .push([v(i, j), v(i + 1, j + 1), v(i, j + 1)]);
        }
    }
    // Squares of a box are left alone; where a corner is round, the diagonal goes that would cut it off.
    sheet.flip(&|c| warp(DVec3::new(c[0], c[1], 0.0)));
    let layers = layers(size, mesh);
    let position = |v: usize, layer: usize| {
        let [x, y] = sheet.coords[v];
        warp(DVec3::new(x, y, layer as f64 * size[2] / layers as f64))
    };
    extrude(&sheet, layers, None, &position, &|_, c| cell(size, c))
}

/// Irregular mesh for cracks: rows of nearly equilateral triangles, jittered and relaxed.
pub(crate) fn irregular(
    size: [f64; 3],
    mesh: MeshSize,
    seed: u64,
    warp: Warp<'_>,
) -> Result<BodyMesh, BakeError> {
    let nx = divisions(size[0], mesh.edge);
    let ny = divisions(size[1], mesh.edge * 0.75_f64.sqrt());
    let step = size[0] / nx as f64;
    let mut sheet = Sheet::default();
    let mut previous: Vec<(u32, f64)> = Vec::new();
    for j in 0..=ny {
        let y = size[1] * j as f64 / ny as f64;
        // Every other row is shifted by half a step, its ends kept on the edge.
        let count = if j % 2 == 0 { nx + 1 } else { nx + 2 };
        let row: Vec<(u32, f64)> = (0..count)
            .map(|i| {
                let x = if j % 2 == 0 {
                    i as f64 * step
                } else {
                    ((i as f64 - 0.5) * step).clamp(0.0, size[0])
                };
                let end = i == 0 || i + 1 == count;
                (sheet.push([x, y], [!end, j > 0 && j < ny], FREE), x)
            })
            .collect();
        if j > 0 {
            sheet.zip(&previous, &row);
        }
        previous = row;
    }
    let lift = |c: [f64; 2]| warp(DVec3::new(c[0], c[1], 0.0));
    sheet.disorder(mesh.edge, seed, &lift);
    sheet.relax(2, &lift);
    sheet.flip(&lift);
    let layers = layers(size, mesh);
    let height = size[2] / layers as f64;
    let position = |v: usize, layer: usize| {
        let mut p = DVec3::new(
            sheet.coords[v][0],
            sheet.coords[v][1],
            layer as f64 * height,
        );
        if layer > 0 && layer < layers {
            let random = |axis: u64| {
                random::symmetric(seed ^ 0x5eed, 3 * (v * (layers + 1) + layer) as u64 + axis)
            };
            p.z += 0.2 * height * random(2);
            for axis in 0..2 {
                if sheet.slides[v][axis] {
                    p[axis] += 0.1 * mesh.edge * random(axis as u64);
                }
            }
        }
        warp(p)
    };
    extrude(&sheet, layers, Some(seed), &position, &|_, c| cell(size, c))
}

/// Cell of a point: a coarse block grid, 3 × 3 × 3 in a cube, 8 × 8 × 1 in a pane.
fn cell(size: [f64; 3], p: DVec3) -> u32 {
    let longest = size.iter().copied().fold(0.0, f64::max);
    let shortest = size.iter().copied().fold(f64::INFINITY, f64::min);
    let along_longest = if shortest > 0.4 * longest { 3.0 } else { 8.0 };
    let mut number = 0;
    for axis in 0..3 {
        let count = (along_longest * size[axis] / longest).round().max(1.0) as u32;
        number = number * count + ((p[axis] / size[axis] * f64::from(count)) as u32).min(count - 1);
    }
    number
}
