//! Scene files: their meaning, their errors, and that writing one loses nothing.

use std::path::Path;

use frangible::glam::{Quat, Vec3};
use frangible::internals::Fatigue;
use frangible::{FractureConfig, Material};
use frangible_bake::weakness::{Channel, Paint, Patch, Zone};
use frangible_bake::{Shape, Station};
use frangible_mesh::PartChoice;
use frangible_scenes::{
    Adhesive, Axis, BodySource, BodySpec, FileWish, MaterialEdit, Place, Projectile,
    ProjectileKind, Region, SCENE_NAMES, Scene, Support, parse_scene, read_scene, scene,
    scene_of_file, scene_to_toml,
};

mod refused;
mod written;

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
fn the_example_of_the_documentation_is_a_scene() {
    let documentation = include_str!("../../../../docs/scene-files.md");
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
        (
            "{ sphere = [0, 0, 0], radius = 1, groove = -1e-3 }",
            "groove",
        ),
        ("{ paint = \"red\", groove = [0, inf] }", "groove"),
        (
            "{ sphere = [0, 0, 0], radius = 1, groove = 1e-3, strength = 0.5 }",
            "`groove`",
        ),
    ] {
        let message = refused(&format!(
            "[[body]]\nmesh = \"a.ply\"\nweakness = [{weakness}]\n"
        ));
        assert!(message.contains(word), "{weakness}: {message}");
    }
    let message = refused(&format!("{LEAST}weakness = [{{ paint = \"red\" }}]\n"));
    assert!(message.contains("built-in shape"), "{message}");
}

#[test]
fn what_makes_no_strength_is_named() {
    for (text, words) in [
        ("weibull_modulus = 0.5", "Weibull modulus is 0.5"),
        ("specimen = 0", "specimen's volume is 0"),
        ("specimen = inf", "specimen's volume is inf"),
        (
            "fatigue = { exponent = 0, rate = 2e6, increase = 1.5 }",
            "fatigue exponent is 0",
        ),
        (
            "fatigue = { exponent = 16, rate = 2e6 }",
            "missing key `increase`",
        ),
        (
            "material = { preset = \"glass\", fracture_energy = 0 }",
            "fracture energy is 0",
        ),
    ] {
        let message = refused(&format!("{LEAST}{text}\n"));
        assert!(message.contains(words), "{text}: {message}");
    }
    for duration in ["-1", "inf"] {
        let message = refused(&format!("{LEAST}[fracture]\nload_duration = {duration}\n"));
        let words = format!("line 4: how long loads rest is {duration}");
        assert!(message.contains(&words), "{message}");
    }
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
    let stronger = of("strength = 100e6");
    let shallower = (glass.strength / 100e6).powi(2);
    assert!((stronger.energy_depth / glass.energy_depth - shallower).abs() < 1e-12);
    let all = of("strength = 5e7, fracture_energy = 9.0, energy_depth = 0.004");
    assert_eq!(
        (all.strength, all.fracture_energy, all.energy_depth),
        (5e7, 9.0, 0.004)
    );
}

#[test]
fn one_word_names_the_papers_model_and_other_keys_override_it() {
    let fracture = |keys: &str| parsed(&format!("{LEAST}[fracture]\n{keys}\n")).fracture;
    let paper = FractureConfig::as_in_the_paper();
    assert_eq!(fracture("model = \"paper\""), paper);
    assert_eq!(fracture("model = \"ours\""), FractureConfig::default());
    let given = FractureConfig::with_given_impulses();
    assert_eq!(fracture("model = \"given_impulses\""), given);
    let mut sized = paper.clone();
    sized.sized_flaws = true;
    sized.samples_per_period = 4.0;
    let keys = "samples_per_period = 4\nmodel = \"paper\"\nsized_flaws = true";
    assert_eq!(fracture(keys), sized);
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
