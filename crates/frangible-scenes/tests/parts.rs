//! Mesh files of several parts as bodies of one scene.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use frangible::glam::{Quat, Vec3};
use frangible_scenes::{
    BodySource, Files, LiveScene, Opened, Place, Scene, SceneError, bake_opened, open_scene_from,
    open_sources_from, parse_scene, scene_to_toml,
};

/// An OBJ of boxes with names, from their lowest and highest corners.
fn obj(boxes: &[(&str, [f64; 3], [f64; 3])]) -> String {
    let mut text = String::new();
    for (i, (name, low, high)) in boxes.iter().enumerate() {
        let _ = writeln!(text, "o {name}");
        for corner in 0..8 {
            let pick = |k: usize| {
                if corner >> k & 1 == 0 {
                    low[k]
                } else {
                    high[k]
                }
            };
            let _ = writeln!(text, "v {} {} {}", pick(0), pick(1), pick(2));
        }
        for face in [
            [1, 3, 4, 2],
            [5, 6, 8, 7],
            [1, 2, 6, 5],
            [3, 7, 8, 4],
            [1, 5, 7, 3],
            [2, 4, 8, 6],
        ] {
            let [a, b, c, d] = face.map(|v| v + 8 * i);
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
    }
    text
}

/// A lid that lies on a base, and a ball-sized knob 10 mm to the side of it, y up.
fn kit() -> String {
    obj(&[
        ("base", [0.0, 0.1, 0.0], [0.1, 0.2, 0.1]),
        ("lid", [0.0, 0.2, 0.0], [0.1, 0.23, 0.1]),
        ("knob", [0.11, 0.15, 0.03], [0.14, 0.19, 0.07]),
    ])
}

fn files(mesh: &str) -> Files {
    let mut files = BTreeMap::new();
    files.insert(PathBuf::from("kit.obj"), mesh.as_bytes().to_vec());
    Files::Given(files)
}

fn scene(keys: &str) -> Scene {
    let text = format!("name = \"s\"\n[[body]]\nname = \"kit\"\nmesh = \"kit.obj\"\n{keys}");
    parse_scene(&text, Path::new("")).unwrap_or_else(|e| panic!("{e}"))
}

fn divided(keys: &str) -> (Scene, Vec<Opened>) {
    open_scene_from(&scene(keys), &files(&kit())).unwrap()
}

fn names(scene: &Scene) -> Vec<&str> {
    scene.bodies.iter().map(|body| &*body.name).collect()
}

/// Centres of the boxes of the kit, m, from the middle of its volume.
fn from_middle() -> [Vec3; 3] {
    let centres = [
        Vec3::new(0.05, 0.15, 0.05),
        Vec3::new(0.05, 0.215, 0.05),
        Vec3::new(0.125, 0.17, 0.05),
    ];
    let volumes = [1e-3, 0.3e-3, 0.048e-3];
    let middle = (0..3).map(|i| volumes[i] * centres[i]).sum::<Vec3>() / 1.348e-3;
    centres.map(|c| c - middle)
}

#[test]
fn each_part_of_a_file_is_a_body_that_stands_as_the_file_has_it() {
    let (scene, opened) = divided("");
    assert_eq!(names(&scene), ["kit base", "kit lid", "kit knob"]);
    assert_eq!(opened.len(), 3);
    // Above the floor: the base stands, the rest is as much higher as in the file.
    for (body, above) in scene.bodies.iter().zip([0.0, 0.1, 0.05]) {
        let Place::Above { height, .. } = body.place else {
            panic!("{:?}", body.place);
        };
        assert!((height - above - 1e-4).abs() < 1e-7, "{height}");
    }
    let (dropped, _) = divided("drop = 1.0");
    let heights = dropped.bodies.iter().map(|body| match body.place {
        Place::Above { height, .. } => height,
        _ => f64::NAN,
    });
    for (height, above) in heights.zip([0.0, 0.1, 0.05]) {
        assert!((height - 1.0 - above).abs() < 1e-7);
    }
    let notes = opened.iter().flat_map(Opened::notes).cloned();
    let notes: Vec<String> = notes.collect();
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(notes[0].contains("3 closed parts") && notes[0].contains("`lid` (22 %)"));
}

#[test]
fn a_turned_kit_moves_and_turns_as_one_body_would() {
    let keys = "position = [1.0, 2.0, 3.0]\nrotation = { axis = \"z\", degrees = 90.0 }\nvelocity = [1.0, 0.0, 0.0]\nspin = [0.0, 0.0, 2.0]\n";
    let (scene, _) = divided(keys);
    let turn = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    for (body, offset) in scene.bodies.iter().zip(from_middle()) {
        let offset = turn * offset;
        let Place::Centre(centre) = body.place else {
            panic!("{:?}", body.place);
        };
        let off = centre - Vec3::new(1.0, 2.0, 3.0) - offset;
        assert!(off.length() < 1e-6, "{off}");
        let velocity = Vec3::X + Vec3::new(0.0, 0.0, 2.0).cross(offset);
        assert!(body.velocity.distance(velocity) < 1e-6);
        assert_eq!(body.spin, Vec3::new(0.0, 0.0, 2.0));
        assert!(body.rotation.abs_diff_eq(turn, 1e-6));
    }
}

#[test]
fn a_divided_scene_is_a_scene_like_any_other() {
    let (scene, opened) = divided("resolution = 5000");
    let text = scene_to_toml(&scene);
    let again = parse_scene(&text, Path::new("")).unwrap();
    assert_eq!(again, scene, "{text}");
    // Opened again, it has the same bodies, which are divided no further.
    let (same, reopened) = open_scene_from(&again, &files(&kit())).unwrap();
    assert_eq!(same, scene);
    assert_eq!(open_sources_from(&again, &files(&kit())).unwrap().len(), 3);
    assert_eq!(opened.len(), reopened.len());
    let tets = scene.bodies.iter().map(|body| match body.source {
        BodySource::Mesh { resolution, .. } => resolution.unwrap(),
        _ => 0,
    });
    // Shared by volume, but for a least number.
    assert_eq!(tets.collect::<Vec<_>>(), [3709, 1112, 1000]);
}

#[test]
fn the_choice_of_parts_gives_one_body_or_several() {
    for (keys, expected) in [
        (
            "parts = \"separate\"",
            vec!["kit base", "kit lid", "kit knob"],
        ),
        ("parts = \"auto\"", vec!["kit base", "kit lid", "kit knob"]),
        ("parts = \"largest\"", vec!["kit"]),
        ("part = \"knob\"", vec!["kit"]),
        ("parts = \"weld\"\ngap = 0.01", vec!["kit"]),
    ] {
        let (scene, opened) = divided(keys);
        assert_eq!(names(&scene), expected, "{keys}");
        if expected.len() == 1 {
            assert_eq!(open_sources_from(&scene, &files(&kit())).unwrap().len(), 1);
            assert!(opened[0].notes()[0].contains("3 closed parts"));
        }
    }
    let refused = |keys: &str| {
        let error = open_scene_from(&scene(keys), &files(&kit())).unwrap_err();
        error.to_string()
    };
    let message = refused("parts = \"weld\"\ngap = 0.002");
    assert!(
        message.contains("10.000 mm apart") && message.contains("0.0100 m"),
        "{message}"
    );
    let message = refused("part = \"foot\"");
    assert!(message.contains("`base`, `lid`, `knob`"), "{message}");
    // Where one body is wanted, several are refused with what can be done.
    let several = open_sources_from(&scene(""), &files(&kit())).unwrap_err();
    assert!(matches!(several, SceneError::SeveralParts { .. }));
    assert!(several.to_string().contains("--parts largest"));
}

#[test]
fn keys_of_parts_that_contradict_each_other_are_refused_by_name() {
    for (keys, wanted) in [
        ("gap = 0.1", "`gap`"),
        ("parts = \"largest\"\ngap = 0.1", "`gap`"),
        ("parts = \"weld\"\ngap = -0.1", "gap"),
        ("parts = \"largest\"\npart = \"a\"", "`part`"),
        ("parts = \"all\"", "separate, largest, weld"),
        ("parts = \"separate\"\nwall = 0.002", "wall"),
    ] {
        let text = format!("[[body]]\nmesh = \"kit.obj\"\n{keys}");
        let message = parse_scene(&text, Path::new("")).unwrap_err().to_string();
        assert!(message.contains(wanted), "{message}");
    }
    let message = parse_scene(
        "[[body]]\nshape = \"vase\"\nparts = \"largest\"",
        Path::new(""),
    );
    assert!(message.unwrap_err().to_string().contains("`parts`"));
}

#[test]
fn supports_hold_the_parts_that_they_reach() {
    let keys = "supports = [{ below = 0.11, side = \"y\" }, { group = \"lid\" }, { sphere = { centre = [0.14, 0.17, 0.05], radius = 0.001 } }]\n";
    let keys = keys.replace(
        "{ below = 0.11, side = \"y\" }",
        "{ box = [[-1, 0.0, -1], [1, 0.11, 1]] }",
    );
    let (scene, _) = divided(&keys);
    let held: Vec<usize> = scene.bodies.iter().map(|b| b.supports.len()).collect();
    assert_eq!(held, [1, 1, 1]);
    assert_ne!(scene.bodies[0].supports, scene.bodies[1].supports);
}

#[test]
fn a_projectile_flies_at_the_largest_part() {
    let boxes = obj(&[
        ("small", [0.0, 0.0, 0.0], [0.05, 0.05, 0.05]),
        ("large", [0.1, 0.0, 0.0], [0.2, 0.1, 0.1]),
    ]);
    let throw = "[[projectile]]\nmass = 0.1\nradius = 0.01\nspeed = 5.0\n";
    let (divided, _) = open_scene_from(&scene(throw), &files(&boxes)).unwrap();
    assert_eq!(divided.projectiles[0].target, 1);
}

#[test]
fn zones_of_weakness_ask_for_one_part() {
    let keys = "weakness = [{ box = [[0, 0, 0], [0.01, 0.01, 0.01]], strength = 0.5 }]\n";
    let error = open_scene_from(&scene(keys), &files(&kit())).unwrap_err();
    assert!(error.to_string().contains("`part`"), "{error}");
    assert_eq!(
        divided(&format!("part = \"lid\"\n{keys}")).0.bodies.len(),
        1
    );
}

#[test]
fn bodies_of_a_kit_start_side_by_side_and_rest_on_each_other() {
    let (scene, opened) = divided("resolution = 600\nmodes = 4");
    let baked = bake_opened(&scene, opened, &mut |_| {}).unwrap();
    for (body, volume) in baked.iter().zip([1e-3, 0.3e-3, 0.048e-3]) {
        let closed = body.report.as_ref().unwrap().closed_volume.unwrap();
        assert!((closed / volume - 1.0).abs() < 1e-6);
        // The lattice cuts off corners; the mesher allows for 3 %.
        let off = body.asset.mass().volume / volume - 1.0;
        assert!(off.abs() < 0.03, "{off}");
    }
    let mut live = LiveScene::new(&scene, &baked).unwrap();
    let start = from_middle();
    let places = |live: &LiveScene| -> Vec<Vec3> {
        let things = live.things().iter();
        things.map(|t| live.pose(t).unwrap().translation).collect()
    };
    let there = places(&live);
    for i in 1..3 {
        let apart = there[i] - there[0] - (start[i] - start[0]);
        // The centre of the tetrahedra is that of the box, but for the corners that the lattice cuts off.
        assert!(apart.length() < 1e-3, "{apart}");
    }
    // Just before the knob reaches the floor.
    while live.time() < 0.09 {
        live.step().unwrap();
    }
    let after = places(&live);
    // The lid stays on the base, and the knob falls.
    assert!((after[1] - after[0]).distance(there[1] - there[0]) < 2e-3);
    let fallen = there[2].y - after[2].y;
    assert!((0.03..0.05).contains(&fallen), "{fallen}");
}
