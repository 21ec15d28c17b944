//! Cracks run `[G12 §5.2, Algorithm 2]`.
//!
//! A crack passes from a fractured tetrahedron to its face neighbour n when n's nodes have both signs of s (of a steered
//! crack: the shared face's nodes), n is not fractured, and `E_f + A_n G_c < E_s + A_n γ η_n` (the test of the text; the printed Algorithm 2
//! leaves the candidate out).
//!
//! Beyond the paper, each a switch:
//! - *Griffith's fronts*: what a crack gains by growing follows from its present size (`feed.rs`; of one that was there before, `tips.rs`);
//! - *finite speed*: fronts arrive along the crack's own path at a share of the Rayleigh speed; a front that lacks
//!   energy waits and is tried again with the stress of the next step, so cracks follow the wave outwards;
//! - *steering*: s is kept at the nodes. The fourth node of n gets the mean over the three shared ones of
//!   `s_i + (x_v − x_i)·d − A (N(x_v) − N(x_i))`, d the crack's normal at n, turned towards the traction σd across the crack.
//!   A crack grows so that no shear acts across its tip (R. V. Goldstein, R. L. Salganik, Int. J. Fracture 10 (1974) 507): tension along it does
//!   not turn it, however large, so that the arms of a star run straight on through the rings of tension about a blow. Where nothing pulls
//!   across a crack it does not turn: on the compressed side of a bent wall it would peel the wall along its middle.
//!   Where toughness varies the crack then kinks to where it costs least for what it releases (`fields/kink.rs`).
//!   Cracks in thin walls stand upright (`stress/wall.rs`): no traction acts on the wall's faces.

use glam::Vec3;

use super::arrival::{Entered, Source, gate};
use super::branching::{forks, start};
use super::felt::Felt;
use super::field::StressField;
use super::passing::passes;
use super::single::{ElementCut, Front};
use super::system::{CrackSystem, UNCUT};
use crate::fields::Tip;
use crate::state::crossing_middle;
use crate::stress::{Symmetric3, largest_eigenvalue};

/// Share of R_c below which the tension across a crack does not steer it.
const STEERING_GATE: f64 = 0.3;

/// Distance ahead, in mean edges, within which a crack looks for the cheapest direction.
const KINK_REACH: f32 = 1.0;

/// A known value this far (in mean edges) from its prediction means that the crack has met another sheet of itself; less is its own
/// curvature, and it takes the known value. Chosen by measurement: with half an edge, and less where the signs differ, neighbouring fronts
/// of one sheet take each other for two and leave bridges (a block of porcelain on its corner at 15 m/s, cracked four times its section, keeps
/// pieces of 0.94 of itself; with one edge 0.40 at most); with two edges the pieces are much the same.
const SELF_MEETING: f32 = 1.0;

/// Sends the stalled fronts on again from `since`, s.
pub(crate) fn retry(system: &mut CrackSystem, since: f64) {
    for front in std::mem::take(&mut system.stalled) {
        let waited = front.arrival < since;
        system.fronts.push(Front {
            arrival: front.arrival.max(since),
            source: if waited { Source::WAITED } else { front.source },
            ..front
        });
    }
}

/// Runs all fronts that arrive by `now`, s.
pub(crate) fn advance(system: &mut CrackSystem, field: &mut StressField, now: f64) {
    while let Some(front) = system.fronts.peek().copied() {
        if front.arrival > now {
            break;
        }
        system.fronts.pop();
        enter(system, field, front);
    }
}

/// A front enters the tetrahedron ahead, which its crack crosses, if that is not at rest, nothing has cut it, and the crack can pay for it.
fn enter(system: &mut CrackSystem, field: &mut StressField, front: Front) {
    let n = front.tet as usize;
    if system.fractured_by[n] == front.crack {
        return;
    }
    if system.fractured_by[n] != UNCUT {
        system.meet(&front, false);
        let from = system.cracks[front.crack as usize].elements[front.from as usize];
        if let Some(beyond) = passes(system, field, &front, &from) {
            start(system, field, front.crack, &from, &beyond);
        }
        return;
    }
    if system.rests(front.tet, front.arrival) {
        return;
    }
    // Stress is costly to find: a front that lacks energy waits without it. A turn would hardly change its area.
    let ahead @ (straight, place) = match front.waiting {
        Some(waiting) => {
            let waiting = &system.waiting[waiting as usize];
            (waiting.area, waiting.place)
        }
        None => straight_on(system, &front, &Crossing::of(system, &front)),
    };
    let area = system.edge * system.edge;
    let lacks = match front.lacks {
        0.0 if system.ledger.has(system.cost(front.tet, area)) => 0.0,
        0.0 => system.cost(front.tet, straight),
        known => known,
    };
    if !system.ledger.has(lacks) {
        if !system.ledger.never_has(lacks) {
            system.wait(Front { lacks, ..front }, ahead);
        }
        return;
    }
    system.keep_section(front.crack, field);
    if system.waits_on(&front, field) {
        return system.wait(front, ahead);
    }
    let felt = field.at(n, place);
    if !system.passes_film(&front, &felt, field)
        || system.stays_refused(&front, &felt, place, field)
    {
        return system.wait(front, ahead);
    }
    let mut crossing = Crossing::of(system, &front);
    let Some((direction, opens)) = steers(system, &felt, &front, &mut crossing) else {
        return system.meet(&front, true);
    };
    let cut = ElementCut {
        tet: front.tet,
        values: crossing.values,
        direction,
        opens,
        mirror: f32::INFINITY,
        time: match system.config.is_paper() {
            false => front.arrival,
            true => crossing.from.time,
        },
    };
    let area = system.area(&crossing.x, &cut.values, cut.direction);
    match pays(system, field, &felt, &front, &cut, (place, area)) {
        Payment::Refused => {}
        Payment::Later { lacks } => {
            let refused = area;
            let front = Front {
                lacks,
                refused,
                ..front
            };
            system.wait(front, ahead);
        }
        Payment::Now { gain } => {
            let fork = forks(system, &front, &cut, &felt);
            let entered = crossing.entered(&front, &cut);
            let cut = system.marked(front.crack, cut, &felt);
            system.fracture(front.crack, cut, &entered, area, gain);
            if let Some(fork) = fork
                && start(system, field, front.crack, &cut, &fork)
            {
                system.forks += 1;
            }
        }
    }
}

/// The tetrahedron ahead of a front, as its crack crosses it.
struct Crossing {
    /// The crack's cut in the tetrahedron that the front comes from.
    from: ElementCut,
    /// Corners, m.
    x: [Vec3; 4],
    /// s at the corners, m; a steered crack does not know the fourth yet.
    values: [f32; 4],
    /// Roughness of a steered crack at the corners, m.
    rough: [f32; 4],
    /// The corner that the shared face does not have.
    fourth: usize,
}

impl Crossing {
    fn of(system: &CrackSystem, front: &Front) -> Self {
        let mesh = &system.asset.fracture;
        let crack = &system.cracks[front.crack as usize];
        let from = crack.elements[front.from as usize];
        let from_nodes = mesh.tets[from.tet as usize];
        // Values of the shared face are those of the tetrahedron the front comes from.
        let (mut values, mut fourth) = ([0.0_f32; 4], 0);
        for (k, node) in mesh.tets[front.tet as usize].iter().enumerate() {
            match from_nodes.iter().position(|v| v == node) {
                Some(i) => values[k] = from.values[i],
                None => fourth = k,
            }
        }
        let x = mesh.corners(front.tet as usize);
        let rough = if system.config.is_paper() {
            values[fourth] = crack.frame.planar(x[fourth]);
            [0.0; 4]
        } else {
            x.map(|x| crack.frame.roughness(x))
        };
        Self {
            from,
            x,
            values,
            rough,
            fourth,
        }
    }

    /// s of the smooth surface at the corners, m.
    fn smooth(&self) -> [f32; 4] {
        std::array::from_fn(|k| self.values[k] + self.rough[k])
    }

    /// s at the fourth corner if the crack has this direction, m: the mean of the extrapolations from the other three.
    fn predicted(&self, direction: Vec3) -> f32 {
        let Self { x, fourth, .. } = *self;
        let smooth = self.smooth();
        let sum: f32 = (0..4)
            .filter(|&i| i != fourth)
            .map(|i| smooth[i] + (x[fourth] - x[i]).dot(direction))
            .sum();
        sum / 3.0 - self.rough[fourth]
    }

    /// The tetrahedron ahead, as the front enters it.
    fn entered(&self, front: &Front, cut: &ElementCut) -> Entered {
        let mut source = front.source;
        if source == Source::WAITED {
            source = Source {
                place: gate(&self.x, &cut.values, self.fourth),
                since: front.arrival,
            };
        }
        Entered::through(&self.x, cut, self.fourth, source)
    }
}

/// The crack's normal in the tetrahedron ahead, where it turns, and the normal of the face of a wall that it opens from. A steered
/// crack finds s at the fourth node; none where it meets another sheet of itself.
fn steers(
    system: &CrackSystem,
    felt: &Felt,
    front: &Front,
    crossing: &mut Crossing,
) -> Option<(Vec3, Vec3)> {
    let crack = &system.cracks[front.crack as usize];
    let Some(turning_length) = system.config.turning_length() else {
        return Some((crack.frame.normal, Vec3::ZERO));
    };
    let from = crossing.from;
    let mesh = &system.asset.fracture;
    let place = system.centroids[from.tet as usize];
    let length = system.centroids[front.tet as usize].distance(place);
    let (stress, opens) = felt.steering(from.opens);
    let ahead = match &felt.wall {
        Some((wall, _)) => upright(from.direction, wall.normal),
        _ => from.direction,
    };
    let toward = steered(
        ahead,
        &stress,
        system.resistance.painted(front.tet),
        f64::from(length),
        turning_length,
    );
    let tip = Tip {
        tet: front.tet,
        normal: toward,
        from: place,
        reach: KINK_REACH * system.edge,
    };
    let toward = system.resistance.toughness.kinked(mesh, tip);
    let predicted = crossing.predicted(toward);
    let node = mesh.tets[front.tet as usize][crossing.fourth];
    let known = system.values.get(front.crack, node);
    if known.is_some_and(|known| (known - predicted).abs() > SELF_MEETING * system.edge) {
        return None;
    }
    crossing.values[crossing.fourth] = known.unwrap_or(predicted);
    // The roughness turns the surface, but not the way of the crack.
    let direction = gradient(&crossing.x, &crossing.smooth());
    Some((direction.unwrap_or(toward), opens))
}

/// Result of a crack's energy test for a tetrahedron.
enum Payment {
    /// The ledger has no more, and never will.
    Refused,
    /// Not under the present stress, or not before so much energy has come, J.
    Later { lacks: f64 },
    /// Yes; the area sets so much energy free, J.
    Now { gain: f64 },
}

/// The energy test of a front `[G12 Algorithm 2]`: `E_f + A_n G_c < E_s + A_n γ η_n`.
fn pays(
    system: &mut CrackSystem,
    field: &StressField,
    felt: &Felt,
    front: &Front,
    cut: &ElementCut,
    (at, area): (Vec3, f32),
) -> Payment {
    let crack = &system.cracks[front.crack as usize];
    let cost = system.cost(front.tet, area);
    let enough = crack.spent + cost - crack.available;
    let gain = system.gain(front, felt, (cut.direction, at, area), enough, field);
    let crack = &system.cracks[front.crack as usize];
    if system.ledger.never_has(cost) {
        Payment::Refused
    } else if !system.ledger.has(cost) {
        Payment::Later { lacks: cost }
    } else if crack.spent + cost < crack.available + gain {
        Payment::Now { gain }
    } else {
        Payment::Later { lacks: 0.0 }
    }
}

/// The crack's normal, turned over a length of path towards the traction across the crack.
fn steered(
    normal: Vec3,
    stress: &Symmetric3,
    strength: f64,
    length: f64,
    turning_length: f64,
) -> Vec3 {
    let traction = stress.times(normal);
    let tension = f64::from(normal.dot(traction));
    let gate = (tension / strength - STEERING_GATE).clamp(0.0, 1.0);
    let weight = (-libm::expm1(-length / turning_length) * gate) as f32;
    // Added to the stress in all directions, the largest compression leaves its axes where they are, and no turn goes past them.
    let compression = largest_eigenvalue(&stress.scaled(-1.0)).max(0.0);
    let toward = (traction + compression * normal).normalize_or(normal);
    (normal * (1.0 - weight) + toward * weight).normalize_or(normal)
}

/// A direction turned into a wall of this normal: no traction acts on the faces, so nothing opens a crack that lies askew.
fn upright(direction: Vec3, normal: Vec3) -> Vec3 {
    (direction - direction.dot(normal) * normal).normalize_or(direction)
}

/// Area of a crack in the tetrahedron ahead if it does not turn there, m², and the middle of what it cuts, m.
fn straight_on(system: &CrackSystem, front: &Front, crossing: &Crossing) -> (f32, Vec3) {
    let Crossing {
        from, x, values, ..
    } = crossing;
    let mut values = *values;
    if system.config.is_paper() {
        // The paper looks at the stress of the tetrahedron [G12 §5.2.3].
        let centroid = system.centroids[front.tet as usize];
        return (system.area(x, &values, from.direction), centroid);
    }
    values[crossing.fourth] = crossing.predicted(from.direction);
    let area = system.area(x, &values, from.direction);
    (area, crossing_middle(x, &values))
}

/// Unit ∇s of the linear s in a tetrahedron; `None` where s does not vary.
pub(crate) fn gradient(x: &[Vec3; 4], s: &[f32; 4]) -> Option<Vec3> {
    let edges = glam::Mat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0]);
    let differences = Vec3::new(s[1] - s[0], s[2] - s[0], s[3] - s[0]);
    (edges.transpose().inverse() * differences).try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRENGTH: f32 = 4e7;

    /// The angle between the crack's normal and x at the end, rad, where it begins at `angle` in the plane of x and y, and runs five turning
    /// lengths under a stress of these principal values, Pa.
    fn settles(angle: f32, stress: [f32; 3]) -> f32 {
        let stress = Symmetric3 {
            diagonal: stress,
            off: [0.0; 3],
        };
        let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let end = (0..20).fold(normal, |normal, _| {
            steered(normal, &stress, f64::from(STRENGTH), 0.25, 1.0)
        });
        end.angle_between(Vec3::X)
    }

    #[test]
    fn a_crack_turns_across_the_tension_and_stays_there() {
        for angle in [0.2, 0.7, 1.0] {
            assert!(settles(angle, [3.0 * STRENGTH, 0.0, 0.0]) < 0.02, "{angle}");
        }
        // Shear is tension one way and as much pressure across it.
        assert!(settles(0.5, [3.0 * STRENGTH, -3.0 * STRENGTH, 0.0]) < 0.02);
        // Nor does it swing about the tension where the pressure is many times as large.
        assert!(settles(0.1, [3.0 * STRENGTH, -30.0 * STRENGTH, 0.0]) < 0.02);
    }

    #[test]
    fn tension_along_a_crack_does_not_turn_it() {
        let along = settles(0.0, [2.0 * STRENGTH, 9.0 * STRENGTH, 0.0]);
        assert!(along < 1e-3, "{along}");
    }

    #[test]
    fn a_crack_that_is_closed_or_hardly_pulled_runs_on_as_it_did() {
        for stress in [[-STRENGTH, 9.0 * STRENGTH, 0.0], [0.2 * STRENGTH, 0.0, 0.0]] {
            let angle = settles(0.2, stress);
            assert!((angle - 0.2).abs() < 1e-3, "{angle} {stress:?}");
        }
    }
}
