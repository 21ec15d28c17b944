//! Weak points that may crack, or raise the peak, at the steps of a batch: all steps of a point at once, so that the
//! arithmetic runs over the steps side by side. Parts of the body are looked at on the caller's threads. What cracks do in the meantime only takes suspects away: release
//! waves never raise the largest tension (λ_max(Q σ Q) ≤ max(λ_max(σ), 0), `stress/shadow.rs`).

use super::field::StressField;
use super::initiation::Peak;
use super::system::CrackSystem;
use super::weak_stress::{Added, Rest, Room, WeakStress};
use crate::body::Body;
use crate::stress::{BATCH, Frame, Lanes, LawRows, Steps, StressLanes, Wide, limit};

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
    /// batch begins. `survivors`: places of the clusters in the body's list, rising, bit k set where step k needs a look.
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
        let tets = |cluster: u32| body.clusters.tets(cluster as usize);
        let is_over = |tet: &u32| system.is_over(*tet, now);
        let survivors = survivors.filter(|(cluster, _)| !tets(*cluster).iter().all(is_over));
        let survivors: Vec<(u32, Steps)> = survivors.collect();
        let modes = field.displacement.amplitudes().len();
        let Some(laws) = body.rows.of(body, field.config, modes) else {
            for (cluster, steps) in survivors {
                let places = body.clusters.places(cluster as usize);
                for (place, tet) in places.zip(tets(cluster)).filter(|(_, tet)| !is_over(tet)) {
                    self.by_displacement(body, field, (place, *tet), steps, peak);
                }
            }
            return;
        };
        let threads = &field.config.threads;
        let count = |(cluster, _): &(u32, Steps)| tets(*cluster).len();
        let points: usize = survivors.iter().map(count).sum();
        let parts = match threads.count() {
            1 => 1,
            threads => (points / LEAST_PART).clamp(1, PARTS * threads),
        };
        let mut stress = std::mem::take(&mut self.stress);
        stress.begin(body, field, parts);
        let mut rest = (&survivors[..], &mut stress.added[..], 0, points);
        let mut tasks = Vec::with_capacity(parts);
        for (room, left) in stress.rooms.iter_mut().zip((1..=parts).rev()) {
            let (all, added, first, points) = rest;
            // A fair share of the points that are left.
            let (mut own, mut taken) = (0, 0);
            while own < all.len() && (left == 1 || taken * left < points) {
                taken += count(&all[own]);
                own += 1;
            }
            let (own, others) = all.split_at(own);
            let until = own.last().map_or(first, |(last, _)| *last as usize + 1);
            let (added, later) = added.split_at_mut(until - first);
            rest = (others, later, until, points - taken);
            tasks.push(Part {
                survivors: own,
                added,
                first,
                room,
            });
        }
        let look = Look {
            body,
            field,
            system,
            now,
            peak,
            farthest: &stress.farthest,
        };
        let finds = threads.map(tasks, || (), |(), part| look_at(look, part, laws));
        self.stress = stress;
        for finds in finds {
            let [most, felt] = finds.passed_over;
            self.passed_over = [self.passed_over[0].max(most), self.passed_over[1].max(felt)];
            for found in finds.found {
                match found {
                    Found::Suspect(suspect, passing) => self.note(suspect, passing),
                    Found::ByDisplacement(place, tet, steps) => {
                        self.by_displacement(body, field, (place, tet), steps, peak);
                    }
                }
            }
        }
    }

    /// Looks at a point by displacement gradients, where rows do not hold. A function of its own: inlined at each of its calls it took a third of
    /// the time in which the crate compiles.
    #[inline(never)]
    fn by_displacement(
        &mut self,
        body: &Body,
        field: &mut StressField,
        (place, tet): (usize, u32),
        steps: Steps,
        peak: Peak,
    ) {
        let state = at_weak_point(field, tet);
        let bounds = state.tension_bounds();
        let passing = Self::passing(body, tet, &bounds, steps, peak);
        if passing != 0 {
            let suspect = Suspect {
                place: place as u32,
                tet,
                state,
                bounds,
            };
            self.note(suspect, passing);
        }
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

/// Least number of points in a part of the body that is looked at by itself.
const LEAST_PART: usize = 2048;

/// Parts per thread: the longest of them ends soon after the others.
const PARTS: usize = 3;

/// The look at all points of some clusters.
#[derive(Clone, Copy)]
struct Look<'a, 'f, 's> {
    body: &'a Body,
    field: &'a StressField<'f>,
    system: &'a CrackSystem<'s>,
    now: f64,
    peak: Peak,
    /// Largest amplitude of each mode in the batch, m·√kg.
    farthest: &'a [f32],
}

/// Part of the clusters, and what is kept of them.
struct Part<'a> {
    /// Places of the clusters in the body's list, rising, and the steps to look at.
    survivors: &'a [(u32, Steps)],
    /// Contributions to the clusters from place `first` on.
    added: &'a mut [Option<Added>],
    first: usize,
    room: &'a mut Room,
}

/// Point that a look has found.
#[expect(clippy::large_enum_variant, reason = "few rows do not hold")]
enum Found {
    /// It may pass its strength, or the peak, at these steps.
    Suspect(Suspect, Steps),
    /// Rows do not hold for it.
    ByDisplacement(usize, u32, Steps),
}

/// Points that a look has found, in the order of the clusters, and the largest bound of those that it has passed over, Pa, and as the weakest point
/// would feel it.
#[derive(Default)]
struct Finds {
    found: Vec<Found>,
    passed_over: [f32; 2],
}

widest! {
    fn look_at(look: Look<'_, '_, '_>, part: Part<'_>, laws: &LawRows) -> Finds {
        look.run(part, laws)
    }

    /// The stress at a weak point, by gradients.
    fn at_weak_point(field: &mut StressField<'_>, tet: u32) -> StressLanes {
        field.at_weak_point(tet as usize)
    }
}

impl Look<'_, '_, '_> {
    #[inline(always)]
    fn is_over(&self, tet: u32) -> bool {
        self.system.is_over(tet, self.now)
    }

    #[inline(always)]
    fn run(self, mut part: Part<'_>, laws: &LawRows) -> Finds {
        let mut finds = Finds::default();
        for &(cluster, steps) in part.survivors {
            self.by_rows(cluster as usize, laws, steps, &mut part, &mut finds);
        }
        finds
    }

    #[inline(always)]
    fn by_rows(
        &self,
        cluster: usize,
        laws: &LawRows,
        steps: Steps,
        part: &mut Part<'_>,
        finds: &mut Finds,
    ) {
        let (body, field) = (self.body, self.field);
        let limit = |tet| Suspects::limit(body, tet, self.peak);
        let rows = laws.cluster(body, field.config, cluster);
        let added = &mut part.added[cluster - part.first];
        let of = (body, field);
        (part.room).look(of, (cluster, rows), self.farthest, added, limit);
        let mut seen = part.room.points(added.as_ref());
        let mut pressed = seen.pressed().iter();
        let mut next = pressed.next();
        let mut doubts = 0;
        let points = (body.clusters.places(cluster)).zip(body.clusters.tets(cluster));
        for ((i, (place, &tet)), &frame) in (0..).zip(points).zip(&rows.frames) {
            let point = seen.next(field, frame);
            if self.is_over(tet) {
                if next == Some(&i) {
                    next = pressed.next();
                }
                continue;
            }
            if next == Some(&i) {
                next = pressed.next();
                let found = Found::ByDisplacement(place, tet, steps);
                finds.found.push(found);
                continue;
            }
            let exact;
            let mut numbers = point.numbers;
            let holds = match &point.left_out {
                Rest::Nothing => None,
                Rest::OfAny(left_out) => {
                    let own = || seen.left_out_of(field, &point);
                    Some(
                        self.is_below(frame, numbers, left_out, (tet, steps), finds)
                            || own().is_some_and(|own| {
                                self.is_below(frame, numbers, &own, (tet, steps), finds)
                            }),
                    )
                }
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
                    exact = seen.exact(field, rows, &point);
                    numbers = &exact;
                }
            }
            let bounds = frame.tension_bounds(numbers);
            let passing = Suspects::passing(body, tet, &bounds, steps, self.peak);
            if passing != 0 {
                let mut state = frame.stress(numbers);
                field.elasticity.set_energy(&mut state);
                let suspect = Suspect {
                    place: place as u32,
                    tet,
                    state,
                    bounds,
                };
                finds.found.push(Found::Suspect(suspect, passing));
            }
        }
        if let Some(added) = added {
            added.doubted(doubts, rows.frames.len());
        }
    }

    /// Returns true if bounds show that a point stays below its strength at all steps to look at.
    #[inline(always)]
    fn is_below(
        &self,
        frame: Frame,
        numbers: &[Lanes],
        left_out: &Lanes,
        (tet, steps): (u32, Steps),
        finds: &mut Finds,
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
        let most = Wide(bounds).largest().max(0.0).min(limit);
        let felt = resistance.as_weakest(most, strength);
        let passed_over = &mut finds.passed_over;
        *passed_over = [passed_over[0].max(most), passed_over[1].max(felt)];
        true
    }
}
