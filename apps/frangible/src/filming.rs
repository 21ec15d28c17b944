//! `frangible film`: a break in slow motion, or its microseconds.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use frangible_photo::{FilmFormat, FilmWriter, Picture, SlowMotion, Studio};
use frangible_recording::{Recording, View};
use frangible_scenes::{BakedBody, Scene, Sounded, bake_opened, open_scene, play};

use crate::args::FilmArgs;
use crate::level::encoded;
#[cfg(feature = "view")]
use crate::microseconds::microseconds;
use crate::progress::Bar;
use crate::request::scene_of;
use crate::say::say;
use crate::soundtrack::soundtrack;

const NO_RENDERER: &str = "--microseconds requires a build with the renderer: cargo run --release --features view -- film --microseconds";

pub(crate) fn run(args: &FilmArgs) -> Result<(), Box<dyn Error>> {
    check("--seconds", args.seconds, [0.2, 120.0])?;
    check("--rate", args.rate, [1.0, 60.0])?;
    check("--slow", args.slow, [1.0, 1e4])?;
    let request = scene_of(args.file.as_deref(), &args.scene)?;
    let scene = request.scene;
    let name = if args.microseconds {
        "-microseconds.gif"
    } else {
        ".gif"
    };
    let path = (args.output.clone())
        .unwrap_or_else(|| PathBuf::from("out").join(format!("{}{name}", scene.name)));
    let format = FilmFormat::of(&path).ok_or_else(|| {
        format!(
            "cannot write the film `{}`: its format is unknown; name a .gif, .webp or .mp4 file, or a folder for separate pictures",
            path.display()
        )
    })?;
    // Before minutes of baking.
    if args.microseconds && !cfg!(feature = "view") {
        return Err(NO_RENDERER.into());
    }
    let draw = drawer(args)?;
    let mut film = FilmWriter::begin(&path, format, args.frame, args.rate)?;
    let bar = Bar::new(false);
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let (scene, sources) = open_scene(&scene)?;
    let baked = bake_opened(&scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    let stop = interrupted()?;
    let count = args.pictures();
    let mut pictures = 0;
    let mut add = |picture: Picture| -> Result<bool, Box<dyn Error>> {
        bar.show(
            &format!("{}: picture {} of {count}", scene.name, pictures + 1),
            pictures as f64 / count as f64,
        );
        pictures += 1;
        film.add(&picture)?;
        Ok(!stop.load(Ordering::Relaxed))
    };
    let sound = if args.microseconds {
        microseconds(&scene, &baked, args, &bar, &mut add)?;
        None
    } else {
        slow_motion(&scene, &baked, &*draw, args, &bar, &mut add)?
    };
    drop(bar);
    let mut heard = String::new();
    if let Some(mut sound) = sound {
        let samples = pictures as f64 / args.rate * sound.config.rate;
        let channels = sound.config.listener.channels;
        sound.samples.truncate(samples as usize * channels);
        let (bytes, report) = encoded(&sound, args.level.into())?;
        film.set_sound(bytes);
        heard = format!("note {}\n", report.note());
    }
    film.finish()?;
    let cut_short = if pictures < count { ", cut short" } else { "" };
    say(&format!(
        "{pictures} pictures{cut_short}\n{}\n{heard}",
        path.display()
    ))?;
    Ok(())
}

fn check(name: &str, value: f64, [least, most]: [f64; 2]) -> Result<(), String> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(format!("{name} is {value}; it must be {least} to {most}"))
}

/// Set once the user has asked to stop: the film then ends where it is.
fn interrupted() -> Result<Arc<AtomicBool>, Box<dyn Error>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        // Whoever asks twice does not want to wait for the picture.
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })?;
    Ok(stop)
}

/// Takes a picture. Returns false if no more are wanted.
pub(crate) type Add<'a> = dyn FnMut(Picture) -> Result<bool, Box<dyn Error>> + 'a;

#[cfg(not(feature = "view"))]
fn microseconds(
    _: &Scene,
    _: &[BakedBody],
    _: &FilmArgs,
    _: &Bar,
    _: &mut Add<'_>,
) -> Result<(), Box<dyn Error>> {
    Err(NO_RENDERER.into())
}

/// Draws a moment of a recording.
type Draw = dyn Fn(&Recording, f64, &View) -> Result<Picture, Box<dyn Error>>;

/// Returns the function that draws the pictures: the renderer if this build has one and `--traced` is not given, else the path tracer.
fn drawer(args: &FilmArgs) -> Result<Box<Draw>, Box<dyn Error>> {
    let [width, height] = args.frame;
    #[cfg(feature = "view")]
    if !args.traced {
        let raster = frangible_draw::Raster::new(width, height)?;
        return Ok(Box::new(move |recording, frame, view| {
            Ok(raster.frame(recording, frame, view)?)
        }));
    }
    let studio = Studio::new(width, height)?;
    Ok(Box::new(move |recording, frame, view| {
        Ok(studio.frame_between(recording, frame, view)?)
    }))
}

/// Draws the scene, slowed down where it breaks; the camera goes along. Returns the sound.
fn slow_motion(
    scene: &Scene,
    baked: &[BakedBody],
    draw: &Draw,
    args: &FilmArgs,
    bar: &Bar,
    add: &mut Add<'_>,
) -> Result<Option<Sounded>, Box<dyn Error>> {
    let run = play(scene, baked, &mut |done| {
        bar.show(&format!("{}: breaking", scene.name), done);
    })?;
    let recording = &run.recording;
    let count = args.pictures();
    let clock = SlowMotion::new(recording, args.seconds, args.slow);
    for picture in 0..count {
        let frame = clock.frame(picture as f64 / args.rate);
        let view = clock.view(frame);
        if !add(draw(recording, frame, &view)?)? {
            break;
        }
    }
    if args.no_sound {
        return Ok(None);
    }
    bar.show(&format!("{}: synthesising sound", scene.name), 1.0);
    soundtrack(&run, scene, &clock, args.seconds).map(Some)
}
