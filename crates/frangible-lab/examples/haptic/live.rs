//! Vibration that goes on from tick to tick, for a loop that feels, shows or sounds a body while it is touched.
//!
//! Theory: a tick is long against the periods of most modes (1 ms against 0.01 to 0.5 ms for a small plate), so no scheme
//! that samples them would do. Forces are taken as linear over a tick, from their last value to the next; then the state
//! (ω q, q̇, f, Δf) of a mode is a linear system with constant coefficients, and one matrix exponential steps it exactly, for
//! any tick and damping. A force that were held constant and jumped between ticks would make every stiff mode ring at twice its
//! deflection; under the ramp stiff modes follow the force, which is the quasi-static answer, and slow ones swing.
//!
//! Limits: the displacement is that of the modes there are; the dent under a contact is below what a hundred modes resolve. The
//! body's motion as a whole belongs to the rigid-body engine. Nothing breaks here: ask [`impact()`](frangible::impact()) or
//! [`rest()`](frangible::internals::rest()).

use frangible::glam::Vec3;
use frangible::internals::asset::each_row;
use frangible::internals::error::{finite, positive};
use frangible::internals::modal::Tick;
use frangible::{Body, InputError};

/// A place on a body's surface, with the mode shapes there. [`SurfacePlace::seek`] moves it without allocating.
#[derive(Clone, Debug)]
pub(crate) struct SurfacePlace {
    /// Position, m, body frame.
    pub(crate) position: Vec3,
    /// Unit normal of the surface there, outwards: smooth, but for sharp edges.
    pub(crate) normal: Vec3,
    /// Number of the surface triangle it lies on.
    pub(crate) triangle: u32,
    /// φ_i there of every mode, 1/√kg.
    shapes: Vec<Vec3>,
}

impl SurfacePlace {
    /// The point of the surface nearest to a point, m, body frame.
    ///
    /// # Errors
    /// A point that is not finite.
    pub(crate) fn nearest(body: &Body, point: Vec3) -> Result<Self, InputError> {
        let mut place = Self {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            triangle: 0,
            shapes: vec![Vec3::ZERO; body.asset().modes().count()],
        };
        place.seek(body, point)?;
        Ok(place)
    }

    /// Moves to the point of the surface of this body nearest to a point, m, body frame.
    ///
    /// # Errors
    /// A point that is not finite; the place stays where it was.
    pub(crate) fn seek(&mut self, body: &Body, point: Vec3) -> Result<(), InputError> {
        finite("a point to be touched", point)?;
        let asset = &**body.asset();
        let at = body.nearest_on_surface(point);
        let normals = &asset.surface().normals[at.triangle as usize];
        let mixed: Vec3 = normals.iter().zip(at.weights).map(|(n, w)| *n * w).sum();
        self.position = at.position;
        self.normal = mixed.normalize_or(normals[0]);
        self.triangle = at.triangle;
        self.shapes.clear();
        self.shapes.resize(asset.modes().count(), Vec3::ZERO);
        each_row(asset, &at, |node, weight| {
            asset.modes().add_shape(node, weight, &mut self.shapes);
        });
        Ok(())
    }
}

/// The vibration of a body under forces on its surface, stepped exactly from tick to tick.
#[derive(Clone, Debug)]
pub(crate) struct LiveModes {
    modes: Vec<LiveMode>,
}

/// A mode: its state, and its change over a tick.
#[derive(Clone, Copy, Debug)]
struct LiveMode {
    /// ω, rad/s.
    frequency: f64,
    /// Matrix that takes (ω q, q̇, force at the tick's beginning, increase of the force) to (ω q, q̇) after the tick.
    step: [[f64; 4]; 2],
    /// (ω q, q̇).
    state: [f64; 2],
    /// Modal force at the end of the last tick, N/√kg.
    force: f64,
    /// Modal force that is pushed with at the end of the next tick, N/√kg.
    next: f64,
}

impl LiveMode {
    /// A mode at rest: ω, rad/s; damping d, 1/s; tick, s.
    fn new(frequency: f64, damping: f64, tick: f64) -> Self {
        let Tick { own, held, ramp } = Tick::new(frequency, damping, tick);
        Self {
            frequency,
            step: [0, 1].map(|i| [own[i][0], own[i][1], held[i], ramp[i]]),
            state: [0.0; 2],
            force: 0.0,
            next: 0.0,
        }
    }

    fn advance(&mut self) {
        let next = std::mem::take(&mut self.next);
        let [x, v] = self.state;
        let inputs = [x, v, self.force, next - self.force];
        let row = |row: [f64; 4]| row.iter().zip(inputs).map(|(a, b)| a * b).sum();
        self.state = self.step.map(row);
        self.force = next;
    }
}

impl LiveModes {
    /// Modes at rest, for ticks of this length, s.
    ///
    /// # Errors
    /// A tick that is not above zero, or not finite.
    pub(crate) fn new(body: &Body, tick: f64) -> Result<Self, InputError> {
        positive("the length of a tick", tick, "s")?;
        let (basis, material) = (body.asset().modes(), body.asset().material());
        let modes = (0..basis.count()).map(|i| {
            let frequency = basis.eigenvalues[i].sqrt();
            LiveMode::new(frequency, basis.damping(i, material), tick)
        });
        Ok(Self {
            modes: modes.collect(),
        })
    }

    /// Pushes on a place with a force, N, at the end of the coming tick; pushes add up, and are forgotten after the tick.
    pub(crate) fn push(&mut self, place: &SurfacePlace, force: Vec3) {
        for (mode, shape) in self.modes.iter_mut().zip(&place.shapes) {
            mode.next += f64::from(shape.dot(force));
        }
    }

    /// Steps by a tick: each force goes in a straight line from its last value to the sum of the pushes since.
    pub(crate) fn step(&mut self) {
        self.modes.iter_mut().for_each(LiveMode::advance);
    }

    /// Displacement of a place by vibration, m, from its position of rest.
    pub(crate) fn displacement(&self, place: &SurfacePlace) -> Vec3 {
        let modes = self.modes.iter().zip(&place.shapes);
        modes
            .map(|(mode, shape)| *shape * (mode.state[0] / mode.frequency) as f32)
            .sum()
    }

    /// Velocity of a place, m/s.
    pub(crate) fn velocity(&self, place: &SurfacePlace) -> Vec3 {
        let modes = self.modes.iter().zip(&place.shapes);
        modes
            .map(|(mode, shape)| *shape * mode.state[1] as f32)
            .sum()
    }

    /// Displacement of a place, m, if the forces of the last tick went on for ever: the quasi-static part of [`LiveModes::displacement`].
    pub(crate) fn static_displacement(&self, place: &SurfacePlace) -> Vec3 {
        let modes = self.modes.iter().zip(&place.shapes);
        modes
            .map(|(mode, shape)| *shape * (mode.force / mode.frequency.powi(2)) as f32)
            .sum()
    }

    /// Kinetic and elastic energy of the vibration, J.
    #[cfg(test)]
    pub(crate) fn energy(&self) -> f64 {
        let energy = |m: &LiveMode| 0.5 * (m.state[0].powi(2) + m.state[1].powi(2));
        self.modes.iter().map(energy).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::LiveMode;

    /// Forces at the ends of ticks, N/√kg.
    const FORCES: [f64; 6] = [0.0, 3.0, -1.0, -1.0, 0.0, 2.0];

    /// q and q̇ under these forces, linear between ticks, by Runge and Kutta's fourth-order method.
    fn integrated(w: f64, d: f64, tick: f64) -> [f64; 2] {
        const STEPS: usize = 20_000;
        let (mut q, mut v) = (0.0, 0.0);
        let h = tick / STEPS as f64;
        for ends in FORCES.windows(2) {
            for k in 0..STEPS {
                let force = |t: f64| ends[0] + (ends[1] - ends[0]) * (k as f64 + t) / STEPS as f64;
                let rate = |q: f64, v: f64, t: f64| [v, force(t) - d * v - w * w * q];
                let a = rate(q, v, 0.0);
                let b = rate(q + 0.5 * h * a[0], v + 0.5 * h * a[1], 0.5);
                let c = rate(q + 0.5 * h * b[0], v + 0.5 * h * b[1], 0.5);
                let e = rate(q + h * c[0], v + h * c[1], 1.0);
                q += h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + e[0]);
                v += h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + e[1]);
            }
        }
        [q, v]
    }

    #[test]
    fn a_tick_is_exact_under_forces_that_grow_linearly() {
        let tick = 1e-3;
        // A swing of a seventh of a tick, one of six ticks; critically and far more than critically damped.
        for (w, d) in [(44e3, 12.0), (1e3, 300.0), (2e3, 4e3), (3e3, 2e4)] {
            let mut mode = LiveMode::new(w, d, tick);
            for force in &FORCES[1..] {
                mode.next = *force;
                mode.advance();
            }
            let [q, v] = integrated(w, d, tick);
            let largest = 3.0 / (w * w);
            assert!(
                (mode.state[0] / w - q).abs() < 1e-6 * largest,
                "w {w} d {d}"
            );
            assert!(
                (mode.state[1] - v).abs() < 1e-6 * largest * w,
                "w {w} d {d}"
            );
        }
    }

    #[test]
    fn a_stiff_mode_follows_a_slow_force() {
        // 20 periods in a tick, no damping to help: the swing about the quasi-static answer is of order 1/(ω tick).
        let (w, tick) = (std::f64::consts::TAU * 20e3, 1e-3);
        let mut mode = LiveMode::new(w, 0.0, tick);
        for k in 1..200 {
            mode.next = f64::from(k.min(100));
            mode.advance();
            let still = mode.force / (w * w);
            assert!((mode.state[0] / w - still).abs() < 2.0 / (w * tick) / (w * w));
        }
    }
}
