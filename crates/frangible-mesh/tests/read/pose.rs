//! The pose that viewers show: morph targets, skins, and meshes that are drawn many times.

use super::*;

fn pose(numbers: &Numbers, nodes: &str, meshes: &str, more: &str) -> Result<InputMesh, ReadError> {
    let json =
        format!(r#""scene":0,"scenes":[{{"nodes":[0]}}],"nodes":{nodes},"meshes":{meshes}{more}"#);
    parse(MeshFormat::Gltf, numbers.glb(&json))
}

fn assert_near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
}

/// Moves the corner on the z axis to twice its height and back, and turns all normals.
fn morphing() -> (Numbers, String) {
    let mut numbers = Numbers::tetrahedron();
    let normals = numbers.floats("VEC3", &[1.0, 0.0, 0.0].repeat(4));
    let mut moves = [0.0; 12];
    moves[11] = 1.0;
    let up = numbers.floats("VEC3", &moves);
    let turned = numbers.floats("VEC3", &[-1.0, 1.0, 0.0].repeat(4));
    let down = numbers.floats("VEC3", &moves.map(|x| -0.5 * x));
    let mesh = format!(
        r#"{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":{normals}}},"indices":1,
        "targets":[{{"POSITION":{up},"NORMAL":{turned}}},{{"POSITION":{down}}}]}}]"#
    );
    (numbers, mesh)
}

#[test]
fn morph_targets_stand_at_the_weights_of_the_node_or_else_of_the_mesh() {
    let (numbers, mesh) = morphing();
    for (node, of_mesh, height) in [
        ("", "", 1.0),
        ("", r#","weights":[1,0]"#, 2.0),
        ("", r#","weights":[0.5,0.5]"#, 1.25),
        ("", r#","weights":[0]"#, 1.0),
        (r#","weights":[0,1]"#, r#","weights":[1,0]"#, 0.5),
        (r#","weights":[-1,0]"#, "", 0.0),
    ] {
        let nodes = format!(r#"[{{"mesh":0{node}}}]"#);
        let read = pose(&numbers, &nodes, &format!("[{mesh}{of_mesh}}}]"), "").expect("a pose");
        assert_near(volume(&read), height / 6.0);
        assert_eq!(
            read.left_out,
            ["morph targets, which stand at their weights"]
        );
        let is_turned = height == 2.0;
        assert_eq!(
            read.normals[0],
            if is_turned { Vec3::Y } else { read.normals[0] }
        );
    }
}

#[test]
fn instances_of_a_morphed_mesh_have_weights_of_their_own() {
    let (numbers, mesh) = morphing();
    let nodes =
        r#"[{"children":[1,2]},{"mesh":0,"weights":[1,0]},{"mesh":0,"translation":[5,0,0]}]"#;
    let read = pose(&numbers, nodes, &format!("[{mesh}}}]"), "").expect("two");
    assert_near(volume(&read), (2.0 + 1.0) / 6.0);
}

/// A mesh whose corner on the z axis follows joint 1 by half, the others joint 0. `inverse`: of joint 1.
fn skinned(numbers: &mut Numbers, inverse: Option<[f32; 16]>) -> (String, String) {
    let joints = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 7].map(|j: u8| j);
    let weights: [u8; 16] = [255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 51, 51, 0, 0];
    let view = numbers.view(&joints);
    numbers.accessors.push(format!(
        r#"{{"bufferView":{view},"componentType":5121,"count":4,"type":"VEC4"}}"#
    ));
    let joints = numbers.accessors.len() - 1;
    let weights = numbers.push(5121, "VEC4", 4, &weights);
    let mesh = format!(
        r#"[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{joints},"WEIGHTS_0":{weights}}},"indices":1}}]}}]"#
    );
    let inverse = inverse.map_or(String::new(), |inverse| {
        let mut unit = [0.0; 16];
        for k in 0..4 {
            unit[5 * k] = 1.0;
        }
        let at = numbers.floats("MAT4", &[unit, inverse].concat());
        format!(r#","inverseBindMatrices":{at}"#)
    });
    (mesh, format!(r#","skins":[{{"joints":[1,2]{inverse}}}]"#))
}

#[test]
fn a_skin_follows_its_joints_and_not_its_node() {
    let node = r#"{"mesh":0,"skin":0,"scale":[4,1,1],"children":[1]}"#;
    // Joint 0 stands still in spite of the node above it, whose inverse it has.
    let still = r#"{"scale":[0.25,1,1],"children":[2]}"#;
    // The half share of joint 1 counts as the weights are made to sum to one: 1 · ½ + 3 · ½ = 2 times as high.
    let nodes = format!(r#"[{node},{still},{{"scale":[1,1,3]}}]"#);
    let mut numbers = Numbers::tetrahedron();
    let (mesh, skin) = skinned(&mut numbers, None);
    let read = pose(&numbers, &nodes, &mesh, &skin).expect("a pose");
    assert_near(volume(&read), 2.0 / 6.0);
    assert_eq!(
        read.left_out,
        ["the skeleton, which stands as its nodes do"]
    );
    // An inverse bind matrix that undoes the scale: the mesh as it was drawn.
    let mut numbers = Numbers::tetrahedron();
    let mut inverse = [0.0; 16];
    for (k, scale) in [1.0, 1.0, 1.0 / 3.0, 1.0].into_iter().enumerate() {
        inverse[5 * k] = scale;
    }
    let (mesh, skin) = skinned(&mut numbers, Some(inverse));
    let read = pose(&numbers, &nodes, &mesh, &skin).expect("a pose");
    assert_near(volume(&read), 1.0 / 6.0);
    // A skeleton that mirrors keeps the outside outside.
    let mirrored = nodes.replace("[0.25,1,1]", "[-0.25,1,1]");
    let read = pose(&numbers, &mirrored, &mesh, &skin).expect("a pose");
    assert_near(volume(&read), 1.0 / 6.0);
    let too_few = skin.replace("[1,2]", "[1]");
    let error = pose(&numbers, &nodes, &mesh, &too_few).expect_err("no joint 1");
    let words = "JOINTS_0: joint 1 of vertex 3 does not exist; the skin has 1";
    assert!(error.to_string().contains(words), "{error}");
    let error = pose(&numbers, &nodes, &mesh, &skin.replace("[1,2]", "[1,9]"));
    let error = error.expect_err("no node 9").to_string();
    assert!(
        error.contains("skin 0: one of its joints does not exist"),
        "{error}"
    );
}

#[test]
fn a_mesh_is_drawn_as_often_as_its_instances_say() {
    let mut numbers = Numbers::tetrahedron();
    let places = numbers.floats("VEC3", &[0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 7.0, 0.0]);
    // A quarter turn about z, and one that is not of unit length.
    let turns: [i8; 12] = [0, 0, 90, 90, 0, 0, 0, 127, 0, 0, 0, 50];
    let turns = numbers.push(5120, "VEC4", 3, &turns.map(|x| x as u8));
    let sizes = numbers.floats("VEC3", &[1.0, 1.0, 1.0, 2.0, 1.0, 1.0, -1.0, 1.0, 3.0]);
    let mesh = r#"[{"name":"cone","primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#;
    let drawn = |attributes: &str, more: &str| {
        let node = format!(
            r#"[{{"mesh":0,"scale":[2,1,1],"name":"row","extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{attributes}}}}}}}}}]"#
        );
        let used = format!(r#","extensionsUsed":["EXT_mesh_gpu_instancing"]{more}"#);
        pose(&numbers, &node, mesh, &used)
    };
    let all = format!(r#""TRANSLATION":{places},"ROTATION":{turns},"SCALE":{sizes}"#);
    let read = drawn(&all, r#","extensionsRequired":["EXT_mesh_gpu_instancing"]"#).expect("three");
    assert_near(volume(&read), 2.0 * (1.0 + 2.0 + 3.0) / 6.0);
    // The node's scale is above the instances: the second begins at x = 10 and is 4 long.
    let high = read.positions.iter().map(|p| p.x).fold(0.0, f64::max);
    assert_near(high, 14.0);
    // The first is turned: its corner on the x axis lies on the y axis.
    assert_near(read.positions[1].y, 1.0);
    assert!(read.left_out.is_empty(), "{:?}", read.left_out);
    let names: Vec<_> = read.groups.iter().map(|group| &group.name[..]).collect();
    assert_eq!(names, ["row", "cone"].repeat(3));
    let places_only = drawn(&format!(r#""TRANSLATION":{places},"_ID":9"#), "").expect("three");
    assert_near(volume(&places_only), 2.0 * 3.0 / 6.0);
    assert_near(volume(&drawn("", "").expect("one")), 2.0 / 6.0);
    for (attributes, words) in [
        (
            r#""TRANSLATION":0,"SCALE":9"#,
            "accessor 9: it does not exist",
        ),
        (
            r#""TRANSLATION":0,"SCALE":2"#,
            "its attributes differ in length",
        ),
        (r#""ROTATION":2"#, "its elements must have 4 components"),
        (r#""SCALE":"all""#, "an accessor is not a number"),
    ] {
        let error = drawn(attributes, "").expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
}
