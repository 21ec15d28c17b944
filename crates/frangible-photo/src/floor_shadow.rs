//! The shadow on the floor, as a texture.
//!
//! A renderer's shadow maps know one strength and draw lines across glass
//! shadows. The floor is flat, though: whatever stands between it and a point
//! of a lamp can be projected onto it, face by face, exactly. Many points of a
//! large lamp and of the room around make the shadow soft, dark where things
//! touch the floor, and a face of glass takes only the light it reflects.

use std::f32::consts::PI;

use frangible_recording::glam::{Vec2, Vec3};

/// Fineness of a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Points of the key light; fewer leave steps in its shadow's edge.
    key_points: usize,
    /// Points of the room's light. Its shadows reach far and are faint; with half as
    /// many, single ones show.
    room_points: usize,
    /// Texels along each side.
    side: usize,
    /// Rounds of smoothing, which hide the remaining edges of single points' shadows.
    smoothings: usize,
    /// Shares of the key light and of the room in the light on the floor, of 1. The rest gets everywhere.
    key_share: f32,
    room_share: f32,
}

impl Fineness {
    /// Fineness for pictures.
    pub const STILL: Self = Self {
        key_points: 36,
        room_points: 72,
        side: 640,
        smoothings: 3,
        key_share: 0.40,
        room_share: 0.42,
    };
    /// The key light's alone, for traced pictures, which decide themselves how dark the shadow is.
    pub const KEY: Self = Self {
        key_points: 24,
        room_points: 0,
        side: 448,
        key_share: 1.0,
        room_share: 0.0,
        ..Self::STILL
    };
    /// The room's alone.
    pub const ROOM: Self = Self {
        key_points: 0,
        room_points: 48,
        side: 320,
        key_share: 0.0,
        room_share: 1.0,
        ..Self::STILL
    };
    /// Fineness for moving things: a twentieth of the work.
    pub const MOVING: Self = Self {
        key_points: 8,
        room_points: 12,
        side: 256,
        smoothings: 5,
        ..Self::STILL
    };
}

/// The turn from one point to the next that spreads points evenly over a disc.
const GOLDEN_TURN: f32 = 2.399_963;

/// A triangle that keeps light from the floor, stage units.
#[derive(Clone, Copy)]
pub struct Caster {
    /// Corners, stage units.
    pub corners: [Vec3; 3],
    /// Clarity: at 0 the face stops all light, at 1 only what it reflects.
    pub clarity: f32,
    /// True for a part of a closed opaque skin, seen counterclockwise from outside: faces turned away from a lamp add nothing to its shadow.
    pub one_sided: bool,
}

/// Brightness of the floor over a square around `center`, which is a point of
/// the floor's plane (x, z).
pub struct FloorShadow {
    /// The middle of the square.
    pub center: Vec2,
    /// Half the square's side, stage units.
    pub half_side: f32,
    /// Texels along each side.
    pub side: usize,
    /// Row by row along z, `side` squared: 1 where nothing takes light away.
    pub brightness: Vec<f32>,
}

/// A shadow that is being cast, lamp by lamp.
pub struct Casting {
    shadow: FloorShadow,
    outlines: Vec<Outline>,
    layer: Vec<f32>,
    /// Lamps that have not cast their shadows, the next one last.
    lamps: Vec<(Vec3, f32)>,
    smoothings: usize,
}

impl Casting {
    /// `key` is a direction towards the key light, its length the distance at
    /// which the lamp has the radius 1.
    pub fn begin(casters: &[Caster], floor_height: f32, key: Vec3, fineness: Fineness) -> Self {
        let (center, half_side) = extent(casters, floor_height);
        let side = fineness.side;
        let mut lamps: Vec<(Vec3, f32)> = lamps(key, fineness).collect();
        lamps.reverse();
        Self {
            shadow: FloorShadow {
                center,
                half_side,
                side,
                brightness: vec![1.0; side * side],
            },
            outlines: casters
                .iter()
                .filter_map(|caster| Outline::above(caster, floor_height))
                .collect(),
            layer: vec![1.0; side * side],
            lamps,
            smoothings: fineness.smoothings,
        }
    }

    /// Lets one lamp cast its shadow; false if all have.
    pub fn go_on(&mut self) -> bool {
        let Some((toward, share)) = self.lamps.pop() else {
            return false;
        };
        self.layer.fill(1.0);
        for outline in &self.outlines {
            self.shadow.project(outline, toward, &mut self.layer);
        }
        for (sum, light) in self.shadow.brightness.iter_mut().zip(&self.layer) {
            *sum -= share * (1.0 - light);
        }
        true
    }

    /// The shadow of all lamps.
    pub fn finish(mut self) -> FloorShadow {
        while self.go_on() {}
        let mut shadow = self.shadow;
        for _ in 0..self.smoothings {
            smooth(&mut shadow.brightness, shadow.side);
        }
        fade_out(&mut shadow.brightness, shadow.side);
        shadow
    }
}

impl FloorShadow {
    /// Casts a shadow from beginning to end, see [`Casting::begin`].
    pub fn cast(casters: &[Caster], floor_height: f32, key: Vec3, fineness: Fineness) -> Self {
        Casting::begin(casters, floor_height, key, fineness).finish()
    }

    fn project(&self, outline: &Outline, toward: Vec3, layer: &mut [f32]) {
        let cosine = outline.normal.dot(toward);
        if outline.one_sided && cosine <= 0.0 {
            return;
        }
        let passes = light_through(outline.clarity, cosine.abs());
        let texels = self.side as f32 / (2.0 * self.half_side);
        let corner = self.center - self.half_side;
        let slope = Vec2::new(toward.x, toward.z) / toward.y;
        let shadow = outline
            .corners
            .map(|(at, height)| (at - slope * height - corner) * texels);
        darken(layer, self.side, &shadow[..outline.count], passes);
    }
}

/// The part of a caster above the floor: up to four corners, each its place
/// (x, z) and its height above the floor.
struct Outline {
    corners: [(Vec2, f32); 4],
    count: usize,
    normal: Vec3,
    clarity: f32,
    one_sided: bool,
}

impl Outline {
    fn above(caster: &Caster, floor_height: f32) -> Option<Self> {
        let [a, b, c] = caster.corners;
        let (corners, count) = above(caster.corners, floor_height);
        let finite = a.is_finite() && b.is_finite() && c.is_finite();
        (count >= 3 && finite).then(|| Self {
            corners: corners.map(|point| (Vec2::new(point.x, point.z), point.y - floor_height)),
            count,
            normal: (b - a).cross(c - a).normalize_or_zero(),
            clarity: caster.clarity,
            one_sided: caster.one_sided,
        })
    }
}

/// The part of a triangle above the floor: three or four corners, or none.
fn above(corners: [Vec3; 3], floor_height: f32) -> ([Vec3; 4], usize) {
    let (mut outline, mut count) = ([Vec3::ZERO; 4], 0);
    let mut add = |point: Vec3| {
        if let Some(slot) = outline.get_mut(count) {
            *slot = point;
            count += 1;
        }
    };
    for (index, here) in corners.into_iter().enumerate() {
        let next = corners[(index + 1) % 3];
        let heights = (here.y - floor_height, next.y - floor_height);
        if heights.0 >= 0.0 {
            add(here);
        }
        if (heights.0 >= 0.0) != (heights.1 >= 0.0) {
            add(here.lerp(next, heights.0 / (heights.0 - heights.1)));
        }
    }
    (outline, count)
}

/// Share of light at this cosine that a face lets through: nothing if it is opaque, else what it neither reflects (Schlick) nor absorbs with its
/// tint.
fn light_through(clarity: f32, cosine: f32) -> f32 {
    if clarity <= 0.0 {
        return 0.0;
    }
    let reflected = 0.04 + 0.96 * (1.0 - cosine).clamp(0.0, 1.0).powi(5);
    (0.75 + 0.25 * clarity.min(1.0)) * (1.0 - reflected)
}

/// Directions towards points of all light sources, each with its share of the light.
fn lamps(key: Vec3, fineness: Fineness) -> impl Iterator<Item = (Vec3, f32)> {
    let (key_points, room_points) = (fineness.key_points, fineness.room_points);
    let distance = key.length();
    let across = key.cross(Vec3::Y).normalize_or(Vec3::X);
    let along = across.cross(key).normalize_or(Vec3::Z);
    let disc = |index: usize, count: usize| {
        let radius = ((index as f32 + 0.5) / count as f32).sqrt();
        Vec2::from_angle(index as f32 * GOLDEN_TURN) * radius
    };
    let bulbs = (0..key_points).map(move |index| {
        let at = disc(index, key_points);
        let toward = key / distance.max(1e-3) + (across * at.x + along * at.y) / distance.max(1.0);
        (toward.normalize(), fineness.key_share / key_points as f32)
    });
    // Points of the disc lifted to the dome: as dense as the floor sees them.
    // The lowest would throw shadows of any length; the dome ends at 23°.
    let room = (0..room_points).map(move |index| {
        let at = disc(index, room_points) * 0.92;
        let toward = Vec3::new(at.x, (1.0 - at.length_squared()).max(0.0).sqrt(), at.y);
        (toward, fineness.room_share / room_points as f32)
    });
    bulbs.chain(room)
}

/// The square of floor around all casters, with room for their shadows.
fn extent(casters: &[Caster], floor_height: f32) -> (Vec2, f32) {
    // Beyond, a piece is a speck far off, and the texture would get coarse.
    let limit = 5.0;
    let (mut low, mut high) = (Vec2::splat(limit), Vec2::splat(-limit));
    for point in casters.iter().flat_map(|caster| caster.corners) {
        let at = Vec2::new(point.x, point.z);
        let reach = (point.y - floor_height).clamp(0.0, limit) + 0.3;
        low = low.min(at - reach);
        high = high.max(at + reach);
    }
    let (low, high) = (low.max(Vec2::splat(-limit)), high.min(Vec2::splat(limit)));
    let half_side = (0.5 * (high - low).max_element()).max(0.1);
    (0.5 * (low + high), half_side)
}

/// Multiplies the texels whose centres lie in a convex outline. Faces that share an
/// edge share no texel and leave none out, else glass would show its mesh.
fn darken(layer: &mut [f32], side: usize, outline: &[Vec2], passes: f32) {
    // The first texel whose centre lies beyond; negative places become 0.
    let first = |edge: f32| ((edge + 0.5) as usize).min(side);
    let heights = outline.iter().map(|corner| corner.y);
    let top = heights.clone().fold(f32::INFINITY, f32::min);
    let bottom = heights.fold(f32::NEG_INFINITY, f32::max);
    for row in first(top)..first(bottom) {
        let y = row as f32 + 0.5;
        let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut p = outline[outline.len() - 1];
        for &q in outline {
            // From the same end for both neighbours, so both round alike.
            let (low, high) = if p.y <= q.y { (p, q) } else { (q, p) };
            if low.y < y && y <= high.y {
                let x = low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
                left = left.min(x);
                right = right.max(x);
            }
            p = q;
        }
        if left < right {
            let row = &mut layer[row * side..][..side];
            for texel in &mut row[first(left)..first(right)] {
                *texel *= passes;
            }
        }
    }
}

/// A tent of three texels each way.
fn smooth(picture: &mut [f32], side: usize) {
    for stride in [1, side] {
        let source = picture.to_vec();
        for index in stride..source.len() - stride {
            let sides = source[index - stride] + source[index + stride];
            picture[index] = 0.5 * source[index] + 0.25 * sides;
        }
    }
}

/// Shadows that leave the square end softly, and its border is plain floor.
fn fade_out(picture: &mut [f32], side: usize) {
    let ramp = |index: usize| {
        let from_border = index.min(side - 1 - index) as f32 / (0.06 * side as f32);
        0.5 - 0.5 * (PI * from_border.min(1.0)).cos()
    };
    let ramps: Vec<f32> = (0..side).map(ramp).collect();
    for (row, across) in picture.chunks_exact_mut(side).zip(&ramps) {
        for (texel, along) in row.iter_mut().zip(&ramps) {
            *texel = 1.0 - (1.0 - *texel) * across * along;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use super::*;

    const SIDE: usize = Fineness::STILL.side;

    #[test]
    fn neighbours_share_no_texel_and_leave_none_out() {
        let mut layer = vec![1.0; SIDE * SIDE];
        let rim: Vec<Vec2> = (0..9)
            .map(|k| 200.3 + 150.0 * Vec2::from_angle(TAU * k as f32 / 9.0))
            .collect();
        for k in 0..9 {
            let middle = Vec2::new(203.7, 198.2);
            darken(&mut layer, SIDE, &[middle, rim[k], rim[(k + 1) % 9]], 0.5);
        }
        assert!(layer.iter().all(|&texel| texel == 1.0 || texel == 0.5));
        let inside = |x: usize, y: usize| layer[y * SIDE + x] == 0.5;
        for (x, y) in (0..90).flat_map(|x| (0..90).map(move |y| (x, y))) {
            assert!(inside(155 + x, 155 + y), "hole at {x}, {y}");
        }
    }

    #[test]
    fn glass_shades_less_than_clay_and_far_floor_not_at_all() {
        let cast = |clarity| {
            let at = |x: f32, z: f32| Vec3::new(x, 0.2, z);
            let casters = [Caster {
                corners: [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 0.0)],
                clarity,
                one_sided: false,
            }];
            FloorShadow::cast(&casters, 0.0, Vec3::new(-3.0, 5.0, 2.0), Fineness::STILL).brightness
        };
        let (glass, clay) = (cast(1.0), cast(0.0));
        let middle = SIDE * SIDE / 2 + SIDE / 2;
        assert!(clay[middle] < 0.5 && glass[middle] > 0.85 && glass[middle] < 1.0);
        assert_eq!((clay[0], glass[SIDE * SIDE - 1]), (1.0, 1.0));
    }

    #[test]
    fn nothing_casts_nothing() {
        let shadow = FloorShadow::cast(&[], 0.0, Vec3::Y, Fineness::MOVING);
        assert!(shadow.half_side > 0.0 && shadow.brightness.iter().all(|&b| b == 1.0));
    }
}
