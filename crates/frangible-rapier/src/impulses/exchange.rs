//! The blow's impulses take the place of the engine's.
//!
//! The engine gives each meeting of two bodies the impulse (1 + e) v / K of two rigid ones. What a body that vibrates takes is
//! known only from the integrated blow ([`frangible::internals::blow`]), whose impulses are outcomes. Impulses are put on both bodies, equal
//! and opposite and on one line, so that momentum is exact.
//!
//! **A blow that holds**: after the step, the difference between the two normal impulses, at the arms that the engine
//! had. No share of it that would bring the bodies nearer again, or give them more energy than the engine took at these
//! contacts, or more than they had before the step. What the engine gained, of two bodies that touched nothing else, is taken
//! back first.
//!
//! **A break**: before the step is taken again, the blow's impulse up to the moment when the contact parted, or the wall under it was
//! gone. The pieces nearest to the contacts take it as one body, a plug: the fewest that do not leave faster than the striker
//! follows, all of them where even they do. So the striker pushes a plug as heavy as the blow made it, not a single splinter
//! with all the momentum of a wall, and what still approaches is the engine's. What the two lose by it went into vibration, and
//! the cracks are paid from it first.

use std::collections::BTreeMap;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::mesh::closest_on_triangle;
use frangible::{Fracture, TriMesh};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet};

use crate::calm::motions::Before;
use crate::impulses::blows::{Meeting, Touch, share_out};
use crate::impulses::cluster::{Cluster, Kick, affordable};
use crate::impulses::motion::{centre, kinetic_energy};
use crate::impulses::settle::Broken;
use crate::impulses::toll::take_energy;
use crate::world::{BreakableWorld, Key, key};

/// Pieces of bodies that broke in a step.
pub(crate) type Families = BTreeMap<Key, Vec<RigidBodyHandle>>;

/// Impulses at points, world axes, N·s and m.
type Pushes = Vec<(DVec3, DVec3)>;

impl BreakableWorld {
    /// The engine's impulses of blows that held give way to what the blows were; `before` holds the bodies as they were before
    /// the step just taken.
    pub(crate) fn give_blows(&mut self, mut meetings: Vec<Meeting>, before: &impl Before) {
        share_out(&mut meetings.iter_mut().collect::<Vec<_>>());
        for meeting in &meetings {
            self.give_blow(meeting, before);
        }
    }

    fn give_blow(&mut self, meeting: &Meeting, before: &impl Before) {
        self.take_gain(meeting, before);
        let bodies = &mut self.physics.bodies;
        let Some(mut pair) = Pair::now(bodies, meeting, before) else {
            return;
        };
        let change = |t: &Touch| t.normal * (meeting.share * (t.blow - t.engine));
        let kicks = pair.kicks(meeting, change);
        let (work, give) = pair.price(kicks);
        let allowed = pair.lost(bodies, meeting, before);
        let mut share = affordable(work, give, allowed);
        for touch in &meeting.touches {
            let leaves = pair.departure(touch);
            let gains = pair.gain(touch, kicks);
            if gains < 0.0 && leaves + share * gains < leaves.min(0.0) {
                share = (leaves.max(0.0) / -gains).min(share);
            }
        }
        let now = pair.energy(bodies);
        pair.kick(bodies, kicks, share);
        debug_assert!(
            pair.energy(bodies) <= (now + allowed) * (1.0 + 1e-5) + 1e-9,
            "a blow that holds gave energy"
        );
    }

    /// Rapier's restitution at several contacts at once can gain energy: of two bodies that met nothing else in the step it is
    /// taken back.
    fn take_gain(&mut self, meeting: &Meeting, before: &impl Before) {
        let pair: Vec<RigidBodyHandle> = [Some(meeting.body), meeting.partner]
            .into_iter()
            .flatten()
            .collect();
        if !self.are_alone(&pair) {
            return;
        }
        let gravity = self.physics.gravity.as_dvec3();
        let bodies = &mut self.physics.bodies;
        let mut gain = 0.0;
        for &handle in &pair {
            if let (Some(then), Some(now)) = (before.body(handle), bodies.get(handle)) {
                let fall = gravity * f64::from(now.gravity_scale() * now.mass());
                let work = fall.dot(centre(now) - centre(then));
                gain += kinetic_energy(now) - kinetic_energy(then);
                gain -= if now.is_dynamic() { work } else { 0.0 };
            }
        }
        take_energy(bodies, &pair[..1], &pair[1..], gain);
    }

    /// Whether these bodies touched nothing but each other, and nothing is tied to them.
    fn are_alone(&self, pair: &[RigidBodyHandle]) -> bool {
        let physics = &self.physics;
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        pair.iter().all(|&handle| {
            let Some(body) = physics.bodies.get(handle) else {
                return false;
            };
            if body.is_fixed() {
                return true;
            }
            let pairs =
                (body.colliders().iter()).flat_map(|&c| physics.narrow_phase.contact_pairs_with(c));
            let mut touching = pairs.filter(|p| p.has_any_active_contact());
            let inside = |c| parent(c).is_some_and(|h| pair.contains(&h));
            let mut joints = physics.impulse_joints.attached_joints(handle);
            !body.is_kinematic()
                && joints.next().is_none()
                && touching.all(|p| inside(p.collider1) && inside(p.collider2))
        })
    }

    /// Before a step is taken again with fragments: the blows that made them act.
    pub(crate) fn pass_blows(&mut self, broken: &mut [Broken]) {
        let families: Families = (broken.iter())
            .map(|b| (key(b.parent), b.fragments.clone()))
            .collect();
        share_out(
            &mut broken
                .iter_mut()
                .flat_map(|b| &mut b.blow)
                .collect::<Vec<_>>(),
        );
        for broken in broken {
            broken.lost = 0.0;
            for meeting in &broken.blow {
                let striker = self.what_became_of(meeting.partner, &families);
                let pieces = nearest_first(&broken.fracture, &broken.fragments, meeting);
                let pushes = |t: &Touch| (t.point, t.direction * (meeting.share * t.blow));
                let pushes: Pushes = meeting.touches.iter().map(pushes).collect();
                broken.lost += self.push_plug(&pieces, &striker, &pushes, None);
            }
        }
    }

    /// After a step that stands: the engine's blow on the whole body, whose pieces move as it did, is taken back as far as energy
    /// allows, and the blow that broke it acts. Returns what is lost of the motion as it was before the blow, J.
    pub(crate) fn replace_blow(
        &mut self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
        meeting: &Meeting,
        families: &Families,
        before: &impl Before,
    ) -> f64 {
        let striker = self.what_became_of(meeting.partner, families);
        let bodies = &mut self.physics.bodies;
        let Some(mut pair) = Pair::new(bodies, fragments, &striker, meeting, before) else {
            return 0.0;
        };
        let back = |t: &Touch| t.direction * (-meeting.share * t.engine);
        let kicks = pair.kicks(meeting, back);
        let (work, give) = pair.price(kicks);
        let share = affordable(work, give, pair.lost(bodies, meeting, before));
        pair.kick(bodies, kicks, share);
        let arm = pair.centres[1];
        let pieces = nearest_first(fracture, fragments, meeting);
        let pushes = |t: &Touch| (t.point, t.direction * (meeting.share * t.blow));
        let pushes: Pushes = meeting.touches.iter().map(pushes).collect();
        // The pieces have moved with the step; the striker keeps its arm.
        let moved = pair.sides[0].centre - pair.centres[0];
        self.push_plug(&pieces, &striker, &pushes, Some((moved, arm)))
    }

    /// What a striker is now: itself, or its pieces; nothing where it is gone.
    pub(crate) fn what_became_of(
        &self,
        striker: Option<RigidBodyHandle>,
        families: &Families,
    ) -> Vec<RigidBodyHandle> {
        let Some(striker) = striker else {
            return Vec::new();
        };
        let there = |h: &RigidBodyHandle| self.physics.bodies.contains(*h);
        match families.get(&key(striker)) {
            Some(pieces) => pieces.iter().copied().filter(there).collect(),
            None => Some(striker).into_iter().filter(there).collect(),
        }
    }

    /// Puts impulses on the pieces nearest to them, in this order, and takes them from the striker. `since` says how far the
    /// pieces have moved since the pushes' points were right, and the striker's centre then. Returns what the motion loses, J.
    fn push_plug(
        &mut self,
        pieces: &[RigidBodyHandle],
        striker: &[RigidBodyHandle],
        pushes: &Pushes,
        since: Option<(DVec3, DVec3)>,
    ) -> f64 {
        let bodies = &mut self.physics.bodies;
        let moved = since.map_or(DVec3::ZERO, |(moved, _)| moved);
        let mut striker = side(bodies, striker);
        let arm = since.map_or(striker.centre, |(_, centre)| centre);
        let taken = Kick::about(arm, pushes.iter().copied()).scaled(-1.0);
        let given = |centre| Kick::about(centre, pushes.iter().map(|(p, j)| (*p + moved, *j)));
        let price = |plug: &Cluster, striker: &Cluster| {
            let kick = given(plug.centre);
            let work = plug.work(kick) + striker.work(taken);
            (work, plug.give(kick) + striker.give(taken), kick)
        };
        let loose = |h: &&RigidBodyHandle| bodies.get(**h).is_some_and(RigidBody::is_dynamic);
        let held = pieces.iter().any(|h| !loose(&h));
        let holds = pieces.first().is_none_or(|h| !loose(&h));
        let members: Vec<RigidBodyHandle> = pieces.iter().filter(loose).copied().collect();
        let mut left = 1.0;
        let mut lost = 0.0;
        let mut count = 1;
        while !holds && count <= members.len() {
            let Some(mut plug) = Cluster::of(bodies, &members[..count]) else {
                break;
            };
            let (work, give, kick) = price(&plug, &striker);
            let all = count == members.len();
            if work + give > 0.0 && !all {
                count = (count + 1 + count / 8).min(members.len());
                continue;
            }
            // What is held beside takes what would make all the loose ones leave faster than the striker follows.
            let share = if work >= 0.0 {
                0.0
            } else if held {
                (-work / give).min(1.0)
            } else {
                affordable(work, give, 0.0)
            };
            plug.kick(bodies, kick.scaled(share));
            striker.kick(bodies, taken.scaled(share));
            lost -= share * work + 0.5 * share * share * give;
            left -= share;
            break;
        }
        if (held || holds) && left > 0.0 {
            let kick = taken.scaled(left);
            let (work, give) = (striker.work(kick), striker.give(kick));
            if work < 0.0 {
                let share = affordable(work, give, 0.0);
                striker.kick(bodies, kick.scaled(share));
                lost -= share * work + 0.5 * share * share * give;
            }
        }
        debug_assert!(lost >= -1e-9, "a blow that breaks gave {} J", -lost);
        lost
    }
}

/// The two sides of a meeting as they are now, and their centres of mass when they met.
struct Pair {
    sides: [Cluster; 2],
    centres: [DVec3; 2],
    members: Vec<RigidBodyHandle>,
}

impl Pair {
    /// Both bodies whole. None where the one that was asked is gone.
    fn now(bodies: &RigidBodySet, meeting: &Meeting, before: &impl Before) -> Option<Self> {
        let partner: Vec<RigidBodyHandle> = meeting.partner.into_iter().collect();
        bodies.get(meeting.body)?;
        Self::new(bodies, &[meeting.body], &partner, meeting, before)
    }

    fn new(
        bodies: &RigidBodySet,
        body: &[RigidBodyHandle],
        partner: &[RigidBodyHandle],
        meeting: &Meeting,
        before: &impl Before,
    ) -> Option<Self> {
        let sides = [side(bodies, body), side(bodies, partner)];
        let partner_before = meeting.partner.and_then(|p| before.body(p));
        let centres = [
            centre(before.body(meeting.body)?),
            partner_before.map_or(DVec3::ZERO, centre),
        ];
        let members = body.iter().chain(partner).copied().collect();
        Some(Self {
            sides,
            centres,
            members,
        })
    }

    /// Impulses at the contacts, on both sides, with the arms of the step's start.
    fn kicks(&self, meeting: &Meeting, impulse: impl Fn(&Touch) -> DVec3) -> [Kick; 2] {
        let pushes = || meeting.touches.iter().map(|t| (t.point, impulse(t)));
        [
            Kick::about(self.centres[0], pushes()),
            Kick::about(self.centres[1], pushes()).scaled(-1.0),
        ]
    }

    /// A share s of these kicks adds s · the first + ½ s² · the second, J.
    fn price(&self, kicks: [Kick; 2]) -> (f64, f64) {
        let [a, b] = &self.sides;
        (
            a.work(kicks[0]) + b.work(kicks[1]),
            a.give(kicks[0]) + b.give(kicks[1]),
        )
    }

    /// Speed at which a contact opens now, m/s.
    fn departure(&self, touch: &Touch) -> f64 {
        let speed = |k: usize| {
            let side = &self.sides[k];
            side.linear + side.angular.cross(touch.point - self.centres[k])
        };
        touch.normal.dot(speed(0) - speed(1))
    }

    /// What the kicks add to that.
    fn gain(&self, touch: &Touch, kicks: [Kick; 2]) -> f64 {
        let speed = |k: usize| {
            let (linear, angular) = self.sides[k].answer(kicks[k]);
            linear + angular.cross(touch.point - self.centres[k])
        };
        touch.normal.dot(speed(0) - speed(1))
    }

    /// Energy that the two have lost in the step: at these contacts, and no more than altogether, J.
    fn lost(&self, bodies: &RigidBodySet, meeting: &Meeting, before: &impl Before) -> f64 {
        let at_contacts: f64 = (meeting.touches.iter())
            .map(|t| 0.5 * meeting.share * t.engine * (t.approach - self.departure(t)))
            .sum();
        let energy =
            |h: Option<RigidBodyHandle>| h.and_then(|h| before.body(h)).map_or(0.0, kinetic_energy);
        let then = energy(Some(meeting.body)) + energy(meeting.partner);
        at_contacts.min(then - self.energy(bodies)).max(0.0)
    }

    fn energy(&self, bodies: &RigidBodySet) -> f64 {
        let members = self.members.iter().filter_map(|&h| bodies.get(h));
        members.map(kinetic_energy).sum()
    }

    fn kick(&mut self, bodies: &mut RigidBodySet, kicks: [Kick; 2], share: f64) {
        for (side, kick) in self.sides.iter_mut().zip(kicks) {
            side.kick(bodies, kick.scaled(share));
        }
    }
}

/// Bodies as one: what of them can move; nothing where none of them can.
fn side(bodies: &RigidBodySet, members: &[RigidBodyHandle]) -> Cluster {
    if let [only] = members {
        let body = bodies.get(*only);
        return body.map_or_else(Cluster::earth, |body| Cluster::single(*only, body));
    }
    let mut members = members.to_vec();
    members.retain(|&h| bodies.get(h).is_some_and(RigidBody::is_dynamic));
    Cluster::of(bodies, &members).unwrap_or_else(Cluster::earth)
}

/// The pieces from the nearest to the contacts; of several as near, in their own order.
fn nearest_first(
    fracture: &Fracture,
    fragments: &[RigidBodyHandle],
    meeting: &Meeting,
) -> Vec<RigidBodyHandle> {
    let distance = |mesh: &TriMesh, middle: Vec3| {
        let squares = meeting.touches.iter();
        squares
            .map(|t| square_distance(mesh, t.local - middle))
            .fold(f64::INFINITY, f64::min)
    };
    let mut order: Vec<(f64, usize)> = (fracture.fragments.iter().take(fragments.len()))
        .enumerate()
        .map(|(i, f)| (distance(&f.mesh, f.mass.centre.as_vec3()), i))
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.into_iter().map(|(_, i)| fragments[i]).collect()
}

/// From a point to the surface, m².
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
