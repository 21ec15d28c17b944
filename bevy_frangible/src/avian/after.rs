//! After the step: bodies that broke give way to their pieces, and the blows that broke them act.

use std::collections::BTreeMap;
use std::sync::PoisonError;

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::glam::{self, DMat3, DVec3};
use frangible::internals::rigid::{Kick, Rigid, nearest_first, take_blow, take_energy};

use super::plain::{double, piece, rigid, velocities};
use super::{Moving, Ruling, Verdict, Verdicts};
use crate::BreakableBody;
use crate::break_apart::conclude;
use crate::meshes::{into, out};

/// Bodies whose contact a break left out of the step, each with the share of the step until they touched and its position at the start of the step,
/// m.
struct Touches(BTreeMap<Entity, (f32, Vec3)>);

impl Touches {
    fn new<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> Self {
        let mut first: BTreeMap<Entity, (f32, Vec3)> = BTreeMap::new();
        for verdict in verdicts {
            let [body, striker] = verdict.began;
            for (entity, began) in [(Some(verdict.body), body), (verdict.striker, striker)] {
                let new = (verdict.touched, began);
                let Some(entity) = entity else { continue };
                let known = first.entry(entity).or_insert(new);
                if new.0 < known.0 {
                    *known = new;
                }
            }
        }
        Self(first)
    }

    /// Position of an entity when it touched. `now` is its position at the end of the step.
    fn place(&self, entity: Entity, now: Vec3) -> Vec3 {
        let touched = self.0.get(&entity);
        touched.map_or(now, |&(share, began)| began.lerp(now, share))
    }
}

/// Motion of bodies while the breaks of a step are carried out, and the pieces of those that broke.
struct Motions<'a, 'w, 's> {
    before: &'a Query<'w, 's, (&'static RigidBody, Moving)>,
    touches: &'a Touches,
    now: BTreeMap<Entity, Rigid>,
    families: BTreeMap<Entity, Vec<Entity>>,
}

impl Motions<'_, '_, '_> {
    fn of(&self, entity: Entity) -> Option<Rigid> {
        if let Some(known) = self.now.get(&entity) {
            return Some(*known);
        }
        let (kind, moving) = self.before.get(entity).ok()?;
        let at = moving.0.0;
        let mut body = rigid(kind, moving);
        body.centre += double(into(self.touches.place(entity, at) - at));
        Some(body)
    }

    /// Moving bodies that a striker consists of now: itself, or its pieces.
    fn parts(&self, striker: Option<Entity>) -> Vec<Entity> {
        let Some(striker) = striker else {
            return Vec::new();
        };
        let parts = self.families.get(&striker);
        let mut parts = parts.cloned().unwrap_or_else(|| vec![striker]);
        parts.retain(|&e| self.of(e).is_some_and(|body| body.gives_way()));
        parts
    }

    fn all(&self, entities: &[Entity]) -> Vec<Rigid> {
        entities.iter().filter_map(|&e| self.of(e)).collect()
    }

    fn set(&mut self, entities: &[Entity], bodies: &[Rigid]) {
        for (&entity, body) in entities.iter().zip(bodies) {
            self.now.insert(entity, *body);
        }
    }
}

/// Gives every body that was hit its outcome.
pub(super) fn carry_out(
    mut commands: Commands,
    verdicts: Res<Verdicts>,
    mut bodies: Query<&mut BreakableBody>,
    moving: Query<(&'static RigidBody, Moving)>,
) {
    let mut verdicts: Vec<Verdict> = {
        let mut list = verdicts.0.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut *list)
    };
    // Pairs come in any order; a body's own break counts before those that held.
    let broke = |v: &Verdict| match &v.ruling {
        Ruling::Now(judged) | Ruling::Late(judged) => judged.broke(),
        Ruling::Waits => false,
    };
    let inside = |v: &&Verdict| broke(v) && matches!(v.ruling, Ruling::Now(_));
    let touches = Touches::new(verdicts.iter().filter(inside));
    verdicts.sort_by_key(|v| (v.body, !broke(v), v.striker));
    verdicts.dedup_by_key(|v| v.body);
    // Two bodies that break each other would find one force, were it not for their other contacts and their cracks: the mean of their answers counts.
    let met: Vec<(Entity, Option<Entity>)> = (verdicts.iter())
        .filter(|v| broke(v))
        .map(|v| (v.body, v.striker))
        .collect();
    let mut motions = Motions {
        before: &moving,
        touches: &touches,
        now: BTreeMap::new(),
        families: BTreeMap::new(),
    };
    for Verdict {
        body: entity,
        striker,
        contacts,
        ruling,
        ..
    } in verdicts
    {
        let (judged, late) = match ruling {
            Ruling::Now(judged) => (judged, false),
            Ruling::Late(judged) => (judged, true),
            Ruling::Waits => continue,
        };
        let (Ok(mut body), Ok((_, now)), Some(whole)) = (
            bodies.get_mut(entity),
            moving.get(entity),
            motions.of(entity),
        ) else {
            continue;
        };
        let (at, rotation) = (touches.place(entity, now.0.0), now.1.0);
        let pose = Transform::from_translation(at).with_rotation(rotation);
        let Some((fracture, fragments)) = conclude(&mut commands, entity, &mut body, pose, judged)
        else {
            continue;
        };
        let points: Vec<glam::Vec3> = contacts.iter().map(|c| c.point).collect();
        let order = nearest_first(&fracture, &points);
        let pieces: Vec<Entity> = order.iter().map(|&i| fragments[i]).collect();
        let mut rigids: Vec<Rigid> = (order.iter().map(|&i| &fracture.fragments[i]))
            .map(|f| {
                let supported = f.supported && !whole.gives_way();
                piece(&f.mass, supported, &whole, rotation, at)
            })
            .collect();
        let parts = motions.parts(striker);
        let mut others = motions.all(&parts);
        let mirrored = striker.is_some_and(|s| met.contains(&(s, Some(entity))));
        // A blow that the whole body has taken already has the engine's impulse.
        let share = match (late, mirrored) {
            (true, _) => 0.0,
            (false, true) => 0.5,
            (false, false) => 1.0,
        };
        let world = |v: glam::Vec3| double(into(rotation * out(v)));
        let pushes: Vec<(DVec3, DVec3)> = (fracture.report.contacts.iter())
            .map(|c| {
                let place = double(into(at)) + world(c.point);
                (place, world(c.normal) * (share * c.impulse))
            })
            .collect();
        let about = Rigid::together(&others).centre;
        let taken = Kick::about(about, &pushes).scaled(-1.0);
        let axes = DMat3::from_cols(
            world(glam::Vec3::X),
            world(glam::Vec3::Y),
            world(glam::Vec3::Z),
        );
        let lost = take_blow(
            &fracture,
            (&order, axes),
            &mut rigids,
            &mut others,
            &pushes,
            taken,
        );
        let count = rigids.len();
        rigids.append(&mut others);
        if parts.is_empty() {
            rigids.push(Rigid::earth());
        }
        take_energy(&mut rigids, fracture.report.fracture_energy - lost);
        motions.set(&pieces, &rigids[..count]);
        motions.set(&parts, &rigids[count..]);
        motions.families.insert(entity, pieces);
    }
    for (entity, body) in &motions.now {
        commands.entity(*entity).try_insert(velocities(body));
    }
    for &entity in touches.0.keys() {
        if let Ok((kind, now)) = moving.get(entity)
            && kind.is_dynamic()
            && !motions.families.contains_key(&entity)
        {
            let at = Position(touches.place(entity, now.0.0));
            commands.entity(entity).try_insert(at);
        }
    }
}
