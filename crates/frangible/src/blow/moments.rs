//! Masses of groups of nodes, and projections of the groups' motions on the rigid motions and the modes of the whole body.

use glam::{DMat3, DVec3};

use super::groups::Groups;
use super::parted::{SIX, outer};
use crate::asset::Asset;
use crate::body::Body;

/// Properties of a group that are known from an earlier parting.
pub(super) struct Known<'a> {
    pub(super) mass: (f64, DMat3),
    pub(super) centre: DVec3,
    pub(super) held: &'a [f64],
}

/// Mass, centre and inertia of a group.
pub(super) struct Moments {
    pub(super) mass: f64,
    pub(super) centre: DVec3,
    pub(super) inertia: DMat3,
    /// Its tetrahedra, and the mass of each that is the group's own.
    parts: Vec<(u32, f64)>,
}

impl Moments {
    /// Computes the masses of all groups but the reference: each tetrahedron's mass is shared out among its nodes, and acts at its centroid. Also
    /// returns the tetrahedra that have nodes of several groups.
    pub(super) fn of(
        body: &Body,
        groups: &Groups,
        known: &[Option<Known<'_>>],
    ) -> (Vec<Self>, Vec<u32>) {
        let asset = &*body.asset;
        let (mesh, centroids) = (&asset.fracture, &body.prepared.centroids);
        let density = f64::from(asset.material.density as f32);
        let mut parts: Vec<Vec<(u32, f64)>> = vec![Vec::new(); groups.parents.len()];
        let mut mixed = Vec::new();
        let known = |group: u32| known.get(group as usize).and_then(Option::as_ref);
        let settled: Vec<bool> = (0..groups.parents.len() as u32)
            .map(|group| group == 0 || known(group).is_some())
            .collect();
        for tet in asset.tets() {
            let of_nodes = mesh.tets[tet].map(|v| groups.of_node[v as usize]);
            if of_nodes != [of_nodes[0]; 4] {
                mixed.push(tet as u32);
            } else if settled[of_nodes[0] as usize] {
                continue;
            }
            let quarter = 0.25 * density * mesh.volume(tet);
            for (i, &group) in of_nodes.iter().enumerate() {
                if !settled[group as usize] && !of_nodes[..i].contains(&group) {
                    let own = of_nodes.iter().filter(|&&g| g == group).count();
                    parts[group as usize].push((tet as u32, quarter * own as f64));
                }
            }
        }
        let edge = f64::from(body.prepared.edge);
        let of = |(group, parts): (u32, Vec<(u32, f64)>)| {
            if let Some(known) = known(group) {
                return Self {
                    mass: known.mass.0,
                    centre: known.centre,
                    inertia: known.mass.1,
                    parts,
                };
            }
            if parts.is_empty() {
                return Self::of_nodes(body, groups, group);
            }
            let at = |tet: u32| centroids[tet as usize].as_dvec3();
            let mass: f64 = parts.iter().map(|p| p.1).sum();
            let centre = parts.iter().map(|&(tet, m)| m * at(tet)).sum::<DVec3>() / mass;
            // Each tetrahedron has an inertia about its own centroid.
            let mut inertia = DMat3::from_diagonal(DVec3::splat(0.05 * edge * edge * mass));
            for &(tet, m) in &parts {
                let d = at(tet) - centre;
                inertia += m * (DMat3::from_diagonal(DVec3::splat(d.length_squared())) - outer(d));
            }
            Self {
                mass,
                centre,
                inertia,
                parts,
            }
        };
        ((0..).zip(parts).skip(1).map(of).collect(), mixed)
    }

    /// Mass of a group that is a splinter of a piece and has no whole tetrahedron of that: the volumes of its nodes. The modes of the piece hold nothing of
    /// it.
    fn of_nodes(body: &Body, groups: &Groups, group: u32) -> Self {
        let (index, mesh) = (&body.prepared.index, &body.asset.fracture);
        let own = (0..mesh.positions.len()).filter(|&v| groups.of_node[v] == group);
        let (mut volume, mut count, mut sum) = (0, 0.0, DVec3::ZERO);
        for v in own {
            volume += index.volumes[v];
            count += 1.0;
            sum += mesh.positions[v].as_dvec3();
        }
        let density = f64::from(body.asset.material.density as f32);
        let mass = density * index.total_volume * (volume as f64 / index.whole as f64);
        let edge = f64::from(body.prepared.edge);
        Self {
            mass,
            centre: sum / count,
            inertia: DMat3::from_diagonal(DVec3::splat(0.05 * edge * edge * mass)),
            parts: Vec::new(),
        }
    }

    /// Adds its mass and inertia to the matrix of all groups.
    pub(super) fn add_mass(&self, matrix: &mut [f64], group: usize, n: usize) {
        let first = SIX * group;
        for k in 0..3 {
            matrix[(first + k) * n + first + k] += self.mass;
            for l in 0..3 {
                matrix[(first + 3 + k) * n + first + 3 + l] += self.inertia.col(l)[k];
            }
        }
    }

    /// p of its six motions: six rows of modes. `of_node`: zeros for each node of the analysis mesh, and again when done.
    pub(super) fn held(&self, body: &Body, modes: usize, of_node: &mut [(f64, DVec3)]) -> Vec<f64> {
        let asset = &*body.asset;
        let mut touched = Vec::new();
        for &(tet, mass) in &self.parts {
            let way = body.prepared.centroids[tet as usize].as_dvec3() - self.centre;
            let point = asset.embedded_tet(tet as usize);
            let nodes = &asset.analysis.elements[point.element as usize];
            for (&node, value) in nodes.iter().zip(point.shape_values()) {
                let m = mass * f64::from(value);
                let (sum, moment) = &mut of_node[node as usize];
                if *sum == 0.0 {
                    touched.push(node);
                }
                *sum += m;
                *moment += m * way;
            }
        }
        touched.sort_unstable();
        let take = |&node: &u32| (node, std::mem::take(&mut of_node[node as usize]));
        let sums: Vec<_> = touched.iter().map(take).collect();
        project(asset, modes, &sums)
    }
}

widest! {
    /// Projections on each mode of six motions with these masses and moments at nodes, kg and kg·m: six rows of modes.
    fn project(asset: &Asset, modes: usize, sums: &[(u32, (f64, DVec3))]) -> Vec<f64> {
        let mut held = vec![0.0; SIX * modes];
        let [x, y, z, rx, ry, rz] = rows_of(&mut held, modes);
        for &(node, (m, s)) in sums {
            let [a, b, c] = asset.modes.rows(node as usize);
            let (a, b, c) = (&a[..modes], &b[..modes], &c[..modes]);
            for i in 0..modes {
                let (a, b, c) = (f64::from(a[i]), f64::from(b[i]), f64::from(c[i]));
                x[i] += m * a;
                y[i] += m * b;
                z[i] += m * c;
                rx[i] += s.y * c - s.z * b;
                ry[i] += s.z * a - s.x * c;
                rz[i] += s.x * b - s.y * a;
            }
        }
        held
    }
}

/// Six rows of a list.
fn rows_of(list: &mut [f64], width: usize) -> [&mut [f64]; SIX] {
    let mut rows = list.chunks_exact_mut(width.max(1));
    std::array::from_fn(|_| match rows.next() {
        Some(row) => &mut row[..width],
        None => &mut [],
    })
}

/// Push of a force on the mass-normalised rigid motions of a free body; zeros for a held one.
pub(super) fn rigid_push(body: &Body, direction: DVec3, at: DVec3) -> [f64; SIX] {
    let mass = &body.asset.mass;
    if body.asset.is_supported() {
        return [0.0; SIX];
    }
    normalised(
        mass.mass,
        mass.inertia,
        direction,
        (at - body.origin()).cross(direction),
    )
}

/// Momentum and angular momentum in the mass-normalised rigid motions of a body: squares add up to pᵀp/m + LᵀI⁻¹L.
fn normalised(mass: f64, inertia: DMat3, linear: DVec3, angular: DVec3) -> [f64; SIX] {
    // Rows of the inverse of Cholesky's factor of the inertia.
    let [a, b, c] = inertia.to_cols_array_2d();
    let l00 = a[0].sqrt();
    let (l10, l20) = (a[1] / l00, a[2] / l00);
    let l11 = (b[1] - l10 * l10).sqrt();
    let l21 = (b[2] - l20 * l10) / l11;
    let l22 = (c[2] - l20 * l20 - l21 * l21).sqrt();
    let x = angular.x / l00;
    let y = (angular.y - l10 * x) / l11;
    let z = (angular.z - l20 * x - l21 * y) / l22;
    let p = linear / mass.sqrt();
    [p.x, p.y, p.z, x, y, z]
}

/// P0: projection of each unknown on the rigid motions of the body.
pub(super) fn rigid_parts(body: &Body, moments: &[Moments]) -> Vec<[f64; SIX]> {
    if body.asset.is_supported() {
        return vec![[0.0; SIX]; SIX * moments.len()];
    }
    let whole = &body.asset.mass;
    let parts = moments.iter().flat_map(|m| {
        [DVec3::X, DVec3::Y, DVec3::Z, DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .enumerate()
            .map(move |(k, axis)| {
                let (linear, angular) = match k < 3 {
                    true => (
                        m.mass * axis,
                        m.mass * (m.centre - body.origin()).cross(axis),
                    ),
                    false => (DVec3::ZERO, m.inertia * axis),
                };
                normalised(whole.mass, whole.inertia, linear, angular)
            })
    });
    parts.collect()
}
