//! Operations and bytes of the initiation, counted in the source: the necessary work, not the work of the compiled code.

use frangible::internals::stress::{DisplacementBatch, Law};

/// Steps of a batch, which go through the arithmetic side by side.
const LANES: usize = DisplacementBatch::LANES;

/// f64 operations of a mode's step matrix, three blocks of 2 × 2 that are not zero: a Taylor series of 13 products (52), scaled (12)
/// and summed (12), without squarings, which 16 samples per period do not need. Free of the force, one block is left out.
const STEP_MATRIX: usize = 13 * (52 + 12 + 12);
/// f64 operations of a mode at a step: the state times its matrix (20), the amplitude (2), the energies (7 and 5).
const MODE_STEP: usize = 20 + 2 + 7 + 5;

/// Operations of the response.
pub(super) fn response(modes: usize, steps: usize) -> f64 {
    (modes * (STEP_MATRIX + MODE_STEP * steps)) as f64
}

/// Bytes that the response writes: f32 amplitudes, and two f64 energies a step that are read and written by every mode.
pub(super) fn response_bytes(modes: usize, steps: usize) -> f64 {
    (steps * modes * (4 + 2 * 16)) as f64
}

/// Operations of u = Φ q at one node for a batch: a multiplication and an addition per axis, mode and step.
pub(super) fn displacement(modes: usize) -> f64 {
    (2 * 3 * modes * LANES) as f64
}

/// Bytes of the same: three rows of Φ read, three rows of the batch written. The amplitudes stay in the first-level cache.
pub(super) fn displacement_bytes(modes: usize) -> f64 {
    (4 * 3 * (modes + LANES)) as f64
}

/// f32 operations that a weak point needs for a batch:
/// - once, ∇N of four corners (5 each) and six mid-edges (12 each);
/// - at each step ∇u of nine nodes relative to the tenth (3 + 18 each), Green and Lagrange's strain (6 + 42), a bound of the largest
///   tension (22), and its law: Hooke's (12), beside a free surface (74), at an edge (27), with the energy (12, 12 and 2).
pub(super) fn weak_point(law: Law) -> f64 {
    let of_law = match law {
        Law::Solid => 12 + 12,
        Law::Free(_) => 74 + 12,
        Law::Edge(_) => 27 + 2,
    };
    (4 * 5 + 6 * 12 + LANES * (9 * 21 + 48 + 22 + of_law)) as f64
}

/// Bytes of the same: the point, its element's node numbers and gradients, the displacements of ten nodes, which other points
/// share.
pub(super) fn weak_point_bytes() -> f64 {
    let point = size_of::<frangible::internals::asset::EmbeddedPoint>();
    let element = 10 * size_of::<u32>() + 4 * size_of::<frangible::glam::Vec3>();
    (point + element + 10 * NODE) as f64
}

/// Bytes of a node's displacements at a batch.
pub(super) const NODE: usize = 3 * LANES * size_of::<f32>();

#[cfg(test)]
mod tests {
    use super::{displacement, displacement_bytes, response, weak_point, weak_point_bytes};
    use frangible::glam::Vec3;
    use frangible::internals::stress::{DisplacementBatch, Law};

    #[test]
    fn counts_by_hand() {
        assert_eq!(response(1, 0), 988.0);
        assert_eq!(response(2, 3), 2.0 * (988.0 + 102.0));
        let lanes = DisplacementBatch::LANES as f64;
        assert_eq!(displacement(100), 600.0 * lanes);
        assert_eq!(displacement_bytes(100), 1200.0 + 12.0 * lanes);
        // A free surface has more to do than the inside, an edge between them.
        let [solid, edge, free] =
            [Law::Solid, Law::Edge(Vec3::X), Law::Free(Vec3::X)].map(weak_point);
        assert_eq!(solid, 92.0 + lanes * 283.0);
        assert!(solid < edge && edge < free);
        assert_eq!(weak_point_bytes(), 32.0 + 88.0 + 120.0 * lanes);
    }
}
