//! Each example draws its picture without a window, and it is the one in the documentation. This needs a Vulkan driver; a software one
//! will do (Debian: `mesa-vulkan-drivers`). With UPDATE_PICTURES set the pictures of the documentation are drawn anew.

use std::path::{Path, PathBuf};
use std::process::Command;

use image::RgbImage;

/// Largest mean difference of a picture from the one of the documentation, of 255: another driver rounds otherwise, and a shard that rolls
/// on is elsewhere.
const DIFFERENCE: f64 = 6.0;

/// Smallest deviation of a picture's pixels from their mean, of 255: an empty picture has none.
const CONTRAST: f64 = 15.0;

fn documented(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../docs/bevy/{name}.png"))
}

fn draw(program: &str, name: &str, arguments: &[&str]) {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    let _ = std::fs::remove_file(&file);
    let mut command = Command::new(program);
    let output = command.arg("--picture").arg(&file).args(arguments).output();
    let output = output.expect("the example runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "no picture; is there a Vulkan driver?\n{said}"
    );
    let known = documented(name);
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        std::fs::copy(&file, &known).expect("the folder of pictures can be written to");
    }
    let [drawn, known] =
        [&file, &known].map(|file| image::open(file).expect("a picture").to_rgb8());
    assert!(
        contrast(&drawn) > CONTRAST,
        "the picture is empty: {}",
        contrast(&drawn)
    );
    let off = difference(&drawn, &known);
    assert!(
        off < DIFFERENCE,
        "{off:.1} of 255 from docs/bevy/{name}.png: look at {}, and draw anew with UPDATE_PICTURES=1",
        file.display()
    );
}

fn contrast(picture: &RgbImage) -> f64 {
    let values = || picture.as_raw().iter().map(|&v| f64::from(v));
    let count = picture.as_raw().len() as f64;
    let mean = values().sum::<f64>() / count;
    (values().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

fn difference(a: &RgbImage, b: &RgbImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let pairs = a.as_raw().iter().zip(b.as_raw());
    pairs.map(|(&a, &b)| f64::from(a.abs_diff(b))).sum::<f64>() / a.as_raw().len() as f64
}

#[test]
fn a_glass_falls() {
    draw(env!("CARGO_BIN_EXE_glass"), "glass", &[]);
}

#[test]
fn a_stone_flies_through_a_window() {
    draw(env!("CARGO_BIN_EXE_window"), "window", &[]);
}

#[test]
fn weak_points_are_drawn() {
    draw(
        env!("CARGO_BIN_EXE_glass"),
        "gizmos",
        &["--gizmos", "--steps", "117"],
    );
}

#[test]
fn a_ball_flies_through_a_wall() {
    draw(env!("CARGO_BIN_EXE_wall"), "wall", &[]);
}

#[test]
fn a_ball_flies_through_a_china_shop() {
    draw(env!("CARGO_BIN_EXE_china_shop"), "china_shop", &[]);
}
