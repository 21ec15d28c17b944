//! The columns of a wall: for every vertex of a remeshed face, the place on the other face.

use glam::{DMat3, DVec3};

use super::mesh::least_tet;
use super::remesh::{Kind, NONE, Sheet};
use super::{Back, Wall};
use frangible_geometry::Rows;

/// A column longer than this many thicknesses stands on a fold too sharp for a wall.
const LONGEST: f64 = 3.5;
/// A corner of a rim is met by a corner of the other up to this many times farther than the closest place.
const TO_CORNER: f64 = 1.5;
/// Places found from the planes of the faces are moved onto the other face if it is this close, in thicknesses.
const SNAP: f64 = 0.3;

/// Rounds in which ends of leaning columns are moved.
const ROUNDS: usize = 30;
/// Least volume of a tetrahedron of a prism, as a share of that in an upright one.
const UPRIGHT: f64 = 0.2;

/// Share of a full normal that keeps a direction still at a corner. It shortens columns by as little.
const STILL: f64 = 1e-8;

/// Ends of the columns on the other face, by the vertices of the sheet; for an offset, on the side behind the sheet (1) or before it (−1).
/// `None` where a fold is too sharp.
pub(super) fn ends(wall: &Wall, sheet: &Sheet, side: f64) -> Option<Vec<DVec3>> {
    let around = sheet.around();
    let sectors: Vec<Vec<Sector>> = (0..sheet.positions.len() as u32)
        .map(|v| sectors(sheet, &around, v))
        .collect();
    let rims = rims_of_vertices(wall, sheet);
    let mut ends: Vec<Option<DVec3>> = vec![None; sheet.positions.len()];
    let mut thickness = vec![None; sheet.positions.len()];
    for v in 0..sheet.positions.len() {
        if let (Kind::Free, [sector]) = (sheet.kinds[v], &sectors[v][..]) {
            let depth = match &wall.back {
                Back::Offset(depth) => Some(*depth),
                Back::Face { .. } => wall
                    .ray(sheet.positions[v], sector.normal)
                    .map(|depth| depth * sector.evenness),
            };
            thickness[v] = depth;
            ends[v] = depth
                .map(|depth| sheet.positions[v] - side * depth / sector.evenness * sector.normal);
        }
    }
    for v in 0..sheet.positions.len() {
        if ends[v].is_some() {
            continue;
        }
        let here = sheet.positions[v];
        let end = match (&wall.back, rims[v]) {
            (Back::Face { rims, .. }, rim) if rim != NONE => {
                let is_corner = sheet.kinds[v] == Kind::Corner;
                rims[rim as usize].closest(here, is_corner)
            }
            _ => here - side * offset(wall, sheet, &sectors[v], &thickness)?,
        };
        ends[v] = Some(match &wall.back {
            Back::Face { face, .. } if rims[v] == NONE => face.closest(end, SNAP * wall.thickness),
            _ => end,
        });
    }
    let ends: Vec<DVec3> = ends.into_iter().flatten().collect();
    let lengths = sheet.positions.iter().zip(&ends);
    let longest = lengths.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    (longest < LONGEST * wall.thickness).then_some(ends)
}

/// Near a fold, straight columns lean against each other or cross. Moves the ends of such columns to the middle of their neighbours' ends
/// until all prisms are upright.
pub(super) fn untangle(wall: &Wall, sheet: &Sheet, columns: &mut [[DVec3; 2]]) {
    let around = sheet.around();
    for _ in 0..ROUNDS {
        let mut leaning: Vec<u32> = Vec::new();
        for &triangle in &sheet.triangles {
            let upright = sheet.normal(triangle).length() * wall.thickness;
            if least_tet(triangle.map(|v| columns[v as usize])) < UPRIGHT * upright {
                leaning.extend(triangle.iter().filter(|&&v| sheet.kind(v) == Kind::Free));
            }
        }
        leaning.sort_unstable();
        leaning.dedup();
        if leaning.is_empty() {
            break;
        }
        for v in leaning {
            let corners = || {
                around
                    .of(v)
                    .iter()
                    .flat_map(|&t| sheet.triangles[t as usize])
            };
            let others = || corners().filter(|&w| w != v);
            let count = others().count() as f64;
            let middle = |side: usize| -> DVec3 {
                others().map(|w| columns[w as usize][side]).sum::<DVec3>() / count
            };
            match &wall.back {
                Back::Face { face, .. } => {
                    columns[v as usize][0] = face.closest(middle(0), wall.thickness);
                }
                Back::Offset(_) => columns[v as usize] = [middle(0), middle(1)],
            }
        }
    }
}

/// Moves columns outwards on bends, so that flat triangles lie as much outside of the curved wall as inside.
///
/// On a surface of mean curvature H, the neighbours of a vertex lie H e² / 2 below its tangent plane on average, and the middle of an
/// equilateral triangle of edge e lies H e² / 8 below the surface, averaged over its area.
pub(super) fn bulge(sheet: &Sheet, columns: &mut [[DVec3; 2]]) {
    let around = sheet.around();
    let before = columns.to_vec();
    for v in 0..sheet.positions.len() as u32 {
        let [sector] = &sectors(sheet, &around, v)[..] else {
            continue;
        };
        let corners = sector
            .triangles
            .iter()
            .flat_map(|&t| sheet.triangles[t as usize]);
        let others: Vec<u32> = corners.filter(|&w| w != v).collect();
        for side in [0, 1] {
            let at = |w: u32| before[w as usize][side];
            // The face's own normal: the other face of a wall that tapers leans.
            let normals = sector.triangles.iter().map(|&t| {
                let [a, b, c] = sheet.triangles[t as usize].map(at);
                (b - a).cross(c - a)
            });
            let normal = normals.sum::<DVec3>().normalize_or_zero();
            let below = others.iter().map(|&w| (at(v) - at(w)).dot(normal));
            let mean = below.sum::<f64>() / others.len().max(1) as f64;
            columns[v as usize][side] += 0.25 * mean * normal;
        }
    }
}

/// Triangles around a vertex between two sharp edges.
struct Sector {
    /// Mean unit normal, by angle.
    normal: DVec3,
    /// Mean cosine between the triangles' normals and the mean one: an end at this depth below the triangles is farther along the normal.
    evenness: f64,
    triangles: Vec<u32>,
}

fn sectors(sheet: &Sheet, around: &Rows, v: u32) -> Vec<Sector> {
    let mut left: Vec<u32> = around.of(v).to_vec();
    let mut found = Vec::new();
    while let Some(start) = left.first().copied() {
        let mut own = vec![start];
        left.remove(0);
        let mut next = 0;
        while let Some(&t) = own.get(next) {
            next += 1;
            let corners = sheet.triangles[t as usize];
            left.retain(|&u| {
                let shared = sheet.triangles[u as usize]
                    .into_iter()
                    .find(|w| *w != v && corners.contains(w));
                let joins = shared.is_some_and(|w| sheet.sharp_at(v, w).is_none());
                if joins {
                    own.push(u);
                }
                !joins
            });
        }
        let weighted: Vec<(f64, DVec3)> = own
            .iter()
            .map(|&t| {
                let corners = sheet.triangles[t as usize];
                let k = corners.iter().position(|&w| w == v).unwrap_or(0);
                let [a, b, c] = [0, 1, 2].map(|i| sheet.at(corners[(k + i) % 3]));
                let angle = (b - a).angle_between(c - a);
                (angle, sheet.normal(corners).normalize_or_zero())
            })
            .collect();
        let sum: DVec3 = weighted.iter().map(|(angle, n)| *angle * *n).sum();
        let normal = sum.normalize_or_zero();
        let angles: f64 = weighted.iter().map(|w| w.0).sum();
        let cosines: f64 = weighted
            .iter()
            .map(|(angle, n)| angle * n.dot(normal))
            .sum();
        found.push(Sector {
            normal,
            evenness: (cosines / angles.max(f64::MIN_POSITIVE)).clamp(0.5, 1.0),
            triangles: own,
        });
    }
    found
}

/// The way from the other face to a vertex: it has each sector's thickness along the sector's normal.
fn offset(
    wall: &Wall,
    sheet: &Sheet,
    sectors: &[Sector],
    thickness: &[Option<f64>],
) -> Option<DVec3> {
    let depth = |sector: &Sector| {
        let corners = sector
            .triangles
            .iter()
            .flat_map(|&t| sheet.triangles[t as usize]);
        let known: Vec<f64> = corners.filter_map(|w| thickness[w as usize]).collect();
        let depth = match &wall.back {
            Back::Offset(depth) => *depth,
            Back::Face { .. } if known.is_empty() => wall.thickness,
            Back::Face { .. } => known.iter().sum::<f64>() / known.len() as f64,
        };
        depth / sector.evenness
    };
    let way = match sectors {
        [a] => depth(a) * a.normal,
        [a, b] => {
            // α + cβ = depth a, cα + β = depth b.
            let c = a.normal.dot(b.normal);
            let [d, e] = [a, b].map(depth);
            ((d - c * e) * a.normal + (e - c * d) * b.normal) / (1.0 - c * c)
        }
        _ => {
            let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
            for sector in sectors {
                let n = sector.normal;
                matrix += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
                right += depth(sector) * n;
            }
            // A direction that no normal has is kept still.
            (matrix + DMat3::from_diagonal(DVec3::splat(STILL))).inverse() * right
        }
    };
    way.is_finite().then_some(way)
}

/// Rim of each vertex at an open edge of the sheet, or [`NONE`].
fn rims_of_vertices(wall: &Wall, sheet: &Sheet) -> Vec<u32> {
    let mut rims = vec![NONE; sheet.positions.len()];
    for &(ends, segment) in &sheet.sharp {
        let rim = wall.rim_of_line.get(segment as usize).copied();
        if let Some(rim) = rim.filter(|&rim| rim != NONE) {
            for v in ends {
                rims[v as usize] = rim;
            }
        }
    }
    rims
}

/// The edge of the other face at a rim.
pub(super) struct RimLine {
    pub(super) segments: Vec<[DVec3; 2]>,
    pub(super) corners: Vec<DVec3>,
}

impl RimLine {
    /// The closest place of the line; for a corner, a corner that is hardly farther.
    fn closest(&self, p: DVec3, is_corner: bool) -> DVec3 {
        let mut best = (f64::INFINITY, p);
        for &[a, b] in &self.segments {
            let along = b - a;
            let t = (p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
            let place = a + t.clamp(0.0, 1.0) * along;
            let distance = place.distance(p);
            if distance < best.0 {
                best = (distance, place);
            }
        }
        if is_corner {
            let mut limit = TO_CORNER * best.0;
            for &corner in &self.corners {
                if corner.distance(p) <= limit {
                    limit = corner.distance(p);
                    best.1 = corner;
                }
            }
        }
        best.1
    }
}
