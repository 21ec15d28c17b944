//! Tests the window from end to end: opened on a display, given a script through the path of a person's input, and judged by the files that it saved.

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, frangible, text};
use frangible_draw::{DrawError, has_adapter};
use serde_json::Value;

/// Software rendering on a busy machine takes seconds a frame; a window that hangs takes for ever.
const LIMIT: Duration = Duration::from_secs(400);

const PANE: &str = r#"
floor = "stone"
[[body]]
name = "pane"
shape = { box = [0.2, 0.2, 0.006] }
material = "glass"
modes = 20
resolution = 3000
"#;

const SCRIPT: &str = "
open pane.toml
screenshot whole.png
ball 0.1 0.012 25 steel
click 0.62 0.5              # into the pane, through the camera
step 400
look stress
scrub 0.1
panel inspect open
screenshot stress.png
show fracture-mesh
screenshot meshes.png
hide fracture-mesh
save report first.json
knob strength 5000          # MPa: nothing breaks that
hit-again
screenshot both.png
look world
panel inspect closed
orbit 30 10
screenshot pieces.png
save glb state.glb
save scene turned.toml
save script done.txt
reset-knob all
home
reset
hammer 0.4 8 steel
click 0.62 0.5              # the head comes down on the pane
step 320                    # its pieces are still in the air
save report struck.json
save script struck.txt
save gif struck.gif 0.1s 30fps 160x100
frames 2
save times times.json
";

/// A display of our own, gone afterwards.
struct Display(Child, String);

impl Display {
    /// None without an X server that needs no screen.
    fn start() -> Option<Self> {
        // Servers that look for a free number themselves may find the same one.
        let first = 100 + std::process::id() % 20_000;
        (first..first + 5).find_map(Self::start_as)
    }

    fn start_as(number: u32) -> Option<Self> {
        let name = format!(":{number}");
        let mut server = Command::new("Xvfb")
            .args([&name, "-displayfd", "1", "-screen", "0", "1024x768x24"])
            .args(["-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        // It tells its number when it is ready.
        let mut ready = String::new();
        let read = BufReader::new(server.stdout.take()?).read_line(&mut ready);
        let display = Self(server, name);
        (read.is_ok() && ready.trim() == number.to_string()).then_some(display)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Display to open windows on. If there is none, prints the reason.
fn display() -> Option<Display> {
    if !cfg!(target_os = "linux") {
        println!("skipped: the test knows no display without a screen but Xvfb");
        return None;
    }
    if !has_adapter() {
        println!("skipped: {}", DrawError::NoAdapter);
        return None;
    }
    let display = Display::start();
    if display.is_none() {
        println!("skipped: there is no Xvfb to open a window on; `cargo xtask setup` installs it");
    }
    display
}

/// Runs `frangible view` in a folder, within the time limit. Returns true if it succeeded, and its messages.
fn view(display: &Display, folder: &Path, args: &[&str]) -> (bool, String) {
    let errors = folder.join("errors.txt");
    let mut program = Command::new(env!("CARGO_BIN_EXE_frangible"))
        .arg("view")
        .args(args)
        .current_dir(folder)
        .env("DISPLAY", &display.1)
        .env("XDG_RUNTIME_DIR", folder)
        .env_remove("WAYLAND_DISPLAY")
        .stderr(fs::File::create(&errors).expect("a file for messages"))
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    let status = loop {
        if let Some(status) = program.try_wait().expect("the program's state") {
            break Some(status);
        }
        if start.elapsed() > LIMIT {
            let _ = program.kill();
            let _ = program.wait();
            break None;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    let said = fs::read_to_string(&errors).unwrap_or_default();
    assert!(status.is_some(), "it hangs: {said}");
    (status.is_some_and(|status| status.success()), said)
}

/// Names of the nodes of a GLB.
fn nodes(path: &Path) -> Vec<String> {
    let bytes = fs::read(path).expect("the GLB");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let json: Value = serde_json::from_slice(&bytes[20..20 + length]).expect("its JSON");
    let nodes = json["nodes"].as_array().expect("nodes").iter();
    nodes
        .filter_map(|node| Some(node["name"].as_str()?.to_string()))
        .collect()
}

/// A picture that shows something: many colours, and not one all over.
fn picture(path: &Path) -> image::RgbImage {
    let picture = image::open(path).expect("a picture").to_rgb8();
    assert_eq!(picture.dimensions(), (640, 400), "{}", path.display());
    let colors: BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(
        colors.len() > 150,
        "{}: {} colours",
        path.display(),
        colors.len()
    );
    picture
}

/// Share of the pixels that differ clearly.
fn difference(a: &image::RgbImage, b: &image::RgbImage) -> f64 {
    let pixels = a.pixels().zip(b.pixels());
    let other = pixels.filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 24));
    other.count() as f64 / f64::from(a.width() * a.height())
}

#[test]
fn a_script_throws_breaks_looks_inside_turns_a_knob_and_saves() {
    let Some(display) = display() else { return };
    let folder = Folder::new("view");
    fs::write(folder.0.join("pane.toml"), PANE).expect("a scene");
    fs::write(folder.0.join("script.txt"), SCRIPT).expect("a script");
    let args = [
        "--script",
        "script.txt",
        "--shots",
        "shots",
        "--size",
        "640x400",
    ];
    let (went_well, said) = view(&display, &folder.0, &args);
    assert!(went_well, "{said}");
    let shots = folder.0.join("shots");

    let read = |name: &str| fs::read_to_string(shots.join(name)).expect("a file");
    let report: Value = serde_json::from_str(&read("first.json")).expect("JSON");
    let pieces = report["pieces"].as_u64().expect("a number") as usize;
    assert!(pieces > 3, "it broke into {pieces}");
    assert!(report["peak_stress_pa"].as_f64() > report["strength_pa"].as_f64());

    let nodes = nodes(&shots.join("state.glb"));
    let named = |part: &str| nodes.iter().filter(|name| name.contains(part)).count();
    assert_eq!(named("piece"), pieces, "{nodes:?}");
    assert_eq!(named("ball"), 1);

    assert!(
        read("turned.toml").contains("strength = 5000000000"),
        "{}",
        read("turned.toml")
    );
    let done = read("done.txt");
    for deed in ["open pane.toml", "throw ", "step 400", "knob strength 5000"] {
        assert!(done.contains(deed), "no `{deed}` in {done}");
    }

    let struck: Value = serde_json::from_str(&read("struck.json")).expect("JSON");
    assert!(struck["pieces"].as_u64() > Some(1), "{struck}");
    assert!(
        read("struck.txt").contains("swing "),
        "{}",
        read("struck.txt")
    );
    film(&shots.join("struck.gif"));
    let times: Value = serde_json::from_str(&read("times.json")).expect("JSON");
    assert!(times["draw_calls"].as_u64() > Some(1), "{times}");
    assert!(times["window_s"]["median"].as_f64() > Some(0.0), "{times}");

    let names = ["whole", "stress", "meshes", "both", "pieces"];
    let [whole, stress, meshes, both, last] =
        names.map(|name| picture(&shots.join(format!("{name}.png"))));
    for (a, b) in [
        (&whole, &stress),
        (&stress, &meshes),
        (&stress, &both),
        (&both, &last),
        (&last, &whole),
    ] {
        let share = difference(a, b);
        assert!(share > 0.01, "only {share} of two pictures differ");
    }
    keep(&shots);
}

/// A film of three pictures in which something moves.
fn film(path: &Path) {
    let file = BufReader::new(fs::File::open(path).expect("the GIF"));
    let decoder = image::codecs::gif::GifDecoder::new(file).expect("a GIF");
    let frames = image::AnimationDecoder::into_frames(decoder);
    let frames = frames.collect_frames().expect("its pictures");
    assert_eq!(frames.len(), 3);
    let [first, last] = [&frames[0], &frames[2]]
        .map(|frame| image::DynamicImage::ImageRgba8(frame.buffer().clone()).into_rgb8());
    let share = difference(&first, &last);
    assert!(
        share > 0.002,
        "only {share} of two pictures of a film differ"
    );
}

/// Keeps the pictures in the folder `FRANGIBLE_KEEP_SHOTS`, if it is set.
fn keep(shots: &Path) {
    let Some(folder) = std::env::var_os("FRANGIBLE_KEEP_SHOTS") else {
        return;
    };
    fs::create_dir_all(&folder).expect("the folder of FRANGIBLE_KEEP_SHOTS");
    for entry in fs::read_dir(shots).expect("the shots") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name");
        fs::copy(&path, Path::new(&folder).join(name)).expect("a copy");
    }
}

#[test]
fn a_script_ends_at_the_first_command_that_fails() {
    let Some(display) = display() else { return };
    let folder = Folder::new("view-fails");
    fs::write(folder.0.join("script.txt"), "scene glas\nsave glb x.glb\n").expect("a script");
    let args = [
        "--script",
        "script.txt",
        "--shots",
        ".",
        "--size",
        "640x400",
    ];
    let (went_well, said) = view(&display, &folder.0, &args);
    assert!(!went_well);
    assert!(said.contains("did you mean `glass`?"), "{said}");
    assert!(!folder.0.join("x.glb").exists());
}

#[test]
fn mistakes_are_told_without_a_window() {
    let folder = Folder::new("view-mistakes");
    let script = folder.0.join("script.txt");
    fs::write(&script, "scene pane\nthro 0,0,0 1,1,1\n").expect("a script");
    let script = script.to_string_lossy();
    for (args, part) in [
        (&["view", "--script", &script][..], "did you mean `throw`?"),
        (&["view", "--size", "huge"], "1280x800"),
        (&["view", "--script", "absent.txt"], "absent.txt"),
    ] {
        let output = frangible(args, None);
        let message = text(&output.stderr);
        assert!(
            !output.status.success() && message.contains(part),
            "{message}"
        );
    }
    let output = Command::new(env!("CARGO_BIN_EXE_frangible"))
        .arg("view")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the program starts");
    if cfg!(target_os = "linux") {
        assert!(
            text(&output.stderr).contains("no display"),
            "{}",
            text(&output.stderr)
        );
    }
}
