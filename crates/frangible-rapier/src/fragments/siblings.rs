//! Fragments of one parent overlap a little at birth; this keeps them from flying apart for it.
//!
//! The hulls of jagged pieces cut into each other by the depth of the jags, and shapes that touch exactly give
//! contact directions that are rounding noise. Rapier would push such pairs apart at up to its corrective speed.
//! Siblings are born with an overlap, of which no more than [`crate::WorldConfig::overlap_relaxation`] × time step is
//! shown to the solver: the pair cannot come nearer, so nothing sinks; it creeps apart at about that speed, so nothing
//! explodes; it may part at any speed, so nothing sticks; and it ends at the true surfaces, so nothing hovers.
//! Only this overlap is softened: a blow between siblings is as hard as any, and one that is pressed into another
//! comes out as of any other body.
//!
//! The `user_data` of a contact manifold keeps the rest of the overlap at birth, where there is any.

use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::pipeline::{ContactModificationContext, PhysicsHooks, PhysicsWorld};

/// Steps after birth in which siblings do not bounce off each other.
const NEWBORN_STEPS: u64 = 2;

/// Steps after birth in which all overlap of siblings is softened: pieces that fly apart turn, and their jags meet, and pushing those apart
/// would make energy.
const YOUNG_STEPS: u64 = 60;

#[derive(Clone, Copy, Debug)]
struct Birth {
    handle: RigidBodyHandle,
    /// Number of the body that broke; [`RUBBLE`] for a rubble.
    parent: u64,
    /// Number of the body that was no piece yet, from which it comes.
    origin: u64,
    step: u64,
}

/// Parent of a rubble, whose parts are siblings of all pieces of its origin.
const RUBBLE: u64 = 0;

/// Parents and births of fragments, by which siblings are known.
#[derive(Clone, Debug, Default)]
pub(crate) struct Siblings {
    /// Number of the current step.
    pub(crate) step: u64,
    /// Largest overlap by which siblings part in a step, m.
    pub(crate) relaxation: f32,
    parents: u64,
    /// Birth of each body, by its index: asked for every pair of fragments in every step.
    births: Vec<Option<Birth>>,
    passages: Vec<Passage>,
}

/// A striker on its way through the fragments of a body that it broke.
#[derive(Clone, Copy, Debug)]
struct Passage {
    striker: RigidBodyHandle,
    /// Number of the body that broke.
    parent: u64,
    /// First step in which it is through.
    until: u64,
}

impl Siblings {
    /// Notes that these bodies are the fragments of one parent, born in the current step.
    pub(crate) fn born(&mut self, parent: RigidBodyHandle, fragments: &[RigidBodyHandle]) {
        self.parents += 1;
        let origin = self.origin(parent).unwrap_or(self.parents);
        for &handle in fragments {
            self.note(Birth {
                handle,
                parent: self.parents,
                origin,
                step: self.step,
            });
        }
    }

    /// This body is the rubble of an origin.
    pub(crate) fn lies(&mut self, handle: RigidBodyHandle, origin: u64) {
        self.note(Birth {
            handle,
            parent: RUBBLE,
            origin,
            step: 0,
        });
    }

    /// For so many steps the striker flies through the siblings of this fragment: what it loses by that it has lost.
    pub(crate) fn pass(&mut self, striker: RigidBodyHandle, fragment: RigidBodyHandle, steps: u64) {
        let Some(Birth { parent, .. }) = self.birth(fragment) else {
            return;
        };
        self.passages.push(Passage {
            striker,
            parent,
            until: self.step + steps,
        });
    }

    /// Ends the passages in which the striker or a fragment touched anything else in the last step.
    pub(crate) fn end_passages(&mut self, physics: &PhysicsWorld) {
        if self.passages.is_empty() {
            return;
        }
        let body = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let touching = physics.narrow_phase.contact_pairs();
        let touching: Vec<[Option<RigidBodyHandle>; 2]> = touching
            .filter(|pair| pair.has_any_active_contact())
            .map(|pair| [pair.collider1, pair.collider2].map(body))
            .collect();
        let mut passages = std::mem::take(&mut self.passages);
        passages.retain(|passage| {
            let takes_part = |h: Option<RigidBodyHandle>| {
                let sibling = |h| self.birth(h).is_some_and(|b| b.parent == passage.parent);
                h.is_some_and(|h| h == passage.striker || sibling(h))
            };
            let mut others = touching.iter().map(|pair| pair.map(takes_part));
            self.step < passage.until && others.all(|[a, b]| a == b)
        });
        self.passages = passages;
    }

    /// Returns true if one of the two is on its way through fragments of which the other is one.
    fn passes(&self, a: RigidBodyHandle, b: RigidBodyHandle) -> bool {
        let mut under_way = self.passages.iter().filter(|p| self.step < p.until);
        under_way.any(|passage| {
            let through = |piece| {
                let birth = self.birth(piece);
                birth.is_some_and(|birth| birth.parent == passage.parent)
            };
            passage.striker == a && through(b) || passage.striker == b && through(a)
        })
    }

    fn note(&mut self, birth: Birth) {
        let index = birth.handle.into_raw_parts().0 as usize;
        if self.births.len() <= index {
            self.births.resize(index + 1, None);
        }
        self.births[index] = Some(birth);
    }

    /// Number of the body that was no piece yet, from which a piece comes.
    pub(crate) fn origin(&self, piece: RigidBodyHandle) -> Option<u64> {
        self.birth(piece).map(|birth| birth.origin)
    }

    /// Forgets bodies that are gone.
    pub(crate) fn purge(&mut self, alive: impl Fn(RigidBodyHandle) -> bool) {
        for birth in &mut self.births {
            *birth = birth.filter(|b| alive(b.handle));
        }
        let step = self.step;
        self.passages.retain(|p| step < p.until && alive(p.striker));
    }

    /// All fragments, in the order of their handles.
    pub(crate) fn fragments(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let pieces = self.births.iter().flatten().filter(|b| b.parent != RUBBLE);
        pieces.map(|birth| birth.handle)
    }

    fn birth(&self, body: RigidBodyHandle) -> Option<Birth> {
        let birth = self.births.get(body.into_raw_parts().0 as usize)?;
        birth.filter(|b| b.handle == body)
    }

    /// Relation of two siblings.
    fn relation(&self, a: RigidBodyHandle, b: RigidBodyHandle) -> Option<Relation> {
        let (a, b) = (self.birth(a)?, self.birth(b)?);
        let rubble = a.parent == RUBBLE || b.parent == RUBBLE;
        let siblings = a.parent == b.parent || rubble && a.origin == b.origin;
        siblings.then(|| match self.step.saturating_sub(a.step.max(b.step)) {
            ..NEWBORN_STEPS => Relation::Newborn,
            _ if rubble => Relation::Rubble,
            NEWBORN_STEPS..YOUNG_STEPS => Relation::Young,
            _ => Relation::Old,
        })
    }
}

/// Relation of two siblings.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Relation {
    /// Born just now: they do not bounce.
    Newborn,
    /// Born lately, perhaps still on their way apart.
    Young,
    /// One is a rubble, in which pieces may lie as they were born.
    Rubble,
    Old,
}

impl PhysicsHooks for Siblings {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        let (Some(a), Some(b)) = (context.rigid_body1, context.rigid_body2) else {
            return;
        };
        if self.passes(a, b) && both_move(context) {
            if let Some(rigid) = context.rigid_mut() {
                rigid.solver_contacts.clear();
            }
            return;
        }
        let Some(relation) = self.relation(a, b) else {
            return;
        };
        let Some(rigid) = context.rigid_mut() else {
            return;
        };
        if relation == Relation::Newborn {
            // The blow reaches a piece through its siblings, many contacts at once; Newton's restitution applied to
            // each of them can gain energy.
            *rigid.restitution = 0.0;
        }
        let deepest = rigid.solver_contacts.iter().map(|c| -c.dist);
        let overlap = deepest.fold(0.0, f32::max);
        let known = f32::from_bits(*rigid.user_data);
        let of_birth = match relation {
            Relation::Newborn => overlap,
            _ => known.min(overlap),
        };
        if relation == Relation::Newborn || known > 0.0 {
            *rigid.user_data = (of_birth - self.relaxation).max(0.0).to_bits();
        }
        let softened = match relation {
            Relation::Old => of_birth,
            _ => overlap,
        };
        for contact in rigid.solver_contacts.iter_mut() {
            let later = (-contact.dist - softened).max(0.0);
            contact.dist = contact.dist.max(-later - self.relaxation);
        }
    }
}

fn both_move(context: &ContactModificationContext<'_>) -> bool {
    let moves = |body: Option<RigidBodyHandle>| {
        body.and_then(|h| context.bodies.get(h))
            .is_some_and(|b| b.is_dynamic())
    };
    moves(context.rigid_body1) && moves(context.rigid_body2)
}
