//! The floor: fine-grained, in a pool of light, fading into the backdrop.

use frangible_recording::glam::{Vec2, Vec3A};
use frangible_recording::{Floor, Recording, View};
use noise_functions::modifiers::Fbm;
use noise_functions::{Noise, Simplex};

use crate::caustic::Caustic;
use crate::floor_shadow::{Caster, Fineness, FloorShadow};
use crate::light::backdrop_seen;
use crate::set::Set;
use crate::stage::{StageUnits, casters, key_light};

/// Shares of the key lamp and of the room in the light on the floor, of 1. The rest gets everywhere.
const KEY_SHARE: f32 = 0.60;
const ROOM_SHARE: f32 = 0.34;

/// Light on the plain floor.
const LIT: f32 = 0.70;

/// A floor of no colour is as warm as this.
const WARMTH: Vec3A = Vec3A::new(1.06, 1.0, 0.93);

/// Radius of the pool of light, stage units.
const POOL: f32 = 3.6;

/// Distances from the view's target at which the floor begins to fade into the backdrop and at which it has faded, stage units.
const FADE: [f32; 2] = [3.0, 15.0];

/// Distance from the view's target beyond which things have no mirror image in the floor, stage units.
const GLOSSY: f32 = 4.0;

/// A level floor under the things.
pub(crate) struct Ground {
    height: f32,
    color: Vec3A,
    key: FloorShadow,
    room: FloorShadow,
    caustic: Option<Caustic>,
    fine: Fbm<Simplex>,
    broad: Fbm<Simplex>,
}

impl Ground {
    pub(crate) fn new(
        recording: &Recording,
        floor: &Floor,
        view: &View,
        units: StageUnits,
        set: &Set,
    ) -> Self {
        let height = (floor.height - units.origin.y) * units.scale;
        let casters = casters(recording, units);
        let key = key_light(&units.view(view));
        let cast = |casters: &[Caster], fineness| FloorShadow::cast(casters, height, key, fineness);
        let room = cast(&casters, Fineness::ROOM);
        // The lamp's light through glass is followed path by path.
        let gathers = set.has_glass();
        let opaque: Vec<Caster> = casters
            .into_iter()
            .map(|caster| Caster {
                clarity: if gathers { 0.0 } else { caster.clarity },
                ..caster
            })
            .collect();
        let shadow = cast(&opaque, Fineness::KEY);
        Self {
            height,
            color: floor.base_color.into(),
            caustic: gathers.then(|| Caustic::new(set, &shadow, height, key.into())),
            key: shadow,
            room,
            fine: Simplex.fbm(2, 0.6, 2.1),
            broad: Simplex.fbm(3, 0.5, 2.3),
        }
    }

    /// Distance along a ray to the floor.
    pub(crate) fn distance(&self, from: Vec3A, along: Vec3A) -> Option<f32> {
        if along.y >= -1e-4 {
            return None;
        }
        let distance = (self.height - from.y) / along.y;
        (distance > 1e-4).then_some(distance)
    }

    /// The light that comes from a point of the floor against a direction.
    pub(crate) fn light(&self, at: Vec3A, along: Vec3A) -> Vec3A {
        let place = Vec2::new(at.x, at.z);
        let away = place.length();
        let far = smooth_step(FADE[0], FADE[1], away);
        let level = Vec3A::new(along.x, 0.0, along.z).normalize_or(along);
        let beyond = backdrop_seen(level);
        if far >= 1.0 {
            return beyond;
        }
        let [key, room] = [&self.key, &self.room].map(|shadow| lookup(shadow, place));
        let gathered = self.gathered(place);
        let shade = Vec3A::splat(1.0 - KEY_SHARE * (1.0 - key) - ROOM_SHARE * (1.0 - room))
            + KEY_SHARE * gathered;
        let pool = 0.42 + 0.58 / (1.0 + (away / POOL).powi(2)).powi(2);
        let grain = self.grain(place, away);
        (self.color * WARMTH * LIT * shade * (pool * grain)).lerp(beyond, far)
    }

    /// The lamp's light that glass gathers at a place, of that on plain floor.
    fn gathered(&self, place: Vec2) -> Vec3A {
        self.caustic
            .as_ref()
            .map_or(Vec3A::ZERO, |caustic| caustic.at(place))
    }

    /// The lamp's light at a point of the floor that comes straight, and that glass gathers there, each of that on plain floor.
    #[cfg(test)]
    pub(crate) fn lamp_at(&self, at: Vec3A) -> [f32; 2] {
        let place = Vec2::new(at.x, at.z);
        [lookup(&self.key, place), self.gathered(place).y]
    }

    /// Fine and broad differences in the floor's brightness, about 1.
    fn grain(&self, place: Vec2, away: f32) -> f32 {
        let broad = self.broad.sample2((place * 0.9).to_array());
        // Grain finer than a pixel is left out far off.
        let near = (1.4 - 0.28 * away).clamp(0.0, 1.0);
        let fine = if near > 0.0 {
            near * self.fine.sample2((place * 55.0).to_array())
        } else {
            0.0
        };
        1.0 + 0.035 * broad + 0.045 * fine
    }

    /// Share of light that the floor mirrors.
    pub(crate) fn gloss(&self, at: Vec3A, along: Vec3A) -> f32 {
        if Vec2::new(at.x, at.z).length() > GLOSSY {
            return 0.0;
        }
        0.035 + 0.35 * (1.0 + along.y).clamp(0.0, 1.0).powi(5)
    }
}

/// The brightness at a place of the floor, between texels.
fn lookup(shadow: &FloorShadow, place: Vec2) -> f32 {
    let side = shadow.side;
    let at = (place - shadow.center + shadow.half_side) * (side as f32 / (2.0 * shadow.half_side));
    let at = at - 0.5;
    if at.min_element() < 0.0 || at.max_element() >= (side - 1) as f32 {
        return 1.0;
    }
    let [x, y] = [at.x as usize, at.y as usize];
    let part = at - at.floor();
    let texel = |dx: usize, dy: usize| shadow.brightness[(y + dy) * side + x + dx];
    let row = |dy| texel(0, dy) * (1.0 - part.x) + texel(1, dy) * part.x;
    row(0) * (1.0 - part.y) + row(1) * part.y
}

fn smooth_step(from: f32, to: f32, at: f32) -> f32 {
    let t = ((at - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
