//! The stress of a hit plate beside the series of all its modes, and of a narrow load beside an elastic layer.

use frangible::FractureConfig;
use frangible::internals::near_field::PlateTheory;
use frangible_bake::BakeError;

use crate::verify::blows::plate::Terms;
use crate::verify::blows::probe::{
    self, BALL, PLATE, Place, about, ball, body, felt, following, places,
};
use crate::verify::case::Findings;
use crate::verify::check::{Check, check};

const SERIES: &str = "Navier's series of a thin plate, all modes";
const LAYER: &str = "the series with Mindlin's frequencies and an elastic layer's far face";

/// Distances from the contact, m.
pub(crate) const DISTANCES: [f64; 5] = [1e-3, 2e-3, 4e-3, 8e-3, 16e-3];

pub(super) fn compute() -> Result<Findings, BakeError> {
    let asset = probe::plate()?;
    let mut checks = Vec::new();
    for (theory, terms, source, name) in [
        (PlateTheory::Kirchhoff, Terms::Thin, SERIES, "thin"),
        (PlateTheory::Layer, Terms::Layer, LAYER, "layer"),
    ] {
        for (modes, tolerance) in [(50, 3.0), (100, 4.0)] {
            let body = body(following(asset.clone(), modes))?;
            let mut config = FractureConfig::default();
            (config.near_field, config.residual) = (Some(theory), false);
            let compared = Compared::of(&body, &config, terms, [0.0; 2])?;
            checks.extend(compared.checks(&format!("{name}, {modes} modes"), tolerance, source));
        }
    }
    Ok(checks.into())
}

/// Radial and hoop stress, computed and of the series, at places and times.
pub(crate) struct Compared {
    pub(crate) places: Vec<Place>,
    /// For each time, for each place: computed and reference, radial and hoop, Pa.
    pub(crate) stress: Vec<Vec<[[f64; 2]; 2]>>,
}

impl Compared {
    pub(crate) fn of(
        body: &frangible::Body,
        config: &FractureConfig,
        terms: Terms,
        centre: [f64; 2],
    ) -> Result<Self, BakeError> {
        let blow = probe::blow(body, ball(centre, 20.0, BALL), config)?;
        let report = &blow.reports()[0];
        let radius = report.contact_radius;
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let mut places: Vec<Place> = [[1.0, 0.0], [half, half]]
            .into_iter()
            .flat_map(|direction| places(body, centre, direction, &DISTANCES))
            .collect();
        places.retain(|p| p.distance >= radius);
        let peak = (0..report.force.len())
            .max_by(|&a, &b| report.force[a].total_cmp(&report.force[b]))
            .unwrap_or(0);
        let later = (peak..report.force.len())
            .find(|&i| report.force[i] < 0.5 * report.force[peak])
            .unwrap_or(peak);
        let steps = [peak * 2 / 3, peak, later];
        let points: Vec<[f64; 2]> = places.iter().map(|p| p.at).collect();
        let load = (&report.force[..], blow.time_step(), radius);
        let exact = PLATE.stress(terms, centre, load, &points, &steps);
        let stress = steps.iter().zip(exact).map(|(&step, exact)| {
            let row = places.iter().zip(exact).map(|(place, exact)| {
                let found = felt(body, &blow, place, step, config);
                [found, exact].map(|s| about(centre, place.at, s))
            });
            row.collect()
        });
        Ok(Self {
            stress: stress.collect(),
            places,
        })
    }

    /// Largest difference of `of` between both, over its largest value in the series.
    pub(crate) fn error(&self, of: impl Fn([f64; 2]) -> f64) -> f64 {
        let all = || self.stress.iter().flatten();
        let most = all().map(|[_, s]| of(*s).abs()).fold(0.0, f64::max);
        let off = all().map(|[a, b]| (of(*a) - of(*b)).abs());
        off.fold(0.0, f64::max) / most
    }

    fn checks(&self, name: &str, tolerance: f64, source: &'static str) -> Vec<Check> {
        let largest = |what: &str, of: fn([f64; 2]) -> f64| {
            let name = format!("{name}: {what}, largest difference over its peak");
            check(name, "%", [100.0 * self.error(of), 0.0], tolerance, source)
        };
        let mut checks = vec![
            largest("total stress", |s| s[0] + s[1]),
            largest("radial stress", |s| s[0]),
            largest("hoop stress", |s| s[1]),
        ];
        // At the peak of the force, along the side.
        for (place, pair) in self.places.iter().zip(&self.stress[1]).take(2) {
            let [found, exact] = pair.map(|s| s[1] / 1e6);
            let name = format!("{name}: hoop stress at {:.1} mm", 1e3 * place.distance);
            checks.push(check(name, "MPa", [found, exact], 0.03, source));
        }
        checks
    }
}
