//! What a picture is about fills it.

use frangible::glam::Vec3;
use frangible_export::{Recording, View};
use frangible_scenes::{bake, play, scene};

const WIDTH: usize = 320;
const HEIGHT: usize = 240;

/// Share of a picture that is covered by nodes whose name has a word, and whether all of the covered part is within the picture.
fn covered(recording: &Recording, frame: usize, view: &View, word: &str) -> (f64, bool) {
    let forward = (view.target - view.eye).normalize();
    let right = forward.cross(view.up).normalize();
    let up = right.cross(forward);
    let tangent = (0.5 * view.vertical_fov).tan();
    let mut hit = vec![false; WIDTH * HEIGHT];
    let mut within = true;
    for (i, node) in recording.nodes.iter().enumerate() {
        if !node.visible.contains(&frame) || !node.name.contains(word) {
            continue;
        }
        let (pose, mesh) = (recording.pose(i, frame), &recording.meshes[node.mesh]);
        let corners = mesh.positions.iter().map(|&p| {
            let d = pose.rotation * p + pose.translation - view.eye;
            let depth = d.dot(forward);
            let place = Vec3::new(d.dot(right) * 0.75, d.dot(up), 0.0) / (depth * tangent);
            within &= depth > 0.0 && place.x.abs() <= 1.0 && place.y.abs() <= 1.0;
            // Behind the eye nothing is seen.
            let place = if depth > 0.0 { place } else { Vec3::NAN };
            let (x, y) = (0.5 + 0.5 * place.x, 0.5 - 0.5 * place.y);
            Vec3::new(x * WIDTH as f32, y * HEIGHT as f32, 0.0)
        });
        let corners: Vec<Vec3> = corners.collect();
        for face in mesh
            .parts
            .iter()
            .flat_map(|part| part.indices.chunks_exact(3))
        {
            let [a, b, c] = [0, 1, 2].map(|k| corners[face[k] as usize]);
            if !(a + b + c).is_finite() {
                continue;
            }
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let range = |low: f32, high: f32, end: usize| {
                (low.floor().max(0.0) as usize)..(high.ceil().clamp(0.0, end as f32) as usize)
            };
            let whole = (b - a).cross(c - a).z;
            for y in range(low.y, high.y, HEIGHT) {
                for x in range(low.x, high.x, WIDTH) {
                    let p = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, 0.0);
                    let parts = [(a, b), (b, c), (c, a)].map(|(s, t)| (t - s).cross(p - s).z);
                    hit[y * WIDTH + x] |= parts.iter().all(|part| part * whole >= 0.0);
                }
            }
        }
    }
    let count = hit.iter().filter(|hit| **hit).count();
    (count as f64 / hit.len() as f64, within)
}

#[test]
fn each_moment_of_a_break_fills_its_picture() {
    let mut badly_framed = 0;
    for (name, modes) in [
        ("glass", 120),
        ("plate", 40),
        ("brick", 20),
        ("rabbit", 20),
        ("window", 40),
    ] {
        let mut scene = scene(name).unwrap();
        scene.bodies[0].modes = modes;
        let baked = bake(&scene, &mut |_| {}).unwrap();
        let recording = play(&scene, &baked, &mut |_| {}).unwrap().recording;
        let body = recording.nodes[0].name.clone();
        let cover = recording.labelled_moments().map(|(frame, _)| {
            let view = recording.view_of(frame);
            covered(&recording, frame, &view, &body)
        });
        println!("{name}: {cover:.3?}");
        let [before, first, flying, resting] = cover;
        let good = [
            (0.15..0.7).contains(&before.0) && before.1,
            (0.15..0.7).contains(&first.0),
            flying.0 > 0.08,
            resting.0 > 0.08,
        ];
        badly_framed += good.iter().filter(|good| !**good).count();
    }
    assert_eq!(badly_framed, 0);
}

#[test]
fn a_wall_ends_with_what_stands_around_its_hole() {
    let mut scene = scene("wall").unwrap();
    for body in &mut scene.bodies {
        body.modes = 20;
    }
    let baked = bake(&scene, &mut |_| {}).unwrap();
    let recording = play(&scene, &baked, &mut |_| {}).unwrap().recording;
    let (end, _) = recording.labelled_moments().into_iter().last().unwrap();
    let (share, _) = covered(&recording, end, &recording.view_of(end), "brick");
    println!("wall: {share:.3}");
    assert!((0.15..0.7).contains(&share), "{share}");
}
