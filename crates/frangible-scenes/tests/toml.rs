//! Scene files: what they say, what they refuse, and that writing one loses nothing.

use std::path::Path;

use frangible::glam::{Quat, Vec3};
use frangible::internals::{CrackPath, CrackTiming};
use frangible::{FractureConfig, Material};
use frangible_bake::weakness::{Channel, Paint, Patch, Zone};
use frangible_bake::{Shape, Station};
use frangible_scenes::{
    Axis, BodySource, BodySpec, FileWish, MaterialEdit, Place, Projectile, ProjectileKind, Region,
    SCENE_NAMES, Scene, Support, parse_scene, read_scene, scene, scene_of_file, scene_to_toml,
};

fn parsed(text: &str) -> Scene {
    parse_scene(text, Path::new("folder")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn refused(text: &str) -> String {
    let message = parse_scene(text, Path::new("folder"))
        .expect_err(text)
        .to_string();
    assert_eq!(message.lines().count(), 1, "{message}");
    message
}

const LEAST: &str = "[[body]]\nshape = \"vase\"\n";

#[test]
fn every_built_in_scene_survives_writing_and_reading() {
    for name in SCENE_NAMES {
        let scene = scene(name).unwrap();
        let text = scene_to_toml(&scene);
        assert_eq!(parsed(&text), scene, "{text}");
    }
}

/// Every field away from its default, with numbers that are hard to print.
fn intricate() -> Scene {
    let mut material = Material::preset("brick").unwrap();
    material.strength = 0.1 + 0.2;
    material.density = 1e-300;
    let mut own = Material::preset("glass").unwrap();
    own.name = "my \"own\"\\\n\u{1}".into();
    let profile = vec![
        Station::sharp([0.0, 0.0], [0.0, 1.0 / 300.0]),
        Station::smooth([0.1, 0.0], [0.09, 1e-3]),
    ];
    let mesh = BodySource::Mesh {
        path: Path::new("folder").join("a mesh.stl"),
        size: Some(0.1 + 0.02),
        up: Axis::X,
        resolution: Some(12_345),
        wall: Some(0.003),
    };
    let mut first = BodySpec::new(
        "first",
        BodySource::Shape(Shape::Revolution { profile }),
        own,
    );
    first.place = Place::Above {
        height: 1.0 / 3.0,
        over: [0.1, -1e-7],
    };
    first.rotation = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let mut second = BodySpec::new("second", mesh, material);
    second.place = Place::Centre(Vec3::new(1.0 / 3.0, 2.0, -7e-5));
    second.velocity = Vec3::new(0.1, 0.2, 0.3);
    second.spin = Vec3::new(-0.0, 1e-20, 3.0);
    second.modes = 7;
    let mut third = BodySpec::new(
        "third",
        BodySource::Asset(Path::new("folder").join("b.frangible")),
        Material::preset("porcelain").unwrap(),
    );
    third.place = Place::Standing { over: [3.0, -2.0] };
    third.weibull_modulus = Some(1e2 / 3.0);
    let zones = [
        Zone::Box([Vec3::ZERO, Vec3::new(0.1, -0.2, 1.0 / 3.0)]),
        Zone::Sphere {
            centre: Vec3::X,
            radius: 0.1,
        },
        Zone::HalfSpace {
            point: Vec3::splat(-1e-5),
            normal: Vec3::new(0.3, 0.0, -7.0),
        },
        Zone::Tube {
            line: vec![Vec3::ZERO, Vec3::Y, Vec3::new(0.1, 0.2, 0.7)],
            radius: 1.0 / 3.0,
        },
    ];
    third.weakness = zones.map(|zone| Patch::of_strength(zone, 0.1)).to_vec();
    third.weakness[1].strength = None;
    third.weakness[1].toughness = Some(2.0);
    third.weakness[2].weak_points = Some(0.0);
    third.paint = vec![
        Paint::of_strength(Channel::Green, [1.0 / 3.0, 1.0]),
        Paint {
            channel: Channel::Alpha,
            strength: None,
            toughness: Some([1.0, 7.0]),
            weak_points: Some([0.0, 0.1]),
        },
    ];
    third.rescale.size = Some(1.0 / 3.0);
    let mut edit = MaterialEdit::preset("stone");
    edit.name = Some("soft “stone”".into());
    (edit.numbers[0], edit.numbers[5]) = (Some(1e9 / 3.0), Some(1e6));
    edit.rise_time = Some(1e-5);
    third.rescale.material = Some(edit);
    let mut scene = Scene::one_body(first);
    scene.name = "intricate".into();
    scene.summary = "tabs\tand “quotes”".into();
    scene.bodies.extend([second, third]);
    scene.projectiles = vec![
        Projectile::ball(0.1, 0.01, 3.3),
        Projectile {
            kind: ProjectileKind::Hammer { crown: 0.061 },
            material: "rubber".into(),
            target: 2,
            at: Vec3::new(0.1, 0.7, 1.0 / 3.0),
            toward: Vec3::new(0.3, -0.1, 0.7),
            ..Projectile::ball(1.0 / 7.0, 0.02, 9.0)
        },
    ];
    scene.floor = None;
    scene.seed = u64::MAX;
    scene.duration = 1.0 / 7.0;
    scene.look_from = Vec3::new(0.1, 0.2, 0.3);
    scene.fracture = FractureConfig::as_in_the_paper();
    scene.fracture.crumb_share = 1.0 / 3.0;
    scene.output.glb = FileWish::Named("a.glb".into());
    scene.output.picture = FileWish::No;
    scene.output.contact_sheet = FileWish::Yes;
    scene.output.seeds = 4;
    scene
}

#[test]
fn an_intricate_scene_survives_writing_and_reading() {
    let mut scene = intricate();
    let absolute = |text: &str| parse_scene(text, Path::new(""));
    let text = scene_to_toml(&scene);
    assert_eq!(absolute(&text).unwrap(), scene, "{text}");
    scene.fracture.timing = CrackTiming::TimeResolved { speed: 0.1 + 0.2 };
    scene.fracture.path = CrackPath::Steered {
        turning_length: 1.0 / 3.0,
    };
    scene.floor = Some("wood".into());
    let text = scene_to_toml(&scene);
    assert_eq!(absolute(&text).unwrap(), scene, "{text}");
}

#[test]
fn the_smallest_scene_is_a_porcelain_body_standing_on_stone() {
    let scene = parsed(LEAST);
    assert_eq!(scene.bodies.len(), 1);
    let body = &scene.bodies[0];
    assert_eq!(body.source, BodySource::Shape(Shape::vase()));
    assert_eq!(body.material.name, "porcelain");
    assert_eq!(body.place, Place::Standing { over: [0.0; 2] });
    assert_eq!(scene.floor.as_deref(), Some("stone"));
    assert!(scene.projectiles.is_empty());
}

#[test]
fn turns_are_about_the_axes_of_the_world_one_after_the_other() {
    let rotation = |value: &str| parsed(&format!("{LEAST}rotation = {value}")).bodies[0].rotation;
    let both = rotation("[{ axis = \"x\", degrees = 90 }, { axis = [0, 0, 3], degrees = 90.0 }]");
    // About x: y goes to z, which the turn about z leaves; z goes to −y, and that to x.
    assert!((both * Vec3::Y - Vec3::Z).length() < 1e-6, "{both}");
    assert!((both * Vec3::Z - Vec3::X).length() < 1e-6, "{both}");
    let exact = rotation("{ quaternion = [0.6, 0, 0, 0.8] }");
    assert_eq!(exact, Quat::from_xyzw(0.6, 0.0, 0.0, 0.8));
}

#[test]
fn paths_are_relative_to_the_file_and_the_ending_tells_what_is_up() {
    for (file, up) in [
        ("a.stl", Axis::Z),
        ("b.OBJ", Axis::Y),
        ("c.ply", Axis::Z),
        ("d.glb", Axis::Y),
    ] {
        let scene = parsed(&format!("[[body]]\nmesh = \"{file}\""));
        let BodySource::Mesh {
            path,
            up: found,
            size,
            ..
        } = &scene.bodies[0].source
        else {
            panic!("no mesh");
        };
        assert_eq!(
            (path.as_path(), *found),
            (Path::new("folder").join(file).as_path(), up)
        );
        assert_eq!(*size, None);
    }
}

#[test]
fn a_misspelt_key_is_named_with_its_line_and_the_nearest() {
    for (text, expected) in [
        (
            "name = \"a\"\n\n[[body]]\nshape = \"vase\"\n\nmaterials = \"glass\"\n",
            "scene line 6: unknown key `materials`, did you mean `material`?",
        ),
        (
            "[[bodi]]\nshape = \"vase\"",
            "scene line 1: unknown key `bodi`, did you mean `body`?",
        ),
        (
            "[[body]]\nshape = \"vase\"\nmaterial = { preset = \"glass\", strengh = 3 }",
            "scene line 3: unknown key `strengh`, did you mean `strength`?",
        ),
        (
            "[[body]]\nshape = \"vasse\"",
            "scene line 2: unknown name `vasse`, did you mean `vase`?",
        ),
        (
            "[[body]]\nshape = \"vase\"\n[fracture]\npath = { steerd = { turning_length = 1 } }",
            "scene line 4: unknown name `steerd`, did you mean `steered`?",
        ),
        // Ways that are gone are answered with those that remain.
        (
            "[[body]]\nshape = \"vase\"\n[pieces]\nmethod = \"quasi_static\"",
            "scene line 4: unknown name `quasi_static`; known here: auto, parent_modes, reanalysis",
        ),
        (
            "[[body]]\nshape = \"vase\"\n[pieces]\nmethod = \"modal_proxy\"",
            "scene line 4: unknown name `modal_proxy`; known here: auto, parent_modes, reanalysis",
        ),
        (
            "[[body]]\nshape = \"vase\"\nmaterial = \"porcelan\"",
            "scene line 3: unknown material `porcelan`; materials: glass, ",
        ),
        (
            "[[body]]\nshape = \"vase\"\n[[projectile]]\nmass = 1\nradius = 1\nspeed = 1\ntarget = \"sceen\"",
            "scene line 7: there is no body `sceen` to aim at, did you mean `scene`?",
        ),
    ] {
        let message = refused(text);
        assert!(message.starts_with(expected), "{message}\nnot: {expected}");
    }
}

#[test]
fn a_knob_that_is_gone_is_refused_with_its_line_and_what_to_do() {
    let gone = "scene line 4: the knob `release_reach` is gone, since how far a crack releases the stress beside it now follows from its \
                length: delete it";
    for value in ["1", "0.5", "\"far\"", "{ metres = 1 }"] {
        for text in [
            format!(
                "[fracture]\ntiming = {{ time_resolved = {{ speed = 0.5, release_reach = {value} }} }}"
            ),
            format!("[fracture.timing.time_resolved]\nrelease_reach = {value}\nspeed = 0.5"),
        ] {
            assert_eq!(refused(&format!("{LEAST}{text}")), gone);
        }
    }
    let kept = format!("{LEAST}[fracture]\ntiming = {{ time_resolved = {{ speed = 0.25 }} }}");
    let timing = CrackTiming::TimeResolved { speed: 0.25 };
    assert_eq!(parsed(&kept).fracture.timing, timing);
}

#[test]
fn wrong_types_and_unusable_values_are_told_with_their_line() {
    let body = |line: &str| format!("seed = 3\n{LEAST}{line}");
    let ball = |line: &str| {
        format!("{LEAST}[[projectile]]\n{line}\n")
            .replace("BALL", "mass = 0.1\nradius = 0.01\nspeed = 3")
    };
    for (text, line, part) in [
        (
            "floor = 3\n".to_string() + LEAST,
            1,
            "true, false or a name",
        ),
        ("floor = \"cheese\"\n".to_string() + LEAST, 1, "`cheese`"),
        (
            "duration = nan\n".to_string() + LEAST,
            1,
            "the duration is NaN",
        ),
        ("name = \"../x\"\n".to_string() + LEAST, 1, "file name"),
        ("seed = -1\n".to_string() + LEAST, 1, "whole number"),
        (
            "look_from = [0, 0, 0]\n".to_string() + LEAST,
            1,
            "not all zero",
        ),
        (String::new(), 1, "[[body]]"),
        (
            "[[body]]\nname = \"a\"".into(),
            1,
            "`shape`, `mesh` or `asset`",
        ),
        (
            body("mesh = \"a.obj\""),
            3,
            "one of `shape`, `mesh` and `asset`",
        ),
        (body("drop = \"high\""), 4, "expected a number"),
        (
            body("drop = -1"),
            4,
            "the drop height is -1; it must be above 0",
        ),
        (body("drop = 1\nposition = [0, 1, 0]"), 5, "remove `drop`"),
        (body("position = [1]"), 4, "[x, z]"),
        (body("position = [1e30, 0]"), 4, "at most 1000"),
        (body("modes = 0"), 4, "the number of modes"),
        (body("modes = -3"), 4, "whole number"),
        (body("size = 0.1"), 4, "is for a `mesh`"),
        (body("rotation = { degrees = 3 }"), 4, "a rotation is"),
        (
            body("rotation = { axis = \"w\", degrees = 3 }"),
            4,
            "`w` is no axis",
        ),
        (
            body("rotation = { quaternion = [1, 1, 1, 1] }"),
            4,
            "unit quaternion",
        ),
        (
            body("rotation = { axis = \"x\", degrees = inf }"),
            4,
            "unit quaternion",
        ),
        (
            body("material = { preset = \"glass\", density = -1 }"),
            4,
            "density",
        ),
        (body("velocity = [0, 500, 0]"), 4, "at most 300 m/s"),
        (
            "[[body]]\nasset = \"a.frangible\"\nsupports = [{ below = 0.01 }]".into(),
            3,
            "part of a baked body",
        ),
        (
            "[[body]]\nshape = { box = [1, 0, 1] }".into(),
            2,
            "side of the box",
        ),
        (
            "[[body]]\nmesh = \"a.obj\"\nsize = -2".into(),
            3,
            "the body's size is -2",
        ),
        (
            "[[body]]\nmesh = \"a.obj\"\nresolution = 3".into(),
            3,
            "500 to 2000000",
        ),
        (
            "[[body]]\nmesh = \"a.obj\"\nup = \"q\"".into(),
            3,
            "`q` is no axis",
        ),
        (
            "[[body]]\nasset = \"a.frangible\"\nsize = -3".into(),
            3,
            "the body's size is -3",
        ),
        (
            "[[body]]\nasset = \"a.frangible\"\nmaterial = \"glas\"".into(),
            3,
            "unknown material `glas`; materials: glass, ",
        ),
        (
            "[[body]]\nasset = \"a.frangible\"\nmodes = 3".into(),
            3,
            "bake it again",
        ),
        (ball("mass = 1\nradius = 1"), 3, "`speed`"),
        (ball("BALL\ncrown = 0.1"), 7, "a ball has no `crown`"),
        (
            ball("BALL\nkind = \"hammer\"\ncrown = 0.001"),
            8,
            "the hammer's crown is 0.001",
        ),
        (
            ball("mass = 0\nradius = 1\nspeed = 1"),
            4,
            "the ball's mass is 0",
        ),
        (ball("BALL\nkind = \"arrow\""), 7, "unknown name `arrow`"),
        (
            body("[fracture]\nsamples_per_period = -1"),
            5,
            "samples per period",
        ),
        (
            body("[fracture]\npath = { steered = { turning_length = 0 } }"),
            5,
            "turning length",
        ),
        (body("[output]\nglb = \"../a.glb\""), 5, "file name"),
        (
            body("[output]\nglb = \"a\"\npicture = \"a\""),
            6,
            "different",
        ),
        (body("[output]\nseeds = 99"), 5, "1 to 36"),
        (
            body("[[body]]\nshape = \"bowl\"\nname = \"scene 1\""),
            6,
            "two bodies `scene 1`",
        ),
        (body("this is no TOML"), 4, ""),
        (body("modes = 3\nmodes = 4"), 5, "already there"),
    ] {
        let message = refused(&text);
        assert!(
            message.starts_with(&format!("scene line {line}: ")) && message.contains(part),
            "{message}\nnot line {line} with `{part}`:\n{text}"
        );
    }
}

#[test]
fn nothing_that_is_cut_short_or_scrambled_makes_it_panic() {
    let text = scene_to_toml(&intricate());
    for end in 0..text.len() {
        if let Some(cut) = text.get(..end) {
            let _ = parse_scene(cut, Path::new(""));
        }
    }
    // Bytes replaced by ones that mean something, at places a linear congruence chooses.
    let mut state = 1_u64;
    let mut next = |n: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % n
    };
    for _ in 0..3000 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..1 + next(4) {
            let at = next(bytes.len());
            bytes[at] = b"[]{}=\"'.,-+e0159\n#tfni"[next(22)];
        }
        if let Ok(scrambled) = String::from_utf8(bytes)
            && let Ok(scene) = parse_scene(&scrambled, Path::new(""))
        {
            // What is accepted is sound, and means the same when written.
            scene.validate().unwrap();
        }
    }
}

#[test]
fn deep_nesting_and_many_bodies_are_refused() {
    let deep = format!("{LEAST}name = {}1", "[".repeat(100_000));
    assert!(refused(&deep).starts_with("scene line 3: "));
    let many = LEAST.repeat(101);
    assert!(refused(&many).contains("number of bodies is 101"));
}

#[test]
fn files_that_are_no_scene_are_refused_with_their_path() {
    let folder = std::env::temp_dir().join(format!("frangible-toml-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let cases = [
        (folder.join("absent.toml"), "there is no such file"),
        (folder.join("absent.obj"), "there is no such file"),
        (folder.clone(), "this is a folder"),
        (write("empty.toml", b""), "this file is empty"),
        (write("empty.stl", b""), "this file is empty"),
        (write("binary.toml", b"\xff\xfe"), "not UTF-8"),
        (write("large.toml", &vec![b' '; 1 << 21]), "too large"),
        (write("picture.jpg", b"x"), ".obj, .stl, .ply, .gltf, .glb"),
        (write("none", b"x"), ".frangible"),
    ];
    for (path, part) in cases {
        let message = scene_of_file(&path).unwrap_err().to_string();
        assert!(
            message.contains(part) && message.contains(&*path.to_string_lossy()),
            "{message}"
        );
        assert_eq!(message.lines().count(), 1, "{message}");
    }
    let named = write("my vase.toml", LEAST.as_bytes());
    assert_eq!(read_scene(&named).unwrap().name, "my vase");
    let odd = write(".a\"b*c .toml", LEAST.as_bytes());
    assert_eq!(read_scene(&odd).unwrap().name, "a_b_c");
    let broken = write("broken.toml", b"\n\nshape = 3");
    let message = read_scene(&broken).unwrap_err().to_string();
    assert!(
        message.contains("broken.toml line 3: unknown key `shape`"),
        "{message}"
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_example_of_the_documentation_is_a_scene() {
    let documentation = include_str!("../../../docs/scene-files.md");
    let example = documentation
        .split("```toml\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .expect("an example");
    let scene = parsed(example);
    assert_eq!((scene.bodies.len(), scene.projectiles.len()), (2, 1));
    assert_eq!(scene.bodies[1].material.strength, 6e5);
    // It spells out the defaults of the fracture.
    assert_eq!(scene.fracture, FractureConfig::default());
}

#[test]
fn supports_of_every_kind_survive_writing_and_reading() {
    let held = "[[body]]\nshape = { box = [0.2, 0.2, 0.01] }\nresolution = 9000\nsupports = [{ below = 0.01 }, { above = 0.02, axes = \"z\" }, \
        { side = \"-x\", at = -0.5 }, { side = \"+y\", at = 0.3, axes = \"yx\" }, { side = \"z\", at = 1 }, \
        { plane = { point = [1, 2, 3], normal = [0, 2, 0] } }, { box = [[0, 0, -inf], [1, 1, 1]] }, \
        { sphere = { centre = [0, 0, 0.1], radius = 0.02 } }, { group = \"the \\\"frame\\\"\" }]";
    let scene = parsed(held);
    let supports = &scene.bodies[0].supports;
    assert_eq!(supports.len(), 9);
    assert_eq!(supports[0], Support::clamped(Region::below(2, 0.01)));
    assert_eq!(supports[1].axes, [false, false, true]);
    assert_eq!(supports[2].region, Region::below(0, -0.5));
    assert_eq!(supports[3].region, Region::above(1, 0.3));
    assert_eq!(supports[3].axes, [true, true, false]);
    assert_eq!(supports[8].region, Region::Group("the \"frame\"".into()));
    assert_eq!(scene.bodies[0].resolution, Some(9000));
    let text = scene_to_toml(&scene);
    assert_eq!(parsed(&text), scene, "{text}");
}

#[test]
fn supports_that_cannot_be_meant_are_refused() {
    for (support, words) in [
        ("{ }", "one of `below`"),
        ("{ below = 0, above = 1 }", "one of `below`"),
        ("{ side = \"-x\" }", "go together"),
        ("{ side = \"w\", at = 0 }", "`side` is one of"),
        ("{ below = 0, axes = \"xx\" }", "letters x, y and z"),
        ("{ below = 0, axes = \"\" }", "letters x, y and z"),
        ("{ below = nan }", "not finite"),
        ("{ box = [[1, 1, 1], [0, 0, 0]] }", "low corner above"),
        ("{ sphere = { centre = [0, 0, 0], radius = 0 } }", "radius"),
    ] {
        let message = refused(&format!(
            "[[body]]\nshape = \"vase\"\nsupports = [{support}]"
        ));
        assert!(
            message.contains(words) && message.contains("line 3"),
            "{message}"
        );
    }
}

#[test]
fn weak_places_are_read_and_mistakes_in_them_named() {
    let text = format!(
        "{LEAST}weibull_modulus = 8\nweakness = [\n  {{ line = [[0, 0, 0], [0, 0, 0.1]], radius = 0.002, strength = 0.2 }},\n  \
         {{ box = [[0, 0, 0], [1, 1, 1]], toughness = 2, weak_points = 0 }},\n]\n"
    );
    let body = &parsed(&text).bodies[0];
    assert_eq!(body.weibull_modulus, Some(8.0));
    let line = Zone::Tube {
        line: vec![Vec3::ZERO, Vec3::Z * 0.1],
        radius: 0.002,
    };
    assert_eq!(body.weakness[0], Patch::of_strength(line, 0.2));
    assert_eq!(body.weakness[1].toughness, Some(2.0));
    for (weakness, word) in [
        ("{ line = [[0, 0, 0]], strength = 0.2 }", "radius"),
        ("{ strength = 0.2 }", "sphere"),
        ("{ line = [], radius = 0.1 }", "no points"),
        ("{ sphere = [0, 0, 0], radius = -1 }", "radius"),
        ("{ sphere = [0, nan, 0], radius = 1 }", "finite"),
        (
            "{ sphere = [0, 0, 0], radius = 1, strength = 0 }",
            "strength",
        ),
        (
            "{ sphere = [0, 0, 0], radius = 1, thoughness = 1 }",
            "thoughness",
        ),
        (
            "{ plane = { point = [0, 0, 0], normal = [0, 0, 0] } }",
            "normal",
        ),
    ] {
        let message = refused(&format!("{LEAST}weakness = [{weakness}]\n"));
        assert!(message.contains(word), "{weakness}: {message}");
    }
    let painted = "[[body]]\nmesh = \"a.ply\"\nweakness = [{ paint = \"red\", strength = 0.2 }, { paint = \"alpha\", weak_points = [4, 0] }]\n";
    let body = &parsed(painted).bodies[0];
    assert_eq!(body.paint[0], Paint::of_strength(Channel::Red, [1.0, 0.2]));
    assert_eq!(body.paint[1].weak_points, Some([4.0, 0.0]));
    for (weakness, word) in [
        ("{ paint = \"read\", strength = 0.2 }", "did you mean `red`"),
        ("{ paint = \"red\", radius = 1 }", "one of"),
        ("{ paint = \"red\", strength = [1, 0] }", "strength"),
        ("{ paint = \"red\", strength = [1, 0.5, 0.2] }", "line 3"),
        (
            "{ sphere = [0, 0, 0], radius = 1, strength = [1, 0.2] }",
            "`paint`",
        ),
    ] {
        let message = refused(&format!(
            "[[body]]\nmesh = \"a.ply\"\nweakness = [{weakness}]\n"
        ));
        assert!(message.contains(word), "{weakness}: {message}");
    }
    let message = refused(&format!("{LEAST}weakness = [{{ paint = \"red\" }}]\n"));
    assert!(message.contains("built-in shape"), "{message}");
    let message = refused(&format!("{LEAST}weibull_modulus = 0.5\n"));
    assert!(message.contains("Weibull"), "{message}");
}

#[test]
fn strength_fracture_energy_and_energy_depth_go_together() {
    let glass = Material::preset("glass").unwrap();
    let of = |text: &str| {
        let scene = format!(
            "[[body]]\nshape = {{ box = [0.1, 0.1, 0.1] }}\nmaterial = {{ preset = \"glass\", {text} }}"
        );
        let scene = parsed(&scene);
        let again = parsed(&scene_to_toml(&scene));
        assert_eq!(scene.bodies[0].material, again.bodies[0].material, "{text}");
        scene.bodies[0].material.clone()
    };
    let tougher = of("fracture_energy = 30.0");
    let root = (30.0 / glass.fracture_energy).sqrt();
    assert!((tougher.strength / glass.strength - root).abs() < 1e-12);
    assert_eq!(tougher.energy_depth, glass.energy_depth);
    let stronger = of("strength = 82e6");
    assert!((stronger.energy_depth / glass.energy_depth - 0.25).abs() < 1e-12);
    let all = of("strength = 5e7, fracture_energy = 9.0, energy_depth = 0.004");
    assert_eq!(
        (all.strength, all.fracture_energy, all.energy_depth),
        (5e7, 9.0, 0.004)
    );
    let fast = of("rise_time = 1e-5");
    let spelled = parsed(
        "[[body]]\nshape = { box = [0.1, 0.1, 0.1] }\nmaterial = { preset = \"GLASS\", rise_time = 1e-5 }",
    );
    assert_eq!(spelled.bodies[0].material, fast);
    assert_eq!(fast.strength, 1.52 * glass.strength);
    for wrong in [
        "preset = \"ice\", rise_time = 1e-5",
        "preset = \"glass\", rise_time = 0.0",
    ] {
        let scene =
            format!("[[body]]\nshape = {{ box = [0.1, 0.1, 0.1] }}\nmaterial = {{ {wrong} }}");
        let error = parse_scene(&scene, Path::new("folder"))
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("rise_time") && error.contains("glass, concrete, pmma"),
            "{error}"
        );
    }
}

#[test]
fn one_word_names_the_papers_model_and_other_keys_override_it() {
    let fracture = |keys: &str| parsed(&format!("{LEAST}[fracture]\n{keys}\n")).fracture;
    let paper = FractureConfig::as_in_the_paper();
    assert_eq!(fracture("model = \"paper\""), paper);
    assert_eq!(fracture("model = \"ours\""), FractureConfig::default());
    let given = FractureConfig::with_given_impulses();
    assert_eq!(fracture("model = \"given_impulses\""), given);
    let mut ledger = paper.clone();
    ledger.energy_ledger = true;
    ledger.samples_per_period = 4.0;
    let keys = "samples_per_period = 4\nmodel = \"paper\"\nenergy_ledger = true";
    assert_eq!(fracture(keys), ledger);
    let message = refused(&format!("{LEAST}[fracture]\nmodel = \"papers\""));
    assert!(
        message.contains("line 4") && message.contains("paper"),
        "{message}"
    );

    let mut scene = parsed(LEAST);
    scene.fracture = paper;
    let text = scene_to_toml(&scene);
    assert!(text.contains("model = \"paper\""), "{text}");
    assert_eq!(parsed(&text).fracture, scene.fracture);
}
