//! Execution of commands, and their recording as a script that reproduces the session.

use frangible_recording::View;
use frangible_scenes::scene;

use super::Session;
use crate::baking::scene_in;
use crate::command::Command;
use crate::error::ViewError;

/// Slowest and fastest clock, simulated seconds per second.
const SLOW_MOTION: [f64; 2] = [1e-4, 4.0];

/// Pictures per simulated second.
const FRAME_RATE: f64 = 60.0;

impl Session {
    /// Executes a command. Bakes, analyses and repeated impacts run in the background until [`Session::poll`] or
    /// [`Session::finish_jobs`] collects them; the steps of [`Command::Step`] are taken immediately.
    ///
    /// # Errors
    /// The command cannot be executed; the session is unchanged.
    pub fn apply(&mut self, command: Command) -> Result<(), ViewError> {
        self.begin(command)?;
        while self.owes() {
            self.take_owed_step()?;
        }
        Ok(())
    }

    /// Carries a command out as [`Session::apply`] does, but leaves its steps to be taken one by one with [`Session::take_owed_step`].
    pub(crate) fn begin(&mut self, command: Command) -> Result<(), ViewError> {
        self.commands += 1;
        self.stale = true;
        self.message = None;
        let kept = command.is_deed().then(|| command.clone());
        let done = self.carry_out(command);
        match (&done, kept) {
            (Ok(()), Some(deed)) => self.write_down(deed),
            (Err(error), _) => self.complain(error),
            _ => {}
        }
        done
    }

    fn carry_out(&mut self, command: Command) -> Result<(), ViewError> {
        match command {
            Command::Volume(number) | Command::SlowMotion(number) if number.is_nan() => {
                return Err(ViewError::Command {
                    line: command.to_string(),
                    problem: "NaN is not allowed; give a number".into(),
                });
            }
            Command::Scene(name) => {
                let wanted = match &self.host {
                    Some(host) => host.scene(&name)?,
                    None => scene(&name)?,
                };
                self.load(wanted);
            }
            Command::Open(path) => {
                let wanted = match &self.host {
                    Some(host) => host.open(&path)?,
                    None => scene_in(&path)?,
                };
                self.shelf.forget_files();
                self.load(wanted);
            }
            Command::CancelBake => self.cancel_bake(),
            Command::Reset => self.reset()?,
            Command::Drop(height) => self.drop_from(height)?,
            Command::Pause => {
                self.paused = true;
                self.hush();
            }
            Command::Volume(volume) => self.set_volume(volume)?,
            Command::Sound(on) => self.set_muted(!on)?,
            Command::Run => self.paused = false,
            Command::Step(count) => {
                self.running()?;
                self.paused = true;
                self.owed = count;
            }
            Command::Frames(count) => {
                let now = self.running()?.time();
                self.paused = true;
                // To the end of a picture, whatever was before.
                let next = (now * FRAME_RATE + 1e-6).floor() + f64::from(count);
                self.owed_until = next / FRAME_RATE;
            }
            Command::SlowMotion(speed) => {
                self.slow_motion = speed.clamp(SLOW_MOTION[0], SLOW_MOTION[1]);
            }
            Command::Ball(ball) => self.choose_ball(ball)?,
            Command::Hammer(hammer) => self.choose_hammer(hammer)?,
            Command::Tool(tool) => self.tool = tool,
            Command::Throw { from, through } => self.throw(from, through)?,
            Command::Swing { from, through } => self.swing(from, through)?,
            Command::Grab { from, through } => self.grab(from, through)?,
            Command::Pull { from, through } => self.pull(from, through),
            Command::LetGo => self.grip = None,
            Command::Undo => self.undo_break()?,
            Command::Look(subject) => self.look(subject)?,
            Command::Scrub(share) => self.scrub = share.clamp(0.0, 1.0),
            Command::Exaggerate(factor) => self.exaggeration = factor.clamp(0.0, 1e6),
            Command::Explode(factor) => self.explode = factor.clamp(0.0, 10.0),
            Command::Show(mark, true) if !self.marks.contains(&mark) => self.marks.push(mark),
            Command::Show(_, true) => {}
            Command::Show(mark, false) => self.marks.retain(|&shown| shown != mark),
            Command::Mode(number) => self.mode = number.max(1),
            Command::Select { from, through } => self.select(from, through),
            Command::Knob(name, value) => self.turn(&name, value)?,
            Command::ResetKnob(name) => self.turn_back(&name)?,
            Command::ResetKnobs => self.turn_all_back()?,
            Command::Material(name) => self.choose_material(&name)?,
            Command::HitAgain => self.hit_again()?,
            Command::LookFrom { eye, target } => {
                let way = target - eye;
                if !way.is_finite() || way.length() < 1e-4 {
                    return Err(ViewError::NotNow(
                        "the camera's position and target must differ".into(),
                    ));
                }
                self.look_from = Some(View {
                    eye,
                    target,
                    ..self.home
                });
            }
            Command::Film(kind, path, options) => self.begin_film(kind, &path, &options)?,
            Command::CancelSave => {
                if let Some(job) = &self.film_job {
                    job.cancel();
                }
            }
            Command::Save(target, path) => {
                self.write(target, &path)?;
                self.say(format!("wrote {}", path.display()));
            }
            other => {
                return Err(ViewError::NotNow(format!(
                    "`{other}` requires a window, and this session has none"
                )));
            }
        }
        Ok(())
    }

    /// Logs the commands that a script needs to do the same again.
    fn write_down(&mut self, deed: Command) {
        match deed {
            Command::Scene(_) | Command::Open(_) => self.log.clear(),
            // Earlier commands do not matter to later ones, but for choices.
            Command::Reset | Command::Drop(_) => self.log.retain(|known| {
                !matches!(
                    known,
                    Command::Step(_)
                        | Command::Throw { .. }
                        | Command::Swing { .. }
                        | Command::Grab { .. }
                        | Command::Pull { .. }
                        | Command::LetGo
                        | Command::Undo
                )
            }),
            // Steps are written down as they are taken.
            Command::Step(_) => return,
            _ => {}
        }
        self.log.push(deed);
    }
}
