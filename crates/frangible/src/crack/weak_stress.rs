//! Stress at the weak points of a cluster at the steps of a batch: rows times amplitudes, and the parts of a motion beside its modes.

use std::sync::Arc;

use super::field::StressField;
use crate::body::Body;
use crate::near_field::Located;
use crate::stress::{
    BATCH, ClusterRows, Frame, Lanes, MOST, STRIDE, SampleStress, Shape, Wide, of_shape,
};

/// Contributions of one motion to the rows of the body, and room for their stress.
#[derive(Clone, Debug, Default)]
pub(crate) struct WeakStress {
    /// Contributions to each cluster that was looked at.
    pub(super) added: Vec<Option<Added>>,
    /// Largest amplitude of each mode in the batch, m·√kg.
    pub(super) farthest: Vec<f32>,
    /// Workspace of each part of the body that is looked at.
    pub(super) rooms: Vec<Room>,
}

/// Stress of one cluster after the other, and workspace for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Room {
    /// Stress of each shape that follows a force, where flaws share samples.
    samples: Vec<SampleStress>,
    /// Row after row.
    numbers: Vec<Lanes>,
    /// Workspace for shapes.
    shapes: Vec<Lanes>,
    /// Part of the stress that the numbers leave out.
    left_out: LeftOut,
    /// Largest tension that the modes add at each point of the cluster, Pa.
    most: Vec<f32>,
}

/// Part of the stress that the numbers of a cluster leave out.
#[derive(Clone, Copy, Debug, Default)]
enum LeftOut {
    /// Nothing.
    #[default]
    Nothing,
    /// All beyond a few shapes: bounds of its tension, Pa, without the near fields, and with the most that these add to any point.
    OfShapes([Lanes; 2]),
    /// All modes and the near fields.
    Modes,
}

/// If more than one of so many points of a cluster is in doubt, all of them are computed.
const MANY: usize = 4;

/// For so many batches, the present one included, all points of such a cluster are computed.
const WAIT: u8 = 4;

/// Contributions of a motion in a cluster.
#[derive(Clone, Debug)]
pub(super) struct Added {
    /// The stress in each row of every shape that follows a force, Pa/N.
    residuals: Vec<Vec<f32>>,
    near: Vec<NearPoint>,
    /// The point nearest to the contact of each near field, where the field is strongest.
    nearest: Vec<NearPoint>,
    /// Points, by their places in the cluster, that something presses on: rows do not hold for them.
    pressed: Vec<u32>,
    /// Batches until it is bounded again.
    wait: u8,
}

/// A point in a near field.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearPoint {
    /// Its first row, and the number of its rows.
    row: usize,
    count: usize,
    /// Number of the field.
    field: usize,
    at: Located,
    /// Shares of the field's two tensions in each row.
    shares: [[f32; MOST]; 2],
    /// Weight of the place in the point's mean; 1 in [`Added::nearest`].
    share: f32,
}

impl WeakStress {
    /// Notes the largest amplitude of each mode in the batch of a field, and makes room for so many parts.
    #[inline(always)]
    pub(super) fn begin(&mut self, body: &Body, field: &StressField, parts: usize) {
        self.farthest.clear();
        for q in field.displacement.amplitudes() {
            let mut sizes = *q;
            sizes.iter_mut().for_each(|q| *q = q.abs());
            self.farthest.push(Wide(sizes).largest());
        }
        self.added.resize(body.clusters.clusters.len(), None);
        if self.rooms.len() < parts {
            self.rooms.resize(parts, Room::default());
        }
    }
}

impl Room {
    /// Computes the stress at all points of the cluster at place `cluster` of the body's list, or its bounds. `limit`: tension at the
    /// point of a weak tetrahedron below which it does not matter, Pa; `farthest`: largest amplitude of each mode in the batch, m·√kg.
    #[inline(always)]
    pub(super) fn look(
        &mut self,
        (body, field): (&Body, &StressField),
        (cluster, rows): (usize, &ClusterRows),
        farthest: &[f32],
        added: &mut Option<Added>,
        limit: impl Fn(u32) -> f32,
    ) {
        let samples = &mut self.samples;
        let added = added.get_or_insert_with(|| Added::new(body, field, cluster, rows, samples));
        let numbers = &mut self.numbers;
        numbers.clear();
        numbers.resize(rows.rows.padded(), Lanes::default());
        for (shares, (_, force)) in added.residuals.iter().zip(field.displacement.residuals()) {
            for (number, share) in numbers.iter_mut().zip(shares) {
                add(number, *share, force);
            }
        }
        let amplitudes = field.displacement.amplitudes();
        added.wait = added.wait.saturating_sub(1);
        self.left_out = LeftOut::Nothing;
        if field.config.culling && added.wait == 0 {
            if let Some(coarse) = rows.coarse(body) {
                let shapes = coarse.add(amplitudes, &mut self.shapes, numbers);
                let everything = with_near(shapes, &added.nearest, field);
                self.left_out = LeftOut::OfShapes([shapes, everything]);
                return;
            }
            rows.sizes().bounds(farthest, &mut self.most);
            let tets = body.clusters.tets(cluster);
            let mut doubts = 0;
            for (&tet, &most) in tets.iter().zip(&self.most) {
                doubts += usize::from(most > limit(tet));
            }
            if MANY * doubts <= tets.len() {
                self.left_out = LeftOut::Modes;
                return;
            }
            added.wait = WAIT;
        }
        rows.rows.add(amplitudes, numbers);
        for near in &added.near {
            near.add(field, &mut numbers[near.row..]);
        }
    }

    /// Points of the cluster that was looked at, one after the other.
    pub(super) fn points<'a>(&'a self, added: Option<&'a Added>) -> Points<'a> {
        Points {
            stress: self,
            added,
            point: 0,
            row: 0,
            near: 0,
        }
    }
}

/// Adds so much of a force, or a tension, at each step.
#[inline(always)]
fn add(sum: &mut Lanes, share: f32, of: &Lanes) {
    for (sum, of) in sum.iter_mut().zip(of) {
        *sum += share * of;
    }
}

/// A bound of a tension, and what near fields add to it at most.
#[inline(always)]
fn with_near(mut most: Lanes, near: &[NearPoint], field: &StressField) -> Lanes {
    for near in near {
        near.add_most(field, &mut most);
    }
    most
}

/// The points of a cluster.
pub(super) struct Points<'a> {
    stress: &'a Room,
    added: Option<&'a Added>,
    point: usize,
    row: usize,
    near: usize,
}

/// Largest tension that the numbers of a point leave out, Pa.
pub(super) enum Rest {
    Nothing,
    /// No more than this at any point of the cluster.
    OfAny(Lanes),
    /// No more than this at this point, which is a good deal: all that its modes bring.
    Own(Lanes),
}

/// Numbers of a point, and what they leave out.
pub(super) struct Seen<'a> {
    /// Its numbers, but for what is left out.
    pub(super) numbers: &'a [Lanes],
    /// Part that the numbers leave out.
    pub(super) left_out: Rest,
    row: usize,
    near: &'a [NearPoint],
}

impl<'a> Points<'a> {
    /// Points, by their places in the cluster, that rows do not hold for.
    pub(super) fn pressed(&self) -> &'a [u32] {
        self.added.map_or(&[], |added| &added.pressed)
    }

    /// The next one.
    #[inline(always)]
    pub(super) fn next(&mut self, field: &StressField, frame: Frame) -> Seen<'a> {
        let (point, row) = (self.point, self.row);
        self.point += 1;
        self.row += frame.count();
        let near = self.added.map_or(&[][..], |added| &added.near[self.near..]);
        let count = near.iter().take_while(|near| near.row == row).count();
        self.near += count;
        let near = &near[..count];
        let left_out = match self.stress.left_out {
            LeftOut::Nothing => Rest::Nothing,
            LeftOut::OfShapes([_, everything]) => Rest::OfAny(everything),
            LeftOut::Modes => Rest::Own(with_near([self.stress.most[point]; BATCH], near, field)),
        };
        Seen {
            numbers: &self.stress.numbers[row..self.row],
            left_out,
            row,
            near,
        }
    }

    /// Largest tension that is left out at a point that was bounded, Pa; none where it is that of all points of its cluster.
    #[inline(always)]
    pub(super) fn left_out_of(&self, field: &StressField, seen: &Seen) -> Option<Lanes> {
        let LeftOut::OfShapes([shapes, _]) = self.stress.left_out else {
            return None;
        };
        let bounded = self.added.is_some_and(|added| !added.nearest.is_empty());
        bounded.then(|| with_near(shapes, seen.near, field))
    }

    /// The numbers of a point, the same bits as where they were not bounded.
    #[inline(always)]
    pub(super) fn exact(
        &self,
        field: &StressField,
        rows: &ClusterRows,
        seen: &Seen,
    ) -> [Lanes; MOST] {
        let mut numbers = [Lanes::default(); MOST];
        let amplitudes = field.displacement.amplitudes();
        let shapes = self.added.map_or(&[][..], |added| &added.residuals);
        let count = seen.numbers.len();
        for (shares, (_, force)) in shapes.iter().zip(field.displacement.residuals()) {
            for (number, share) in numbers.iter_mut().zip(&shares[seen.row..][..count]) {
                add(number, *share, force);
            }
        }
        rows.rows
            .add_to(seen.row, amplitudes, &mut numbers[..count]);
        for near in seen.near {
            near.add(field, &mut numbers);
        }
        numbers
    }
}

impl NearPoint {
    /// Adds the most that the field adds to a tension there.
    #[inline(always)]
    fn add_most(&self, field: &StressField, to: &mut Lanes) {
        let most = field.near.0[self.field].most_lanes(&self.at, field.step / STRIDE);
        add(to, self.share, &most);
    }

    /// Adds the field to the point's numbers.
    #[inline(always)]
    fn add(&self, field: &StressField, numbers: &mut [Lanes]) {
        let stress = field.near.0[self.field].lanes(&self.at, field.step / STRIDE);
        for (tension, shares) in stress.iter().zip(&self.shares) {
            for (number, share) in numbers[..self.count].iter_mut().zip(shares) {
                add(number, *share, tension);
            }
        }
    }
}

impl Added {
    /// Waits a while before the cluster is bounded again, if too many of its points were in doubt.
    pub(super) fn doubted(&mut self, doubts: usize, points: usize) {
        if MANY * doubts > points {
            self.wait = WAIT;
        }
    }

    #[inline(never)]
    fn new(
        body: &Body,
        field: &StressField,
        cluster: usize,
        rows: &ClusterRows,
        samples: &mut Vec<SampleStress>,
    ) -> Self {
        let shapes = field.displacement.residuals();
        samples.resize_with(shapes.len(), SampleStress::default);
        let of = |((shape, _), samples): (&(Arc<Shape>, _), _)| {
            of_shape(field.asset, &field.elasticity, shape, &rows.points, samples)
        };
        let residuals = shapes.iter().zip(samples).map(of).collect();
        let (mut near, mut pressed, mut row) = (Vec::new(), Vec::new(), 0);
        let points = body.clusters.tets(cluster).iter().zip(&rows.points);
        for (i, (&tet, point)) in (0..).zip(points) {
            let frame = point.frame;
            if field.is_pressed(tet as usize) {
                pressed.push(i);
            } else {
                let share = point.share();
                for (place, wall) in point.walls() {
                    let places = field.near.places(place, wall);
                    near.extend(places.map(|(field, at)| {
                        NearPoint {
                            row,
                            count: frame.count(),
                            field,
                            shares: (at.directions())
                                .map(|along| frame.of_uniaxial(along).map(|x| share * x)),
                            share,
                            at,
                        }
                    }));
                }
            }
            row += frame.count();
        }
        let whole = |point: &NearPoint| NearPoint {
            share: 1.0,
            ..*point
        };
        let mut nearest: Vec<NearPoint> = Vec::new();
        for point in &near {
            match nearest.iter_mut().find(|known| known.field == point.field) {
                Some(known) if point.at.is_nearer(&known.at) => *known = whole(point),
                Some(_) => {}
                None => nearest.push(whole(point)),
            }
        }
        Self {
            residuals,
            near,
            nearest,
            pressed,
            wait: 0,
        }
    }
}
