//! `frangible-lab gallery`: the pictures and the film that the documentation shows.
//!
//! The sheets are those of `frangible break`, drawn by following light, made smaller and written as JPEG: at a quality of 90 and with all
//! colours a sheet takes 80 to 200 kB and looks as it did; as a PNG it takes 400 to 980 kB, and with a palette of 256 colours 320 to 510 kB.

use std::path::Path;

use frangible_lab::Result;
use frangible_photo::{
    FilmFormat, FilmWriter, Picture, SheetOptions, SlowMotion, Studio, contact_sheet,
};
use frangible_recording::{make_folder, write_atomically};
use frangible_scenes::{Run, SCENE_NAMES, bake_with, play, scene};
use image::RgbImage;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{FilterType, resize};

use crate::args::GalleryArgs;
use crate::output::{Bar, say};

/// Width of a sheet, pixels, and quality of its file, of 100.
const WIDTH: u32 = 960;
const QUALITY: u8 = 90;

/// The film: scenes, each with the factor by which it is slowed down.
const FILM: [(&str, f64); 5] = [
    ("wine-glass", 12.0),
    ("statue", 8.0),
    ("bottle", 16.0),
    ("piggy-bank", 10.0),
    ("plate", 10.0),
];

/// Size of its pictures, pixels, pictures a second, seconds of each scene, and quality of 100.
const FRAME: [u32; 2] = [480, 270];
const RATE: f64 = 15.0;
const SECONDS: f64 = 3.0;
const FILM_QUALITY: f32 = 80.0;

/// Pictures over which one scene goes over into the next.
const FADE: usize = 4;

pub(crate) fn run(args: &GalleryArgs) -> Result<()> {
    make_folder(&args.write, &[], "--write")?;
    if args.hero {
        return film(&args.write.join("hero.webp"));
    }
    let all = SCENE_NAMES.map(String::from).to_vec();
    let scenes = if args.scenes.is_empty() {
        &all
    } else {
        &args.scenes
    };
    // A wrong name is reported before minutes of work.
    for name in scenes {
        scene(name)?;
    }
    for name in scenes {
        let sheet = contact_sheet(&played(name)?.recording, &SheetOptions::default())?;
        let height = WIDTH * sheet.height() / sheet.width();
        let small = resize(&RgbImage::from(sheet), WIDTH, height, FilterType::Lanczos3);
        let mut bytes = Vec::new();
        JpegEncoder::new_with_quality(&mut bytes, QUALITY).encode_image(&small)?;
        let path = args.write.join(format!("{name}.jpg"));
        write_atomically(&path, &bytes)?;
        say(&format!("{} {} kB\n", path.display(), bytes.len() / 1000))?;
    }
    Ok(())
}

/// A built-in scene, as `frangible break` plays it.
fn played(name: &str) -> Result<Run> {
    let bar = Bar::new();
    let scene = scene(name)?;
    let baked = bake_with(&scene, |p| bar.show(name, 0.5 * p.fraction))?;
    Ok(play(&scene, &baked, &mut |share| {
        bar.show(name, 0.5 + 0.5 * share);
    })?)
}

/// Five breaks, one after the other, by following light.
fn film(path: &Path) -> Result<()> {
    let studio = Studio::new(FRAME[0], FRAME[1])?;
    let mut film = FilmWriter::begin(path, FilmFormat::WebP, FRAME, RATE)?;
    film.set_quality(FRAME, FILM_QUALITY)?;
    let count = (SECONDS * RATE) as usize;
    let mut last: Option<Picture> = None;
    for (number, (name, slow)) in FILM.into_iter().enumerate() {
        let run = played(name)?;
        let recording = &run.recording;
        let clock = SlowMotion::new(recording, SECONDS, slow);
        let bar = Bar::new();
        for picture in 0..count {
            let done = (number * count + picture) as f64 / (FILM.len() * count) as f64;
            bar.show(name, done);
            let frame = clock.frame(picture as f64 / RATE);
            let mut drawn = studio.frame_between(recording, frame, &clock.view(frame))?;
            if let Some(last) = last.as_ref().filter(|_| picture < FADE) {
                blend(&mut drawn, last, (picture + 1) as f32 / (FADE + 1) as f32);
            }
            if picture + 1 == count {
                last = Some(drawn.clone());
            }
            film.add(&drawn)?;
        }
    }
    film.finish()?;
    let size = std::fs::metadata(path)?.len();
    Ok(say(&format!("{} {} kB\n", path.display(), size / 1000))?)
}

/// Shows so much of a picture, and the rest of the one before it.
fn blend(picture: &mut Picture, before: &Picture, share: f32) {
    for (new, &old) in picture.bytes_mut().iter_mut().zip(before.bytes()) {
        *new = (f32::from(*new) * share + f32::from(old) * (1.0 - share)).round() as u8;
    }
}
