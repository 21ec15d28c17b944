//! Cracks under a motion of the body, wherever it comes from: an impact, a resting load, a blast.

use web_time::Instant;

use crate::blow::Blow;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::crack::{CrackSystem, Peak, StressField, Suspects, crack};
use crate::fragment::{self, Labels, MeshIndex};
use crate::modal::Motion;
use crate::outcome::{ImpactReport, LookedAt};
use crate::refuse::Culling;
use crate::state::BodyState;
use crate::stress::{BATCH, DisplacementBatch, STRIDE, lane};
use crate::trace::CrackTrace;

/// Time steps between two looks whether cracks have weakened the wall under a contact.
const BETWEEN_STARS: usize = 7;

/// What the cracks of an impact did to a body.
#[expect(clippy::large_enum_variant, reason = "one at a time, never stored")]
pub(crate) enum Cracked<'a> {
    /// Margin, report, and the body's cracks if there are new ones.
    Held(f64, ImpactReport, Option<Box<BodyState>>),
    /// Pieces, not made yet.
    Parted(CrackSystem<'a>, Labels, ImpactReport),
}

/// Stress wave → cracks `[G12 §4.4, §5]` → which nodes hang together `[G12 §6.1]`, for any motion of the body.
pub(crate) struct Cracking<'a> {
    pub(crate) body: &'a Body,
    pub(crate) config: &'a FractureConfig,
    pub(crate) motion: Motion,
    /// Surface triangles under a contact.
    pub(crate) pressed: Vec<u32>,
    /// Time step of the motion, s.
    pub(crate) time_step: f64,
    /// Energy that the cracks may spend, with the ledger, J.
    pub(crate) budget: f64,
    /// The blow that the motion comes from: it ends when the wall under it is gone.
    pub(crate) blow: Option<Box<Blow>>,
}

impl<'a> Cracking<'a> {
    /// Runs all cracks, where it is known that nothing happens before time step `first_step`.
    pub(crate) fn run(
        mut self,
        first_step: usize,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let (body, config) = (self.body, self.config);
        let budget = if config.energy_ledger {
            self.budget
        } else {
            f64::INFINITY
        };
        let mut system = CrackSystem::new(body, config, budget);
        let mut looked = Looked::default();
        let mut suspects = Suspects::default();
        // From the beginning of its batch, so that every batch is whole.
        let mut step = first_step / STRIDE * STRIDE;
        while let Some((next, contact, compliance)) =
            self.follow(step, &mut system, &mut suspects, &mut looked, &mut report)
        {
            let Some(blow) = &mut self.blow else { break };
            let now = next as f64 * self.time_step;
            blow.weaken(body, contact, compliance, now);
            self.motion = std::mem::take(&mut blow.motion);
            report.contacts = blow.reports();
            report.contact_duration = blow.duration();
            report.time_steps = self.motion.steps();
            system.releases.forget_batch();
            step = next;
        }
        report.peak_elastic_energy = self.motion.peak_energy;
        report.peak_strain_energy = self.motion.peak_strain_energy;
        self.end(system, looked, report, trace)
    }

    /// Runs the cracks from a time step on: to the end of the motion, or to a time step before which cracks have weakened the wall under a
    /// contact, whose number comes with it, and what the wall then gives way by, m/N.
    fn follow(
        &mut self,
        first_step: usize,
        system: &mut CrackSystem<'a>,
        suspects: &mut Suspects,
        looked: &mut Looked,
        report: &mut ImpactReport,
    ) -> Option<(usize, usize, f64)> {
        let (body, config, motion) = (self.body, self.config, &self.motion);
        let mut displacement = DisplacementBatch::new(&body.asset);
        let mut culling = Culling::new(body, config, motion);
        let mut field = StressField::new(body, config, motion, &self.pressed, &mut displacement);
        let mut roots = [0.0; BATCH];
        let mut weakened = None;
        for step in first_step..motion.steps() {
            if system.is_spent() {
                break;
            }
            let k = lane(step);
            field.step = step;
            if step % BETWEEN_STARS == 0
                && step > first_step
                && let Some(blow) = self.blow.as_ref().filter(|b| b.pushes_at(step))
                && let Some((contact, compliance)) = blow.weakened(system)
            {
                weakened = Some((step, contact, compliance));
                break;
            }
            if step % STRIDE == 0 || step == first_step {
                // Bounds, then the points that they leave, of all steps of the batch.
                let start = Instant::now();
                culling.begin();
                for step in (step..motion.steps()).take(BATCH - k) {
                    let k = lane(step);
                    roots[k] = culling.root(motion, step);
                    culling.survive(motion, step, roots[k], k);
                }
                field.displacement.seek(motion, step);
                let cut = &system.fractured_by;
                suspects.find(body, &mut field, culling.survivors(), cut, looked.peak);
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
        looked.asked_clusters |= culling.asked_clusters;
        let [most, felt] = suspects.passed_over;
        looked.passed_over = looked.passed_over.max(culling.passed_over).max(most);
        looked.as_weakest = looked.as_weakest.max(culling.as_weakest).max(felt);
        weakened
    }

    /// What came of it.
    fn end(
        self,
        system: CrackSystem<'a>,
        looked: Looked,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let body = self.body;
        let peak = looked.peak;
        if let Some(first) = system.cracks.get(system.old_cracks) {
            report.first_crack_time = first.elements.first().map(|cut| cut.time);
            report.first_crack_point = Some(first.frame.origin - body.origin().as_vec3());
        }
        if report.looked_at == LookedAt::Amplitudes && looked.asked_clusters {
            report.looked_at = LookedAt::Clusters;
        }
        report.peak_stress = f64::from(peak.tension);
        if peak.tension > 0.0 {
            let place = body.prepared.centroids[peak.tet as usize].as_dvec3();
            report.peak_point = Some((place - body.origin()).as_vec3());
        }
        report.stress_bound = f64::from(peak.tension.max(looked.passed_over));
        report.cracks = system.cracks.len() - system.old_cracks;
        report.forks = system.forks;
        report.crack_area = system.area;
        report.fracture_energy = system.spent;
        let margin = report.strength / f64::from(peak.as_weakest.max(looked.as_weakest));
        if system.area == 0.0 && trace.is_none() {
            return Cracked::Held(margin, report, None);
        }
        let start = Instant::now();
        let crumb_share = self.config.crumb_share;
        let index = &body.prepared.index;
        let labels = fragment::label(&system, index, crumb_share);
        report.timings.labels = start.elapsed().as_secs_f64();
        if let Some(trace) = trace {
            *trace = CrackTrace::of(&system, &labels.of_node);
        }
        report.arrivals = system.arrivals();
        if labels.count < 2 {
            let grown = system.area > 0.0;
            let state = grown.then(|| Box::new(BodyState::of(&system.cracks)));
            Cracked::Held(margin, report, state)
        } else {
            if self.blow.is_some() {
                cut_off(&system, &labels, index, &self.pressed, &mut report);
            }
            Cracked::Parted(system, labels, report)
        }
    }
}

/// Ends the force of each contact when the piece under it is cut free: what pushes later pushes that piece alone, which whoever moves the
/// pieces finds out. A piece of more than half of the body bears the whole blow. The cracks themselves have run under the whole force: their motion is
/// not found anew.
fn cut_off(
    system: &CrackSystem,
    labels: &Labels,
    index: &MeshIndex,
    pressed: &[u32],
    report: &mut ImpactReport,
) {
    let asset = system.asset;
    // A piece's surface has no triangles of mesh nodes.
    if asset.portion.is_some() || pressed.len() != report.contacts.len() {
        return;
    }
    let label = |v: u32| labels.of_node[v as usize];
    for (contact, &triangle) in report.contacts.iter_mut().zip(pressed) {
        let Some(triangle) = asset.surface.triangles.get(triangle as usize) else {
            continue;
        };
        let piece = label(triangle[0]);
        if index.is_most(labels, piece) {
            continue;
        }
        let cuts = system.cracks.iter().flat_map(|crack| &crack.elements);
        let around = cuts.filter(|cut| {
            let labels = asset.fracture.tets[cut.tet as usize].map(label);
            labels.contains(&piece) && labels != [piece; 4]
        });
        let free = around.map(|cut| cut.time).fold(0.0, f64::max);
        contact.end_at(free, report.time_step);
    }
    let durations = report.contacts.iter().map(|contact| contact.duration);
    report.contact_duration = durations.fold(0.0, f64::max);
}

/// What has been met so far.
#[derive(Clone, Copy, Debug, Default)]
struct Looked {
    peak: Peak,
    asked_clusters: bool,
    /// Largest bound of what was passed over, Pa.
    passed_over: f32,
    /// Largest bound of what was passed over, as the weakest point would feel it, Pa.
    as_weakest: f32,
}
