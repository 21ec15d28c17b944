//! Cracks fork (beyond the paper).
//!
//! A crack that has run a distance r under a tension σ across it splits in two when σ √r reaches a constant of the material. The rule is
//! measured: in glass σ √r is the same whatever the strength, and the radius at which the surface turns rough, where the crack is about
//! to split, is 13 times the depth of the flaw from which the crack came (J. J. Mecholsky, R. W. Rice, S. W. Freiman, J. Am. Ceram. Soc. 57
//! (1974) 440, read in its abstract). A flaw of depth a, half a penny at the surface, breaks at 1.24 σ √a = K_Ic; so the constant is
//! √13 / 1.24 = 2.9 times K_Ic.
//!
//! The distance counts from where the crack started or split last. σ is what other cracks have left of the tension; the crack itself
//! takes nothing of what lies straight ahead of it. The crack runs on as it did, and a new one leaves it at Yoffe's angle, on the
//! side with more tension: ahead of a fast crack the largest tension lies 60° off its path (E. H. Yoffe, Phil. Mag. 42 (1951) 739).
//! The new crack starts one edge of the mesh away, on a plane through the place of the fork, and grows both ways: back it ends where
//! it meets the old one. A fork nearer than one edge is finer than the mesh, and is left out.

use glam::Vec3;

use super::field::{Felt, StressField};
use super::propagation::gradient;
use super::release::once;
use super::single::{Crack, ElementCut, Front};
use super::surface::CrackFrame;
use super::system::{CrackSystem, UNCUT};
use crate::config::{CrackPath, CrackTiming};
use crate::material::Material;
use crate::state::{crossing_area, crossing_polygon};
use crate::stress::Symmetric3;

/// Branching constant σ √r over K_Ic: √13 / 1.24.
const BRANCHING: f64 = 2.908;

/// Angle between the two cracks (Yoffe 1951).
const ANGLE: f32 = std::f32::consts::FRAC_PI_3;

/// A crack does not fork nearer than this to where it started or forked, and the new one starts so far from the old, in mean edges.
pub(super) const APART: f32 = 1.0;

/// A crack that took this many times as long as it needs at its speed has waited for energy: it is slow, and does not fork.
const SLOWEST: f64 = 2.0;

/// A place where a crack leaves another one.
pub(super) struct Fork {
    pub(super) place: Vec3,
    /// Tetrahedron where the new crack starts.
    pub(super) start: u32,
    /// The new crack's normal.
    pub(super) normal: Vec3,
}

/// Where the crack forks that is about to cut a tetrahedron, if it does.
pub(super) fn forks(
    system: &CrackSystem,
    front: &Front,
    cut: &ElementCut,
    felt: &Felt,
) -> Option<Fork> {
    let config = system.config;
    let CrackTiming::TimeResolved { speed } = config.timing else {
        return None;
    };
    if !config.branching || config.path == CrackPath::Planar {
        return None;
    }
    let mesh = &system.asset.fracture;
    let n = cut.tet as usize;
    let crack = &system.cracks[front.crack as usize];
    let (polygon, corners) = crossing_polygon(&mesh.corners(n), &cut.values);
    let place = polygon[..corners].iter().sum::<Vec3>() / corners.max(1) as f32;
    let (run, since) = latest(crack, place);
    let material = &system.asset.material;
    let free = f64::from(run) / (speed * material.rayleigh_speed());
    if run < APART * system.edge || cut.time - since > SLOWEST * free {
        return None;
    }
    let enough = constant(system.resistance.toughness.of(cut.tet), material);
    let wall = felt.wall.as_ref().map(|(wall, _)| wall);
    let thickness = wall.map(|wall| wall.distances(system.centroids[n]).iter().sum());
    let tension = |stress: &Symmetric3, n: Vec3| f64::from(n.dot(stress.times(n)));
    let (stress, opposite) = felt.on_face(cut.opens);
    let before = tension(&stress, cut.direction);
    let through = felt.opening(cut.direction, material.poisson_ratio) / before;
    let forks = |tension: f64| feed(tension, through, run, thickness) >= enough;
    // No release raises the tension: most fronts end here.
    if before <= 0.0 || !forks(before) {
        return None;
    }
    let left = once(system, front, stress, opposite, cut.time);
    if !forks(tension(&left, cut.direction)) {
        return None;
    }
    let from = system.centroids[crack.elements[front.from as usize].tet as usize];
    let ahead = system.centroids[n] - from;
    let axis = match wall {
        Some(wall) => wall.normal,
        None => ahead.cross(cut.direction).try_normalize()?,
    };
    let along = cut.direction.cross(axis).try_normalize()?;
    let along = along * ahead.dot(along).signum();
    let angles = [ANGLE, -ANGLE];
    let [first, second] = angles.map(|angle| tension(&left, turned(cut.direction, axis, angle)));
    let angle = angles[usize::from(second > first)];
    let goal = place + turned(along, axis, angle) * (APART * system.edge);
    let start = nearest(system, cut.tet, goal)?;
    Some(Fork {
        place,
        start,
        normal: turned(cut.direction, axis, angle),
    })
}

/// A vector turned about a unit axis by an angle, rad.
fn turned(v: Vec3, axis: Vec3, angle: f32) -> Vec3 {
    let (sin, cos) = libm::sincosf(angle);
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}

/// How far a place lies from where its crack started or forked last, m, and when that was, s.
pub(super) fn latest(crack: &Crack, place: Vec3) -> (f32, f64) {
    let start = (crack.frame.origin, crack.elements[0].time);
    let distances = std::iter::once(&start).chain(&crack.forks);
    let nearest = distances.map(|&(from, time)| (from.distance(place), time));
    nearest.fold((f32::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a })
}

/// The branching constant where the fracture energy is this, J/m²: Pa √m.
fn constant(fracture_energy: f64, material: &Material) -> f64 {
    BRANCHING * (fracture_energy * material.contact_modulus()).sqrt()
}

/// What σ √r is of a crack that has run so far, m, under a tension at the surface, Pa. In a wall of a thickness, m, the crack goes through it once it
/// is longer than that; then a part of the tension counts, which is `through` of it (`tips.rs`).
fn feed(tension: f64, through: f64, run: f32, thickness: Option<f32>) -> f64 {
    let run = f64::from(run);
    match thickness.map(f64::from) {
        Some(thickness) if thickness < run => tension * thickness.sqrt().max(through * run.sqrt()),
        _ => tension * run.sqrt(),
    }
}

/// The uncut tetrahedron about a place that is reached from another one by always coming nearer.
pub(super) fn nearest(system: &CrackSystem, from: u32, goal: Vec3) -> Option<u32> {
    let distance = |tet: u32| system.centroids[tet as usize].distance_squared(goal);
    let mut tet = from;
    loop {
        let neighbours = system.asset.fracture.neighbours[tet as usize];
        let known = neighbours
            .into_iter()
            .filter(|&m| m != crate::mesh::NO_NEIGHBOUR);
        let next = known.min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)))?;
        if distance(next) >= distance(tet) {
            break;
        }
        tet = next;
    }
    (tet != from && system.fractured_by[tet as usize] == UNCUT).then_some(tet)
}

/// Starts the crack that leaves another one at a place which that one reached with `cut`, if it can be paid.
pub(super) fn start(
    system: &mut CrackSystem,
    field: &mut StressField,
    parent: u32,
    cut: &ElementCut,
    fork: &Fork,
) -> bool {
    let CrackTiming::TimeResolved { speed } = system.config.timing else {
        return false;
    };
    let material = &system.asset.material;
    let (e, mesh) = (fork.start, &system.asset.fracture);
    if system.is_over(e, cut.time) {
        return false;
    }
    let frame = CrackFrame::new(
        fork.place,
        fork.normal,
        material.roughness_amplitude,
        material.roughness_wavelength,
        system.seed,
        e,
    );
    let x = mesh.corners(e as usize);
    let values = x.map(|p| frame.planar(p));
    let area = crossing_area(&x, &values);
    let gain = material.energy_depth * f64::from(field.at(e as usize).state.energy_density);
    if area <= 0.0
        || gain <= system.resistance.toughness.of(e)
        || !system.ledger.has(system.cost(e, area))
    {
        return false;
    }
    system.cracks[parent as usize]
        .forks
        .push((fork.place, cut.time));
    let id = system.cracks.len() as u32;
    system.add(frame, e);
    let distance = fork.place.distance(system.centroids[e as usize]);
    let new = ElementCut {
        tet: e,
        values,
        direction: gradient(&x, &values).unwrap_or(fork.normal),
        opens: cut.opens,
        time: cut.time + f64::from(distance) / (speed * material.rayleigh_speed()),
    };
    system.fracture(id, new, area, f64::from(area) * gain);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crack_forks_thirteen_times_the_depth_of_its_flaw_away_from_it() {
        let glass = Material::preset("glass").unwrap();
        let toughness = (glass.fracture_energy * glass.contact_modulus()).sqrt();
        for depth in [2e-5, 1e-4, 5e-4] {
            let breaks_at = toughness / (1.24 * f64::sqrt(depth));
            let forks = |run: f64| {
                feed(breaks_at, 0.0, run as f32, None) >= constant(glass.fracture_energy, &glass)
            };
            assert!(!forks(12.9 * depth) && forks(13.1 * depth), "{depth}");
        }
    }

    #[test]
    fn in_a_wall_bending_feeds_no_more_than_a_crack_through_it_takes() {
        let (tension, thickness) = (1e8, 4e-3);
        let feed = |run| feed(tension, 0.36, run, Some(thickness));
        assert_eq!(feed(2e-3), tension * f64::from(2e-3_f32).sqrt());
        // Longer than the wall is thick: that of the thickness at first, then that of a crack through the wall.
        assert_eq!(feed(5e-3), feed(2e-2));
        let long = 0.36 * tension * f64::from(0.1_f32).sqrt();
        assert!((feed(0.1) - long).abs() < 1e-9 * long);
    }
}
