//! Collapses of edges.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use frangible::glam::DVec3;
use frangible::internals::RenderMesh;
use frangible::internals::mesh::closest_on_triangle;

use super::topology::{INNER, Topology, is_between};

/// Least cosine between the normals of a face before and after.
const TURN: f64 = 0.3;

/// Least cosine between the normals of an outer face before and after: these faces lie on the surface that the author drew.
const OUTER_TURN: f64 = 0.98;

/// Distances that count as none, of the largest.
const EXACT: f64 = 1e-3;

/// Twice the area of the thinnest face that a collapse may make, in squares of its longest side.
const THIN: f64 = 0.02;

/// Sum of the squared distances from planes, weighted by area.
#[derive(Clone, Copy, Default)]
struct Quadric {
    /// Upper half of the symmetric matrix.
    squares: [f64; 6],
    linear: DVec3,
    constant: f64,
    weight: f64,
}

impl Quadric {
    fn of_plane(point: DVec3, normal: DVec3, weight: f64) -> Self {
        let (n, d) = (normal, -normal.dot(point));
        Self {
            squares: [
                n.x * n.x,
                n.x * n.y,
                n.x * n.z,
                n.y * n.y,
                n.y * n.z,
                n.z * n.z,
            ]
            .map(|x| x * weight),
            linear: weight * d * n,
            constant: weight * d * d,
            weight,
        }
    }

    fn add(&mut self, other: &Self) {
        for (own, more) in self.squares.iter_mut().zip(other.squares) {
            *own += more;
        }
        self.linear += other.linear;
        self.constant += other.constant;
        self.weight += other.weight;
    }

    /// Mean of the squared distances.
    fn at(&self, p: DVec3) -> f64 {
        let [xx, xy, xz, yy, yz, zz] = self.squares;
        let square = xx * p.x * p.x
            + yy * p.y * p.y
            + zz * p.z * p.z
            + 2.0 * (xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z);
        let sum = square + 2.0 * self.linear.dot(p) + self.constant;
        if self.weight > 0.0 {
            (sum / self.weight).max(0.0)
        } else {
            0.0
        }
    }
}

/// A place that may move to another: bits of the squared distance, which are in its order, the two places, and how often they had changed.
type Candidate = Reverse<(u64, [u32; 2], [u32; 2])>;

struct Work<'a> {
    mesh: &'a RenderMesh,
    topology: &'a mut Topology,
    at: Vec<DVec3>,
    quadrics: Vec<Quadric>,
    /// Number of changes of each vertex so far.
    changes: Vec<u32>,
    heap: BinaryHeap<Candidate>,
    /// Places of the full mesh that have moved to each place.
    absorbed: Vec<Vec<DVec3>>,
    /// Largest distance that such a place may have, squared, and the same where the outer surface must not change.
    most: [f64; 2],
}

/// Moves places onto neighbours, as long as the faces around them stay within `most`, m, of where they were.
pub(super) fn collapse(mesh: &RenderMesh, topology: &mut Topology, most: f64) {
    let at: Vec<DVec3> = topology.places.iter().map(|p| p.as_dvec3()).collect();
    let mut quadrics = vec![Quadric::default(); at.len()];
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
        absorbed: vec![Vec::new(); at.len()],
        most: [most, EXACT * most].map(|most| most * most),
        mesh,
        topology,
        at,
        quadrics,
    };
    for from in 0..work.at.len() as u32 {
        for to in work.neighbours(from) {
            work.offer(from, to);
        }
    }
    while let Some(Reverse((_, [from, to], changes))) = work.heap.pop() {
        let now = [from, to].map(|place| work.changes[place as usize]);
        if now == changes {
            work.try_to_move(from, to);
        }
    }
}

impl Work<'_> {
    /// Places that share a face with one, sorted.
    fn neighbours(&self, place: u32) -> Vec<u32> {
        let around = self.topology.around[place as usize].iter();
        let places = around.flat_map(|&face| self.topology.faces[face as usize].places);
        let mut neighbours: Vec<u32> = places.filter(|&other| other != place).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    fn offer(&mut self, from: u32, to: u32) {
        if self.topology.stays[from as usize] {
            return;
        }
        let mut sum = self.quadrics[from as usize];
        sum.add(&self.quadrics[to as usize]);
        let target = self.at[to as usize];
        // Far from a place its own planes weigh more than the mean.
        let cost = sum.at(target).max(self.quadrics[from as usize].at(target));
        if !self.topology.is_outer(from) || cost <= self.most[1] {
            let changes = [from, to].map(|place| self.changes[place as usize]);
            self.heap
                .push(Reverse((cost.to_bits(), [from, to], changes)));
        }
    }

    fn try_to_move(&mut self, from: u32, to: u32) {
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
            return;
        };
        let is_sound = shared.len() == 2 && self.common_neighbours(from, to) == 2;
        let is_kept = || {
            !self.topology.is_outer(from) || self.is_seen_as_before([from, to], &others, &wedges)
        };
        let is_near = || self.is_near([from, to], &others);
        if !is_sound
            || !is_kept()
            || !is_near()
            || !others.iter().all(|&face| self.may_change(face, from, to))
        {
            return;
        }
        for &face in &shared {
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
        let mut absorbed = std::mem::take(&mut self.absorbed[from as usize]);
        absorbed.push(self.at[from as usize]);
        self.absorbed[to as usize].append(&mut absorbed);
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

    /// Returns true if the faces around a place, and what has moved to it, are near those that are left, and these near the former.
    /// `others`: those that change.
    fn is_near(&self, [from, to]: [u32; 2], others: &[u32]) -> bool {
        let corners = |face: u32, moved: bool| {
            let places = self.topology.faces[face as usize].places;
            let place = |place| if moved && place == from { to } else { place };
            places.map(|p| self.at[place(p) as usize])
        };
        let around = &self.topology.around;
        let beside = around[to as usize]
            .iter()
            .filter(|&&face| !self.topology.faces[face as usize].places.contains(&from));
        let beside: Vec<[DVec3; 3]> = beside.map(|&face| corners(face, false)).collect();
        let before: Vec<_> = (around[from as usize].iter())
            .map(|&face| corners(face, false))
            .collect();
        let after: Vec<_> = others.iter().map(|&face| corners(face, true)).collect();
        let is_near = |point: DVec3, faces: &[[DVec3; 3]]| {
            faces.iter().chain(&beside).any(|&[a, b, c]| {
                let [u, v, w] = closest_on_triangle([a, b, c], point);
                (a * u + b * v + c * w).distance_squared(point) <= self.most[0]
            })
        };
        let middle = |[a, b, c]: [DVec3; 3]| (a + b + c) / 3.0;
        let absorbed = &self.absorbed[from as usize];
        is_near(self.at[from as usize], &after)
            && absorbed.iter().all(|&point| is_near(point, &after))
            && before.iter().all(|&face| is_near(middle(face), &after))
            && after.iter().all(|&face| is_near(middle(face), &before))
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
            let Some(weights) = weights(corners, p, self.most[1]) else {
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

    /// Returns true if a face neither turns over nor gets too thin.
    fn may_change(&self, face: u32, from: u32, to: u32) -> bool {
        let face = &self.topology.faces[face as usize];
        let before = face.places.map(|place| self.at[place as usize]);
        let mut after = before;
        after[corner(&face.places, from)] = self.at[to as usize];
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
        // A face without area has no normal that it could keep.
        let turn = if face.wedges[0] == INNER {
            TURN
        } else {
            OUTER_TURN
        };
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
