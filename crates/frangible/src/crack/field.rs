//! The body's stress at one time step, evaluated where it is asked for.

use glam::Vec3;

use crate::asset::{Asset, EmbeddedPoint};
use crate::config::FractureConfig;
use crate::stress::{
    DisplacementBatch, Elasticity, Law, Skin, StressLanes, StressState, Symmetric3, Wall,
    largest_eigenvalue,
};

/// Stress at fracture tetrahedra at one step.
pub(crate) struct StressField<'a> {
    pub(crate) asset: &'a Asset,
    pub(crate) skin: &'a Skin,
    pub(crate) config: &'a FractureConfig,
    /// Surface triangles that something presses on: they are not free.
    pub(crate) pressed: &'a [u32],
    pub(crate) displacement: &'a mut DisplacementBatch,
    pub(crate) elasticity: Elasticity,
    pub(crate) step: usize,
}

impl StressField<'_> {
    /// Stress and strain energy density at the centroid of fracture tetrahedron `e`.
    pub(crate) fn at(&mut self, e: usize) -> StressState {
        let gradient = self.gradient(self.asset.embedded_tet(e));
        match self.wall(e) {
            Some(wall) => self.elasticity.free_state(gradient, wall.normal),
            None => self.elasticity.state(gradient),
        }
    }

    /// The wall that fracture tetrahedron `e` is part of.
    pub(crate) fn wall(&self, e: usize) -> Option<Wall> {
        wall(self.asset, self.skin, self.config, e)
    }

    /// Stress that steers a crack in fracture tetrahedron `e`: in a wall that of its face with the larger tension, since
    /// there the crack opens; behind, a bent wall may be stretched another way. `state`: that at the centroid.
    pub(crate) fn steering(
        &mut self,
        e: usize,
        wall: Option<&Wall>,
        state: &StressState,
    ) -> Symmetric3 {
        let Some(wall) = wall else {
            return state.stress;
        };
        let [front, back] = self.on_faces(e, wall);
        if largest_eigenvalue(&front) >= largest_eigenvalue(&back) {
            front
        } else {
            back
        }
    }

    /// Tension across a crack of this unit normal in fracture tetrahedron `e` that opens its front, Pa: of a wall that of its middle and
    /// the part of its bending that counts (`tip.rs`), at most the larger one of its faces. `state`: that at the centroid.
    pub(crate) fn opening(&mut self, e: usize, normal: Vec3, state: &StressState) -> f64 {
        let across = |stress: &Symmetric3| f64::from(normal.dot(stress.to_mat3() * normal));
        let Some(wall) = self.wall(e) else {
            return across(&state.stress).max(0.0);
        };
        let [front, back] = self.on_faces(e, &wall).map(|stress| across(&stress));
        let largest = front.max(back).max(0.0);
        let middle = (0.5 * (front + back)).clamp(0.0, largest);
        let nu = self.asset.material.poisson_ratio;
        let share = (1.0 + nu) / (3.0 * (3.0 + nu));
        (middle.powi(2) + share * (largest - middle).powi(2)).sqrt()
    }

    /// Stress on the two faces of a wall beside the centroid of fracture tetrahedron `e`.
    fn on_faces(&mut self, e: usize, wall: &Wall) -> [Symmetric3; 2] {
        let centre = self.asset.embedded_tet(e);
        let distances = wall.distances(self.asset.fracture.centroid(e));
        distances.map(|distance| {
            let gradient = self.gradient(&shifted(self.asset, centre, wall.normal * distance));
            self.elasticity.free_state(gradient, wall.normal).stress
        })
    }

    /// The same where a crack may start in it, at all steps of the batch: at its [`weak_place`].
    #[inline(always)]
    pub(crate) fn at_weak_point(&mut self, e: usize) -> StressLanes {
        let (point, law) = weak_place(self.asset, self.skin, self.config, self.pressed, e);
        let gradients = self.displacement.gradients(self.asset, point);
        self.elasticity.lanes(&gradients, law)
    }

    /// The same at the mirror image of the [`weak_place`] behind the middle of the wall that it is in, if it is in one: on the opposite
    /// face, of a place on a face. Half the difference of the two is what bends the wall there.
    #[inline(always)]
    pub(crate) fn opposite_weak_point(&mut self, e: usize) -> Option<StressLanes> {
        let wall = self.wall(e)?;
        let (point, law) = weak_place(self.asset, self.skin, self.config, self.pressed, e);
        let [front, back] = wall.distances(position(self.asset, point));
        let image = shifted(self.asset, point, wall.normal * (front + back));
        let gradients = self.displacement.gradients(self.asset, &image);
        Some(self.elasticity.lanes(&gradients, law))
    }

    fn gradient(&mut self, point: &EmbeddedPoint) -> glam::Mat3 {
        self.displacement.gradient(self.asset, point, self.step)
    }
}

/// A point of the body moved by a little, m, seen by the same analysis element.
fn shifted(asset: &Asset, point: &EmbeddedPoint, by: Vec3) -> EmbeddedPoint {
    let gradients = &asset.analysis.barycentric_gradients[point.element as usize];
    EmbeddedPoint {
        barycentric: std::array::from_fn(|k| point.barycentric[k] + gradients[k].dot(by)),
        ..*point
    }
}

/// Where an embedded point is, m.
fn position(asset: &Asset, point: &EmbeddedPoint) -> Vec3 {
    let corners = &asset.analysis.elements[point.element as usize][..4];
    let parts = corners.iter().zip(point.barycentric);
    let closest: Vec3 = parts
        .map(|(&v, share)| asset.analysis.nodes[v as usize] * share)
        .sum();
    closest + point.offset
}

fn wall(asset: &Asset, skin: &Skin, config: &FractureConfig, e: usize) -> Option<Wall> {
    if config.plane_stress_walls {
        skin.wall(asset, e)
    } else {
        None
    }
}

/// Where a crack may start in fracture tetrahedron `e`, and the law of the stress there: at its flaw on the free surface,
/// else at its centroid.
///
/// Under a contact the surface is pressed together, which no mode resolves: there the centroid serves.
#[inline(always)]
pub(crate) fn weak_place<'a>(
    asset: &'a Asset,
    skin: &'a Skin,
    config: &FractureConfig,
    pressed: &[u32],
    e: usize,
) -> (&'a EmbeddedPoint, Law) {
    let wall = wall(asset, skin, config, e);
    let flaw = skin.flaw(asset.place(e)).filter(|_| config.surface_flaws);
    match flaw.filter(|flaw| !pressed.contains(&flaw.triangle)) {
        Some(flaw) => match wall.and_then(|wall| wall.edge(flaw.normal)) {
            Some(along) => (&flaw.point, Law::Edge(along)),
            None => (&flaw.point, Law::Free(flaw.normal)),
        },
        None => {
            let law = wall.map_or(Law::Solid, |wall| Law::Free(wall.normal));
            (asset.embedded_tet(e), law)
        }
    }
}
