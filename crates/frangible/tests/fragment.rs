//! Fragments tile the body that they are of, exactly, and are closed.

use std::collections::BTreeMap;

use crate::bodies::breaks;
use frangible::TriMesh;
use frangible::glam::{DMat3, DVec3, Vec3};

/// Directed edges that do not occur as often as their opposites.
fn unmatched_edges(mesh: &TriMesh) -> usize {
    let mut balance: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (i, j) in [(a, b), (b, c), (c, a)] {
            *balance.entry((i.min(j), i.max(j))).or_default() += if i < j { 1 } else { -1 };
        }
    }
    balance.values().filter(|&&n| n != 0).count()
}

#[test]
fn fragments_tile_the_body() {
    for b in breaks() {
        let (name, asset) = (&b.name, b.body.asset());
        let fragments = &b.fracture.fragments;
        let share = |of: &dyn Fn(&frangible::Fragment) -> f64, whole: f64| {
            fragments.iter().map(of).sum::<f64>() / whole - 1.0
        };
        let volume = share(&|f| f.mass.volume, asset.mass().volume);
        let emitted = share(&|f| f.mesh.volume(), asset.mass().volume);
        let mass = share(&|f| f.mass.mass, asset.mass().mass);
        assert!(volume.abs() < 1e-9, "{name}: volumes are off by {volume}");
        assert!(emitted.abs() < 1e-6, "{name}: meshes are off by {emitted}");
        assert!(mass.abs() < 1e-9, "{name}: masses are off by {mass}");
        assert!(b.fracture.report.volume_error.abs() < 1e-9);
        assert!(fragments.len() > 1, "{name}");
        for (i, f) in fragments.iter().enumerate() {
            assert!(
                f.mass.volume > 0.0 && f.mesh.volume() > 0.0,
                "{name}: piece {i} is turned inside out"
            );
            assert_eq!(unmatched_edges(&f.mesh), 0, "{name}: piece {i} is open");
            assert!(f.mesh.is_closed(), "{name}: piece {i} touches itself");
            let mut vertices = f.mesh.triangles.iter().flatten();
            assert!(vertices.all(|&v| (v as usize) < f.mesh.positions.len()));
            assert_eq!(f.mesh.normals.len(), f.mesh.triangles.len());
        }
    }
}

#[test]
fn the_largest_piece_comes_first() {
    for b in breaks() {
        let volumes = b.fracture.fragments.iter().map(|f| f.mass.volume);
        let volumes: Vec<f64> = volumes.collect();
        assert!(volumes.windows(2).all(|w| w[1] <= w[0]), "{}", b.name);
    }
}

#[test]
fn fragments_keep_the_bodys_centre_and_inertia() {
    for b in breaks() {
        let (name, asset) = (&b.name, b.body.asset());
        let size = asset.mass().volume.cbrt();
        let mut centre = DVec3::ZERO;
        let mut inertia = DMat3::ZERO;
        for f in &b.fracture.fragments {
            let (m, c) = (f.mass.mass, f.mass.centre);
            centre += m * c;
            let outer = DMat3::from_cols(c * c.x, c * c.y, c * c.z);
            let steiner = DMat3::from_diagonal(DVec3::splat(c.length_squared())) - outer;
            inertia += f.mass.inertia + m * steiner;
        }
        centre /= asset.mass().mass;
        let norm = |m: DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
        let error = norm(inertia - asset.mass().inertia) / norm(asset.mass().inertia);
        assert!(centre.length() < 1e-6 * size, "{name}: {centre} m");
        assert!(error < 1e-6, "{name}: inertia off by {error:e}");
    }
}

#[test]
fn colliders_lie_within_their_pieces() {
    for b in breaks() {
        for (i, f) in b.fracture.fragments.iter().enumerate() {
            let what = format!("{}: piece {i}", b.name);
            let corners = f.mesh.positions.iter().copied();
            let low = corners.clone().fold(Vec3::INFINITY, Vec3::min) - 1e-6;
            let high = corners.fold(Vec3::NEG_INFINITY, Vec3::max) + 1e-6;
            assert!(!f.cell_shares.is_empty(), "{what} has no collider");
            for (cell, points) in &f.cell_shares {
                assert!((*cell as usize) < b.body.asset().cells().len());
                for p in points {
                    let inside = p.cmpge(low).all() && p.cmple(high).all();
                    assert!(inside, "{what}, cell {cell}: {p} outside {low}..{high}");
                }
            }
        }
    }
}

#[test]
fn a_held_body_leaves_a_piece_where_it_is_held_and_others_fall() {
    let (mut seen, mut fallen) = (0, 0);
    for b in breaks().iter().filter(|b| b.name.starts_with("shelf")) {
        let fragments = &b.fracture.fragments;
        let portions = b.fracture.portions(&b.body, |_, _| true);
        for (fragment, portion) in fragments.iter().zip(&portions) {
            let portion = portion.as_ref().expect("it was wanted");
            let held = !portion.supported().is_empty();
            assert_eq!(fragment.supported, held, "{}", b.name);
        }
        assert!(fragments.iter().any(|f| f.supported), "{}", b.name);
        fallen += fragments.iter().filter(|f| !f.supported).count();
        seen += 1;
    }
    assert!(
        seen > 5 && fallen > 10,
        "{seen} breaks, {fallen} pieces fall"
    );
}
