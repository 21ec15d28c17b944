//! Detection of touches, slides and rolling from the contacts reported by a physics engine in each step.

use std::collections::BTreeMap;

use frangible_recording::{RecordedSlide, RecordedTouch};
use glam::Vec3;

/// A touch that changes the lighter body's speed by less than this is none, m/s.
const AUDIBLE: f32 = 0.02;

/// Multiple of a body's weight up to which a push is no touch: weight pushes in every step, and more when contacts come and go.
const LYING: f32 = 3.0;

/// Time between two looks at what slides and rolls, s.
const SLIDES: f64 = 1.0 / 240.0;

/// Time without contact after which a pair touches anew, s: a rolling body pushes in every second step or so.
const LIFTED: f64 = 4.0 * SLIDES;

/// A rolling contact travels as fast as the body turns about it; one faster than this multiple has hopped from one place to another.
const HOPPED: f32 = 2.0;

/// Slower contacts rest or roll, m/s: the solver leaves about this speed to lying bodies.
const SLIDING: f32 = 0.02;

/// Friction that takes less is not heard, W: of 0.1 mW a ten-millionth is sound at best, which are 10 dB a metre away.
const LEAST_POWER: f64 = 1e-4;

/// Motion of a body: velocity, m/s, angular velocity, rad/s, and centre of mass, m.
pub type EngineMotion = [Vec3; 3];

/// A contact in a step: between a tracked object and another object or a fixed body. Bodies and colliders are identified by the
/// engine's numbers.
#[derive(Clone, Copy, Debug)]
pub struct Push {
    /// Identifiers of the two colliders, which must stay the same from step to step.
    pub colliders: [u64; 2],
    /// Numbers of the objects; `None` for an object that is not tracked.
    pub nodes: (usize, Option<usize>),
    /// Identifiers of the bodies, in the order of the objects; `None` for a collider without a body.
    pub bodies: [Option<u64>; 2],
    /// Mass of the lighter moving body, kg.
    pub lightest: f32,
    /// Position of the contact, m.
    pub point: Vec3,
    /// Unit direction of the force on the first object.
    pub normal: Vec3,
    /// Position of the contact in the frames of the two colliders, m, in the order of the objects.
    pub places: [Vec3; 2],
    /// Impulse along the normal in the step, N·s.
    pub impulse: f32,
    /// Coefficient of friction.
    pub friction: f32,
}

/// Properties of a step of the physics engine.
#[derive(Clone, Copy, Debug)]
pub struct EngineStep {
    /// Time at the end of the step, s.
    pub time: f64,
    /// Length of the step, s.
    pub length: f32,
    /// Acceleration of gravity, m/s².
    pub gravity: f32,
    /// Lever arm of rolling resistance, m: the distance of the resultant pressure ahead of the contact's normal; zero without rolling
    /// resistance.
    pub rolling_arm: f32,
}

/// Detects touches by comparing the contacts of a step with those of the previous step.
#[derive(Clone, Debug, Default)]
pub struct Touching {
    /// Impulse of each pair of colliders in the latest step, N·s.
    pushed: BTreeMap<[u64; 2], f32>,
    /// Motion of each body after the latest step.
    moving: BTreeMap<u64, EngineMotion>,
    /// Number of steps so far.
    steps: u64,
    /// Time of the last check for slides and rolling, s.
    looked: f64,
    /// Last contact of each pair: its position in the frames of the two colliders, m, and its time, s.
    places: BTreeMap<[u64; 2], Touched>,
}

type Touched = ([Vec3; 2], f64);

impl Touching {
    /// Detects the touches, slides and rolling of a step from all its contacts and the motion of the bodies after it.
    ///
    /// A pair of colliders touches if its impulse is more than twice that of the previous step, and changes the velocity of the lighter
    /// body by more than 2 cm/s in addition to its weight. The exact time within the step is unknown. If all touches were placed at the
    /// end of the step, they would sound like one loud clap, and the steps like a tone; each touch therefore gets a random time in the step.
    pub fn step(
        &mut self,
        step: &EngineStep,
        pushes: &[Push],
        motions: BTreeMap<u64, EngineMotion>,
    ) -> (Vec<RecordedTouch>, Vec<RecordedSlide>) {
        let (time, length) = (step.time, step.length);
        let before = std::mem::take(&mut self.pushed);
        let moving = std::mem::replace(&mut self.moving, motions);
        self.steps += 1;
        let since = time - self.looked;
        let looks = since > SLIDES - 1e-9;
        if looks {
            self.looked = time;
        }
        let (mut touches, mut slides) = (Vec::new(), Vec::new());
        self.places.retain(|_, (_, then)| time - *then < LIFTED);
        for push in pushes {
            let known = before.get(&push.colliders).copied().unwrap_or(0.0);
            self.pushed.insert(push.colliders, push.impulse);
            let [a, b] = push.bodies.map(|body| speed_at(&moving, body, push.point));
            let least = (AUDIBLE + LYING * length * step.gravity) * push.lightest;
            if push.impulse >= least.max(2.0 * known) {
                let speed = (b - a).dot(push.normal);
                let drawn = [
                    self.steps,
                    push.nodes.0 as u64,
                    push.nodes.1.map_or(0, |n| n as u64 + 1),
                ];
                touches.push(RecordedTouch {
                    time: time - f64::from(length) * drawn_share(drawn),
                    nodes: push.nodes,
                    point: push.point,
                    normal: push.normal,
                    impulse: f64::from(push.impulse),
                    speed: f64::from(speed + length * step.gravity).max(0.0),
                });
            } else if looks {
                let look = [time, since];
                slides.extend(slide(push, &self.moving, f64::from(length), look));
                let now = (push.places, time);
                if let Some((before, then)) = self.places.insert(push.colliders, now) {
                    let arm = step.rolling_arm / length;
                    let before = (before, time - then);
                    slides.extend(roll(push, &self.moving, before, arm, look));
                }
            }
        }
        (touches, slides)
    }
}

/// The slide at a push, if there is one: by Coulomb's law, from the normal force and the speed along the surfaces.
fn slide(
    push: &Push,
    moving: &BTreeMap<u64, EngineMotion>,
    step: f64,
    [time, since]: [f64; 2],
) -> Option<RecordedSlide> {
    let [a, b] = push.bodies.map(|body| speed_at(moving, body, push.point));
    let along = (a - b).reject_from(push.normal);
    let speed = f64::from(along.length());
    let power = f64::from(push.friction * push.impulse) / step * speed;
    (along.length() > SLIDING && power > LEAST_POWER).then(|| RecordedSlide {
        time,
        duration: since.min(2.0 * SLIDES),
        nodes: push.nodes,
        point: push.point,
        normal: push.normal,
        speed,
        power,
    })
}

/// The rolling at a push, if there is any: the contact travels over both surfaces, from its places `before`. The power lost to the resistance to
/// rolling is its torque, the normal force at an arm, times how fast the two turn about each other. `arm`: that arm over the step's time, m/s.
fn roll(
    push: &Push,
    moving: &BTreeMap<u64, EngineMotion>,
    (before, ago): ([Vec3; 2], f64),
    arm: f32,
    [time, since]: [f64; 2],
) -> Option<RecordedSlide> {
    let [a, b] = push.bodies.map(|body| {
        let motion = body.and_then(|body| moving.get(&body));
        motion
            .copied()
            .unwrap_or([Vec3::ZERO, Vec3::ZERO, push.point])
    });
    let turning = (a[1] - b[1]).reject_from(push.normal);
    let farthest = a[2].distance(push.point).max(b[2].distance(push.point));
    let travelled = [0, 1].map(|k| before[k].distance(push.places[k]));
    let speed = travelled[0].min(travelled[1]) / ago as f32;
    let power = f64::from(push.impulse * arm * turning.length());
    let hopped = speed > HOPPED * turning.length() * farthest;
    (speed > SLIDING && !hopped && power > LEAST_POWER).then(|| RecordedSlide {
        time,
        duration: since.min(2.0 * SLIDES),
        nodes: push.nodes,
        point: push.point,
        normal: push.normal,
        speed: f64::from(speed),
        power,
    })
}

/// Velocity of a body at a point, m/s; zero for a fixed one.
fn speed_at(moving: &BTreeMap<u64, EngineMotion>, body: Option<u64>, point: Vec3) -> Vec3 {
    let motion = body.and_then(|body| moving.get(&body));
    motion.map_or(Vec3::ZERO, |[velocity, spin, centre]| {
        *velocity + spin.cross(point - *centre)
    })
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
