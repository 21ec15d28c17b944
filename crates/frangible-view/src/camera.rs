//! A camera that circles its target, and the rays through its picture.

use frangible::glam::{Quat, Vec2, Vec3};
use frangible_recording::View;

/// A half line into the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, m.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

/// A camera on a sphere around its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    home: View,
    target: Vec3,
    distance: f32,
    /// Angle from +z towards +x, rad.
    turn: f32,
    /// Above the level, rad.
    lift: f32,
}

/// The steepest look down or up, rad: at the pole "right" would have no meaning.
const STEEPEST: f32 = 1.5;

/// Nearest and farthest, in units of the first distance: beyond, near things are cut off and far ones lost in the haze.
const RANGE: [f32; 2] = [0.15, 4.0];

impl Orbit {
    /// A camera that stands where this view does.
    #[must_use]
    pub fn new(view: View) -> Self {
        let away = view.eye - view.target;
        let distance = away.length().max(1e-3);
        Self {
            home: view,
            target: view.target,
            distance,
            turn: away.x.atan2(away.z),
            lift: (away.y / distance).clamp(-1.0, 1.0).asin(),
        }
    }

    /// Returns the initial view.
    #[must_use]
    pub fn home(&self) -> View {
        self.home
    }

    /// Moves the target to `middle`, and the camera so near that a thing with these half width and half height, m, just fits; the direction of view
    /// stays. `aspect` is width over height of the space for the picture.
    pub fn focus_on(&mut self, middle: Vec3, [width, height]: [f32; 2], aspect: f32) {
        let tangent = (0.5 * self.home.vertical_fov).tan();
        let needed = (height / tangent).max(width / (tangent * aspect.max(0.1)));
        self.target = middle;
        // Parts nearer than the middle look larger.
        self.distance = 1.05 * needed + 0.5 * height;
    }

    /// Takes the position of this view; the home view stays what it was.
    pub fn stand(&mut self, view: View) {
        *self = Self {
            home: self.home,
            ..Self::new(view)
        };
    }

    /// Back to the beginning.
    pub fn go_home(&mut self) {
        *self = Self::new(self.home);
    }

    /// Returns the current view.
    #[must_use]
    pub fn view(&self) -> View {
        View {
            eye: self.target + self.distance * self.away(),
            target: self.target,
            ..self.home
        }
    }

    fn away(&self) -> Vec3 {
        let turn = Quat::from_rotation_y(self.turn);
        turn * Quat::from_rotation_x(-self.lift) * Vec3::Z
    }

    /// Turns around the target, rad: the camera goes right and up.
    pub fn turn_by(&mut self, right: f32, up: f32) {
        self.turn = (self.turn + right) % std::f32::consts::TAU;
        self.lift = (self.lift + up).clamp(-STEEPEST, STEEPEST);
    }

    /// Moves the target along the picture, shares of the picture's height.
    pub fn pan_by(&mut self, right: f32, up: f32) {
        let height = 2.0 * self.distance * (0.5 * self.home.vertical_fov).tan();
        let [across, upward] = self.axes();
        self.target += height * (right * across + up * upward);
    }

    /// Goes nearer by this factor.
    pub fn zoom_by(&mut self, factor: f32) {
        if factor.is_finite() && factor > 0.0 {
            let first = self.home.eye.distance(self.home.target).max(1e-3);
            self.distance = (self.distance / factor).clamp(RANGE[0] * first, RANGE[1] * first);
        }
    }

    /// Position of a point in the picture, the inverse of [`Orbit::ray`]; none for a point behind the camera.
    #[must_use]
    pub fn place(&self, point: Vec3, aspect: f32, shift: [f32; 2]) -> Option<Vec2> {
        let tangent = (0.5 * self.home.vertical_fov).tan();
        let [right, up] = self.axes();
        let away = self.away();
        let d = point - (self.target + self.distance * away);
        let depth = -d.dot(away);
        let x = d.dot(right) / (depth * tangent * aspect) + shift[0];
        let y = d.dot(up) / (depth * tangent) + shift[1];
        (depth > 0.0).then(|| Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y))
    }

    /// Right and up in the picture.
    fn axes(&self) -> [Vec3; 2] {
        let away = self.away();
        let right = Vec3::Y.cross(away).normalize_or(Vec3::X);
        [right, away.cross(right)]
    }

    /// The ray through a place of the picture, shares of its width and height from the upper left. `aspect` is width over height; `shift` is the
    /// displacement of the picture, shares of half its width and height to the right and up.
    #[must_use]
    pub fn ray(&self, at: Vec2, aspect: f32, shift: [f32; 2]) -> Ray {
        let tangent = (0.5 * self.home.vertical_fov).tan();
        let x = (2.0 * at.x - 1.0 - shift[0]) * tangent * aspect;
        let y = (1.0 - 2.0 * at.y - shift[1]) * tangent;
        let [right, up] = self.axes();
        let away = self.away();
        Ray {
            origin: self.target + self.distance * away,
            direction: (x * right + y * up - away).normalize(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn somewhere() -> View {
        View {
            eye: Vec3::new(0.7, 0.9, 1.1),
            target: Vec3::new(0.1, 0.2, -0.1),
            up: Vec3::Y,
            vertical_fov: 0.55,
        }
    }

    #[test]
    fn it_stands_where_the_view_does_and_comes_home() {
        let mut camera = Orbit::new(somewhere());
        assert!(camera.view().eye.distance(somewhere().eye) < 1e-5);
        camera.turn_by(1.0, 0.2);
        camera.pan_by(0.3, -0.2);
        camera.zoom_by(1.7);
        assert!(camera.view().eye.distance(somewhere().eye) > 0.1);
        camera.go_home();
        assert!(camera.view().eye.distance(somewhere().eye) < 1e-5);
    }

    #[test]
    fn rays_go_through_what_is_drawn_there() {
        let camera = Orbit::new(somewhere());
        let (aspect, shift) = (1.6, [0.2, -0.1]);
        // A point of the world, projected as any camera does, shows under the ray through that place.
        let view = camera.view();
        let point = Vec3::new(0.25, 0.1, 0.05);
        let forward = (view.target - view.eye).normalize();
        let right = forward.cross(Vec3::Y).normalize();
        let up = right.cross(forward);
        let d = point - view.eye;
        let tangent = (0.5 * view.vertical_fov).tan();
        let x = d.dot(right) / d.dot(forward) / tangent / aspect + shift[0];
        let y = d.dot(up) / d.dot(forward) / tangent + shift[1];
        let at = Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y);
        let ray = camera.ray(at, aspect, shift);
        let miss = (point - ray.origin).cross(ray.direction).length();
        assert!(miss < 1e-5, "{miss} m");
        let place = camera
            .place(point, aspect, shift)
            .expect("before the camera");
        assert!(place.distance(at) < 1e-5, "{place}");
        let behind = view.eye - forward;
        assert_eq!(camera.place(behind, aspect, shift), None);
    }

    #[test]
    fn it_never_tips_over_nor_goes_out_of_sight() {
        let mut camera = Orbit::new(somewhere());
        camera.turn_by(0.0, 9.0);
        assert!(camera.view().eye.y - camera.view().target.y > 0.0);
        for factor in [1e9, 0.0, f32::NAN, 1e-9] {
            camera.zoom_by(factor);
            let distance = camera.view().eye.distance(camera.view().target);
            assert!((0.1..10.0).contains(&distance), "{distance}");
        }
    }
}
