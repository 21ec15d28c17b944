//! Files, options and bodies that are refused in a sentence.

use std::fs;

use super::{box_obj, cross_obj, scene_file};
use crate::common::{Folder, frangible, refused, refused_in_a_sentence, text};

#[test]
fn files_that_cannot_be_broken_are_refused_in_a_sentence() {
    let input = Folder::new("inputs");
    let file = |name: &str, text: &str| scene_file(&input, name, text);
    let absent = input.0.join("absent.obj").to_string_lossy().into_owned();
    let folder = input.0.to_string_lossy().into_owned();
    let body = "[[body]]\nshape = \"vase\"\n";
    for (path, parts) in [
        (absent.clone(), &["no such file", "absent.obj"][..]),
        ("glass".into(), &["no file `glass`", "--scene glass"]),
        (folder, &["this is a folder"]),
        (file("empty.stl", ""), &["empty.stl", "empty"]),
        (file("picture.jpg", "x"), &[".obj", ".frangible", ".toml"]),
        (file("text.toml", "once upon a time"), &["text.toml line 1"]),
        (
            file("key.toml", &format!("{body}\nmaterail = \"glass\"")),
            &["key.toml line 4", "`materail`", "did you mean `material`"],
        ),
        (
            file("value.toml", &format!("{body}drop = -2")),
            &["value.toml line 3", "the drop height is -2"],
        ),
        (
            file("far.toml", "[[body]]\nmesh = \"meshes/far.ply\""),
            &["no such file", "meshes/far.ply"],
        ),
        (
            file(
                "held.toml",
                &format!(
                    "{body}supports = [{{ below = -1 }}]\n[[projectile]]\nmass = 0.1\nradius = 0.015\nspeed = 5\n"
                ),
            ),
            &[
                "support 0 of `",
                "{ below = -1.0 }, contains no part of the body",
                "(the body reaches from 0 to 0.21",
                "m along z)",
            ],
        ),
    ] {
        refused_in_a_sentence("files", &["break", &path, "--no-pictures"], parts);
    }
    refused(
        "files",
        &["break", &absent, "--scene", "vase"],
        &["--scene"],
    );
}

#[test]
fn supports_that_cannot_be_meant_are_refused_with_an_example() {
    for (spec, part) in [
        ("below", "KIND:WHERE"),
        ("below:w:0", "an axis and a coordinate"),
        ("above:x:high", "an axis and a coordinate"),
        ("box:0,0,0,1", "lowest and its highest"),
        ("sphere:0,0,0", "centre and its radius"),
        ("sphere:0,0,0,-1", "radius that is not above zero"),
        ("group:", "a group takes a name"),
        ("circle:0", "kind of region is unknown"),
        ("below:z:0@xx", "letters x, y and z"),
        ("group:frame", "there is no group `frame`"),
    ] {
        refused_in_a_sentence("support", &["--scene", "pane", "--support", spec], &[part]);
    }
    let drop = ["--support", "below:z:0", "--drop", "1"];
    refused_in_a_sentence("support", &drop, &["cannot be dropped", "--ball"]);
}

#[test]
fn options_for_meshes_are_refused_elsewhere() {
    let check = |args: &[&str], parts: &[&str]| refused_in_a_sentence("mesh", args, parts);
    check(&["--size", "0.1"], &["--size applies only to mesh files"]);
    check(&["--resolution", "9"], &["resolution is 9", "500 to"]);
    check(&["--up", "z"], &["--up applies only to mesh files"]);
    check(&["--up", "q"], &["--up is `q`", "x, y or z"]);
    let input = Folder::new("mesh-input");
    let mesh = scene_file(&input, "a.obj", "v 0 0 0\n");
    check(&["break", &mesh, "--size", "-1"], &["size is -1", "3 m"]);
    check(&["break", &mesh, "--size", "nan"], &["size is NaN"]);
    check(&["break", &mesh, "--resolution", "7"], &["resolution is 7"]);
    check(
        &["break", &mesh, "--resolution", "-7"],
        &["resolution is -7"],
    );
    let baked = scene_file(&input, "a.frangible", "x");
    check(
        &["break", &baked, "--material", "glas"],
        &["unknown material `glas`; materials: glass, "],
    );
    check(
        &["break", &baked, "--size", "-0.1"],
        &["the body's size is -0.1"],
    );
    check(
        &["break", &baked, "--modes", "9"],
        &["already baked", "bake"],
    );
    check(
        &["break", &baked, "--resolution", "3000"],
        &["--resolution cannot change `a`", "`frangible bake`"],
    );
}

#[test]
fn bakes_that_cannot_be_are_refused_and_leave_nothing() {
    let folder = Folder::new("bake");
    let scene = scene_file(
        &folder,
        "two.toml",
        "[[body]]\nshape = \"vase\"\n[[body]]\nshape = \"bowl\"\n",
    );
    let out = |name: &str| folder.0.join(name).to_string_lossy().into_owned();
    let far = out("no-such-folder/a.frangible");
    let good = out("a.frangible");
    let wrong = out("a.obj");
    for (args, part) in [
        (vec!["--scene", "vas", "-o", &good], "did you mean `vase`"),
        (
            vec!["--scene", "vase", "-o", &wrong],
            "must end in .frangible",
        ),
        (vec!["--scene", "vase", "-o", &far], "-o FILE"),
        (vec![&scene, "-o", &good], "2 bodies"),
        (
            vec!["--scene", "vase", "-o", &good, "--modes", "0"],
            "--modes",
        ),
        (
            vec!["--scene", "vase", "-o", &good, "--size", "1"],
            "mesh files",
        ),
        (vec![&good, "-o", &good], "no such file"),
        (vec!["-o", &good], "FILE"),
        (vec!["--scene", "vase"], "--output"),
    ] {
        let output = frangible(&[&["bake"], &args[..]].concat(), None);
        let message = text(&output.stderr);
        assert!(!output.status.success(), "{args:?}");
        assert_ne!(output.status.code(), Some(101), "{message}");
        assert!(message.contains(part), "{args:?}: {message}");
        assert_eq!(folder.files(), ["two.toml"], "{args:?} left files");
    }
}

#[test]
fn meshes_that_cannot_be_broken_are_refused_in_a_sentence() {
    let input = Folder::new("bad-meshes");
    let path = |name: &str| input.0.join(name).to_string_lossy().into_owned();
    let file = |name: &str, bytes: &[u8]| {
        fs::write(path(name), bytes).expect("a mesh file");
        path(name)
    };
    let good = file("buddha.obj", box_obj([0.1; 3]).as_bytes());
    let diary = "Dear diary, today I renamed a letter to see what comes of it. ".repeat(9);
    let mut glb = b"glTF\x02\0\0\0\x00\x10\0\0\x00\x08\0\0JSON{\"asset\":".to_vec();
    let cut_glb = file("cut.glb", &glb);
    glb.truncate(7);
    let nan = box_obj([0.1; 3]).replacen("v 0 ", "v nan ", 1);
    let flat = "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nf 1 2 3 4\n";
    let mut cut_stl = vec![0; 84];
    cut_stl[80] = 5;
    cut_stl.extend([0; 120]);
    let cases: [(String, &[&str]); 13] = [
        (
            path("budha.obj"),
            &["no such file", "did you mean `buddha.obj`"],
        ),
        (path("no/such/folder.obj"), &["no such file", "folder.obj"]),
        (file("empty.glb", b""), &["empty"]),
        (
            file("diary.stl", diary.as_bytes()),
            &["text", "solid", "diary.stl"],
        ),
        (file("diary.glb", diary.as_bytes()), &["glTF", "diary.glb"]),
        (
            file("diary.obj", diary.as_bytes()),
            &["no triangles", "diary.obj"],
        ),
        (
            file("diary.frangible", diary.as_bytes()),
            &["diary.frangible"],
        ),
        (cut_glb, &["cut.glb"]),
        (file("shorter.glb", &glb), &["shorter.glb"]),
        (file("cut.stl", &cut_stl), &["truncated", "facet 3 of 5"]),
        (
            file("nan.obj", nan.as_bytes()),
            &["vertex 1", "finite", "nan.obj"],
        ),
        (
            file("flat.obj", flat.as_bytes()),
            &["flat", "thickness", "flat.obj"],
        ),
        (
            file("huge.obj", box_obj([120.0, 90.0, 60.0]).as_bytes()),
            &["120 m", "--size 0.12"],
        ),
    ];
    for (path, parts) in &cases {
        refused_in_a_sentence("bad-meshes-out", &["break", path, "--no-pictures"], parts);
        let baked = input.0.join("never.frangible");
        let args = ["bake", path, "-o", &*baked.to_string_lossy()];
        let output = frangible(&args, None);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        assert!(!baked.exists(), "{path} was baked");
    }
    for (option, value, part) in [
        ("--resolution", "3", "500 to 2000000"),
        ("--resolution", "2000001", "500 to 2000000"),
        ("--size", "1e-5", "0.001 to 3 m"),
        ("--size", "1e9", "0.001 to 3 m"),
        ("--up", "w", "x, y or z"),
        ("--material", "glas", "materials: glass, "),
    ] {
        refused_in_a_sentence("bad-meshes-out", &["break", &good, option, value], &[part]);
    }
}

#[test]
fn walls_too_thin_are_refused_with_the_resolution_they_need_and_no_folder_is_left() {
    let input = Folder::new("thin");
    for (thickness, part) in [(0.003, "--resolution "), (0.0001, "at least ")] {
        let mesh = scene_file(&input, "cross.obj", &cross_obj(0.3, thickness));
        let out = input.0.join("out");
        let output = frangible(&["break", &mesh], Some(&out));
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(
            message.contains(part) && message.contains("`cross`"),
            "{message}"
        );
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert!(!out.exists(), "an empty folder is left behind");
    }
}
