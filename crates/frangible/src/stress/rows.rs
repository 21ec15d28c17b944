//! Stress at weak points straight from the modal amplitudes, σ = S q (beyond the paper): where strain is linear, displacement, gradient,
//! law and wall are one matrix, found once for a body. It has three rows for a point of a free surface, and is read from end to end.

use glam::{Mat3, Vec3};

use super::batch::Lanes;
use super::frame::{Frame, MOST};
use super::shape::Shape;
use super::strain::{Elasticity, Law};
use super::tensor::Symmetric3;
use super::wall::Wall;
use super::wide::{Wide, narrow, wide};
use crate::asset::{Asset, EmbeddedPoint};

/// No fracture tetrahedron.
pub(crate) const NO_TET: u32 = u32::MAX;

/// Rows that are summed side by side: each is a chain of sums that waits for itself.
const GROUP: usize = 6;

/// A weak point as its rows see it.
#[derive(Clone, Debug)]
pub(crate) struct RowPoint {
    pub(crate) point: EmbeddedPoint,
    pub(crate) law: Law,
    pub(crate) frame: Frame,
    /// Its position, m.
    pub(crate) place: Vec3,
    /// The wall that it is in.
    pub(crate) wall: Option<Wall>,
    /// Further sample points of its flaw, over which the rows are averaged.
    pub(crate) samples: Vec<Sample>,
}

/// A further sample point of a flaw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Fracture tetrahedron at whose centroid it lies; [`NO_TET`] if it lies elsewhere.
    pub(crate) tet: u32,
    pub(crate) point: EmbeddedPoint,
    pub(crate) law: Law,
    /// Its position, m.
    pub(crate) place: Vec3,
    /// The wall that it is in.
    pub(crate) wall: Option<Wall>,
}

impl RowPoint {
    /// Returns the sample points of its flaw with their constitutive laws; true for the weak point itself.
    pub(crate) fn places(&self) -> impl Iterator<Item = (&EmbeddedPoint, Law, bool)> {
        let samples = self.samples.iter().map(|s| (&s.point, s.law, false));
        std::iter::once((&self.point, self.law, true)).chain(samples)
    }

    /// The places in walls where nothing keeps the near field of a contact out, each with its wall.
    pub(crate) fn walls(&self) -> impl Iterator<Item = (Vec3, &Wall)> {
        let own = std::iter::once((self.law, self.place, &self.wall));
        let samples = self.samples.iter().map(|s| (s.law, s.place, &s.wall));
        own.chain(samples)
            .filter_map(|(law, place, wall)| match law {
                Law::Free(_) => Some((place, wall.as_ref()?)),
                Law::Solid | Law::Edge(_) => None,
            })
    }

    /// Weight of each of these places in the mean.
    pub(crate) fn share(&self) -> f32 {
        1.0 / (1 + self.samples.len()) as f32
    }

    /// The nodes that its stress depends on, but for the first one of its own element: the gradients of the shape functions add up to nothing.
    #[inline(always)]
    fn nodes(&self, asset: &Asset, elasticity: &Elasticity, nodes: &mut Nodes) {
        nodes.shares.clear();
        let first = asset.analysis.elements[self.point.element as usize][0] as usize;
        nodes.first = first;
        let share = self.share();
        for (point, law, own) in self.places() {
            let element = point.element as usize;
            let gradients = &asset.analysis.barycentric_gradients[element];
            let weights = point.shape_gradients(gradients);
            let all = asset.analysis.elements[element].iter().zip(weights);
            for (&node, g) in all.filter(|(node, _)| **node as usize != first) {
                let rows = match own {
                    true => elasticity.per_displacement(law, self.frame, g),
                    false => elasticity.per_displacement_in(law, self.frame, g),
                };
                nodes.add(node as usize, own, rows.map(|row| row * share));
            }
        }
    }
}

/// A point's rows per displacement of nodes, Pa/m.
#[derive(Clone, Debug, Default)]
struct Nodes {
    /// The node whose displacement is subtracted from those of the others.
    first: usize,
    shares: Vec<(usize, [[f32; 3]; MOST])>,
}

impl Nodes {
    /// Adds shares of a node; those of an element that comes `first` are new.
    #[inline(always)]
    fn add(&mut self, node: usize, first: bool, rows: [Vec3; MOST]) {
        let known = match first {
            true => None,
            false => self.shares.iter_mut().find(|known| known.0 == node),
        };
        match known {
            Some((_, shares)) => {
                for (share, row) in shares.iter_mut().zip(rows) {
                    *share = (Vec3::from_array(*share) + row).to_array();
                }
            }
            None => self.shares.push((node, rows.map(|row| row.to_array()))),
        }
    }
}

/// Rows of the points of a cluster, one after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    /// Pa per m·√kg: `[group of rows][mode, from the highest][row]`.
    numbers: Vec<[f32; GROUP]>,
    modes: usize,
}

impl Rows {
    /// The rows of the first `modes` modes at some points.
    pub(crate) fn new(
        asset: &Asset,
        elasticity: &Elasticity,
        modes: usize,
        points: &[RowPoint],
    ) -> Self {
        let count: usize = points.iter().map(|p| p.frame.count()).sum();
        let mut rows = Self {
            numbers: vec![[0.0; GROUP]; count.div_ceil(GROUP) * modes],
            modes,
        };
        fill(&mut rows, asset, elasticity, points);
        rows
    }

    /// Rows of so many modes each, from the lowest.
    pub(super) fn of(modes: usize, rows: impl ExactSizeIterator<Item = Vec<f32>>) -> Self {
        let mut numbers = vec![[0.0; GROUP]; rows.len().div_ceil(GROUP) * modes];
        for (i, row) in rows.enumerate() {
            let group = &mut numbers[i / GROUP * modes..][..modes];
            for (to, from) in group.iter_mut().zip(row.into_iter().rev()) {
                to[i % GROUP] = from;
            }
        }
        Self { numbers, modes }
    }

    /// Modes of each row.
    pub(crate) fn modes(&self) -> usize {
        self.modes
    }

    /// One row, from the lowest mode on.
    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = f32> {
        let group = &self.numbers[row / GROUP * self.modes..][..self.modes];
        group.iter().rev().map(move |numbers| numbers[row % GROUP])
    }

    /// [`Self::add`] of the rows of one point, which are as many as there are sums.
    #[inline(always)]
    pub(crate) fn add_to(&self, first: usize, amplitudes: &[Lanes], sums: &mut [Lanes]) {
        let skipped = self.modes - amplitudes.len();
        let row = |row: usize| {
            let group = &self.numbers[row / GROUP * self.modes..][..self.modes];
            let numbers = group[skipped..].iter();
            numbers.map(move |numbers| numbers[row % GROUP])
        };
        let amplitudes = || amplitudes.iter().rev();
        // Three of them side by side: each is a chain of sums that waits for itself.
        let (threes, rest) = sums.as_chunks_mut::<3>();
        let mut at = first;
        for sums in threes {
            let (mut a, mut b, mut c) = (Wide(sums[0]), Wide(sums[1]), Wide(sums[2]));
            let rows = row(at).zip(row(at + 1)).zip(row(at + 2));
            for (((x, y), z), q) in rows.zip(amplitudes()) {
                (a, b, c) = (a.plus(x, q), b.plus(y, q), c.plus(z, q));
            }
            *sums = [a.0, b.0, c.0];
            at += 3;
        }
        for sum in rest {
            let mut own = Wide(*sum);
            for (x, q) in row(at).zip(amplitudes()) {
                own = own.plus(x, q);
            }
            *sum = own.0;
            at += 1;
        }
    }

    /// Count of the numbers that [`Self::add`] adds to: the rows, and some that are empty.
    pub(crate) fn padded(&self) -> usize {
        match self.modes {
            0 => 0,
            modes => self.numbers.len() / modes * GROUP,
        }
    }

    /// Adds the rows times the amplitudes of the first modes, m·√kg, highest first: high modes move little, so that a sum is large, and
    /// rounds, only at the end.
    #[inline(always)]
    pub(crate) fn add(&self, amplitudes: &[Lanes], sums: &mut [Lanes]) {
        let skipped = self.modes - amplitudes.len();
        let groups = self.numbers.chunks_exact(self.modes.max(1));
        for (group, sums) in groups.zip(sums.as_chunks_mut::<GROUP>().0) {
            let [mut a, mut b, mut c, mut d, mut e, mut f] = wide(sums);
            for (row, q) in group[skipped..].iter().zip(amplitudes.iter().rev()) {
                a = a.plus(row[0], q);
                b = b.plus(row[1], q);
                c = c.plus(row[2], q);
                d = d.plus(row[3], q);
                e = e.plus(row[4], q);
                f = f.plus(row[5], q);
            }
            *sums = narrow([a, b, c, d, e, f]);
        }
    }
}

/// Stress of a shape at samples that several flaws share.
#[derive(Clone, Debug, Default)]
pub(crate) struct SampleStress {
    /// Place of each fracture tetrahedron in the list; `u32::MAX` if its stress is not known yet.
    places: Vec<u32>,
    /// Pa/N.
    known: Vec<Symmetric3>,
}

impl SampleStress {
    /// Returns the stress at the centroid of a fracture tetrahedron, and computes it if it is not known yet.
    #[inline(always)]
    fn of(&mut self, asset: &Asset, tet: u32, compute: impl FnOnce() -> Symmetric3) -> Symmetric3 {
        if self.places.is_empty() {
            self.places.resize(asset.fracture.tets.len(), u32::MAX);
        }
        let place = &mut self.places[tet as usize];
        if *place == u32::MAX {
            *place = self.known.len() as u32;
            self.known.push(compute());
        }
        self.known[*place as usize]
    }
}

/// Stress of a shape of the body per newton at some points, Pa/N: row after row.
pub(crate) fn of_shape(
    asset: &Asset,
    elasticity: &Elasticity,
    shape: &Shape,
    points: &[RowPoint],
    samples: &mut SampleStress,
) -> Vec<f32> {
    let mut rows = Vec::new();
    for row_point in points {
        let (frame, share) = (row_point.frame, row_point.share());
        let stress = stress_of(asset, elasticity, shape, (&row_point.point, row_point.law));
        let mut sums = frame.numbers(&stress).map(|number| number * share);
        for sample in &row_point.samples {
            let compute = || stress_of(asset, elasticity, shape, (&sample.point, sample.law));
            let stress = match sample.tet {
                NO_TET => compute(),
                tet => samples.of(asset, tet, compute),
            };
            for (sum, number) in sums.iter_mut().zip(frame.numbers(&stress)) {
                *sum += number * share;
            }
        }
        rows.extend(&sums[..frame.count()]);
    }
    rows
}

/// Stress of a shape of the body per newton at a point with this law, Pa/N.
#[inline(always)]
fn stress_of(
    asset: &Asset,
    elasticity: &Elasticity,
    shape: &Shape,
    (point, law): (&EmbeddedPoint, Law),
) -> Symmetric3 {
    let element = point.element as usize;
    let weights = point.shape_gradients(&asset.analysis.barycentric_gradients[element]);
    let [first, others @ ..] = &asset.analysis.elements[element];
    // The gradients of the shape functions add up to nothing.
    let shared = Vec3::from_array(shape.at(asset, *first as usize));
    let mut gradient = Mat3::ZERO;
    for (&node, g) in others.iter().zip(&weights[1..]) {
        let u = Vec3::from_array(shape.at(asset, node as usize)) - shared;
        gradient.x_axis += u * g.x;
        gradient.y_axis += u * g.y;
        gradient.z_axis += u * g.z;
    }
    let strain = Symmetric3::from_mat3(gradient);
    Symmetric3::from_components(elasticity.linear(&strain.components(), law))
}

widest! {
    /// Fills rows.
    fn fill(rows: &mut Rows, asset: &Asset, elasticity: &Elasticity, points: &[RowPoint]) {
        let modes = rows.modes;
        let shapes = &asset.modes;
        let mut sums: [Vec<f32>; MOST] = std::array::from_fn(|_| vec![0.0; modes]);
        let (mut row, mut nodes) = (0, Nodes::default());
        for point in points {
            let count = point.frame.count();
            sums[..count].iter_mut().for_each(|sum| sum.fill(0.0));
            point.nodes(asset, elasticity, &mut nodes);
            let first = nodes.first;
            for &(node, shares) in &nodes.shares {
                for axis in 0..3 {
                    let here = &shapes.row(3 * node + axis)[..modes];
                    let shared = &shapes.row(3 * first + axis)[..modes];
                    for (sum, share) in sums[..count].iter_mut().zip(&shares) {
                        let (sum, share) = (&mut sum[..modes], share[axis]);
                        for i in 0..modes {
                            sum[i] += share * (here[i] - shared[i]);
                        }
                    }
                }
            }
            for sum in &sums[..count] {
                let group = &mut rows.numbers[row / GROUP * modes..][..modes];
                for (to, &from) in group.iter_mut().zip(sum.iter().rev()) {
                    to[row % GROUP] = from;
                }
                row += 1;
            }
        }
    }
}
