//! The film of the microseconds in which a body breaks, by the renderer.

use std::error::Error;

use frangible_draw::{ColoredSurface, Raster, SurfaceLine};
use frangible_recording::View;
use frangible_scenes::{BakedBody, Scene, Wave, first_break};

use crate::args::FilmArgs;
use crate::filming::Add;
use crate::progress::Bar;

/// Seconds for which the last picture stands.
const END: f64 = 0.6;

/// The camera's distance over that of a still.
const NEARER: f32 = 0.8;

/// The colours end at the tension that this share of all places and times stays below: that right under the contact would leave
/// nothing for the rest.
const WITHIN: f64 = 0.995;

/// The first break in its own time: the body stands still, tension runs over it, and cracks go with it.
pub(crate) fn microseconds(
    scene: &Scene,
    baked: &[BakedBody],
    args: &FilmArgs,
    bar: &Bar,
    add: &mut Add<'_>,
) -> Result<(), Box<dyn Error>> {
    let [width, height] = args.frame;
    let raster = Raster::new(width, height)?;
    let found = first_break(scene, baked, &mut |done| {
        bar.show(
            &format!("{}: simulating up to the first break", scene.name),
            done,
        );
    })?;
    let Some(found) = found else {
        return Err("nothing breaks in this scene, so there is nothing to film; hit the body harder (--drop, --ball)".into());
    };
    let still = ((END * args.rate) as usize).max(1);
    let count = args.pictures();
    let moments = count.saturating_sub(still).max(2);
    let wave = found.wave(moments, &mut |done| {
        bar.show(&format!("{}: computing the stress wave", scene.name), done);
    })?;
    let most = f64::from(wave.quantile(WITHIN)).max(wave.strength);
    let view = nearer(found.stills(&[&[]], 0.0)[0].camera);
    for picture in 0..count {
        let moment = picture.min(moments - 1);
        let surface = surface_at(&wave, moment, most, &found.name);
        if !add(raster.colored_frame(&surface, &view)?)? {
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

/// Surface to draw at a moment of the wave. The colour scale ends at a tension of `most`, Pa.
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
            format!("{name}: {:.0} µs after contact", 1e6 * now.time),
            format!("force {:.0} N", now.force),
        ],
        legend: [
            "0".into(),
            format!("{:.0} MPa", 1e-6 * most),
            format!(
                "tension (cracks can start at {:.0} MPa)",
                1e-6 * wave.strength
            ),
        ],
    }
}
