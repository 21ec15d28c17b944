//! State of a session for display: the subject, its marks, and all numbers of the panels.

use std::sync::Arc;
use std::time::Duration;

use frangible::glam::Vec3;
use frangible_scenes::{LiveScene, ThingKind};

use super::Session;
use crate::analysis::Analysis;
use crate::camera::Ray;
use crate::command::{Mark, Subject};
use crate::compare;
use crate::error::ViewError;
use crate::jobs::Job;
use crate::marks;
use crate::numbers::{BlowNumbers, ComparedNumbers, KnobValues};
use crate::picking::pick;
use crate::picture::{Batch, Picture};
use crate::shown::{BakeShown, Focus, Selection, Shown};
use crate::times::{Spread, thread_time};

impl Session {
    pub(super) fn look(&mut self, subject: Subject) -> Result<(), ViewError> {
        match subject {
            Subject::World => {}
            Subject::Compare if self.compared.is_none() => {
                return Err(ViewError::NotNow(
                    "there is nothing to compare yet; repeat the last impact first (H)".into(),
                ));
            }
            Subject::Compare => {}
            Subject::Stress | Subject::Cracks | Subject::Modes => self.analyse()?,
        }
        self.set_subject(subject);
        self.scrub_to_the_point();
        Ok(())
    }

    /// Goes to the moment that shows most of the subject: all cracks, or the largest tension.
    fn scrub_to_the_point(&mut self) {
        match (self.subject, &self.analysis) {
            (Subject::Cracks, _) => self.scrub = 1.0,
            (Subject::Stress, Some(analysis)) => self.scrub = analysis.worst_moment(),
            _ => {}
        }
    }

    /// Has the last contact analysed, if that is not done.
    fn analyse(&mut self) -> Result<(), ViewError> {
        let blow = Arc::clone(self.last_blow()?);
        if self.analysis.is_none() && self.analysis_job.is_none() {
            self.analysis_job = Some(Job::start(move |_| Analysis::of(&blow)));
        }
        Ok(())
    }

    pub(super) fn poll_analysis(&mut self, wait: Option<Duration>) -> bool {
        let Some(result) = Job::collect(&mut self.analysis_job, wait) else {
            return false;
        };
        match result {
            Ok(analysis) => {
                let worst = analysis.worst_moment();
                self.exaggeration = marks::telling_exaggeration(&analysis, worst);
                self.scrub = worst;
                self.analysis = Some(Arc::new(analysis));
                self.scrub_to_the_point();
            }
            Err(error) => self.complain(&error),
        }
        true
    }

    pub(super) fn select(&mut self, from: Vec3, through: Vec3) {
        let direction = (through - from).normalize_or_zero();
        let ray = Ray {
            origin: from,
            direction,
        };
        let explode = self.explode as f32;
        let met = self.live.as_ref().and_then(|live| pick(live, explode, ray));
        self.selection = met.and_then(|met| met.thing);
    }

    /// Returns the current state for display.
    #[must_use]
    pub fn shown(&mut self) -> Shown {
        let began = self.stale.then(thread_time);
        if self.stale {
            self.picture = Arc::new(self.draw());
            self.stale = false;
        }
        let mut shown = self.tell();
        if let Some(began) = began {
            self.publishing.note(thread_time().saturating_sub(began));
        }
        shown.publishing = self.publishing.spread();
        shown
    }

    /// Collects all numbers of the panels, and the picture.
    fn tell(&self) -> Shown {
        let live = self.live.as_ref();
        let count = |wanted: fn(&ThingKind) -> bool| {
            live.map_or(0, |live| {
                let things = live.things().iter();
                let there = things.filter(|t| wanted(&t.kind) && live.pose(t).is_some());
                there.count()
            })
        };
        let bake = self.bake_job.as_ref().map(Job::progress);
        let again = self.again_job.as_ref().map(Job::progress);
        let told = again.filter(|progress| !progress.what.is_empty());
        let progress = bake.or(told);
        Shown {
            commands: self.commands,
            busy: self.is_busy(),
            scene: self
                .scene
                .as_ref()
                .map_or(String::new(), |s| s.name.clone()),
            summary: self
                .scene
                .as_ref()
                .map_or(String::new(), |s| s.summary.clone()),
            starts: self.starts,
            home: self.home,
            focus: self.focus,
            time: self.time(),
            steps: self.steps,
            paused: self.paused,
            slow_motion: self.slow_motion,
            sound: self.volume(),
            whole: count(|kind| matches!(kind, ThingKind::Body(_))),
            pieces: count(|kind| matches!(kind, ThingKind::Piece { .. })),
            fingerprint: live.map_or(0, |live| live.world().fingerprint()),
            undoable: self.undo.len(),
            ball: self.ball.clone(),
            hammer: self.hammer.clone(),
            tool: self.tool,
            bake: progress.map(|progress| BakeShown {
                what: progress.what,
                share: progress.share,
            }),
            filming: self.film_job.as_ref().map(|job| {
                let progress = job.progress();
                BakeShown {
                    what: progress.what,
                    share: progress.share,
                }
            }),
            reel: self.reel.seconds(),
            analysing: self.analysis_job.is_some() || self.again_job.is_some(),
            message: self.message.clone(),
            picture: Arc::clone(&self.picture),
            subject: self.subject,
            scrub: self.scrub,
            exaggeration: self.exaggeration,
            explode: self.explode,
            marks: self.marks.clone(),
            mode: self.mode,
            blow: self.blow.as_deref().map(BlowNumbers::from),
            course: self.analysis.as_ref().map(|a| Arc::clone(&a.course)),
            largest_color: self.largest_color,
            selection: self.selected(),
            compared: self.compared.as_deref().map(ComparedNumbers::from),
            knobs: self.settings.as_ref().map(KnobValues::from),
            turned: match (&self.built, &self.settings) {
                (Some(built), Some([now, _])) => built != now,
                _ => false,
            },
            contacts: live
                .map(|live| live.world().impact_counts())
                .unwrap_or_default(),
            break_step: self.break_step,
            publishing: Spread::default(),
        }
    }

    /// Looks at something else, and has the camera turn to it.
    pub(super) fn set_subject(&mut self, subject: Subject) {
        if self.subject != subject {
            self.turn_to(subject);
        }
    }

    pub(super) fn turn_to(&mut self, subject: Subject) {
        self.subject = subject;
        let on = match (subject, &self.blow) {
            (Subject::World, _) | (_, None) => None,
            (Subject::Compare, Some(blow)) => Some((blow.pose.translation, compare::extent(blow))),
            (_, Some(blow)) => {
                let reach = marks::reach(blow.body.asset());
                Some((blow.pose.translation, [reach, reach]))
            }
        };
        self.focus = Focus {
            number: self.focus.number + 1,
            on,
        };
    }

    fn selected(&self) -> Option<Selection> {
        let live = self.live.as_ref()?;
        let thing = live.things().get(self.selection?)?;
        let positions = &thing.mesh.positions;
        let low = positions.iter().fold(Vec3::INFINITY, |l, &p| l.min(p));
        let high = positions.iter().fold(Vec3::NEG_INFINITY, |h, &p| h.max(p));
        let mut size = (high - low).to_array();
        size.sort_by(|a, b| b.total_cmp(a));
        Some(Selection {
            name: thing.name.clone(),
            mass: thing.mass,
            volume: thing.volume,
            size,
            speed: live.speed(thing)?,
        })
    }

    fn draw(&mut self) -> Picture {
        let version = self.picture.version + 1;
        self.largest_color = None;
        let Some(live) = self.live.as_ref() else {
            return Picture {
                version,
                ..Picture::default()
            };
        };
        let mut picture = Picture {
            version,
            floor: live.floor().copied(),
            wireframe: self.marks.contains(&Mark::Wireframe),
            ..Picture::default()
        };
        let explode = self.explode as f32;
        let shown = match (self.subject, &self.blow, &self.analysis) {
            (Subject::Stress, Some(blow), Some(analysis)) => {
                let (batches, largest) =
                    marks::strained(analysis, blow.pose, self.scrub, self.exaggeration);
                self.largest_color = Some(largest);
                Some(batches)
            }
            (Subject::Modes, Some(blow), Some(analysis)) => {
                let mode = self.mode_of(analysis);
                let (batch, largest) = marks::mode(analysis, blow.pose, mode, self.scrub);
                self.largest_color = Some(largest);
                Some(vec![batch])
            }
            (Subject::Cracks, Some(blow), Some(analysis)) => {
                Some(marks::cracks(analysis, blow.pose, self.scrub))
            }
            (Subject::Compare, ..) => self.side_by_side(live, &mut picture),
            _ => None,
        };
        picture.batches = match shown {
            Some(batches) => batches.into_iter().map(Arc::new).collect(),
            None => {
                let batches = self.mesher.batches(live, explode);
                self.mark_selected(&mut picture);
                batches
            }
        };
        let mut skins = std::mem::take(&mut self.skins);
        let edges = self.mesh_edges(&mut skins).into_iter().map(Arc::new);
        picture.batches.extend(edges);
        self.skins = skins;
        self.mark_contact(&mut picture);
        picture
    }

    /// Both outcomes of the last impact, one beside the other.
    fn side_by_side(&self, live: &LiveScene, picture: &mut Picture) -> Option<Vec<Batch>> {
        let (compared, scene) = (self.compared.as_ref()?, self.scene.as_ref()?);
        let explode = self.explode as f32;
        let batches = compare::side_by_side(live, compared, scene.look_from, explode);
        picture.floor = None;
        Some(batches)
    }

    fn mark_contact(&self, picture: &mut Picture) {
        if matches!(self.subject, Subject::Compare | Subject::Modes) {
            return;
        }
        let Some(blow) = &self.blow else { return };
        // In the world the contact is a thing of the past: the body is elsewhere, or gone.
        let near = self.subject != Subject::World || self.time() - blow.time < 0.05;
        if self.marks.contains(&Mark::Impulse) && near {
            marks::impulse(blow, picture);
        }
        let Some(analysis) = self
            .analysis
            .as_ref()
            .filter(|_| self.subject != Subject::World)
        else {
            return;
        };
        if self.marks.contains(&Mark::WeakPoints) {
            marks::weak_points(analysis, blow.pose, picture);
        }
        if self.marks.contains(&Mark::Starts) {
            marks::starts(analysis, blow.pose, picture);
        }
    }

    fn mark_selected(&self, picture: &mut Picture) {
        let chosen = self.live.as_ref().zip(self.selection);
        if let Some((live, number)) = chosen
            && let Some(thing) = live.things().get(number)
            && let Some(pose) = live.pose(thing)
        {
            marks::outline(thing, pose, self.explode as f32, picture);
        }
    }
}
