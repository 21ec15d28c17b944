//! What a blow is integrated with: how each contact pushes and feels the modes, the wall oscillators about it, what follows the
//! force, and how fine the steps are.

use glam::Vec3;

use super::Spring;
use super::bank::{Bank, padded};
use super::wall::{NearPlan, near};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{self, Contact, Load, Touch, hertz_at, modal_load};

/// Hertz' time over the longest substep. Measured: the energy error then is 3e-6 of what the striker loses (`frangible-lab verify`, case
/// `blow`), and falls with the square of the substep.
const SUBSTEPS_PER_HERTZ_TIME: f64 = 400.0;

/// Rounds over all contacts until the energy of approach is known.
const APPROACH_ROUNDS: usize = 2000;

/// A contact, made ready.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) touch: Touch,
    pub(super) spring: Spring,
    /// A script's impulse, N·s, and duration, s, instead of a striker.
    pub(super) script: Option<[f64; 2]>,
    /// Hertz' time, s.
    pub(super) hertz_time: f64,
    pub(super) near: Option<NearPlan>,
    /// φ · (n + f) of every mode that follows the force, 1/√kg; zero for those that the near field serves.
    pub(super) residual: Vec<f64>,
}

/// Everything that a blow is integrated with.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) sites: Vec<Site>,
    /// Modes that are followed.
    pub(super) modes: usize,
    /// ω and d of the modes and, after them, of all wall oscillators.
    pub(super) oscillators: Vec<(f64, f64)>,
    /// 1/ω of the modes, s.
    pub(super) periods: Vec<f64>,
    /// How hard each contact pushes each oscillator, 1/√kg.
    pub(super) drive: Vec<Vec<f64>>,
    /// How each contact feels each oscillator's ω q, s/√kg.
    pub(super) gap: Vec<Vec<f64>>,
    /// B of the rigid bodies, 1/kg: row-major.
    pub(super) inverse_mass: Vec<f64>,
    /// c of what follows the force, m/N: row-major.
    pub(super) compliance: Vec<f64>,
    /// Step at which stresses are looked at, s.
    pub(super) time_step: f64,
    /// Steps after the blow are longer by this factor.
    pub(super) coarser: f64,
    /// Substeps in each.
    pub(super) substeps: usize,
    /// The oscillators through a substep.
    pub(super) fine: Bank,
    /// The oscillators through a time step.
    pub(super) step: Bank,
    /// The oscillators through a time step after the blow.
    pub(super) coarse: Bank,
}

impl Plan {
    /// None where nothing pushes. `longest`: a substep is no longer than this, s.
    pub(super) fn new(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
        longest: Option<f64>,
    ) -> Option<Self> {
        let pushing = |c: &&Contact| c.is_script() || c.approach_speed > 0.0;
        let asset = &*body.asset;
        let modes = asset.modes.followed();
        let mut load = modal_load(body, contacts.iter().filter(pushing));
        if load.touches.is_empty() {
            return None;
        }
        let inverse_mass = inverse_masses(body, &load);
        load.modal_impulse = stopping(body, &load, &inverse_mass);
        let count = load.touches.len();
        let mut sites: Vec<Site> = Vec::with_capacity(count);
        let mut shapes: Vec<[Vec<f64>; 2]> = Vec::with_capacity(count);
        let mut oscillators: Vec<(f64, f64)> = (0..modes)
            .map(|i| {
                let damping = asset.modes.damping(i, &asset.material);
                (asset.modes.eigenvalues[i].sqrt(), damping)
            })
            .collect();
        for (k, touch) in load.touches.iter().enumerate() {
            let mass = 1.0 / inverse_mass[k * count + k];
            let (site, shape) = site(body, touch, mass, config, &mut oscillators);
            sites.push(site);
            shapes.push(shape);
        }
        let hertz_time = sites
            .iter()
            .map(|s| s.script.map_or(s.hertz_time, |[_, duration]| duration))
            .fold(f64::INFINITY, f64::min);
        let pulse = contact::pulse(asset, &load, hertz_time, config);
        let time_step = pulse.time_step;
        let longest = longest.unwrap_or(hertz_time / SUBSTEPS_PER_HERTZ_TIME);
        let substeps = (time_step / longest).ceil() as usize;
        let mut plan = Self {
            modes,
            inverse_mass,
            compliance: Vec::new(),
            time_step,
            substeps: substeps.max(1),
            fine: Bank::default(),
            step: Bank::default(),
            coarse: Bank::default(),
            coarser: (pulse.longest_step / time_step).max(1.0),
            drive: Vec::new(),
            gap: Vec::new(),
            periods: oscillators[..modes].iter().map(|(w, _)| 1.0 / w).collect(),
            oscillators,
            sites,
        };
        plan.couple(body, shapes);
        plan.fine = Bank::new(&plan.oscillators, time_step / plan.substeps as f64);
        plan.step = Bank::new(&plan.oscillators, time_step);
        plan.coarse = Bank::new(&plan.oscillators, plan.coarser * time_step);
        Some(plan)
    }

    /// The most energy that the contacts can take from the motion of approach, J: the largest `v · J − ½ Jᵀ B J` of impulses J ≥ 0.
    ///
    /// All that the springs and the vibration hold at any time is of this kind, for the impulses so far.
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

    /// How contacts push and feel all oscillators, and each other through what follows the force.
    fn couple(&mut self, body: &Body, shapes: Vec<[Vec<f64>; 2]>) {
        let asset = &*body.asset;
        let count = self.sites.len();
        let width = padded(self.oscillators.len());
        let mut felt = Vec::with_capacity(count);
        for (site, [drive, gap]) in self.sites.iter_mut().zip(shapes) {
            let (mut pushes, mut feels) = (vec![0.0; width], vec![0.0; width]);
            for i in 0..self.modes {
                pushes[i] = drive[i];
                feels[i] = gap[i] / self.oscillators[i].0;
            }
            if let Some(near) = &site.near {
                let normal = f64::from(site.touch.contact.normal.dot(near.place.inwards));
                for (i, band) in near.oscillators.clone().zip(&near.bands.oscillators) {
                    let xi = band.give.sqrt();
                    pushes[i] = xi * near.across;
                    feels[i] = xi * normal / self.oscillators[i].0;
                }
            }
            site.residual = drive[self.modes..].to_vec();
            felt.push(gap[self.modes..].to_vec());
            self.drive.push(pushes);
            self.gap.push(feels);
        }
        self.compliance = vec![0.0; count * count];
        let eigenvalues = &asset.modes.eigenvalues[self.modes..];
        for k in 0..count {
            for (l, site) in self.sites.iter().enumerate() {
                let terms = felt[k].iter().zip(&site.residual).zip(eigenvalues);
                self.compliance[k * count + l] = terms.map(|((a, b), lambda)| a * b / lambda).sum();
            }
            if let Some(near) = &self.sites[k].near {
                let normal = f64::from(self.sites[k].touch.contact.normal.dot(near.place.inwards));
                self.compliance[k * count + k] += normal * near.across * near.bands.compliance();
            }
        }
    }
}

/// B: what a unit impulse at contact l changes the approach at contact k by, 1/kg.
fn inverse_masses(body: &Body, load: &Load) -> Vec<f64> {
    let asset = &*body.asset;
    let count = load.touches.len();
    let mut matrix = vec![0.0; count * count];
    for (k, a) in load.touches.iter().enumerate() {
        for (l, b) in load.touches.iter().enumerate() {
            if !asset.is_supported() {
                let place = |t: &Touch| (t.contact.point.as_dvec3(), t.contact.normal.as_dvec3());
                matrix[k * count + l] = asset.mass.inverse_mass_between(place(a), place(b));
            }
            if k != l {
                let (a, b) = (&a.contact.striker, &b.contact.striker);
                matrix[k * count + l] += a.inverse_mass_between(b);
            }
        }
        let own = &mut matrix[k * count + k];
        *own += f64::from(a.contact.striker.inverse_effective_mass);
        // Neither gives way when a held body is hit by an immovable one; the body's own mass stands in.
        if *own <= 0.0 {
            *own = 1.0 / asset.mass.mass;
        }
    }
    matrix
}

/// Modal impulses of what stops each striker, and of scripts: which modes matter, and so the time step, must not hang on what an engine
/// says of an impulse that is an outcome here.
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

/// One contact, and its push on and feeling of every mode that there is.
fn site(
    body: &Body,
    touch: &Touch,
    mass: f64,
    config: &FractureConfig,
    oscillators: &mut Vec<(f64, f64)>,
) -> (Site, [Vec<f64>; 2]) {
    let asset = &*body.asset;
    let contact = &touch.contact;
    let spring = Spring::at(asset, contact, touch.curvature_radius);
    let hertz_time = hertz_at(
        asset,
        contact,
        touch.curvature_radius,
        touch.inverse_effective_mass,
    );
    let script = contact
        .is_script()
        .then(|| [f64::from(contact.impulse), f64::from(contact.duration)]);
    let mut site = Site {
        spring,
        script,
        hertz_time,
        near: None,
        residual: Vec::new(),
        touch: touch.clone(),
    };
    let direction = contact.direction();
    let mut drive = touch.project(body, direction);
    let mut gap = touch.modal_shape.clone();
    let followed = asset.modes.followed();
    if let Some(theory) = config.near_field
        && let Some((near, first)) = near(body, &site, mass, direction, theory)
    {
        let served = first;
        // Across the wall the near field goes on where the modes end; along it they serve.
        let inwards = near.place.inwards;
        let along = |v: Vec3| v - v.dot(inwards) * inwards;
        let (drive_along, gap_along) = (
            touch.project(body, along(direction)),
            touch.project(body, along(contact.normal)),
        );
        drive[served..].copy_from_slice(&drive_along[served..]);
        gap[served..].copy_from_slice(&gap_along[served..]);
        let first = oscillators.len();
        for band in &near.bands.oscillators {
            let material = &asset.material;
            let damping = material.stiffness_damping * band.eigenvalue + material.mass_damping;
            oscillators.push((band.eigenvalue.sqrt(), damping));
        }
        site.near = Some(NearPlan {
            oscillators: first..oscillators.len(),
            ..near
        });
    }
    if !config.residual {
        drive[followed..].fill(0.0);
        gap[followed..].fill(0.0);
    }
    (site, [drive, gap])
}
