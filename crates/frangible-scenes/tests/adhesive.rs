//! An adhesive holds the pieces of the body that it bonds.

use frangible::Material;
use frangible::glam::Vec3;
use frangible_bake::Shape;
use frangible_scenes::{
    Adhesive, BodySource, BodySpec, Place, Projectile, Region, Run, Scene, Support, bake, play,
    scene,
};

/// A tile in front of a block that is held, hit by a ball.
fn tile_on_a_block() -> Scene {
    let body = |name: &str, size: [f64; 3], material: &str| {
        let shape = BodySource::Shape(Shape::Box { size });
        BodySpec {
            modes: 20,
            resolution: Some(3000),
            ..BodySpec::new(name, shape, Material::preset(material).unwrap())
        }
    };
    let tile = BodySpec {
        place: Place::Centre(Vec3::new(0.0, 0.3, 0.0232)),
        ..body("tile", [0.1, 0.1, 0.006], "porcelain")
    };
    let block = BodySpec {
        place: Place::Centre(Vec3::new(0.0, 0.3, 0.0)),
        supports: vec![Support::clamped(Region::below(2, 0.01))],
        ..body("block", [0.12, 0.12, 0.04], "steel")
    };
    let mut scene = Scene::one_body(tile);
    scene.bodies.push(block);
    scene.projectiles = vec![Projectile::ball(0.1, 0.0145, 6.0)];
    scene.duration = 0.25;
    scene
}

/// Share of the mass of pieces that ends within 5 mm of where it broke.
fn stays(run: &Run) -> f64 {
    let recording = &run.recording;
    let last = recording.frame_count - 1;
    let (mut stays, mut all) = (0.0, 0.0);
    for (i, node) in recording.nodes.iter().enumerate() {
        if !node.name.contains("piece") {
            continue;
        }
        let mass = node.keep_extras.iter().find(|extra| extra.0 == "mass_kg");
        let mass = mass.map_or(0.0, |extra| extra.1);
        all += mass;
        let end = last.min(node.visible.end - 1);
        let [from, to] =
            [node.visible.start, end].map(|frame| recording.pose(i, frame).translation);
        if end == last && from.distance(to) < 5e-3 {
            stays += mass;
        }
    }
    assert!(all > 0.0, "nothing broke");
    stays / all
}

#[test]
fn an_adhesive_without_strength_or_patches_is_refused() {
    for (strength, patch, word) in [
        (0.0, 0.02, "strength"),
        (1e6, 0.0, "patches"),
        (1e6, f64::NAN, "patches"),
    ] {
        let mut scene = tile_on_a_block();
        scene.adhesive = Some(Adhesive { strength, patch });
        let message = scene.validate().unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }
}

/// The tile without a ball, at this distance from the block, m, bonded or not.
fn hung(gap: f32, patch: Option<f64>) -> Scene {
    let mut scene = tile_on_a_block();
    scene.projectiles.clear();
    scene.duration = 0.1;
    scene.bodies[0].place = Place::Centre(Vec3::new(0.0, 0.3, 0.023 + gap));
    scene.adhesive = patch.map(|patch| Adhesive {
        strength: 1e6,
        patch,
    });
    scene
}

#[test]
fn bodies_that_touch_or_overlap_by_rounding_are_bonded() {
    let baked = bake(&hung(0.0, None)).unwrap();
    let fall = |scene: &Scene| {
        let recording = play(scene, &baked, &mut |_| {}).unwrap().recording;
        let last = recording.frame_count - 1;
        let tile = recording.nodes.iter().position(|node| node.name == "tile");
        let tile = tile.expect("it is drawn");
        let [from, to] = [0, last].map(|frame| recording.pose(tile, frame).translation);
        from.distance(to)
    };
    let free = fall(&hung(2e-3, None));
    assert!(free > 0.03, "without an adhesive it falls {free} m");
    // A patch may be wider than the tile.
    for (gap, patch) in [
        (2e-3, 0.05),
        (0.0, 0.05),
        (1e-9, 0.5),
        (-1e-6, 0.05),
        (-2e-5, 0.5),
    ] {
        let fallen = fall(&hung(gap, Some(patch)));
        assert!(fallen < 1e-3, "a gap of {gap} m: it fell {fallen} m");
    }
}

#[test]
fn an_adhesive_that_bonds_nothing_is_refused() {
    let scene = hung(0.01, Some(0.02));
    let baked = bake(&scene).unwrap();
    let refused = play(&scene, &baked, &mut |_| {}).err();
    let message = refused.expect("10 mm are no layer").to_string();
    assert!(message.contains("bonds nothing"), "{message}");
}

#[test]
fn the_scenes_of_glued_sheets_break_and_keep_most_of_their_pieces() {
    // The pieces of a telephone fly with it.
    for (name, seconds, least) in [("phone", 0.9, None), ("tiles", 0.5, Some(0.5))] {
        let mut scene = scene(name).unwrap();
        scene.duration = scene.duration.min(seconds);
        let baked = bake(&scene).unwrap();
        let run = play(&scene, &baked, &mut |_| {}).unwrap();
        let pieces = run.breaks.iter().map(|b| b.masses.len()).sum::<usize>();
        println!("{name}: {pieces} pieces, {:.2} stays", stays(&run));
        assert!(pieces > 5, "{name}: {pieces}");
        assert!(least.is_none_or(|least| stays(&run) >= least), "{name}");
    }
}
