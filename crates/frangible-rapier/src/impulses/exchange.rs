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
//! gone. The pieces take it as the blow says ([`frangible::internals::rigid`]), and what still approaches is
//! the engine's. What the two lose by it went into vibration, and the cracks are paid from it first.

use std::collections::BTreeMap;

use frangible::Fracture;
use frangible::glam::DVec3;
use frangible::internals::rigid::{
    self, Kick, Pushes, Rigid, affordable, is_local, kick_together, push_plug, push_whole,
};
use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::calm::motions::Before;
use crate::impulses::blows::{Meeting, Touch, share_out};
use crate::impulses::motion::{centre, kinetic_energy};
use crate::impulses::plain::{Plain, take_energy};
use crate::impulses::settle::Broken;
use crate::world::{BreakableWorld, Key, key};

/// Pieces of bodies that broke in a step.
pub(crate) type Families = BTreeMap<Key, Vec<RigidBodyHandle>>;

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
        let allowed = pair.lost(meeting, before);
        let mut share = affordable(work, give, allowed);
        for touch in &meeting.touches {
            let leaves = pair.departure(touch);
            let gains = pair.gain(touch, kicks);
            if gains < 0.0 && leaves + share * gains < leaves.min(0.0) {
                share = (leaves.max(0.0) / -gains).min(share);
            }
        }
        let now = pair.energy();
        pair.kick(kicks, share);
        debug_assert!(
            pair.energy() <= (now + allowed) * (1.0 + 1e-5) + 1e-9,
            "a blow that holds gave energy"
        );
        pair.put_back(bodies);
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

    /// Returns true if these bodies touched nothing but each other, and nothing is tied to them.
    pub(crate) fn are_alone(&self, pair: &[RigidBodyHandle]) -> bool {
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
            let thrown = self.thrown_at(broken);
            let blows: Vec<Push<'_>> = (broken.blow.iter())
                .map(|meeting| Push {
                    meeting,
                    striker: self.what_became_of(meeting.partner, &families),
                    since: None,
                })
                .collect();
            broken.lost = self.push_apart(&broken.fracture, &broken.fragments, &blows);
            if let Some(thrown) = thrown {
                self.fly_through(broken, &thrown);
            }
        }
    }

    /// After a step that stands: the engine's blows on the whole body, whose pieces move as it did, are taken back as far as energy
    /// allows, and the blows that broke it act. Returns what is lost of the motion as it was before them, J.
    pub(crate) fn replace_blows(
        &mut self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
        meetings: &[Meeting],
        families: &Families,
        before: &impl Before,
    ) -> f64 {
        let mut blows = Vec::with_capacity(meetings.len());
        for meeting in meetings {
            let striker = self.what_became_of(meeting.partner, families);
            let bodies = &mut self.physics.bodies;
            let Some(mut pair) = Pair::new(bodies, fragments, &striker, meeting, before) else {
                continue;
            };
            let back = |t: &Touch| t.direction * (-meeting.share * t.engine);
            let kicks = pair.kicks(meeting, back);
            let (work, give) = pair.price(kicks);
            let share = affordable(work, give, pair.lost(meeting, before));
            pair.kick(kicks, share);
            pair.put_back(bodies);
            // The pieces have moved with the step; the striker keeps its arm.
            let moved = pair.wholes[0].centre - pair.centres[0];
            blows.push(Push {
                meeting,
                striker,
                since: Some((moved, pair.centres[1])),
            });
        }
        self.push_apart(fracture, fragments, &blows)
    }

    /// Puts blows on fragments: as they [move apart](rigid::part) by what was followed of them; on a [plug](push_plug) where nothing was, or where a
    /// blow is [local](is_local). Returns what the motion loses, J.
    fn push_apart(
        &mut self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
        blows: &[Push<'_>],
    ) -> f64 {
        let pieces = |blow: &Push<'_>| blow.meeting.nearest(fracture, fragments);
        let mut lost = 0.0;
        if fracture.moves_apart() && !blows.iter().any(|blow| self.is_local(&pieces(blow), blow)) {
            for blow in blows {
                lost += self.push_pieces(fragments, blow, push_whole);
            }
            return lost - self.part(fracture, fragments, lost);
        }
        for blow in blows {
            lost += self.push_pieces(&pieces(blow), blow, push_plug);
        }
        lost
    }

    /// Returns true if a blow is [local](is_local) to few of these pieces, which come in the order of their distance from it.
    fn is_local(&self, pieces: &[RigidBodyHandle], blow: &Push<'_>) -> bool {
        let set = &self.physics.bodies;
        let (pieces, striker) = (Plain::of(set, pieces), Plain::of(set, &blow.striker));
        let (pushes, taken) = blow.acts(&striker);
        is_local(&pieces.bodies, &striker.bodies, &pushes, taken)
    }

    /// Lets the fragments of a body that moves as one move apart as they did in the blow, by what it has lost and the cracks did not take.
    /// Returns what that takes, J.
    pub(crate) fn part(
        &mut self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
        lost: f64,
    ) -> f64 {
        let set = &mut self.physics.bodies;
        let there = fragments.iter().zip(&fracture.fragments);
        let there = there.filter_map(|(&handle, fragment)| {
            let rotation = set.get(handle)?.rotation().as_dquat();
            let own = [fragment.velocity, fragment.angular_velocity];
            Some((handle, own.map(|v| rotation * v)))
        });
        let (handles, motions): (Vec<_>, Vec<_>) = there.unzip();
        let mut pieces = Plain::of(set, &handles);
        let most = lost - fracture.report.fracture_energy;
        let taken = rigid::part(&mut pieces.bodies, &motions, most);
        pieces.put_back(set);
        taken
    }

    /// Bodies that a striker is now: itself, or its pieces; nothing where it is gone.
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

    /// Puts a blow's impulses on the pieces, in this order, and takes them from the striker. Returns what the motion loses, J.
    fn push_pieces(
        &mut self,
        pieces: &[RigidBodyHandle],
        blow: &Push<'_>,
        push: impl Fn(&mut [Rigid], &mut [Rigid], &Pushes, Kick) -> f64,
    ) -> f64 {
        let set = &mut self.physics.bodies;
        let (mut pieces, mut striker) = (Plain::of(set, pieces), Plain::of(set, &blow.striker));
        let (pushes, taken) = blow.acts(&striker);
        let lost = push(&mut pieces.bodies, &mut striker.bodies, &pushes, taken);
        pieces.put_back(set);
        striker.put_back(set);
        lost
    }
}

/// A blow to be put on fragments.
struct Push<'a> {
    meeting: &'a Meeting,
    /// The striker, or the pieces that it has become.
    striker: Vec<RigidBodyHandle>,
    /// Displacement of the pieces since the blow, m, and the striker's centre of mass at the blow.
    since: Option<(DVec3, DVec3)>,
}

impl Push<'_> {
    /// Impulses on the pieces, and what the striker takes.
    fn acts(&self, striker: &Plain) -> (Vec<(DVec3, DVec3)>, Kick) {
        let now = (DVec3::ZERO, Rigid::together(&striker.bodies).centre);
        let (moved, arm) = self.since.unwrap_or(now);
        let pushes = |moved: DVec3| -> Vec<(DVec3, DVec3)> {
            let touches = self.meeting.touches.iter();
            let push = |t: &Touch| (t.point + moved, t.direction * (self.meeting.share * t.blow));
            touches.map(push).collect()
        };
        let taken = Kick::about(arm, &pushes(DVec3::ZERO)).scaled(-1.0);
        (pushes(moved), taken)
    }
}

/// The two sides of a meeting as they are now, and their centres of mass when they met.
struct Pair {
    sides: [Plain; 2],
    /// Each side as one rigid body.
    wholes: [Rigid; 2],
    centres: [DVec3; 2],
}

impl Pair {
    /// The present state of both bodies as wholes. None if the one that was asked is gone.
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
        let sides = [Plain::of(bodies, body), Plain::of(bodies, partner)];
        let wholes = [0, 1].map(|k: usize| Rigid::together(&sides[k].bodies));
        let partner_before = meeting.partner.and_then(|p| before.body(p));
        let centres = [
            centre(before.body(meeting.body)?),
            partner_before.map_or(DVec3::ZERO, centre),
        ];
        Some(Self {
            sides,
            wholes,
            centres,
        })
    }

    /// Impulses at the contacts, on both sides, with the arms of the step's start.
    fn kicks(&self, meeting: &Meeting, impulse: impl Fn(&Touch) -> DVec3) -> [Kick; 2] {
        let touches = meeting.touches.iter();
        let pushes: Vec<(DVec3, DVec3)> = touches.map(|t| (t.point, impulse(t))).collect();
        [
            Kick::about(self.centres[0], &pushes),
            Kick::about(self.centres[1], &pushes).scaled(-1.0),
        ]
    }

    /// A share s of these kicks adds s · the first + ½ s² · the second, J.
    fn price(&self, kicks: [Kick; 2]) -> (f64, f64) {
        let [a, b] = &self.wholes;
        (
            a.work(kicks[0]) + b.work(kicks[1]),
            a.give(kicks[0]) + b.give(kicks[1]),
        )
    }

    /// Speed at which a contact opens now, m/s.
    fn departure(&self, touch: &Touch) -> f64 {
        let speed = |k: usize| {
            let whole = &self.wholes[k];
            whole.linear + whole.angular.cross(touch.point - self.centres[k])
        };
        touch.normal.dot(speed(0) - speed(1))
    }

    /// Increase of a contact's opening speed by the kicks, m/s.
    fn gain(&self, touch: &Touch, kicks: [Kick; 2]) -> f64 {
        let speed = |k: usize| {
            let (linear, angular) = self.wholes[k].answer(kicks[k]);
            linear + angular.cross(touch.point - self.centres[k])
        };
        touch.normal.dot(speed(0) - speed(1))
    }

    /// Energy that the two have lost in the step: at these contacts, and no more than altogether, J.
    fn lost(&self, meeting: &Meeting, before: &impl Before) -> f64 {
        let at_contacts: f64 = (meeting.touches.iter())
            .map(|t| 0.5 * meeting.share * t.engine * (t.approach - self.departure(t)))
            .sum();
        let energy =
            |h: Option<RigidBodyHandle>| h.and_then(|h| before.body(h)).map_or(0.0, kinetic_energy);
        let then = energy(Some(meeting.body)) + energy(meeting.partner);
        at_contacts.min(then - self.energy()).max(0.0)
    }

    fn energy(&self) -> f64 {
        let bodies = self.sides.iter().flat_map(|side| &side.bodies);
        bodies.map(Rigid::kinetic_energy).sum()
    }

    fn kick(&mut self, kicks: [Kick; 2], share: f64) {
        for ((side, whole), kick) in self.sides.iter_mut().zip(&mut self.wholes).zip(kicks) {
            kick_together(&mut side.bodies, whole, kick.scaled(share));
        }
    }

    fn put_back(&self, bodies: &mut RigidBodySet) {
        for side in &self.sides {
            side.put_back(bodies);
        }
    }
}
