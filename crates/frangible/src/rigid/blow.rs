//! The impulse of a blow on the fragments that it leaves, and the energy of the cracks.

use glam::{DMat3, DVec3, Vec3};

use super::{Kick, Pushes, Rigid};
use crate::mesh::{TriMesh, closest_on_triangle};
use crate::outcome::Fracture;

/// Lets a kick act on bodies as on one, which is `whole`.
pub fn kick_together(bodies: &mut [Rigid], whole: &mut Rigid, kick: Kick) {
    let (linear, angular) = whole.answer(kick);
    for body in bodies.iter_mut().filter(|b| b.gives_way()) {
        body.linear += linear + angular.cross(body.centre - whole.centre);
        body.angular += angular;
    }
    whole.linear += linear;
    whole.angular += angular;
}

/// The largest share s of a kick, 0..=1, that adds at most `allowed` J: s · work + ½ s² · give.
#[must_use]
pub fn affordable(work: f64, give: f64, allowed: f64) -> f64 {
    if work + 0.5 * give <= allowed {
        return 1.0;
    }
    // Exact in both limits, no difference of large numbers where work is negative.
    let root = (work * work + 2.0 * give * allowed).max(0.0).sqrt();
    let share = if work > 0.0 {
        2.0 * allowed / (work + root)
    } else {
        (root - work) / give
    };
    if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Puts a blow's impulses on the pieces, which come in the order of their distance from it, and takes them from the striker: itself, the
/// pieces that it has become, or none where it does not give way. `taken` is what the striker gets, about its own centre. Where some
/// pieces are held, those take what would make the loose ones leave faster than the striker follows. Returns the energy that the motion
/// loses, J.
pub fn push_plug(pieces: &mut [Rigid], striker: &mut [Rigid], pushes: &Pushes, taken: Kick) -> f64 {
    let mut follower = Rigid::together(striker);
    let held = pieces.iter().any(|p| !p.gives_way());
    let holds = pieces.first().is_none_or(|p| !p.gives_way());
    let loose: Vec<usize> = (0..pieces.len())
        .filter(|&i| pieces[i].gives_way())
        .collect();
    let (mut left, mut lost) = (1.0, 0.0);
    let bodies: Vec<Rigid> = loose.iter().map(|&i| pieces[i]).collect();
    if !holds && let Some(mut plug) = Plug::new(&bodies, &follower, pushes, taken) {
        let (work, give) = (plug.work, plug.give);
        let share = if held && work < 0.0 && give > 0.0 {
            (-work / give).min(1.0)
        } else if work < 0.0 {
            affordable(work, give, 0.0)
        } else {
            0.0
        };
        kick_together(&mut plug.members, &mut plug.whole, plug.kick.scaled(share));
        kick_together(striker, &mut follower, taken.scaled(share));
        for (&i, member) in loose.iter().zip(plug.members) {
            pieces[i] = member;
        }
        lost -= share * work + 0.5 * share * share * give;
        left -= share;
    }
    if (held || holds) && left > 0.0 {
        let kick = taken.scaled(left);
        let (work, give) = (follower.work(kick), follower.give(kick));
        if work < 0.0 {
            let share = affordable(work, give, 0.0);
            kick_together(striker, &mut follower, kick.scaled(share));
            lost -= share * work + 0.5 * share * share * give;
        }
    }
    debug_assert!(lost >= -1e-9, "a blow that breaks gave {} J", -lost);
    lost
}

/// Puts a blow's impulses on pieces that [move apart](part) by what the blow has made of them: on all of them as on one body, or where
/// some are held on what holds them. `taken` is what the striker gets. Returns the energy that the motion loses, J.
pub fn push_whole(
    pieces: &mut [Rigid],
    striker: &mut [Rigid],
    pushes: &Pushes,
    taken: Kick,
) -> f64 {
    let held = pieces.iter().any(|p| !p.gives_way());
    let mut whole = match held {
        true => Rigid::earth(),
        false => Rigid::together(pieces),
    };
    let mut follower = Rigid::together(striker);
    let kick = Kick::about(whole.centre, pushes);
    let work = whole.work(kick) + follower.work(taken);
    let give = whole.give(kick) + follower.give(taken);
    let share = match work < 0.0 {
        true => affordable(work, give, 0.0),
        false => 0.0,
    };
    if !held {
        kick_together(pieces, &mut whole, kick.scaled(share));
    }
    kick_together(striker, &mut follower, taken.scaled(share));
    -share * work - 0.5 * share * share * give
}

/// Puts a blow's impulses on the fragments of a body that it broke, and takes them from the striker. `pieces` are the fragments in this order,
/// [from the nearest](nearest_first); `axes` turns the body's frame to the world's. Returns the energy that the motion loses, J, from which the
/// cracks are to be paid first.
pub fn take_blow(
    fracture: &Fracture,
    (order, axes): (&[usize], DMat3),
    pieces: &mut [Rigid],
    striker: &mut [Rigid],
    pushes: &Pushes,
    taken: Kick,
) -> f64 {
    if !fracture.moves_apart() || is_local(pieces, striker, pushes, taken) {
        return push_plug(pieces, striker, pushes, taken);
    }
    let lost = push_whole(pieces, striker, pushes, taken);
    let own = |&number: &usize| {
        let fragment = &fracture.fragments[number];
        [fragment.velocity, fragment.angular_velocity].map(|v| axes * v)
    };
    let motions: Vec<[DVec3; 2]> = order.iter().map(own).collect();
    lost - part(pieces, &motions, lost - fracture.report.fracture_energy)
}

/// Returns true if a blow ends before it affects all pieces, which are sorted by their distance from it: its [plug](push_plug) is less than half
/// of the free mass. Its energy is then mainly in short waves, with little in the motion of large pieces.
#[must_use]
pub fn is_local(pieces: &[Rigid], striker: &[Rigid], pushes: &Pushes, taken: Kick) -> bool {
    let loose: Vec<Rigid> = pieces.iter().filter(|p| p.gives_way()).copied().collect();
    let mass: f64 = loose.iter().map(|p| p.mass).sum();
    let plug = Plug::new(&loose, &Rigid::together(striker), pushes, taken);
    plug.is_some_and(|plug| plug.whole.mass < 0.5 * mass)
}

/// The fewest pieces that do not leave faster than the striker follows.
struct Plug {
    members: Vec<Rigid>,
    whole: Rigid,
    kick: Kick,
    /// A share s of the blow adds s · work + ½ s² · give to the energy, J.
    work: f64,
    give: f64,
}

impl Plug {
    /// None where nothing is loose.
    fn new(loose: &[Rigid], follower: &Rigid, pushes: &Pushes, taken: Kick) -> Option<Self> {
        let mut count = 1.min(loose.len());
        while count > 0 {
            let members = loose[..count].to_vec();
            let whole = Rigid::together(&members);
            let kick = Kick::about(whole.centre, pushes);
            let work = whole.work(kick) + follower.work(taken);
            let give = whole.give(kick) + follower.give(taken);
            if work + give > 0.0 && count < loose.len() {
                count = (count + 1 + count / 8).min(loose.len());
                continue;
            }
            return Some(Self {
                members,
                whole,
                kick,
                work,
                give,
            });
        }
        None
    }
}

/// Lets pieces that move as one body move apart: each gets what its fragment has beyond the whole body's motion, [velocity and angular
/// velocity](crate::Fragment::velocity) in world axes, as much of it as takes no more than this energy, J. Returns what it takes. Momentum stays.
pub fn part(pieces: &mut [Rigid], motions: &[[DVec3; 2]], most: f64) -> f64 {
    let each = || pieces.iter().zip(motions).filter(|(p, _)| p.gives_way());
    let energy = |(piece, [linear, angular]): (&Rigid, &[DVec3; 2])| {
        0.5 * (piece.mass * linear.length_squared() + angular.dot(piece.inertia * *angular))
    };
    // They carry no momentum, so that nothing of the common motion comes in.
    let wanted: f64 = each().map(energy).sum();
    if !(wanted > 0.0 && wanted.is_finite() && most > 0.0) {
        return 0.0;
    }
    let scale = (most / wanted).min(1.0).sqrt();
    for (piece, [linear, angular]) in pieces.iter_mut().zip(motions) {
        if piece.gives_way() {
            piece.linear += *linear * scale;
            piece.angular += *angular * scale;
        }
    }
    wanted.min(most)
}

/// Takes up to `energy`, J, from the motion of bodies against each other; returns what was taken.
pub fn take_energy(bodies: &mut [Rigid], energy: f64) -> f64 {
    if energy.is_nan() || energy <= 0.0 {
        return 0.0;
    }
    let fixed = bodies.iter().find(|b| !b.gives_way()).copied();
    let common = fixed.unwrap_or_else(|| Rigid::together(bodies));
    let apart = |b: &Rigid| b.deviation(common.velocity_at(b.centre), common.angular);
    let available: f64 = bodies.iter().map(apart).sum();
    if !(available.is_finite() && available > 0.0) {
        return 0.0;
    }
    let scale = (1.0 - energy / available).max(0.0).sqrt();
    for b in bodies.iter_mut().filter(|b| b.gives_way()) {
        let at = common.velocity_at(b.centre);
        b.linear = at + (b.linear - at) * scale;
        b.angular = common.angular + (b.angular - common.angular) * scale;
    }
    energy.min(available)
}

/// The numbers of the fragments, from the nearest to these points, m, body frame; of several as near, in their own order.
#[must_use]
pub fn nearest_first(fracture: &Fracture, points: &[Vec3]) -> Vec<usize> {
    let gap = |mesh: &TriMesh, centre: Vec3| {
        let gaps = points.iter().map(|&p| square_distance(mesh, p - centre));
        gaps.fold(f64::INFINITY, f64::min)
    };
    let fragments = fracture.fragments.iter().enumerate();
    let mut order: Vec<(f64, usize)> = fragments
        .map(|(i, f)| (gap(&f.mesh, f.mass.centre.as_vec3()), i))
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.into_iter().map(|(_, i)| i).collect()
}

/// Squared distance from a point to the surface, m².
fn square_distance(mesh: &TriMesh, point: Vec3) -> f64 {
    let point = point.as_dvec3();
    let of = |triangle: &[u32; 3]| {
        let corners = triangle.map(|v| mesh.positions[v as usize].as_dvec3());
        let weights = closest_on_triangle(corners, point);
        let closest: DVec3 = corners.iter().zip(weights).map(|(c, w)| *c * w).sum();
        closest.distance_squared(point)
    };
    mesh.triangles.iter().map(of).fold(f64::INFINITY, f64::min)
}
