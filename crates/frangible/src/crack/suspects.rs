//! Weak points that may crack, or raise the peak, at the steps of a batch: all steps of a point at once, so that the
//! arithmetic runs over the steps side by side. What cracks do in the meantime only takes suspects away: release
//! waves never raise the largest tension (λ_max(Q σ Q) ≤ max(λ_max(σ), 0), `stress/shadow.rs`).

use super::field::StressField;
use super::initiation::Peak;
use super::system::CrackSystem;
use super::weak_stress::{Rest, WeakStress};
use crate::body::Body;
use crate::stress::{BATCH, ClusterRows, Frame, Lanes, Steps, StressLanes, Wide, limit};

/// A weak point whose stress may pass its strength, or the peak so far, at a step of a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suspect {
    /// Its place among the body's weak points, in the order of the clusters.
    pub(crate) place: u32,
    pub(crate) tet: u32,
    /// Stress and strain energy at the steps of the batch.
    pub(crate) state: StressLanes,
    /// Upper bounds of the largest principal tension, Pa.
    pub(crate) bounds: Lanes,
}

/// Suspects of the steps of a batch of one motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Suspects {
    points: Vec<Suspect>,
    of_step: [Vec<u32>; BATCH],
    stress: WeakStress,
    /// Largest bound of the points that were passed over, Pa, and as the weakest point would feel it.
    pub(crate) passed_over: [f32; 2],
}

impl Suspects {
    /// Looks at the points of the clusters that survive at any step of the field's batch, but for those that are over by `now`, s, when the
    /// batch begins. `survivors`: places of the clusters in the body's list, bit k set where step k needs a look.
    pub(crate) fn find(
        &mut self,
        body: &Body,
        field: &mut StressField,
        survivors: impl Iterator<Item = (u32, Steps)>,
        system: &CrackSystem,
        now: f64,
        peak: Peak,
    ) {
        self.points.clear();
        self.of_step.iter_mut().for_each(Vec::clear);
        look(Look {
            suspects: self,
            body,
            field,
            survivors,
            system,
            now,
            peak,
        });
    }

    /// Tension at a point up to which neither a crack starts there nor the peak is passed, Pa.
    #[inline(always)]
    fn limit(body: &Body, tet: u32, peak: Peak) -> f32 {
        let strength = body.resistance.strength(tet);
        let felt = body.resistance.at_strength(peak.as_weakest, strength);
        strength.min(peak.tension).min(felt)
    }

    /// Steps, of those to look at, at which the stress at a point may pass its strength, or the peak.
    #[inline(always)]
    fn passing(body: &Body, tet: u32, bounds: &Lanes, steps: Steps, peak: Peak) -> Steps {
        let limit = Self::limit(body, tet, peak);
        let mut passing = 0;
        for (k, &bound) in bounds.iter().enumerate() {
            passing |= Steps::from(bound > limit) << k;
        }
        passing & steps
    }

    #[inline(always)]
    fn note(&mut self, suspect: Suspect, mut passing: Steps) {
        let number = self.points.len() as u32;
        self.points.push(suspect);
        while passing != 0 {
            self.of_step[passing.trailing_zeros() as usize].push(number);
            passing &= passing - 1;
        }
    }

    /// Suspects at step `k` of the batch.
    pub(crate) fn at(&self, k: usize) -> impl Iterator<Item = &Suspect> {
        self.of_step[k].iter().map(|&i| &self.points[i as usize])
    }
}

/// The sum of two bounds.
#[inline(always)]
fn sum(mut a: Lanes, b: &Lanes) -> Lanes {
    for k in 0..BATCH {
        a[k] += b[k];
    }
    a
}

/// The look at all points of some clusters.
struct Look<'a, 'f, 's, I> {
    suspects: &'a mut Suspects,
    body: &'a Body,
    field: &'a mut StressField<'f>,
    survivors: I,
    system: &'a CrackSystem<'s>,
    now: f64,
    peak: Peak,
}

widest! {
    fn look[I: Iterator<Item = (u32, Steps)>](look: Look<'_, '_, '_, I>) {
        look.run();
    }

    /// The stress at a weak point, by gradients.
    fn at_weak_point(field: &mut StressField<'_>, tet: u32) -> StressLanes {
        field.at_weak_point(tet as usize)
    }
}

impl<I: Iterator<Item = (u32, Steps)>> Look<'_, '_, '_, I> {
    #[inline(always)]
    fn run(mut self) {
        let (body, config) = (self.body, self.field.config);
        let modes = self.field.displacement.amplitudes().len();
        let laws = body.rows.of(body, config, modes);
        if laws.is_some() {
            self.suspects.stress.begin(self.field);
        }
        while let Some((cluster, steps)) = self.survivors.next() {
            let cluster = cluster as usize;
            let mut tets = body.clusters.tets(cluster).iter();
            if tets.all(|&tet| self.is_over(tet)) {
                continue;
            }
            if let Some(laws) = laws {
                self.by_rows(cluster, laws.cluster(body, config, cluster), steps);
                continue;
            }
            let tets = body.clusters.tets(cluster);
            for (place, &tet) in body.clusters.places(cluster).zip(tets) {
                if !self.is_over(tet) {
                    self.by_displacement(place, tet, steps);
                }
            }
        }
    }
}

impl<I> Look<'_, '_, '_, I> {
    #[inline(always)]
    fn is_over(&self, tet: u32) -> bool {
        self.system.is_over(tet, self.now)
    }

    #[inline(always)]
    fn by_rows(&mut self, cluster: usize, rows: &ClusterRows, steps: Steps) {
        let body = self.body;
        let mut stress = std::mem::take(&mut self.suspects.stress);
        let limit = |tet| Suspects::limit(body, tet, self.peak);
        stress.look(body, self.field, cluster, rows, limit);
        let mut seen = stress.points(cluster);
        let mut pressed = seen.pressed().iter();
        let mut next = pressed.next();
        let mut doubts = 0;
        let points = (body.clusters.places(cluster)).zip(body.clusters.tets(cluster));
        for ((i, (place, &tet)), &frame) in (0..).zip(points).zip(&rows.frames) {
            let point = seen.next(self.field, frame);
            if self.is_over(tet) {
                if next == Some(&i) {
                    next = pressed.next();
                }
                continue;
            }
            if next == Some(&i) {
                next = pressed.next();
                self.by_displacement(place, tet, steps);
                continue;
            }
            let exact;
            let mut numbers = point.numbers;
            let holds = match &point.left_out {
                Rest::Nothing => None,
                Rest::OfAny(left_out) => Some(
                    self.is_below(frame, numbers, left_out, tet, steps)
                        || seen
                            .left_out_of(self.field, &point)
                            .is_some_and(|own| self.is_below(frame, numbers, &own, tet, steps)),
                ),
                // Much is left out: nothing of it is to be taken for the largest tension that was passed over.
                Rest::Own(left_out) => {
                    let bounds = sum(frame.tension_bounds(numbers), left_out);
                    Some(Suspects::passing(body, tet, &bounds, steps, self.peak) == 0)
                }
            };
            match holds {
                None => {}
                Some(true) => continue,
                Some(false) => {
                    doubts += 1;
                    exact = seen.exact(self.field, rows, &point);
                    numbers = &exact;
                }
            }
            let bounds = frame.tension_bounds(numbers);
            let passing = Suspects::passing(body, tet, &bounds, steps, self.peak);
            if passing != 0 {
                let mut state = frame.stress(numbers);
                self.field.elasticity.set_energy(&mut state);
                let suspect = Suspect {
                    place: place as u32,
                    tet,
                    state,
                    bounds,
                };
                self.suspects.note(suspect, passing);
            }
        }
        stress.doubted(cluster, doubts, rows.frames.len());
        self.suspects.stress = stress;
    }

    /// Returns true if bounds show that a point stays below its strength at all steps to look at.
    #[inline(always)]
    fn is_below(
        &mut self,
        frame: Frame,
        numbers: &[Lanes],
        left_out: &Lanes,
        tet: u32,
        steps: Steps,
    ) -> bool {
        let resistance = &self.body.resistance;
        let strength = resistance.strength(tet);
        let limit = limit(strength);
        let bounds = sum(frame.tension_bounds(numbers), left_out);
        let mut above = 0;
        for (k, bound) in bounds.iter().enumerate() {
            above |= Steps::from(*bound > limit) << k;
        }
        if above & steps != 0 {
            return false;
        }
        // No `clamp`, which would be a call.
        self.pass_over(tet, Wide(bounds).largest().max(0.0).min(limit));
        true
    }

    /// Takes note of a point whose tension is no more than this, Pa.
    #[inline(always)]
    fn pass_over(&mut self, tet: u32, most: f32) {
        let resistance = &self.body.resistance;
        let felt = resistance.as_weakest(most, resistance.strength(tet));
        let passed_over = &mut self.suspects.passed_over;
        *passed_over = [passed_over[0].max(most), passed_over[1].max(felt)];
    }

    /// Looks at a point by displacement gradients, where rows do not hold. A function of its own: inlined at each of its calls it took a third of
    /// the time in which the crate compiles.
    #[inline(never)]
    fn by_displacement(&mut self, place: usize, tet: u32, steps: Steps) {
        let state = at_weak_point(self.field, tet);
        let bounds = state.tension_bounds();
        let passing = Suspects::passing(self.body, tet, &bounds, steps, self.peak);
        if passing != 0 {
            let suspect = Suspect {
                place: place as u32,
                tet,
                state,
                bounds,
            };
            self.suspects.note(suspect, passing);
        }
    }
}
