//! The sharp lines of a sheet as they were before remeshing: vertices that slide along them stay on them.

use glam::DVec3;

use super::sheet::{Kind, NONE, Sharp, Sheet, edges_of};

/// Segments without progress after which the search for the closest place of a line ends.
const PATIENCE: usize = 8;

/// Segments of lines, each with those before and after it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    ends: Vec<[DVec3; 2]>,
    /// Next segment beyond each end, or [`NONE`] beyond a corner.
    next: Vec<[u32; 2]>,
}

impl Lines {
    /// The closest place of the line of a segment, found by walking along the line, and the segment there.
    pub(crate) fn closest(&self, p: DVec3, start: u32) -> (DVec3, u32) {
        let place = |segment: u32| {
            let [a, b] = self.ends[segment as usize];
            let along = b - a;
            let t = (p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
            a + t.clamp(0.0, 1.0) * along
        };
        let mut best = (place(start), start);
        let mut nearest = best.0.distance_squared(p);
        for side in [0, 1] {
            let (mut here, mut from, mut idle) = (start, side, 0);
            while idle < PATIENCE {
                let next = self.next[here as usize][from];
                if next == NONE || next == start {
                    break;
                }
                // Walk on through the far end: the one that does not lead back.
                from = usize::from(self.next[next as usize][0] == here);
                here = next;
                let found = place(here);
                idle += 1;
                if found.distance_squared(p) < nearest {
                    nearest = found.distance_squared(p);
                    best = (found, here);
                    idle = 0;
                }
            }
        }
        best
    }
}

/// Finds the sharp lines of triangles: edges at which normals differ by more than `crease`, degrees, and edges of one triangle. A vertex
/// where lines meet, end, or turn by more than that is a corner.
pub(crate) fn trace(positions: &[DVec3], triangles: &[[u32; 3]], crease: f64) -> (Sheet, Lines) {
    let cosine = crease.to_radians().cos();
    let mut sheet = Sheet {
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
        kinds: vec![Kind::Free; positions.len()],
        sharp: Vec::new(),
    };
    let normals: Vec<DVec3> = triangles
        .iter()
        .map(|&t| sheet.normal(t).normalize_or_zero())
        .collect();
    let mut lines = Lines::default();
    for edge in edges_of(triangles) {
        let [(t, _), (u, _)] = edge.sides;
        if u == NONE || normals[t as usize].dot(normals[u as usize]) < cosine {
            let sharp: Sharp = (edge.ends, sheet.sharp.len() as u32);
            sheet.sharp.push(sharp);
            lines.ends.push(edge.ends.map(|v| positions[v as usize]));
        }
    }
    lines.next = vec![[NONE; 2]; lines.ends.len()];
    // Sharp edges by vertex: (vertex, segment, which end of the segment).
    let mut met: Vec<(u32, u32, usize)> = sheet
        .sharp
        .iter()
        .flat_map(|&(ends, segment)| [0, 1].map(|end| (ends[end], segment, end)))
        .collect();
    met.sort_unstable();
    for same in met.chunk_by(|a, b| a.0 == b.0) {
        let v = same[0].0;
        let direction = |&(_, segment, end): &(u32, u32, usize)| {
            let ends = lines.ends[segment as usize];
            (ends[1 - end] - ends[end]).normalize_or_zero()
        };
        sheet.kinds[v as usize] = match same {
            [a, b] if -direction(a).dot(direction(b)) > cosine => {
                lines.next[a.1 as usize][a.2] = b.1;
                lines.next[b.1 as usize][b.2] = a.1;
                Kind::Line(a.1)
            }
            _ => Kind::Corner,
        };
    }
    (sheet, lines)
}
