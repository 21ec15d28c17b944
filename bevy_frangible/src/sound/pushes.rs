//! Touches and slides in Avian's world.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::Material;
use frangible_sound::{EngineMotion, EngineStep, Push};

use super::Heard;
use crate::meshes::into;
use crate::{BreakableBody, Broken, FragmentOf, MadeOf};

/// A body as it moves.
type Moving = (
    Entity,
    &'static RigidBody,
    &'static Position,
    &'static Rotation,
    &'static LinearVelocity,
    &'static AngularVelocity,
    &'static ComputedMass,
    &'static ComputedCenterOfMass,
);

/// Filter for things of a known material that neither break nor come of a break, such as a thrown ball.
type Thrown = (Without<BreakableBody>, Without<FragmentOf>, Without<Broken>);

/// Finds the touches and slides of the step that was just taken.
pub(super) fn touch(
    mut heard: ResMut<Heard>,
    collisions: Collisions,
    bodies: Query<Moving>,
    thrown: Query<
        (
            Entity,
            &RigidBody,
            &MadeOf,
            &ComputedMass,
            Option<&Collider>,
        ),
        Thrown,
    >,
    (gravity, time): (Res<Gravity>, Res<Time<Fixed>>),
) {
    let heard = &mut *heard;
    for (entity, kind, made, mass, collider) in &thrown {
        if heard.troupe.node(entity).is_none() && kind.is_dynamic() && mass.inverse() > 0.0 {
            let mass = f64::from(mass.value());
            let radius = radius(collider, &made.0, mass);
            heard.troupe.ball(entity, &made.0, [radius, mass]);
        }
    }
    let troupe = &heard.troupe;
    let pushes = collisions
        .iter()
        .filter_map(|pair| push(pair, &bodies, &|entity| troupe.node(entity)));
    let mut pushes: Vec<Push> = pushes.collect();
    // Pairs come in any order.
    pushes.sort_by_key(|push| push.colliders);
    let step = EngineStep {
        time: time.elapsed_secs_f64(),
        length: time.delta_secs(),
        gravity: gravity.0.length(),
        // Avian knows no resistance to rolling.
        rolling_arm: 0.0,
    };
    (heard.touches, heard.slides) = heard.touching.step(&step, &pushes, motions(&bodies));
}

/// The radius of a ball, m, or that of a ball of its mass.
fn radius(collider: Option<&Collider>, material: &Material, mass: f64) -> f64 {
    let ball = collider.and_then(|collider| collider.shape().as_ball());
    ball.map_or_else(
        || (3.0 * mass / (4.0 * PI * material.density)).cbrt(),
        |ball| f64::from(ball.radius),
    )
}

/// Push between two bodies; `None` if nothing pushes, or none of them sounds.
fn push(
    pair: &ContactPair,
    bodies: &Query<Moving>,
    node: &dyn Fn(Entity) -> Option<usize>,
) -> Option<Push> {
    let all = pair.manifolds.iter().flat_map(|manifold| {
        let points = manifold.points.iter();
        points.map(move |point| (manifold, point))
    });
    // A sum of vectors: pushes from opposite sides cancel. Avian counts each substep twice, once with its push-out and once without.
    let push: Vec3 = all
        .clone()
        .map(|(manifold, point)| manifold.normal * (0.5 * point.normal_impulse))
        .sum();
    let impulse = push.length();
    if impulse.is_nan() || impulse <= 0.0 {
        return None;
    }
    let (manifold, deepest) =
        all.max_by(|a, b| a.1.normal_impulse.total_cmp(&b.1.normal_impulse))?;
    let followed = |body: Option<Entity>| {
        let (entity, kind, .., mass, _) = bodies.get(body?).ok()?;
        let mass = if kind.is_dynamic() {
            mass.value()
        } else {
            f32::INFINITY
        };
        Some((node(entity)?, mass))
    };
    let (nodes, lightest, flip) = match [pair.body1, pair.body2].map(followed) {
        [Some(a), Some(b)] => ((a.0, Some(b.0)), a.1.min(b.1), false),
        [Some(a), None] => ((a.0, None), a.1, false),
        [None, Some(b)] => ((b.0, None), b.1, true),
        [None, None] => return None,
    };
    let turned = |body: Option<Entity>, anchor: Vec3| {
        let body = body.and_then(|body| bodies.get(body).ok());
        into(body.map_or(anchor, |(_, _, _, turn, ..)| turn.0.inverse() * anchor))
    };
    let mut places = [
        turned(pair.body1, deepest.anchor1),
        turned(pair.body2, deepest.anchor2),
    ];
    let mut names = [pair.body1, pair.body2].map(|body| body.map(Entity::to_bits));
    if flip {
        places.reverse();
        names.reverse();
    }
    Some(Push {
        colliders: [pair.collider1, pair.collider2].map(Entity::to_bits),
        nodes,
        bodies: names,
        lightest,
        point: into(deepest.point),
        // Avian's normals point from the first collider to the second.
        normal: into(push / impulse * if flip { 1.0 } else { -1.0 }),
        places,
        impulse,
        friction: manifold.friction,
    })
}

/// Motion of each dynamic body.
fn motions(bodies: &Query<Moving>) -> BTreeMap<u64, EngineMotion> {
    let moving = bodies.iter().filter(|(_, kind, ..)| kind.is_dynamic());
    let motion = moving.map(|(entity, _, at, turn, linear, angular, _, centre)| {
        let motion = [linear.0, angular.0, at.0 + turn.0 * centre.0];
        (entity.to_bits(), motion.map(into))
    });
    motion.collect()
}
