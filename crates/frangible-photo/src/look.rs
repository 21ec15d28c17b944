//! Looks of materials from close by.

use frangible_recording::glam::{Vec3A, Vec4};
use frangible_recording::{Grain, SurfaceMaterial};
use noise_functions::modifiers::Fbm;
use noise_functions::{CellDistance, CellValue, Noise, Simplex};

/// Tilt of a fresh face of glass of which no more is known.
const BROKEN: f32 = 0.11;

/// The colour of frosted glass.
const FROST: Vec3A = Vec3A::new(0.80, 0.84, 0.83);

/// Shares of light that mist and hackle scatter, and that any crack within glass does.
const MIST: f32 = 0.35;
const HACKLE: f32 = 0.20;
const CRACK_HAZE: f32 = 0.12;

/// A surface as rays see it.
pub(crate) struct Look {
    color: Vec3A,
    roughness: f32,
    pub(crate) metallic: f32,
    /// If true, light passes through and is bent.
    clear: bool,
    /// Share of the light that passes a face of a surface with some opacity.
    pub(crate) opacity: f32,
    pub(crate) ior: f32,
    /// Absorption of red, green and blue per stage unit of the body, as an exponent.
    pub(crate) swallows: Vec3A,
    pub(crate) thin: bool,
    grain: Grain,
}

/// Optical properties of a point of a surface.
pub(crate) struct Skin {
    pub(crate) color: Vec3A,
    pub(crate) roughness: f32,
    /// Tilt of the normal, in the frame of the mesh.
    pub(crate) bump: Vec3A,
    /// Share of the light that is scattered inside a clear body.
    pub(crate) cloud: f32,
}

impl Look {
    /// `scale`: stage units per metre.
    pub(crate) fn of(surface: &SurfaceMaterial, scale: f32) -> Self {
        let [red, green, blue, opacity] = surface.base_color;
        let clear = surface.transmission > 0.0;
        let left = Vec3A::from(surface.attenuation_color).max(Vec3A::splat(1e-3));
        let swallows = if surface.attenuation_distance.is_finite() && !surface.thin {
            Vec3A::from(left.to_array().map(|part| -part.ln()))
                / (surface.attenuation_distance * scale)
        } else {
            Vec3A::ZERO
        };
        Self {
            color: Vec3A::new(red, green, blue),
            roughness: surface.roughness,
            metallic: surface.metallic,
            clear,
            opacity: if clear { 1.0 } else { opacity },
            ior: surface.ior,
            swallows,
            thin: surface.thin,
            grain: surface.grain,
        }
    }

    pub(crate) fn is_clear(&self) -> bool {
        self.clear || self.opacity < 1.0
    }

    /// The colour of clouds inside a clear body, and of its frosted faces.
    pub(crate) fn cloud_color(&self) -> Vec3A {
        match self.grain {
            Grain::Marked => FROST,
            _ => self.color,
        }
    }

    pub(crate) fn bends(&self) -> bool {
        self.clear
    }

    /// Share of the lamp's light that passes a clear face on its way to a shaded point.
    pub(crate) fn passes(&self, cosine: f32) -> f32 {
        let reflected = 0.04 + 0.96 * (1.0 - cosine).clamp(0.0, 1.0).powi(5);
        (1.0 - reflected)
            * if self.clear {
                0.97
            } else {
                1.0 - 0.5 * self.opacity
            }
    }

    /// The skin at a place of the mesh's frame, m, with a row of [`RecordedMesh::marks`](frangible_recording::RecordedMesh::marks).
    pub(crate) fn skin(&self, at: Vec3A, mark: Vec4) -> Skin {
        let even = Skin {
            color: self.color,
            roughness: self.roughness,
            bump: Vec3A::ZERO,
            cloud: 0.0,
        };
        match self.grain {
            Grain::Even => even,
            Grain::Broken => Skin {
                // Between the ridges a fresh face of glass is a mirror.
                bump: if self.clear { BROKEN } else { 0.34 } * lean(at, 0.0016, 2),
                ..even
            },
            Grain::Marked => {
                let (bump, cloud) = marked(at, mark);
                // Dust and the rims of scales show a crack within glass from all sides.
                let least = if self.thin { CRACK_HAZE } else { 0.0 };
                Skin {
                    bump,
                    cloud: cloud.max(least),
                    ..even
                }
            }
            Grain::Clay => {
                let patch = fractal(at, 0.011, 3);
                let speck = fractal(at, 0.0014, 3);
                let pore = smooth_step(0.42, 0.62, fractal(at + Vec3A::splat(0.31), 0.0026, 2));
                let pale = smooth_step(0.50, 0.72, fractal(at + Vec3A::splat(0.77), 0.0021, 2));
                let color = self.color * (1.0 + 0.20 * patch + 0.16 * speck);
                Skin {
                    color: color.lerp(Vec3A::new(0.60, 0.40, 0.28), 0.4 * pale)
                        * (1.0 - 0.55 * pore),
                    bump: 0.30 * lean(at, 0.0016, 2),
                    ..even
                }
            }
            Grain::Aggregate => {
                let cell = place(at, 0.009);
                let edge = CellDistance::default().sample3(cell);
                let stone = smooth_step(0.42, 0.34, edge);
                let shade = CellValue::default().sample3(cell);
                let mortar = self.color * (1.0 + 0.16 * fractal(at, 0.004, 3));
                let stones = self.color * (0.75 + 0.40 * shade)
                    + Vec3A::new(0.05, 0.03, 0.0) * (0.5 + shade);
                Skin {
                    color: mortar.lerp(stones, 0.8 * stone),
                    bump: (0.30 - 0.2 * stone) * lean(at, 0.0022, 2),
                    ..even
                }
            }
            Grain::Veined => {
                let warp = 0.012 * fractal(at + Vec3A::splat(0.7), 0.05, 3);
                let vein = 1.0 - fractal(at + Vec3A::splat(warp), 0.045, 4).abs() * 6.0;
                let cloud = fractal(at, 0.03, 3);
                let gray = self.color * Vec3A::new(0.42, 0.43, 0.46);
                Skin {
                    color: self.color.lerp(gray, 0.75 * vein.clamp(0.0, 1.0).powi(2))
                        * (1.0 + 0.06 * cloud),
                    ..even
                }
            }
            Grain::Cloudy => {
                let cloud = fractal(at, 0.03, 5);
                Skin {
                    cloud: 0.10 + 0.35 * smooth_step(-0.5, 0.6, cloud),
                    bump: 0.06 * lean(at, 0.012, 2),
                    ..even
                }
            }
        }
    }
}

/// Tilt of the normal of a crack face of glass, and the share of light that it scatters.
///
/// A mirror up to its radius, then mist, which takes up to 1.3 of that radius (10 and 13 flaws deep), then ridges along the crack's way, which widen with
/// the distance as ridges that run from one point do, from 0.03 to 0.25 mm.
fn marked(at: Vec3A, mark: Vec4) -> (Vec3A, f32) {
    let way = Vec3A::from_vec4(mark);
    let run = way.length();
    if run <= 0.0 {
        return (BROKEN * lean(at, 0.0016, 2), 0.0);
    }
    let (along, reached) = (way / run, run * mark.w);
    let mist = smooth_step(0.85, 1.1, reached);
    let hackle = smooth_step(1.2, 1.8, reached);
    let dimples = 0.16 * mist * (1.0 - hackle) * lean(at, 0.00025, 2);
    if hackle <= 0.0 {
        return (dimples, MIST * mist);
    }
    // The number of ridges about the start doubles wherever they have become twice as wide.
    let width = (0.06 * run).clamp(3e-5, 2.5e-4);
    let level = (run / width).log2().max(0.0);
    let ridges = |level: f32| {
        let count = level.exp2();
        lean(along * count + Vec3A::splat(0.15 * run / width), 1.0, 2)
    };
    let tilt = ridges(level.floor()).lerp(ridges(level.floor() + 1.0), level.fract());
    let across = tilt - along * tilt.dot(along);
    let depth = 0.18 + 0.14 * smooth_step(1.3, 4.0, reached);
    let cloud = MIST * mist * (1.0 - hackle) + HACKLE * hackle;
    (dimples + hackle * depth * across, cloud)
}

fn place(at: Vec3A, size: f32) -> [f32; 3] {
    (at / size).to_array()
}

/// Noise of several sizes, the largest `size` metres, about −1 to 1.
fn fractal(at: Vec3A, size: f32, octaves: u32) -> f32 {
    let noise: Fbm<Simplex> = Simplex.fbm(octaves, 0.5, 2.03);
    noise.sample3(place(at, size))
}

/// Tilt of a normal by bumps of this size, along each axis.
fn lean(at: Vec3A, size: f32, octaves: u32) -> Vec3A {
    let along = |seed: f32| fractal(at + Vec3A::splat(seed), size, octaves);
    Vec3A::new(along(0.0), along(3.17), along(7.31))
}

fn smooth_step(from: f32, to: f32, at: f32) -> f32 {
    let t = ((at - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
