//! Halves long edges.

use super::lines::Lines;
use super::sheet::{Edge, Kind, NONE, Sharp, Sheet};
use super::surface::Reference;

/// Rounds of halving. Each round halves most long edges, so these suffice for edges a million times too long.
const ROUNDS: usize = 60;

/// Halves edges longer than `longest`, m, the longest first, until none is left.
pub(crate) fn split(sheet: &mut Sheet, lines: &Lines, reference: &Reference, longest: f64) {
    for _ in 0..ROUNDS {
        let edges = sheet.edges();
        let mut long: Vec<(f64, usize)> = edges
            .iter()
            .enumerate()
            .map(|(i, edge)| (sheet.length(edge.ends), i))
            .filter(|(length, _)| *length > longest)
            .collect();
        if long.is_empty() {
            break;
        }
        long.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut touched = vec![false; sheet.triangles.len()];
        let mut halves: Vec<(usize, [Sharp; 2])> = Vec::new();
        for (_, i) in long {
            let edge = edges[i];
            let sides = edge.sides.into_iter().filter(|s| s.0 != NONE);
            if sides.clone().any(|s| touched[s.0 as usize]) {
                continue;
            }
            sides.for_each(|s| touched[s.0 as usize] = true);
            halves.extend(halve(sheet, edge, lines, reference));
        }
        for (place, [first, second]) in halves {
            sheet.sharp[place] = first;
            sheet.sharp.push(second);
        }
        sheet.sharp.sort_unstable();
    }
}

/// Halves an edge and its triangles; returns the halves of a sharp edge with its place in the list.
fn halve(
    sheet: &mut Sheet,
    edge: Edge,
    lines: &Lines,
    reference: &Reference,
) -> Option<(usize, [Sharp; 2])> {
    let [a, b] = edge.ends;
    let middle = 0.5 * (sheet.at(a) + sheet.at(b));
    let v = sheet.positions.len() as u32;
    let place = sheet.sharp.binary_search_by_key(&edge.ends, |s| s.0).ok();
    let segment = place.map(|place| sheet.sharp[place].1);
    match segment {
        Some(segment) => {
            sheet.positions.push(middle);
            sheet.kinds.push(Kind::Line(segment));
            sheet.onto_line(v, lines);
        }
        None => {
            sheet
                .positions
                .push(reference.closest(middle, sheet.length(edge.ends)));
            sheet.kinds.push(Kind::Free);
        }
    }
    for (t, k) in edge.sides.into_iter().filter(|s| s.0 != NONE) {
        let triangle = sheet.triangles[t as usize];
        let [from, to, apex] = [0, 1, 2].map(|i| triangle[(k as usize + i) % 3]);
        sheet.triangles[t as usize] = [from, v, apex];
        sheet.triangles.push([v, to, apex]);
    }
    Some((place?, [([a, v], segment?), ([b, v], segment?)]))
}
