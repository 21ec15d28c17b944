//! Contacts on the body's surface, and their push on each mode: ξ_i = φ_i(b) · n.

use glam::Vec3;

use super::{Contact, Striker};
use crate::asset::{Asset, each_row};
use crate::body::Body;
use crate::mesh::SurfacePoint;

/// A contact on the body's surface, with its push on the modes.
#[derive(Clone, Debug)]
pub struct Touch {
    /// The contact, its point moved onto the surface.
    pub contact: Contact,
    /// Number of the surface triangle that it touches.
    pub triangle: u32,
    /// Weights of the corners of that triangle.
    pub weights: [f32; 3],
    /// ξ_i = φ_i(b) · n of every mode, 1/√kg.
    pub modal_shape: Vec<f64>,
    /// Radius of curvature of the body there, m; infinite where flat.
    pub curvature_radius: f64,
    /// nᵀ K n of the body there, 1/kg; zero where it is held, since it does not give way as a whole.
    pub inverse_effective_mass: f64,
}

impl Touch {
    /// φ_i(b) · v of every mode, 1/√kg.
    pub(crate) fn project(&self, body: &Body, v: Vec3) -> Vec<f64> {
        let at = SurfacePoint {
            triangle: self.triangle,
            weights: self.weights,
            position: self.contact.point,
        };
        projected(&body.asset, &at, v)
    }
}

/// All contacts of an impact as one modal load.
#[derive(Clone, Debug)]
pub struct Load {
    /// One per contact.
    pub touches: Vec<Touch>,
    /// Σ_k φ_i(b_k) · J_k of every mode, J the whole impulse with friction, N·s/√kg: the modal impulses.
    pub modal_impulse: Vec<f64>,
}

impl Load {
    /// Surface triangles that the contacts press on.
    pub(crate) fn pressed(&self) -> Vec<u32> {
        self.touches.iter().map(|t| t.triangle).collect()
    }
}

/// Finds each contact on the surface and sums up the modal impulses.
#[must_use]
pub fn modal_load<'a>(body: &Body, contacts: impl IntoIterator<Item = &'a Contact>) -> Load {
    let asset = &*body.asset;
    let modes = asset.modes.count();
    let mut modal_impulse = vec![0.0; modes];
    let mut touches = Vec::new();
    for contact in contacts {
        let normal = contact.normal.normalize();
        let at = body.prepared.surface.closest(contact.point);
        let modal_shape = projected(asset, &at, normal);
        for (sum, xi) in modal_impulse.iter_mut().zip(&modal_shape) {
            *sum += f64::from(contact.impulse) * xi;
        }
        if contact.friction != Vec3::ZERO {
            let friction = projected(asset, &at, contact.friction);
            modal_impulse
                .iter_mut()
                .zip(friction)
                .for_each(|(sum, xi)| *sum += xi);
        }
        touches.push(Touch {
            contact: Contact {
                point: at.position,
                normal,
                ..contact.clone()
            },
            triangle: at.triangle,
            weights: at.weights,
            modal_shape,
            curvature_radius: f64::from(asset.surface.curvature_radius[at.triangle as usize]),
            inverse_effective_mass: give(asset, &at, normal),
        });
    }
    Load {
        touches,
        modal_impulse,
    }
}

/// nᵀ K n of a body there, 1/kg; zero where it is held, since it does not give way as a whole.
pub(crate) fn give(asset: &Asset, at: &SurfacePoint, normal: Vec3) -> f64 {
    if asset.is_supported() {
        return 0.0;
    }
    let (point, normal) = (at.position.as_dvec3(), normal.as_dvec3());
    asset.mass.inverse_effective_mass(point, normal)
}

/// B: speed of approach that a unit impulse at one contact takes away at another one, 1/kg, or at itself if it is the same. Each is its
/// striker, its place and its unit normal.
pub(crate) fn inverse_mass(
    asset: &Asset,
    (a, at, normal): (&Striker, Vec3, Vec3),
    (b, there, along): (&Striker, Vec3, Vec3),
    is_same: bool,
) -> f64 {
    let mut inverse = 0.0;
    if !asset.is_supported() {
        let [a, b] = [(at, normal), (there, along)].map(|(at, n)| (at.as_dvec3(), n.as_dvec3()));
        inverse = asset.mass.inverse_mass_between(a, b);
    }
    if !is_same {
        return inverse + a.inverse_mass_between(b);
    }
    inverse += f64::from(a.inverse_effective_mass);
    // Neither gives way when a held body is hit by an immovable one; the body's own mass stands in.
    if inverse > 0.0 {
        inverse
    } else {
        1.0 / asset.mass.mass
    }
}

/// φ_i(b) · v of every mode.
fn projected(asset: &Asset, at: &SurfacePoint, v: Vec3) -> Vec<f64> {
    let mut sums = vec![0.0; asset.modes.count()];
    each_row(asset, at, |node, weight| {
        let push = (v * weight).to_array().map(f64::from);
        asset.modes.add_push(node, push, &mut sums);
    });
    sums
}
