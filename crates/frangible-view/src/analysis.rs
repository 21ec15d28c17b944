//! Analysis of a contact: its motion over time, its stresses, and its cracks one by one.

use std::f64::consts::PI;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::mesh::TetMesh;
use frangible::internals::modal::Motion;
use frangible::internals::outcome::ContactReport;
use frangible::internals::stress::Symmetric3;
use frangible::internals::{CrackTrace, ElementTrace, ShownStress, impact_traced};
use frangible::{Asset, Body, Contact, FractureConfig, InputError};

use crate::blow::Blow;
use crate::numbers::{Course, Series};

/// Modes that are plotted: those that strain the body most.
const PLOTTED_MODES: usize = 6;

/// A crack.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CrackShape {
    /// The triangles of its surface, m, body frame, each with the time when the crack came there, s after the contact began.
    pub triangles: Vec<([Vec3; 3], f64)>,
    /// The middle of the tetrahedron where it started, m, body frame.
    pub start: Vec3,
    /// Time at which it started, s after the contact began.
    pub time: f64,
    /// Tetrahedra it went through.
    pub tetrahedra: usize,
}

/// Course of a contact, moment by moment.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The body that was hit.
    pub asset: Arc<Asset>,
    /// Its numbers over time.
    pub course: Arc<Course>,
    /// Cracks in the order in which they started.
    pub cracks: Vec<CrackShape>,
    /// Tetrahedra that they went through, in the order of time.
    pub cut: Vec<ElementTrace>,
    /// Middles of the weak tetrahedra, m, body frame.
    pub weak_points: Vec<Vec3>,
    /// Length of the contact, s.
    pub contact: f64,
    motion: Motion,
    time_step: f64,
    body: Body,
    config: FractureConfig,
    pressed: Vec<u32>,
}

impl Analysis {
    /// Analyses a blow: about as much work as the blow itself.
    ///
    /// # Errors
    /// Contacts that the fracture model refuses.
    pub fn of(blow: &Blow) -> Result<Self, InputError> {
        Self::of_contacts(&blow.body, &blow.contacts, &blow.config)
    }

    fn of_contacts(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Result<Self, InputError> {
        let asset = Arc::clone(body.asset());
        let (outcome, trace) = impact_traced(body, contacts, config)?;
        let known = |element: &&ElementTrace| element.time.is_finite();
        let cut = trace.cracks.iter().flatten().filter(known);
        let mut cut: Vec<ElementTrace> = cut.copied().collect();
        cut.sort_by(|a, b| a.time.total_cmp(&b.time));
        let report = outcome.report();
        let mut analysis = Self {
            course: Arc::default(),
            cracks: cracks(asset.fracture(), &trace),
            cut,
            weak_points: middles(asset.fracture(), body.weak_tets()),
            contact: report.contact_duration,
            motion: trace.motion,
            time_step: report.time_step,
            body: body.clone(),
            config: config.clone(),
            pressed: trace.pressed,
            asset,
        };
        let impulse = contacts.iter().map(|contact| contact.impulse).sum();
        analysis.course = Arc::new(analysis.over_time(impulse, &report.contacts));
        Ok(analysis)
    }

    /// The numbers over time of contacts that were integrated, or of a half-sine of this impulse, N·s; without a motion there are none.
    fn over_time(&self, impulse: f32, contacts: &[ContactReport]) -> Course {
        let basis = self.asset.modes();
        let damping = |mode| basis.damping(mode, self.asset.material());
        let modes = 0..basis.count();
        let cracking = self.cracking();
        let end = self.motion.begin(self.motion.steps(), self.time_step);
        let rest = Course {
            strength: self.body.weakest(),
            cracks: self.cracks.len(),
            duration: cracking[1].max(end),
            cracking,
            swings: modes.map(|i| [basis.frequency(i), damping(i)]).collect(),
            ..Course::default()
        };
        if self.motion.steps() == 0 {
            return rest;
        }
        let tension = self.tensions();
        Course {
            force: if contacts.is_empty() {
                half_sine(0.5 * PI * f64::from(impulse) / self.contact, self.contact)
            } else {
                force(contacts, self.time_step)
            },
            modes: self.plotted_modes(),
            peak_tension: tension.points.iter().map(|p| p[1]).fold(0.0, f64::max),
            tension,
            ..rest
        }
    }

    /// Times at which the first crack started and the last one grew, s after the contact began; zeros without one.
    fn cracking(&self) -> [f64; 2] {
        [self.cut.first(), self.cut.last()].map(|cut| cut.map_or(0.0, |cut| cut.time))
    }

    /// Amplitudes of all modes at this share of the motion's time, m·√kg; all at rest without a motion.
    #[must_use]
    pub fn amplitudes(&self, share: f64) -> &[f32] {
        self.step(share).map_or(&[], |step| self.motion.at(step))
    }

    /// The share of the motion's time at which the tension is largest.
    #[must_use]
    pub fn worst_moment(&self) -> f64 {
        let points = &self.course.tension.points;
        let worst = points.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        worst.map_or(0.0, |point| {
            point[0] / self.course.duration.max(f64::MIN_POSITIVE)
        })
    }

    fn plotted_modes(&self) -> Vec<Series> {
        let motion = &self.motion;
        let basis = self.asset.modes();
        let stress = |step: usize, mode: usize| motion.at(step)[mode] * basis.peak_stress[mode];
        let peak = |mode: usize| {
            let steps = 0..motion.steps();
            steps.map(|k| stress(k, mode).abs()).fold(0.0, f32::max)
        };
        let mut order: Vec<(f32, usize)> = (0..motion.modes).map(|i| (peak(i), i)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        order.truncate(PLOTTED_MODES);
        let every = motion.steps().div_ceil(400).max(1);
        let series = order.into_iter().map(|(_, mode)| Series {
            name: format!("{}: {:.0} Hz", mode + 1, basis.frequency(mode)),
            points: (0..motion.steps())
                .step_by(every)
                .map(|k| [self.end_of(k), f64::from(stress(k, mode))])
                .collect(),
        });
        series.collect()
    }

    /// Largest tension anywhere in the body, Pa.
    fn tensions(&self) -> Series {
        let largest = self.stress().largest_tensions();
        let mut points = vec![[0.0, 0.0]];
        let times = (0..).map(|k| self.end_of(k));
        points.extend(
            times
                .zip(largest.into_iter().map(f64::from))
                .map(<[f64; 2]>::from),
        );
        Series {
            name: "largest tension".into(),
            points,
        }
    }

    fn stress(&self) -> ShownStress<'_> {
        ShownStress::new(&self.body, &self.config, &self.pressed, &self.motion)
    }

    /// Stress on triangles of the outer surface at this share of the motion's time, Pa, as cracks feel it; empty without a motion.
    #[must_use]
    pub fn surface_stress(&self, share: f64) -> Vec<(u32, Symmetric3)> {
        self.step(share)
            .map_or_else(Vec::new, |step| self.stress().on_surface(step))
    }

    /// The time step at this share of the motion's time; none without a motion.
    fn step(&self, share: f64) -> Option<usize> {
        self.motion.step_at(self.course.time(share), self.time_step)
    }

    /// Time at which a time step ends, s.
    fn end_of(&self, step: usize) -> f64 {
        self.motion.begin(step + 1, self.time_step)
    }
}

/// The force of all contacts of a blow that was integrated, N, over time steps of this length, s.
fn force(contacts: &[ContactReport], time_step: f64) -> Series {
    let steps = contacts.iter().map(|c| c.force.len()).max().unwrap_or(0);
    let all = |k: usize| -> f32 { contacts.iter().filter_map(|c| c.force.get(k)).sum() };
    let points = (0..steps).map(|k| [time_step * (k + 1) as f64, f64::from(all(k))]);
    Series {
        name: "force".into(),
        points: std::iter::once([0.0, 0.0]).chain(points).collect(),
    }
}

/// `a sin(π t / t_d)` of this peak, N, and duration, s.
fn half_sine(peak: f64, duration: f64) -> Series {
    const SAMPLES: u32 = 48;
    let point = |i: u32| {
        let share = f64::from(i) / f64::from(SAMPLES);
        [share * duration, peak * (PI * share).sin()]
    };
    Series {
        name: "force".into(),
        points: (0..=SAMPLES).map(point).collect(),
    }
}

fn middles(mesh: &TetMesh, tets: &[u32]) -> Vec<Vec3> {
    tets.iter().map(|&e| mesh.centroid(e as usize)).collect()
}

fn cracks(mesh: &TetMesh, trace: &CrackTrace) -> Vec<CrackShape> {
    let mut cracks: Vec<CrackShape> = Vec::new();
    for elements in &trace.cracks {
        let Some(first) = elements.first() else {
            continue;
        };
        let mut crack = CrackShape {
            start: mesh.centroid(first.tet as usize),
            time: first.time,
            tetrahedra: elements.len(),
            ..CrackShape::default()
        };
        for element in elements {
            let nodes = mesh.tets[element.tet as usize];
            let corners = nodes.map(|node| mesh.positions[node as usize]);
            let mut triangles = Vec::new();
            cut(corners, element.values, &mut triangles);
            let timed = triangles.into_iter().map(|t| (t, element.time));
            crack.triangles.extend(timed);
        }
        cracks.push(crack);
    }
    cracks.sort_by(|a, b| a.time.total_cmp(&b.time));
    cracks
}

/// The part of s = 0 within a tetrahedron, one or two triangles; zero counts as positive.
fn cut(corners: [Vec3; 4], values: [f32; 4], triangles: &mut Vec<[Vec3; 3]>) {
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for (corner, value) in corners.into_iter().zip(values) {
        match value >= 0.0 {
            true => above.push((corner, value)),
            false => below.push((corner, value)),
        }
    }
    let between = |a: (Vec3, f32), b: (Vec3, f32)| a.0.lerp(b.0, a.1 / (a.1 - b.1));
    match (&above[..], &below[..]) {
        ([one], [a, b, c]) | ([a, b, c], [one]) => {
            triangles.push([between(*one, *a), between(*one, *b), between(*one, *c)]);
        }
        ([a, b], [c, d]) => {
            let square = [
                between(*a, *c),
                between(*a, *d),
                between(*b, *d),
                between(*b, *c),
            ];
            triangles.push([square[0], square[1], square[2]]);
            triangles.push([square[0], square[2], square[3]]);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_through_a_tetrahedron_has_the_area_it_must() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let area = |level: f32| {
            let mut triangles = Vec::new();
            cut(corners, corners.map(|p| p.z - level), &mut triangles);
            triangles
                .iter()
                .map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length())
                .sum::<f32>()
        };
        // A cut parallel to a face has the face's area times the square of the remaining height.
        for level in [0.25, 0.5, 0.9] {
            let expected = 0.5 * (1.0 - level) * (1.0 - level);
            assert!((area(level) - expected).abs() < 1e-6);
        }
        assert_eq!(area(2.0), 0.0);
        let mut square = Vec::new();
        cut(corners, corners.map(|p| p.x + p.y - 0.5), &mut square);
        assert_eq!(square.len(), 2);
    }

    #[test]
    fn the_pulse_carries_its_impulse() {
        let (impulse, duration) = (0.3, 2e-4);
        let series = half_sine(impulse * PI / (2.0 * duration), duration);
        let sum: f64 = series
            .points
            .windows(2)
            .map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][1] + w[1][1]))
            .sum();
        assert!((sum / impulse - 1.0).abs() < 1e-3, "{sum}");
    }
}
