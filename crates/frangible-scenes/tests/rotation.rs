//! A body and its blow turned together break the same way, but for rounding: a turn rounds every f32 anew.
//!
//! Measured: turns change the cracks of 5 of 20 blows, of three places of ten. Mode shapes changed by at most two units in the last
//! place, nothing turned, change 10 of 40, among them all that the turns change.

use std::sync::Arc;

use crate::common::{block, blow, pane, steel_ball, stone_floor};
use frangible::glam::{DMat3, Mat3, Quat, Vec3};
use frangible::internals::asset::{AnalysisMesh, OuterSurface};
use frangible::internals::{TetMesh, impact_traced};
use frangible::{Asset, Breakable, Contact, FractureConfig};

/// The asset in a frame turned by q.
fn turned(asset: &Asset, q: Quat) -> Asset {
    let all = |points: &[Vec3]| -> Vec<Vec3> { points.iter().map(|&p| q * p).collect() };
    let mut new = asset.clone().into_parts();
    new.fracture = TetMesh::new(
        all(&asset.fracture().positions),
        asset.fracture().tets.clone(),
    )
    .into();
    let gradients = asset.analysis().barycentric_gradients.iter();
    new.analysis = AnalysisMesh {
        nodes: all(&asset.analysis().nodes),
        barycentric_gradients: gradients.map(|g| g.map(|v| q * v)).collect(),
        ..asset.analysis().clone()
    };
    new.surface = OuterSurface {
        normals: asset
            .surface()
            .normals
            .iter()
            .map(|n| n.map(|v| q * v))
            .collect(),
        ..asset.surface().clone()
    };
    let points = new.embedding.tets.iter_mut();
    for point in points.chain(&mut new.embedding.nodes) {
        point.offset = q * point.offset;
    }
    for cell in &mut new.cells {
        cell.points = all(&cell.points);
    }
    let m = asset.modes().count();
    for (node, rows) in new.modes.shapes.chunks_mut(3 * m).enumerate() {
        for mode in 0..m {
            let phi = |axis| asset.modes().row(3 * node + axis)[mode];
            let phi = q * Vec3::new(phi(0), phi(1), phi(2));
            for axis in 0..3 {
                rows[axis * m + mode] = phi[axis];
            }
        }
    }
    let rotation: DMat3 = Mat3::from_quat(q).as_dmat3();
    new.mass.inertia = rotation * asset.mass().inertia * rotation.transpose();
    Asset::from_parts(new)
}

/// Without the roughness of its cracks, which is fixed to the body's axes.
fn smooth(asset: &Asset) -> Asset {
    let mut smooth = asset.clone();
    smooth.parts_mut().material.roughness_amplitude = 0.0;
    smooth
}

#[test]
fn a_body_turned_with_its_blow_breaks_the_same_way() {
    let turns = [
        Quat::from_rotation_z(std::f32::consts::FRAC_PI_2),
        Quat::from_axis_angle(Vec3::new(0.3, -0.5, 0.8).normalize(), 1.1),
    ];
    let (mut same, mut all, mut broke, mut nodes_apart) = (0, 0, 0, Vec::new());
    for asset in [pane(), block()] {
        let asset = smooth(asset);
        let span = asset
            .fracture()
            .positions
            .iter()
            .copied()
            .fold(Vec3::ZERO, Vec3::max);
        for k in 0..5_u64 {
            let at = span * Vec3::new(0.17 * k as f32, 0.9 - 0.2 * k as f32, 1.0);
            let striker = if k % 2 == 0 {
                steel_ball(0.13)
            } else {
                stone_floor()
            };
            let toward = Vec3::new(0.1, 0.05 * k as f32, -1.0);
            let contact = blow(&asset, at, toward, 4.0 + 2.0 * k as f64, striker);
            let config = FractureConfig::default();
            let run = |asset: Asset, contact: Contact| {
                let body = Breakable::uniform(Arc::new(asset)).unwrap().body(k);
                impact_traced(&body, std::slice::from_ref(&contact), &config)
                    .unwrap()
                    .1
            };
            let plain = run(asset.clone(), contact.clone());
            for q in turns {
                let contact = Contact {
                    point: q * contact.point,
                    normal: q * contact.normal,
                    ..contact.clone()
                };
                let other = run(turned(&asset, q), contact);
                let cuts = |trace: &frangible::internals::CrackTrace| -> Vec<Vec<u32>> {
                    let tets = |c: &Vec<frangible::internals::ElementTrace>| {
                        c.iter().map(|e| e.tet).collect()
                    };
                    trace.cracks.iter().map(tets).collect()
                };
                all += 1;
                same += usize::from(cuts(&plain) == cuts(&other));
                broke += usize::from(plain.fragment_of_node.iter().any(|&f| f > 0));
                let pairs = plain.fragment_of_node.iter().zip(&other.fragment_of_node);
                let apart = pairs.filter(|(a, b)| a != b).count();
                nodes_apart.push(apart as f64 / plain.fragment_of_node.len().max(1) as f64);
            }
        }
    }
    println!(
        "{same} of {all} blows with the same cracks in the same order, {broke} broke; nodes in another fragment: {nodes_apart:.3?}"
    );
    assert!(broke > 5);
    // Rounding decides between cracks that are about to start at once: by builds that differ in rounding alone, 6 or 7 of 20 are the same.
    assert!(4 * same >= all, "{same} of {all}");
}
