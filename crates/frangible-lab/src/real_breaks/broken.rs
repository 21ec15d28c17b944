//! A broken body, and measures of its cracks.

use std::collections::BTreeMap;

use frangible::Outcome;
use frangible::glam::Vec3;
use frangible::internals::CrackTrace;

use super::subjects::Subject;

/// The part of a crack in one tetrahedron.
#[derive(Clone, Copy)]
pub(crate) struct Cut {
    /// Its middle, m, body frame.
    pub(crate) place: Vec3,
    /// Unit normal of the crack.
    pub(crate) normal: Vec3,
    /// Area of the crack in it, m².
    pub(crate) area: f64,
}

/// A body that broke.
pub(crate) struct Broken {
    /// Point of impact, m, body frame: the middle of the contacts, weighted by their impulses.
    pub(crate) hit: Vec3,
    /// Unit direction of the push.
    pub(crate) push: Vec3,
    /// Share of the volume of each piece, largest first.
    pub(crate) shares: Vec<f64>,
    /// Middles of these pieces, m, body frame.
    pub(crate) middles: Vec<Vec3>,
    pub(crate) cracks: usize,
    pub(crate) forks: usize,
    pub(crate) first: Option<Vec3>,
    pub(crate) first_time: Option<f64>,
    /// Sum of the contacts' largest forces, N, and duration of the longest contact, s.
    pub(crate) force: f64,
    pub(crate) contact: f64,
    pub(crate) cuts: Vec<Cut>,
    /// Mean edge of the tetrahedra, m.
    pub(crate) edge: f64,
    /// Nodes, m, with the piece that each belongs to.
    nodes: Vec<(Vec3, u32)>,
    /// Corners of the box around the body, m.
    pub(crate) bounds: [Vec3; 2],
}

impl Broken {
    /// None where it held.
    pub(crate) fn of(subject: &Subject, outcome: Outcome, trace: &CrackTrace) -> Option<Self> {
        let Outcome::Broke(fracture) = outcome else {
            return None;
        };
        let (mesh, report) = (subject.kind.asset().fracture(), &fracture.report);
        let whole = subject.kind.asset().mass().volume;
        let mut pieces: Vec<(f64, Vec3)> = fracture
            .fragments
            .iter()
            .map(|f| (f.mass.volume / whole, f.mass.centre.as_vec3()))
            .collect();
        pieces.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (mut hit, mut push, mut weight) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for contact in &report.contacts {
            let impulse = contact.impulse as f32;
            hit += impulse * contact.point;
            push += impulse * contact.normal;
            weight += impulse;
        }
        let cuts = trace.cracks.iter().flatten();
        let nodes = mesh.positions.iter().copied();
        let ends = |f: fn(Vec3, Vec3) -> Vec3| mesh.positions.iter().copied().reduce(f);
        Some(Self {
            hit: hit / weight,
            push: push.normalize_or_zero(),
            shares: pieces.iter().map(|p| p.0).collect(),
            middles: pieces.iter().map(|p| p.1).collect(),
            cracks: report.cracks,
            forks: report.forks,
            first: report.first_crack_point,
            first_time: report.first_crack_time,
            cuts: cuts
                .filter_map(|cut| section(mesh.corners(cut.tet as usize), cut.values))
                .collect(),
            force: report.contacts.iter().map(|c| c.peak_force).sum(),
            contact: report
                .contacts
                .iter()
                .map(|c| c.duration)
                .fold(0.0, f64::max),
            edge: f64::from(mesh.mean_edge()),
            nodes: nodes.zip(trace.fragment_of_node.iter().copied()).collect(),
            bounds: [ends(Vec3::min)?, ends(Vec3::max)?],
        })
    }

    /// The lowest place of the body along z, m.
    pub(crate) fn foot(&self) -> f32 {
        self.bounds[0].z
    }

    /// Height above the foot over the height of the body.
    pub(crate) fn height(&self, place: Vec3) -> f64 {
        f64::from((place.z - self.foot()) / (self.bounds[1].z - self.foot()))
    }

    /// Parts of a zone: the shares of its nodes that pieces have, largest first, down to 2 %.
    pub(crate) fn parts(&self, zone: impl Fn(Vec3) -> bool) -> Vec<f64> {
        let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
        let inside = self.nodes.iter().filter(|(place, _)| zone(*place));
        inside.for_each(|(_, piece)| *counts.entry(*piece).or_default() += 1);
        let all: usize = counts.values().sum();
        let shares = counts.values().map(|&n| n as f64 / all as f64);
        let mut shares: Vec<f64> = shares.filter(|share| *share >= 0.02).collect();
        shares.sort_by(|a, b| b.total_cmp(a));
        shares
    }

    /// Share of the area of the cuts that these are about for which something holds; none without cracks there.
    pub(crate) fn share(
        &self,
        of: impl Fn(&Cut) -> bool,
        holds: impl Fn(&Cut) -> bool,
    ) -> Option<f64> {
        let (mut sum, mut all) = (0.0, 0.0);
        for cut in self.cuts.iter().filter(|cut| of(cut)) {
            all += cut.area;
            sum += if holds(cut) { cut.area } else { 0.0 };
        }
        (all > 0.0).then(|| sum / all)
    }

    /// Returns true if a cut runs away from the point of impact, seen along the push.
    pub(crate) fn runs_away(&self, cut: &Cut) -> bool {
        let flat = |v: Vec3| v - self.push * v.dot(self.push);
        let across = self
            .push
            .cross(flat(cut.place - self.hit))
            .normalize_or_zero();
        cut.normal.dot(across).abs() > std::f32::consts::FRAC_1_SQRT_2
    }

    /// Arms on the circle of this radius about the point of impact, m.
    pub(crate) fn arms(&self, radius: f64) -> f64 {
        let u = self.push.any_orthonormal_vector();
        let v = self.push.cross(u);
        let near = self.cuts.iter().filter(|cut| {
            let (distance, _) = self.across(cut.place);
            (distance - radius).abs() < 0.5 * self.edge
                && f64::from(cut.place.distance(self.hit)) < 1.5 * radius + self.edge
                && self.runs_away(cut)
        });
        let angle = |cut: &Cut| {
            let d = cut.place - self.hit;
            f64::from(d.dot(v).atan2(d.dot(u)))
        };
        let mut angles: Vec<f64> = near.map(angle).collect();
        angles.sort_by(f64::total_cmp);
        let Some(first) = angles.first().copied() else {
            return 0.0;
        };
        angles.push(first + std::f64::consts::TAU);
        groups(&angles, 1.5 * self.edge / radius).max(2) as f64 - 1.0
    }

    /// Rings between two distances from the point of impact, m: the mean over 72 lines.
    pub(crate) fn rings(&self, nearest: f64, farthest: f64) -> f64 {
        let u = self.push.any_orthonormal_vector();
        let v = self.push.cross(u);
        let around: Vec<&Cut> = self
            .cuts
            .iter()
            .filter(|cut| !self.runs_away(cut))
            .collect();
        let lines = 72;
        let on_line = |i: usize| {
            let (sine, cosine) = (std::f32::consts::TAU * i as f32 / lines as f32).sin_cos();
            let (out, aside) = (cosine * u + sine * v, cosine * v - sine * u);
            let mut places: Vec<f64> = around
                .iter()
                .filter(|cut| f64::from((cut.place - self.hit).dot(aside).abs()) < 0.5 * self.edge)
                .map(|cut| f64::from((cut.place - self.hit).dot(out)))
                .filter(|at| (nearest..farthest).contains(at))
                .collect();
            places.sort_by(f64::total_cmp);
            groups(&places, 1.5 * self.edge) as f64
        };
        (0..lines).map(on_line).sum::<f64>() / lines as f64
    }

    /// Distance of a place from the line along the push through the point of impact, and along it, m.
    pub(crate) fn across(&self, place: Vec3) -> (f64, f64) {
        let d = place - self.hit;
        let along = d.dot(self.push);
        (
            f64::from((d - along * self.push).length()),
            f64::from(along),
        )
    }
}

/// Returns true if a cut of a body about the z-axis runs along the axis, or out from it: its normal lies within 45° of the direction around the axis.
pub(crate) fn meridional(cut: &Cut) -> bool {
    let around = Vec3::Z.cross(cut.place).normalize_or_zero();
    cut.normal.dot(around).abs() > std::f32::consts::FRAC_1_SQRT_2
}

/// Distance from the z-axis, m.
pub(crate) fn radius(place: Vec3) -> f32 {
    place.truncate().length()
}

/// Number of groups in sorted numbers, separated by more than a gap.
fn groups(sorted: &[f64], gap: f64) -> usize {
    let apart = sorted.windows(2).filter(|pair| pair[1] - pair[0] > gap);
    usize::from(!sorted.is_empty()) + apart.count()
}

/// The polygon where a function, linear in a tetrahedron, is zero.
fn section(corners: [Vec3; 4], values: [f32; 4]) -> Option<Cut> {
    let mut points = Vec::with_capacity(4);
    let (above, below): (Vec<usize>, Vec<usize>) = (0..4).partition(|&k| values[k] >= 0.0);
    for (n, &i) in above.iter().enumerate() {
        // Back and forth, so that four points go round.
        let mut others = below.clone();
        if n % 2 == 1 {
            others.reverse();
        }
        for j in others {
            let share = values[i] / (values[i] - values[j]);
            points.push(corners[i].lerp(corners[j], share));
        }
    }
    let middle = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
    let sides = (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()]));
    let twice: Vec3 = sides.map(|(a, b)| (a - middle).cross(b - middle)).sum();
    let area = 0.5 * f64::from(twice.length());
    (area > 0.0).then(|| Cut {
        place: middle,
        normal: twice.normalize_or_zero(),
        area,
    })
}
