//! A tick: position and velocity of the probe in; force, displacement of the surface and news of the body out.
//!
//! - The force is that of a spring and a damper along the surface's normal, as haptic devices render contact: kilonewtons per
//!   metre, a hundredth of what the surface itself would answer with. While the probe is inside, the surface point slides with it and
//!   is not looked for anew, so that it is not pushed out on the other side of a thin body.
//! - The surface gives way by its vibration under that force: quasi-static and dynamic, exact over the tick ([`LiveModes`]).
//! - The first tick of a contact is a blow: the impulse that rigid bodies exchange at the speed of approach, in the time that two
//!   elastic bodies take. Most are refused at once. Else cracks and pieces are made on another thread, to be there [`DELAY`](crate::judge::DELAY) ticks
//!   later.
//! - One question at a time: until it is answered the body is whole, and no other blow is asked about.
//! - In the other ticks of a contact the force presses. One number per body clears that nearly always.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::{Force, Stage, Vibration, rest_margin_at_least};
use frangible::{Body, Contact, Fracture, FractureConfig, InputError, Outcome, Striker};

use crate::judge::{Case, Judge};
use crate::live::{LiveModes, SurfacePlace};

/// Length of a tick, s.
pub(crate) const TICK: f64 = 1e-3;

/// Tip of the probe, and the spring and damper of its contact.
#[derive(Clone, Debug)]
pub(crate) struct Probe {
    /// Radius of the tip, m.
    pub(crate) radius: f32,
    /// Striker of its blows.
    pub(crate) striker: Striker,
    /// Spring of the contact, N/m.
    pub(crate) stiffness: f32,
    /// Damper of the contact, N·s/m.
    pub(crate) damping: f32,
}

/// Kind of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The probe touches nothing.
    Free,
    /// The probe presses or slides.
    Contact,
    /// The probe has just met the surface, too softly for any crack.
    Blow,
    /// A crack may start: another thread looks for cracks and pieces.
    Asked,
    /// The other thread's answer is there.
    Verdict,
}

/// Result of a tick.
#[derive(Clone, Debug)]
pub(crate) struct Felt {
    /// Kind of the tick.
    pub(crate) kind: Kind,
    /// Force on the probe, N.
    pub(crate) force: Vec3,
    /// Displacement of the surface at the contact by vibration, m, from its position of rest; zero without contact.
    pub(crate) displacement: Vec3,
    /// The quasi-static part of it, m.
    pub(crate) at_rest: Vec3,
    /// The pieces, in the tick in which they are there.
    pub(crate) pieces: Option<Box<Fracture>>,
}

impl Felt {
    const fn nothing() -> Self {
        Self {
            kind: Kind::Free,
            force: Vec3::ZERO,
            displacement: Vec3::ZERO,
            at_rest: Vec3::ZERO,
            pieces: None,
        }
    }
}

/// A body that is touched.
pub(crate) struct Touch {
    body: Arc<Body>,
    config: FractureConfig,
    probe: Probe,
    live: LiveModes,
    place: SurfacePlace,
    inside: bool,
    /// True once it broke: there is nothing left to touch.
    gone: bool,
    tick: u64,
    judge: Judge,
}

impl Touch {
    /// A whole body at rest.
    ///
    /// # Errors
    /// None to be expected.
    pub(crate) fn new(
        body: Body,
        probe: Probe,
        config: &FractureConfig,
    ) -> Result<Self, InputError> {
        // Made when it is first asked for, which should not be in a tick.
        let _ = rest_margin_at_least(&body, 0.0, 0.0, 1.0);
        Ok(Self {
            live: LiveModes::new(&body, TICK)?,
            place: SurfacePlace::nearest(&body, Vec3::ZERO)?,
            body: Arc::new(body),
            config: config.clone(),
            probe,
            inside: false,
            gone: false,
            tick: 0,
            judge: Judge::new(config.clone()),
        })
    }

    /// Puts another whole body in the place of this one, once no question about it is open.
    ///
    /// # Errors
    /// None to be expected.
    pub(crate) fn replace(&mut self, body: Body) -> Result<(), InputError> {
        self.live = LiveModes::new(&body, TICK)?;
        self.body = Arc::new(body);
        (self.inside, self.gone) = (false, false);
        Ok(())
    }

    /// Returns true if cracks and pieces are due in the coming tick.
    pub(crate) fn expects_verdict(&self) -> bool {
        self.judge.is_due(self.tick + 1)
    }

    /// The judge, which makes cracks and pieces.
    pub(crate) fn judge(&mut self) -> &mut Judge {
        &mut self.judge
    }

    /// A tick: the centre of the probe's tip, m, and its velocity, m/s, in the body frame. When its force is given out, let
    /// [`Judge::hand_over`] follow.
    ///
    /// # Errors
    /// A position or velocity that is not finite.
    pub(crate) fn tick(&mut self, position: Vec3, velocity: Vec3) -> Result<Felt, InputError> {
        self.tick += 1;
        if self.gone {
            return Ok(Felt::nothing());
        }
        let normal = self.place.normal;
        let on_plane = position - normal * (position - self.place.position).dot(normal);
        let near = if self.inside { on_plane } else { position };
        self.place.seek(&self.body, near)?;
        let (push, displacement, at_rest) = self.contact(position, velocity);
        let first = push > 0.0 && !self.inside;
        self.inside = push > 0.0;
        let mut felt = Felt {
            force: self.place.normal * push,
            displacement,
            at_rest,
            ..Felt::nothing()
        };
        if self.inside {
            felt.kind = Kind::Contact;
        }
        if let Some(kind) = self.question(first, velocity, felt.force)? {
            felt.kind = kind;
        }
        if let Some(verdict) = self.judge.verdict(self.tick) {
            felt.kind = Kind::Verdict;
            felt.pieces = self.take_note(verdict?)?;
        }
        Ok(felt)
    }

    /// The size of the contact's force, N, and the displacement of the surface, m: now, and when all has come to rest.
    fn contact(&mut self, position: Vec3, velocity: Vec3) -> (f32, Vec3, Vec3) {
        let (place, probe) = (&self.place, &self.probe);
        let moved = self.live.displacement(place).dot(place.normal);
        let gap = (position - place.position).dot(place.normal) - moved - probe.radius;
        let push = if gap < 0.0 {
            let parting = (velocity - self.live.velocity(place)).dot(place.normal);
            (-probe.stiffness * gap - probe.damping * parting).max(0.0)
        } else {
            0.0
        };
        if push > 0.0 {
            self.live.push(place, place.normal * -push);
        }
        self.live.step();
        if push > 0.0 {
            let at_rest = self.live.static_displacement(place);
            (push, self.live.displacement(place), at_rest)
        } else {
            (0.0, Vec3::ZERO, Vec3::ZERO)
        }
    }

    /// Asks if a crack starts, unless one is being computed already. Returns the kind of the tick.
    fn question(
        &mut self,
        first: bool,
        velocity: Vec3,
        force: Vec3,
    ) -> Result<Option<Kind>, InputError> {
        if !self.inside || self.judge.is_busy() {
            return Ok(None);
        }
        if first {
            return Ok(Some(self.blow(velocity)?));
        }
        // One number per body clears nearly all that presses.
        if rest_margin_at_least(&self.body, force.length(), 0.0, self.config.load_duration) > 1.0 {
            return Ok(None);
        }
        let press = Force {
            point: self.place.position,
            force: -force,
        };
        self.judge.ask(self.tick, &self.body, Case::Press(press));
        Ok(Some(Kind::Asked))
    }

    /// Asks about a blow, which is mostly refused at once.
    fn blow(&mut self, velocity: Vec3) -> Result<Kind, InputError> {
        let (body, inward) = (&self.body, -self.place.normal);
        let speed = f64::from(velocity.dot(inward).max(0.0));
        let striker = self.probe.striker.clone();
        let hit = Contact::collision(body.asset(), self.place.position, inward, speed, striker);
        match Vibration::begin(body, &[hit], &self.config)? {
            Stage::Held(_) => Ok(Kind::Blow),
            Stage::Vibrates(vibration) => {
                let case = Case::Impact(Box::new(vibration));
                self.judge.ask(self.tick, &self.body, case);
                Ok(Kind::Asked)
            }
        }
    }

    /// The pieces, or the body's own cracks.
    fn take_note(&mut self, verdict: Outcome) -> Result<Option<Box<Fracture>>, InputError> {
        match verdict {
            Outcome::Broke(fracture) => {
                self.gone = true;
                return Ok(Some(fracture));
            }
            Outcome::Held {
                state: Some(state), ..
            } => Arc::make_mut(&mut self.body).set_state(*state)?,
            _ => {}
        }
        Ok(None)
    }
}
