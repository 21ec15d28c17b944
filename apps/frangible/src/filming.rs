//! `frangible film`: a break in slow motion, or its microseconds.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use frangible_draw::{
    ColoredSurface, FilmFormat, FilmWriter, RgbImage, SlowMotion, Studio, SurfaceLine,
};
use frangible_export::View;
use frangible_scenes::{
    BakedBody, Scene, Sounded, Wave, bake_opened, first_break, open_sources, play,
};

use crate::args::FilmArgs;
use crate::progress::Bar;
use crate::request::scene_of;
use crate::say::say;
use crate::soundtrack::soundtrack;

/// Seconds for which the last picture stands.
const END: f64 = 0.6;

/// The camera's distance over that of a still.
const NEARER: f32 = 0.8;

/// The colours end at the tension that this share of all places and times stays below: that right under the contact would leave
/// nothing for the rest.
const WITHIN: f64 = 0.995;

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
            "`{}` is no film that can be written; name a file .gif, .webp or .mp4, or a folder of pictures",
            path.display()
        )
    })?;
    // Before minutes of baking.
    let studio = Studio::new(args.frame[0], args.frame[1])?;
    let mut film = FilmWriter::begin(&path, format, args.frame, args.rate)?;
    let bar = Bar::new(false);
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let sources = open_sources(&scene)?;
    let baked = bake_opened(&scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    let stop = interrupted()?;
    let count = args.pictures();
    let mut pictures = 0;
    let mut add = |picture: RgbImage| -> Result<bool, Box<dyn Error>> {
        bar.show(
            &format!("{}: picture {} of {count}", scene.name, pictures + 1),
            pictures as f64 / count as f64,
        );
        pictures += 1;
        film.add(picture)?;
        Ok(!stop.load(Ordering::Relaxed))
    };
    let sound = if args.microseconds {
        microseconds(&scene, &baked, &studio, args, &bar, &mut add)?;
        None
    } else {
        slow_motion(&scene, &baked, &studio, args, &bar, &mut add)?
    };
    drop(bar);
    if let Some(mut sound) = sound {
        let samples = pictures as f64 / args.rate * sound.config.rate;
        let channels = sound.config.listener.channels;
        sound.samples.truncate(samples as usize * channels);
        film.set_sound(sound.wav()?);
    }
    film.finish()?;
    let cut_short = if pictures < count { ", cut short" } else { "" };
    say(&format!(
        "{pictures} pictures{cut_short}\n{}\n",
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

/// Takes a picture, and says whether more are wanted.
type Add<'a> = dyn FnMut(RgbImage) -> Result<bool, Box<dyn Error>> + 'a;

/// The scene, slowed down where it breaks; the camera goes along. Returns what it sounds like.
fn slow_motion(
    scene: &Scene,
    baked: &[BakedBody],
    studio: &Studio,
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
        let drawn = if args.traced {
            studio.frame_between(recording, frame, &view)?
        } else {
            studio.film_frame_between(recording, frame, &view)?
        };
        if !add(drawn)? {
            break;
        }
    }
    if args.no_sound {
        return Ok(None);
    }
    bar.show(&format!("{}: listening", scene.name), 1.0);
    soundtrack(&run, scene, &clock, args.seconds).map(Some)
}

/// The first break in its own time: the body stands still, tension runs over it, and cracks go with it.
fn microseconds(
    scene: &Scene,
    baked: &[BakedBody],
    studio: &Studio,
    args: &FilmArgs,
    bar: &Bar,
    add: &mut Add<'_>,
) -> Result<(), Box<dyn Error>> {
    let found = first_break(scene, baked, &mut |done| {
        bar.show(&format!("{}: until it breaks", scene.name), done);
    })?;
    let Some(found) = found else {
        return Err("nothing breaks in this scene, so there are no microseconds to film; hit it harder (--drop, --ball)".into());
    };
    let still = ((END * args.rate) as usize).max(1);
    let count = args.pictures();
    let moments = count.saturating_sub(still).max(2);
    let wave = found.wave(moments, &mut |done| {
        bar.show(&format!("{}: the wave", scene.name), done);
    })?;
    let most = f64::from(wave.quantile(WITHIN)).max(wave.strength);
    let view = nearer(found.stills(&[&[]], 0.0)[0].camera);
    for picture in 0..count {
        let moment = picture.min(moments - 1);
        let surface = surface_at(&wave, moment, most, &found.name);
        if !add(studio.colored_frame(&surface, &view)?)? {
            break;
        }
    }
    Ok(())
}

/// A view of stills leaves room for headings and arrows; the captions of a film take less.
fn nearer(view: View) -> View {
    View {
        eye: view.target + (view.eye - view.target) * NEARER,
        ..view
    }
}

/// What is to be drawn of a moment; the colours end at a tension of `most`, Pa.
fn surface_at(wave: &Wave, moment: usize, most: f64, name: &str) -> ColoredSurface {
    let now = &wave.moments[moment];
    let value = |tension: &f32| (f64::from(*tension) / most).clamp(0.0, 1.0) as f32;
    let so_far = wave.cuts.partition_point(|cut| cut.time <= now.time);
    let line = |cut: &frangible_scenes::SurfaceCut| SurfaceLine {
        ends: cut.ends,
        normal: cut.normal,
    };
    ColoredSurface {
        positions: wave.positions.clone(),
        triangles: wave.triangles.clone(),
        values: now.tension.iter().map(value).collect(),
        lines: wave.cuts[..so_far].iter().map(line).collect::<Vec<_>>(),
        captions: vec![
            format!("{name}: {:.0} µs after the touch", 1e6 * now.time),
            format!("force {:.0} N", now.force),
        ],
        legend: [
            "0".into(),
            format!("{:.0} MPa", 1e-6 * most),
            format!("tension (it may tear from {:.0} MPa)", 1e-6 * wave.strength),
        ],
    }
}
