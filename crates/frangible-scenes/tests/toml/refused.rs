//! Texts that are no scene, or none that can be meant.

use super::written::intricate;
use super::*;

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
            "[[body]]\nshape = \"vase\"\n[fracture]\nduration = \"modal_herz\"",
            "scene line 4: unknown name `modal_herz`, did you mean `modal_hertz`?",
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
        (body("size = 0.1"), 4, "applies only to a `mesh`"),
        (body("rotation = { degrees = 3 }"), 4, "a rotation must be"),
        (
            body("rotation = { axis = \"w\", degrees = 3 }"),
            4,
            "`w` is not an axis",
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
            "[[body]]\nshape = { box = [1000, 0.1, 0.1] }".into(),
            2,
            "the longest side of `shape` is 1000; it must be 0.001 to 3 m",
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
            "`q` is not an axis",
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
            body("[fracture]\nduration = { as_printed = { c = 0 } }"),
            5,
            "the constant c",
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
        (body("this is not TOML"), 4, ""),
        (body("modes = 3\nmodes = 4"), 5, "occurs twice"),
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
            // An accepted file is sound, and means the same when written.
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
        (
            std::path::PathBuf::from("https://example.org/a.obj"),
            "download it first",
        ),
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
fn supports_that_cannot_be_meant_are_refused() {
    for (support, words) in [
        ("{ }", "one of `below`"),
        ("{ below = 0, above = 1 }", "one of `below`"),
        ("{ side = \"-x\" }", "given together"),
        ("{ side = \"w\", at = 0 }", "`side` must be one of"),
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
