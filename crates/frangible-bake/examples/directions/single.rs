//! One crack under a tension or bending that is the same everywhere.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::modal::Motion;
use frangible::internals::{Factors, Fields, follow_traced};
use frangible::{Asset, Breakable, FractureConfig};
use rayon::prelude::*;

use crate::cuts::{Cut, cuts};
use crate::pane::{pane, uniform};
use crate::{Options, Result};

/// Prints the paths and speeds of single cracks.
pub(crate) fn single(options: &Options) -> Result<()> {
    let mut asset = uniform(pane(options)?);
    asset.parts_mut().material.roughness_amplitude = options.get("rough", 0.0);
    asset.parts_mut().material.branching_constant = f64::INFINITY;
    let asset = Arc::new(asset);
    let bends = options.get("bend", 0.0) > 0.0;
    let starts = options.get("starts", 8.0) as usize;
    let over = options.get("over", 1.5);
    let mut config = FractureConfig::default();
    if options.get("planar", 0.0) > 0.0 {
        config.model = frangible::internals::Model::Paper;
    }
    let material = asset.material();
    let rayleigh = material.rayleigh_speed();
    println!(
        "angle  turned: rms, most of a path; off the line, mm in 100 mm; speed over what it should be: mean, least, most; arrival scatter"
    );
    for step in 0..=6 {
        let angle = f64::from(step) * 15.0_f64.to_radians();
        let runs: Vec<Run> = (0..starts)
            .into_par_iter()
            .flat_map_iter(|number| {
                let place = Vec3::new(
                    (0.02 * ((number as f64 * 0.754_877_67).fract() - 0.5)) as f32,
                    (0.02 * ((number as f64 * 0.569_840_29).fract() - 0.5)) as f32,
                    0.002,
                );
                run(&asset, &config, place, angle, over, bends, 0.5 * rayleigh)
            })
            .collect();
        let count = runs.len().max(1) as f64;
        let turned = (runs.iter().map(|r| r.turned.powi(2)).sum::<f64>() / count).sqrt();
        let most = runs.iter().map(|r| r.turned).fold(0.0, f64::max);
        let off = (runs.iter().map(|r| r.off.powi(2)).sum::<f64>() / count).sqrt();
        let speeds = || runs.iter().map(|r| r.speed);
        println!(
            "{:3}°   {turned:.2}° {most:.2}°   {off:.2}   {:.3} {:.3} {:.3}  {:.3}  ({} paths, {:.1} mm)",
            15 * step,
            speeds().sum::<f64>() / count,
            speeds().fold(f64::INFINITY, f64::min),
            speeds().fold(0.0, f64::max),
            runs.iter().map(|r| r.scatter).sum::<f64>() / count,
            runs.len(),
            runs.iter().map(|r| r.length).sum::<f64>() / count,
        );
    }
    Ok(())
}

/// One arm of a single crack.
struct Run {
    /// Root of the mean square of its direction against where it should run, by area, degrees.
    turned: f64,
    /// Distance of its end from the line, over the length of the path, %.
    off: f64,
    /// Speed over the one it should have.
    speed: f64,
    /// Scatter of arrival times about the straight run, in those of a mean edge.
    scatter: f64,
    /// Length, mm.
    length: f64,
}

/// Follows both arms of the crack that starts at the flaw nearest to a place, across a tension at this angle.
fn run(
    asset: &Arc<Asset>,
    config: &FractureConfig,
    place: Vec3,
    angle: f64,
    over: f64,
    bends: bool,
    speed: f64,
) -> Vec<Run> {
    let mesh = asset.fracture();
    let near = (0..mesh.tets.len()).min_by(|&a, &b| {
        mesh.centroid(a)
            .distance(place)
            .total_cmp(&mesh.centroid(b).distance(place))
    });
    let Some(start) = near else { return Vec::new() };
    let none = Factors {
        weak_points: 0.0,
        ..Factors::ONE
    };
    let mut of_tet = vec![none; mesh.tets.len()];
    of_tet[start] = Factors {
        weak_points: 1e9,
        ..Factors::ONE
    };
    let mut fields = Fields::default();
    fields.of_tet = of_tet;
    let kind = Breakable::uniform(Arc::clone(asset))
        .and_then(|kind| kind.with_fields(fields))
        .expect("a pane");
    let body = kind.body(1);
    let material = asset.material();
    // Tension σ across the crack, which runs at the angle.
    let (young, poisson) = (material.youngs_modulus, material.poisson_ratio);
    let stress = over * material.strength;
    let (along, across) = (-poisson * stress / young, stress / young);
    let (sin, cos) = angle.sin_cos();
    let strain = [
        along * cos * cos + across * sin * sin,
        along * sin * sin + across * cos * cos,
        2.0 * (along - across) * sin * cos,
    ];
    let mut q = [0.0_f32; 6];
    for (k, e) in strain.iter().enumerate() {
        q[k + 3 * usize::from(bends)] = *e as f32;
    }
    let steps = 64;
    let time_step = 0.3 / speed / steps as f64;
    let motion = Motion::new(q.repeat(steps), 6, 1e9, 1e9);
    let (_, trace) = follow_traced(&body, &motion, &[], time_step, config).expect("a motion");
    let first = cuts(asset, &trace).min_by(|a, b| a.time.total_cmp(&b.time));
    let Some(first) = first else {
        return Vec::new();
    };
    let origin = first.middle;
    let direction = Vec3::new(cos as f32, sin as f32, 0.0);
    let mut arms = Vec::new();
    for arm in [1.0_f32, -1.0] {
        let along = arm * direction;
        let own: Vec<Cut> = cuts(asset, &trace)
            .filter(|cut| (cut.middle - origin).dot(along) > 0.01)
            .collect();
        if own.is_empty() {
            continue;
        }
        let area: f64 = own.iter().map(|c| c.area).sum();
        let off_angle = |c: &Cut| {
            let turned = (c.angle - angle).rem_euclid(std::f64::consts::PI);
            turned.min(std::f64::consts::PI - turned).to_degrees()
        };
        let turned = (own
            .iter()
            .map(|c| c.area * off_angle(c).powi(2))
            .sum::<f64>()
            / area)
            .sqrt();
        let far = |c: &Cut| f64::from((c.middle - origin).dot(along));
        let last = own.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(last) = last else { continue };
        let off =
            100.0 * f64::from((last.middle - origin).dot(Vec3::Z.cross(along)).abs()) / far(last);
        // Least squares of distance over time.
        let n = own.len() as f64;
        let (mt, mx) = (
            own.iter().map(|c| c.time).sum::<f64>() / n,
            own.iter().map(&far).sum::<f64>() / n,
        );
        let covariance: f64 = own.iter().map(|c| (c.time - mt) * (far(c) - mx)).sum();
        let variance: f64 = own.iter().map(|c| (c.time - mt).powi(2)).sum();
        let slope = covariance / variance;
        let rest: f64 = own
            .iter()
            .map(|c| (far(c) - mx - slope * (c.time - mt)).powi(2))
            .sum();
        arms.push(Run {
            turned,
            off,
            speed: slope / speed,
            scatter: (rest / n).sqrt() / f64::from(mesh.mean_edge()),
            length: 1e3 * far(last),
        });
    }
    arms
}
