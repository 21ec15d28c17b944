//! A crack's implicit surface s(p) = 0 `[G12 Eq. 6-10]`.
//!
//! `s(p) = p_y − A (N(p_x/ℓ, p_z/ℓ) − N(0))` in the crack's frame: origin at the centre of the element where it
//! started, y along its normal, N a 2D simplex noise with seeded offset; subtracting N(0) makes the start crossed.
//! Changes versus the paper: a steered crack (beyond the paper) keeps s at the nodes and extrapolates it from
//! element to element, turning until no shear acts across it; then only the noise comes from here.

use glam::Vec3;
use noise_functions::{Noise, Simplex};

use crate::rng::{Purpose, stream, uniform};
use crate::stress::perpendicular_axes;

/// Frame and roughness of one crack.
#[derive(Clone, Debug)]
pub(crate) struct CrackFrame {
    pub(crate) origin: Vec3,
    pub(crate) normal: Vec3,
    axes: (Vec3, Vec3),
    amplitude: f32,
    inverse_wavelength: f32,
    offset: [f32; 2],
    noise_seed: i32,
}

impl CrackFrame {
    pub(crate) fn new(
        origin: Vec3,
        normal: Vec3,
        amplitude: f64,
        wavelength: f64,
        seed: u64,
        element: u32,
    ) -> Self {
        let mut rng = stream(seed, Purpose::Roughness, element);
        // Offsets within 0..64 wavelengths keep the noise's arguments exact to 1e-5 in f32.
        let offset = [
            uniform(&mut rng) as f32 * 64.0,
            uniform(&mut rng) as f32 * 64.0,
        ];
        let noise_seed = (uniform(&mut rng) * f64::from(i32::MAX)) as i32;
        Self {
            origin,
            normal,
            axes: perpendicular_axes(normal),
            amplitude: amplitude as f32,
            inverse_wavelength: 1.0 / wavelength as f32,
            offset,
            noise_seed,
        }
    }

    /// A N(p), m: height of the roughness over the mean surface.
    pub(crate) fn roughness(&self, p: Vec3) -> f32 {
        if self.amplitude == 0.0 {
            return 0.0;
        }
        let d = (p - self.origin) * self.inverse_wavelength;
        let at = [
            d.dot(self.axes.0) + self.offset[0],
            d.dot(self.axes.1) + self.offset[1],
        ];
        self.amplitude * Simplex.seed(self.noise_seed).sample2(at)
    }

    /// s(p) of the plane with noise, m.
    pub(crate) fn planar(&self, p: Vec3) -> f32 {
        (p - self.origin).dot(self.normal) - (self.roughness(p) - self.roughness(self.origin))
    }
}
