//! The body's stress at one time step, evaluated on demand.

use glam::Vec3;

use super::felt::Felt;
use crate::asset::{Asset, EmbeddedPoint};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::motion::{DisplacementBatch, Moment, Motion};
use crate::near_field::NearFields;
use crate::stress::{
    BATCH, Elasticity, Frame, Lanes, Law, MOST, NO_TET, RowPoint, STRIDE, Sample, SampleStress,
    Skin, StressLanes, StressState, Symmetric3, Wall, WeakPlace, of_shape, wall_of, weak_place,
};

/// Stress at fracture tetrahedra at one step.
pub(crate) struct StressField<'a> {
    body: &'a Body,
    pub(crate) asset: &'a Asset,
    pub(crate) skin: &'a Skin,
    pub(crate) config: &'a FractureConfig,
    /// Surface triangles that something presses on: they are not free.
    pub(crate) pressed: &'a [u32],
    pub(crate) displacement: &'a mut DisplacementBatch,
    pub(super) motion: &'a Motion,
    moment: Moment,
    pub(crate) elasticity: Elasticity,
    /// Near fields under contacts on walls, which the modes do not show.
    pub(crate) near: NearFields<'a>,
    /// Centroids of the fracture tetrahedra, m.
    pub(crate) centroids: &'a [Vec3],
    pub(crate) step: usize,
}

impl<'a> StressField<'a> {
    /// The stress of a motion, at its first step.
    pub(crate) fn new(
        body: &'a Body,
        config: &'a FractureConfig,
        motion: &'a Motion,
        pressed: &'a [u32],
        displacement: &'a mut DisplacementBatch,
    ) -> Self {
        let asset = &*body.asset;
        Self {
            body,
            asset,
            skin: &body.prepared.skin,
            config,
            pressed,
            displacement,
            motion,
            moment: Moment::default(),
            elasticity: Elasticity::new(&asset.material).with_green_lagrange(config.is_paper()),
            near: motion.complement.near(),
            centroids: &body.prepared.centroids,
            step: 0,
        }
    }

    /// Returns the stress on a crack at the position, m, where it cuts fracture tetrahedron `e`: in a solid the stress and energy there, in a wall
    /// the stress on both faces and the mean energy through the wall. The centroid may lie an edge length from the crack, where the stress near
    /// a contact differs; using it would align crack arms with the mesh.
    pub(crate) fn at(&mut self, e: usize, place: Vec3) -> Felt {
        let aside = place - self.centroids[e];
        let centre = shifted(self.asset, self.asset.embedded_tet(e), aside);
        let Some(wall) = self.wall(e) else {
            let gradient = self.gradient(&centre);
            return Felt {
                state: self.elasticity.state(gradient),
                wall: None,
            };
        };
        let faces = self.on_faces(place, &centre, &wall);
        // Stress is linear through the wall, and energy quadratic: Simpson's rule is exact.
        let middle = faces[0].plus(&faces[1]).scaled(0.5);
        let [front, back, middle] =
            [faces[0], faces[1], middle].map(|s| self.elasticity.with_energy(s));
        let energy = (front.energy_density + back.energy_density + 4.0 * middle.energy_density)
            * (1.0 / 6.0);
        Felt {
            state: StressState {
                energy_density: energy,
                ..middle
            },
            wall: Some((wall, faces)),
        }
    }

    /// Upper bounds of the largest tension that [`at`](Self::at) finds there, but for rounding, at all steps of the batch, Pa.
    pub(super) fn tension_bounds(&mut self, e: usize, place: Vec3) -> Lanes {
        tension_bounds(self, e, place)
    }

    /// The wall that fracture tetrahedron `e` is part of.
    pub(crate) fn wall(&self, e: usize) -> Option<Wall> {
        wall_of(self.asset, self.skin, self.config, e)
    }

    /// Weak point of fracture tetrahedron `e`: the place at which a crack may start.
    #[inline(always)]
    fn weak_place(&self, e: usize) -> WeakPlace {
        let places = &self.body.places;
        weak_place(self.asset, self.skin, places, self.config, self.pressed, e)
    }

    /// Position of that place, m.
    pub(super) fn weak_position(&self, e: usize) -> Vec3 {
        self.weak_place(e).position(self.body, e)
    }

    /// Outward normal of the face of the wall that a crack opens from which starts in fracture tetrahedron `e`; zero where its flaw
    /// lies on no face of a wall.
    pub(crate) fn opens(&self, e: usize) -> Vec3 {
        let weak = self.weak_place(e);
        match (weak.law, weak.wall) {
            (Law::Free(normal), Some(_)) if weak.flaw.is_some() => normal,
            _ => Vec3::ZERO,
        }
    }

    /// Stress on the two faces of a wall beside a place in it, m, which the analysis mesh sees as `centre`.
    fn on_faces(&mut self, place: Vec3, centre: &EmbeddedPoint, wall: &Wall) -> [Symmetric3; 2] {
        let distances = wall.distances(place);
        distances.map(|distance| {
            let up = wall.normal * distance;
            let gradient = self.gradient(&shifted(self.asset, centre, up));
            let stress = self.elasticity.free_state(gradient, wall.normal).stress;
            match self.near.at(place + up, wall, self.step) {
                Some(near) => stress.plus(&near),
                None => stress,
            }
        })
    }

    /// Stress and energy where a crack may start in fracture tetrahedron `e`, its [`weak_place`], at all steps of the batch.
    #[inline(always)]
    pub(crate) fn at_weak_point(&mut self, e: usize) -> StressLanes {
        let weak = self.weak_place(e);
        if self.config.sized_flaws && self.body.flaw_depth(e as u32) > 0.0 {
            return self.mean(&weak.row_point(self.body, self.config, e));
        }
        let gradients = self.displacement.gradients(self.asset, &weak.point);
        let mut lanes = self.elasticity.lanes(&gradients, weak.law);
        if let (Law::Free(_), Some(wall)) = (weak.law, &weak.wall)
            && !self.near.0.is_empty()
        {
            self.add_near(&mut lanes, weak.position(self.body, e), wall);
        }
        lanes
    }

    /// Mean stress over a flaw that is larger than its tetrahedron, at all steps of the batch.
    #[inline(never)]
    fn mean(&mut self, point: &RowPoint) -> StressLanes {
        let share = point.share();
        let mut numbers = [Lanes::default(); MOST];
        let own = Sample {
            tet: NO_TET,
            point: point.point,
            law: point.law,
            place: point.place,
            wall: point.wall,
        };
        for sample in std::iter::once(&own).chain(&point.samples) {
            let gradients = self.displacement.gradients(self.asset, &sample.point);
            let mut lanes = self.elasticity.lanes(&gradients, sample.law);
            if let (Law::Free(_), Some(wall)) = (sample.law, &sample.wall) {
                self.near
                    .add(&mut lanes, sample.place, wall, self.step / STRIDE);
            }
            for k in 0..BATCH {
                let here = point.frame.numbers(&lanes.stress(k));
                for (sum, number) in numbers.iter_mut().zip(here) {
                    sum[k] += share * number;
                }
            }
        }
        let mut lanes = point.frame.stress(&numbers);
        self.elasticity.set_energy(&mut lanes);
        lanes
    }

    /// Returns true if the weak point of fracture tetrahedron `e` lies on a free surface.
    pub(super) fn is_on_surface(&self, e: usize) -> bool {
        self.weak_place(e).flaw.is_some()
    }

    /// Returns true if something presses on the flaw of fracture tetrahedron `e`.
    pub(super) fn is_pressed(&self, e: usize) -> bool {
        let flaw = self.skin.flaw(self.asset.place(e));
        flaw.is_some_and(|flaw| self.pressed.contains(&flaw.triangle))
    }

    /// Adds the near fields to the stress at a point of a wall.
    #[inline(always)]
    fn add_near(&self, lanes: &mut StressLanes, place: Vec3, wall: &Wall) {
        if self.near.add(lanes, place, wall, self.step / STRIDE) {
            self.elasticity.set_energy(lanes);
        }
    }

    /// Stress at all steps of the batch at the mirror image of the [`weak_place`] of fracture tetrahedron `e` behind the middle of the wall
    /// that it is in, if it is in one: on the opposite face, of a place on a face. Half the difference of the two is what bends the wall there.
    /// `place`: the tetrahedron's place among the body's weak points.
    #[inline(always)]
    pub(crate) fn opposite_weak_point(&mut self, place: usize, e: usize) -> Option<StressLanes> {
        let modes = self.displacement.amplitudes().len();
        let laws = self.body.rows.of(self.body, self.config, modes);
        let (image, mut lanes) = match laws {
            // Rows are of points where nothing presses.
            Some(laws) if !self.is_pressed(e) => {
                let (cluster, i) = self.body.clusters.locate(place);
                let opposite = laws.opposite(self.body, self.config, cluster);
                let (image, first) = opposite.images[i].as_ref()?;
                let mut numbers = [Lanes::default(); MOST];
                let numbers = &mut numbers[..image.frame.count()];
                for (shape, force) in self.displacement.residuals() {
                    let image = std::slice::from_ref(image);
                    let none = &mut SampleStress::default();
                    let shares = of_shape(self.asset, &self.elasticity, shape, image, none);
                    for (number, share) in numbers.iter_mut().zip(shares) {
                        for (sum, force) in number.iter_mut().zip(force) {
                            *sum += share * force;
                        }
                    }
                }
                let amplitudes = self.displacement.amplitudes();
                opposite.rows.add_to(*first, amplitudes, numbers);
                (image.clone(), image.frame.stress(numbers))
            }
            _ => {
                let weak = self.weak_place(e);
                let image = weak.opposite(self.body, self.config, e)?;
                if !image.samples.is_empty() {
                    return Some(self.mean(&image));
                }
                let gradients = self.displacement.gradients(self.asset, &image.point);
                let lanes = self.elasticity.lanes(&gradients, image.law);
                (image, lanes)
            }
        };
        if image.samples.is_empty() {
            if let (Law::Free(_), Some(wall)) = (image.law, &image.wall) {
                self.add_near(&mut lanes, image.place, wall);
            }
        } else {
            self.add_mean_near(&mut lanes, &image);
        }
        Some(lanes)
    }

    /// Adds the mean of the near fields over a flaw.
    fn add_mean_near(&self, lanes: &mut StressLanes, point: &RowPoint) {
        let share = point.share();
        let mut numbers = [Lanes::default(); MOST];
        for (place, wall) in point.walls() {
            let mut near = StressLanes::default();
            self.near.add(&mut near, place, wall, self.step / STRIDE);
            for k in 0..BATCH {
                let here = point.frame.numbers(&near.stress(k));
                for (sum, number) in numbers.iter_mut().zip(here) {
                    sum[k] += share * number;
                }
            }
        }
        let near = point.frame.stress(&numbers);
        lanes.add_all(&near);
        self.elasticity.set_energy(lanes);
    }

    fn gradient(&mut self, point: &EmbeddedPoint) -> glam::Mat3 {
        (self.moment).gradient(self.asset, self.motion, point, self.step)
    }
}

widest! {
    /// Bounds of the tension at a place.
    fn tension_bounds(field: &mut StressField<'_>, e: usize, place: Vec3) -> Lanes {
        let (asset, aside) = (field.asset, place - field.centroids[e]);
        let centre = shifted(asset, asset.embedded_tet(e), aside);
        let Some(wall) = field.wall(e) else {
            let gradients = field.displacement.gradients(asset, &centre);
            return field.elasticity.lanes(&gradients, Law::Solid).tension_bounds();
        };
        let mut most = Lanes::default();
        for distance in wall.distances(place) {
            let up = wall.normal * distance;
            let gradients = field.displacement.gradients(asset, &shifted(asset, &centre, up));
            let mut lanes = field.elasticity.lanes(&gradients, Law::Free(wall.normal));
            field.near.add(&mut lanes, place + up, &wall, field.step / STRIDE);
            let bounds = lanes.tension_bounds();
            for k in 0..BATCH {
                most[k] = most[k].max(bounds[k]);
            }
        }
        most
    }
}

/// A point of the body moved by a little, m, seen by the same analysis element.
fn shifted(asset: &Asset, point: &EmbeddedPoint, by: Vec3) -> EmbeddedPoint {
    let gradients = &asset.analysis.barycentric_gradients[point.element as usize];
    point.moved(gradients, by)
}

impl WeakPlace {
    /// Point and samples from which its stress rows are made. `e`: its tetrahedron.
    pub(crate) fn row_point(&self, body: &Body, config: &FractureConfig, e: usize) -> RowPoint {
        let place = self.position(body, e);
        let samples = match config.sized_flaws {
            true => body.flaw_samples(e as u32, place),
            false => Vec::new(),
        };
        let skin = &body.prepared.skin;
        let sample = |tet: u32| {
            let wall = wall_of(&body.asset, skin, config, tet as usize);
            Sample {
                tet,
                point: *body.asset.embedded_tet(tet as usize),
                law: wall.map_or(Law::Solid, |wall| Law::Free(wall.normal)),
                place: body.prepared.centroids[tet as usize],
                wall,
            }
        };
        RowPoint {
            point: self.point,
            law: self.law,
            frame: Frame::of(self.law, self.wall.as_ref()),
            place,
            wall: self.wall,
            samples: samples.into_iter().map(sample).collect(),
        }
    }

    /// Its mirror image behind the middle of the wall that it is in; none in a solid. `e`: its tetrahedron.
    pub(crate) fn opposite(
        &self,
        body: &Body,
        config: &FractureConfig,
        e: usize,
    ) -> Option<RowPoint> {
        let wall = self.wall?;
        let mut here = self.row_point(body, config, e);
        let across = |wall: &Wall, place: Vec3| {
            let [front, back] = wall.distances(place);
            wall.normal * (front + back)
        };
        for sample in &mut here.samples {
            let by = across(sample.wall.as_ref().unwrap_or(&wall), sample.place);
            sample.point = shifted(&body.asset, &sample.point, by);
            sample.place += by;
            sample.tet = NO_TET;
        }
        let by = across(&wall, here.place);
        Some(RowPoint {
            point: shifted(&body.asset, &self.point, by),
            place: here.place + by,
            ..here
        })
    }

    /// Its position, m. `e`: its tetrahedron.
    #[inline(always)]
    pub(crate) fn position(&self, body: &Body, e: usize) -> Vec3 {
        self.flaw.unwrap_or(body.prepared.centroids[e])
    }
}
