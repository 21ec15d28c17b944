//! Steps, throws, breaks and undo.

use std::sync::Arc;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_rapier::rapier3d::math::Pose as RapierPose;
use frangible_rapier::{BreakCause, BreakEvent, HeldEvent};
use frangible_recording::Pose;
use frangible_scenes::{LiveScene, ThingKind, Throw};

use super::Session;
use crate::blow::Blow;
use crate::camera::Ray;
use crate::command::{BallSpec, Command, Subject, Tool};
use crate::error::{ViewError, within};
use crate::picking::pick;

/// Simulated time between states that are put aside, s: an undone break is at most so far off.
const SAVE_EVERY: f64 = 1.0 / 60.0;

/// Breaks that can be undone.
const UNDOABLE: usize = 20;

/// Start of a thrown ball before its target, as a share of the way from the eye; nearer it would fill the picture.
const START: f32 = 0.35;

/// Distance that a ball flies when it is thrown at nothing, m.
const INTO_THE_BLUE: f32 = 3.0;

impl Session {
    /// Takes one step.
    ///
    /// # Errors
    /// The fracture model rejected an impact; the scene can continue.
    pub fn step(&mut self) -> Result<(), ViewError> {
        self.put_aside();
        self.pull_along();
        let Some(live) = self.live.as_mut() else {
            return Ok(());
        };
        let before = live.time();
        let stepped = live.step();
        let passed = (live.time() - before) / self.slow_motion;
        self.reel.note(live, passed);
        self.steps += 1;
        self.stale = true;
        match self.log.last_mut() {
            Some(Command::Step(count)) => *count += 1,
            _ => self.log.push(Command::Step(1)),
        }
        self.hear();
        self.listen_to_step();
        Ok(stepped?)
    }

    /// Takes one of the steps that a command asked for.
    pub(crate) fn take_owed_step(&mut self) -> Result<(), ViewError> {
        self.owed = self.owed.saturating_sub(1);
        self.step().inspect_err(|error| self.complain(error))
    }

    /// Returns true if a command still wants steps.
    pub(crate) fn owes(&self) -> bool {
        self.owed > 0 || self.time() < self.owed_until - 1e-9
    }

    /// Puts the state aside once in a while, as long as something may break.
    fn put_aside(&mut self) {
        let Some(live) = self.live.as_ref() else {
            return;
        };
        let due = |last: &frangible_scenes::SavedScene| live.time() - last.time() >= SAVE_EVERY;
        if self.recent.as_ref().is_none_or(due) && live.world().breakables().next().is_some() {
            self.recent = Some(live.save());
        }
    }

    /// Takes note of breaks and of blows that held in the last step.
    fn hear(&mut self) {
        let Some(live) = self.live.as_ref() else {
            return;
        };
        let breaks: Vec<Blow> = live
            .world()
            .breaks()
            .iter()
            .filter_map(|event| broken(live, event))
            .collect();
        let held = live.world().held().iter();
        let hardest = held.max_by(|a, b| a.report.stress_bound.total_cmp(&b.report.stress_bound));
        let held = hardest.and_then(|event| withstood(live, event));
        let timings = *live.world().timings();
        if let Some(blow) = breaks.into_iter().next_back() {
            let before = self.blow.replace(Arc::new(blow));
            self.break_step = timings;
            self.forget_analysis();
            if let Some(saved) = self.recent.take() {
                self.undo.push((saved, before, self.steps));
                if self.undo.len() > UNDOABLE {
                    self.undo.remove(0);
                }
            }
        } else if let Some(held) = held {
            let harder = match &self.blow {
                Some(known) => {
                    known.fracture.is_none() && held.report.stress_bound > known.report.stress_bound
                }
                None => true,
            };
            if harder {
                self.blow = Some(Arc::new(held));
                self.forget_analysis();
            }
        }
    }

    fn forget_analysis(&mut self) {
        self.analysis = None;
        self.analysis_job = None;
    }

    pub(super) fn choose_ball(&mut self, ball: BallSpec) -> Result<(), ViewError> {
        Material::preset(&ball.material)?;
        within("the ball's mass", ball.mass, [1e-6, 1e4], "kg")?;
        within("the ball's radius", ball.radius, [5e-4, 1.0], "m")?;
        within("the ball's speed", ball.speed, [0.01, 400.0], "m/s")?;
        self.ball = ball;
        self.tool = Tool::Ball;
        Ok(())
    }

    pub(super) fn throw(&mut self, from: Vec3, through: Vec3) -> Result<(), ViewError> {
        let explode = self.explode as f32;
        let ball = self.ball.clone();
        let direction = (through - from).normalize_or_zero();
        let live = self.running()?;
        let ray = Ray {
            origin: from,
            direction,
        };
        // Where the ray meets something the ball's path is bent to meet it too.
        let met = pick(live, explode, ray).map_or(INTO_THE_BLUE, |met| met.distance);
        live.throw(&Throw {
            mass: ball.mass,
            radius: ball.radius,
            speed: ball.speed,
            material: ball.material,
            from: from + START * met * direction,
            through: from + met * direction,
        })?;
        Ok(())
    }

    pub(super) fn undo_break(&mut self) -> Result<(), ViewError> {
        let Some((saved, blow, _)) = self.undo.pop() else {
            return Err(ViewError::NotNow("nothing has broken yet".into()));
        };
        let live = self.running()?;
        live.restore(&saved);
        self.grip = None;
        self.listen_anew();
        self.blow = blow;
        self.recent = None;
        self.forget_analysis();
        self.compared = None;
        self.set_subject(Subject::World);
        self.paused = true;
        self.say("back to just before the break; the simulation is paused".into());
        Ok(())
    }
}

fn pose_of(pose: &RapierPose) -> Pose {
    Pose {
        translation: Vec3::from(pose.translation.to_array()),
        rotation: Quat::from_array(pose.rotation.to_array()),
    }
}

fn broken(live: &LiveScene, event: &BreakEvent) -> Option<Blow> {
    let (thing, name, number) = named(live, event.parent)?;
    Some(Blow {
        name,
        thing,
        number,
        body: live.body_before(event.parent)?.clone(),
        pose: pose_of(&event.pose),
        contacts: event.contacts.clone(),
        cause: event.cause,
        config: live.world().config().fracture.clone(),
        report: event.fracture.report.clone(),
        fracture: Some(Arc::clone(&event.fracture)),
        energy_paid: event.energy_paid,
        time: live.time(),
    })
}

fn withstood(live: &LiveScene, event: &HeldEvent) -> Option<Blow> {
    let (thing, name, number) = named(live, event.body)?;
    let pose = live.world().physics.bodies.get(event.body)?.position();
    Some(Blow {
        name,
        thing,
        number,
        body: live.body_before(event.body)?.clone(),
        pose: pose_of(pose),
        contacts: event.contacts.clone(),
        cause: BreakCause::Impact,
        config: live.world().config().fracture.clone(),
        report: event.report.clone(),
        fracture: None,
        energy_paid: 0.0,
        time: live.time(),
    })
}

fn named(
    live: &LiveScene,
    handle: frangible_rapier::rapier3d::dynamics::RigidBodyHandle,
) -> Option<(usize, String, Option<usize>)> {
    let things = live.things();
    let thing = things.iter().rposition(|thing| thing.handle == handle)?;
    let number = match things[thing].kind {
        ThingKind::Body(number) => Some(number),
        _ => None,
    };
    Some((thing, things[thing].name.clone(), number))
}
