//! Orientation of shells and cavities.

use glam::DVec3;

use super::column::Columns;
use super::edges::Edges;
use super::patches::Patches;

/// An open part is turned when its volume, closed over the middle of its rim, is below minus this share of area^1.5
/// (a ball has 0.094, a box of 10 : 10 : 0.1 has 0.0034); flatter sheets stay as they are wound.
const CLEARLY_INSIDE_OUT: f64 = 1e-3;

/// Points per shell that must all be inside another one for it to be nested.
const SAMPLES: usize = 8;

/// Numbers of nested shells, by kind.
#[derive(Default)]
pub(super) struct Nesting {
    pub(super) cavities: usize,
    pub(super) alike: usize,
}

/// Volume with sign, and area, of every part.
struct Measures {
    volume: Vec<f64>,
    area: Vec<f64>,
}

/// Tells for every part whether it has to be turned, as a whole.
///
/// Closed shells inside no other face outwards. A shell inside another keeps its winding relative to the outermost:
/// wound against it, it bounds a cavity; wound like it, it is solid within solid, as eyes in a head are. Inside a
/// cavity it faces outwards.
pub(super) fn to_turn(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    patches: &Patches,
    edges: &Edges,
) -> (Vec<bool>, Nesting) {
    let measures = measure(positions, triangles, patches, edges);
    let count = patches.is_closed.len();
    let closed = patches.is_closed.iter().filter(|&&closed| closed).count();
    let around = if closed > 1 {
        containers(positions, triangles, patches, &measures)
    } else {
        vec![Vec::new(); count]
    };
    let mut by_size: Vec<u32> = (0..count as u32).collect();
    by_size.sort_by(|&a, &b| {
        measures.volume[b as usize]
            .abs()
            .total_cmp(&measures.volume[a as usize].abs())
    });
    let mut nesting = Nesting::default();
    let mut is_outward = vec![true; count];
    let mut turn = vec![false; count];
    for patch in by_size.into_iter().map(|patch| patch as usize) {
        let (volume, area) = (measures.volume[patch], measures.area[patch]);
        if patches.is_one_sided[patch] {
            continue;
        }
        if !patches.is_closed[patch] {
            turn[patch] = volume < -CLEARLY_INSIDE_OUT * area.powf(1.5);
            continue;
        }
        let outermost = around[patch].iter().copied().max_by(|&a, &b| {
            let size = |shell: u32| measures.volume[shell as usize].abs();
            size(a).total_cmp(&size(b))
        });
        let depth: i32 = around[patch]
            .iter()
            .map(|&shell| if is_outward[shell as usize] { 1 } else { -1 })
            .sum();
        if let Some(outermost) = outermost.filter(|_| depth > 0) {
            let is_alike = (volume > 0.0) == (measures.volume[outermost as usize] > 0.0);
            is_outward[patch] = is_alike;
            nesting.alike += usize::from(is_alike);
            nesting.cavities += usize::from(!is_alike);
        }
        turn[patch] = (volume > 0.0) != is_outward[patch] && volume != 0.0;
    }
    (turn, nesting)
}

fn measure(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    patches: &Patches,
    edges: &Edges,
) -> Measures {
    let count = patches.is_closed.len();
    // Middle of the rim, or some vertex of a closed part.
    let mut rim = vec![(DVec3::ZERO, 0.0); count];
    for (near, group) in edges.groups() {
        if let [side] = group {
            let (sum, number) = &mut rim[patches.of[side.triangle()] as usize];
            *sum += positions[near as usize] + positions[side.far() as usize];
            *number += 2.0;
        }
    }
    let mut volume = vec![0.0; count];
    let mut area = vec![0.0; count];
    for (t, triangle) in triangles.iter().enumerate() {
        let patch = patches.of[t] as usize;
        let (sum, number) = &mut rim[patch];
        if *number == 0.0 {
            (*sum, *number) = (positions[triangle[0] as usize], 1.0);
        }
        let centre = *sum / *number;
        let [a, b, c] = triangle.map(|v| positions[v as usize] - centre);
        volume[patch] += a.dot(b.cross(c)) / 6.0;
        area[patch] += 0.5 * (b - a).cross(c - a).length();
    }
    Measures { volume, area }
}

/// For every closed part the closed parts around it.
fn containers(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    patches: &Patches,
    measures: &Measures,
) -> Vec<Vec<u32>> {
    let count = patches.is_closed.len();
    let mut members: Vec<u32> = (0..triangles.len() as u32)
        .filter(|&t| patches.is_closed[patches.of[t as usize] as usize])
        .collect();
    let columns = Columns::new(positions, triangles, &patches.of, members.clone());
    members.sort_unstable_by_key(|&t| (patches.of[t as usize], t));
    let mut around = vec![Vec::new(); count];
    for shell in members.chunk_by(|&a, &b| patches.of[a as usize] == patches.of[b as usize]) {
        let own = patches.of[shell[0] as usize];
        let size = measures.volume[own as usize].abs();
        let mut found: Option<Vec<u32>> = None;
        for sample in shell.iter().step_by(shell.len().div_ceil(SAMPLES)) {
            let [a, b, c] = triangles[*sample as usize].map(|v| positions[v as usize]);
            let here = columns.around((a + b + c) / 3.0);
            let here = here.iter().map(|&(other, _)| other);
            let here =
                here.filter(|&other| other != own && measures.volume[other as usize].abs() > size);
            match &mut found {
                None => found = Some(here.collect()),
                Some(found) => {
                    let here: Vec<u32> = here.collect();
                    found.retain(|other| here.binary_search(other).is_ok());
                }
            }
            if found.as_ref().is_some_and(Vec::is_empty) {
                break;
            }
        }
        around[own as usize] = found.unwrap_or_default();
    }
    around
}
