//! Pieces that have parted move on their own (beyond the paper).
//!
//! A piece P has six rigid motions r (three shifts, three turns about its centre) that are zero outside it. With Φ the modes of the whole body,
//! the displacement is `u = Φ q' + R c`, c the six unknowns of each piece. Q = q' + P c are the modal amplitudes of the whole displacement,
//!
//! - `p_ki = ∫_P ρ φ_i · r_k` the projection of a piece's motion on the modes, √kg,
//! - `M = M_R − P0ᵀP0 − PᵀP` the rest of its mass: its own mass M_R, less the part that the body's rigid motion and its modes hold,
//! - `z_k = r_k(b) · n − Σ_i p_ki ξ_i − P0ᵀξ0` the push of a unit force at b on a piece, less what acts through the rigid motion and modes,
//!
//! and, with damping α Λ + β,
//!
//! `Q̈ + β Q̇ + Λ (Q − P c) + α Λ (Q̇ − P ċ) = ξ F`, `M c̈ + β M ċ = PᵀΛ (Q − P c) + α PᵀΛ (Q̇ − P ċ) + z F`.
//!
//! Strain energy and stress are those of q' = Q − P c. When a piece parts, c = ċ = 0: nothing jumps. The momentum of a piece against the whole
//! body's rigid motion, `PᵀQ̇ + M ċ`, is changed by outside forces alone. The largest child of what has not parted is the *reference*, whose
//! motion follows from those of the others. Faces of pieces that close press on each other at the four corners of their outline.
//!
//! Sources: a fault that drives the modes of the whole Earth (Gilbert, Geophys. J. 22, 1971); reanalysis of structures.

use glam::{DMat3, DVec3};

use super::apart::GroupMotion;
use super::faces::{Corner, corners};
use super::groups::Groups;
use super::moments::{Known, Moments, rigid_parts, rigid_push};
use super::plan::Plan;
use super::solve::{factor, is_positive, mirror, squares};
use crate::body::Body;

/// Shares of the pieces' own masses that are added to M; the first with which M is positive definite is used. Without them M may not be, since masses
/// are sums over the tetrahedra, in which the modes are not orthogonal.
const ADDED: [f64; 6] = [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3];

/// Least radius of a striker, in radii of the hole, with which it goes on to what is beside a piece: into such a hole it sinks by less than a fifth
/// of the hole's radius before it touches the rim. A ball that sinks in deeper flies through, or meets pieces elsewhere.
const BLUNT: f64 = 3.0;

/// The six rigid motions of a piece.
pub(super) const SIX: usize = 6;

/// Motion of a body from a time on, once pieces have parted. Lists have an entry for each of the pieces' n unknowns.
#[derive(Clone, Debug)]
pub(super) struct Parted {
    /// Time step and substep of the parting.
    pub(super) step: usize,
    pub(super) substep: usize,
    pub(super) groups: Groups,
    /// Centre of each group but the reference, m, in the frame of the fracture mesh.
    pub(super) centres: Vec<DVec3>,
    /// p: a row of modes for each unknown, √kg.
    pub(super) held: Vec<f64>,
    modes: usize,
    /// The groups' own masses and moments of inertia about their centres, kg and kg·m².
    masses: Vec<(f64, DMat3)>,
    /// M: n × n, kg and kg·m².
    pub(super) mass: Vec<f64>,
    /// z of each contact, with its friction and without: on the group under it, and on the [one beside](Self::beside).
    pushes: [Vec<[Vec<f64>; 2]>; 2],
    /// The group that each contact goes on to when the one under it has flown off: the rest of what that one was part of.
    pub(super) beside: Vec<Option<u32>>,
    pub(super) corners: Vec<Corner>,
}

impl Parted {
    /// Prepares the motion of these groups from a time step and a substep on.
    pub(super) fn new(
        body: &Body,
        plan: &Plan,
        before: Option<&Self>,
        groups: Groups,
        nodes: &[u32],
        [step, substep]: [usize; 2],
    ) -> Self {
        let known = before.map_or(Vec::new(), |before| before.as_they_were(&groups));
        let (moments, mixed) = Moments::of(body, &groups, &known);
        let n = SIX * moments.len();
        let mut held = Vec::with_capacity(n * plan.modes);
        let mut of_node = vec![(0.0, DVec3::ZERO); body.asset.analysis.nodes.len()];
        for (group, moment) in (1..).zip(&moments) {
            match known.get(group).and_then(Option::as_ref) {
                Some(known) => held.extend_from_slice(known.held),
                None => held.extend(moment.held(body, plan.modes, &mut of_node)),
            }
        }
        let rigid = rigid_parts(body, &moments);
        let by_modes = squares(&held, n, &vec![1.0; plan.modes]);
        let by_rigid = squares(rigid.as_flattened(), n, &[1.0; SIX]);
        let sums = by_modes.iter().zip(&by_rigid);
        let mut mass: Vec<f64> = sums.map(|(modes, rigid)| -(modes + rigid)).collect();
        mirror(&mut mass, n);
        let mut own = vec![0.0; n * n];
        for (g, moment) in moments.iter().enumerate() {
            moment.add_mass(&mut own, g, n);
        }
        mass.iter_mut().zip(&own).for_each(|(m, own)| *m += own);
        add_until_positive(&mut mass, &own, n);
        let centres: Vec<DVec3> = moments.iter().map(|m| m.centre).collect();
        let mut parted = Self {
            step,
            substep,
            held,
            modes: plan.modes,
            masses: moments.iter().map(|m| (m.mass, m.inertia)).collect(),
            mass,
            pushes: [Vec::new(), Vec::new()],
            beside: Vec::new(),
            corners: corners(body, &groups, &centres, &mixed),
            centres,
            groups,
        };
        for (k, site) in plan.sites.iter().enumerate() {
            let contact = &site.touch.contact;
            let group = parted.groups.of_node[nodes[k] as usize];
            let beside = parted.groups.beside(group).or_else(|| {
                let before = before?.beside[k]?;
                parted.groups.heir(before).filter(|&heir| heir != group)
            });
            let most = f64::from(contact.striker.curvature_radius) / BLUNT;
            let fits = |_: &u32| parted.radius_about(group, contact.normal.as_dvec3()) < most;
            parted.beside.push(beside.filter(fits));
            let at = contact.point.as_dvec3() + body.origin();
            let felt: Vec<f64> = plan.felt_by(k).collect();
            let ways = [
                (contact.direction().as_dvec3(), &plan.drive[k][..plan.modes]),
                (contact.normal.as_dvec3(), &felt[..]),
            ];
            for (which, (direction, shape)) in ways.into_iter().enumerate() {
                let by_body = rigid_push(body, direction, at);
                let push = |group: u32| {
                    let mut z = vec![0.0; n];
                    if group > 0 {
                        let first = SIX * (group as usize - 1);
                        let arm = at - parted.centres[group as usize - 1];
                        z[first..first + SIX].copy_from_slice(&wrench(direction, arm));
                    }
                    for (j, z) in z.iter_mut().enumerate() {
                        let row = parted.row(j).iter().zip(shape);
                        *z -= row.map(|(p, xi)| p * xi).sum::<f64>();
                        let rigid = rigid[j].iter().zip(&by_body);
                        *z -= rigid.map(|(p, xi)| p * xi).sum::<f64>();
                    }
                    z
                };
                let pushes = [push(group), push(parted.beside[k].unwrap_or(group))];
                parted.pushes[which].push(pushes);
            }
        }
        parted
    }

    /// Radius of a disc that has the mass of a group and its moment of inertia about an axis, m; 0 for the reference.
    fn radius_about(&self, group: u32, axis: DVec3) -> f64 {
        let own = (group as usize).checked_sub(1).map(|g| &self.masses[g]);
        own.map_or(0.0, |(mass, inertia)| {
            (2.0 * axis.dot(*inertia * axis) / mass).sqrt()
        })
    }

    /// z of each contact, with its friction, 0, or without, 1: on the group under it, or on the one beside if it has gone on to that.
    pub(super) fn pushes<'a>(
        &'a self,
        friction: usize,
        gone_on: &'a [Option<usize>],
    ) -> impl Iterator<Item = &'a [f64]> {
        let each = self.pushes[friction].iter().zip(gone_on);
        each.map(|(ways, &gone)| &ways[usize::from(gone.is_some())][..])
    }

    /// z of one contact without its friction.
    pub(super) fn push(&self, contact: usize, gone_on: &[Option<usize>]) -> &[f64] {
        &self.pushes[1][contact][usize::from(gone_on[contact].is_some())]
    }

    /// Known properties of the later groups: of each that has exactly the nodes of its parent.
    fn as_they_were(&self, later: &Groups) -> Vec<Option<Known<'_>>> {
        let mut counts_before = vec![0_u32; self.groups.parents.len()];
        let mut counts = vec![[0_u32; 2]; later.parents.len()];
        for (&before, &now) in self.groups.of_node.iter().zip(&later.of_node) {
            counts_before[before as usize] += 1;
            let [all, from_parent] = &mut counts[now as usize];
            *all += 1;
            *from_parent += u32::from(before == later.parents[now as usize]);
        }
        let of = |(&parent, [all, from_parent]): (&u32, [u32; 2])| {
            let g = (parent as usize).checked_sub(1)?;
            let is_all = all == from_parent && all == counts_before[parent as usize];
            let rows = SIX * self.modes;
            is_all.then(|| Known {
                mass: self.masses[g],
                centre: self.centres[g],
                held: &self.held[rows * g..rows * (g + 1)],
            })
        };
        later.parents.iter().zip(counts).map(of).collect()
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        SIX * self.centres.len()
    }

    /// p of an unknown, √kg: the projection of its motion on each mode.
    pub(super) fn row(&self, unknown: usize) -> &[f64] {
        &self.held[unknown * self.modes..(unknown + 1) * self.modes]
    }

    /// p of each unknown.
    pub(super) fn rows(&self) -> impl Iterator<Item = &[f64]> {
        (0..self.unknowns()).map(|j| self.row(j))
    }

    /// Velocity and angular velocity of each group but the reference for these momenta, m/s and rad/s.
    pub(super) fn velocities(&self, momenta: &[f64]) -> Vec<[DVec3; 2]> {
        let groups = momenta.chunks_exact(SIX).zip(&self.masses);
        let velocity = |(six, (mass, inertia)): (&[f64], &(f64, DMat3))| {
            let (linear, angular) = (DVec3::from_slice(six), DVec3::from_slice(&six[3..]));
            [linear / *mass, inertia.inverse() * angular]
        };
        groups.map(velocity).collect()
    }

    /// Motion of each group but the reference, with these velocities and angular velocities, m/s and rad/s.
    pub(super) fn motions(&self, drifts: &[[DVec3; 2]]) -> Vec<GroupMotion> {
        let motion = |(&centre, &[velocity, angular]): (&DVec3, &[DVec3; 2])| GroupMotion {
            centre,
            velocity,
            angular,
        };
        self.centres.iter().zip(drifts).map(motion).collect()
    }

    /// Kinetic energy of the groups but the reference, with these velocities and angular velocities, J.
    pub(super) fn kinetic_energy(&self, drifts: &[[DVec3; 2]]) -> f64 {
        let groups = self.masses.iter().zip(drifts);
        let of = |((mass, inertia), [v, w]): (&(f64, DMat3), &[DVec3; 2])| {
            0.5 * (mass * v.length_squared() + w.dot(*inertia * *w))
        };
        groups.map(of).sum()
    }

    /// Moves the nodes under contacts that have gone on before substep `until` to the nearest nodes of the groups that they have gone on to.
    pub(super) fn go_on(
        &self,
        body: &Body,
        plan: &Plan,
        gone_on: &[Option<usize>],
        until: usize,
        nodes: &mut [u32],
    ) {
        let positions = &body.asset.fracture.positions;
        for (k, node) in nodes.iter_mut().enumerate() {
            let Some(group) = self.beside[k].filter(|_| gone_on[k].is_some_and(|s| s < until))
            else {
                continue;
            };
            let point = plan.sites[k].touch.contact.point + body.origin().as_vec3();
            let own = (0..positions.len()).filter(|&v| self.groups.of_node[v] == group);
            let away = |v: usize| positions[v].distance_squared(point);
            let nearest = own.min_by(|&a, &b| away(a).total_cmp(&away(b)));
            *node = nearest.map_or(*node, |node| node as u32);
        }
    }

    /// Computes the unknowns of these groups, or their rates, from those of the groups before: children start with their parent's motion.
    pub(super) fn inherit(&self, before: Option<&Self>, unknowns: &[f64]) -> Vec<f64> {
        let mut own = vec![0.0; self.unknowns()];
        let Some(before) = before else { return own };
        for (g, six) in own.chunks_exact_mut(SIX).enumerate() {
            let parent = self.groups.parents[g + 1] as usize;
            if parent == 0 {
                continue;
            }
            let of_parent = &unknowns[SIX * (parent - 1)..SIX * parent];
            let (shift, turn) = (
                DVec3::from_slice(of_parent),
                DVec3::from_slice(&of_parent[3..]),
            );
            let shift = shift + turn.cross(self.centres[g] - before.centres[parent - 1]);
            shift.write_to_slice(six);
            turn.write_to_slice(&mut six[3..]);
        }
        own
    }
}

/// Adds shares of the pieces' own masses until M is positive definite.
fn add_until_positive(mass: &mut [f64], own: &[f64], n: usize) {
    let mut added = 0.0;
    for share in ADDED {
        for k in 0..n {
            mass[k * n + k] += (share - added) * own[k * n + k];
        }
        added = share;
        if is_positive(&factor(mass.to_vec(), n), n) {
            return;
        }
    }
}

/// Push of a unit force in this direction, at this arm from a piece's centre, on the piece's six motions.
pub(super) fn wrench(direction: DVec3, arm: DVec3) -> [f64; SIX] {
    let moment = arm.cross(direction);
    let (f, m) = (direction.to_array(), moment.to_array());
    [f[0], f[1], f[2], m[0], m[1], m[2]]
}

/// d dᵀ.
pub(crate) fn outer(d: DVec3) -> DMat3 {
    DMat3::from_cols(d * d.x, d * d.y, d * d.z)
}
