//! Supports, from and to TOML.

use frangible::glam::DVec3;
use frangible_bake::{Region, Support};

use super::body::clash;
use super::schema::SupportTable;
use super::values::{number, numbers, quoted};
use crate::check::Fault;
use crate::source::axes_of;

const KEY: &str = "supports";

const ONE_REGION: &str = "a support must have exactly one of `below`, `above`, `side` with `at`, `plane`, `box`, `sphere` and `group`, \
     for example { below = 0.01 }, { side = \"-x\", at = 0.02 } or { group = \"frame\" }";

pub(super) fn support(table: SupportTable) -> Result<Support, Fault> {
    let vector = DVec3::from_array;
    let mut regions = Vec::new();
    regions.extend(table.below.map(|at| Region::below(2, at)));
    regions.extend(table.above.map(|at| Region::above(2, at)));
    match (&table.side, table.at) {
        (None, None) => {}
        (Some(side), Some(at)) => regions.push(side_of(side, at)?),
        _ => {
            let problem =
                "`side` and `at` must be given together, for example { side = \"-x\", at = 0.02 }";
            return Err(clash(KEY, problem));
        }
    }
    regions.extend(table.plane.map(|plane| Region::HalfSpace {
        point: vector(plane.point),
        normal: vector(plane.normal),
    }));
    regions.extend(table.cuboid.map(|[low, high]| Region::Box {
        low: vector(low),
        high: vector(high),
    }));
    regions.extend(table.sphere.map(|ball| Region::Sphere {
        centre: vector(ball.centre),
        radius: ball.radius,
    }));
    regions.extend(table.group.map(Region::Group));
    let axes = match table.axes.as_deref() {
        None => [true; 3],
        Some(letters) => axes_of(letters).ok_or_else(|| {
            clash(KEY, "the axes of a support must be some of the letters x, y and z, for example axes = \"xy\"")
        })?,
    };
    let mut regions = regions.into_iter();
    match (regions.next(), regions.next()) {
        (Some(region), None) => Ok(Support { region, axes }),
        _ => Err(clash(KEY, ONE_REGION)),
    }
}

/// `-x` is everything whose x is `at` or less, `+x` or `x` everything whose x is `at` or more.
fn side_of(side: &str, at: f64) -> Result<Region, Fault> {
    let (lower, letter) = match side.strip_prefix('-') {
        Some(letter) => (true, letter),
        None => (false, side.strip_prefix('+').unwrap_or(side)),
    };
    let axis = match letter {
        "x" => 0,
        "y" => 1,
        "z" => 2,
        _ => {
            let problem = "`side` must be one of \"-x\", \"+x\", \"-y\", \"+y\", \"-z\", \"+z\"";
            return Err(clash(KEY, problem));
        }
    };
    Ok(if lower {
        Region::below(axis, at)
    } else {
        Region::above(axis, at)
    })
}

pub(crate) fn support_text(support: &Support) -> String {
    let region = match &support.region {
        Region::HalfSpace { point, normal } => half_space_text(*point, *normal),
        Region::Box { low, high } => {
            let (low, high) = (numbers(&low.to_array()), numbers(&high.to_array()));
            format!("box = [{low}, {high}]")
        }
        Region::Sphere { centre, radius } => format!(
            "sphere = {{ centre = {}, radius = {} }}",
            numbers(&centre.to_array()),
            number(*radius)
        ),
        Region::Group(name) => format!("group = {}", quoted(name)),
        // No other kind can be asked for here.
        _ => String::new(),
    };
    let letters: String = ["x", "y", "z"]
        .into_iter()
        .zip(support.axes)
        .filter_map(|(letter, held)| held.then_some(letter))
        .collect();
    if support.axes == [true; 3] {
        format!("{{ {region} }}")
    } else {
        format!("{{ {region}, axes = {} }}", quoted(&letters))
    }
}

fn half_space_text(point: DVec3, normal: DVec3) -> String {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let at = point[axis];
        let region = Region::HalfSpace { point, normal };
        let lower = Region::below(axis, at) == region;
        if lower || Region::above(axis, at) == region {
            return match (letter, lower) {
                ("z", true) => format!("below = {}", number(at)),
                ("z", false) => format!("above = {}", number(at)),
                (_, true) => format!("side = \"-{letter}\", at = {}", number(at)),
                (_, false) => format!("side = \"+{letter}\", at = {}", number(at)),
            };
        }
    }
    let (point, normal) = (numbers(&point.to_array()), numbers(&normal.to_array()));
    format!("plane = {{ point = {point}, normal = {normal} }}")
}
