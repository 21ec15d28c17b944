//! The rest pose: morph targets at their weights, then the skeleton as its nodes stand.

use glam::{DMat4, DVec3};
use gltf_json::{Index, Root, Skin};

use super::accessor::read;
use super::buffers::Buffers;
use crate::read::ReadError;

/// Transforms of the joints of a skin, from the mesh into the world.
pub(super) fn joints(
    root: &Root,
    buffers: &Buffers,
    skin: Index<Skin>,
    worlds: &[DMat4],
) -> Result<Vec<DMat4>, ReadError> {
    let bad = |problem: &str| ReadError::malformed(format!("skin {}", skin.value()), problem);
    let skin = root.get(skin).ok_or_else(|| bad("it does not exist"))?;
    let inverse = match skin.inverse_bind_matrices {
        Some(at) => read::<16>(root, buffers, at)?,
        None => Vec::new(),
    };
    if !inverse.is_empty() && inverse.len() < skin.joints.len() {
        return Err(bad("it has fewer inverse bind matrices than joints"));
    }
    let joint = |(k, node): (usize, &Index<gltf_json::Node>)| {
        let world = worlds.get(node.value());
        let world = world.ok_or_else(|| bad("one of its joints does not exist"))?;
        let inverse = inverse.get(k).map(DMat4::from_cols_array);
        Ok(*world * inverse.unwrap_or(DMat4::IDENTITY))
    };
    skin.joints.iter().enumerate().map(joint).collect()
}

/// Adds the displacements of morph targets, given with their weights, to rows of vectors.
pub(super) fn morph(
    root: &Root,
    buffers: &Buffers,
    targets: impl Iterator<Item = (usize, f64)>,
    rows: &mut [[f64; 3]],
) -> Result<(), ReadError> {
    for (accessor, weight) in targets {
        let moves = read::<3>(root, buffers, Index::new(accessor as u32))?;
        for (row, by) in rows.iter_mut().zip(moves) {
            *row = (DVec3::from(*row) + weight * DVec3::from(by)).to_array();
        }
    }
    Ok(())
}

/// The transform of each vertex by its joints; `sets`: accessors of joints and of their weights, four of each per vertex.
pub(super) fn skinned(
    root: &Root,
    buffers: &Buffers,
    sets: &[[usize; 2]],
    joints: &[DMat4],
    count: usize,
) -> Result<Vec<DMat4>, ReadError> {
    let mut sums = vec![(DMat4::ZERO, 0.0); count];
    for (set, accessors) in sets.iter().enumerate() {
        let [of, weights] = accessors.map(|at| read::<4>(root, buffers, Index::new(at as u32)));
        for (v, ((sum, total), (of, weights))) in
            sums.iter_mut().zip(of?.iter().zip(&weights?)).enumerate()
        {
            for (joint, &weight) in of.iter().zip(weights) {
                // Joints without weight need not exist.
                if weight.is_nan() || weight <= 0.0 {
                    continue;
                }
                let joint = joints.get(*joint as usize).ok_or_else(|| {
                    let problem = format!(
                        "joint {joint} of vertex {v} does not exist; the skin has {}",
                        joints.len()
                    );
                    ReadError::malformed(format!("JOINTS_{set}"), problem)
                })?;
                *sum += *joint * weight;
                *total += weight;
            }
        }
    }
    // Vertices without a weight follow the first joint.
    let first = joints.first().copied().unwrap_or(DMat4::IDENTITY);
    let matrix = |(sum, total): (DMat4, f64)| {
        if total > 0.0 {
            sum * (1.0 / total)
        } else {
            first
        }
    };
    Ok(sums.into_iter().map(matrix).collect())
}
