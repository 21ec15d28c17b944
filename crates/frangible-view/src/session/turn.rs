//! Knobs, and the repetition of the last impact with their current values.

use std::sync::Arc;
use std::time::Duration;

use frangible::{Material, Outcome, impact};
use frangible_bake::frangible_mesh::did_you_mean;
use frangible_scenes::{BakedBody, Scene, intact_body};

use super::Session;
use crate::baking::{bake, of_wanted_material};
use crate::blow::Blow;
use crate::command::Subject;
use crate::error::ViewError;
use crate::jobs::{Job, Teller};
use crate::knobs::{KNOBS, Knob, Settings};
use crate::shown::Compared;

/// Result of an impact taken again, and of a bake it needed.
pub(super) struct Again {
    blow: Blow,
    baked: Option<(Scene, Vec<BakedBody>)>,
}

impl Session {
    fn settings_mut(&mut self) -> Result<&mut [Settings; 2], ViewError> {
        self.settings.as_mut().ok_or_else(|| {
            ViewError::NotNow("no scene is loaded; load one before setting knobs".into())
        })
    }

    pub(super) fn turn(&mut self, name: &str, value: f64) -> Result<(), ViewError> {
        let knob = knob_named(name)?;
        let [now, _] = self.settings_mut()?;
        let before = now.clone();
        knob.turn(now, value);
        let changed = self.check_turned(before)?;
        self.after_turning(changed);
        Ok(())
    }

    pub(super) fn turn_back(&mut self, name: &str) -> Result<(), ViewError> {
        let knob = knob_named(name)?;
        let [now, own] = self.settings_mut()?;
        let (before, value) = (now.clone(), knob.value(own));
        knob.turn(now, value);
        let changed = self.check_turned(before)?;
        self.after_turning(changed);
        Ok(())
    }

    pub(super) fn turn_all_back(&mut self) -> Result<(), ViewError> {
        let [now, own] = self.settings_mut()?;
        let changed = now != own;
        *now = own.clone();
        self.after_turning(changed);
        Ok(())
    }

    pub(super) fn choose_material(&mut self, name: &str) -> Result<(), ViewError> {
        let material = Material::preset(name)?;
        let [now, _] = self.settings_mut()?;
        let changed = now.material != material;
        now.material = material;
        self.after_turning(changed);
        Ok(())
    }

    /// Returns true if the knobs have changed. If their new values are not valid, puts them back.
    fn check_turned(&mut self, before: Settings) -> Result<bool, ViewError> {
        let [now, _] = self.settings_mut()?;
        if let Err(error) = now.material.validate() {
            *now = before;
            return Err(frangible::InputError::from(error).into());
        }
        Ok(*now != before)
    }

    /// A scene in which nothing has happened yet takes the knobs at once; another one when it begins again.
    fn after_turning(&mut self, changed: bool) {
        let untouched = self.steps == 0 && self.blow.is_none();
        if !changed {
            return;
        }
        if untouched {
            self.prepare();
        } else {
            self.say(
                "H repeats the last impact with the new knobs, R restarts the scene with them"
                    .into(),
            );
        }
    }

    pub(super) fn hit_again(&mut self) -> Result<(), ViewError> {
        let blow = Arc::clone(self.last_blow()?);
        let (true, Some(number)) = (blow.is_repeatable(), blow.number) else {
            return Err(ViewError::NotNow(format!(
                "`{}` was already broken when it was hit; only impacts on whole bodies can be repeated",
                blow.name
            )));
        };
        let Some(wanted) = self.wanted_scene() else {
            return Ok(());
        };
        let baked = self.shelf.find(&wanted).map(<[BakedBody]>::to_vec);
        if baked.is_none() && self.host.is_some() {
            // The host bakes beside the session.
            self.begin_bake(wanted);
            self.hits_again = true;
            return Ok(());
        }
        let settings = self.settings.clone();
        self.again_job = Some(Job::start(move |teller| {
            take_again(&blow, number, &wanted, baked, settings.as_ref(), teller)
        }));
        Ok(())
    }

    pub(super) fn poll_again(&mut self, wait: Option<Duration>) -> bool {
        let Some(result) = Job::collect(&mut self.again_job, wait) else {
            return false;
        };
        match result {
            Ok(again) => {
                if let Some((scene, baked)) = again.baked {
                    self.shelf.keep(&scene, baked);
                }
                self.compare(again.blow);
            }
            Err(error) => self.complain(&error),
        }
        true
    }

    fn compare(&mut self, new: Blow) {
        let Some(old) = self.blow.clone() else { return };
        let mut differences = Vec::new();
        if let (Some(built), Some([now, _])) = (&self.built, &self.settings) {
            for knob in &KNOBS {
                let values = [knob.value(built), knob.value(now)];
                if values[0] != values[1] {
                    differences.push((knob.label.into(), values, knob.unit.into()));
                }
            }
        }
        self.compared = Some(Arc::new(Compared {
            blows: [old, Arc::new(new)],
            differences,
        }));
        self.set_subject(Subject::Compare);
        self.paused = true;
    }
}

fn knob_named(name: &str) -> Result<&'static Knob, ViewError> {
    Knob::named(name).ok_or_else(|| {
        let names: Vec<&str> = KNOBS.iter().map(|knob| knob.name).collect();
        let hint = did_you_mean(name, names.iter().copied());
        ViewError::NotNow(format!(
            "there is no knob `{name}`{hint}; knobs: {}",
            names.join(", ")
        ))
    })
}

/// Lets the same contacts hit the intact body, made anew with the knobs.
fn take_again(
    blow: &Blow,
    number: usize,
    wanted: &Scene,
    baked: Option<Vec<BakedBody>>,
    settings: Option<&[Settings; 2]>,
    teller: &Teller,
) -> Result<Again, ViewError> {
    let (baked, new) = match baked {
        Some(baked) => (baked, false),
        None => (bake(wanted, teller)?, true),
    };
    let made = of_wanted_material(wanted, &baked, settings)?;
    let asset = made.get(number).map(|body| Arc::clone(&body.asset));
    let asset = asset.ok_or(ViewError::Worker)?;
    let body = intact_body(wanted, number, &asset)?;
    let outcome = impact(&body, &blow.contacts, &wanted.fracture)?;
    let report = outcome.report().clone();
    let fracture = match outcome {
        Outcome::Broke(fracture) => Some(Arc::new(*fracture)),
        _ => None,
    };
    Ok(Again {
        blow: Blow {
            body,
            config: wanted.fracture.clone(),
            report,
            fracture,
            energy_paid: 0.0,
            ..blow.clone()
        },
        baked: new.then(|| (wanted.clone(), baked)),
    })
}
