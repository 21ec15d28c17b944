//! A fixed camera.

use frangible_recording::View;
use frangible_recording::glam::{Mat4, Vec3};
use kiss3d::camera::Camera3d;
use kiss3d::event::WindowEvent;
use kiss3d::glamx::Pose3;
use kiss3d::glamx::glam::camera::rh::proj::directx;
use kiss3d::window::Canvas;

/// A camera with a fixed [`View`], in the units of the stage.
pub struct StillCamera {
    eye: Vec3,
    view: Pose3,
    projection: Mat4,
    near: f32,
    far: f32,
}

impl StillCamera {
    /// Makes a camera for a view; `aspect` is the width of the picture over its height.
    #[must_use]
    pub fn new(view: &View, aspect: f32) -> Self {
        let distance = view.eye.distance(view.target);
        let (near, far) = (0.05 * distance, 40.0 * distance);
        Self {
            eye: view.eye,
            view: Pose3::look_at_rh(view.eye, view.target, view.up.normalize()),
            // Depth from 0 to 1, as wgpu clips.
            projection: directx::perspective(view.vertical_fov, aspect, near, far),
            near,
            far,
        }
    }

    /// Moves the picture by this share of half its width to the right and of half its height up.
    #[must_use]
    pub fn shifted(mut self, [right, up]: [f32; 2]) -> Self {
        self.projection = Mat4::from_translation(Vec3::new(right, up, 0.0)) * self.projection;
        self
    }
}

impl Camera3d for StillCamera {
    fn handle_event(&mut self, _: &Canvas, _: &WindowEvent) {}

    fn eye(&self) -> Vec3 {
        self.eye
    }

    fn view_transform(&self) -> Pose3 {
        self.view
    }

    fn transformation(&self) -> Mat4 {
        self.projection * self.view.to_mat4()
    }

    fn inverse_transformation(&self) -> Mat4 {
        self.transformation().inverse()
    }

    fn clip_planes(&self) -> (f32, f32) {
        (self.near, self.far)
    }

    fn update(&mut self, _: &Canvas) {}

    fn view_transform_pair(&self, _: usize) -> (Pose3, Mat4) {
        (self.view, self.projection)
    }
}
