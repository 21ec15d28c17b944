//! Loading, baking and set-up of scenes.

use std::time::Duration;

use frangible_scenes::{BakedBody, BodySource, LiveScene, Scene};

use super::Session;
use crate::baking::{bake, of_wanted_material};
use crate::command::Subject;
use crate::error::ViewError;
use crate::jobs::Job;
use crate::knobs::{Settings, turn_material};

impl Session {
    /// Takes another scene, its knobs as it has them.
    pub(super) fn load(&mut self, scene: Scene) {
        self.settings = None;
        self.scene = Some(scene);
        self.live = None;
        self.forget_contacts();
        self.prepare();
    }

    /// Sets the scene up, or has its bodies baked first.
    pub(super) fn prepare(&mut self) {
        self.bake_job = None;
        self.hits_again = false;
        let Some(wanted) = self.wanted_scene() else {
            return;
        };
        if let Some(baked) = self.shelf.find(&wanted) {
            let baked = baked.to_vec();
            self.set_up(&wanted, &baked);
            return;
        }
        self.begin_bake(wanted);
    }

    /// Has the bodies of a scene baked.
    pub(super) fn begin_bake(&mut self, wanted: Scene) {
        self.bake_job = Some(match &self.host {
            Some(host) => Job::delivered(|delivery| host.bring(&wanted, delivery)),
            None => Job::start(move |teller| bake(&wanted, teller)),
        });
    }

    /// The scene with the knobs as they are.
    pub(crate) fn wanted_scene(&self) -> Option<Scene> {
        let mut scene = self.scene.clone()?;
        let Some([now, own]) = &self.settings else {
            return Some(scene);
        };
        scene.fracture = now.fracture.clone();
        scene.seed = now.seed;
        let came_baked =
            |body: &&mut frangible_scenes::BodySpec| matches!(body.source, BodySource::Asset(_));
        for body in scene.bodies.iter_mut().filter(|body| !came_baked(body)) {
            turn_material(&mut body.material, now, own);
            if now.modes != own.modes {
                body.modes = now.modes;
            }
        }
        Some(scene)
    }

    pub(super) fn poll_bake(&mut self, wait: Option<Duration>) -> bool {
        let Some(result) = Job::collect(&mut self.bake_job, wait) else {
            return false;
        };
        match (result, self.wanted_scene()) {
            (Ok(baked), Some(wanted)) => {
                self.shelf.keep(&wanted, baked.clone());
                if !std::mem::take(&mut self.hits_again) {
                    self.set_up(&wanted, &baked);
                } else if let Err(error) = self.hit_again() {
                    self.complain(&error);
                }
            }
            (Err(error), _) => self.complain(&error),
            _ => {}
        }
        true
    }

    fn set_up(&mut self, wanted: &Scene, baked: &[BakedBody]) {
        if self.settings.is_none() {
            self.settings = self
                .scene
                .as_ref()
                .and_then(|scene| Settings::of(scene, baked.first()))
                .map(|own| [own.clone(), own]);
        }
        let made = of_wanted_material(wanted, baked, self.settings.as_ref())
            .and_then(|baked| Ok(LiveScene::new(wanted, &baked)?));
        match made {
            Ok(live) => {
                self.home = live.view(wanted.look_from);
                self.look_from = None;
                self.forget_contacts();
                self.reel.note(&live, 0.0);
                self.live = Some(live);
                self.built = self.settings.as_ref().map(|[now, _]| now.clone());
                self.steps = 0;
                self.starts += 1;
                self.listen_anew();
            }
            Err(error) => self.complain(&error),
        }
    }

    /// Forgets all that has been thrown.
    pub(super) fn forget_contacts(&mut self) {
        self.recent = None;
        self.undo.clear();
        self.blow = None;
        self.analysis = None;
        self.compared = None;
        self.analysis_job = None;
        self.again_job = None;
        self.selection = None;
        self.grip = None;
        self.set_subject(Subject::World);
        self.reel.clear();
        self.owed = 0;
        self.owed_until = 0.0;
        self.mesher = crate::mesher::Mesher::default();
        self.skins = crate::edges::Skins::default();
    }

    pub(super) fn reset(&mut self) -> Result<(), ViewError> {
        if self.scene.is_none() {
            return Err(ViewError::NotNow(
                "no scene is loaded; choose one to restart".into(),
            ));
        }
        self.prepare();
        Ok(())
    }

    pub(super) fn drop_from(&mut self, height: f64) -> Result<(), ViewError> {
        let scene = self.scene.as_mut().ok_or_else(|| {
            ViewError::NotNow("no scene is loaded; choose one before dropping bodies".into())
        })?;
        let mut dropped = scene.clone();
        dropped.drop_all(height);
        dropped.validate()?;
        *scene = dropped;
        self.prepare();
        Ok(())
    }

    pub(super) fn cancel_bake(&mut self) {
        if self.bake_job.take().is_some() {
            self.hits_again = false;
            self.say("the bake was cancelled".into());
        }
    }
}
