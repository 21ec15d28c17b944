//! The near field of one contact over time: tables over distance and time step, and the stress that they give at a point of the wall.

use glam::Vec3;

use super::bands::{Bands, Spacing};
use super::wall::WallMaterial;
use crate::stress::{BATCH, Lanes, STRIDE, StressLanes, Symmetric3, Wall, length};

/// Step between the first distances of the table, in thicknesses of the wall.
const FIRST_STEP: f64 = 0.08;

/// Every step is larger than the one before by this factor.
const GROWTH: f64 = 1.04;

/// A place belongs to the contact's wall where the cosine between the two normals is at least this.
const SAME_WALL: f32 = 0.3;

/// A place belongs to the contact's wall where its distance along the wall is at least this share of the straight one, less
/// [`DEEPEST`] thicknesses.
const LEAST_SHARE: f32 = 0.7;

/// Thicknesses of the wall that a place may lie deeper than the contact.
const DEEPEST: f32 = 1.5;

/// Distance from the contact at which the field ends, in wavelengths of the longest wave that it has.
const WAVELENGTHS: f64 = 2.5;

/// Place of the contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearPlace {
    /// Point on the surface, m, body frame of the mesh.
    pub(crate) point: Vec3,
    /// Unit normal of the wall there, from the loaded face inwards.
    pub(crate) inwards: Vec3,
    /// The field is zero from the table's first distance on that is no less than this, m: a crack, an edge, or nothing that matters.
    pub(crate) reach: f64,
    /// True if it stays in the ply of a laminated wall that is touched.
    pub(crate) in_ply: bool,
}

/// Shapes of the waves about one contact: their stress per newton over distance.
#[derive(Debug)]
pub(crate) struct NearShapes {
    /// Thickness of the wall, m.
    thickness: f64,
    /// Distances, m, rising from 0.
    radii: Vec<f64>,
    /// σ_r + σ_θ and σ_θ − σ_r of the far face of everything that follows the force, Pa/N, at each distance.
    still: Vec<[f64; 2]>,
    /// σ_r + σ_θ and σ_θ − σ_r of the far face of each oscillator, Pa per newton of ω² q, at each distance.
    swinging: Vec<Vec<[f64; 2]>>,
}

impl NearShapes {
    /// The shapes of these bands of a wall, as far as `reach`, m.
    pub(crate) fn new(wall: &WallMaterial, bands: &Bands, reach: f64) -> Self {
        let radii = radii(wall.thickness, reach);
        Self {
            thickness: wall.thickness,
            still: bands.following_stress(wall, &radii),
            swinging: bands.swinging_stress(wall, &radii),
            radii,
        }
    }
}

/// The near field of one contact.
#[derive(Clone, Debug)]
pub(crate) struct NearField {
    place: NearPlace,
    thickness: f32,
    /// Distances of the table, m, rising from 0; zero stress from the last on.
    radii: Vec<f32>,
    /// Square of the straight distance beyond which no place of the wall lies in the field, m².
    outermost: f32,
    /// σ_r + σ_θ and σ_θ − σ_r of the far face, Pa: `[part][radius * steps + step]`.
    table: [Vec<f32>; 2],
    /// Upper bound of the principal tension at this distance or farther, Pa: `[radius * steps + step]`.
    most: Vec<f32>,
    /// Time steps; after them there is no field.
    steps: usize,
    /// True for a field that lasts: one step stands for all.
    steady: bool,
}

impl NearField {
    /// Distance to which the field of waves from wave number `first`, 1/m, on is kept, m.
    pub(crate) fn reach(first: f64) -> f64 {
        WAVELENGTHS * std::f64::consts::TAU / first
    }

    /// `swing`: for each time step ω² q of each oscillator of the bands, N; `force`: on the contact, N.
    pub(crate) fn new(place: NearPlace, shapes: &NearShapes, swing: &[f32], force: &[f32]) -> Self {
        let NearShapes {
            thickness,
            radii,
            still,
            swinging,
        } = shapes;
        let thickness = *thickness as f32;
        let steps = force.len();
        let mut table = [0, 1].map(|_| vec![0.0_f32; radii.len() * steps]);
        fill(
            &mut table,
            still,
            swinging,
            &by_oscillator(swing, steps),
            force,
        );
        let last = (radii.len() - 1) * steps;
        table.iter_mut().for_each(|t| t[last..].fill(0.0));
        let end = radii.last().map_or(0.0, |&r| r as f32);
        // Of a place that counts, the distance along the wall is at least the share of the straight one less the depth.
        let straight = (end + DEEPEST * thickness) / LEAST_SHARE;
        let mut field = Self {
            place,
            outermost: straight * straight,
            thickness,
            radii: radii.iter().map(|&r| r as f32).collect(),
            most: Vec::new(),
            table,
            steps,
            steady: false,
        };
        field.most = field.largest_from_outside();
        field
    }

    /// The field of a steady force, N.
    pub(crate) fn steady(place: NearPlace, wall: &WallMaterial, first: f64, force: f32) -> Self {
        let everything_follows = Spacing {
            width: 1.0,
            even_to: 0.0,
            follows_from: 0.0,
        };
        // Nothing rests on a point: a patch as wide as the wall is thick.
        let bands = Bands::new(wall, first, wall.thickness, everything_follows);
        let shapes = NearShapes::new(wall, &bands, place.reach);
        Self {
            steady: true,
            ..Self::new(place, &shapes, &[], &[force])
        }
    }

    /// Step of the table for a time step.
    #[inline(always)]
    fn step(&self, step: usize) -> usize {
        if self.steady { 0 } else { step }
    }

    /// ½ (|σ_r + σ_θ| + |σ_θ − σ_r|) bounds both principal stresses on either face; between two distances the table is
    /// linear, so the larger of its ends bounds it.
    fn largest_from_outside(&self) -> Vec<f32> {
        const ROUNDING: f32 = 1.0 + 1e-5;
        let steps = self.steps;
        let mut most = vec![0.0_f32; self.table[0].len()];
        for i in (0..self.radii.len()).rev() {
            for step in 0..steps {
                let at = i * steps + step;
                let here = 0.5 * ROUNDING * (self.table[0][at].abs() + self.table[1][at].abs());
                let outside = most.get(at + steps).copied().unwrap_or(0.0);
                most[at] = here.max(outside);
            }
        }
        most
    }

    /// Largest principal tension that the field adds, Pa, at a time step: anywhere as far as a distance of the table, or farther.
    #[inline(always)]
    pub(crate) fn most(&self, distance: Option<usize>, step: usize) -> f32 {
        let step = self.step(step);
        match distance {
            Some(i) if step < self.steps => self.most[i * self.steps + step],
            _ => 0.0,
        }
    }

    /// Largest distance of the table that is no farther, or none beyond the last.
    pub(crate) fn below(&self, distance: f32) -> Option<usize> {
        let after = self.radii.partition_point(|&r| r <= distance);
        (after < self.radii.len()).then(|| after.saturating_sub(1))
    }

    /// Least distance along the wall, m, of places of the wall at this straight distance from the contact, m, or farther.
    pub(crate) fn nearest_along(&self, distance: f32) -> f32 {
        (LEAST_SHARE * distance - DEEPEST * self.thickness).max(0.0)
    }

    /// Straight distance of a place from the contact, m.
    pub(crate) fn distance(&self, place: Vec3) -> f32 {
        place.distance(self.place.point)
    }

    /// Place of a point of the wall in the field; none where the field does not reach. `wall`: the body's wall at the point.
    #[inline(always)]
    fn locate(&self, point: Vec3, wall: &Wall) -> Option<Located> {
        let away = point - self.place.point;
        if away.length_squared() > self.outermost {
            return None;
        }
        let side = wall.normal.dot(self.place.inwards);
        let along = away - away.dot(wall.normal) * wall.normal;
        let distance = length(along);
        let radius = self.below(distance)?;
        if side.abs() < SAME_WALL || distance < self.nearest_along(length(away)) {
            return None;
        }
        // From the middle of the wall, towards the far face, in halves of the thickness.
        let [front, back] = wall.distances(point);
        let deep = (away + 0.5 * (front + back) * wall.normal).dot(self.place.inwards);
        if self.place.in_ply && deep > self.thickness {
            return None;
        }
        let height = (-(front + back) / self.thickness * side.signum()).clamp(-1.0, 1.0);
        let shrink = distance.recip();
        let radial = if shrink.is_finite() && shrink > 0.0 {
            along * shrink
        } else {
            wall.normal.any_orthonormal_vector()
        };
        let [a, b] = [radius, radius + 1].map(|i| self.radii[i]);
        Some(Located {
            radius,
            share: (distance - a) / (b - a),
            height,
            radial,
            hoop: wall.normal.cross(radial),
        })
    }

    /// Radial and hoop stress there at a time step, Pa.
    #[inline(always)]
    fn stress(&self, at: &Located, step: usize) -> [f32; 2] {
        let step = self.step(step);
        if step >= self.steps {
            return [0.0; 2];
        }
        let rows = [at.radius, at.radius + 1].map(|i| i * self.steps + step);
        let [sum, difference] = [0, 1].map(|part| {
            let [a, b] = rows.map(|i| self.table[part][i]);
            at.height * (a + (b - a) * at.share)
        });
        [0.5 * (sum - difference), 0.5 * (sum + difference)]
    }

    /// Upper bound of the field's principal tension there at the steps of a batch, Pa.
    #[inline(always)]
    pub(crate) fn most_lanes(&self, at: &Located, batch: usize) -> Lanes {
        let row = &self.most[at.radius * self.steps..][..self.steps];
        let first = (batch * STRIDE).wrapping_sub(1);
        let mut most = [0.0; BATCH];
        for k in 0..BATCH {
            let step = self.step(first.wrapping_add(k));
            most[k] = if step < self.steps { row[step] } else { 0.0 };
        }
        most
    }

    /// Radial and hoop stress there at all steps of a batch, Pa.
    #[inline(always)]
    pub(crate) fn lanes(&self, at: &Located, batch: usize) -> [Lanes; 2] {
        let (mut radial, mut hoop): (Lanes, Lanes) = ([0.0; BATCH], [0.0; BATCH]);
        // Before the first step there is none, but of a steady field.
        let first = (batch * STRIDE).wrapping_sub(1);
        if self.steady || first >= self.steps.saturating_sub(BATCH) {
            for k in 0..BATCH {
                [radial[k], hoop[k]] = self.stress(at, first.wrapping_add(k));
            }
            return [radial, hoop];
        }
        let [sums, differences] = &self.table;
        let [here, next] = [at.radius, at.radius + 1].map(|i| i * self.steps + first);
        let (a, b) = (&sums[here..][..BATCH], &sums[next..][..BATCH]);
        let (c, d) = (&differences[here..][..BATCH], &differences[next..][..BATCH]);
        for k in 0..BATCH {
            let sum = at.height * (a[k] + (b[k] - a[k]) * at.share);
            let difference = at.height * (c[k] + (d[k] - c[k]) * at.share);
            (radial[k], hoop[k]) = (0.5 * (sum - difference), 0.5 * (sum + difference));
        }
        [radial, hoop]
    }
}

/// A point in the field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Located {
    /// Distance of the table before it, and the share of the way to the next.
    radius: usize,
    share: f32,
    /// Height over the middle of the wall in halves of its thickness, positive towards the far face.
    height: f32,
    radial: Vec3,
    hoop: Vec3,
}

impl Located {
    /// Returns true if the field is bounded by more here than at another place.
    pub(crate) fn is_nearer(&self, other: &Self) -> bool {
        self.radius < other.radius
    }

    /// Unit vectors along which the field's two tensions act.
    pub(crate) fn directions(&self) -> [Vec3; 2] {
        [self.radial, self.hoop]
    }
}

/// Distances of the table, m, for a wall of this thickness, m.
fn radii(thickness: f64, reach: f64) -> Vec<f64> {
    let first = FIRST_STEP * thickness;
    let mut radii = vec![0.0];
    let mut step = first;
    let mut r = 0.0;
    while r < reach {
        r += step;
        step *= GROWTH;
        radii.push(r);
    }
    radii
}

/// Step after step of each oscillator, side by side.
fn by_oscillator(swing: &[f32], steps: usize) -> Vec<f32> {
    let oscillators = swing.len().checked_div(steps).unwrap_or(0);
    let mut sorted = Vec::with_capacity(swing.len());
    for i in 0..oscillators {
        sorted.extend(swing.iter().skip(i).step_by(oscillators));
    }
    sorted
}

widest! {
    /// The sums over all oscillators at every distance and time step.
    fn fill(
        table: &mut [Vec<f32>; 2],
        still: &[[f64; 2]],
        swinging: &[Vec<[f64; 2]>],
        swing: &[f32],
        force: &[f32],
    ) {
        let steps = force.len();
        if steps == 0 {
            return;
        }
        for part in 0..2 {
            let rows = table[part].chunks_exact_mut(steps);
            for ((row, still), swinging) in rows.zip(still).zip(swinging) {
                let share = still[part] as f32;
                for (sum, &force) in row.iter_mut().zip(force) {
                    *sum = share * force;
                }
                for (shares, swing) in swinging.iter().zip(swing.chunks_exact(steps)) {
                    let share = shares[part] as f32;
                    for (sum, &q) in row.iter_mut().zip(swing) {
                        *sum += share * q;
                    }
                }
            }
        }
    }
}

/// The near fields of all contacts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NearFields<'a>(pub(crate) &'a [NearField]);

impl NearFields<'_> {
    /// Numbers of the fields that reach a point of a wall, and where it lies in them.
    pub(crate) fn places(
        &self,
        point: Vec3,
        wall: &Wall,
    ) -> impl Iterator<Item = (usize, Located)> {
        let fields = self.0.iter().enumerate();
        fields.filter_map(move |(i, field)| Some((i, field.locate(point, wall)?)))
    }

    /// Adds them to the stress at a point of a wall at the steps of a batch; returns true if any reaches it.
    #[inline(always)]
    pub(crate) fn add(
        &self,
        stress: &mut StressLanes,
        point: Vec3,
        wall: &Wall,
        batch: usize,
    ) -> bool {
        let mut reached = false;
        for field in self.0 {
            let Some(at) = field.locate(point, wall) else {
                continue;
            };
            reached = true;
            let [radial, hoop] = field.lanes(&at, batch);
            stress.add_uniaxial(&radial, at.radial);
            stress.add_uniaxial(&hoop, at.hoop);
        }
        reached
    }

    /// Their stress at a point of a wall at a time step; none where no field reaches.
    pub(crate) fn at(&self, point: Vec3, wall: &Wall, step: usize) -> Option<Symmetric3> {
        let mut sum = None;
        for field in self.0 {
            if let Some(at) = field.locate(point, wall) {
                let [radial, hoop] = field.stress(&at, step);
                let stress = Symmetric3::uniaxial(radial, at.radial)
                    .plus(&Symmetric3::uniaxial(hoop, at.hoop));
                sum = Some(sum.map_or(stress, |s: Symmetric3| s.plus(&stress)));
            }
        }
        sum
    }
}
