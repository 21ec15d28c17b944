//! Data for the integration of a blow: the contacts' forces on the modes and wall oscillators, the contributions of these to the gaps, the
//! residual compliance, and the time steps.

use std::ops::Range;
use std::sync::Arc;

use super::Spring;
use super::bank::{Bank, Pushes, padded, spans};
use super::couple::add_waves;
use super::receptance::Push;
use super::wall::{NearPlan, place};
use crate::body::Body;
use crate::config::{DurationModel, FractureConfig};
use crate::contact::{self, Contact, Load, Receptance, Touch, modal_load};
use crate::near_field::NearShapes;

/// Hertz's time over the longest substep. Measured: the energy error then is 3e-5 of what the striker loses (`frangible-lab verify`, case
/// `blow`), and falls with the square of the substep.
const SUBSTEPS_PER_HERTZ_TIME: f64 = 100.0;

/// Hertz's time over the longest substep where both bodies vibrate: each integrates the blow for itself, and both must find the same impulse.
/// Measured: the impulses differ by less than 1e-5 of it, and with a hundred substeps by 7e-5.
const SUBSTEPS_OF_PAIRS: f64 = 400.0;

/// Most rounds over all contacts to find the energy of approach.
const APPROACH_ROUNDS: usize = 2000;

/// A contact, prepared for the integration.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) touch: Touch,
    pub(super) spring: Spring,
    /// A script's impulse, N·s, and duration, s, instead of a striker.
    pub(super) script: Option<[f64; 2]>,
    /// Expected duration of the contact, s: Hertz's time, or the script's.
    pub(super) duration: f64,
    pub(super) near: Option<NearPlan>,
    /// φ · (n + f) of every mode that follows the force, 1/√kg; only the part along the wall for those that the near field stands for.
    pub(super) residual: Vec<f64>,
}

/// Data for the integration of a blow.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) sites: Vec<Site>,
    /// Number of integrated modes.
    pub(super) modes: usize,
    /// Oscillators of the body: its modes and, after them, its wall oscillators.
    pub(super) own: usize,
    /// ω and d of the body's oscillators, then of [their copies without friction](Plan::feel_without_friction), then of breakable strikers.
    pub(super) oscillators: Vec<(f64, f64)>,
    /// Index of the first mode that contributes to the gaps: 0, or that of the [copies without friction](Plan::feel_without_friction).
    pub(super) felt_first: usize,
    /// α, s, and β, 1/s, of the damping α λ + β.
    pub(super) rayleigh: [f64; 2],
    /// Oscillators of breakable strikers.
    pub(super) strikers: Range<usize>,
    /// 1/ω of the modes, s.
    pub(super) periods: Vec<f64>,
    /// Push of each contact on each oscillator, 1/√kg.
    pub(super) drive: Vec<Vec<f64>>,
    /// Displacement of the body along each contact's push per ω q of each of its own oscillators, s/√kg.
    pub(super) ways: Vec<Vec<f64>>,
    /// Reduction of each contact's gap per ω q of each oscillator, s/√kg.
    pub(super) gap: Vec<Vec<f64>>,
    /// Oscillators driven by each contact.
    pub(super) pushed: Vec<Vec<Range<usize>>>,
    /// Oscillators that contribute to the gap of each contact.
    pub(super) felt: Vec<Vec<Range<usize>>>,
    /// B of the rigid bodies, 1/kg: row-major.
    pub(super) inverse_mass: Vec<f64>,
    /// c: residual compliance of both bodies of each contact, m/N: row-major.
    pub(super) compliance: Vec<f64>,
    /// Residual compliance of the body alone, m/N.
    pub(super) own_compliance: Vec<f64>,
    /// Time step at which stresses are evaluated, s.
    pub(super) time_step: f64,
    /// Factor by which time steps are longer once the near field has gone.
    pub(super) coarser: f64,
    /// Number of substeps in a time step.
    pub(super) substeps: usize,
    /// The oscillators through a substep.
    pub(super) fine: Bank,
    /// The body's oscillators through a time step.
    pub(super) step: Bank,
    /// The body's oscillators through a longer time step, once the near field has gone.
    pub(super) coarse: Bank,
}

impl Plan {
    /// Prepares the blow of these contacts; `None` if nothing pushes. `longest`: the longest substep, s.
    pub(super) fn new(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Option<Self> {
        let pushing = contacts.iter().filter(|c| c.pushes(config.duration));
        let asset = &*body.asset;
        let modes = asset.modes.followed();
        let mut load = modal_load(body, pushing);
        if load.touches.is_empty() {
            return None;
        }
        let inverse_mass = inverse_masses(body, &load);
        load.modal_impulse = stopping(body, &load, &inverse_mass);
        let count = load.touches.len();
        let mut sites: Vec<Site> = Vec::with_capacity(count);
        let mut felt: Vec<(Receptance, Push)> = Vec::with_capacity(count);
        let mut oscillators: Vec<(f64, f64)> = (0..modes)
            .map(|i| {
                let damping = asset.modes.damping(i, &asset.material);
                (asset.modes.eigenvalues[i].sqrt(), damping)
            })
            .collect();
        for (k, touch) in load.touches.iter().enumerate() {
            let mass = 1.0 / inverse_mass[k * count + k];
            let (site, of_site) = site(body, touch, mass, config, &mut oscillators);
            sites.push(site);
            felt.push(of_site);
        }
        let times = sites.iter().map(|s| s.duration);
        let shortest = times.fold(f64::INFINITY, f64::min);
        let pulse = contact::pulse(asset, &load, shortest, config);
        let time_step = pulse.time_step;
        let pair = (sites.iter()).any(|s| s.touch.contact.striker.receptance.is_some());
        let substeps = match pair {
            true => SUBSTEPS_OF_PAIRS,
            false => SUBSTEPS_PER_HERTZ_TIME,
        };
        let longest = longest.unwrap_or(shortest / substeps);
        let substeps = (time_step / longest).ceil() as usize;
        let width = padded(oscillators.len());
        let mut plan = Self {
            modes,
            inverse_mass,
            compliance: Vec::new(),
            own_compliance: Vec::new(),
            own: oscillators.len(),
            felt_first: 0,
            rayleigh: [
                asset.material.stiffness_damping,
                asset.material.mass_damping,
            ],
            strikers: 0..0,
            time_step,
            substeps: substeps.max(1),
            fine: Bank::default(),
            step: Bank::default(),
            coarse: Bank::default(),
            coarser: (pulse.longest_step / time_step).max(1.0),
            drive: vec![vec![0.0; width]; count],
            ways: Vec::new(),
            gap: vec![vec![0.0; width]; count],
            pushed: Vec::new(),
            felt: Vec::new(),
            periods: oscillators[..modes].iter().map(|(w, _)| 1.0 / w).collect(),
            oscillators,
            sites,
        };
        plan.couple_body(&felt);
        plan.add_strikers();
        let way = |drive: &Vec<f64>| {
            let own = drive[..padded(plan.own)].iter().zip(&plan.oscillators);
            let mut way: Vec<f64> = own.map(|(xi, (w, _))| xi / w).collect();
            way.resize(padded(plan.own), 0.0);
            way
        };
        plan.ways = plan.drive.iter().map(way).collect();
        let spans_of = |rows: &[Vec<f64>]| rows.iter().map(|row| spans(row)).collect();
        plan.pushed = spans_of(&plan.drive);
        plan.felt = spans_of(&plan.gap);
        plan.fine = Bank::new(&plan.oscillators, time_step / plan.substeps as f64);
        // After the blow the body swings alone.
        let own = &plan.oscillators[..plan.own];
        plan.step = Bank::new(own, time_step);
        plan.coarse = Bank::new(own, plan.coarser * time_step);
        Some(plan)
    }

    /// φ · n of the integrated modes in the gap of a contact, 1/√kg.
    pub(super) fn felt_by(&self, contact: usize) -> impl Iterator<Item = f64> {
        let gap = &self.gap[contact][self.felt_first..self.felt_first + self.modes];
        gap.iter()
            .zip(&self.oscillators)
            .map(|(gap, (w, _))| gap * w)
    }

    /// For each contact, the nearest of the body's own nodes of the fracture tetrahedron under it.
    pub(super) fn nodes(&self, body: &Body) -> Vec<u32> {
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
        self.sites.iter().map(|s| node(&s.touch)).collect()
    }

    /// Pushes of the contacts on the oscillators.
    pub(super) fn pushes(&self) -> Pushes<'_> {
        Pushes {
            drive: &self.drive,
            spans: &self.pushed,
        }
    }

    /// The most energy that the contacts can take from the motion of approach, J: the largest `v · J − ½ Jᵀ B J` of impulses J ≥ 0.
    ///
    /// The energy of springs and vibration at any time is at most this expression for the impulses so far.
    pub(super) fn approach_energy(&self) -> f64 {
        let count = self.sites.len();
        let speeds: Vec<f64> = (self.sites.iter())
            .map(|s| f64::from(s.touch.contact.approach_speed))
            .collect();
        let mut impulses = vec![0.0; count];
        let mut energy = 0.0;
        for _ in 0..APPROACH_ROUNDS {
            for k in 0..count {
                let row = &self.inverse_mass[k * count..(k + 1) * count];
                let taken: f64 = row.iter().zip(&impulses).map(|(b, j)| b * j).sum();
                impulses[k] = (impulses[k] + (speeds[k] - taken) / row[k]).max(0.0);
            }
            let before = energy;
            energy = (0..count)
                .map(|k| {
                    let row = &self.inverse_mass[k * count..(k + 1) * count];
                    let taken: f64 = row.iter().zip(&impulses).map(|(b, j)| b * j).sum();
                    impulses[k] * (speeds[k] - 0.5 * taken)
                })
                .sum();
            if energy - before <= 1e-9 * energy {
                break;
            }
        }
        energy
    }
}

/// B: change of the approach speed at contact k per unit impulse at contact l, 1/kg.
fn inverse_masses(body: &Body, load: &Load) -> Vec<f64> {
    let asset = &*body.asset;
    let count = load.touches.len();
    let mut matrix = vec![0.0; count * count];
    for (k, a) in load.touches.iter().enumerate() {
        for (l, b) in load.touches.iter().enumerate() {
            let [a, b] = [a, b].map(|t| (&t.contact.striker, t.contact.point, t.contact.normal));
            matrix[k * count + l] = contact::inverse_mass(asset, a, b, k == l);
        }
    }
    matrix
}

/// Modal impulses of the impulse that stops each striker, and of scripts. They decide which modes matter, and so the time step, which must not depend
/// on an engine's impulse: the impulse is a result here.
fn stopping(body: &Body, load: &Load, inverse_mass: &[f64]) -> Vec<f64> {
    let count = load.touches.len();
    let mut sums = vec![0.0; body.asset.modes.count()];
    for (k, touch) in load.touches.iter().enumerate() {
        let contact = &touch.contact;
        let impulse = match contact.is_script() {
            true => f64::from(contact.impulse),
            false => f64::from(contact.approach_speed) / inverse_mass[k * count + k],
        };
        let shape = touch.project(body, contact.direction());
        let pairs = sums.iter_mut().zip(shape);
        pairs.for_each(|(sum, xi)| *sum += impulse * xi);
    }
    sums
}

/// Prepares one contact, and returns the receptance and the push there. Appends its wall oscillators to `oscillators`.
fn site(
    body: &Body,
    touch: &Touch,
    mass: f64,
    config: &FractureConfig,
    oscillators: &mut Vec<(f64, f64)>,
) -> (Site, (Receptance, Push)) {
    let contact = &touch.contact;
    let mut site = Site {
        spring: Spring::at(&body.asset, contact, touch.curvature_radius),
        script: contact
            .is_script()
            .then(|| [f64::from(contact.impulse), f64::from(contact.duration)]),
        duration: contact::touch_duration(&body.asset, touch, DurationModel::Hertz),
        near: None,
        residual: Vec::new(),
        touch: touch.clone(),
    };
    let (felt, push) = Receptance::at(body, touch, config);
    if let Some(wall) = felt.wall
        && let Some(place) = place(body, touch, &wall)
    {
        let (bands, contact_radius) = wall.bands(&site, mass);
        site.near = Some(NearPlan {
            oscillators: add_waves(&felt, &bands, oscillators),
            place,
            across: push.across,
            shapes: Arc::new(NearShapes::new(&wall.material, &bands, place.reach)),
            wall,
            bands,
            contact_radius,
        });
    }
    site.residual = push.drive[felt.followed..].to_vec();
    (site, (felt, push))
}
