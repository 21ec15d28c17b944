//! Cracks follow scores. Share of the crack area in grooves, which are 23 % of the volume, over eight seeds: without kinks
//! 0.34 (dropped on a corner), 0.40 (hit in the middle) and 0.30 (hit hard), with them 0.72, 0.78 and 0.63; a bar without scores 0.25.

use std::sync::Arc;

use crate::common::{self, blow, steel_ball, stone_floor};
use frangible::glam::Vec3;
use frangible::internals::{CrackTrace, Fields, impact_traced};
use frangible::{Asset, Breakable, Contact, FractureConfig};
use frangible_bake::weakness::{self, Patch};
use frangible_scenes::{bake, scene};

/// Area over which s = 0 crosses a tetrahedron, m².
fn crossing_area(x: [Vec3; 4], s: [f32; 4]) -> f32 {
    let mut points: Vec<Vec3> = Vec::new();
    for [i, j] in [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] {
        if (s[i] < 0.0) != (s[j] < 0.0) {
            points.push(x[i].lerp(x[j], s[i] / (s[i] - s[j])));
        }
    }
    // Of four points in a plane, in any order, the area is that of the largest pairing of opposite corners.
    let area = |a: Vec3, b: Vec3| 0.5 * a.cross(b).length();
    match points[..] {
        [a, b, c] => area(b - a, c - a),
        [a, b, c, d] => [area(b - a, d - c), area(c - a, d - b), area(d - a, c - b)]
            .into_iter()
            .fold(0.0, f32::max),
        _ => 0.0,
    }
}

/// Area of the cracks inside the grooves and in all, m².
fn areas(asset: &Asset, grooves: &[Patch], trace: &CrackTrace) -> [f32; 2] {
    let mut sums = [0.0; 2];
    for cut in trace.cracks.iter().flatten() {
        let tet = cut.tet as usize;
        let area = crossing_area(asset.fracture().corners(tet), cut.values);
        let p = asset.fracture().centroid(tet);
        let inside = grooves.iter().any(|g| g.zone.contains(p));
        sums[0] += if inside { area } else { 0.0 };
        sums[1] += area;
    }
    sums
}

fn share(asset: &Arc<Asset>, fields: Fields, grooves: &[Patch], hit: Contact) -> f32 {
    let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
    let kind = kind.with_fields(fields).unwrap();
    let config = FractureConfig::default();
    let mut sums = [0.0; 2];
    let mut starts = Vec::new();
    for seed in 1..=4 {
        let (outcome, trace) =
            impact_traced(&kind.body(seed), std::slice::from_ref(&hit), &config).unwrap();
        let [inside, all] = areas(asset, grooves, &trace);
        sums = [sums[0] + inside, sums[1] + all];
        starts.push((trace.cracks.len(), common::pieces(&outcome)));
    }
    println!(
        "   {:.1} cm² in all; cracks, pieces: {starts:?}",
        1e4 * sums[1]
    );
    sums[0] / sums[1]
}

#[test]
fn a_scored_bar_breaks_along_its_grooves() {
    let mut scene = scene("chocolate").unwrap();
    scene.bodies[0].modes = 40;
    let asset = bake(&scene).unwrap()[0].asset.clone();
    let grooves = &scene.bodies[0].weakness;
    let inside = |e: usize| {
        let p = asset.fracture().centroid(e);
        grooves.iter().any(|g| g.zone.contains(p))
    };
    let volume = |e: usize| asset.fracture().volume(e);
    let all = 0..asset.fracture().tets.len();
    let of_volume =
        all.clone().filter(|&e| inside(e)).map(volume).sum::<f64>() / all.map(volume).sum::<f64>();
    println!(
        "edge {} m, {of_volume:.3} of the volume in grooves",
        asset.fracture().mean_edge()
    );
    let corner = Vec3::new(0.079, 0.039, 0.0);
    let middle = Vec3::new(0.003, 0.004, 0.0045);
    for (what, hit) in [
        (
            "dropped on a corner",
            blow(&asset, corner, -corner, 4.4, stone_floor()),
        ),
        (
            "hit in the middle",
            blow(&asset, middle, Vec3::NEG_Z, 2.0, steel_ball(0.05)),
        ),
        (
            "hit hard",
            blow(&asset, middle, Vec3::NEG_Z, 4.0, steel_ball(0.05)),
        ),
    ] {
        let scored = weakness::patched(Fields::default(), &asset, grooves).unwrap();
        let with = share(&asset, scored, grooves, hit.clone());
        let without = share(&asset, Fields::default(), grooves, hit);
        println!("{what}: {with:.3} of the area in grooves, {without:.3} without scores");
        assert!(
            with > 0.5 && with > 2.0 * without,
            "{what}: {with} {without}"
        );
    }
}
