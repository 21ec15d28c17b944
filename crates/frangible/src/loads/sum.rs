//! How much a body carries wherever the load acts: one number per body, so that most loads need not be looked at.
//!
//! A force f at a point b of the surface moves mode i to φ_i(b)·f / λ_i, at most |φ_i(b)| |f| / λ_i. Over a triangle φ_i
//! is linear and its length convex, so its largest value is at a corner. With s_i the largest stress of mode i in the
//! body, forces whose sizes add up to F cause no more stress than F · max over corners of Σ_i s_i |φ_i| / λ_i.

use glam::Vec3;

use crate::blow::SteadyNear;
use crate::body::Body;
use crate::impact::harmless;
use crate::stress::ShapeWeights;

/// Share of the bounds that rounding of sums over a few thousand terms cannot reach.
const ROUNDING: f32 = 1.0 + 1e-4;

/// The largest stress, Pa, and gradient per newton of force anywhere on the surface, and per m/s² of gravity.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PerNewton {
    force: [f32; 2],
    gravity: [f32; 2],
}

impl PerNewton {
    fn of(body: &Body) -> Self {
        let (asset, prepared) = (&*body.asset, &*body.prepared);
        let modes = asset.modes.count();
        let compliance = |i: usize| prepared.periods[i] * prepared.periods[i];
        let (stress, gradient) = &prepared.whole;
        let sums = |length: &dyn Fn(usize) -> f32| {
            let mut sums = [0.0_f32; 2];
            for i in 0..modes {
                let q = length(i) * compliance(i);
                sums[0] += q * stress[i];
                sums[1] += q * gradient[i];
            }
            sums.map(|sum| sum * ROUNDING)
        };
        let mut nodes: Vec<u32> = asset.surface.triangles.as_flattened().to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let mut most = Self::default();
        let mut shapes = vec![Vec3::ZERO; modes];
        for node in nodes {
            shapes.fill(Vec3::ZERO);
            let point = &asset.embedding.nodes[node as usize];
            let element = asset.analysis.elements[point.element as usize];
            for (&at, weight) in element.iter().zip(ShapeWeights::values(point)) {
                for axis in 0..3 {
                    let row = asset.modes.row(3 * at as usize + axis);
                    for (shape, &phi) in shapes.iter_mut().zip(row) {
                        shape[axis] += weight * phi;
                    }
                }
            }
            let here = sums(&|i| shapes[i].length());
            most.force = [0, 1].map(|k| most.force[k].max(here[k]));
        }
        // A wall may be pushed right where its near field is: bounded from the longest waves that the modes leave to it.
        let walls = asset.surface.walls.thickness.len() as u32;
        let near = (0..walls).filter_map(|t| SteadyNear::most_per_newton(body, t));
        most.force[0] += near.fold(0.0, f32::max);
        if !prepared.weight.is_empty() {
            most.gravity = sums(&|i| prepared.weight[i].length());
        }
        most
    }
}

/// Makes the number that [`rest_margin_at_least`] multiplies with.
pub(crate) fn prepare(body: &Body) {
    body.prepared.per_newton.get_or_init(|| PerNewton::of(body));
}

/// How many times as much a body could carry, at least, of forces whose sizes (N) add up to `total`, wherever they act, and
/// of `gravity` (m/s²) when it is held: strength over a bound of the stress. Far below what [`rest`](super::rest) finds, but for a
/// handful of multiplications: above 1, nothing happens.
#[must_use]
pub fn rest_margin_at_least(body: &Body, total: f32, gravity: f32) -> f64 {
    let most = body.prepared.per_newton.get_or_init(|| PerNewton::of(body));
    let [stress, gradient] = [0, 1].map(|k| total * most.force[k] + gravity * most.gravity[k]);
    let bound = stress + 0.5 * body.prepared.quadratic_modulus * gradient * gradient;
    f64::from(harmless(body)) / f64::from(bound)
}
