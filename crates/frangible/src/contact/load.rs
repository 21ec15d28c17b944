//! Where contacts touch and how hard they push each mode: ξ_i = φ_i(b) · n.

use glam::Vec3;

use super::Contact;
use crate::asset::Asset;
use crate::mesh::closest_on_triangle;
use crate::stress::ShapeWeights;

/// A contact on the body's surface, with what its modes see of it.
#[derive(Clone, Debug)]
pub struct Touch {
    /// The contact, its point moved onto the surface.
    pub contact: Contact,
    /// ξ_i = φ_i(b) · n of every mode, 1/√kg.
    pub modal_shape: Vec<f64>,
    /// Radius of curvature of the body there, m; infinite where flat.
    pub curvature_radius: f64,
    /// nᵀ K n of the body there, 1/kg; zero where it is held, since it does not give way as a whole.
    pub inverse_effective_mass: f64,
}

/// All contacts of an impact as one modal load.
#[derive(Clone, Debug)]
pub struct Load {
    /// One per contact with an impulse.
    pub touches: Vec<Touch>,
    /// Σ_k φ_k ξ_{i,k} of every mode, N·s/√kg: the modal impulses.
    pub modal_impulse: Vec<f64>,
}

/// Finds each contact on the surface and sums up the modal impulses.
#[must_use]
pub fn modal_load(asset: &Asset, contacts: &[Contact]) -> Load {
    let modes = asset.modes.count();
    let mut modal_impulse = vec![0.0; modes];
    let mut touches = Vec::with_capacity(contacts.len());
    for contact in contacts.iter().filter(|c| c.impulse > 0.0) {
        let normal = contact.normal.normalize();
        let (triangle, corners, point) = closest_on_surface(asset, contact.point);
        let mut modal_shape = vec![0.0; modes];
        for (&node, corner) in asset.surface.triangles[triangle].iter().zip(corners) {
            let weights = ShapeWeights::values(&asset.embedding.nodes[node as usize]);
            let element =
                asset.analysis.elements[asset.embedding.nodes[node as usize].element as usize];
            for (&analysis_node, weight) in element.iter().zip(weights) {
                for axis in 0..3 {
                    let w = f64::from(corner * weight * normal[axis]);
                    let row = asset.modes.row(3 * analysis_node as usize + axis);
                    for (xi, &phi) in modal_shape.iter_mut().zip(row) {
                        *xi += w * f64::from(phi);
                    }
                }
            }
        }
        for (sum, xi) in modal_impulse.iter_mut().zip(&modal_shape) {
            *sum += f64::from(contact.impulse) * xi;
        }
        touches.push(Touch {
            contact: Contact {
                point,
                normal,
                ..*contact
            },
            modal_shape,
            curvature_radius: f64::from(asset.surface.curvature_radius[triangle]),
            inverse_effective_mass: if asset.is_supported() {
                0.0
            } else {
                asset
                    .mass
                    .inverse_effective_mass(point.as_dvec3(), normal.as_dvec3())
            },
        });
    }
    Load {
        touches,
        modal_impulse,
    }
}

/// Nearest point of the outer surface: triangle, weights of its corners, position.
fn closest_on_surface(asset: &Asset, point: Vec3) -> (usize, [f32; 3], Vec3) {
    let mut best = (f32::INFINITY, 0, [1.0, 0.0, 0.0], point);
    for (i, triangle) in asset.surface.triangles.iter().enumerate() {
        let x = triangle.map(|v| asset.fracture.positions[v as usize]);
        let weights =
            closest_on_triangle(x.map(Vec3::as_dvec3), point.as_dvec3()).map(|w| w as f32);
        let q = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let distance = q.distance_squared(point);
        if distance < best.0 {
            best = (distance, i, weights, q);
        }
    }
    (best.1, best.2, best.3)
}
