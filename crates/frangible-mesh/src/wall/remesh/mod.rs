//! Remeshes a triangulated sheet to triangles of one size without a preferred direction.
//!
//! Edges are split, removed and turned, and vertices moved along the sheet [Botsch & Kobbelt 2004]; sharp lines, corners and the edges of
//! the sheet stay. The mesh that cracks cut is then shaken: three rounds of moves by lot, flips and one smoothing step leave no trace of
//! the triangles that were drawn.

mod collapse;
mod flip;
mod lines;
mod relax;
mod sheet;
mod split;
pub(crate) mod surface;

use crate::random;
use crate::surface::Surface;
use relax::Ground;
use surface::Reference;

pub(crate) use collapse::is_manifold;
pub(crate) use sheet::{Edge, Kind, NONE, Sheet, edges_of};

/// Edges at which normals differ by more than this, degrees, are sharp.
pub(crate) const CREASE: f64 = 38.0;
/// Longest and shortest edges, in wanted edges [Botsch & Kobbelt 2004, §4].
const LONGEST: f64 = 4.0 / 3.0;
const SHORTEST: f64 = 4.0 / 5.0;
/// Rounds of splitting, removing, turning and smoothing.
const ROUNDS: u64 = 6;
/// Rounds of moves by lot. One leaves stretches of the pattern standing, three leave none.
const SHAKES: u64 = 3;
/// Largest move along each axis, in wanted edges.
const SHAKE: f64 = 0.35;

/// Makes triangles with edges of about `edge` metres out of those of `surface`; irregular for a seed. The sharp edges of the result name
/// the sharp edges of `surface`, counted in the order of [`edges_of`].
pub(crate) fn remesh(
    surface: &Surface,
    reference: &Reference,
    edge: f64,
    seed: Option<u64>,
) -> Sheet {
    let (mut sheet, lines) = lines::trace(&surface.positions, &surface.triangles, CREASE);
    let ground = Ground {
        lines: &lines,
        reference,
        edge,
    };
    for round in 0..ROUNDS {
        split::split(&mut sheet, &lines, reference, LONGEST * edge);
        flip::flip(&mut sheet);
        if let Some(seed) = seed
            && round + 2 < ROUNDS
        {
            // Halved edges are all of one length; moved by lot, some are too short and some too long.
            ground.jitter(&mut sheet, SHAKE * edge, random::bits(seed, SHAKES + round));
            flip::flip(&mut sheet);
        }
        collapse::collapse(&mut sheet, SHORTEST * edge, LONGEST * edge);
        flip::flip(&mut sheet);
        ground.relax(&mut sheet, 2);
        flip::flip(&mut sheet);
    }
    if let Some(seed) = seed {
        for round in 0..SHAKES {
            ground.jitter(&mut sheet, SHAKE * edge, random::bits(seed, round));
            flip::flip(&mut sheet);
            ground.relax(&mut sheet, 1);
            flip::flip(&mut sheet);
        }
        ground.relax(&mut sheet, 2);
        flip::flip(&mut sheet);
    }
    sheet
}
