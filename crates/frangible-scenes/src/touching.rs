//! What touches, what slides and what rolls, found in a world step by step.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible_export::{RecordedSlide, RecordedTouch};
use frangible_rapier::BreakableWorld;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::geometry::{Collider, ContactPair};

/// A touch that changes the lighter body's speed by less than this is none, m/s.
const AUDIBLE: f32 = 0.02;

/// What lies is pushed by its weight in every step, and when contacts come and go by a multiple of it: so many are no touch.
const LYING: f32 = 3.0;

/// Time between two looks at what slides and rolls, s.
const SLIDES: f64 = 1.0 / 240.0;

/// What has not touched for so long touches anew, s: what rolls pushes in every second step or so.
const LIFTED: f64 = 4.0 * SLIDES;

/// A contact that rolls travels as fast as the body turns about it; faster than so many times this it has hopped from one place to another.
const HOPPED: f32 = 2.0;

/// Slower contacts rest or roll, m/s: the solver leaves about this much to what lies.
const SLIDING: f32 = 0.02;

/// Friction that takes less is not heard, W: of 0.1 mW a ten-millionth is sound at best, which are 10 dB a metre away.
const LEAST_POWER: f64 = 1e-4;

/// Notices what comes together, by what pushed in the step before.
#[derive(Default)]
pub(crate) struct Touching {
    /// Impulse of each pair of colliders in the latest step, N·s.
    pushed: BTreeMap<[(u32, u32); 2], f32>,
    /// Velocity, m/s, angular velocity, rad/s, and centre of mass, m, of each body after the latest step.
    moving: BTreeMap<(u32, u32), Motion>,
    /// Steps so far.
    steps: u64,
    /// When what slides was looked at, s.
    looked: f64,
    /// Where each pair touched last, m, in the frames of its two colliders, and when, s.
    places: BTreeMap<[(u32, u32); 2], Touched>,
}

type Motion = [Vec3; 3];

type Touched = ([Vec3; 2], f64);

/// Two things that push each other in a step.
struct Pair {
    nodes: (usize, Option<usize>),
    /// Mass of the lighter one that moves, kg.
    lightest: f32,
    /// Where, m, and the unit direction of the push on the first node.
    point: Vec3,
    normal: Vec3,
    /// Where it is in the frames of the two colliders, m.
    places: [Vec3; 2],
    /// N·s.
    impulse: f32,
    friction: f32,
    /// Bodies of the colliders.
    bodies: [Option<RigidBodyHandle>; 2],
}

impl Touching {
    /// What came together in the step that ended `time` s after the first frame, and what slides or rolls: `node` numbers the bodies that are
    /// followed.
    ///
    /// A touch is where a pair of colliders pushes more than twice as hard as in the step before, and changes the speed of the lighter body by
    /// more than 2 cm/s beyond what its weight does. When within its step it came is not known. All touches of a step at its end would be heard as
    /// one loud clap, and steps as a tone of their own, so that each is put at a moment of the step that is drawn for it.
    pub(crate) fn step(
        &mut self,
        world: &BreakableWorld,
        node: &dyn Fn(RigidBodyHandle) -> Option<usize>,
        time: f64,
    ) -> (Vec<RecordedTouch>, Vec<RecordedSlide>) {
        let physics = &world.physics;
        let step = physics.integration_parameters.dt;
        let gravity = physics.gravity.length();
        let before = std::mem::take(&mut self.pushed);
        let now = motions(world);
        let moving = std::mem::replace(&mut self.moving, now);
        self.steps += 1;
        let since = time - self.looked;
        let looks = since > SLIDES - 1e-9;
        if looks {
            self.looked = time;
        }
        let (mut touches, mut slides) = (Vec::new(), Vec::new());
        self.places.retain(|_, (_, then)| time - *then < LIFTED);
        for contact in physics.narrow_phase.contact_pairs() {
            // A sum of vectors: what is pushed from both sides goes nowhere.
            let push = Vec3::from(contact.total_impulse().to_array());
            if push == Vec3::ZERO {
                continue;
            }
            let key = [contact.collider1, contact.collider2].map(|c| c.into_raw_parts());
            let known = before.get(&key).copied().unwrap_or(0.0);
            self.pushed.insert(key, push.length());
            let Some(pair) = pair(world, contact, push, node) else {
                continue;
            };
            let [a, b] = pair.bodies.map(|body| speed_at(&moving, body, pair.point));
            let least = (AUDIBLE + LYING * step * gravity) * pair.lightest;
            if pair.impulse >= least.max(2.0 * known) {
                let speed = (a - b).dot(push / pair.impulse);
                let drawn = [
                    self.steps,
                    pair.nodes.0 as u64,
                    pair.nodes.1.map_or(0, |n| n as u64 + 1),
                ];
                touches.push(RecordedTouch {
                    time: time - f64::from(step) * drawn_share(drawn),
                    nodes: pair.nodes,
                    point: pair.point,
                    normal: pair.normal,
                    impulse: f64::from(pair.impulse),
                    speed: f64::from(speed + step * gravity).max(0.0),
                });
            } else if looks {
                let look = [time, since];
                slides.extend(slide(&pair, &self.moving, f64::from(step), look));
                let now = (pair.places, time);
                if let Some((before, then)) = self.places.insert(key, now) {
                    let arm = world.config().rolling_arm / step;
                    let before = (before, time - then);
                    slides.extend(roll(&pair, &self.moving, before, arm, look));
                }
            }
        }
        (touches, slides)
    }
}

/// What slides, if it does: by Coulomb's law, from the normal force and the speed along the surfaces.
fn slide(
    pair: &Pair,
    moving: &BTreeMap<(u32, u32), Motion>,
    step: f64,
    [time, since]: [f64; 2],
) -> Option<RecordedSlide> {
    let [a, b] = pair.bodies.map(|body| speed_at(moving, body, pair.point));
    let along = (a - b).reject_from(pair.normal);
    let speed = f64::from(along.length());
    let power = f64::from(pair.friction * pair.impulse) / step * speed;
    (along.length() > SLIDING && power > LEAST_POWER).then(|| RecordedSlide {
        time,
        duration: since.min(2.0 * SLIDES),
        nodes: pair.nodes,
        point: pair.point,
        normal: pair.normal,
        speed,
        power,
    })
}

/// What rolls, if it does: its contact travels over both surfaces, from where it was so many seconds `before`. What the resistance to rolling
/// takes is its torque, the normal force at an arm, times how fast the two turn about each other. `arm`: that arm over the step's time, m/s.
fn roll(
    pair: &Pair,
    moving: &BTreeMap<(u32, u32), Motion>,
    (before, ago): ([Vec3; 2], f64),
    arm: f32,
    [time, since]: [f64; 2],
) -> Option<RecordedSlide> {
    let [a, b] = pair.bodies.map(|body| {
        let motion = body.and_then(|body| moving.get(&body.into_raw_parts()));
        motion
            .copied()
            .unwrap_or([Vec3::ZERO, Vec3::ZERO, pair.point])
    });
    let turning = (a[1] - b[1]).reject_from(pair.normal);
    let farthest = a[2].distance(pair.point).max(b[2].distance(pair.point));
    let travelled = [0, 1].map(|k| before[k].distance(pair.places[k]));
    let speed = travelled[0].min(travelled[1]) / ago as f32;
    let power = f64::from(pair.impulse * arm * turning.length());
    let hopped = speed > HOPPED * turning.length() * farthest;
    (speed > SLIDING && !hopped && power > LEAST_POWER).then(|| RecordedSlide {
        time,
        duration: since.min(2.0 * SLIDES),
        nodes: pair.nodes,
        point: pair.point,
        normal: pair.normal,
        speed: f64::from(speed),
        power,
    })
}

/// Who pushes whom and where; `None` unless one of them is followed.
fn pair(
    world: &BreakableWorld,
    contact: &ContactPair,
    push: Vec3,
    node: &dyn Fn(RigidBodyHandle) -> Option<usize>,
) -> Option<Pair> {
    let physics = &world.physics;
    let colliders = [contact.collider1, contact.collider2];
    let bodies = colliders.map(|c| physics.colliders.get(c).and_then(Collider::parent));
    let followed = |body: Option<RigidBodyHandle>| {
        let body = body?;
        Some((node(body)?, physics.bodies.get(body)?.mass()))
    };
    let (nodes, lightest, flip) = match bodies.map(followed) {
        [Some(a), Some(b)] => ((a.0, Some(b.0)), a.1.min(b.1), false),
        [Some(a), None] => ((a.0, None), a.1, false),
        [None, Some(b)] => ((b.0, None), b.1, true),
        [None, None] => return None,
    };
    let (manifold, deepest) = contact.find_deepest_contact()?;
    let at = physics.colliders.get(contact.collider1)?;
    let at = at.position().transform_point(deepest.local_p1);
    let impulse = push.length();
    Some(Pair {
        nodes,
        lightest,
        point: Vec3::from(at.to_array()),
        places: [deepest.local_p1, deepest.local_p2].map(|p| Vec3::from(p.to_array())),
        // Rapier's normals point from the first collider to the second.
        normal: push / impulse * if flip { 1.0 } else { -1.0 },
        impulse,
        friction: manifold.data.friction,
        bodies,
    })
}

/// Velocity of a body at a point, m/s; of what does not move, zero.
fn speed_at(
    moving: &BTreeMap<(u32, u32), Motion>,
    body: Option<RigidBodyHandle>,
    point: Vec3,
) -> Vec3 {
    let motion = body.and_then(|body| moving.get(&body.into_raw_parts()));
    motion.map_or(Vec3::ZERO, |[velocity, spin, centre]| {
        *velocity + spin.cross(point - *centre)
    })
}

/// Velocity, angular velocity and centre of mass of each body that moves.
fn motions(world: &BreakableWorld) -> BTreeMap<(u32, u32), Motion> {
    let bodies = world.physics.bodies.iter().filter(|(_, b)| b.is_dynamic());
    let motion = bodies.map(|(handle, body)| {
        let motion = [body.linvel(), body.angvel(), body.center_of_mass()];
        let motion = motion.map(|v| Vec3::from(v.to_array()));
        (handle.into_raw_parts(), motion)
    });
    motion.collect()
}

/// A number from 0 to 1 that hangs on these alone: rounds of splitmix64.
pub(crate) fn drawn_share(key: [u64; 3]) -> f64 {
    let mixed = key.iter().fold(0, |state: u64, &k| {
        let x = (state ^ k).wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    });
    (mixed >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use frangible_rapier::rapier3d::math::{Pose, Vector};
    use frangible_rapier::{Ball, SurfaceProperties, WorldConfig};

    use super::*;

    const RADIUS: f32 = 0.02;
    const MASS: f32 = 0.5;

    /// What slides or rolls where a steel ball is thrown along a stone floor at 1 m/s, turning so fast, rad/s.
    fn thrown(spin: f32) -> Vec<RecordedSlide> {
        let mut world = BreakableWorld::new(WorldConfig::default()).expect("a world");
        world
            .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
            .expect("a floor");
        let ball = Ball {
            mass: MASS,
            radius: RADIUS,
        };
        let at = Pose::from_translation(Vector::new(0.0, RADIUS, 0.0));
        let ball = world.insert_ball(ball, SurfaceProperties::STEEL, at, Vector::X);
        let ball = ball.expect("a ball");
        let body = &mut world.physics.bodies[ball];
        body.set_angvel(Vector::new(0.0, 0.0, -spin), true);
        let node = |handle| (handle == ball).then_some(0);
        let mut touching = Touching::default();
        let mut heard = Vec::new();
        for _ in 0..60 {
            world.step().expect("a step");
            heard.extend(touching.step(&world, &node, world.time()).1);
        }
        heard
    }

    #[test]
    fn a_ball_that_rolls_is_recorded_with_what_its_rolling_takes() {
        let rolls = thrown(1.0 / RADIUS);
        assert!(rolls.len() > 10, "{}", rolls.len());
        let arm = WorldConfig::default().rolling_arm;
        let mut taken = 0.0;
        for roll in &rolls {
            assert!((0.9..1.05).contains(&roll.speed), "{roll:?}");
            taken += roll.power * roll.duration;
        }
        // A quarter of a second at 1 m/s. The engine pushes now and then, and on the whole with the ball's weight.
        let turned = 0.25 / f64::from(RADIUS);
        let expected = f64::from(MASS * 9.81 * arm) * turned;
        assert!(
            (0.8..1.1).contains(&(taken / expected)),
            "{taken} J of {expected} J"
        );
        // Without spin it slides first, and friction takes far more.
        let slides = thrown(0.0);
        assert!(slides[0].power > 5.0 * rolls[0].power, "{:?}", slides[0]);
    }
}
