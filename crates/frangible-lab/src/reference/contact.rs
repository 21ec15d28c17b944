//! Contact duration, time step, force `[G12 §4.1-4.3]`.

use std::f64::consts::{PI, TAU};

use frangible::Contact;
use frangible::glam::DVec3;

use crate::reference::body::Solid;
use crate::reference::modes::forced;
use crate::reference::options::{Duration, Options, TimeStep};

/// Hertz' constant of Eq. 1.
const C: f64 = 2.868;

/// Largest amplitude of a mode under a half-sine of unit impulse and amplitude `a`, 1/s: an impulse's, or 1.77 times the
/// static one, whichever is less.
fn excitation(modal_impulse: f64, lambda: f64, a: f64) -> f64 {
    modal_impulse.abs() * (1.0 / lambda.sqrt()).min(1.77 * a / lambda)
}

/// The duration that brings in no more energy than `brought`, J, and how near another was.
fn admissible(solid: &Solid, modal_impulse: &[f64], mut duration: f64, brought: f64) -> (f64, f64) {
    let mut margin = 1.0_f64;
    for _ in 0..200 {
        let u = PI / duration;
        let mut peak = 0.0_f64;
        for instant in 1..=40 {
            let t = duration * f64::from(instant) / 40.0;
            let mut energy = 0.0;
            for (i, &lambda) in solid.asset.modes().eigenvalues.iter().enumerate() {
                let (q, v) = forced(lambda, damping(solid, i), u, t);
                let force = modal_impulse[i] * u / 2.0;
                energy += 0.5 * (v * v + lambda * q * q) * force * force;
            }
            peak = peak.max(energy);
        }
        margin = margin.min((peak / brought - 1.0).abs());
        if peak <= brought {
            break;
        }
        duration *= 1.05;
    }
    (duration, margin)
}

/// A contact and its coupling to the modes.
struct Touch {
    /// Number of the surface triangle.
    triangle: u32,
    speed: f64,
    /// ξ_i = φ_i(b) · n, 1/√kg.
    xi: Vec<f64>,
    /// Radius of curvature of the body there, m.
    radius: f64,
    /// Eq. 1 for the two bodies, s.
    hertz: f64,
    rigid_striker: bool,
    /// Kinetic energy of the approach that it takes up, J.
    energy: f64,
}

/// The force of an impact over time.
pub(crate) struct Force {
    /// Σ_k φ_k ξ_{i,k} of every mode, N·s/√kg.
    pub(crate) modal_impulse: Vec<f64>,
    /// t_d, s.
    pub(crate) duration: f64,
    /// Δt, s.
    pub(crate) time_step: f64,
    /// Surface triangles that the contacts touch.
    pub(crate) pressed: Vec<u32>,
    /// Steps until the contact's end.
    pub(crate) contact_steps: usize,
    /// Steps in all.
    pub(crate) steps: usize,
    /// Relative change that would alter the number of steps.
    pub(crate) margin: f64,
}

impl Force {
    /// u = π / t_d, rad/s.
    pub(crate) fn frequency(&self) -> f64 {
        PI / self.duration
    }

    /// a of a unit impulse, 1/s `[G12 Eq. 5]`.
    pub(crate) fn amplitude(&self) -> f64 {
        let u = self.frequency();
        u / (1.0 - (u * self.duration).cos())
    }

    /// `None` when no contact has an impulse.
    pub(crate) fn new(solid: &Solid, contacts: &[Contact], options: &Options) -> Option<Self> {
        let mut modal_impulse = vec![0.0; solid.asset.modes().count()];
        let mut touches = Vec::new();
        for contact in contacts.iter().filter(|c| c.impulse > 0.0) {
            let touch = touch(solid, contact);
            for (sum, xi) in modal_impulse.iter_mut().zip(&touch.xi) {
                *sum += f64::from(contact.impulse) * xi;
            }
            touches.push(touch);
        }
        // "if the body is colliding at several locations at the same time, we choose the contact that has the
        // smallest duration" [G12 §4.1].
        let mut duration = f64::INFINITY;
        for touch in &touches {
            duration = duration.min(contact_duration(solid, touch, options.duration));
        }
        if touches.is_empty() {
            return None;
        }
        let mut margin = 1.0;
        if options.admissible {
            let brought = touches.iter().map(|t| t.energy).sum();
            (duration, margin) = admissible(solid, &modal_impulse, duration, brought);
        }
        let (time_step, contact_steps, other) =
            time_step(solid, &modal_impulse, duration, options.time_step);
        let mut force = Self {
            modal_impulse,
            duration,
            pressed: touches.iter().map(|t| t.triangle).collect(),
            time_step,
            contact_steps,
            steps: contact_steps,
            margin: other.min(margin),
        };
        if options.after_contact {
            force.go_on(solid);
        }
        Some(force)
    }

    /// Steps for 1.5 periods of the lowest significantly excited mode.
    fn go_on(&mut self, solid: &Solid) {
        let a = self.frequency() / 2.0;
        let mut amplitudes = Vec::new();
        for (i, &lambda) in solid.asset.modes().eigenvalues.iter().enumerate() {
            amplitudes.push(excitation(self.modal_impulse[i], lambda, a));
        }
        let largest = amplitudes.iter().copied().fold(0.0, f64::max);
        let mut low = 0;
        for (i, amplitude) in amplitudes.iter().enumerate() {
            self.margin = self.margin.min((amplitude / (0.05 * largest) - 1.0).abs());
            if *amplitude >= 0.05 * largest {
                low = i;
                break;
            }
        }
        let end = 1.5 * TAU / solid.asset.modes().eigenvalues[low].sqrt();
        if end > self.duration {
            let wanted = end / self.time_step;
            self.margin = self.margin.min((wanted - wanted.round()).abs() / wanted);
            self.steps = self.contact_steps.max(wanted.ceil() as usize).min(20_000);
        }
    }
}

fn touch(solid: &Solid, contact: &Contact) -> Touch {
    let asset = solid.asset;
    let p = contact.point.as_dvec3();
    let n = contact.normal.as_dvec3().normalize();
    let mut best = (f64::INFINITY, 0, [0.0; 3], p);
    for (t, triangle) in asset.surface().triangles.iter().enumerate() {
        let x = triangle.map(|v| solid.nodes[v as usize]);
        let l = closest(x, p);
        let q = x[0] * l[0] + x[1] * l[1] + x[2] * l[2];
        if q.distance(p) < best.0 {
            best = (q.distance(p), t, l, q);
        }
    }
    let (_, t, l, b) = best;
    let striker = &contact.striker;
    let speed = f64::from(contact.approach_speed).max(1e-3);
    let radius = f64::from(asset.surface().curvature_radius[t]);
    let ball = (0.75 * asset.mass().volume / PI).cbrt();

    // Eq. 1 for the two bodies: 1/m = nᵀ K n of both, 1/E of both, 1/r of both.
    let mut give = f64::from(striker.inverse_effective_mass);
    if asset.supported().is_empty() {
        let arm = (b - asset.mass().centre).cross(n);
        give += 1.0 / asset.mass().mass + arm.dot(asset.mass().inertia.inverse() * arm);
    }
    let mass = if give > 0.0 {
        1.0 / give
    } else {
        asset.mass().mass
    };
    let nu = solid.material.poisson_ratio;
    let own = solid.material.youngs_modulus / (1.0 - nu * nu);
    let modulus = 1.0 / (1.0 / own + 1.0 / f64::from(striker.contact_modulus));
    let bend = 1.0 / radius.max(3e-3) + 1.0 / f64::from(striker.curvature_radius).max(1e-4);
    let r = (1.0 / bend).min(ball);
    let hertz = C * (mass * mass / (modulus * modulus * r) / speed).powf(0.2); // [G12 Eq. 1]
    Touch {
        triangle: t as u32,
        speed,
        xi: solid.modal_shape(asset.surface().triangles[t], l, n),
        radius: radius.clamp(3e-3, ball),
        hertz,
        rigid_striker: striker.contact_modulus.is_infinite(),
        energy: 0.5 * f64::from(contact.impulse) * f64::from(contact.approach_speed)
            / (1.0 + f64::from(striker.restitution)),
    }
}

/// `[G12 Eq. 2]`.
fn contact_duration(solid: &Solid, touch: &Touch, model: Duration) -> f64 {
    // "we select the most excited mode among those that are not critically damped": the one of the largest
    // displacement |ξ|/√λ, with a damping ratio below 0.9.
    let modes = solid.asset.modes();
    let mut max = None;
    let mut largest = -1.0;
    for (i, &lambda) in modes.eigenvalues.iter().enumerate() {
        let displacement = touch.xi[i].abs() / lambda.sqrt();
        if damping(solid, i) < 1.8 * lambda.sqrt() && displacement > largest {
            largest = displacement;
            max = Some(i);
        }
    }
    let Some(max) = max else { return touch.hertz };
    let lambda = modes.eigenvalues[max];
    match model {
        Duration::Hertz => touch.hertz,
        Duration::ModalHertz => {
            let own = C * (touch.radius / (lambda * lambda) / touch.speed).powf(0.2);
            // "we compute contact duration estimation for each of the bodies involved in the contact, and retain
            // the largest duration".
            if touch.rigid_striker {
                own
            } else {
                own.max(touch.hertz)
            }
        }
        Duration::AsPrinted { c } => {
            let period = TAU / natural_frequency(solid, max);
            c * (period * period / touch.speed).powf(0.2)
        }
    }
}

/// d_i = α λ_i + β, 1/s.
pub(crate) fn damping(solid: &Solid, i: usize) -> f64 {
    solid.material.stiffness_damping * solid.asset.modes().eigenvalues[i]
        + solid.material.mass_damping
}

/// Im ω_i, rad/s; 0 of a mode that does not swing.
fn natural_frequency(solid: &Solid, i: usize) -> f64 {
    let d = damping(solid, i);
    (solid.asset.modes().eigenvalues[i] - 0.25 * d * d)
        .max(0.0)
        .sqrt()
}

/// Δt, the number of steps, and how near that number was to another `[G12 Eq. 3]`.
fn time_step(
    solid: &Solid,
    modal_impulse: &[f64],
    duration: f64,
    model: TimeStep,
) -> (f64, usize, f64) {
    let per_step = match model {
        TimeStep::AsPrinted => 4.0 * PI,
        TimeStep::Nyquist => PI,
        TimeStep::Sampled { per_period } => {
            return sampled(solid, modal_impulse, duration, per_period);
        }
    };
    // "the highest frequency of the noncritically damped mode among the modes that have been excited".
    let largest = modal_impulse.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut high = 0.0_f64;
    for (i, impulse) in modal_impulse.iter().enumerate() {
        if impulse.abs() > 1e-6 * largest {
            high = high.max(natural_frequency(solid, i));
        }
    }
    let time_step = per_step / high;
    // Algorithm 1, line 7: for t < t_d, t ← t + Δt.
    let steps = (duration / time_step).ceil();
    (time_step, steps as usize, 0.0)
}

fn sampled(
    solid: &Solid,
    modal_impulse: &[f64],
    duration: f64,
    per_period: f64,
) -> (f64, usize, f64) {
    let modes = solid.asset.modes();
    let a = PI / duration / 2.0;
    let u = PI / duration;
    let mut total = 0.0;
    let mut swings = Vec::new();
    let mut margin = 1.0_f64;
    for (i, &lambda) in modes.eigenvalues.iter().enumerate() {
        let q = excitation(modal_impulse[i], lambda, a);
        total += q * f64::from(modes.peak_stress[i]);
        // Motion of the mode beside its answer to a slow force; a and u are those of a unit impulse: 2 a = u.
        let mut beside = q;
        margin = margin.min((lambda / (2.0 * u * u) - 1.0).abs());
        if lambda > 2.0 * u * u {
            let response = modal_impulse[i].abs() * a / (lambda - u * u);
            beside = beside.min(2.0 * response * u / lambda.sqrt());
        }
        swings.push(beside * f64::from(modes.peak_stress[i]));
    }
    let (mut above, mut high) = (0.0, 0);
    for i in (0..swings.len()).rev() {
        above += swings[i];
        margin = margin.min((above / (0.02 * total) - 1.0).abs());
        if above > 0.02 * total {
            high = i;
            break;
        }
    }
    let wanted = duration * per_period * modes.eigenvalues[high].sqrt() / TAU;
    if wanted > 16.0 {
        margin = margin.min((wanted - wanted.round()).abs() / wanted);
    }
    let steps = wanted.ceil().max(16.0);
    (duration / steps, steps as usize, margin)
}

/// Weights of the point of a triangle closest to `p`: its foot if that lies inside, else the closest of the edges.
fn closest(x: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let normal = (x[1] - x[0]).cross(x[2] - x[0]);
    let area = normal.length_squared();
    let mut l = [0.0; 3];
    for k in 0..3 {
        let (a, b) = (x[(k + 1) % 3], x[(k + 2) % 3]);
        l[k] = (b - a).cross(p - a).dot(normal) / area;
    }
    if l.iter().all(|&w| w >= 0.0) {
        return l;
    }
    let mut best = f64::INFINITY;
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let edge = x[j] - x[i];
        let s = ((p - x[i]).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
        let distance = p.distance(x[i] + edge * s);
        if distance < best {
            best = distance;
            l = [0.0; 3];
            l[i] = 1.0 - s;
            l[j] = s;
        }
    }
    l
}
