//! Crack initiation of an impact: tetrahedra and times at which the stress exceeds the strength.

use frangible::internals::stress::{
    DisplacementBatch, Elasticity, Symmetric3, largest_eigenvalue, largest_eigenvalue_bound,
};
use frangible::internals::{LookedAt, Vibration};
use frangible::{Body, FractureConfig};

use super::passes::HEADER;

/// If the largest tensile stress is within this share of the strength, the CPU decides.
pub const DOUBT: f32 = 1e-3;

/// A bound this many times the smallest strength leaves a motion to the CPU: its amplitudes' rounding, 2e-5 of the largest,
/// could then be as much as [`DOUBT`] of the strength.
const MOST_BOUND: f64 = 50.0;

/// Most entries of [`Initiation::exceeding`].
pub const LIST: usize = 64;

/// A weak tetrahedron whose stress exceeds its strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exceedance {
    /// The fracture tetrahedron.
    pub tet: u32,
    /// First such time step, from 0, at the time (step + 1) Δt after the start of the contact.
    pub step: usize,
    /// Its largest principal tensile stress at that step, Pa.
    pub stress: f32,
    /// Its largest principal tensile stress over all time, Pa.
    pub peak: f32,
}

/// Crack initiation of one impact: stress against strength at all weak tetrahedra and time steps, before any crack.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Initiation {
    /// Extent of the analysis.
    pub looked_at: LookedAt,
    /// Time steps of the impact.
    pub time_steps: usize,
    /// Largest principal tension met, Pa, and its tetrahedron. With [culling](frangible::FractureConfig::culling), tetrahedra and steps at which a
    /// bound stays below every strength are left out.
    pub peak_stress: f32,
    /// See [`Self::peak_stress`].
    pub peak_tet: Option<u32>,
    /// Largest tension over the strength of its tetrahedron, and the tetrahedron.
    pub peak_share: f32,
    /// See [`Self::peak_share`].
    pub most_strained: Option<u32>,
    /// Largest bound of the parts that were left out, Pa.
    pub passed_over: f32,
    /// Largest bound of the whole body at a time step, Pa; 0 where the CPU computed all this.
    pub bound: f32,
    /// Strength over the largest tensile stress or bound, each scaled to the weakest tetrahedron.
    pub margin: f64,
    /// First step with a tension above 1 − [`DOUBT`] of the strength.
    pub doubt: Option<usize>,
    /// First tension above the strength: of the first such step the largest tension, of equals the lowest tetrahedron.
    pub first: Option<Exceedance>,
    /// All tetrahedra whose stress passes their strength, ascending; the first [`LIST`] of them.
    pub exceeding: Vec<Exceedance>,
    /// Number of such tetrahedra, listed or not.
    pub exceeding_count: usize,
}

impl Initiation {
    /// Returns true if [`Self::exceeding`] is incomplete.
    #[must_use]
    pub fn overflowed(&self) -> bool {
        self.exceeding.len() < self.exceeding_count
    }

    /// First step at which a crack can start; none where the body clearly held.
    pub(crate) fn first_open(&self, body: &Body) -> Option<usize> {
        if self.is_safe(body) {
            self.doubt
        } else {
            Some(0)
        }
    }

    /// Returns true if [`DOUBT`] covers the rounding of the amplitudes.
    pub(crate) fn is_safe(&self, body: &Body) -> bool {
        f64::from(self.bound) <= MOST_BOUND * body.weakest()
    }

    /// Empty result.
    fn none(time_steps: usize) -> Self {
        Self {
            looked_at: LookedAt::Amplitudes,
            time_steps,
            peak_stress: 0.0,
            peak_tet: None,
            peak_share: 0.0,
            most_strained: None,
            passed_over: 0.0,
            bound: 0.0,
            margin: f64::INFINITY,
            doubt: None,
            first: None,
            exceeding: Vec::new(),
            exceeding_count: 0,
        }
    }

    fn set_margin(&mut self, body: &Body) {
        let felt = (f64::from(self.peak_share) * body.weakest()).max(f64::from(self.passed_over));
        self.margin = body.weakest() / felt;
    }

    /// Result for an impact whose bound, Pa, passes the limit at no time step.
    pub(crate) fn passed_over(bound: f32, body: &Body, time_steps: usize) -> Self {
        let mut found = Self {
            passed_over: bound,
            bound,
            ..Self::none(time_steps)
        };
        found.set_margin(body);
        found
    }

    /// Reads the words of `gather.wgsl`. `bounds`: largest bound of the steps that were passed over, and of all, Pa.
    pub(crate) fn read(words: &[u32], bounds: [f32; 2], body: &Body, time_steps: usize) -> Self {
        let [passed_over, bound] = bounds;
        let (header, list) = words.split_at(HEADER);
        let float = f32::from_bits;
        let step = |word: u32| (word != u32::MAX).then_some(word as usize);
        let tet = |place: u32| body.weak_tets().get(place as usize).copied();
        let peak_stress = float(header[0]);
        let count = header[8] as usize;
        let mut found = Self {
            looked_at: LookedAt::Stresses,
            peak_stress,
            peak_tet: tet(header[1]),
            peak_share: float(header[2]),
            most_strained: tet(header[3]),
            passed_over: float(header[9]).max(passed_over),
            bound,
            doubt: step(header[4]),
            first: step(header[5])
                .zip(tet(header[6]))
                .map(|(step, tet)| Exceedance {
                    tet,
                    step,
                    stress: float(header[7]),
                    peak: float(header[10]),
                }),
            exceeding: list
                .chunks_exact(4)
                .take(count)
                .filter_map(|e| {
                    Some(Exceedance {
                        tet: tet(e[0])?,
                        step: e[1] as usize,
                        stress: float(e[2]),
                        peak: float(e[3]),
                    })
                })
                .collect(),
            exceeding_count: count,
            ..Self::none(time_steps)
        };
        found.set_margin(body);
        found
    }
}

/// Computes [`Gpu::initiation`](super::Gpu::initiation) on the CPU, with the GPU's arithmetic and without culling: every weak tetrahedron at every
/// time step from `first_step` on. For tests and comparisons, and where the GPU is in doubt.
#[must_use]
pub fn initiation_on_cpu(
    body: &Body,
    vibration: &Vibration,
    config: &FractureConfig,
    first_step: usize,
) -> Initiation {
    let mut found = Initiation::none(vibration.report.time_steps);
    let mut of_tet: Vec<Option<Exceedance>> = vec![None; body.weak_tets().len()];
    let visit = |place: usize, tet, step, tensor: &Symmetric3| {
        let strength = body.strength(tet);
        // Nothing that is kept changes: most tetrahedra at most times, and the bound needs no trigonometry.
        let bound = largest_eigenvalue_bound(tensor);
        let kept = found.peak_stress.min(strength * (1.0 - DOUBT));
        if bound <= kept && bound <= found.peak_share * strength {
            return;
        }
        let stress = largest_eigenvalue(tensor);
        if stress > found.peak_stress {
            (found.peak_stress, found.peak_tet) = (stress, Some(tet));
        }
        let share = stress / strength;
        if share > found.peak_share {
            (found.peak_share, found.most_strained) = (share, Some(tet));
        }
        if stress > strength * (1.0 - DOUBT) {
            found.doubt.get_or_insert(step);
        }
        match &mut of_tet[place] {
            Some(known) => known.peak = known.peak.max(stress),
            None if stress > strength => {
                let (peak, exceedance) = (stress, &mut of_tet[place]);
                *exceedance = Some(Exceedance {
                    tet,
                    step,
                    stress,
                    peak,
                });
            }
            None => (),
        }
    };
    follow(body, vibration, config, first_step, visit);
    let all: Vec<Exceedance> = of_tet.into_iter().flatten().collect();
    let earlier = |a: &Exceedance, b: &Exceedance| {
        (a.step.cmp(&b.step))
            .then(b.stress.total_cmp(&a.stress))
            .then(a.tet.cmp(&b.tet))
    };
    found.looked_at = LookedAt::Stresses;
    found.first = all.iter().copied().min_by(earlier);
    found.exceeding_count = all.len();
    found.exceeding = all.into_iter().take(LIST).collect();
    found.set_margin(body);
    found
}

/// Visits every step and weak tetrahedron (place in the list, number, step, stress).
fn follow(
    body: &Body,
    vibration: &Vibration,
    config: &FractureConfig,
    first_step: usize,
    mut visit: impl FnMut(usize, u32, usize, &Symmetric3),
) {
    let asset = &**body.asset();
    let motion = vibration.motion(body);
    let elasticity = Elasticity::new(asset.material()).with_green_lagrange(config.is_paper());
    let places: Vec<_> = (body.weak_tets().iter())
        .map(|&tet| body.weak_place(tet, config, &vibration.pressed))
        .collect();
    let mut displacement = DisplacementBatch::new(asset);
    for step in first_step..motion.steps() {
        displacement.seek(&motion, step);
        for (place, &tet) in body.weak_tets().iter().enumerate() {
            let (point, law) = places[place];
            let gradient = displacement.gradient(asset, &point, step);
            visit(place, tet, step, &elasticity.state_by(gradient, law).stress);
        }
    }
}
