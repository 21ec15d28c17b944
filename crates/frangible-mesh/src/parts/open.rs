//! What of a surface bounds nothing closed: sheets, and shells with holes.

use frangible_geometry::DisjointSets;
use glam::DVec3;

use super::regions::Regions;
use crate::repair::Welded;

/// A cluster of open faces encloses something if its volume, closed over the middle of its rim, is above this share of area^1.5 (a ball has
/// 0.094, a box of 10 : 10 : 0.1 has 0.0034).
const ENCLOSES: f64 = 1e-3;

/// Sheets whose boxes are this near are one cluster, as a share of the mesh's diagonal.
const NEAR: f64 = 1e-3;

/// More sheets than this are one cluster: a soup.
const MOST_SHEETS: usize = 1000;

/// Open faces that belong together.
pub(super) struct Cluster {
    /// Their numbers.
    pub(super) faces: Vec<u32>,
    /// Lowest and highest corner.
    pub(super) bounds: [DVec3; 2],
    /// Volume closed over the middle of the cluster, in the cube of the mesh's unit; 0 of a sheet.
    pub(super) volume: f64,
}

impl Cluster {
    /// True of sheets that have no inside.
    pub(super) fn is_sheet(&self) -> bool {
        self.volume == 0.0
    }
}

/// Clusters of the faces that bound no closed region: those on common vertices, and those whose boxes touch.
pub(super) fn clusters(mesh: &Welded, regions: &Regions, diagonal: f64) -> Vec<Cluster> {
    let open = (0..).zip(&regions.faces);
    let open: Vec<u32> = open
        .filter(|(_, face)| face.regions().next().is_none())
        .map(|(f, _)| f)
        .collect();
    if open.is_empty() {
        return Vec::new();
    }
    let mut sets = DisjointSets::new(mesh.positions.len());
    let vertices = |f: u32| regions.faces[f as usize].vertices;
    for &f in &open {
        let [a, b, c] = vertices(f);
        sets.join(a, b);
        sets.join(b, c);
    }
    let mut sheets = grouped(&open, |f| sets.find(vertices(f)[0]));
    if sheets.len() > MOST_SHEETS {
        sheets = vec![open];
    } else {
        sheets = by_boxes(mesh, regions, sheets, NEAR * diagonal);
    }
    sheets
        .into_iter()
        .map(|faces| cluster(mesh, regions, faces))
        .collect()
}

/// Items by their keys, in the order of the first of each.
fn grouped(items: &[u32], mut key: impl FnMut(u32) -> u32) -> Vec<Vec<u32>> {
    let mut keyed: Vec<(u32, u32)> = items.iter().map(|&item| (key(item), item)).collect();
    keyed.sort_unstable();
    let same = keyed.chunk_by(|a, b| a.0 == b.0);
    let mut groups: Vec<Vec<u32>> = same
        .map(|same| same.iter().map(|&(_, item)| item).collect())
        .collect();
    groups.sort_unstable_by_key(|group: &Vec<u32>| group[0]);
    groups
}

/// Merges sheets until no two boxes touch.
fn by_boxes(
    mesh: &Welded,
    regions: &Regions,
    mut sheets: Vec<Vec<u32>>,
    near: f64,
) -> Vec<Vec<u32>> {
    loop {
        let boxes: Vec<[DVec3; 2]> = sheets.iter().map(|s| bounds(mesh, regions, s)).collect();
        let mut sets = DisjointSets::new(sheets.len());
        for (i, one) in boxes.iter().enumerate() {
            for (j, two) in boxes.iter().enumerate().skip(i + 1) {
                if apart(one, two) <= near {
                    sets.join(i as u32, j as u32);
                }
            }
        }
        let numbers: Vec<u32> = (0..sheets.len() as u32).collect();
        let groups = grouped(&numbers, |sheet| sets.find(sheet));
        if groups.len() == sheets.len() {
            return sheets;
        }
        sheets = groups
            .into_iter()
            .map(|group| {
                let mut faces: Vec<u32> = group
                    .into_iter()
                    .flat_map(|sheet| std::mem::take(&mut sheets[sheet as usize]))
                    .collect();
                faces.sort_unstable();
                faces
            })
            .collect();
    }
}

/// Largest distance of two boxes along an axis; 0 or below where they touch.
pub(super) fn apart(one: &[DVec3; 2], two: &[DVec3; 2]) -> f64 {
    (one[0] - two[1]).max(two[0] - one[1]).max_element()
}

/// Box around faces.
pub(super) fn bounds(mesh: &Welded, regions: &Regions, faces: &[u32]) -> [DVec3; 2] {
    let vertices = faces
        .iter()
        .flat_map(|&f| regions.faces[f as usize].vertices);
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    vertices.fold(nothing, |[low, high], v| {
        let p = mesh.positions[v as usize];
        [low.min(p), high.max(p)]
    })
}

fn cluster(mesh: &Welded, regions: &Regions, faces: Vec<u32>) -> Cluster {
    let bounds = bounds(mesh, regions, &faces);
    let corners = |f: &u32| {
        regions.faces[*f as usize]
            .vertices
            .map(|v| mesh.positions[v as usize])
    };
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for [a, b, c] in faces.iter().map(corners) {
        let area = 0.5 * (b - a).cross(c - a).length();
        sum += area * (a + b + c) / 3.0;
        total += area;
    }
    let middle = if total > 0.0 { sum / total } else { bounds[0] };
    let volume: f64 = faces
        .iter()
        .map(corners)
        .map(|corners| {
            let [a, b, c] = corners.map(|p| p - middle);
            a.dot(b.cross(c)) / 6.0
        })
        .sum();
    let encloses = volume.abs() > ENCLOSES * total.powf(1.5);
    Cluster {
        faces,
        bounds,
        volume: if encloses { volume.abs() } else { 0.0 },
    }
}
