//! Number of modes that are integrated through time during a blow.
//!
//! The others respond statically to the current force, q = ξ F/λ, which is accurate for modes much faster than the blow and costs no time
//! steps. So the number depends on the blow. A hard blow is assumed: a steel ball with a tenth of the body's mass and a radius of 10 mm at
//! 5 m/s, with Hertz's duration on a flat surface and a half-sine force inwards along the normal. Softer or slower blows last longer and
//! need fewer modes.
//! For a body with [branches](has_branches), the ball has a tenth of the mass of a branch: at its end, the branch and not the whole body
//! resists the contact, which is therefore shorter and excites more modes. Twelve arms have twelve modes of first-order bending.
//!
//! The blow is simulated at [`CONTACTS`] points that are spread evenly over the surface. For each point, the largest tensile
//! principal stress over a sample of tetrahedra and over time is computed with the lowest N modes integrated, for a sequence of N.
//! The result is the smallest N beyond which more modes change this stress by less than [`TOLERANCE`], for all points but
//! [`SPARED`]. The sample is spread over the surface and dense around the contact. On a wall, tetrahedra within [`NEAR`] thicknesses
//! of the contact are excluded, since no number of modes resolves the stress there, which the near field provides.

use frangible::Asset;
use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::internals::Preset;
use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::contact::hertz_duration;
use frangible::internals::modal::Oscillator;
use frangible::internals::stress::{Symmetric3, largest_eigenvalue, largest_eigenvalue_bound};

use crate::random;

/// Numbers that are tried; the last resort is to follow all.
const LADDER: [usize; 12] = [20, 30, 40, 60, 80, 100, 120, 160, 200, 240, 300, 350];
/// Fewest modes among which a search is worth its time; of fewer, all are followed.
const SEARCHED: usize = 60;
/// Change of the peak tension that does not matter.
const TOLERANCE: f64 = 0.03;
/// Contacts.
const CONTACTS: usize = 16;
/// Contacts that may change by more.
const SPARED: usize = 2;
/// Triangles of the sample that lie all over the surface.
const SPREAD: usize = 900;
/// Triangles of the sample that lie about each contact.
const ABOUT: usize = 40;
/// Reach of the near field that is left out, in thicknesses of the wall.
const NEAR: f32 = 2.0;
/// Time steps while the force acts.
const FORCED: usize = 16;
/// Time steps after the force.
const FREE: usize = 32;
/// All of them.
const TIMES: usize = FORCED + FREE;
/// Periods of the lowest mode that are looked at.
const PERIODS: f64 = 1.5;
/// Eigenvalues this close are those of a pair, which is followed whole or not at all.
const PAIR: f64 = 1e-2;

/// The ball: share of the mass of what it hits, radius in m, speed in m/s.
const BALL: (f64, f64, f64) = (0.1, 0.01, 5.0);
/// Share of the body's mass that a branch has.
const BRANCH: f64 = 0.1;
/// A body that fills less of its box has branches. Measured: a chandelier, a tree of coral and a candelabrum fill about 0.1 of it; a
/// statuette 0.22, a hammer's head 0.66, a rabbit 0.83. Cups, glasses and bottles fill 0.06 to 0.18, and are walls.
const BRANCHED: f64 = 0.15;
/// Share of a surface on walls from which on a body is a shell: of bodies with branches nothing is, of cups and bottles 0.8 to 1.
const SHELL: f64 = 0.3;

/// Number of modes to follow, at least one. The asset's own choice is not looked at.
pub(crate) fn followed(asset: &Asset) -> usize {
    let count = asset.modes().count();
    if count <= SEARCHED {
        return count;
    }
    let ladder: Vec<usize> = steps(&asset.modes().eigenvalues);
    let contacts = spread(asset);
    let pulse = Pulse::new(asset);
    let own = sample(asset, &contacts);
    let rows: Vec<Rows> = own
        .iter()
        .map(|&t| stress_rows(asset, asset.surface().tets[t] as usize))
        .collect();
    let peaks: Vec<Vec<f32>> = contacts
        .iter()
        .map(|&at| peaks(asset, at, &pulse, &own, &rows, &ladder))
        .collect();
    let differs = |step: usize| {
        let far = |peaks: &&Vec<f32>| {
            let all = f64::from(peaks[peaks.len() - 1]);
            (f64::from(peaks[step]) - all).abs() > TOLERANCE * all
        };
        peaks.iter().filter(far).count() > SPARED
    };
    // The first step after the last that differs.
    let last = (0..ladder.len()).rev().find(|&step| differs(step));
    ladder[last.map_or(0, |step| step + 1)]
}

/// The ladder below the number of modes, no pair torn, and the number itself.
fn steps(eigenvalues: &[f64]) -> Vec<usize> {
    let whole = |wanted: usize| {
        let pair = |n: &usize| eigenvalues[*n] > (1.0 + PAIR) * eigenvalues[*n - 1];
        (wanted..eigenvalues.len()).find(pair)
    };
    let below = LADDER.into_iter().filter(|&n| n < eigenvalues.len());
    let mut steps: Vec<usize> = below.filter_map(whole).collect();
    steps.push(eigenvalues.len());
    steps.dedup();
    steps
}

/// Surface triangles far from one another: each the farthest from those before, the first from the centre of mass.
fn spread(asset: &Asset) -> Vec<usize> {
    let centroids: Vec<Vec3> = (0..asset.surface().triangles.len())
        .map(|t| centroid(asset, t))
        .collect();
    let mut gaps: Vec<f32> = centroids.iter().map(|c| c.length_squared()).collect();
    let mut chosen = Vec::new();
    for _ in 0..CONTACTS.min(centroids.len()) {
        let farthest = (0..gaps.len()).max_by(|&a, &b| gaps[a].total_cmp(&gaps[b]).then(b.cmp(&a)));
        let Some(next) = farthest else { break };
        // Distances from the centre choose the first one only.
        let first = chosen.is_empty();
        chosen.push(next);
        for (gap, c) in gaps.iter_mut().zip(&centroids) {
            let new = c.distance_squared(centroids[next]);
            *gap = if first { new } else { gap.min(new) };
        }
    }
    chosen
}

fn centroid(asset: &Asset, triangle: usize) -> Vec3 {
    let corners = asset.surface().triangles[triangle];
    corners
        .iter()
        .map(|&v| asset.fracture().positions[v as usize])
        .sum::<Vec3>()
        / 3.0
}

/// Surface triangles behind whose faces stress is looked at: some all over, and those nearest to each contact but for the near
/// field of a wall.
fn sample(asset: &Asset, contacts: &[usize]) -> Vec<usize> {
    let count = asset.surface().triangles.len();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&t| (random::bits(1, t as u64), t));
    let mut own: Vec<usize> = order.into_iter().take(SPREAD).collect();
    let centroids: Vec<Vec3> = (0..count).map(|t| centroid(asset, t)).collect();
    for &at in contacts {
        let reach = left_out(asset, at);
        let gap = |t: usize| centroids[t].distance(centroids[at]);
        let mut near: Vec<usize> = (0..count).filter(|&t| gap(t) >= reach).collect();
        if near.len() > ABOUT {
            near.select_nth_unstable_by(ABOUT, |&a, &b| gap(a).total_cmp(&gap(b)).then(a.cmp(&b)));
            near.truncate(ABOUT);
        }
        own.extend(near);
    }
    own.sort_unstable();
    own.dedup();
    own
}

/// Distance from a contact within which the stress is the near field's, m.
fn left_out(asset: &Asset, triangle: usize) -> f32 {
    let wall = asset.surface().walls.at(triangle as u32);
    wall.map_or(0.0, |wall| NEAR * wall.thickness as f32)
}

/// Returns true if the body is made of branches: no shell, and far lighter than the box of its material with the same moments of inertia.
fn has_branches(asset: &Asset) -> bool {
    let (mass, inertia) = (&asset.mass(), asset.mass().inertia);
    let trace = inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z;
    // Second moments of the mass: a box of sides a, b, c has a²/12, b²/12, c²/12.
    let second = (DMat3::from_diagonal(DVec3::splat(0.5 * trace)) - inertia) * (1.0 / mass.mass);
    let on_box = (1728.0 * second.determinant()).max(0.0).sqrt();
    let triangles = asset.surface().triangles.len();
    let on_walls = (0..triangles as u32)
        .filter(|&t| asset.surface().walls.at(t).is_some())
        .count();
    mass.volume < BRANCHED * on_box && (on_walls as f64) < SHELL * triangles as f64
}

/// The force and the times.
struct Pulse {
    duration: f64,
    /// Time step, s.
    step: f64,
    /// Number of steps between sampled times after the contact.
    stride: usize,
}

impl Pulse {
    fn new(asset: &Asset) -> Self {
        let (share, radius, speed) = BALL;
        let struck = if has_branches(asset) { BRANCH } else { 1.0 };
        let mass = asset.mass().mass * struck * share;
        let effective = match asset.is_supported() {
            true => mass,
            false => mass / (1.0 + share),
        };
        let modulus = 1.0
            / (1.0 / asset.material().contact_modulus() + 1.0 / Preset::STEEL.contact_modulus());
        let duration = hertz_duration(effective, modulus, radius, speed);
        let step = duration / FORCED as f64;
        let lowest = match asset.modes().count() {
            0 => 0.0,
            _ => 1.0 / asset.modes().frequency(0),
        };
        let after = (PERIODS * lowest - duration).max(duration) / step;
        Self {
            duration,
            step,
            stride: ((after / FREE as f64).ceil() as usize).max(1),
        }
    }

    fn force(&self, time: usize) -> f64 {
        match time < FORCED {
            true => (std::f64::consts::PI * (time + 1) as f64 / FORCED as f64).sin(),
            false => 0.0,
        }
    }

    /// Amplitudes of a mode under a force of peak 1 N/√kg.
    fn follow(&self, eigenvalue: f64, damping: f64) -> [f64; TIMES] {
        let turn = std::f64::consts::PI / self.duration;
        let mut mode = Oscillator::new(eigenvalue, damping, turn, self.step);
        std::array::from_fn(|time| {
            let forced = time < FORCED;
            for _ in 0..if forced { 1 } else { self.stride } {
                mode.step(forced);
            }
            mode.displacement()
        })
    }
}

/// Stress of each mode at a point, Pa per m·√kg: one row of modes for each of xx, yy, zz, xy, yz, zx.
type Rows = [Vec<f32>; 6];

/// Returns the stress of each mode at the centroid of a fracture tetrahedron.
#[must_use]
pub fn stress_rows(asset: &Asset, tet: usize) -> Rows {
    let point = &asset.embedding().tets[tet];
    let element = point.element as usize;
    let gradients = point.shape_gradients(&asset.analysis().barycentric_gradients[element]);
    let count = asset.modes().count();
    let (lambda, mu) = (
        asset.material().lame_lambda() as f32,
        asset.material().shear_modulus() as f32,
    );
    let mut rows: Rows = std::array::from_fn(|_| vec![0.0; count]);
    for (&node, g) in asset.analysis().elements[element].iter().zip(gradients) {
        let [x, y, z] = asset.modes().rows(node as usize);
        for i in 0..count {
            let u = Vec3::new(x[i], y[i], z[i]);
            let volume = lambda * u.dot(g);
            for axis in 0..3 {
                rows[axis][i] += volume + 2.0 * mu * u[axis] * g[axis];
                let next = (axis + 1) % 3;
                rows[3 + axis][i] += mu * (u[axis] * g[next] + u[next] * g[axis]);
            }
        }
    }
    rows
}

/// ξ of every mode for a force inwards on a triangle, 1/√kg.
fn load(asset: &Asset, triangle: usize) -> Vec<f64> {
    let inwards = -asset.surface().normals[triangle]
        .iter()
        .sum::<Vec3>()
        .normalize_or_zero();
    let mut load = vec![0.0; asset.modes().count()];
    for v in asset.surface().triangles[triangle] {
        let point: &EmbeddedPoint = &asset.embedding().nodes[v as usize];
        let nodes = &asset.analysis().elements[point.element as usize];
        for (&node, weight) in nodes.iter().zip(point.shape_values()) {
            let push = (inwards * weight).to_array().map(|p| f64::from(p) / 3.0);
            asset.modes().add_push(node as usize, push, &mut load);
        }
    }
    load
}

type Times = [f32; TIMES];

/// Largest principal tension of a contact, Pa per N, for each step of the ladder.
fn peaks(
    asset: &Asset,
    at: usize,
    pulse: &Pulse,
    own: &[usize],
    rows: &[Rows],
    ladder: &[usize],
) -> Vec<f32> {
    let load = load(asset, at);
    let modes = asset.modes();
    let moved: Vec<Times> = (0..modes.count())
        .map(|i| {
            let damping = modes.damping(i, asset.material());
            let unit = pulse.follow(modes.eigenvalues[i], damping);
            unit.map(|q| (load[i] * q) as f32)
        })
        .collect();
    let still: Vec<f32> = load
        .iter()
        .zip(&modes.eigenvalues)
        .map(|(xi, lambda)| (xi / lambda) as f32)
        .collect();
    let force: Times = std::array::from_fn(|time| pulse.force(time) as f32);
    let (centre, reach) = (centroid(asset, at), left_out(asset, at));
    let mut peaks = vec![0.0_f32; ladder.len()];
    for (&t, rows) in own.iter().zip(rows) {
        if centroid(asset, t).distance(centre) < reach {
            continue;
        }
        let mut stress = [[0.0_f32; TIMES]; 6];
        // The share of the modes that are not followed, each from the step on to the last.
        let mut rest: [f32; 6] =
            std::array::from_fn(|c| rows[c].iter().zip(&still).map(|(s, q)| s * q).sum());
        let mut first = 0;
        for (peak, &count) in peaks.iter_mut().zip(ladder) {
            for (c, row) in rows.iter().enumerate() {
                for i in first..count {
                    let s = row[i];
                    for (sum, q) in stress[c].iter_mut().zip(&moved[i]) {
                        *sum += s * q;
                    }
                    rest[c] -= s * still[i];
                }
            }
            first = count;
            for time in 0..TIMES {
                let [xx, yy, zz, xy, yz, zx] =
                    std::array::from_fn(|c| stress[c][time] + rest[c] * force[time]);
                let stress = Symmetric3 {
                    diagonal: [xx, yy, zz],
                    off: [xy, yz, zx],
                };
                if largest_eigenvalue_bound(&stress) > *peak {
                    *peak = peak.max(largest_eigenvalue(&stress));
                }
            }
        }
    }
    peaks
}
