//! Sound of pieces without their own modes: free plates of the same size, in closed form.
//!
//! A shard is approximated by a rectangular plate of the same mass, surface area and aspect ratio, whose frequencies Warburton gave in
//! closed form (The vibration of rectangular plates, Proc. Inst. Mech. Eng. 168, 1954). They are 5–14 % too high for a square plate, and a
//! shard is not a rectangle, so only the pitch range and the duration of the sound are realistic, not the individual tones. For thick
//! pieces, frequencies are reduced by shear and rotary inertia (Mindlin, to first order).

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3, Vec3};

use crate::body::{Mode, SoundBody};
use crate::damping::{AudibleDamping, Hold};
use crate::error::{SoundError, within};
use crate::of_asset::HIGHEST;
use crate::sphere::{EquivalentSphere, SurfaceElement};
use crate::waves::HARMONICS;

/// Material of a plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlateMaterial {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Damping of audible vibration.
    pub damping: AudibleDamping,
}

/// A free rectangular plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Length, width and thickness, m.
    pub sides: [f64; 3],
    /// Rotation from the plate's axes, along its length, width and thickness, to the body's frame.
    pub axes: DQuat,
    /// For each mode heard, the numbers of its bar modes along length and width.
    tones: Vec<[usize; 2]>,
    /// Mass, kg.
    mass: f64,
}

/// Modes of a plate that are kept, the lowest.
const MOST_TONES: usize = 12;

/// Bar modes along a side: two rigid ones and these many that bend.
const ALONG: usize = 7;

/// Points along a side at which the surface is taken.
const POINTS: usize = 14;

/// β of a free bar's modes: cosh β cos β = 1; from the third on (n + ½) π to six digits.
fn bar_root(bending: usize) -> f64 {
    match bending {
        1 => 4.730_040_744_862_704,
        2 => 7.853_204_624_095_838,
        n => (n as f64 + 0.5) * PI,
    }
}

/// Shape of the m-th mode of a free bar at x from −½ to ½ of its length, with a mean square of 1: rigid motions for 0 and 1. The ends of a
/// bar that bends then move by 2.
fn bar_shape(m: usize, x: f64) -> f64 {
    match m {
        0 => 1.0,
        1 => 12.0_f64.sqrt() * x,
        _ => {
            let beta = bar_root(m - 1);
            let (at, end) = (beta * x, 0.5 * beta);
            if m.is_multiple_of(2) {
                at.cos() / end.cos() + at.cosh() / end.cosh()
            } else {
                at.sin() / end.sin() + at.sinh() / end.sinh()
            }
        }
    }
}

/// Warburton's numbers of a bar mode: G, H and J of his Table 1, free edges.
fn warburton(m: usize) -> [f64; 3] {
    match m {
        0 => [0.0, 0.0, 0.0],
        1 => [0.0, 0.0, 12.0 / (PI * PI)],
        2 => [1.506, 1.248, 5.017],
        _ => {
            let n = m as f64 - 0.5;
            [
                n,
                n * n * (1.0 - 2.0 / (n * PI)),
                n * n * (1.0 + 6.0 / (n * PI)),
            ]
        }
    }
}

/// Angular frequency of a free plate's mode, rad/s.
fn tone([m, n]: [usize; 2], [a, b, h]: [f64; 3], material: &PlateMaterial) -> f64 {
    let nu = material.poisson_ratio;
    let ([gx, hx, jx], [gy, hy, jy]) = (warburton(m), warburton(n));
    let ratio = a / b;
    let square = gx.powi(4)
        + (gy * ratio).powi(4)
        + 2.0 * ratio * ratio * (nu * hx * hy + (1.0 - nu) * jx * jy);
    let modulus = material.youngs_modulus / (12.0 * (1.0 - nu * nu) * material.density);
    let number = PI * PI / (a * a) * square.sqrt(); // k² of the bending wave
    // Mindlin's wave to first order in (kh)²: rotation of the section, and shear with κ = 5/6.
    let slower = 1.0 + number * h * h / 12.0 * (1.0 + 2.0 / (5.0 / 6.0 * (1.0 - nu)));
    number * h * modulus.sqrt() / slower.sqrt()
}

impl Plate {
    /// Creates the plate of a shard from the triangles of its closed surface, m, relative to its centre of mass, and its mass, kg.
    ///
    /// # Errors
    /// The surface has no area or volume, or a value of the material is invalid.
    pub fn of_surface(
        name: impl Into<String>,
        surface: &[SurfaceElement],
        mass: f64,
        material: &PlateMaterial,
    ) -> Result<(Self, SoundBody), SoundError> {
        let area: f64 = surface.iter().map(|e| e.area.length()).sum();
        let range = "above zero";
        within(
            || "the area of a piece, m²,".into(),
            area,
            area > 0.0,
            range,
        )?;
        within(
            || "the mass of a piece, kg,".into(),
            mass,
            mass > 0.0,
            range,
        )?;
        let density = material.density;
        within(
            || "the density of a piece, kg/m³,".into(),
            density,
            density > 0.0,
            range,
        )?;
        let volume = mass / density;
        let ellipsoid = EquivalentSphere::of(surface)?;
        let semi_axes = ellipsoid.semi_axes();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| semi_axes[j].total_cmp(&semi_axes[i]));
        let stretch = semi_axes[order[0]] / semi_axes[order[1]];
        // Both faces and the rim make the surface: A h = V, 2 A + 2 (a + b) h = S.
        let mut face = 0.5 * area;
        for _ in 0..20 {
            let (a, b) = ((face * stretch).sqrt(), (face / stretch).sqrt());
            face = (0.5 * area - (a + b) * volume / face).max(0.15 * area);
        }
        let sides = [
            (face * stretch).sqrt(),
            (face / stretch).sqrt(),
            volume / face,
        ];
        let axis = |i: usize| ellipsoid.axes * DVec3::AXES[i];
        let (x, y) = (axis(order[0]), axis(order[1]));
        let axes = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y)));
        Self::new(name, sides, axes, material)
    }

    /// Creates a plate with these sides, m, and this rotation.
    ///
    /// # Errors
    /// A side or a value of the material is invalid.
    pub fn new(
        name: impl Into<String>,
        sides: [f64; 3],
        axes: DQuat,
        material: &PlateMaterial,
    ) -> Result<(Self, SoundBody), SoundError> {
        let range = "above zero";
        for side in sides {
            within(|| "a side of a plate, m,".into(), side, side > 0.0, range)?;
        }
        let (modulus, nu) = (material.youngs_modulus, material.poisson_ratio);
        within(
            || "Young's modulus of a plate, Pa,".into(),
            modulus,
            modulus > 0.0,
            range,
        )?;
        let fits = nu > -1.0 && nu < 0.5;
        within(
            || "Poisson's ratio of a plate".into(),
            nu,
            fits,
            "between -1 and 0.5",
        )?;
        let mass = material.density * sides.iter().product::<f64>();
        within(
            || "the mass of a plate, kg,".into(),
            mass,
            mass > 0.0,
            range,
        )?;
        let mut tones: Vec<([usize; 2], f64)> = Vec::new();
        for m in 0..ALONG + 2 {
            for n in 0..ALONG + 2 {
                let omega = tone([m, n], sides, material);
                if m + n >= 2 && omega > 0.0 && omega <= std::f64::consts::TAU * HIGHEST {
                    tones.push(([m, n], omega));
                }
            }
        }
        tones.sort_by(|a, b| a.1.total_cmp(&b.1));
        tones.truncate(MOST_TONES);
        let mut plate = Self {
            sides,
            axes,
            tones: Vec::new(),
            mass,
        };
        let surface = plate.surface();
        let sphere = EquivalentSphere::of(&surface)?;
        let mut motion = vec![vec![0.0_f32; HARMONICS]; tones.len()];
        for element in &surface {
            let weights = sphere.weights(element);
            let across = plate.axes * DVec3::Z;
            for (motion, (tone, _)) in motion.iter_mut().zip(&tones) {
                let shape = plate.shape(*tone, element.place);
                for (sum, weight) in motion.iter_mut().zip(weights) {
                    *sum += (weight.dot(across) * shape) as f32;
                }
            }
        }
        let modes = (tones.iter().zip(motion)).map(|((_, omega), motion)| {
            let frequency = omega / std::f64::consts::TAU;
            Mode::new(frequency, motion, &sphere, &material.damping, Hold::Free)
        });
        let body = SoundBody {
            name: name.into(),
            mass,
            modes: modes.collect(),
            sphere,
        };
        plate.tones = tones.into_iter().map(|(tone, _)| tone).collect();
        body.validate()?;
        Ok((plate, body))
    }

    /// Returns the modal forces, 1/√kg, of one newton along a direction at a point, m, in the body frame.
    #[must_use]
    pub fn push(&self, point: Vec3, direction: Vec3) -> Vec<f32> {
        let across = (self.axes * DVec3::Z).dot(direction.as_dvec3());
        let shape = |&tone: &[usize; 2]| (across * self.shape(tone, point.as_dvec3())) as f32;
        self.tones.iter().map(shape).collect()
    }

    /// Displacement of a mode at a point, 1/√kg.
    fn shape(&self, [m, n]: [usize; 2], place: DVec3) -> f64 {
        let place = self.axes.inverse() * place;
        let along = |x: f64, side: f64| (x / side).clamp(-0.5, 0.5);
        bar_shape(m, along(place.x, self.sides[0])) * bar_shape(n, along(place.y, self.sides[1]))
            / self.mass.sqrt()
    }

    /// Elements of both faces and the rim.
    fn surface(&self) -> Vec<SurfaceElement> {
        let [a, b, h] = self.sides;
        let step = |i: usize| (i as f64 + 0.5) / POINTS as f64 - 0.5;
        let mut surface = Vec::new();
        let mut put = |place: DVec3, area: DVec3| {
            surface.push(SurfaceElement {
                place: self.axes * place,
                area: self.axes * area,
            });
        };
        let parts = (POINTS * POINTS) as f64;
        for i in 0..POINTS {
            for side in [-1.0, 1.0] {
                for j in 0..POINTS {
                    let place = DVec3::new(a * step(i), b * step(j), 0.5 * side * h);
                    put(place, DVec3::Z * (side * a * b / parts));
                }
                let n = POINTS as f64;
                put(
                    DVec3::new(a * step(i), 0.5 * side * b, 0.0),
                    DVec3::Y * (side * a * h / n),
                );
                put(
                    DVec3::new(0.5 * side * a, b * step(i), 0.0),
                    DVec3::X * (side * b * h / n),
                );
            }
        }
        surface
    }
}
