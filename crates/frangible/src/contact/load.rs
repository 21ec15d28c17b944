//! Where contacts touch and how hard they push each mode: ξ_i = φ_i(b) · n.

use glam::Vec3;

use super::Contact;
use crate::asset::Asset;
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
    /// nᵀ K n of the body there, 1/kg.
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
            inverse_effective_mass: asset
                .mass
                .inverse_effective_mass(point.as_dvec3(), normal.as_dvec3()),
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
        let weights = closest_on_triangle(point, x);
        let q = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let distance = q.distance_squared(point);
        if distance < best.0 {
            best = (distance, i, weights, q);
        }
    }
    (best.1, best.2, best.3)
}

/// Barycentric coordinates of the closest point of a triangle [Ericson 2005, §5.1.5].
fn closest_on_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> [f32; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let sum = va + vb + vc;
    [va / sum, vb / sum, vc / sum]
}
