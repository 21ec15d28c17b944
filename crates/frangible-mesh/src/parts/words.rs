//! What was found of a surface's parts, in words.

use super::{ChosenParts, PartChoice, Parts};

/// Bodies as near as this touch, m.
const TOUCHING: f64 = 1e-6;

/// Names that a list shows.
const NAMES: usize = 4;

/// One line on parts and choice; none for a single part of closed shells.
pub(super) fn note(parts: &Parts, choice: &PartChoice, chosen: &ChosenParts) -> Option<String> {
    let count = parts.list.len();
    if count < 2 && parts.loose_sheets == 0 {
        return None;
    }
    let mut said = Vec::new();
    let bodies = &chosen.bodies;
    let closed = if parts.list.iter().all(|part| part.is_exact) {
        "closed"
    } else {
        "separate"
    };
    let total: f64 = parts.list.iter().map(|part| part.volume).sum();
    let names = || {
        let named = bodies.iter().map(|body| {
            let percent = 100.0 * body.volume / total;
            format!("`{}` ({percent:.0} %)", body.name)
        });
        listed(named.collect(), NAMES)
    };
    let shares_faces = parts.shared_faces > 0;
    said.push(match (choice, bodies.len()) {
        (PartChoice::Weld { .. }, _) => format!("{count} {closed} parts welded into one body"),
        (PartChoice::Only(name), _) => format!("`{name}` of {count} {closed} parts is the body"),
        (_, 1) if count == 1 => "one part is the body".into(),
        (_, 1) if shares_faces && bodies[0].parts.len() == count => {
            format!("{count} {closed} parts that share faces are one body")
        }
        (_, 1) => {
            let name = &bodies[0].name;
            format!("the largest of {count} {closed} parts, `{name}`, is the body")
        }
        (_, many) if many == count => {
            format!(
                "{count} {closed} parts, each a body of its own: {}",
                names()
            )
        }
        (_, many) => format!("{count} {closed} parts, {many} bodies: {}", names()),
    });
    if let Some(gap) = chosen.weld.filter(|gap| *gap > 0.0) {
        said.push(format!("gaps of up to {} are filled", length(gap)));
    }
    if let Some(gap) = chosen.gap {
        said.push(match gap.width {
            width if width < TOUCHING => "the nearest touch".into(),
            width => format!("the nearest are {} apart", length(width)),
        });
    }
    if chosen.dropped > 0 {
        let percent = 100.0 * chosen.dropped_share;
        let what = match choice {
            PartChoice::Auto | PartChoice::Separate => "smaller than 1 % of the volume ",
            _ => "",
        };
        said.push(format!(
            "{} {what}left out ({} together)",
            counted(chosen.dropped, "part", "parts"),
            share(percent)
        ));
    }
    if shares_faces && chosen.bodies.iter().any(|body| body.parts.len() > 1) {
        let faces = counted(parts.shared_faces, "face", "faces");
        said.push(format!("{faces} inside it left out"));
    }
    let hollows: usize = parts.list.iter().map(|part| part.hollows).sum();
    if hollows > 0 {
        said.push(counted(hollows, "hollow", "hollows"));
    }
    if parts.loose_sheets > 0 {
        let sheets = counted(parts.loose_sheets, "open sheet", "open sheets");
        said.push(format!("{sheets} that enclose nothing left out"));
    }
    Some(said.join("; "))
}

fn share(percent: f64) -> String {
    match percent {
        small if small < 0.01 => "less than 0.01 % of it".into(),
        percent => format!("{percent:.2} % of it"),
    }
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// The first names, and how many there are besides.
pub(super) fn some_names<'a>(names: impl Iterator<Item = &'a str>, most: usize) -> String {
    listed(names.map(|name| format!("`{name}`")).collect(), most)
}

fn listed(items: Vec<String>, most: usize) -> String {
    let first = items[..most.min(items.len())].join(", ");
    match items.len().saturating_sub(most) {
        0 => first,
        rest => format!("{first} and {rest} more"),
    }
}

/// A length in a unit that suits it.
pub(super) fn length(metres: f64) -> String {
    match metres {
        m if m >= 1.0 => format!("{m:.2} m"),
        m if m >= 1e-5 => format!("{:.3} mm", 1e3 * m),
        m => format!("{:.3} µm", 1e6 * m),
    }
}

/// A little more, to four digits behind the point.
pub(super) fn up(metres: f64) -> f64 {
    (1e4 * metres).ceil() / 1e4
}
