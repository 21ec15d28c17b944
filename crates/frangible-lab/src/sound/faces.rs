//! The faces of a crack, which beat and rub on each other while the body rings.
//!
//! Modes of a cracked body know its cracks as cuts that are open: the two faces may even run through each other. Here they may not. Where
//! they close they push each other apart, as stiff as the layer of material between the nodes on their two sides, and where they slide
//! while they are pressed together they rub, after Coulomb. Faces without stress of their own touch before the blow and press nothing, so that
//! all forces grow with the blow alone: a cup that is hit twice as hard sounds twice as loud, and its tones and their decay stay.

use frangible::Material;
use frangible::glam::Vec3;
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::modal::ModalBasis;
use frangible::internals::piece::{Elastic, Portion};
use frangible::internals::state::BodyState;
use frangible_sound::SoundPulse;

/// Lanes of a row: its modes are filled up to a multiple of them.
const LANES: usize = 16;

/// Places on the two faces that lie opposite each other: one for each tetrahedron that a crack has cut.
pub(super) struct Faces {
    /// Modes, filled up to whole lanes.
    width: usize,
    /// Motion of the one side against the other for each mode, 1/√kg: along the normal, and along two directions within the face.
    rows: Vec<[Vec<f32>; 3]>,
    /// Stiffness along the normal and within the face, N/m.
    stiffness: Vec<[f32; 2]>,
    /// Coefficient of friction.
    friction: f32,
}

/// A mode of the body: angular frequency, rad/s, and loss of energy, 1/s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tone {
    pub(super) omega: f64,
    pub(super) loss: f64,
}

impl Tone {
    pub(super) fn of(mode: &frangible_sound::Mode) -> Self {
        Self {
            omega: std::f64::consts::TAU * mode.frequency,
            loss: mode.loss,
        }
    }
}

/// Course of the modes under a blow.
pub(super) struct Course {
    /// Force of the faces on each mode over time.
    pub(super) pulses: Vec<SoundPulse>,
    /// Energy at the end of the blow, J, and the part of it that friction has taken by the end.
    pub(super) energy: f64,
    pub(super) rubbed: f64,
}

impl Faces {
    /// The faces of a body's cracks. `state`: the cracks; `portion` and `elastic`: the body with its modes found with the cracks in it.
    pub(super) fn new(
        state: &BodyState,
        portion: &Portion,
        elastic: &Elastic,
        material: &Material,
        friction: f32,
    ) -> Self {
        let modes = &elastic.modes;
        let width = modes.count().next_multiple_of(LANES);
        let fracture = portion.root().fracture();
        let young = material.youngs_modulus as f32;
        let shear = young / (2.0 + 2.0 * material.poisson_ratio as f32);
        let mut faces = Self {
            width,
            rows: Vec::new(),
            stiffness: Vec::new(),
            friction,
        };
        let polygons = state.faces(portion.root().fracture());
        for (cut, (corners, count)) in state.cuts().zip(polygons) {
            let nodes = fracture.tets[cut.tet as usize];
            let mut shares = [0.0_f32; 4];
            let mut distance = 0.0;
            for above in [true, false] {
                let side = |k: &usize| (cut.values[*k] > 0.0) == above;
                let count = (0..4).filter(side).count() as f32;
                for k in (0..4).filter(side) {
                    shares[k] = if above { 1.0 } else { -1.0 } / count;
                    distance += shares[k] * cut.values[k];
                }
            }
            let ring = 1..count.saturating_sub(1);
            let area: Vec3 = ring
                .map(|k| 0.5 * (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]))
                .sum();
            let points = nodes.map(|v| portion.nodes().binary_search(&v).ok());
            if distance <= 0.0 || shares.contains(&0.0) || points.contains(&None) {
                continue;
            }
            let across = cut.direction.any_orthonormal_vector();
            let axes = [cut.direction, across, cut.direction.cross(across)];
            let mut rows = [(); 3].map(|()| vec![0.0; width]);
            for (point, share) in points.into_iter().flatten().zip(shares) {
                add(
                    &mut rows,
                    modes,
                    elastic,
                    &elastic.nodes[point],
                    axes.map(|a| a * share),
                );
            }
            faces.rows.push(rows);
            let scale = area.length() / distance;
            faces.stiffness.push([young * scale, shear * scale]);
        }
        faces
    }

    /// Places on the faces.
    pub(super) fn count(&self) -> usize {
        self.rows.len()
    }

    /// Follows the modes through a blow and for a time after it, s, by steps of `step`, s; the forces of the faces are noted as their mean over
    /// `every` steps.
    pub(super) fn follow(
        &self,
        tones: &[Tone],
        push: &[f32],
        blow: &SoundPulse,
        [step, long]: [f64; 2],
        every: usize,
    ) -> Course {
        let mut turns = Vec::new();
        for tone in tones {
            // The exact motion of a free mode over a step: q and v by e^{−δt}, cos and sin.
            let delta = 0.5 * tone.loss;
            let own = (tone.omega.powi(2) - delta.powi(2)).max(1.0).sqrt();
            let (sin, cos) = (own * step).sin_cos();
            let fall = (-delta * step).exp();
            turns.push([
                fall * (cos + delta / own * sin),
                fall * sin / own,
                -fall * tone.omega.powi(2) / own * sin,
                fall * (cos - delta / own * sin),
            ]);
        }
        let (mut q, mut v) = (vec![0.0_f64; tones.len()], vec![0.0_f64; tones.len()]);
        let (mut place, mut force) = (vec![0.0_f32; self.width], vec![0.0_f32; self.width]);
        let mut slid = vec![[0.0_f32; 2]; self.rows.len()];
        let mut noted: Vec<Vec<f32>> = Vec::new();
        let mut sums = vec![0.0_f32; self.width];
        let (mut energy, mut rubbed) = (0.0, 0.0);
        let steps = (long / step) as usize;
        let struck = (blow.duration() / step).ceil() as usize;
        for n in 0..steps {
            for (i, [a, b, c, d]) in turns.iter().enumerate() {
                (q[i], v[i]) = (a * q[i] + b * v[i], c * q[i] + d * v[i]);
                place[i] = q[i] as f32;
            }
            force.fill(0.0);
            for ((rows, stiffness), slid) in self.rows.iter().zip(&self.stiffness).zip(&mut slid) {
                let [gap, y, z] = [0, 1, 2].map(|k| dot(&rows[k], &place));
                if gap >= 0.0 {
                    *slid = [y, z];
                    continue;
                }
                let pressed = -gap * stiffness[0];
                let mut held = [y - slid[0], z - slid[1]].map(|s| s * stiffness[1]);
                let size = held[0].hypot(held[1]);
                let most = self.friction * pressed;
                if size > most {
                    let kept = most / size;
                    let way = (size - most) / stiffness[1];
                    rubbed += f64::from(most * way);
                    held = held.map(|h| h * kept);
                    *slid = [y - held[0] / stiffness[1], z - held[1] / stiffness[1]];
                }
                for (row, f) in rows.iter().zip([pressed, -held[0], -held[1]]) {
                    for (sum, r) in force.iter_mut().zip(row) {
                        *sum += f * r;
                    }
                }
            }
            let given = blow.at((n as f64 + 1.0) * step).0;
            for (i, v) in v.iter_mut().enumerate() {
                *v += step * (f64::from(force[i]) + given * f64::from(push[i]));
                sums[i] += force[i] / every as f32;
            }
            if n == struck {
                let modes = q.iter().zip(&v).zip(tones);
                energy = modes
                    .map(|((q, v), t)| 0.5 * (v * v + (t.omega * q).powi(2)))
                    .sum();
            }
            if (n + 1) % every == 0 {
                noted.push(std::mem::replace(&mut sums, vec![0.0; self.width]));
            }
        }
        let time_step = every as f64 * step;
        let pulses = (0..tones.len()).map(|i| SoundPulse {
            time_step,
            force: noted.iter().map(|sums| sums[i]).collect(),
        });
        Course {
            pulses: pulses.collect(),
            energy,
            rubbed,
        }
    }
}

/// Adds a point's share of the motion along some axes, each times a weight.
fn add(
    rows: &mut [Vec<f32>; 3],
    modes: &ModalBasis,
    elastic: &Elastic,
    point: &EmbeddedPoint,
    axes: [Vec3; 3],
) {
    let nodes = elastic.analysis.elements[point.element as usize];
    for (&node, shape) in nodes.iter().zip(point.shape_values()) {
        let motion = modes.rows(node as usize);
        for (row, axis) in rows.iter_mut().zip(axes) {
            for (motion, weight) in motion.into_iter().zip((axis * shape).to_array()) {
                for (sum, m) in row.iter_mut().zip(motion) {
                    *sum += weight * m;
                }
            }
        }
    }
}

/// The sum of products, lane by lane, so that it is computed in vectors.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One face, normal to the motion of the first mode, along the motion of the second.
    fn face(friction: f32) -> Faces {
        let row = |mode: usize| {
            let mut row = vec![0.0; LANES];
            row[mode] = 1.0;
            row
        };
        Faces {
            width: LANES,
            rows: vec![[row(0), row(1), vec![0.0; LANES]]],
            stiffness: vec![[3.0e6, 3.0e6]],
            friction,
        }
    }

    fn follow(friction: f32, blow: f64) -> Course {
        let tone = |omega: f64| Tone { omega, loss: 0.0 };
        let blow = SoundPulse::half_sine(blow, 1e-4);
        let tones = [tone(1e3), tone(700.0)];
        face(friction).follow(&tones, &[1.0, 0.8], &blow, [1e-6, 0.1], 1)
    }

    /// A mode whose faces are open for half a swing of ω and closed for half a swing of √(ω² + k) takes π/ω + π/√(ω² + k) for both.
    #[test]
    fn a_crack_that_beats_has_the_period_of_its_two_halves() {
        let course = follow(0.0, 0.01);
        let force = &course.pulses[0].force;
        let closes = |n: &usize| force[n - 1] == 0.0 && force[*n] > 0.0;
        let closings: Vec<usize> = (1..force.len()).filter(closes).collect();
        let period = 1e-6 * (closings[20] - closings[0]) as f64 / 20.0;
        let expected = std::f64::consts::PI * (1.0 / 1e3 + 1.0 / (1e6_f64 + 3e6).sqrt());
        assert!(
            (period / expected - 1.0).abs() < 1e-3,
            "{period} {expected}"
        );
        // Nothing rubs, and the last beat is as hard as the first.
        let hardest = |from: usize| force[from..from + 5000].iter().copied().fold(0.0, f32::max);
        let (first, last) = (hardest(closings[0]), hardest(force.len() - 5000));
        assert!((last / first - 1.0).abs() < 0.01, "{first} {last}");
        assert_eq!(course.rubbed, 0.0);
    }

    #[test]
    fn what_rubs_takes_energy_and_all_forces_grow_with_the_blow() {
        let (once, twice) = (follow(0.4, 0.01), follow(0.4, 0.02));
        let share = once.rubbed / once.energy;
        assert!((0.1..1.0).contains(&share), "{share}");
        // The blow's own numbers are rounded.
        let [a, b] = [&once, &twice].map(|course| course.rubbed);
        assert!((b / a / 4.0 - 1.0).abs() < 1e-3, "{a} {b}");
    }
}
