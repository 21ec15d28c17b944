//! A blow, and how cracks change it.

use std::sync::Arc;

use glam::DVec3;

use super::apart::Apart;
use super::flight::Setup;
use super::groups::Groups;
use super::integrate::{MOST_SUBSTEPS, Progress, Run, Softening, run};
use super::parted::Parted;
use super::plan::{Plan, Site};
use super::record::Record;
use super::star::Star;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{self, Contact};
use crate::crack::{CrackSystem, StressField};
use crate::error::InputError;
use crate::motion::{DisplacementBatch, Motion, Residual};
use crate::stress::{STRIDE, Shape, Symmetric3, lane};

/// Factor by which a star's compliance must have grown for the forces to be found anew.
const GREW: f64 = 1.3;

/// Longest duration of a blow that breaks a body, in durations of the blow on the whole body: what still rests on a contact after that is held by it,
/// and no longer struck.
const LONGER: usize = 4;

/// Batches of time steps for which a motion that cracks have changed is followed at a time: cracks mostly change it again before its end.
const BATCHES: usize = 2;

/// A blow, integrated: the forces of its contacts and the motion of the body.
#[derive(Clone, Debug)]
pub struct Blow {
    pub(super) plan: Plan,
    instant: bool,
    /// Substeps after which the contacts are cut off.
    longest: usize,
    /// The shapes that follow each contact's force.
    shapes: Vec<Option<Arc<Shape>>>,
    pub(super) record: Record,
    pub(super) progress: Progress,
    /// An earlier state, from which the motion is found anew when cracks change it.
    saved: Option<Box<Progress>>,
    /// The node of the fracture mesh under each contact.
    nodes: Vec<u32>,
    /// Softening of the body under the contacts by cracks.
    softer: Vec<Softening>,
    /// Partings of pieces, in the order of time.
    pub(super) parted: Vec<Parted>,
    /// Motion of the body over time.
    pub(crate) motion: Motion,
}

impl Blow {
    /// Integrates the blow of these contacts on a body that does not break. Returns `None` if no contact pushes.
    ///
    /// # Errors
    /// Returns the errors of [`Contact::validate`] and [`FractureConfig::validate`].
    pub fn new(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Result<Option<Self>, InputError> {
        Self::with_substep(body, contacts, config, None)
    }

    /// [`Blow::new`] with substeps no longer than `longest`, s: used to measure the error of the default.
    #[doc(hidden)]
    pub fn with_substep(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Result<Option<Self>, InputError> {
        contacts.iter().try_for_each(Contact::validate)?;
        config.validate()?;
        let contacts = contact::in_one(contacts);
        Ok(Self::of_valid(body, &contacts, config, longest))
    }

    /// [`Blow::with_substep`] of contacts that have been checked, with scripts that push [in one](contact::in_one) direction.
    pub(crate) fn of_valid(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Option<Self> {
        let plan = Plan::new(body, contacts, config, longest)?;
        let shape = |site: &Site| Residual::shape(&body.asset, &site.residual);
        let motion = Motion {
            modes: plan.modes,
            ..Motion::default()
        };
        let mut blow = Self {
            shapes: plan.sites.iter().map(shape).collect(),
            progress: Progress::new(&plan),
            record: Record::default(),
            saved: None,
            nodes: plan.nodes(body),
            plan,
            instant: config.is_paper(),
            longest: MOST_SUBSTEPS,
            softer: Vec::new(),
            parted: Vec::new(),
            motion,
        };
        blow.integrate(usize::MAX);
        blow.longest = (LONGER * blow.contact_steps() * blow.plan.substeps).min(MOST_SUBSTEPS);
        Some(blow)
    }

    /// The most energy that strikers and body can lose by meeting, J: the kinetic energy of their relative motion at the contacts. Scripts bring
    /// none.
    pub(crate) fn approach_energy(&self) -> f64 {
        self.plan.approach_energy()
    }

    /// Returns true if strikers push and no scripts do.
    pub(crate) fn is_of_strikers(&self) -> bool {
        self.plan.sites.iter().all(|site| site.script.is_none())
    }

    /// Time step of the motion, s.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        self.plan.time_step
    }

    /// Surface triangles that the contacts press on.
    pub(crate) fn pressed(&self) -> Vec<u32> {
        self.plan.sites.iter().map(|s| s.touch.triangle).collect()
    }

    /// Number of time steps until the contacts have parted, or so far if they have not.
    pub(super) fn contact_steps(&self) -> usize {
        let after = self.progress.after;
        after.map_or(self.progress.step, |after| after.contact_steps)
    }

    pub(super) fn substep(&self) -> f64 {
        self.plan.time_step / self.plan.substeps as f64
    }

    /// The motion of the body over time.
    #[doc(hidden)]
    #[must_use]
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Velocity and angular velocity of each piece that moves on its own at the end, relative to the rigid motion of the whole body, m/s and rad/s.
    #[doc(hidden)]
    #[must_use]
    pub fn drifts(&self) -> Vec<[DVec3; 2]> {
        let Progress { flight, state, .. } = &self.progress;
        flight.drifts(self.setup(), state)
    }

    /// Motion of each group relative to the rigid motion of the body; none if nothing has parted.
    pub(crate) fn apart(&self, body: &Body) -> Option<Apart> {
        let parted = self.parted.last()?;
        Some(Apart {
            of_node: parted.groups.of_node.clone(),
            motions: parted.motions(&self.drifts()),
            held: body.asset.is_supported(),
        })
    }

    /// Parts pieces at a time step, as cracks do. `piece_of_node`: piece of each node of the fracture mesh, the largest first.
    #[doc(hidden)]
    pub fn part(&mut self, body: &Body, piece_of_node: &[u32], pieces: usize, step: usize) {
        let (groups, _) = self.groups(body, (piece_of_node, pieces), &self.nodes(body, step));
        self.go_on(body, step, &[], groups);
        self.integrate(usize::MAX);
    }

    /// Returns the stress at the weak point of fracture tetrahedron `tet` at a time step of the blow, Pa, as used for crack initiation.
    #[must_use]
    pub fn stress(
        &self,
        body: &Body,
        tet: u32,
        step: usize,
        config: &FractureConfig,
    ) -> Symmetric3 {
        let pressed = self.pressed();
        let mut displacement = DisplacementBatch::new(&body.asset);
        displacement.seek(&self.motion, step);
        let mut field = StressField::new(body, config, &self.motion, &pressed, &mut displacement);
        field.step = step;
        field.at_weak_point(tet as usize).stress(lane(step))
    }

    /// Contacts whose forces must be found anew, because cracks have cut the wall under them: their numbers, and the compliance of the star under
    /// each, m/N.
    pub(crate) fn weakened(&self, system: &CrackSystem) -> Vec<(usize, f64)> {
        let sites = self.plan.sites.iter().enumerate();
        let walls = sites.filter_map(|(k, site)| Some((k, site.near.as_ref()?)));
        let weakened = walls.filter_map(|(k, near)| {
            let star = Star::of(system, &near.place, near.wall.material.thickness)?;
            let compliance = star.compliance(near.wall.material.bending_stiffness);
            let known = self.softer.iter().rev().find(|s| s.contact == k);
            let before = known.map_or(0.0, |s| s.compliance);
            (compliance > GREW * before).then_some((k, compliance))
        });
        weakened.collect()
    }

    /// Returns true if contacts still push at a time step.
    pub(crate) fn pushes_at(&self, step: usize) -> bool {
        (self.progress.after).is_none_or(|after| step < after.contact_steps)
    }

    /// Groups of nodes that move on their own once these pieces have parted, none if no new group has formed. Also, for each piece,
    /// false if it has parted but moves with its parent group. `pushed`: the [nodes](Self::nodes) under contacts.
    pub(crate) fn groups(
        &self,
        body: &Body,
        pieces: (&[u32], usize),
        pushed: &[u32],
    ) -> (Option<Groups>, Vec<bool>) {
        let before = self.parted.last().map(|parted| &parted.groups);
        let index = &body.prepared.index;
        Groups::next(before, &body.asset, index, pieces, pushed)
    }

    /// Node under each contact at a time step.
    pub(crate) fn nodes(&self, body: &Body, step: usize) -> Vec<u32> {
        let mut nodes = self.nodes.clone();
        if let Some(parted) = self.parted.last() {
            let until = step * self.plan.substeps;
            parted.go_on(
                body,
                &self.plan,
                &self.progress.flight.gone_on,
                until,
                &mut nodes,
            );
        }
        nodes
    }

    /// Goes on from a time step with a body of which these groups have parted, and whose compliance under these contacts is larger by so much,
    /// m/N. The steps before stay as they were, bit for bit; those after it are known [as far as they are asked for](Self::go_further).
    pub(crate) fn go_on(
        &mut self,
        body: &Body,
        step: usize,
        contacts: &[(usize, f64)],
        groups: Option<Groups>,
    ) {
        let saved = self.saved.take().filter(|saved| saved.step <= step);
        self.progress = saved.map_or_else(|| Progress::new(&self.plan), |saved| *saved);
        self.record.forget_after(&self.progress, &self.plan);
        let energies = self.record.energies.iter().map(|e| e[0]);
        let most = energies.fold(0.0, f64::max);
        self.motion.keep(self.progress.step, most);
        self.follow(step);
        self.saved = Some(Box::new(self.progress.clone()));
        let substep = step * self.plan.substeps;
        let softer = contacts.iter().map(|&(contact, compliance)| Softening {
            contact,
            substep,
            compliance,
        });
        self.softer.extend(softer);
        if let Some(groups) = groups {
            self.nodes = self.nodes(body, step);
            let nodes = &self.nodes;
            let (plan, before) = (&self.plan, self.parted.last());
            let parted = Parted::new(body, plan, before, groups, nodes, [step, substep]);
            self.parted.push(parted);
        }
        self.integrate(self.horizon());
    }

    /// Follows the motion some steps further. Returns false if it is over.
    pub(crate) fn go_further(&mut self) -> bool {
        let goes = !self.progress.is_over();
        if goes {
            self.saved = Some(Box::new(self.progress.clone()));
            self.integrate(self.horizon());
        }
        goes
    }

    /// Follows the motion until the contacts have parted.
    pub(crate) fn end_contacts(&mut self) {
        while self.progress.after.is_none() {
            self.integrate(self.horizon());
        }
    }

    /// Upper bound of the strain energy over the whole motion, J; none while contacts push.
    pub(crate) fn most_energy(&self) -> Option<f64> {
        // Without pushes, the energy that is there only changes its form.
        self.progress.after?;
        let [whole, _] = self.record.energies.last()?;
        Some(self.motion.peak_strain_energy.max(*whole))
    }

    /// Time step to which the motion is followed next, a few whole batches on.
    fn horizon(&self) -> usize {
        match self.instant {
            true => usize::MAX,
            false => (self.progress.step / STRIDE + BATCHES) * STRIDE,
        }
    }

    fn setup(&self) -> Setup<'_> {
        Setup {
            plan: &self.plan,
            parted: &self.parted,
        }
    }

    /// Follows the motion to a time step.
    fn follow(&mut self, until: usize) {
        run(Run {
            setup: Setup {
                plan: &self.plan,
                parted: &self.parted,
            },
            softer: &self.softer,
            instant: self.instant,
            longest: self.longest,
            until,
            progress: &mut self.progress,
            record: &mut self.record,
            motion: &mut self.motion,
        });
    }

    /// Follows the motion to a time step, with the parts that the modes leave out.
    fn integrate(&mut self, until: usize) {
        let before = self.progress.step;
        self.follow(until);
        let plan = &self.plan;
        self.motion.coarse = (self.progress.after)
            .filter(|_| plan.coarser > 1.0)
            .map(|after| (after.near_steps, plan.coarser));
        if before < self.progress.near_steps() {
            self.motion.complement =
                self.record
                    .complement(plan, &self.shapes, self.progress.near_steps());
        }
    }
}
