//! Scenes that are written and read again.

use super::*;

#[test]
fn every_built_in_scene_survives_writing_and_reading() {
    for name in SCENE_NAMES {
        let scene = scene(name).unwrap();
        let text = scene_to_toml(&scene);
        assert_eq!(parsed(&text), scene, "{text}");
    }
}

/// Every field away from its default, with numbers that are hard to print.
pub(crate) fn intricate() -> Scene {
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
        wall: None,
        parts: PartChoice::Weld {
            gap: Some(0.1 + 0.2),
        },
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
    third.specimen = Some(1e-5 / 3.0);
    third.fatigue = Some(Fatigue {
        exponent: 50.0 / 3.0,
        rate: 1e6 / 3.0,
        increase: 4.0 / 3.0,
    });
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
    third.weakness[3] = Patch::of_groove(third.weakness[3].zone.clone(), 1e-3 / 3.0);
    third.paint = vec![
        Paint::of_strength(Channel::Green, [1.0 / 3.0, 1.0]),
        Paint {
            channel: Channel::Alpha,
            strength: None,
            toughness: Some([1.0, 7.0]),
            weak_points: Some([0.0, 0.1]),
            groove: Some([0.0, 1e-3 / 3.0]),
        },
    ];
    third.rescale.size = Some(1.0 / 3.0);
    let mut edit = MaterialEdit::preset("stone");
    edit.name = Some("soft “stone”".into());
    (edit.numbers[0], edit.numbers[5]) = (Some(1e9 / 3.0), Some(1e6));
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
    scene.adhesive = Some(Adhesive {
        strength: 1e7 / 3.0,
        patch: 0.1 + 0.2,
    });
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
    scene.output.drawing = frangible_scenes::Drawing::Light;
    scene
}

#[test]
fn an_intricate_scene_survives_writing_and_reading() {
    let mut scene = intricate();
    let absolute = |text: &str| parse_scene(text, Path::new(""));
    let text = scene_to_toml(&scene);
    assert_eq!(absolute(&text).unwrap(), scene, "{text}");
    scene.fracture = FractureConfig::default();
    scene.fracture.load_duration = 1.0 / 3.0;
    scene.output.drawing = frangible_scenes::Drawing::Fine;
    scene.floor = Some("wood".into());
    let text = scene_to_toml(&scene);
    assert_eq!(absolute(&text).unwrap(), scene, "{text}");
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
