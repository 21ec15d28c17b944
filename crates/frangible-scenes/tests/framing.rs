//! What a picture is about fills it.

use frangible::glam::{Mat4, Vec3, Vec4Swizzles as _};
use frangible_export::{Recording, View};
use frangible_scenes::{bake, play, scene};

const WIDTH: usize = 320;
const HEIGHT: usize = 240;

/// Share of a picture that is covered by nodes whose name has a word, and whether all of the covered part is within the picture.
fn covered(recording: &Recording, frame: usize, view: &View, word: &str) -> (f64, bool) {
    let camera = Mat4::perspective_rh(view.vertical_fov, 4.0 / 3.0, 1e-3, 1e3)
        * Mat4::look_at_rh(view.eye, view.target, view.up);
    let mut hit = vec![false; WIDTH * HEIGHT];
    let mut within = true;
    for (i, node) in recording.nodes.iter().enumerate() {
        if !node.visible.contains(&frame) || !node.name.contains(word) {
            continue;
        }
        let (pose, mesh) = (recording.pose(i, frame), &recording.meshes[node.mesh]);
        let corners = mesh.positions.iter().map(|&p| {
            let clip = camera * (pose.rotation * p + pose.translation).extend(1.0);
            let place = clip.xyz() / clip.w;
            within &= clip.w > 0.0 && place.x.abs() <= 1.0 && place.y.abs() <= 1.0;
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
    for (name, modes) in [("glass", 120), ("plate", 40), ("brick", 20), ("rabbit", 20)] {
        let mut scene = scene(name).unwrap();
        scene.bodies[0].modes = modes;
        let baked = bake(&scene, &mut |_| {}).unwrap();
        let run = play(&scene, &baked, &mut |_| {}).unwrap();
        for b in &run.breaks {
            println!("t {} before {:.4} after {:.4} cracks {:.4} work {:.4} paid {:.4} approach {:.4} strain {:.4}", b.time, b.kinetic_before, b.kinetic_after, b.cracks_together, b.work, b.energy_paid, b.report.approach_energy, b.report.peak_strain_energy);
            for c in &b.report.contacts { println!("  J {:.4} peak {:.0} dur {:.2e} depart {:.3} n {:?}", c.impulse, c.peak_force, c.duration, c.departure_speed, c.normal); }
            for c in &b.contacts { println!("  contact v {:.3} J {:.4} m {:.4}", c.approach_speed, c.impulse, 1.0 / c.striker.inverse_effective_mass); }
        }
        let recording = run.recording;
        {
            let (mut p, mut m) = (0.0_f64, 0.0_f64);
            for (i, n) in recording.nodes.iter().enumerate().skip(1) {
                let Some(mass) = n.keep_extras.iter().find(|e| e.0 == "mass_kg") else { continue };
                let d = recording.pose(i, 31).translation - recording.pose(i, 30).translation;
                p += mass.1 * f64::from(d.y) * 60.0; m += mass.1;
            }
            println!("mean speed up {:.3} of {m:.4} kg", p / m);
        }
        let moments = recording.labelled_moments();
        let body = recording.nodes[0].name.clone();
        let cover =
            moments.map(|(frame, _)| covered(&recording, frame, &recording.view_of(frame), &body));
        println!(
            "{name}: {cover:.3?} {:?} {:?}",
            recording.moments, recording.views
        );
        for i in 0..8.min(recording.nodes.len()) {
            let n = &recording.nodes[i];
            println!("{} {:?} {:?}", n.name, n.visible, [29, 30, 31, 35, 60, 480].map(|f| recording.pose(i, f).translation));
        }
        let [before, first, flying, resting] = cover;
        assert!((0.15..0.7).contains(&before.0) && before.1, "{name}");
        assert!((0.15..0.7).contains(&first.0) && first.1, "{name}");
        assert!(flying.0 > 0.08, "{name}");
        assert!(resting.0 > 0.08, "{name}");
    }
}
