//! Bodies with many branches: the modes that a blow follows by choice, and what follows the force, against all modes.

use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::blow::Blow;
use frangible::internals::stress::largest_eigenvalue;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::{BakeSpec, Shape, SolidShape, bake};

/// Modes that are kept.
const MODES: usize = 200;

/// Length of an arm, its radius and the hub's, m.
const ARM: f64 = 0.12;
const RADIUS: f64 = 0.008;
const HUB: f64 = 0.025;

/// Times that are looked at.
const TIMES: usize = 100;

/// A hub with eight equal arms, toward the corners of a cube.
fn jack() -> Asset {
    let mut solid = DistanceSolid::sphere(DVec3::ZERO, HUB);
    for corner in 0..8 {
        let sign = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let end = ARM * DVec3::new(sign(0), sign(1), sign(2)).normalize();
        solid = solid.smooth_union(DistanceSolid::capsule(DVec3::ZERO, end, RADIUS), 0.004);
    }
    let solid = SolidShape {
        tets: 8_000,
        ..SolidShape::new(Arc::new(solid))
    };
    let shape = Shape::Solid(solid);
    let mut material = Material::preset("glass").unwrap();
    // Every tetrahedron is a weak point: stresses are looked at everywhere.
    material.weak_point_density = 1e15;
    let spec = BakeSpec {
        modes: MODES,
        analysis: Some(shape.size_for(1500.0).unwrap()),
        ..BakeSpec::new("jack", shape, material)
    };
    bake(&spec).unwrap()
}

/// The largest tension of a blow at places about the root of the arm along (1, 1, 1) and on the hub, Pa.
fn peak(asset: &Asset, contact: &Contact) -> f32 {
    let body = Breakable::uniform(asset.clone()).unwrap().body(1);
    let config = FractureConfig::default();
    let blow = Blow::new(&body, std::slice::from_ref(contact), &config)
        .unwrap()
        .unwrap();
    let root = Vec3::splat(0.6 * HUB as f32);
    let near = |e: &u32| asset.fracture().centroid(*e as usize).distance(root) < 0.02;
    let tets: Vec<u32> = body.weak_tets().iter().copied().filter(near).collect();
    let (motion, step) = (blow.motion(), blow.time_step());
    let end = motion.begin(motion.steps(), step);
    let mut most = 0.0_f32;
    for time in 0..TIMES {
        let at = end * time as f64 / TIMES as f64;
        let at = motion.step_at(at, step).unwrap();
        for &tet in tets.iter().step_by(tets.len() / 25) {
            most = most.max(largest_eigenvalue(&blow.stress(&body, tet, at, &config)));
        }
    }
    most
}

#[test]
fn the_modes_that_a_blow_on_a_branch_follows_give_the_stress_that_all_modes_do() {
    let chosen = jack();
    let mut all = chosen.clone();
    all.parts_mut().modes.residual_modes = 0;
    let followed = chosen.modes().followed();
    // Fewer than eight bendings of each arm in both directions, and more than four.
    assert!((64..MODES).contains(&followed), "{followed}");
    let steel = Material::preset("steel").unwrap();
    let end = Vec3::splat((ARM / 3.0_f64.sqrt()) as f32);
    let across = Vec3::new(1.0, -1.0, 0.0).normalize();
    for (at, toward) in [
        (end - RADIUS as f32 * across, across),
        (end + RADIUS as f32 * end.normalize(), -end),
        (Vec3::new(0.0, 0.0, HUB as f32), Vec3::NEG_Z),
    ] {
        let ball = Striker::ball(&steel, 0.006, 0.01);
        let contact = Contact::strike(at, toward.normalize(), 4.0, ball);
        let [some, truth] = [&chosen, &all].map(|asset| peak(asset, &contact));
        println!(
            "{followed} of {MODES}: {:.4} of {:.1} MPa",
            some / truth,
            1e-6 * truth
        );
        assert!(
            (some / truth - 1.0).abs() < 0.03,
            "{} at {at}",
            some / truth
        );
    }
}
