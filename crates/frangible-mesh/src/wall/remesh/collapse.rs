//! Removes short edges.

use frangible_geometry::Rows;

use super::sheet::{Kind, NONE, Sheet, edges_of, smallest_angle};

/// Rounds of removal; each removes about an eighth of the short edges.
const ROUNDS: usize = 60;
/// Cosine of the largest angle between a removed piece of a line and the edge that replaces it: 12°, so that a circle keeps fifteen
/// vertices.
const STRAIGHT: f64 = 0.978;
/// Cosine of the largest turn of a triangle.
const TURN: f64 = 0.5;
/// Edges below this share of the shortest wanted are removed even if longer edges result.
const TINY: f64 = 0.2;
/// A removal leaves no angle below this, degrees, unless there was one before.
const ANGLE: f64 = 4.0;

/// Removes edges shorter than `shortest`, m, the shortest first, where no edge above `longest`, m, results.
pub(crate) fn collapse(sheet: &mut Sheet, shortest: f64, longest: f64) {
    for _ in 0..ROUNDS {
        let around = sheet.around();
        let mut short: Vec<(f64, [u32; 2], bool)> = sheet
            .edges()
            .iter()
            .map(|e| (sheet.length(e.ends), e.ends, e.sides[1].0 == NONE))
            .filter(|(length, ..)| *length < shortest)
            .collect();
        short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut touched = vec![false; sheet.triangles.len()];
        let mut gone = vec![false; sheet.triangles.len()];
        let mut moved: Vec<[u32; 2]> = Vec::new();
        for (length, [a, b], is_rim) in short {
            let longest = match length < TINY * shortest {
                true => f64::INFINITY,
                false => longest,
            };
            let found = [[b, a], [a, b]]
                .into_iter()
                .find(|&[from, to]| can_go(sheet, &around, &touched, [from, to], is_rim, longest));
            let Some([from, to]) = found else { continue };
            for &t in around.of(from).iter().chain(around.of(to)) {
                touched[t as usize] = true;
            }
            for &t in around.of(from) {
                let triangle = &mut sheet.triangles[t as usize];
                gone[t as usize] = triangle.contains(&to);
                for v in triangle.iter_mut().filter(|v| **v == from) {
                    *v = to;
                }
            }
            moved.push([from, to]);
        }
        if moved.is_empty() {
            break;
        }
        let mut gone = gone.into_iter();
        sheet.triangles.retain(|_| !gone.next().unwrap_or(false));
        rename(sheet, &mut moved);
        sheet.compact();
    }
}

/// Sharp edges follow their vertices.
fn rename(sheet: &mut Sheet, moved: &mut [[u32; 2]]) {
    moved.sort_unstable();
    let now = |v: u32| {
        let place = moved.binary_search_by_key(&v, |m| m[0]);
        place.map_or(v, |place| moved[place][1])
    };
    for (ends, _) in &mut sheet.sharp {
        let [a, b] = ends.map(now);
        *ends = [a.min(b), a.max(b)];
    }
    sheet.sharp.retain(|(ends, _)| ends[0] != ends[1]);
    sheet.sharp.sort_unstable();
    sheet.sharp.dedup_by_key(|s| s.0);
}

/// Whether vertex `from` may move to `to` and vanish.
fn can_go(
    sheet: &Sheet,
    around: &Rows,
    touched: &[bool],
    [from, to]: [u32; 2],
    is_rim: bool,
    longest: f64,
) -> bool {
    let (near, far) = (around.of(from), around.of(to));
    if near.iter().chain(far).any(|&t| touched[t as usize]) {
        return false;
    }
    if !kinds_allow(sheet, near, [from, to]) {
        return false;
    }
    // Exactly the apexes of the vanishing triangles are neighbours of both ends.
    let (mine, theirs) = (neighbours(sheet, near, from), neighbours(sheet, far, to));
    let common = mine.iter().filter(|v| theirs.binary_search(v).is_ok());
    let apexes = if is_rim { 1 } else { 2 };
    if common.count() != apexes || near.len() <= apexes {
        return false;
    }
    let place = sheet.at(to);
    near.iter().all(|&t| {
        let triangle = sheet.triangles[t as usize];
        if triangle.contains(&to) {
            return true;
        }
        let before = sheet.normal(triangle);
        let corners = triangle.map(|v| if v == from { place } else { sheet.at(v) });
        let [a, b, c] = corners;
        let after = (b - a).cross(c - a);
        let limit = ANGLE.min(smallest_angle(triangle.map(|v| sheet.at(v))));
        triangle
            .iter()
            .all(|&v| v == from || sheet.at(v).distance(place) <= longest)
            && after.dot(before) > TURN * after.length() * before.length()
            && smallest_angle(corners) >= limit
    })
}

/// Free vertices may go anywhere, those of a line only along it, and only where it is straight.
fn kinds_allow(sheet: &Sheet, near: &[u32], [from, to]: [u32; 2]) -> bool {
    match sheet.kind(from) {
        Kind::Free => true,
        Kind::Corner => false,
        Kind::Line(_) => {
            if sheet.sharp_at(from, to).is_none() {
                return false;
            }
            let other = neighbours(sheet, near, from)
                .into_iter()
                .find(|&v| v != to && sheet.sharp_at(from, v).is_some());
            let Some(other) = other else { return false };
            let chord = (sheet.at(to) - sheet.at(other)).normalize_or_zero();
            [[other, from], [from, to]].into_iter().all(|[a, b]| {
                let piece = (sheet.at(b) - sheet.at(a)).normalize_or_zero();
                piece.dot(chord) >= STRAIGHT
            })
        }
    }
}

/// Vertices that share a triangle with `v`, rising.
fn neighbours(sheet: &Sheet, around: &[u32], v: u32) -> Vec<u32> {
    let mut found: Vec<u32> = around
        .iter()
        .flat_map(|&t| sheet.triangles[t as usize])
        .filter(|&w| w != v)
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Whether every edge has one triangle, or two that run along it in opposite directions, and the triangles around every vertex form one
/// fan.
pub(crate) fn is_manifold(vertices: usize, triangles: &[[u32; 3]]) -> bool {
    let mut sides: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .collect();
    sides.sort_unstable();
    if sides.windows(2).any(|pair| pair[0] == pair[1]) {
        return false;
    }
    let around = Rows::inverse(vertices, triangles);
    let edges = edges_of(triangles);
    // A fan of n triangles has n inner edges at its hub if it is closed, n − 1 if it is open.
    let mut inner = vec![0; vertices];
    let mut open = vec![0; vertices];
    for edge in &edges {
        let count = if edge.sides[1].0 == NONE {
            &mut open
        } else {
            &mut inner
        };
        for v in edge.ends {
            count[v as usize] += 1;
        }
    }
    (0..vertices).all(|v| {
        let fan = around.of(v as u32).len();
        match open[v] {
            0 => fan == inner[v],
            2 => fan == inner[v] + 1,
            _ => fan == 0,
        }
    })
}
