//! Names of parts, as the file has them.

use super::Part;
use crate::InputMesh;

/// Share of a part's triangles that a name must cover.
const COVERS: f64 = 0.5;

/// Names each part after the smallest group that covers most of it. Parts that would have the same name are numbered.
pub(super) fn name(mesh: &InputMesh, parts: &mut [Part]) {
    let mut totals: Vec<(&str, usize)> = Vec::new();
    let mut groups: Vec<(&str, u32, u32)> = Vec::new();
    for group in mesh.groups.iter().filter(|g| !g.name.trim().is_empty()) {
        let (start, end) = (group.triangles.start, group.triangles.end);
        groups.push((group.name.trim(), start, end));
        totals.push((group.name.trim(), end.saturating_sub(start) as usize));
    }
    totals.sort_unstable();
    let totals: Vec<(&str, usize)> = totals
        .chunk_by(|a, b| a.0 == b.0)
        .map(|same| (same[0].0, same.iter().map(|t| t.1).sum()))
        .collect();
    let total = |name: &str| {
        let place = totals.binary_search_by(|t| t.0.cmp(name));
        place.map_or(0, |place| totals[place].1)
    };
    for part in parts.iter_mut() {
        let mut covered: Vec<(&str, usize)> = groups
            .iter()
            .map(|&(name, start, end)| {
                let before = |t: u32| part.triangles.partition_point(|&(own, _)| own < t);
                (name, before(end).saturating_sub(before(start)))
            })
            .filter(|&(_, count)| count > 0)
            .collect();
        covered.sort_unstable();
        let best = covered
            .chunk_by(|a, b| a.0 == b.0)
            .map(|same| (same[0].0, same.iter().map(|c| c.1).sum::<usize>()))
            .filter(|&(_, count)| count as f64 > COVERS * part.triangles.len() as f64)
            .min_by_key(|&(name, _)| (total(name), name));
        if let Some((name, _)) = best {
            part.name = name.into();
        }
    }
    number_equal(parts);
}

/// Gives parts without a name one, and parts of the same name a number each.
fn number_equal(parts: &mut [Part]) {
    if parts.len() < 2 {
        return;
    }
    for part in parts.iter_mut().filter(|part| part.name.is_empty()) {
        part.name = "part".into();
    }
    let mut taken: Vec<String> = parts.iter().map(|part| part.name.clone()).collect();
    taken.sort_unstable();
    let count =
        |name: &String| taken.partition_point(|t| t <= name) - taken.partition_point(|t| t < name);
    let repeated: Vec<bool> = parts.iter().map(|part| count(&part.name) > 1).collect();
    let mut given: Vec<(String, usize)> = Vec::new();
    for (part, repeated) in parts.iter_mut().zip(repeated) {
        if !repeated {
            continue;
        }
        let place = given.iter().position(|(name, _)| *name == part.name);
        let place = place.unwrap_or_else(|| {
            given.push((part.name.clone(), 0));
            given.len() - 1
        });
        loop {
            given[place].1 += 1;
            let name = format!("{} {}", given[place].0, given[place].1);
            if taken.binary_search(&name).is_err() {
                part.name = name;
                break;
            }
        }
    }
}
