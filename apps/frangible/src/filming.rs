//! `frangible film`: a break in slow motion, or its microseconds.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use frangible_draw::{ColoredSurface, FilmFormat, FilmWriter, RgbImage, Studio, SurfaceLine};
use frangible_export::{Recording, View};
use frangible_scenes::{BakedBody, Scene, Wave, bake_opened, first_break, open_sources, play};

use crate::args::FilmArgs;
use crate::progress::Bar;
use crate::request::scene_of;
use crate::say::say;

/// Share of a film that passes before the first crack, at least: from the moment that the first view is of.
const BEFORE: f64 = 0.1;

/// Share of a film in which it is slow.
const SLOW: f64 = 0.55;

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
            "`{}` is no film that can be written; name a file .gif or .mp4, or a folder of pictures",
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
    if args.microseconds {
        microseconds(&scene, &baked, &studio, args, &bar, &mut add)?;
    } else {
        slow_motion(&scene, &baked, &studio, args, &bar, &mut add)?;
    }
    drop(bar);
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

/// The scene, slowed down where it breaks; the camera goes along.
fn slow_motion(
    scene: &Scene,
    baked: &[BakedBody],
    studio: &Studio,
    args: &FilmArgs,
    bar: &Bar,
    add: &mut Add<'_>,
) -> Result<(), Box<dyn Error>> {
    let run = play(scene, baked, &mut |done| {
        bar.show(&format!("{}: breaking", scene.name), done);
    })?;
    let recording = &run.recording;
    let count = args.pictures();
    let clock = Clock::of(recording, args.seconds, args.slow);
    for picture in 0..count {
        let frame = clock.frame(picture as f64 / args.rate);
        let view = view_at(recording, frame);
        if !add(studio.film_frame_between(recording, frame, &view)?)? {
            break;
        }
    }
    Ok(())
}

/// Which frame of a recording a film shows when.
struct Clock {
    /// Times of the film, s, and frames of the recording: straight between them.
    knots: [[f64; 2]; 4],
}

impl Clock {
    /// A film of so many seconds, so many times slower than it is where things break.
    fn of(recording: &Recording, seconds: f64, slow: f64) -> Self {
        let rate = f64::from(recording.frame_rate);
        let moments = recording.moments;
        let (crack, end) = (moments.first_crack as f64, moments.at_rest as f64);
        let moving = (seconds - END).max(0.5 * seconds);
        let first = (moments.before as f64).min(crack);
        let before = ((crack - first) / rate).clamp(BEFORE * moving, 0.4 * moving);
        let slowly = SLOW * moving;
        let parted = (crack + slowly * rate / slow).min(end);
        Self {
            knots: [
                [0.0, first],
                [before, crack],
                [before + slowly, parted],
                [moving, end.max(parted)],
            ],
        }
    }

    fn frame(&self, time: f64) -> f64 {
        between(&self.knots, time)
    }
}

/// The value of a line through these points, which is level before the first and after the last.
fn between(knots: &[[f64; 2]], at: f64) -> f64 {
    let next = knots.partition_point(|knot| knot[0] <= at);
    match (next.checked_sub(1).map(|i| knots[i]), knots.get(next)) {
        (None, Some(first)) => first[1],
        (Some([from, a]), Some([to, b])) => a + (b - a) * (at - from) / (to - from),
        (Some([_, last]), None) => last,
        (None, None) => 0.0,
    }
}

/// The camera on its way between the views of the moments.
fn view_at(recording: &Recording, frame: f64) -> View {
    let Some(views) = recording.views else {
        return recording.camera;
    };
    let moments = recording.labelled_moments().map(|(frame, _)| frame as f64);
    let next = moments
        .partition_point(|&moment| moment <= frame)
        .clamp(1, 3);
    let [from, to] = [next - 1, next].map(|i| moments[i]);
    let share = ((frame - from) / (to - from).max(1e-9)).clamp(0.0, 1.0) as f32;
    // It starts and stops gently.
    let share = share * share * (3.0 - 2.0 * share);
    let [a, b] = [views[next - 1], views[next]];
    View {
        eye: a.eye.lerp(b.eye, share),
        target: a.target.lerp(b.target, share),
        up: a.up.lerp(b.up, share),
        vertical_fov: a.vertical_fov + (b.vertical_fov - a.vertical_fov) * share,
    }
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

#[cfg(test)]
mod tests {
    use frangible::glam::Vec3;
    use frangible_export::Moments;

    use super::*;

    #[test]
    fn a_film_is_slow_where_things_break_and_ends_at_rest() {
        let recording = Recording {
            frame_rate: 60.0,
            frame_count: 400,
            moments: Moments {
                before: 50,
                first_crack: 60,
                just_after: 66,
                at_rest: 399,
                moves_on: false,
            },
            ..Recording::default()
        };
        let clock = Clock::of(&recording, 6.0, 8.0);
        let frames: Vec<f64> = (0..120).map(|i| clock.frame(f64::from(i) / 20.0)).collect();
        assert!(frames.is_sorted());
        assert_eq!(frames[119], 399.0);
        assert_eq!(frames[0], 50.0);
        let at = frames.partition_point(|frame| *frame < 60.0);
        let step = frames[at + 2] - frames[at + 1];
        assert!((step - 60.0 / 8.0 / 20.0).abs() < 1e-9, "{step}");
        // A scene that is over before the film is slow for as long as it lasts.
        let short = Clock::of(&recording, 6.0, 1.0);
        assert!((0..120).all(|i| short.frame(f64::from(i) / 20.0) <= 399.0));
    }

    #[test]
    fn the_camera_is_at_each_moment_where_its_view_is() {
        let view = |x: f32| View {
            eye: Vec3::X * x,
            ..View::default()
        };
        let recording = Recording {
            moments: Moments {
                before: 0,
                first_crack: 10,
                just_after: 10,
                at_rest: 30,
                moves_on: false,
            },
            views: Some([0.0, 1.0, 2.0, 3.0].map(view)),
            ..Recording::default()
        };
        let eye = |frame| view_at(&recording, frame).eye.x;
        assert_eq!(
            [eye(0.0), eye(5.0), eye(20.0), eye(30.0), eye(99.0)],
            [0.0, 0.5, 2.5, 3.0, 3.0]
        );
    }
}
