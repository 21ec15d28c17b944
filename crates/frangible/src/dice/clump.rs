//! Clumps: pieces of dice that move together.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::network::{NONE, Network};
use super::surface::Corner;
use crate::fragment::Fragment;
use crate::mesh::{MassProperties, TriMesh};
use crate::rng::{Purpose, stream, uniform};

/// Dice of a tempered wall that move together.
#[derive(Clone, Debug)]
pub struct Clump {
    network: Arc<Network>,
    /// Its dice, rising.
    dice: Vec<u32>,
    /// Origin of its frame, m, frame of the fracture mesh.
    centre: DVec3,
    seed: u64,
    /// Number of partings that led to it.
    generation: u32,
}

impl Clump {
    /// All dice of a wall.
    pub(super) fn whole(network: Arc<Network>, seed: u64) -> Self {
        Self {
            dice: (0..network.dice.len() as u32).collect(),
            centre: DVec3::ZERO,
            network,
            seed,
            generation: 0,
        }
    }

    /// Number of dice.
    #[must_use]
    pub fn count(&self) -> usize {
        self.dice.len()
    }

    /// Number of breaks that led to it: 1 for a piece of a whole wall.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// Times at which the front of the cracks passed the dice, s since the start of the contact.
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        self.dice
            .iter()
            .map(|&die| self.network.time(die))
            .collect()
    }

    /// Middles of the dice on the upper face of the wall, m, frame of the clump.
    #[must_use]
    pub fn places(&self) -> Vec<Vec3> {
        let place = |&die: &u32| (self.network.points[die as usize][0] - self.centre).as_vec3();
        self.dice.iter().map(place).collect()
    }

    /// Parts it into so many clumps, or into single dice where it has fewer, largest first; places are in its own frame.
    #[must_use]
    pub fn part(&self, into: usize) -> (Vec<Fragment>, Vec<Arc<Self>>) {
        let labels = self.labels(into);
        let count = labels.iter().max().map_or(0, |&most| most as usize + 1);
        let mut dice_of: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (&die, &label) in self.dice.iter().zip(&labels) {
            dice_of[label as usize].push(die);
        }
        let mut label_of = vec![NONE; self.network.dice.len()];
        dice_of.sort_by_key(|dice| std::cmp::Reverse(dice.len()));
        for (label, dice) in (0..).zip(&dice_of) {
            dice.iter().for_each(|&die| label_of[die as usize] = label);
        }
        let mut vertex_of = vec![NONE; 2 * self.network.points.len()];
        let parts = dice_of.into_iter().map(|dice| {
            let fragment = self.fragment(&dice, &label_of, &mut vertex_of);
            let clump = Self {
                network: Arc::clone(&self.network),
                centre: self.centre + fragment.mass.centre,
                dice,
                seed: self.seed,
                generation: self.generation + 1,
            };
            (fragment, Arc::new(clump))
        });
        parts.unzip()
    }

    /// Part of each die: that of the nearest of some dice drawn by the seed, along the network.
    fn labels(&self, into: usize) -> Vec<u32> {
        let mut place_of = vec![NONE; self.network.dice.len()];
        for (place, &die) in (0..).zip(&self.dice) {
            place_of[die as usize] = place;
        }
        let mut labels = vec![NONE; self.dice.len()];
        let mut queue = VecDeque::new();
        let first = self.dice.first().copied().unwrap_or(0);
        let item = first.wrapping_mul(31).wrapping_add(self.dice.len() as u32);
        let mut rng = stream(self.seed, Purpose::Clumps, item);
        let mut order: Vec<u32> = (0..self.dice.len() as u32).collect();
        for i in 0..into.clamp(1, order.len().max(1)).min(order.len()) {
            let j = i + (uniform(&mut rng) * (order.len() - i) as f64) as usize;
            order.swap(i, j);
            labels[order[i] as usize] = i as u32;
            queue.push_back(order[i] as usize);
        }
        while let Some(at) = queue.pop_front() {
            for beside in self.network.neighbours(self.dice[at]) {
                let beside = place_of[beside as usize] as usize;
                if labels.get(beside) == Some(&NONE) {
                    labels[beside] = labels[at];
                    queue.push_back(beside);
                }
            }
        }
        // A wall in several pieces may have one without a die of its own.
        labels
            .iter_mut()
            .for_each(|label| *label = if *label == NONE { 0 } else { *label });
        labels
    }

    /// The piece of these dice, in the frame of this clump. `vertex_of`: for each point on each face no vertex yet, before and after.
    fn fragment(&self, dice: &[u32], label_of: &[u32], vertex_of: &mut [u32]) -> Fragment {
        let network = &*self.network;
        let own = label_of[dice[0] as usize];
        let (mut outer, mut hidden) = (Vec::new(), Vec::<[Corner; 3]>::new());
        outer.reserve(14 * dice.len());
        hidden.reserve(6 * dice.len());
        let (mut inner, mut neighbours) = (Vec::new(), Vec::new());
        for &die in dice {
            outer.extend(network.faces_of(die));
            for (triangles, neighbour) in network.sides_of(die) {
                let label = label_of.get(neighbour as usize).copied();
                match label {
                    None => outer.extend(triangles),
                    Some(label) if label == own => {
                        if neighbour > die {
                            hidden.extend(triangles);
                        }
                    }
                    Some(label) => {
                        inner.extend(triangles);
                        let other = if label == NONE {
                            Fragment::PARTED
                        } else {
                            label
                        };
                        neighbours.extend([other; 2]);
                    }
                }
            }
        }
        let outer_triangles = outer.len();
        outer.append(&mut inner);
        let place = |(point, side): Corner| network.points[point as usize][side];
        let of_mesh = |t: &[Corner; 3]| t.map(|c| place(c) - self.centre);
        let mass = MassProperties::of_surface(network.density, outer.iter().map(of_mesh));
        let local = |c: Corner| (place(c) - self.centre - mass.centre).as_vec3();
        let mut used: Vec<usize> = Vec::with_capacity(8 * dice.len());
        let mut positions = Vec::with_capacity(8 * dice.len());
        let triangles: Vec<[u32; 3]> = outer
            .iter()
            .map(|t| {
                t.map(|c| {
                    let slot = 2 * c.0 as usize + c.1;
                    if vertex_of[slot] == NONE {
                        vertex_of[slot] = positions.len() as u32;
                        used.push(slot);
                        positions.push(local(c));
                    }
                    vertex_of[slot]
                })
            })
            .collect();
        used.into_iter().for_each(|slot| vertex_of[slot] = NONE);
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            [(b - a).cross(c - a).normalize_or_zero(); 3]
        };
        let normals = triangles.iter().map(normal).collect();
        Fragment {
            cell_shares: vec![(0, positions.clone())],
            mesh: TriMesh {
                positions,
                triangles,
                normals,
                outer_triangles,
                cracks: hidden.iter().map(|t| t.map(local)).collect(),
            },
            neighbours,
            render: None,
            mass,
            supported: false,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
        }
    }
}
