//! Cracks under a motion of the body, wherever it comes from: an impact, a resting load, a blast.

use glam::Vec3;
use web_time::Instant;

use crate::blow::{Apart, Blow, Groups};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::crack::{CrackSystem, Peak, StressField, Suspects, crack};
use crate::fragment::{self, Labels, Volumes};
use crate::motion::{DisplacementBatch, Motion};
use crate::outcome::{ImpactReport, LookedAt};
use crate::refuse::Culling;
use crate::state::BodyState;
use crate::stress::{BATCH, STRIDE, lane};
use crate::trace::CrackTrace;

/// Pieces are looked for again when the cracks have grown by this factor, or have stopped.
const GREW: f64 = 1.15;

/// Effect of an impact's cracks on a body.
#[expect(clippy::large_enum_variant, reason = "one at a time, never stored")]
pub(crate) enum Cracked<'a> {
    /// Margin, report, and the body's cracks if there are new ones.
    Held(f64, ImpactReport, Option<Box<BodyState>>),
    /// Pieces, not made yet, and how they move apart where that was followed.
    Parted(CrackSystem<'a>, Labels, Option<Apart>, ImpactReport),
    /// Dice, from this place, m, and time, s, on, in so many clumps.
    Diced(Vec3, f64, usize, ImpactReport),
}

/// Stress wave → cracks `[G12 §4.4, §5]` → connected pieces `[G12 §6.1]`, for any motion of the body.
pub(crate) struct Cracking<'a> {
    pub(crate) body: &'a Body,
    pub(crate) config: &'a FractureConfig,
    pub(crate) moves: Moves,
    /// Surface triangles under a contact.
    pub(crate) pressed: Vec<u32>,
    /// Time step of the motion, s.
    pub(crate) time_step: f64,
    /// Energy that the cracks may spend, where a ledger is kept, J.
    pub(crate) budget: f64,
}

/// Origin of the motion that opens cracks.
pub(crate) enum Moves {
    /// A motion that cracks do not change.
    Given(Motion),
    /// A blow: it goes on with the pieces that part.
    Blow(Box<Blow>),
}

impl Moves {
    /// The motion as far as it is known.
    pub(crate) fn motion(&self) -> &Motion {
        match self {
            Self::Given(motion) => motion,
            Self::Blow(blow) => blow.motion(),
        }
    }

    fn blow(&self) -> Option<&Blow> {
        match self {
            Self::Given(_) => None,
            Self::Blow(blow) => Some(blow),
        }
    }
}

/// Reason why the cracks have paused.
enum Stop {
    /// Nothing is left that could crack.
    End,
    /// The motion has been followed no further than to its last step.
    Asks,
    /// Cracks have changed the motion from this time step on.
    Changed(usize, Changed),
}

/// Change of the motion by cracks.
struct Changed {
    /// Contacts that still push, and the compliance that the body has gained there, m/N.
    contacts: Vec<(usize, f64)>,
    /// Groups that move on their own, where more has parted.
    groups: Option<Groups>,
}

/// State of the cracks when pieces were last looked for.
#[derive(Default)]
struct Grown {
    /// Area of the cracks then, m².
    asked: f64,
    /// Area at the last look, m².
    before: f64,
    /// The cracks' progress when it was last asked, and the pieces.
    pieces: Option<([usize; 2], Labels)>,
    /// Nodes under the contacts when groups were last looked for.
    pushed: Vec<u32>,
}

impl Grown {
    /// Returns true if it is time to look for pieces again, with cracks of this area, m².
    fn is_due(&mut self, area: f64) -> bool {
        let stopped = area <= std::mem::replace(&mut self.before, area);
        let due = area > self.asked && (stopped || area > GREW * self.asked);
        if due {
            self.asked = area;
        }
        due
    }
}

impl<'a> Cracking<'a> {
    /// Runs all cracks, where it is known that nothing happens before time step `first_step`.
    pub(crate) fn run(
        self,
        first_step: usize,
        report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        self.run_after(Looked::default(), first_step, report, trace)
    }

    /// Returns true if the body parts. Only stress that may crack it is looked at, so the report's stresses and the margin mean nothing.
    pub(crate) fn parts(self, first_step: usize, report: ImpactReport) -> bool {
        let cracked = self.run_after(Looked::AT_ENOUGH, first_step, report, &mut None);
        matches!(cracked, Cracked::Parted(..) | Cracked::Diced(..))
    }

    fn run_after(
        mut self,
        mut looked: Looked,
        first_step: usize,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let (body, config) = (self.body, self.config);
        let mut system = CrackSystem::new(body, config, self.budget);
        let mut suspects = Suspects::default();
        let mut displacement = DisplacementBatch::new(&body.asset);
        let mut culling = Culling::new(body, config, self.moves.motion());
        (culling.passed_over, culling.as_weakest) = (looked.passed_over, looked.as_weakest);
        // From the beginning of its batch, so that every batch is whole.
        let mut step = first_step / STRIDE * STRIDE;
        let mut grown = Grown::default();
        loop {
            let seen = (&mut displacement, &mut culling, &mut suspects);
            let stop = self.follow(
                step,
                &mut system,
                seen,
                &mut grown,
                &mut looked,
                &mut report,
            );
            let Moves::Blow(blow) = &mut self.moves else {
                break;
            };
            let start = Instant::now();
            match stop {
                Stop::End => break,
                Stop::Asks => {
                    step = blow.motion().steps();
                    if !blow.go_further() {
                        break;
                    }
                }
                Stop::Changed(from, changed) => {
                    step = from;
                    blow.go_on(body, step, &changed.contacts, changed.groups);
                    displacement.forget();
                    system.forget_batch();
                }
            }
            // A shorter blow brings less in the end.
            if let Some(most) = blow.most_energy() {
                system.ledger.cap(most);
            }
            report.timings.response += start.elapsed().as_secs_f64();
        }
        let [most, felt] = suspects.passed_over;
        looked.asked_clusters = culling.asked_clusters;
        looked.passed_over = culling.passed_over.max(most);
        looked.as_weakest = culling.as_weakest.max(felt);
        if let Moves::Blow(blow) = &mut self.moves {
            let start = Instant::now();
            blow.end_contacts();
            report.take_blow(blow);
            report.timings.response += start.elapsed().as_secs_f64();
        }
        self.end(system, grown, looked, report, trace)
    }

    /// Runs the cracks from a time step on: to the end of the motion as far as it is known, or until they have changed it.
    fn follow(
        &self,
        first_step: usize,
        system: &mut CrackSystem<'a>,
        (displacement, culling, suspects): (&mut DisplacementBatch, &mut Culling, &mut Suspects),
        grown: &mut Grown,
        looked: &mut Looked,
        report: &mut ImpactReport,
    ) -> Stop {
        let (body, config, motion) = (self.body, self.config, self.moves.motion());
        let mut field = StressField::new(body, config, motion, &self.pressed, displacement);
        let mut roots = [0.0; BATCH];
        for step in first_step..motion.steps() {
            if system.is_spent() {
                return Stop::End;
            }
            let k = lane(step);
            field.step = step;
            system.ledger.come(motion.strain_energy_until(step));
            if step > first_step
                && let Some(blow) = self.moves.blow()
            {
                let start = Instant::now();
                let changed = self.look(blow, step, system, grown);
                report.timings.labels += start.elapsed().as_secs_f64();
                if let Some(changed) = changed {
                    return Stop::Changed(step, changed);
                }
            }
            if step % STRIDE == 0 || step == first_step {
                // Bounds, then the points that they leave, of all steps of the batch.
                let start = Instant::now();
                roots = culling.look(motion, step..motion.steps().min(step + BATCH - k));
                field.displacement.seek(motion, step);
                let now = motion.begin(step, self.time_step);
                let survivors = culling.survivors();
                suspects.find(body, &mut field, survivors, system, now, looked.peak);
                report.timings.stress += start.elapsed().as_secs_f64();
            }
            system.wake(roots[k]);
            if !culling.survives(k) && system.is_quiet() {
                continue;
            }
            report.looked_at = LookedAt::Stresses;
            let start = Instant::now();
            let times = [step, step + 1].map(|step| motion.begin(step, self.time_step));
            looked.peak = crack(system, &mut field, suspects, times, looked.peak);
            report.timings.cracks += start.elapsed().as_secs_f64();
        }
        Stop::Asks
    }

    /// Checks whether cracks have weakened what bears a contact, and finds the pieces that they have parted: the large ones move on their own, the
    /// others come to rest.
    fn look(
        &self,
        blow: &Blow,
        step: usize,
        system: &mut CrackSystem<'a>,
        grown: &mut Grown,
    ) -> Option<Changed> {
        if !grown.is_due(system.area) {
            return None;
        }
        let contacts = match blow.pushes_at(step) {
            true => blow.weakened(system),
            false => Vec::new(),
        };
        let mut groups = None;
        // Cracks that run at once feel neither each other nor that a piece has parted.
        // Pieces on a film do not part: they go on bearing what the wall bears.
        if !self.config.is_paper() && self.body.asset.material.laminate.is_none() {
            let (index, mesh) = (&self.body.prepared.index, &self.body.asset.fracture);
            let progress = system.progress();
            let labels = match grown.pieces.take() {
                Some((known, labels)) if known == progress => labels,
                before => {
                    let before = before.map(|(_, labels)| labels);
                    fragment::label(system, index, self.config.crumb_share, before)
                }
            };
            let pushed = blow.nodes(self.body, step);
            if labels.count > 1 && (labels.has_parted || pushed != grown.pushed) {
                let of_node = &labels.of_node;
                let acts;
                (groups, acts) = blow.groups(self.body, (of_node, labels.count), &pushed);
                grown.pushed = pushed;
                let free = Volumes::of(&labels, index).free(&acts);
                let now = blow.motion().begin(step, self.time_step);
                let speed = self.body.asset.material.rayleigh_speed();
                system
                    .rest
                    .release(of_node, &mesh.positions, &free, now, speed);
            }
            grown.pieces = Some((progress, labels));
        }
        (groups.is_some() || !contacts.is_empty()).then_some(Changed { contacts, groups })
    }

    /// Ends the impact: completes the report.
    fn end(
        self,
        system: CrackSystem<'a>,
        grown: Grown,
        looked: Looked,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let body = self.body;
        let peak = looked.peak;
        report.take_motion(self.moves.motion());
        report.take_cracks(&system, body);
        if report.looked_at == LookedAt::Amplitudes && looked.asked_clusters {
            report.looked_at = LookedAt::Clusters;
        }
        report.take_peak(peak, body);
        report.stress_bound = f64::from(peak.tension.max(looked.passed_over));
        let margin = report.strength / f64::from(peak.as_weakest.max(looked.as_weakest));
        if let Some((place, time, tet)) = system.gone {
            report.first_crack_time = Some(time);
            report.first_crack_point = Some(place - body.origin().as_vec3());
            report.arrivals = vec![vec![(tet, time)]];
            report.cracks = 1;
            return Cracked::Diced(place, time, self.config.clumps, report);
        }
        if system.area == 0.0 && trace.is_none() {
            return Cracked::Held(margin, report, None);
        }
        let start = Instant::now();
        let labels = match grown.pieces {
            Some((progress, labels)) if progress == system.progress() => labels,
            before => {
                let (index, before) = (&body.prepared.index, before.map(|(_, labels)| labels));
                fragment::label(&system, index, self.config.crumb_share, before)
            }
        };
        report.timings.labels += start.elapsed().as_secs_f64();
        if let Some(trace) = trace {
            *trace = CrackTrace::of(
                &system,
                &labels.of_node,
                self.moves.motion().clone(),
                self.pressed,
            );
        }
        if labels.count < 2 {
            let grown = system.area > 0.0;
            let state = grown.then(|| Box::new(BodyState::of(&system.cracks)));
            Cracked::Held(margin, report, state)
        } else {
            let apart = self.moves.blow().and_then(|blow| blow.apart(body));
            Cracked::Parted(system, labels, apart, report)
        }
    }
}

/// Stress met so far, and bounds of what was passed over.
#[derive(Clone, Copy, Debug, Default)]
struct Looked {
    peak: Peak,
    asked_clusters: bool,
    /// Largest bound of the skipped stresses, Pa.
    passed_over: f32,
    /// Largest bound of the skipped stresses, scaled to the strength of the weakest point, Pa.
    as_weakest: f32,
}

impl Looked {
    /// A state that no stress exceeds, for runs in which the stress itself is not requested.
    const AT_ENOUGH: Self = Self {
        peak: Peak::UNPASSABLE,
        asked_clusters: false,
        passed_over: f32::INFINITY,
        as_weakest: f32::INFINITY,
    };
}
