//! Light sources.

use frangible_recording::View;
use frangible_recording::glam::{Vec2, Vec3, Vec3A};

use crate::random::{Random, disc_axes};
use crate::stage::key_light;

/// Radius of the key lamp over its distance: a soft box.
const KEY_RADIUS: f32 = 0.17;

/// Light that the key lamp gives a face turned to it.
const KEY: Vec3A = Vec3A::new(1.62, 1.54, 1.42);

/// Light from all sides: from the middle of the backdrop, from overhead and from the floor.
const HORIZON: Vec3A = Vec3A::new(0.30, 0.31, 0.325);
const OVERHEAD: Vec3A = Vec3A::new(0.52, 0.55, 0.60);
const BELOW: Vec3A = Vec3A::new(0.16, 0.155, 0.15);

/// The wall that the camera looks at, where the floor ends.
const WALL: Vec3A = Vec3A::new(0.150, 0.165, 0.190);

/// Blur of the lamps in the light on matt faces, over their distance: few paths would find sharp lamps, and would leave specks.
const MATT: f32 = 0.7;

/// A lamp that is seen in mirrors: a panel around a direction.
struct Panel {
    toward: Vec3A,
    across: Vec3A,
    along: Vec3A,
    /// Half its width and height over its distance.
    half: Vec2,
    light: Vec3A,
}

/// All light sources.
pub(crate) struct Lights {
    key: Vec3A,
    panels: [Panel; 3],
    backward: Vec3A,
}

impl Lights {
    /// The lights of a view in stage units.
    pub(crate) fn new(view: &View) -> Self {
        let away = Vec3::new(view.eye.x, 0.0, view.eye.z);
        let backward: Vec3A = away.normalize_or(Vec3::Z).into();
        let right = Vec3A::Y.cross(backward);
        let key = Vec3A::from(key_light(view)).normalize();
        let panel = |toward: Vec3A, half: [f32; 2], light: [f32; 3]| {
            let toward = toward.normalize();
            let across = Vec3A::Y.cross(toward).normalize_or(right);
            Panel {
                toward,
                across,
                along: toward.cross(across),
                half: half.into(),
                light: light.into(),
            }
        };
        let panels = [
            panel(key, [0.22, 0.30], [11.0, 10.5, 9.8]),
            // A tall strip on the right, cooler.
            panel(
                4.0 * right + 1.6 * Vec3A::Y + 1.4 * backward,
                [0.10, 0.62],
                [3.0, 3.3, 3.7],
            ),
            // A rim light from behind.
            panel(
                2.4 * right + 2.6 * Vec3A::Y - 4.0 * backward,
                [0.55, 0.16],
                [5.0, 5.0, 5.0],
            ),
        ];
        Self {
            key,
            panels,
            backward,
        }
    }

    /// A direction towards a point of the key lamp.
    pub(crate) fn toward_key(&self, random: &mut Random) -> Vec3A {
        let [x, y] = random.disc();
        let [across, along] = disc_axes(self.key);
        (self.key + KEY_RADIUS * (x * across + y * along)).normalize()
    }

    /// Light from the key lamp on a face whose normal makes this cosine with it, before it is shaded.
    pub(crate) fn key(&self, cosine: f32) -> Vec3A {
        KEY * cosine.max(0.0)
    }

    /// Light from a direction for a matt face: all but the key lamp, which is looked for on purpose.
    pub(crate) fn room(&self, toward: Vec3A) -> Vec3A {
        let panels = self.panels[1..]
            .iter()
            .map(|panel| panel.seen(toward, MATT));
        backdrop(toward) + panels.sum::<Vec3A>()
    }

    /// Light that a mirror sees in a direction. `blur` is the lamps' blur over their distance.
    pub(crate) fn mirrored(&self, toward: Vec3A, blur: f32) -> Vec3A {
        let panels = self.panels.iter().map(|panel| panel.seen(toward, blur));
        // Glass that light goes straight through shows the wall behind it. Behind the camera the room is dim, so that glass shows no veil.
        let ahead = (-1.6 * toward.dot(self.backward)).clamp(0.0, 1.0);
        let behind = 1.0 - 0.45 * toward.dot(self.backward).max(0.0) * (1.0 - toward.y.max(0.0));
        let room = (backdrop(toward) * behind).lerp(backdrop_seen(toward), ahead);
        room + panels.sum::<Vec3A>()
    }
}

impl Panel {
    fn seen(&self, toward: Vec3A, blur: f32) -> Vec3A {
        let ahead = toward.dot(self.toward);
        if ahead <= 0.0 {
            return Vec3A::ZERO;
        }
        let at = Vec2::new(toward.dot(self.across), toward.dot(self.along)) / ahead;
        // A soft border, the wider the more it is blurred; as much light on a larger area.
        let half = self.half + blur;
        let border = 0.16 * self.half.min_element() + 1.6 * blur;
        let edge = ((half - at.abs()) / border).clamp(Vec2::ZERO, Vec2::ONE);
        let area = (self.half.x * self.half.y) / (half.x * half.y);
        // Brighter in the middle than at the edge, as a soft box is.
        let glow = 1.0 - 0.35 * (at / half).length_squared().min(1.0);
        self.light * (edge.x * edge.y * glow * area)
    }
}

/// Light of the backdrop: brighter where the floor ends than overhead.
pub(crate) fn backdrop(toward: Vec3A) -> Vec3A {
    if toward.y >= 0.0 {
        let up = toward.y.min(1.0);
        HORIZON.lerp(OVERHEAD, up * up)
    } else {
        HORIZON.lerp(BELOW, (-4.0 * toward.y).min(1.0))
    }
}

/// The backdrop as the camera sees it: darker upwards.
pub(crate) fn backdrop_seen(toward: Vec3A) -> Vec3A {
    WALL * (1.0 - 1.1 * toward.y.max(0.0)).max(0.4)
}
