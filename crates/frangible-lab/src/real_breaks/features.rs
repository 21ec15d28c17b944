//! Features of broken bodies: common to all, and of panes, vessels, solids.

use frangible::glam::Vec3;

use super::broken::{Broken, Cut, meridional, radius};

/// A number that is read off a broken body, if that body has it.
pub(crate) type Reading = Box<dyn Fn(&Broken) -> Option<f64>>;

/// A feature, with its unit.
pub(crate) struct Feature {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    pub(crate) reading: Reading,
}

impl Feature {
    pub(crate) fn new(
        name: impl Into<String>,
        unit: &'static str,
        reading: impl Fn(&Broken) -> Option<f64> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            unit,
            reading: Box::new(reading),
        }
    }
}

/// Features of every body.
pub(crate) fn common() -> Vec<Feature> {
    vec![
        Feature::new("pieces", "", |b| Some(b.shares.len() as f64)),
        Feature::new("largest piece", "%", |b| Some(b.shares[0])),
        Feature::new("cracks", "", |b| Some(b.cracks as f64)),
        Feature::new("forks", "", |b| Some(b.forks as f64)),
        Feature::new("first crack after", "µs", |b| b.first_time),
        Feature::new("first crack away from the blow", "mm", |b| {
            b.first.map(|first| f64::from(first.distance(b.hit)))
        }),
    ]
}

/// Panes: star, rings, cone.
pub(crate) fn flat() -> Vec<Feature> {
    let mut features: Vec<Feature> = [10, 20, 50, 65]
        .map(|r| {
            let radius = 1e-3 * f64::from(r);
            Feature::new(format!("arms at {r} mm"), "", move |b| Some(b.arms(radius)))
        })
        .into();
    let zone = |from: f64, to: f64| {
        move |b: &Broken, cut: &Cut| (from..to).contains(&b.across(cut.place).0)
    };
    for [from, to] in [[0.0, 0.02], [0.02, 0.07]] {
        let zone = zone(from, to);
        features.push(Feature::new(
            format!(
                "cracks that run away, {:.0} to {:.0} mm",
                1e3 * from,
                1e3 * to
            ),
            "%",
            move |b| b.share(|cut| zone(b, cut), |cut| b.runs_away(cut)),
        ));
    }
    features.push(Feature::new("rings between 10 and 70 mm", "", |b| {
        Some(b.rings(0.01, 0.07))
    }));
    let near = zone(0.0, 0.02);
    features.push(Feature::new(
        "cracks that lean by 20° or more, within 20 mm",
        "%",
        move |b| {
            let leans = |cut: &Cut| cut.normal.dot(b.push).abs() > 20_f32.to_radians().sin();
            b.share(|cut| near(b, cut), leans)
        },
    ));
    features.push(Feature::new(
        "first crack below the face that was hit",
        "mm",
        |b| b.first.map(|first| b.across(first).1),
    ));
    features.push(Feature::new("pieces within 20 mm of the blow", "", |b| {
        Some(b.middles.iter().filter(|m| b.across(**m).0 < 0.02).count() as f64)
    }));
    features
}

/// Bodies about the z-axis: cracks along it, and where the first one starts.
fn of_revolution() -> Vec<Feature> {
    vec![
        Feature::new("first crack away from the axis", "mm", |b| {
            b.first.map(|first| f64::from(radius(first)))
        }),
        Feature::new("cracks along the axis or out from it", "%", |b| {
            b.share(|_| true, meridional)
        }),
        Feature::new("first crack's height, foot 0, rim 1", "%", |b| {
            b.first.map(|first| b.height(first))
        }),
        Feature::new(
            "cracks that run away from the blow, within 20 mm",
            "%",
            |b| {
                let near = |cut: &Cut| cut.place.distance(b.hit) < 0.02;
                b.share(near, |cut| b.runs_away(cut))
            },
        ),
    ]
}

/// Number of parts that a zone is in, and share of the largest.
fn parts(
    name: &'static str,
    zone: impl Fn(&Broken, Vec3) -> bool + Copy + 'static,
) -> [Feature; 2] {
    [
        Feature::new(format!("parts of the {name}"), "", move |b| {
            Some(b.parts(|place| zone(b, place)).len() as f64)
        }),
        Feature::new(format!("largest part of the {name}"), "%", move |b| {
            b.parts(|place| zone(b, place)).first().copied()
        }),
    ]
}

/// Share of cracks between two distances from the axis, or of all within a zone, that run around.
fn around(name: &'static str, zone: impl Fn(&Broken, &Cut) -> bool + Copy + 'static) -> Feature {
    Feature::new(format!("cracks around the axis {name}"), "%", move |b| {
        b.share(|cut| zone(b, cut), |cut| !meridional(cut))
    })
}

pub(crate) fn plate() -> Vec<Feature> {
    let between =
        |from: f32, to: f32| move |_: &Broken, cut: &Cut| (from..to).contains(&radius(cut.place));
    let mut features = of_revolution();
    features.push(around("in the well, up to 65 mm", between(0.02, 0.065)));
    features.push(around(
        "where the well ends, 65 to 90 mm",
        between(0.065, 0.09),
    ));
    features.push(around("in the rim, from 90 mm", between(0.09, 0.13)));
    features.push(Feature::new("pieces that reach the rim", "%", |b| {
        let reach = b
            .middles
            .iter()
            .zip(&b.shares)
            .filter(|(m, _)| radius(**m) > 0.09);
        Some(reach.map(|(_, share)| share).sum())
    }));
    features.extend(parts("rim", |_, place| radius(place) > 0.115));
    features.extend(parts("well", |_, place| radius(place) < 0.065));
    features
}

pub(crate) fn bowl() -> Vec<Feature> {
    let mut features = of_revolution();
    features.extend(parts("rim", |b, place| b.height(place) > 0.9));
    features.extend(parts("bottom", |b, place| b.height(place) < 0.1));
    features
}

pub(crate) fn bottle() -> Vec<Feature> {
    let above = |b: &Broken, place: Vec3| 1e3 * (place.z - b.foot());
    let mut features = of_revolution();
    features.push(Feature::new("largest force", "kN", |b| Some(b.force)));
    features.push(Feature::new("contact", "µs", |b| Some(b.contact)));
    for r in [8, 15] {
        features.push(Feature::new(format!("arms at {r} mm"), "", move |b| {
            Some(b.arms(1e-3 * f64::from(r)))
        }));
    }
    features.push(Feature::new(
        "first crack below the face that was hit",
        "mm",
        |b| b.first.map(|first| b.across(first).1),
    ));
    features.push(around("in the cylinder", move |b, cut| {
        (30.0..120.0).contains(&above(b, cut.place))
    }));
    features.push(around("at the heel, up to 12 mm", move |b, cut| {
        above(b, cut.place) < 12.0 && radius(cut.place) > 0.022
    }));
    features.push(around("in the shoulder and neck", move |b, cut| {
        above(b, cut.place) > 130.0
    }));
    features.extend(parts("base", move |b, place| above(b, place) < 6.0));
    features.extend(parts("neck", move |b, place| above(b, place) > 170.0));
    features
}

pub(crate) fn tumbler() -> Vec<Feature> {
    let mut features = of_revolution();
    features.extend(parts("rim", |b, place| b.height(place) > 0.97));
    features.extend(parts("base", |b, place| b.height(place) < 0.06));
    features
}

pub(crate) fn wine_glass() -> Vec<Feature> {
    let mut features = of_revolution();
    let stem = |b: &Broken, place: Vec3| (0.1..0.43).contains(&b.height(place));
    features.push(around("in the stem", move |b, cut| stem(b, cut.place)));
    features.push(Feature::new("cracks in the stem, of all", "%", move |b| {
        b.share(|_| true, |cut| stem(b, cut.place))
    }));
    features.extend(parts("stem", stem));
    features.extend(parts("foot", |b, place| b.height(place) < 0.04));
    features.extend(parts("bowl", |b, place| b.height(place) > 0.5));
    features.extend(parts("rim", |b, place| b.height(place) > 0.98));
    features
}

pub(crate) fn bulb() -> Vec<Feature> {
    let mut features = of_revolution();
    features.extend(parts("neck", |b, place| b.height(place) > 0.8));
    features
}

/// Solids: halves, chips, crumbs.
pub(crate) fn solid() -> Vec<Feature> {
    vec![
        Feature::new("second largest piece", "%", |b| {
            Some(b.shares.get(1).copied().unwrap_or(0.0))
        }),
        Feature::new("in pieces of less than 1 %", "%", |b| {
            Some(b.shares.iter().filter(|share| **share < 0.01).sum())
        }),
        Feature::new("these pieces' mean distance from the blow", "mm", |b| {
            let small = b
                .shares
                .iter()
                .zip(&b.middles)
                .filter(|(share, _)| **share < 0.01);
            let (mut sum, mut all) = (0.0, 0.0);
            for (share, middle) in small {
                sum += share * f64::from(middle.distance(b.hit));
                all += share;
            }
            (all > 0.0).then(|| sum / all)
        }),
    ]
}

pub(crate) fn chocolate() -> Vec<Feature> {
    // Lines of the grooves, 20 mm apart, 3 mm wide; as far aside as an edge they are still hit.
    let in_groove = |place: Vec3, aside: f32| {
        let near = |x: f32, lines: f32| {
            let line = (x / 0.02).round();
            line.abs() <= lines && (x - 0.02 * line).abs() < aside
        };
        near(place.x, 3.0) || near(place.y, 1.0)
    };
    let mut features = solid();
    features.push(Feature::new(
        "cracks within 2.5 mm of a groove's middle",
        "%",
        move |b| b.share(|_| true, |cut| in_groove(cut.place, 0.0025)),
    ));
    features
}

pub(crate) fn statue() -> Vec<Feature> {
    let mut features = solid();
    features.push(Feature::new(
        "first crack's height, foot 0, rim 1",
        "%",
        |b| b.first.map(|first| b.height(first)),
    ));
    let between =
        |from: f64, to: f64| move |b: &Broken, place: Vec3| (from..to).contains(&b.height(place));
    features.extend(parts("plinth", between(-0.1, 0.07)));
    features.extend(parts("legs", between(0.1, 0.47)));
    features.extend(parts("trunk", between(0.56, 0.74)));
    features.extend(parts("neck", between(0.75, 0.79)));
    features.extend(parts("head and arms", between(0.8, 1.1)));
    features
}
