//! Collapses of edges.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use frangible::glam::DVec3;
use frangible::internals::RenderMesh;

use super::near::Full;
use super::quadric::Quadric;
use super::topology::{MADE, Topology, is_between};

/// Least cosine between the normals of a face before and after.
const TURN: f64 = 0.3;

/// Least cosine between the normals of an outer face before and after: these faces lie on the surface that the author drew.
const OUTER_TURN: f64 = 0.98;

/// Distances that count as none, of the largest.
const EXACT: f64 = 1e-3;

/// Twice the area of the thinnest face that a collapse may make, in squares of its longest side.
const THIN: f64 = 0.02;

/// Rounds in which all moves are tried.
const PASSES: usize = 4;

/// A place that may move to another: bits of the squared distance, which are in its order, the two places, and how often they had changed.
type Candidate = Reverse<(u64, [u32; 2], [u32; 2])>;

struct Work<'a> {
    mesh: &'a RenderMesh,
    topology: &'a mut Topology,
    full: &'a mut Full,
    at: Vec<DVec3>,
    quadrics: Vec<Quadric>,
    /// Number of changes of each vertex so far.
    changes: Vec<u32>,
    heap: BinaryHeap<Candidate>,
    /// Squared distance that counts as none, m².
    exact: f64,
}

/// Moves places onto neighbours, or both to a place between, as long as the two meshes stay within `most`, m, of each other.
pub(super) fn collapse(mesh: &RenderMesh, topology: &mut Topology, full: &mut Full, most: f64) {
    let at: Vec<DVec3> = topology.places.iter().map(|p| p.as_dvec3()).collect();
    let mut quadrics = vec![Quadric::ZERO; at.len()];
    for face in &topology.faces {
        let [a, b, c] = face.places.map(|p| at[p as usize]);
        let across = (b - a).cross(c - a);
        let Some(normal) = across.try_normalize() else {
            continue;
        };
        let plane = Quadric::of_plane(a, normal, across.length());
        for place in face.places {
            quadrics[place as usize].add(&plane);
        }
    }
    let mut work = Work {
        changes: vec![0; at.len()],
        heap: BinaryHeap::new(),
        exact: (EXACT * most).powi(2),
        mesh,
        topology,
        full,
        at,
        quadrics,
    };
    // What could not move may be able to once others have moved.
    for _ in 0..PASSES {
        if !work.pass() {
            break;
        }
    }
    let places = work.at.iter().map(|p| p.as_vec3()).collect();
    topology.places = places;
}

impl Work<'_> {
    /// Tries all moves, the least first. Returns true if there was one.
    fn pass(&mut self) -> bool {
        for from in 0..self.at.len() as u32 {
            for to in self.neighbours(from) {
                self.offer(from, to);
            }
        }
        let mut moved = false;
        while let Some(Reverse((_, [from, to], changes))) = self.heap.pop() {
            let now = [from, to].map(|place| self.changes[place as usize]);
            if now == changes {
                let targets = self.targets(from, to);
                let mut targets = targets.into_iter();
                moved |= targets.any(|target| self.try_to_move(from, to, target));
            }
        }
        moved
    }

    /// Places that share a face with one, sorted.
    fn neighbours(&self, place: u32) -> Vec<u32> {
        let around = self.topology.around[place as usize].iter();
        let places = around.flat_map(|&face| self.topology.faces[face as usize].places);
        let mut neighbours: Vec<u32> = places.filter(|&other| other != place).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// Returns true if both places may move anywhere.
    fn are_free(&self, from: u32, to: u32) -> bool {
        [from, to].iter().all(|&place| self.topology.is_free(place))
    }

    /// Places to which a place and a neighbour may move together, the best first.
    fn targets(&self, from: u32, to: u32) -> Vec<DVec3> {
        let ends = [to, from].map(|place| self.at[place as usize]);
        if !self.are_free(from, to) {
            return vec![ends[0]];
        }
        let mut sum = self.quadrics[from as usize];
        sum.add(&self.quadrics[to as usize]);
        // Positions are stored in single precision, and are compared as such.
        let best = sum.best(0.5 * (ends[0] + ends[1])).as_vec3().as_dvec3();
        vec![best, ends[0], ends[1]]
    }

    fn offer(&mut self, from: u32, to: u32) {
        if self.topology.stays[from as usize] {
            return;
        }
        let mut sum = self.quadrics[from as usize];
        sum.add(&self.quadrics[to as usize]);
        let cost = if self.are_free(from, to) {
            if from > to {
                return;
            }
            sum.at(self.targets(from, to)[0])
        } else {
            // Far from a place its own planes weigh more than the mean.
            let target = self.at[to as usize];
            sum.at(target).max(self.quadrics[from as usize].at(target))
        };
        if !self.topology.is_authored(from) || cost <= self.exact {
            let changes = [from, to].map(|place| self.changes[place as usize]);
            self.heap
                .push(Reverse((cost.to_bits(), [from, to], changes)));
        }
    }

    /// Moves both places to a target if nothing forbids it.
    fn try_to_move(&mut self, from: u32, to: u32, target: DVec3) -> bool {
        let (mut shared, mut others) = (Vec::new(), Vec::new());
        for &face in &self.topology.around[from as usize] {
            let places = self.topology.faces[face as usize].places;
            let list = if places.contains(&to) {
                &mut shared
            } else {
                &mut others
            };
            list.push(face);
        }
        let Some(wedges) = self.wedges_after([from, to], &shared, &others) else {
            return false;
        };
        if shared.len() != 2 || self.common_neighbours(from, to) != 2 {
            return false;
        }
        if self.topology.is_authored(from) && !self.is_seen_as_before([from, to], &others, &wedges)
        {
            return false;
        }
        let moves = target != self.at[to as usize];
        let near_to = self.topology.around[to as usize].iter();
        let beside: Vec<u32> = near_to
            .copied()
            .filter(|face| !shared.contains(face))
            .collect();
        let after = |&face: &u32| {
            let places = self.topology.faces[face as usize].places;
            let corner = |place| match place == from || place == to {
                true => target,
                false => self.at[place as usize],
            };
            (face, places.map(corner))
        };
        let faces: Vec<(u32, [DVec3; 3])> = others.iter().chain(&beside).map(after).collect();
        let changed = if moves {
            &faces[..]
        } else {
            &faces[..others.len()]
        };
        if !changed
            .iter()
            .all(|&(face, after)| self.may_change(face, after))
        {
            return false;
        }
        let Some(shares) = self.full.shared_out(&shared, &faces) else {
            return false;
        };
        let middle = |&(_, [a, b, c]): &(u32, [DVec3; 3])| self.full.is_near((a + b + c) / 3.0);
        if (moves && !self.full.is_near(target)) || !changed.iter().all(middle) {
            return false;
        }
        self.full.take(&shared, &faces, shares);
        self.merge([from, to], target, &shared, &others, wedges);
        true
    }

    /// Gives the faces of a place to another, and moves that to the target.
    fn merge(
        &mut self,
        [from, to]: [u32; 2],
        target: DVec3,
        shared: &[u32],
        others: &[u32],
        wedges: Vec<u32>,
    ) {
        for &face in shared {
            let places = self.topology.faces[face as usize].places;
            self.topology.faces[face as usize].is_left = false;
            for place in places {
                self.topology.around[place as usize].retain(|&f| f != face);
            }
        }
        for (&face, wedge) in others.iter().zip(wedges) {
            let own = &mut self.topology.faces[face as usize];
            let k = corner(&own.places, from);
            own.places[k] = to;
            own.wedges[k] = wedge;
            self.topology.around[to as usize].push(face);
        }
        self.topology.around[from as usize].clear();
        self.at[to as usize] = target;
        let quadric = self.quadrics[from as usize];
        self.quadrics[to as usize].add(&quadric);
        self.changes[from as usize] += 1;
        self.changes[to as usize] += 1;
        for other in self.neighbours(to) {
            self.offer(other, to);
            self.offer(to, other);
        }
    }

    /// The wedge of each other face at `to`: that of a shared face that has its wedge at `from`. None if one has no such face.
    fn wedges_after(
        &self,
        [from, to]: [u32; 2],
        shared: &[u32],
        others: &[u32],
    ) -> Option<Vec<u32>> {
        let at = |face: u32, place: u32| {
            let face = &self.topology.faces[face as usize];
            face.wedges[corner(&face.places, place)]
        };
        let after = |&face: &u32| {
            let own = at(face, from);
            let like = shared.iter().find(|&&shared| at(shared, from) == own);
            like.map(|&shared| at(shared, to))
        };
        others.iter().map(after).collect()
    }

    /// Returns true if the outer surface without a place is where it was, and looks as it did. `wedges`: those of its faces after the move.
    fn is_seen_as_before(&self, [from, to]: [u32; 2], others: &[u32], wedges: &[u32]) -> bool {
        let p = self.at[from as usize];
        let vertex = |wedge: u32| self.topology.wedges[wedge as usize].vertex;
        let holds = |face: u32, after: u32, own: u32| {
            let face = &self.topology.faces[face as usize];
            let k = corner(&face.places, from);
            if face.wedges[k] != own {
                return false;
            }
            let (mut corners, mut of) = (face.places.map(|v| self.at[v as usize]), face.wedges);
            corners[k] = self.at[to as usize];
            of[k] = after;
            let Some(weights) = weights(corners, p, self.exact) else {
                return false;
            };
            is_between(
                self.mesh,
                vertex(own),
                of.map(vertex),
                weights.map(|w| w as f32),
            )
        };
        let own = others.iter().map(|&face| {
            let face = &self.topology.faces[face as usize];
            face.wedges[corner(&face.places, from)]
        });
        let mut own: Vec<u32> = own.collect();
        own.sort_unstable();
        own.dedup();
        own.iter().all(|&own| {
            let mut faces = others.iter().zip(wedges);
            faces.any(|(&face, &after)| holds(face, after, own))
        })
    }

    fn common_neighbours(&self, from: u32, to: u32) -> usize {
        let others = self.neighbours(to);
        let own = self.neighbours(from);
        own.iter()
            .filter(|place| others.binary_search(place).is_ok())
            .count()
    }

    /// Returns true if a face neither turns over nor gets too thin with these corners.
    fn may_change(&self, face: u32, after: [DVec3; 3]) -> bool {
        let face = &self.topology.faces[face as usize];
        let before = face.places.map(|place| self.at[place as usize]);
        let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let longest = |[a, b, c]: [DVec3; 3]| {
            let sides = [b - a, c - b, a - c];
            sides
                .iter()
                .map(|side| side.length_squared())
                .fold(0.0, f64::max)
        };
        let (old, new) = (across(before), across(after));
        let shape = new.length() / longest(after);
        let old_shape = old.length() / longest(before);
        if shape.is_nan() || shape < THIN.min(old_shape) {
            return false;
        }
        let turn = if face.wedges[0] >= MADE {
            TURN
        } else {
            OUTER_TURN
        };
        // A face without area has no normal that it could keep.
        old_shape < 1e-4 || old.dot(new) >= turn * old.length() * new.length()
    }
}

/// Weights of the corners of a triangle at a point in it, whose squared distance from it is at most `most`.
fn weights([a, b, c]: [DVec3; 3], p: DVec3, most: f64) -> Option<[f64; 3]> {
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    let of = |x: DVec3, y: DVec3| (x - p).cross(y - p).dot(normal) / square;
    let weights = [of(b, c), of(c, a), of(a, b)];
    let height = (p - a).dot(normal).powi(2) / square;
    // Rounding leaves points of a side a little outside.
    let is_in = weights.iter().all(|&w| w >= -1e-3);
    (is_in && height <= most).then_some(weights)
}

fn corner(places: &[u32; 3], place: u32) -> usize {
    // Faces around a place have it, so the fallback never shows.
    places.iter().position(|&p| p == place).unwrap_or(0)
}
