//! After the step: bodies that broke give way to their pieces, and the blows that broke them act.

use std::collections::BTreeMap;
use std::sync::PoisonError;
use std::time::Duration;

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::Fracture;
use frangible::glam::{self, DMat3, DVec3};
use frangible::internals::outcome::ContactReport;
use frangible::internals::rigid::{
    APART, Kick, Rigid, fly_through, nearest_first, take_blow, take_energy, take_held,
};

use super::plain::{double, piece, rigid, velocities};
use super::{Moving, Passages, Ruling, Verdict, Verdicts};
use crate::break_apart::conclude;
use crate::meshes::{into, out};
use crate::{BreakableBody, FragmentOf};

/// Bodies nearer than this touch, m: Avian lists contacts that may come.
const TOUCHES: f32 = 1e-4;

/// Bodies whose contact was left out of the step, each with the time from the start of the step until it touched, s, and its position then, m: Avian's own
/// position at the end of the step is no guide, since its sweep may have stopped a fast body in front of the other one.
struct Touches(BTreeMap<Entity, (f32, Vec3)>);

impl Touches {
    fn new<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> Self {
        let mut first: BTreeMap<Entity, (f32, Vec3)> = BTreeMap::new();
        for verdict in verdicts {
            let [body, striker] = verdict.places;
            for (entity, place) in [(Some(verdict.body), body), (verdict.striker, striker)] {
                let new = (verdict.touched, place);
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
        self.0.get(&entity).map_or(now, |&(_, place)| place)
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

/// A blow that acts: on which body, by whom, and the share of it, since each of two breakable bodies gives its own answer.
struct Blow {
    body: Entity,
    striker: Option<Entity>,
    share: f64,
    /// Place and rotation of the body at the blow.
    at: Vec3,
    rotation: Quat,
}

impl Blow {
    /// The body's axes in the world.
    fn axes(&self) -> DMat3 {
        let axis = |v: glam::Vec3| double(into(self.rotation * out(v)));
        DMat3::from_cols(
            axis(glam::Vec3::X),
            axis(glam::Vec3::Y),
            axis(glam::Vec3::Z),
        )
    }

    /// Impulses on the body, at their places in the world.
    fn pushes(&self, contacts: &[ContactReport]) -> Vec<(DVec3, DVec3)> {
        let (at, axes) = (double(into(self.at)), self.axes());
        let push = |c: &ContactReport| {
            let impulse = axes * c.normal.as_dvec3() * (self.share * c.impulse);
            (at + axes * c.point.as_dvec3(), impulse)
        };
        contacts.iter().map(push).collect()
    }

    /// The body has held it.
    fn act_on_whole(&self, contacts: &[ContactReport], motions: &mut Motions) {
        let parts = motions.parts(self.striker);
        let (Some(mut whole), mut others) = (motions.of(self.body), motions.all(&parts)) else {
            return;
        };
        take_held(&mut whole, &mut others, &self.pushes(contacts));
        if whole.gives_way() {
            motions.set(&[self.body], &[whole]);
        }
        motions.set(&parts, &others);
    }

    /// The body has broken into these fragments. `whole`: its motion before; `alone`: neither it nor the striker touched anything else.
    fn act_on_pieces(
        &self,
        (fracture, fragments): (&Fracture, &[Entity]),
        (whole, alone): (&Rigid, bool),
        points: &[glam::Vec3],
        motions: &mut Motions,
    ) {
        let order = nearest_first(fracture, points);
        let pieces: Vec<Entity> = order.iter().map(|&i| fragments[i]).collect();
        let mut rigids: Vec<Rigid> = (order.iter().map(|&i| &fracture.fragments[i]))
            .map(|f| {
                let supported = f.supported && !whole.gives_way();
                piece(&f.mass, supported, whole, self.rotation, self.at)
            })
            .collect();
        let parts = motions.parts(self.striker);
        let mut others = motions.all(&parts);
        let (axes, pushes) = (self.axes(), self.pushes(&fracture.report.contacts));
        let about = Rigid::together(&others).centre;
        let taken = Kick::about(about, &pushes).scaled(-1.0);
        let lost = take_blow(
            fracture,
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
        let (rigids, others) = rigids.split_at_mut(count);
        if alone {
            let place = (&order[..], axes, double(into(self.at)));
            fly_through(fracture, place, rigids, others);
        }
        motions.set(&pieces, rigids);
        motions.set(&parts, others);
        motions.families.insert(self.body, pieces);
    }
}

/// Gives every body that was hit its outcome.
pub(super) fn carry_out(
    mut commands: Commands,
    (verdicts, mut passages): (Res<Verdicts>, ResMut<Passages>),
    mut bodies: Query<&mut BreakableBody>,
    moving: Query<(&'static RigidBody, Moving)>,
    (collisions, pieces): (Collisions, Query<&FragmentOf>),
    time: Res<Time<Fixed>>,
) {
    let now = time.elapsed();
    if !passages.0.is_empty() {
        passages.0.retain(|&(striker, parent), until| {
            let takes_part =
                |e: Entity| e == striker || pieces.get(e).is_ok_and(|of| of.0 == parent);
            *until > now && touch_nothing_else(&collisions, takes_part)
        });
    }
    let mut verdicts: Vec<Verdict> = {
        let mut list = verdicts.0.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut *list)
    };
    // Pairs come in any order; a body's own break counts before those that held.
    let touches = Touches::new(verdicts.iter().filter(|v| v.left_out));
    verdicts.sort_by_key(|v| (v.body, !broke(v), v.striker));
    // Besides a body's first verdict, only blows that it has held act on it.
    verdicts.dedup_by(|next, first| next.body == first.body && (broke(first) || !next.left_out));
    // Two bodies that break each other would find one force, were it not for their other contacts and their cracks: the mean of their answers counts.
    let met = |broken_too: bool, list: &[Verdict]| -> Vec<(Entity, Option<Entity>)> {
        let acts = |v: &&Verdict| v.left_out || matches!(v.ruling, Ruling::Late(_));
        let of = list
            .iter()
            .filter(acts)
            .filter(|v| self::broke(v) == broken_too);
        of.map(|v| (v.body, v.striker)).collect()
    };
    let (broken, held) = (met(true, &verdicts), met(false, &verdicts));
    let mut motions = Motions {
        before: &moving,
        touches: &touches,
        now: BTreeMap::new(),
        families: BTreeMap::new(),
    };
    let mut concluded = None;
    for verdict in verdicts {
        let (judged, late) = match verdict.ruling {
            Ruling::Now(judged) => (judged, false),
            Ruling::Late(judged) => (judged, true),
            Ruling::Waits => continue,
        };
        let (entity, striker) = (verdict.body, verdict.striker);
        let (Ok(mut body), Ok((_, there)), Some(whole)) = (
            bodies.get_mut(entity),
            moving.get(entity),
            motions.of(entity),
        ) else {
            continue;
        };
        let mirror = striker.map(|s| (s, Some(entity)));
        let is_among = |list: &[_]| mirror.is_some_and(|mirror| list.contains(&mirror));
        let same = if judged.broke() { &broken } else { &held };
        let blow = Blow {
            body: entity,
            striker,
            // A blow that the whole body has taken already has the engine's impulse.
            share: match (late, is_among(same)) {
                (true, _) => 0.0,
                (false, true) => 0.5,
                (false, false) => 1.0,
            },
            at: touches.place(entity, there.0.0),
            rotation: there.1.0,
        };
        if let Some(report) = judged.report().filter(|_| verdict.left_out && !judged.broke())
            // The other body has broken by this blow: its answer counts.
            && !is_among(&broken)
        {
            blow.act_on_whole(&report.contacts, &mut motions);
        }
        if concluded.replace(entity) == Some(entity) {
            continue;
        }
        let pose = Transform::from_translation(blow.at).with_rotation(blow.rotation);
        let Some((fracture, fragments)) = conclude(&mut commands, entity, &mut body, pose, judged)
        else {
            continue;
        };
        let points: Vec<glam::Vec3> = verdict.contacts.iter().map(|c| c.point).collect();
        let takes_part = |e: Entity| e == entity || Some(e) == striker;
        let alone = blow.share == 1.0 && touch_nothing_else(&collisions, takes_part);
        let made = (&*fracture, &fragments[..]);
        blow.act_on_pieces(made, (&whole, alone), &points, &mut motions);
        if let Some(striker) = striker.filter(|_| alone) {
            passages
                .0
                .insert((striker, entity), now + Duration::from_secs_f64(APART));
        }
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

/// Returns true if no body of these touches one that is none of them.
fn touch_nothing_else(collisions: &Collisions, takes_part: impl Fn(Entity) -> bool) -> bool {
    let touching = collisions.iter().filter(|pair| {
        let mut points = pair.manifolds.iter().flat_map(|m| &m.points);
        points.any(|p| p.penetration > -TOUCHES)
    });
    let mut inside =
        touching.map(|pair| [pair.body1, pair.body2].map(|b| b.is_some_and(&takes_part)));
    inside.all(|[a, b]| a == b)
}

fn broke(verdict: &Verdict) -> bool {
    match &verdict.ruling {
        Ruling::Now(judged) | Ruling::Late(judged) => judged.broke(),
        Ruling::Waits => false,
    }
}
