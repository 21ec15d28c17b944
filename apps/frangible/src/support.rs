//! Supports as text: `--support SPEC`, and the same words in Python.

use frangible::glam::DVec3;
use frangible_scenes::{Region, Support, axes_of};

const EXAMPLES: &str = "for example below:z:0.01, above:x:0.3, box:0,0,0,0.1,0.1,0.1, sphere:0,0,0,0.02 or group:frame, \
     each with @xy to fix x and y only";

/// Parses a support such as `below:z:0.01`.
///
/// # Errors
/// A text that is not a support; the message gives examples of valid ones.
pub fn parse_support(text: &str) -> Result<Support, String> {
    let wrong = |problem: &str| format!("the support is `{text}`; {problem}, {EXAMPLES}");
    let (region, axes) = match text.rsplit_once('@') {
        None => (text, [true; 3]),
        Some((region, letters)) => {
            let axes = axes_of(letters);
            let axes = axes
                .ok_or_else(|| wrong("the axes after @ must be some of the letters x, y and z"))?;
            (region, axes)
        }
    };
    let (kind, rest) = region
        .split_once(':')
        .ok_or_else(|| wrong("it must have the form KIND:WHERE"))?;
    let numbers = |what: &str, text: &str, count: usize| {
        let numbers: Option<Vec<f64>> = text.split(',').map(|s| s.trim().parse().ok()).collect();
        numbers
            .filter(|numbers| numbers.len() == count)
            .ok_or_else(|| wrong(what))
    };
    let vector = DVec3::from_slice;
    let region = match kind {
        "below" | "above" => {
            let what = "this kind takes an axis and a coordinate in m";
            let (letter, at) = rest.split_once(':').ok_or_else(|| wrong(what))?;
            let axis = ["x", "y", "z"].iter().position(|&known| known == letter);
            let axis = axis.ok_or_else(|| wrong(what))?;
            let at = numbers(what, at, 1)?[0];
            if kind == "below" {
                Region::below(axis, at)
            } else {
                Region::above(axis, at)
            }
        }
        "box" => {
            let corners = numbers(
                "a box takes its lowest and its highest corner, in m",
                rest,
                6,
            )?;
            Region::Box {
                low: vector(&corners[..3]),
                high: vector(&corners[3..]),
            }
        }
        "sphere" => {
            let numbers = numbers("a sphere takes its centre and its radius, in m", rest, 4)?;
            Region::Sphere {
                centre: vector(&numbers[..3]),
                radius: numbers[3],
            }
        }
        "group" if !rest.is_empty() => Region::Group(rest.into()),
        "group" => return Err(wrong("a group takes a name")),
        _ => return Err(wrong("the kind of region is unknown")),
    };
    Ok(Support { region, axes })
}
