//! Moments of the normal over a set of triangles, up to second order, about their centroid [B18 §3.1].

use glam::DVec3;

use super::packet::{Packet, WIDTH, area_vector};

/// Pairs of axes in the order in which second moments are stored.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// ∫n, ∫n⊗δ and ∫n⊗δ⊗δ over triangles, with δ = x − centre.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    /// Centroid of the area, m.
    pub(super) centre: DVec3,
    /// Area of the triangles, m².
    pub(super) area: f64,
    /// ∫nᵢ, m².
    pub(super) zeroth: DVec3,
    /// ∫nᵢδⱼ by i then j, m³.
    pub(super) first: [[f64; 3]; 3],
    /// ∫nᵢδⱼδₖ by i then the pair jk in the order xx yy zz xy xz yz, m⁴.
    pub(super) second: [[f64; 6]; 3],
}

/// Moments of one packet's triangles, exact.
pub(super) fn of_packet(packet: &Packet) -> Moments {
    let triangles: [[DVec3; 3]; WIDTH] = std::array::from_fn(|lane| packet.triangle(lane));
    let areas = triangles.map(area_vector);
    let area: f64 = areas.iter().map(|n| n.length()).sum();
    let weighted: DVec3 = triangles
        .iter()
        .zip(&areas)
        .map(|([a, b, c], n)| n.length() / 3.0 * (a + b + c))
        .sum();
    let mut sum = Moments {
        centre: weighted / area,
        area,
        ..Moments::default()
    };
    for (corners, n) in triangles.iter().zip(areas) {
        let deltas = corners.map(|x| x - sum.centre);
        let total = deltas[0] + deltas[1] + deltas[2];
        sum.zeroth += n;
        for i in 0..3 {
            for j in 0..3 {
                sum.first[i][j] += n[i] * total[j] / 3.0;
            }
            for (slot, [j, k]) in PAIRS.into_iter().enumerate() {
                let products: f64 = deltas.iter().map(|d| d[j] * d[k]).sum();
                sum.second[i][slot] += n[i] / 12.0 * (products + total[j] * total[k]);
            }
        }
    }
    sum
}

/// Moments of the union, about its own centroid.
pub(super) fn join(parts: &[Moments]) -> Moments {
    let area: f64 = parts.iter().map(|part| part.area).sum();
    let weighted: DVec3 = parts.iter().map(|part| part.area * part.centre).sum();
    let mut sum = Moments {
        centre: weighted / area,
        area,
        ..Moments::default()
    };
    for part in parts {
        let shift = part.centre - sum.centre;
        sum.zeroth += part.zeroth;
        for i in 0..3 {
            for j in 0..3 {
                sum.first[i][j] += part.first[i][j] + part.zeroth[i] * shift[j];
            }
            for (slot, [j, k]) in PAIRS.into_iter().enumerate() {
                sum.second[i][slot] += part.second[i][slot]
                    + part.first[i][j] * shift[k]
                    + part.first[i][k] * shift[j]
                    + part.zeroth[i] * shift[j] * shift[k];
            }
        }
    }
    sum
}
