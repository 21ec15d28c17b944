//! The sound of a baked body: its modes, and the modal forces of a force at a point.
//!
//! All data are derived from the asset when the body is prepared for sound, so that files are no larger and bakes take no longer.

use frangible::Asset;
use frangible::internals::asset::each_row;
use glam::{DVec3, Vec3};

use crate::body::{Mode, SoundBody};
use crate::damping::{AudibleDamping, Hold};
use crate::error::SoundError;
use crate::sphere::{EquivalentSphere, SurfaceElement};
use crate::waves::HARMONICS;

/// Highest frequency of modes that are kept, Hz; higher ones are hardly audible.
pub const HIGHEST: f64 = 16_000.0;

/// Sound data of a breakable body, or of a piece with its own modes, including its surface.
#[derive(Clone, Debug)]
pub struct AssetSound {
    body: frangible::Body,
    /// Modes that sound.
    count: usize,
}

impl AssetSound {
    /// Prepares a body for sound with its support: its modes up to [`HIGHEST`], and their motion on the equivalent sphere.
    ///
    /// # Errors
    /// The surface has no area, or a value of the asset is invalid.
    pub fn new(
        body: &frangible::Body,
        damping: &AudibleDamping,
        hold: Hold,
    ) -> Result<(Self, SoundBody), SoundError> {
        let asset = body.asset();
        let surface = elements(asset);
        let places: Vec<SurfaceElement> = surface.iter().map(|(_, element)| *element).collect();
        let sphere = EquivalentSphere::of(&places)?;
        let frequencies = asset.modes().eigenvalues.iter();
        let frequencies = frequencies.map(|l| l.max(0.0).sqrt() / std::f64::consts::TAU);
        let heard: Vec<f64> = frequencies.take_while(|&f| f <= HIGHEST).collect();
        let motion = motion(asset, &sphere, &surface, heard.len());
        let modes = heard.iter().zip(motion).map(|(&frequency, motion)| {
            // Rounding gives a loose piece modes of a fraction of a hertz, which nobody hears.
            Mode::new(frequency.max(1.0), motion, &sphere, damping, hold)
        });
        let sound = SoundBody {
            name: asset.name().to_owned(),
            mass: if asset.is_supported() {
                f64::INFINITY
            } else {
                asset.mass().mass
            },
            modes: modes.collect(),
            sphere,
        };
        sound.validate()?;
        let own = Self {
            body: body.clone(),
            count: heard.len(),
        };
        Ok((own, sound))
    }

    /// Returns the modal forces, 1/√kg, of one newton along a direction, applied to the surface point nearest to a point, m, in the body
    /// frame.
    #[must_use]
    pub fn push(&self, point: Vec3, direction: Vec3) -> Vec<f32> {
        let asset = self.body.asset();
        let at = self.body.nearest_on_surface(point);
        let mut sums = vec![0.0_f32; asset.modes().count()];
        each_row(asset, &at, |node, weight| {
            let push = (direction * weight).to_array();
            asset.modes().add_push(node, push, &mut sums);
        });
        sums.truncate(self.count);
        sums
    }

    /// Returns the motion of the surface point nearest to a point, m, in the body frame: the sum of the modes with these weights.
    #[must_use]
    pub fn motion(&self, point: Vec3, weights: &[f32]) -> Vec3 {
        let asset = self.body.asset();
        let at = self.body.nearest_on_surface(point);
        let mut sum = Vec3::ZERO;
        each_row(asset, &at, |node, weight| {
            let along = asset.modes().rows(node).map(|row| {
                let modes = row[..self.count].iter().zip(weights);
                modes.map(|(phi, weight)| phi * weight).sum::<f32>()
            });
            sum += weight * Vec3::from(along);
        });
        sum
    }
}

/// The triangles of the surface as elements, with their corners.
fn elements(asset: &Asset) -> Vec<([u32; 3], SurfaceElement)> {
    let positions = asset.surface_positions();
    let element = |&triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| positions[v as usize].as_dvec3());
        let element = SurfaceElement {
            place: (a + b + c) / 3.0,
            area: 0.5 * (b - a).cross(c - a),
        };
        (triangle, element)
    };
    asset.surface().triangles.iter().map(element).collect()
}

/// Motion of the first modes on the sphere: one list of harmonics for each.
///
/// The weights of the triangles are gathered at the nodes that carry the modes first, which are fewer.
fn motion(
    asset: &Asset,
    sphere: &EquivalentSphere,
    surface: &[([u32; 3], SurfaceElement)],
    modes: usize,
) -> Vec<Vec<f32>> {
    let nodes = asset.analysis().nodes.len();
    let mut slot = vec![usize::MAX; nodes];
    let mut carried: Vec<(usize, [DVec3; HARMONICS])> = Vec::new();
    let mut at_vertex = vec![None::<Box<[DVec3; HARMONICS]>>; asset.surface_positions().len()];
    for (triangle, element) in surface {
        let weights = sphere.weights(element);
        for &vertex in triangle {
            let sums = at_vertex[vertex as usize]
                .get_or_insert_with(|| Box::new([DVec3::ZERO; HARMONICS]));
            for (sum, weight) in sums.iter_mut().zip(weights) {
                *sum += weight / 3.0;
            }
        }
    }
    for (vertex, sums) in at_vertex.iter().enumerate() {
        let Some(sums) = sums else { continue };
        let point = &asset.embedding().nodes[vertex];
        let element = asset.analysis().elements[point.element as usize];
        for (&node, share) in element.iter().zip(point.shape_values()) {
            let node = node as usize;
            if slot[node] == usize::MAX {
                slot[node] = carried.len();
                carried.push((node, [DVec3::ZERO; HARMONICS]));
            }
            let into = &mut carried[slot[node]].1;
            for (into, sum) in into.iter_mut().zip(sums.iter()) {
                *into += *sum * f64::from(share);
            }
        }
    }
    let mut motion = vec![vec![0.0_f32; modes]; HARMONICS];
    for (node, weights) in &carried {
        let rows = asset.modes().rows(*node).map(|row| &row[..modes]);
        for (row, weight) in motion.iter_mut().zip(weights) {
            let [x, y, z] = weight.as_vec3().to_array();
            for (((sum, a), b), c) in row.iter_mut().zip(rows[0]).zip(rows[1]).zip(rows[2]) {
                *sum += x * a + y * b + z * c;
            }
        }
    }
    (0..modes)
        .map(|mode| motion.iter().map(|row| row[mode]).collect())
        .collect()
}
