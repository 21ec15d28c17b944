//! Cracks fork (beyond the paper).
//!
//! A crack that has run a distance r under a tension σ across it splits in two when σ √r reaches a constant of the material
//! ([`Material::branching_constant`]). The rule is measured, on glass: the materials' presets say where.
//!
//! The distance counts from where the crack started or split last. σ is what other cracks have left of the tension; the crack itself
//! takes nothing of what lies straight ahead of it. In a wall a crack is half a penny on one face until it is as deep as the wall is thick; after
//! that it may go through the wall (`Run::intensity`). The crack runs on as it did, and a new one leaves it at Yoffe's angle, on the
//! side with more tension: ahead of a fast crack the largest tension lies 60° off its path (E. H. Yoffe, Phil. Mag. 42 (1951) 739).
//! The new crack starts one edge of the mesh away, on a plane through the place of the fork, and grows both ways: back it ends where
//! it meets the old one. A fork nearer than one edge is finer than the mesh, and is left out.

use glam::Vec3;

use super::arrival::{Entered, Source};
use super::felt::Felt;
use super::field::StressField;
use super::release::once;
use super::single::{Crack, ElementCut, Front};
use super::surface::CrackFrame;
use super::system::{CrackSystem, UNCUT};
use crate::material::Material;
use crate::state::crossing_middle;
use crate::stress::Symmetric3;

/// Angle between the two cracks (Yoffe 1951).
const ANGLE: f32 = std::f32::consts::FRAC_PI_3;

/// A crack does not fork nearer than this to where it started or forked, and the new one starts so far from the old, in mean edges.
pub(super) const APART: f32 = 1.0;

/// A crack that took this many times as long as it needs at its speed has waited for energy: it is slow, and does not fork.
pub(super) const SLOWEST: f64 = 2.0;

/// A place where a crack leaves another one.
pub(super) struct Fork {
    pub(super) place: Vec3,
    /// Tetrahedron where the new crack starts.
    pub(super) start: u32,
    /// The new crack's normal.
    pub(super) normal: Vec3,
}

/// Returns the fork of a crack that is about to cut a tetrahedron, if it forks there.
pub(super) fn forks(
    system: &CrackSystem,
    front: &Front,
    cut: &ElementCut,
    felt: &Felt,
) -> Option<Fork> {
    let speed = system.config.crack_speed()?;
    let mesh = &system.asset.fracture;
    let n = cut.tet as usize;
    let crack = &system.cracks[front.crack as usize];
    let place = crossing_middle(&mesh.corners(n), &cut.values);
    let (run, since) = nearest_start(crack, place);
    let material = &system.asset.material;
    let free = f64::from(run) / (speed * material.rayleigh_speed());
    if run < APART * system.edge || cut.time - since > SLOWEST * free {
        return None;
    }
    let enough = constant(system.resistance.toughness.of(cut.tet), material);
    let wall = felt.wall.as_ref().map(|(wall, _)| wall);
    let (stress, opposite) = felt.on_face(cut.opens);
    let before = tension(&stress, cut.direction);
    if before <= 0.0 {
        return None;
    }
    let (run, _) = Run::of(felt, cut, f64::from(run), material.poisson_ratio);
    let forks = |tension: f64| run.intensity(tension) >= enough;
    // No release raises the tension: most fronts end here.
    if !forks(before) {
        return None;
    }
    let enough = |left: &Symmetric3| forks(tension(left, cut.direction));
    let left = once(
        system,
        (front.crack, place),
        stress,
        opposite,
        cut.time,
        enough,
    )?;
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

/// Distance of a place from the nearest point where its crack started or forked, m, and the time of that, s.
pub(super) fn nearest_start(crack: &Crack, place: Vec3) -> (f32, f64) {
    let start = (crack.frame.origin, crack.elements[0].time);
    let distances = std::iter::once(&start).chain(&crack.forks);
    let nearest = distances.map(|&(from, time)| (from.distance(place), time));
    nearest.fold((f32::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a })
}

/// The branching constant where the fracture energy is this, J/m²: Pa √m.
fn constant(fracture_energy: f64, material: &Material) -> f64 {
    material.branching_constant * (fracture_energy * material.contact_modulus()).sqrt()
}

/// Tension across a plane of this unit normal, Pa.
fn tension(stress: &Symmetric3, normal: Vec3) -> f64 {
    f64::from(normal.dot(stress.times(normal)))
}

/// Run of a crack: its length, and the wall that it runs in.
pub(super) struct Run {
    /// Distance from where the crack started or forked last, m.
    length: f64,
    /// The wall that it runs in; none in a solid.
    wall: Option<BentWall>,
}

/// A bent wall, as a crack feels it.
struct BentWall {
    /// Distance between the faces, m.
    thickness: f64,
    /// Share of the tension at the face that comes from bending, 0 to 1.
    bending: f64,
    /// Tension that opens a crack through the whole wall as much, over that at the face.
    through: f64,
}

impl Run {
    /// The run of a crack that cuts a tetrahedron so far from its start, m, and the tension across it there, Pa.
    pub(super) fn of(
        felt: &Felt,
        cut: &ElementCut,
        length: f64,
        poisson_ratio: f64,
    ) -> (Self, f64) {
        let (stress, opposite) = felt.on_face(cut.opens);
        let before = tension(&stress, cut.direction);
        let wall = felt.wall.as_ref().map(|(wall, _)| wall);
        let wall = wall.zip(opposite).map(|(wall, opposite)| BentWall {
            thickness: f64::from(wall.thickness()),
            bending: (0.5 - 0.5 * tension(&opposite, cut.direction) / before).clamp(0.0, 1.0),
            through: felt.opening(cut.direction, poisson_ratio) / before,
        });
        (Self { length, wall }, before)
    }

    /// Stress intensity at the face under a tension σ there, Pa, over that of half a penny of unit radius under unit tension in a solid: Pa √m.
    ///
    /// In a solid it is σ √r after a run r. In a wall the half penny feels the face behind it, and the tension of bending falls with the depth
    /// (J. C. Newman, I. S. Raju, Engng Fracture Mech. 15 (1981) 185, for equal half axes). A crack that is longer than the wall is
    /// thick may go through it, and then feels the part of σ that opens it along its whole front; the larger of the two counts.
    pub(super) fn intensity(&self, tension: f64) -> f64 {
        let Some(wall) = &self.wall else {
            return tension * self.length.sqrt();
        };
        let depth = self.length.min(wall.thickness);
        let deep = depth / wall.thickness;
        let penny = |deep: f64| {
            let squared = deep * deep;
            (1.04 + 0.2017 * squared - 0.1061 * squared * squared) * (1.1 + 0.35 * squared)
        };
        // What bending loses at the face: 0.34 + 0.11 where the half axes are equal.
        let falls = 1.0 - 0.45 * deep * wall.bending;
        let at_face = penny(deep) / penny(0.0) * falls * depth.sqrt();
        if self.length <= wall.thickness {
            return tension * at_face;
        }
        // Half a penny of unit radius under unit tension has √(π / 2.464) times its own factor.
        let through = wall.through * (2.464 * self.length).sqrt() / penny(0.0);
        tension * at_face.max(through)
    }
}

/// Uncut tetrahedron about a place, found from another one by always coming nearer.
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

/// Starts a crack that branches off another one, which reached the fork with `cut`, if it can be paid. Returns true if it starts.
pub(super) fn start(
    system: &mut CrackSystem,
    field: &mut StressField,
    parent: u32,
    cut: &ElementCut,
    fork: &Fork,
) -> bool {
    let Some(speed) = system.config.crack_speed() else {
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
    let area = system.area(&x, &values, fork.normal);
    let felt = field.at(e as usize, crossing_middle(&x, &values));
    // It grows from the crack that it leaves, and is fed as that one is.
    let flaw = system.depth(&system.cracks[parent as usize], e, felt.wall.is_some());
    let gain = flaw * felt.energy_across(fork.normal, material.contact_modulus());
    if area <= 0.0
        || gain <= system.resistance.toughness.of(e)
        || !system.ledger.has(system.cost(e, area))
    {
        return false;
    }
    let at_surface = system.cracks[parent as usize].at_surface;
    system.cracks[parent as usize]
        .forks
        .push((fork.place, cut.time));
    let id = system.cracks.len() as u32;
    system.add(frame, e);
    (
        system.cracks[id as usize].flaw,
        system.cracks[id as usize].at_surface,
    ) = (flaw, at_surface);
    let distance = fork.place.distance(system.centroids[e as usize]);
    let new = ElementCut {
        tet: e,
        values,
        direction: fork.normal,
        opens: cut.opens,
        mirror: f32::INFINITY,
        time: cut.time + f64::from(distance) / (speed * material.rayleigh_speed()),
    };
    let from = Source {
        place: fork.place,
        since: cut.time,
    };
    let entered = Entered::at_start(from);
    system.fracture(id, new, &entered, area, f64::from(area) * gain);
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
            let forks = |length: f64| {
                let run = Run { length, wall: None };
                run.intensity(breaks_at) >= constant(glass.fracture_energy, &glass)
            };
            assert!(!forks(12.9 * depth) && forks(13.1 * depth), "{depth}");
        }
    }

    /// Intensity over that of half a penny in a solid: in a wall of 4 mm, after a run, m.
    fn beside_a_solid(length: f64, bending: f64, through: f64) -> f64 {
        let thickness = 4e-3;
        let wall = BentWall {
            thickness,
            bending,
            through,
        };
        let run = |wall| Run { length, wall };
        run(Some(wall)).intensity(1e8) / run(None).intensity(1e8)
    }

    #[test]
    fn in_a_wall_a_short_crack_is_half_a_penny_and_a_long_one_goes_through() {
        assert!((beside_a_solid(1e-6, 1.0, 0.36) - 1.0).abs() < 1e-3);
        // Half a penny that touches the face behind, by Newman and Raju's formula: 1.8593 √h where a short one has 1.2918 √h, times 0.55 if bent.
        let touches = [0.0, 1.0].map(|bending| beside_a_solid(4e-3, bending, 1.0));
        assert!((touches[0] - 1.4393).abs() < 1e-3 && (touches[1] - 0.7916).abs() < 1e-3);
        // A straight crack through the wall: √π over 1.2918.
        for through in [1.0, 0.36] {
            let long = beside_a_solid(0.4, 1.0, through);
            assert!((long - 1.3721 * through).abs() < 1e-3);
        }
    }

    #[test]
    fn a_crack_that_has_cut_through_a_stretched_wall_is_fed_nearly_as_before() {
        // The two formulas meet where the crack becomes one through the wall.
        let [before, after] = [3.99e-3, 6e-3].map(|length| beside_a_solid(length, 0.0, 1.0));
        assert!((after / before - 1.0).abs() < 0.06);
        // Bending no longer feeds it more until it is some two and a half thicknesses long.
        let [before, after] = [4e-3_f64, 8e-3].map(|l| l.sqrt() * beside_a_solid(l, 1.0, 0.36));
        assert!((before - after).abs() < 1e-9);
    }
}
