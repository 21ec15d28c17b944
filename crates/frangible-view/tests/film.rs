//! Films: the recording of the last seconds, and the written files. Drawing takes a graphics driver; without one it is skipped.

use std::path::Path;

use crate::common::{folder, give, pane};
use frangible_draw::has_adapter;
use frangible_view::{Command, Session};
use image::codecs::gif::GifDecoder;
use image::{AnimationDecoder, Frame, RgbaImage};

fn frames_of(path: &Path) -> Vec<Frame> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let frames = GifDecoder::new(file).unwrap().into_frames();
    frames.collect_frames().unwrap()
}

/// Share of the pixels that differ clearly.
fn difference(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let other = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| {
        (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 24)
    };
    let count = a.pixels().zip(b.pixels()).filter(other).count();
    count as f64 / f64::from(a.width() * a.height())
}

fn drawn(test: &str) -> Option<Session> {
    if !has_adapter() {
        println!("skipped: there is no graphics driver");
        return None;
    }
    Some(pane(test))
}

#[test]
fn the_last_seconds_are_kept_as_they_were_seen() {
    let mut session = pane("reel");
    give(&mut session, "frames 30");
    assert!((session.shown().reel - 0.5).abs() < 0.04);
    // A tenth of the speed: a picture of the scene is ten of the film.
    give(&mut session, "slow-motion 0.1");
    give(&mut session, "frames 6");
    assert!((session.shown().reel - 1.5).abs() < 0.05);
    // No more than twenty seconds, however slow.
    give(&mut session, "slow-motion 0.001");
    give(&mut session, "frames 3");
    assert!((session.shown().reel - 20.0).abs() < 0.02);
    give(&mut session, "reset");
    assert!(session.shown().reel < 0.04);
}

#[test]
fn a_gif_has_the_pictures_asked_for_and_something_moves_in_it() {
    let Some(mut session) = drawn("gif") else {
        return;
    };
    give(&mut session, "frames 24");
    let path = folder("gif").join("last.gif");
    let line = format!("save gif {} 0.4s 10fps 160x100", path.display());
    give(&mut session, &line);
    let frames = frames_of(&path);
    assert_eq!(frames.len(), 4);
    for frame in &frames {
        assert_eq!(frame.buffer().dimensions(), (160, 100));
        assert_eq!(frame.delay().numer_denom_ms(), (100, 1));
    }
    // The pane breaks in between.
    let share = difference(frames[0].buffer(), frames[3].buffer());
    assert!(share > 0.02, "{share}");
}

#[test]
fn single_pictures_and_a_still_are_files_of_the_size_asked_for() {
    let Some(mut session) = drawn("frames") else {
        return;
    };
    give(&mut session, "frames 24");
    let out = folder("frames");
    let line = format!("save frames {} 0.2s 10fps 160x100", out.join("f").display());
    give(&mut session, &line);
    let names: Vec<_> = std::fs::read_dir(out.join("f")).unwrap().collect();
    assert_eq!(names.len(), 2);
    let first = image::open(out.join("f/frame-0001.png")).unwrap();
    assert_eq!((first.width(), first.height()), (160, 100));
    let mut stills = Vec::new();
    for (name, eye) in [("a.png", "0.3,0.3,0.8"), ("b.png", "-0.8,0.3,0.3")] {
        give(&mut session, &format!("look-from {eye} 0,0.1,0"));
        let path = out.join(name);
        give(
            &mut session,
            &format!("save still {} 96x64 2spp", path.display()),
        );
        stills.push(image::open(path).unwrap().to_rgba8());
    }
    assert_eq!(stills[0].dimensions(), (96, 64));
    assert!(difference(&stills[0], &stills[1]) > 0.02, "another camera");
}

#[test]
fn a_film_can_be_given_up_and_leaves_no_file() {
    let Some(mut session) = drawn("given-up") else {
        return;
    };
    give(&mut session, "frames 4");
    let path = folder("given-up").join("still.png");
    let line = format!("save still {} 96x64 4000spp", path.display());
    session.apply(Command::parse(&line).unwrap()).unwrap();
    assert!(session.shown().filming.is_some());
    let error = session.apply(Command::parse("save gif x.gif").unwrap());
    assert!(error.unwrap_err().to_string().contains("cancel-save"));
    give(&mut session, "cancel-save");
    assert!(session.shown().filming.is_none() && !path.exists());
}

#[test]
fn films_that_cannot_be_made_say_why() {
    let mut session = Session::new();
    let refused = |session: &mut Session, line: &str, hint: &str| {
        let error = session.apply(Command::parse(line).unwrap()).unwrap_err();
        assert!(error.to_string().contains(hint), "{line}: {error}");
    };
    refused(&mut session, "save gif x.gif", "no scene is loaded");
    let mut session = pane("no-film");
    refused(&mut session, "save gif x.gif 60s", "must be 0.01 to 20 s");
    refused(&mut session, "save gif x.gif 500fps", "must be 1 to 60 1/s");
    refused(
        &mut session,
        "look-from 0,0,0 0,0,0",
        "position and target must differ",
    );
    if !has_adapter() {
        return;
    }
    let wait = |session: &mut Session, line: &str| {
        session.apply(Command::parse(line).unwrap()).unwrap();
        session.finish_jobs();
        session.shown().message.unwrap()
    };
    let (message, complaint) = wait(&mut session, "save gif x.gif 2x2");
    assert!(complaint && message.contains("2 × 2"), "{message}");
    let path = folder("no-film").join("x.mp4");
    let (message, complaint) = wait(
        &mut session,
        &format!("save mp4 {} 0.1s 10fps 64x64", path.display()),
    );
    let there = std::process::Command::new("ffmpeg")
        .arg("-version")
        .output();
    match there {
        Ok(_) => assert!(!complaint && path.exists(), "{message}"),
        Err(_) => assert!(message.contains("apt-get install ffmpeg"), "{message}"),
    }
}
