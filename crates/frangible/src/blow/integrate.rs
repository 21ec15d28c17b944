//! The integration of a blow, substep by substep.

use std::f64::consts::{PI, TAU};

use super::Complement;
use super::bank::{BankState, dot};
use super::complement::Residual;
use super::plan::Plan;
use super::star::Star;
use crate::body::Body;
use crate::config::{CrackTiming, FractureConfig};
use crate::contact::{Contact, Pulse, Touch};
use crate::crack::{CrackSystem, StressField};
use crate::error::InputError;
use crate::modal::Motion;
use crate::near_field::NearField;
use crate::outcome::ContactReport;
use crate::stress::{DisplacementBatch, Symmetric3, lane};

/// A blow of so many substeps is cut off: a contact that lasts this long is none of a blow's.
const MOST_SUBSTEPS: usize = 60_000;

/// Most time steps of one impact; a longer motion is cut there (the cut shows in the report's number of steps).
const MOST_STEPS: usize = 20_000;

/// Mode i is significantly excited when its amplitude reaches this share of the largest.
const SIGNIFICANT: f64 = 0.05;

/// Periods of the lowest significantly excited mode that are looked at.
const PERIODS: f64 = 1.5;

/// Rounds over all contacts until their forces agree.
const MOST_ROUNDS: usize = 60;

/// A star counts anew when it gives way by this factor more.
const GREW: f64 = 1.3;

/// From a substep on the wall under a contact gives way by so much more.
#[derive(Clone, Copy, Debug)]
struct Softening {
    contact: usize,
    substep: usize,
    /// m/N.
    compliance: f64,
}

/// A blow, integrated: the forces of its contacts and the motion of the body.
#[derive(Clone, Debug)]
pub struct Blow {
    plan: Plan,
    instant: bool,
    /// Forces after each substep, N, contact after contact.
    forces: Vec<f64>,
    /// Time steps until the contacts have parted.
    contact_steps: usize,
    /// Speed of each striker away from the body as a rigid one after it, m/s.
    departures: Vec<f64>,
    energy_at_parting: f64,
    /// What stars of cracks have made of the walls under the contacts.
    stars: Vec<Softening>,
    /// What the body does.
    pub(crate) motion: Motion,
}

impl Blow {
    /// The blow of these contacts on a body, which nothing breaks; none where nothing pushes.
    ///
    /// # Errors
    /// What [`Contact::validate`] and [`FractureConfig::validate`] refuse.
    pub fn new(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Result<Option<Self>, InputError> {
        Self::with_substep(body, contacts, config, None)
    }

    /// [`Blow::new`] with substeps no longer than this, s: what the error of the default is measured with.
    #[doc(hidden)]
    pub fn with_substep(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Result<Option<Self>, InputError> {
        contacts.iter().try_for_each(Contact::validate)?;
        config.validate()?;
        Ok(Self::integrated(body, contacts, config, longest))
    }

    /// [`Blow::new`] of contacts that have been checked.
    pub(crate) fn of_valid(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Option<Self> {
        Self::integrated(body, contacts, config, None)
    }

    fn integrated(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Option<Self> {
        let plan = Plan::new(body, contacts, config, longest)?;
        let mut blow = Self {
            plan,
            instant: config.timing == CrackTiming::Instant,
            forces: Vec::new(),
            contact_steps: 0,
            departures: Vec::new(),
            energy_at_parting: 0.0,
            stars: Vec::new(),
            motion: Motion::default(),
        };
        let run = blow.run(&[]);
        blow.take(body, run);
        Some(blow)
    }

    /// The most energy that strikers and body can lose by meeting, J: what they hold of motion against each other at the contacts.
    /// Scripts bring none.
    pub(crate) fn approach_energy(&self) -> f64 {
        self.plan.approach_energy()
    }

    /// Whether strikers push, and no script.
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

    /// What the contacts push each mode with, as given impulses would, N·s/√kg.
    pub(crate) fn modal_impulse(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.plan.modes];
        let count = self.plan.sites.len();
        for (k, drive) in self.plan.drive.iter().enumerate() {
            let impulse: f64 =
                self.forces.iter().skip(k).step_by(count).sum::<f64>() * self.substep();
            for (sum, xi) in sums.iter_mut().zip(drive) {
                *sum += impulse * xi;
            }
        }
        sums
    }

    /// Its time steps, and a half-sine of its length.
    pub(crate) fn pulse(&self) -> Pulse {
        let duration = self.duration().max(self.substep());
        Pulse {
            duration,
            amplitude: 0.5 * PI / duration,
            time_step: self.plan.time_step,
            contact_steps: self.contact_steps,
            total_steps: self.motion.steps(),
            longest_step: self.plan.time_step,
        }
    }

    /// How long the contacts push, s.
    pub(crate) fn duration(&self) -> f64 {
        let count = self.plan.sites.len();
        let last = self.forces.iter().rposition(|&f| f > 0.0);
        last.map_or(0.0, |i| (i / count + 1) as f64 * self.substep())
    }

    /// Hertz' time of the contacts, the shortest, s.
    pub(crate) fn hertz_time(&self) -> f64 {
        let times = self.plan.sites.iter().map(|s| s.hertz_time);
        times.fold(f64::INFINITY, f64::min)
    }

    fn substep(&self) -> f64 {
        self.plan.time_step / self.plan.substeps as f64
    }

    /// What became of each contact.
    #[must_use]
    pub fn reports(&self) -> Vec<ContactReport> {
        let count = self.plan.sites.len();
        let dt = self.substep();
        let of = |(k, site): (usize, &super::plan::Site)| {
            let forces = || self.forces.iter().skip(k).step_by(count);
            let peak = forces().copied().fold(0.0, f64::max);
            let sampled = forces().skip(self.plan.substeps - 1);
            ContactReport {
                point: site.touch.contact.point,
                normal: site.touch.contact.normal,
                approach_speed: f64::from(site.touch.contact.approach_speed),
                impulse: forces().sum::<f64>() * dt,
                peak_force: peak,
                duration: forces()
                    .rposition(|&f| f > 0.0)
                    .map_or(0.0, |i| (i + 1) as f64 * dt),
                contact_radius: (site.near.as_ref())
                    .map_or(site.spring.contact_radius(peak), |near| near.contact_radius),
                departure_speed: self.departures[k],
                force: sampled
                    .step_by(self.plan.substeps)
                    .map(|&f| f as f32)
                    .collect(),
            }
        };
        self.plan.sites.iter().enumerate().map(of).collect()
    }

    /// Energy of all modes and wall oscillators when the contact parts, and what the motion of approach has lost, J: of one contact,
    /// without damping, the same but for the error of the substeps.
    #[must_use]
    pub fn energies(&self) -> [f64; 2] {
        let mass = 1.0 / self.plan.inverse_mass[0];
        let before = f64::from(self.plan.sites[0].touch.contact.approach_speed);
        let after = self.departures[0];
        [
            self.energy_at_parting,
            0.5 * mass * (before * before - after * after),
        ]
    }

    /// The body's stress at the weak place of fracture tetrahedron `tet` at a time step of the blow, Pa, as cracks feel it.
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

    /// Whether cracks have cut the wall under a contact so far that its force must be found anew: number of the contact, and what the
    /// star gives way by, m/N.
    pub(crate) fn weakened(&self, system: &CrackSystem) -> Option<(usize, f64)> {
        let sites = self.plan.sites.iter().enumerate();
        let mut walls = sites.filter_map(|(k, site)| Some((k, site.near.as_ref()?)));
        walls.find_map(|(k, near)| {
            let star = Star::of(system, &near.place, near.wall.thickness)?;
            let compliance = star.compliance(near.wall.bending_stiffness);
            let known = self.stars.iter().rev().find(|s| s.contact == k);
            let before = known.map_or(0.0, |s| s.compliance);
            (compliance > GREW * before).then_some((k, compliance))
        })
    }

    /// Whether contacts still push at a time step.
    pub(crate) fn pushes_at(&self, step: usize) -> bool {
        step < self.contact_steps
    }

    /// Whether anything bears a contact still.
    pub(crate) fn bears(&self, contact: usize) -> bool {
        let known = self.stars.iter().filter(|s| s.contact == contact);
        known.into_iter().all(|s| s.compliance.is_finite())
    }

    /// The node of the fracture mesh next to each contact, of those that are the body's own.
    pub(crate) fn bearing_nodes(&self, body: &Body) -> Vec<u32> {
        let asset = &*body.asset;
        let mesh = &asset.fracture;
        let origin = body.origin().as_vec3();
        let node = |touch: &Touch| {
            let point = touch.contact.point + origin;
            let tet = asset.surface.tets[touch.triangle as usize] as usize;
            let away = |v: u32| mesh.positions[v as usize].distance_squared(point);
            let own = |v: &u32| asset.portion.as_ref().is_none_or(|p| p.has_node(*v));
            let nodes = mesh.tets[tet].into_iter();
            let nearest = nodes
                .filter(own)
                .min_by(|&a, &b| away(a).total_cmp(&away(b)));
            nearest.unwrap_or(mesh.tets[tet][0])
        };
        self.plan.sites.iter().map(|s| node(&s.touch)).collect()
    }

    /// Goes on from `now`, s, with contacts where the body gives way by so much more than it did, m/N. What was before stays as it was,
    /// bit for bit.
    pub(crate) fn weaken(&mut self, body: &Body, contacts: &[(usize, f64)], now: f64) {
        let substep = (now / self.substep()).round() as usize;
        let softer = contacts.iter().map(|&(contact, compliance)| Softening {
            contact,
            substep,
            compliance,
        });
        self.stars.extend(softer);
        let known = (substep * self.plan.sites.len()).min(self.forces.len());
        let run = self.run(&self.forces[..known]);
        self.take(body, run);
    }

    fn take(&mut self, body: &Body, run: Record) {
        self.motion = self.motion_of(body, &run);
        self.energy_at_parting = run.energy_at_parting;
        self.contact_steps = run.contact_steps;
        self.departures = run.speeds.iter().map(|v| -v).collect();
        self.forces = run.forces;
    }

    /// `known`: forces from the beginning on that are known already.
    fn run(&self, known: &[f64]) -> Record {
        // With the widest vectors that this processor has; the same operations in the same order, so the same bits.
        pulp::Arch::new().dispatch(Run {
            plan: &self.plan,
            known,
            stars: &self.stars,
            instant: self.instant,
        })
    }

    fn motion_of(&self, body: &Body, run: &Record) -> Motion {
        let plan = &self.plan;
        let count = plan.sites.len();
        let asset = &*body.asset;
        let mut complement = Complement::default();
        let mut first = 0;
        for (k, site) in plan.sites.iter().enumerate() {
            let sampled = run.forces.iter().skip((plan.substeps - 1) * count + k);
            let force: Vec<f32> = sampled
                .step_by(plan.substeps * count)
                .map(|&f| f as f32)
                .collect();
            if let Some(near) = &site.near {
                let oscillators = near.oscillators.len();
                let rows = run.swing.chunks_exact(run.width);
                let frequencies = &plan.oscillators[near.oscillators.clone()];
                // From ω p of the oscillator of unit mass to ω² q of the one that the force itself drives, N.
                let scale: Vec<f32> = (near.bands.oscillators.iter().zip(frequencies))
                    .map(|(band, (w, _))| (w / band.give.sqrt()) as f32)
                    .collect();
                let mut swing = Vec::with_capacity(rows.len() * oscillators);
                for row in rows {
                    let own = &row[first..first + oscillators];
                    swing.extend(own.iter().zip(&scale).map(|(x, s)| x * s));
                }
                first += oscillators;
                let mut across: Vec<f32> = force.iter().map(|f| f * near.across as f32).collect();
                across.resize(run.near_steps, 0.0);
                let (place, wall, bands) = (near.place, &near.wall, &near.bands);
                complement
                    .near
                    .push(NearField::new(place, wall, bands, &swing, &across));
            }
            complement
                .residuals
                .extend(Residual::new(asset, &site.residual, force));
        }
        Motion {
            amplitudes: run.amplitudes.clone(),
            modes: plan.modes,
            peak_energy: run.peak_energy,
            peak_strain_energy: run.peak_strain_energy,
            coarse: (plan.coarser > 1.0).then_some((run.near_steps, plan.coarser)),
            complement,
        }
    }
}

/// What an integration found.
struct Record {
    /// Forces after each substep, N.
    forces: Vec<f64>,
    /// Amplitudes of the modes at each time step, m·√kg.
    amplitudes: Vec<f32>,
    /// ω p of all wall oscillators at each time step until the near field has gone, m·√kg/s.
    swing: Vec<f32>,
    /// How many oscillators there are in a row of `swing`, at least 1.
    width: usize,
    near_steps: usize,
    contact_steps: usize,
    /// Speed of each striker into the body after the blow, m/s.
    speeds: Vec<f64>,
    peak_energy: f64,
    peak_strain_energy: f64,
    energy_at_parting: f64,
}

/// The integration.
struct Run<'a> {
    plan: &'a Plan,
    /// Forces from the beginning on that are known already.
    known: &'a [f64],
    stars: &'a [Softening],
    /// Whether nothing is looked at after the contact.
    instant: bool,
}

impl pulp::NullaryFnOnce for Run<'_> {
    type Output = Record;

    #[inline(always)]
    fn call(self) -> Record {
        let plan = self.plan;
        let count = plan.sites.len();
        let dt = plan.time_step / plan.substeps as f64;
        let mut state = BankState::rest(plan.oscillators.len());
        let mut ways = vec![0.0; count];
        let mut speeds: Vec<f64> = (plan.sites.iter())
            .map(|s| f64::from(s.touch.contact.approach_speed))
            .collect();
        let mut forces = vec![0.0; count];
        let mut next = vec![0.0; count];
        let mut growth = vec![0.0; count];
        let mut bases = vec![0.0; count];
        let mut weakness = vec![0.0; count];
        // Square roots of the springs' dents, m^½.
        let mut roots = vec![0.0; count];
        // What a unit growth of force l takes from gap k within a substep.
        let mut give = vec![0.0; count * count];
        for k in 0..count {
            for l in 0..count {
                give[k * count + l] = plan.inverse_mass[k * count + l] * dt * dt / 6.0
                    + plan.fine.give(&plan.gap[k], &plan.drive[l]);
            }
        }
        let modes = plan.modes;
        let mut record = Record {
            forces: Vec::new(),
            amplitudes: Vec::new(),
            swing: Vec::new(),
            width: (plan.oscillators.len() - modes).max(1),
            near_steps: 0,
            contact_steps: 0,
            speeds: Vec::new(),
            peak_energy: 0.0,
            peak_strain_energy: 0.0,
            energy_at_parting: 0.0,
        };
        let mut substep = 0;
        let mut parted = false;
        while !(parted && substep % plan.substeps == 0) {
            let t = (substep + 1) as f64 * dt;
            plan.fine.coast(&mut state, &plan.drive, &forces);
            for k in 0..count {
                // The gap if no force grew, less what stays of the forces in the static part.
                let fall: f64 = (0..count)
                    .map(|l| plan.inverse_mass[k * count + l] * forces[l])
                    .sum();
                bases[k] =
                    ways[k] + speeds[k] * dt - 0.5 * fall * dt * dt - dot(&plan.gap[k], &state.x);
            }
            for star in self.stars.iter().filter(|star| star.substep == substep) {
                weakness[star.contact] = star.compliance;
            }
            match self.known.get(substep * count..(substep + 1) * count) {
                Some(known) => next.copy_from_slice(known),
                None if parted => next.fill(0.0),
                None => solve(
                    plan, &bases, &give, &weakness, &forces, t, &mut roots, &mut next,
                ),
            }
            for k in 0..count {
                growth[k] = next[k] - forces[k];
            }
            plan.fine.grow(&mut state, &plan.drive, &growth);
            for k in 0..count {
                let row = &plan.inverse_mass[k * count..(k + 1) * count];
                let (mut held, mut mean) = (0.0, 0.0);
                for ((b, f), g) in row.iter().zip(&forces).zip(&growth) {
                    held += b * (0.5 * f + g / 6.0);
                    mean += b * (f + 0.5 * g);
                }
                ways[k] += speeds[k] * dt - held * dt * dt;
                speeds[k] -= mean * dt;
            }
            forces.copy_from_slice(&next);
            record.forces.extend_from_slice(&forces);
            substep += 1;
            if substep % plan.substeps == 0 {
                record.sample(plan, &state, &forces, true);
            }
            if !parted {
                parted = self.has_parted(&state, &speeds, &forces, &weakness, t)
                    || substep >= MOST_SUBSTEPS;
                if parted {
                    record.energy_at_parting = energies(&state)[0];
                }
            }
        }
        record.contact_steps = substep / plan.substeps;
        record.speeds = speeds;
        self.ring(&mut record, state);
        record
    }
}

impl Run<'_> {
    /// Whether every contact is open and opening further, or has nothing left to push.
    #[inline(always)]
    fn has_parted(
        &self,
        state: &BankState,
        speeds: &[f64],
        forces: &[f64],
        weakness: &[f64],
        t: f64,
    ) -> bool {
        let plan = self.plan;
        if forces.iter().any(|&f| f > 0.0) {
            return false;
        }
        plan.sites.iter().enumerate().all(|(k, site)| {
            if weakness[k].is_infinite() {
                return true;
            }
            if let Some([_, duration]) = site.script {
                return t >= duration;
            }
            // ω q and q̇ are felt alike.
            let give: f64 = (plan.gap[k].iter().zip(&plan.oscillators).zip(&state.v))
                .map(|((gap, (w, _)), v)| gap * w * v)
                .sum();
            speeds[k] < give
        })
    }

    /// The free motion after the contacts.
    #[inline(always)]
    fn ring(&self, record: &mut Record, mut state: BankState) {
        let plan = self.plan;
        let time_step = plan.time_step;
        if self.instant {
            record.near_steps = record.contact_steps;
            return;
        }
        let amplitude = |i: usize| state.x[i].hypot(state.v[i]) / plan.oscillators[i].0;
        let largest = (0..plan.modes).map(amplitude).fold(0.0, f64::max);
        let low = (0..plan.modes).find(|&i| amplitude(i) >= SIGNIFICANT * largest);
        let period = low.map_or(0.0, |i| TAU / plan.oscillators[i].0);
        // After the blow its waves leave within half a period of the lowest of them.
        let near = plan.sites.iter().filter_map(|s| s.near.as_ref());
        let leave = near.map(|n| PI / n.lowest).fold(0.0, f64::max);
        let leave = ((leave / time_step).ceil() as usize).min(MOST_STEPS);
        record.near_steps = record.contact_steps + leave;
        for _ in record.contact_steps..record.near_steps {
            plan.step.coast(&mut state, &[], &[]);
            record.sample(plan, &state, &[], true);
        }
        let rest = PERIODS * period - record.near_steps as f64 * time_step;
        let steps = (rest / (plan.coarser * time_step)).ceil().max(0.0) as usize;
        let steps = steps.min(MOST_STEPS);
        record.amplitudes.reserve_exact(steps * plan.modes);
        for _ in 0..steps {
            plan.coarse.coast(&mut state, &[], &[]);
            record.sample(plan, &state, &[], false);
        }
    }
}

impl Record {
    #[inline(always)]
    fn sample(&mut self, plan: &Plan, state: &BankState, forces: &[f64], near: bool) {
        let (modes, all) = (plan.modes, plan.oscillators.len());
        let amplitudes = state.x[..modes].iter().zip(&plan.periods);
        self.amplitudes
            .extend(amplitudes.map(|(x, period)| (x * period) as f32));
        if near {
            self.swing
                .extend(state.x[modes..all].iter().map(|&x| x as f32));
        }
        let count = forces.len();
        let mut held = 0.0;
        for k in 0..count {
            for l in 0..count {
                held += 0.5 * forces[k] * plan.compliance[k * count + l] * forces[l];
            }
        }
        let [whole, strain] = energies(state);
        self.peak_energy = self.peak_energy.max(whole + held);
        self.peak_strain_energy = self.peak_strain_energy.max(strain + held);
    }
}

/// Energy and strain energy of all oscillators, J.
#[inline(always)]
fn energies(state: &BankState) -> [f64; 2] {
    let strain = 0.5 * dot(&state.x, &state.x);
    [strain + 0.5 * dot(&state.v, &state.v), strain]
}

/// The forces at the end of a substep, N. `roots`: what the springs begin with, and end with.
#[inline(always)]
#[expect(
    clippy::too_many_arguments,
    reason = "the state of one loop, taken apart"
)]
fn solve(
    plan: &Plan,
    bases: &[f64],
    give: &[f64],
    weakness: &[f64],
    forces: &[f64],
    t: f64,
    roots: &mut [f64],
    next: &mut [f64],
) {
    let count = bases.len();
    next.copy_from_slice(forces);
    for _ in 0..MOST_ROUNDS {
        let mut change = 0.0_f64;
        let mut largest = 0.0_f64;
        for k in 0..count {
            let site = &plan.sites[k];
            let found = match site.script {
                _ if weakness[k].is_infinite() => 0.0,
                Some([impulse, duration]) if t < duration => {
                    0.5 * PI * impulse / duration * (PI * t / duration).sin()
                }
                Some(_) => 0.0,
                None => {
                    let mut gap = bases[k];
                    for l in 0..count {
                        let i = k * count + l;
                        gap += give[i] * forces[l];
                        if l != k {
                            gap -= (give[i] + plan.compliance[i]) * next[l];
                        }
                    }
                    let i = k * count + k;
                    let compliance = plan.compliance[i] + weakness[k];
                    site.spring.force(gap, give[i] + compliance, &mut roots[k])
                }
            };
            change = change.max((found - next[k]).abs());
            largest = largest.max(found);
            next[k] = found;
        }
        if count == 1 || change <= 1e-12 * largest {
            break;
        }
    }
}
