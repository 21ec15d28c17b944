//! The films of a laminated wall across the cracks between its pieces.
//!
//! Two pieces that share cracks are bonded there at one place, or at two places where the crack between them is long: then they turn about it as about a
//! hinge, and nothing else has to be known of the film's shape.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3, Vec3};

use super::Fragment;
use crate::blow::outer;
use crate::body::Body;
use crate::material::Laminate;
use crate::mesh::symmetric_eigen;

/// Length of a support that is held as one, m.
const STRETCH_OF_RIM: f64 = 0.05;

/// A crack this many times as long as the wall is thick has two bonds.
const LONG: f64 = 2.0;

/// Film across a part of the crack between two pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmBond {
    /// The two pieces, by their numbers among the fragments; the second is [`FilmBond::FRAME`] where it holds a piece in the body's supports.
    pub pieces: [u32; 2],
    /// Middle of the part, m, body frame of the parent.
    pub place: Vec3,
    /// Unit vector along the crack.
    pub along: Vec3,
    /// Unit vector across the crack, from the first piece to the second.
    pub across: Vec3,
    /// Length of the part, m.
    pub length: f64,
    /// Section of all films there, m².
    pub section: f64,
    /// Tension that the film carries, Pa, and opening at which it tears, m.
    pub strength: f64,
    /// See [`FilmBond::strength`].
    pub stretch: f64,
    /// Half of the thickness of the wall, m: the arm at which the film pulls when the two pieces press upon each other at a face.
    pub arm: f64,
}

impl FilmBond {
    /// Number that stands for the body's supports in the place of a second piece.
    pub const FRAME: u32 = u32::MAX;
}

/// Sums over the cracks between two pieces.
#[derive(Clone, Copy, Default)]
struct Seam {
    other: u32,
    area: f64,
    first: DVec3,
    second: DMat3,
    normal: DVec3,
}

/// The films between the pieces of a laminated body, and those that hold them in its supports. `piece_of`: for each node.
pub(crate) fn film_of(
    body: &Body,
    fragments: &[Fragment],
    piece_of: impl Fn(u32) -> Option<u32>,
) -> Vec<FilmBond> {
    let Some((thickness, laminate)) = body.laminated_wall() else {
        return Vec::new();
    };
    let mut bonds = film(laminate, fragments, thickness);
    let asset = &body.asset;
    let held = asset.supported.iter().filter_map(|&v| {
        let place = asset.fracture.positions[v as usize].as_dvec3();
        Some((piece_of(v)?, place - body.origin()))
    });
    bonds.extend(film_at_supports(laminate, held, thickness));
    bonds
}

/// The bonds between all pieces of a wall of this thickness, m; places are in the frame of the fragments' centres.
fn film(laminate: &Laminate, fragments: &[Fragment], thickness: f64) -> Vec<FilmBond> {
    let mut bonds = Vec::new();
    for (one, fragment) in (0..).zip(fragments) {
        for seam in seams(one, fragment) {
            bonds.extend(bonds_of(one, seam, laminate, thickness));
        }
    }
    bonds
}

/// Cracks between a piece and those after it.
fn seams(one: u32, fragment: &Fragment) -> Vec<Seam> {
    let mesh = &fragment.mesh;
    let mut seams: Vec<Seam> = Vec::new();
    for (triangle, &other) in mesh.triangles[mesh.outer_triangles..]
        .iter()
        .zip(&fragment.neighbours)
    {
        if other <= one || other == Fragment::PARTED {
            continue;
        }
        let [a, b, c] =
            triangle.map(|v| fragment.mass.centre + mesh.positions[v as usize].as_dvec3());
        let normal = 0.5 * (b - a).cross(c - a);
        let (area, middle) = (normal.length(), (a + b + c) / 3.0);
        let at = seams.iter().position(|seam| seam.other == other);
        let at = at.unwrap_or_else(|| {
            seams.push(Seam {
                other,
                ..Seam::default()
            });
            seams.len() - 1
        });
        let seam = &mut seams[at];
        seam.area += area;
        seam.first += area * middle;
        seam.second += outer(middle) * area;
        seam.normal += normal;
    }
    seams
}

fn bonds_of(
    one: u32,
    seam: Seam,
    laminate: &Laminate,
    thickness: f64,
) -> impl Iterator<Item = FilmBond> {
    let middle = seam.first / seam.area;
    let spread = seam.second * (1.0 / seam.area) - outer(middle);
    let (moments, directions) = symmetric_eigen(spread);
    let largest = (0..3).max_by(|&a, &b| moments[a].total_cmp(&moments[b]));
    let length = seam.area / thickness;
    let along = directions.col(largest.unwrap_or(0)).normalize_or(DVec3::X);
    let across = seam.normal - seam.normal.dot(along) * along;
    let across = across.normalize_or(along.any_orthonormal_vector());
    let films = f64::from(laminate.plies - 1) * laminate.interlayer;
    let count = if length > LONG * thickness { 2 } else { 1 };
    let (part, laminate, other) = (length / f64::from(count), *laminate, seam.other);
    let shift = move |k: i32| (f64::from(k) - 0.5 * f64::from(count - 1)) * part;
    let sound = seam.area > 0.0 && middle.is_finite();
    (0..if sound { count } else { 0 }).map(move |k| FilmBond {
        pieces: [one, other],
        place: (middle + shift(k) * along).as_vec3(),
        along: along.as_vec3(),
        across: across.as_vec3(),
        length: part,
        section: part * films,
        strength: laminate.strength,
        stretch: laminate.stretch,
        arm: 0.5 * thickness,
    })
}

/// The bonds of pieces to what holds the body: one for each stretch of held nodes. `held`: pieces and places of the nodes, m.
fn film_at_supports(
    laminate: &Laminate,
    held: impl Iterator<Item = (u32, DVec3)>,
    thickness: f64,
) -> Vec<FilmBond> {
    let mut of_square: BTreeMap<(u32, [i32; 3]), Vec<DVec3>> = BTreeMap::new();
    for (piece, place) in held {
        let square = (place / STRETCH_OF_RIM).floor().as_ivec3().to_array();
        of_square.entry((piece, square)).or_default().push(place);
    }
    let bonds = of_square.into_iter().map(|((piece, _), places)| {
        let seam = places.iter().fold(Seam::default(), |seam, &p| Seam {
            other: FilmBond::FRAME,
            area: seam.area + 1.0,
            first: seam.first + p,
            second: seam.second + outer(p),
            ..seam
        });
        let [mut low, mut high] = [places[0]; 2];
        for &p in &places {
            (low, high) = (low.min(p), high.max(p));
        }
        let length = (high - low).length().clamp(thickness, STRETCH_OF_RIM);
        let scale = length * thickness / seam.area;
        let seam = Seam {
            area: seam.area * scale,
            first: seam.first * scale,
            second: seam.second * scale,
            ..seam
        };
        bonds_of(piece, seam, laminate, thickness)
    });
    bonds.flatten().collect()
}
