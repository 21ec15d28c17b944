//! Light of the key lamp that glass gathers on the floor.

use frangible_recording::glam::{Vec2, Vec3A};
use rayon::prelude::*;

use crate::floor_shadow::FloorShadow;
use crate::photon::Photon;
use crate::random::{Random, disc_axes, hash};
use crate::set::Set;

/// Paths from the lamp, and number of paths that are followed together.
const PATHS: u32 = 60_000;
const TOGETHER: u32 = 4_000;

/// Texels along each side.
const SIDE: usize = 256;

/// Rounds of smoothing: fewer paths than one would like to follow meet each texel.
const SMOOTHINGS: usize = 3;

/// Radius of the lamp over its distance.
const LAMP: f32 = 0.10;

/// Gathered light on a square of the floor, of that of the lamp on plain floor.
pub(crate) struct Caustic {
    corner: Vec2,
    /// Texels per stage unit.
    texels: f32,
    light: Vec<Vec3A>,
}

impl Caustic {
    /// Follows light from the lamp through everything clear onto a floor of this height, over the square of a shadow.
    pub(crate) fn new(set: &Set, shadow: &FloorShadow, height: f32, key: Vec3A) -> Self {
        let key = key.normalize();
        let faces = set.clear_faces_toward(key);
        let total = faces.last().map_or(0.0, |&(_, sum)| sum);
        let texels = SIDE as f32 / (2.0 * shadow.half_side);
        let corner = shadow.center - shadow.half_side;
        let mut caustic = Self {
            corner,
            texels,
            light: vec![Vec3A::ZERO; SIDE * SIDE],
        };
        if total <= 0.0 {
            return caustic;
        }
        // Light per path, of the lamp's on plain floor: area seen from the lamp over that of a texel seen from there.
        let each = total / PATHS as f32 * texels * texels / key.y.max(0.1);
        let landed: Vec<Vec<(usize, Vec3A)>> = (0..PATHS.div_ceil(TOGETHER))
            .into_par_iter()
            .map(|batch| {
                let numbers = batch * TOGETHER..(batch + 1) * TOGETHER;
                let follow = |number| {
                    let mut random = Random::new(hash(0x51ed_270b), number);
                    // One after the other over all faces, so that light lands evenly.
                    let pick = (number as f32 + random.next()) / PATHS as f32 * total;
                    let [across, along] = disc_axes(key);
                    let turn = Vec2::from_angle(std::f32::consts::TAU * random.next());
                    let [x, y] = (turn * random.next().sqrt()).to_array();
                    let from_lamp = -(key + LAMP * (x * across + y * along)).normalize();
                    let photon = Photon::through(set, &faces, from_lamp, pick, &mut random)?;
                    let at = photon.on_floor(height)?;
                    let texel = (at - corner) * texels;
                    let inside = texel.min_element() >= 0.0 && texel.max_element() < SIDE as f32;
                    inside.then(|| {
                        (
                            texel.y as usize * SIDE + texel.x as usize,
                            photon.light * each,
                        )
                    })
                };
                numbers.filter_map(follow).collect()
            })
            .collect();
        for (texel, light) in landed.into_iter().flatten() {
            caustic.light[texel] += light;
        }
        for _ in 0..SMOOTHINGS {
            smooth(&mut caustic.light);
        }
        caustic
    }

    /// The gathered light at a place of the floor.
    pub(crate) fn at(&self, place: Vec2) -> Vec3A {
        let at = (place - self.corner) * self.texels - 0.5;
        if at.min_element() < 0.0 || at.max_element() >= (SIDE - 1) as f32 {
            return Vec3A::ZERO;
        }
        let [x, y] = [at.x as usize, at.y as usize];
        let part = at - at.floor();
        let row = |y: usize| self.light[y * SIDE + x].lerp(self.light[y * SIDE + x + 1], part.x);
        row(y).lerp(row(y + 1), part.y)
    }
}

/// A tent of three texels each way.
fn smooth(light: &mut [Vec3A]) {
    for stride in [1, SIDE] {
        let source = light.to_vec();
        for index in stride..source.len() - stride {
            let sides = source[index - stride] + source[index + stride];
            light[index] = 0.5 * source[index] + 0.25 * sides;
        }
    }
}
