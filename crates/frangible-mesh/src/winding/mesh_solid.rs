//! The solid inside a triangle surface.

use glam::DVec3;
use rayon::prelude::*;

use super::far::{self, Far};
use super::nearest::{self, Nearest};
use super::number;
use super::packet::{Packet, area_vector};
use super::segment;
use super::tree::{self, Tree};
use crate::solid::{Solid, SurfacePoint, sign_change};
use crate::surface::Surface;

/// Sizes between which no product of lengths leaves the range of f64, m.
const SIZES: [f64; 2] = [1e-30, 1e30];
/// Points per task of a batch; fixed, so that the work is cut the same way for any number of threads.
const BATCH: usize = 256;
/// Winding number that shows an inside. An open sheet needs a depth of a fiftieth of its half width to reach it.
const CLEARLY_INSIDE: f64 = 0.51;
/// Hits closer than this share of a segment are one.
const SAME_HIT: f64 = 1e-9;

/// Error of making a solid from a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// No triangle at all, or more than can be counted.
    #[error("the surface has {0} triangles; it must have 1 to 2^30")]
    TriangleCount(usize),
    /// A corner that does not exist.
    #[error(
        "triangle {triangle} refers to vertex {vertex}, but there are only {count}; check its vertex indices"
    )]
    Index {
        /// The triangle.
        triangle: usize,
        /// Its corner.
        vertex: u32,
        /// Vertices there are.
        count: usize,
    },
    /// NaN or infinity.
    #[error(
        "vertex {vertex} at {position} is not finite; give every coordinate a finite value in metres"
    )]
    NotFinite {
        /// The vertex.
        vertex: u32,
        /// Position given, m.
        position: DVec3,
    },
    /// A size that is not between 1e-30 and 1e30 m.
    #[error("the surface measures {0:e} m; scale it to between 1e-30 m and 1e30 m")]
    Size(f64),
    /// Every triangle is a line or a point.
    #[error(
        "none of the {0} triangles has an area; give at least one whose vertices are not collinear"
    )]
    NoArea(usize),
    /// Flat, or the sides cancel.
    #[error(
        "the surface does not enclose a volume: its winding number reaches only {highest:.3}, but inside a body it exceeds 0.5; close the surface, give it a thickness, or orient its faces consistently"
    )]
    NoInside {
        /// The highest winding number found.
        highest: f64,
    },
}

/// A triangle surface as a [`Solid`]: inside is where its winding number exceeds one half, within the box that holds
/// the triangles. The surface may be open, a soup, in shells, or cross itself; a surface that is inside out as a whole
/// is turned, and triangles without area are left out. Where holes are, w = ½ closes them.
#[derive(Clone, Debug)]
pub struct MeshSolid {
    tree: Tree,
    far: Vec<Far>,
    bounds: [DVec3; 2],
    turned: bool,
}

impl MeshSolid {
    /// Reads the surface, builds the search tree and looks for an inside.
    ///
    /// # Errors
    /// See [`SolidError`].
    pub fn new(surface: &Surface) -> Result<Self, SolidError> {
        let mut solid = Self::skin(surface)?;
        let mut highest = f64::NEG_INFINITY;
        for _ in 0..2 {
            let found = solid.highest_winding_number();
            if found > CLEARLY_INSIDE {
                return Ok(solid);
            }
            highest = highest.max(found);
            solid.turned = !solid.turned;
        }
        Err(SolidError::NoInside { highest })
    }

    /// Reads a surface that need not enclose anything, such as a flat sheet, for the closest places on it.
    ///
    /// # Errors
    /// See [`SolidError`].
    pub fn skin(surface: &Surface) -> Result<Self, SolidError> {
        let triangles = checked(surface)?;
        let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let corners = triangles.iter().flat_map(|(_, corners)| corners);
        let bounds = corners.fold(nothing, |[l, h], &c| [l.min(c), h.max(c)]);
        let size = (bounds[1] - bounds[0]).length();
        if !(SIZES[0]..=SIZES[1]).contains(&size) {
            return Err(SolidError::Size(size));
        }
        let middle = 0.5 * (bounds[0] + bounds[1]);
        let volume: f64 = triangles
            .iter()
            .map(|(_, corners)| area_vector(*corners).dot(corners[0] - middle))
            .sum();
        let tree = tree::build(&triangles);
        let far = far::expand(&tree);
        Ok(Self {
            tree,
            far,
            bounds,
            turned: volume < 0.0,
        })
    }

    /// Number of times the surface goes around `p`: 1 in a closed body, 0 outside, between them near holes [J13 §3]. Exact but
    /// for far groups of triangles, which are expanded to second order: off by less than 0.01 [B18 §3].
    #[must_use]
    pub fn winding_number(&self, p: DVec3) -> f64 {
        let w = number::winding_number(&self.tree, &self.far, p);
        if self.turned { -w } else { w }
    }

    /// For each point, true if it is inside; on all threads.
    #[must_use]
    pub fn inside_many(&self, points: &[DVec3]) -> Vec<bool> {
        let mut inside = vec![false; points.len()];
        inside
            .par_chunks_mut(BATCH)
            .zip(points.par_chunks(BATCH))
            .for_each(|(inside, points)| {
                for (inside, &p) in inside.iter_mut().zip(points) {
                    *inside = self.inside(p);
                }
            });
        inside
    }

    /// The closest place of the surface if it is no farther than `within` metres. A tight bound makes it quick: the
    /// distance of a point nearby plus the way from there.
    #[must_use]
    pub fn nearest(&self, p: DVec3, within: f64) -> Option<Nearest> {
        let (face, corners) = nearest::nearest(&self.tree, p, within)?;
        let position = nearest::closest_on_triangle(corners, p);
        let normal = area_vector(corners).normalize_or(DVec3::Y);
        Some(Nearest {
            position,
            distance: position.distance(p),
            face,
            normal: if self.turned { -normal } else { normal },
        })
    }

    /// The first triangle through which the segment leaves the body, from its back to its front: the place along the segment,
    /// 0..1, and its index in the surface; the lowest of those that share the place.
    #[must_use]
    pub fn first_exit(&self, from: DVec3, to: DVec3) -> Option<(f64, u32)> {
        let hits = segment::hits(&self.tree, from, to);
        let exit = hits.iter().find(|hit| hit.leaves != self.turned)?;
        Some((exit.t, exit.face))
    }

    pub(super) fn packets(&self) -> &[Packet] {
        &self.tree.packets
    }

    pub(super) fn turned(&self) -> bool {
        self.turned
    }

    fn in_bounds(&self, p: DVec3) -> bool {
        let [low, high] = self.bounds;
        p.cmpge(low).all() && p.cmple(high).all()
    }

    /// Intervals of the segment between triangles, as the borders 0, t₁, …, 1.
    pub(super) fn borders(&self, from: DVec3, to: DVec3) -> Vec<f64> {
        let mut borders = vec![0.0];
        for hit in segment::hits(&self.tree, from, to) {
            if hit.t - borders[borders.len() - 1] > SAME_HIT && hit.t < 1.0 - SAME_HIT {
                borders.push(hit.t);
            }
        }
        borders.push(1.0);
        borders
    }

    /// Parameter at which the winding number falls below one half, between two of a segment with no triangle between.
    fn fade(&self, at: impl Fn(f64) -> DVec3, inside: f64, outside: f64) -> f64 {
        let between = |s: f64| inside + s * (outside - inside);
        let lack = |s: f64| {
            let p = at(between(s));
            if self.in_bounds(p) {
                0.5 - self.winding_number(p)
            } else {
                0.5
            }
        };
        between(sign_change(lack, 1e-6))
    }

    /// The highest winding number at places that would be inside: half way from triangles to the faces behind them,
    /// or else on a grid.
    fn highest_winding_number(&self) -> f64 {
        let [low, high] = self.bounds;
        let size = (high - low).length();
        let step = (self.tree.packets.len() / 256).max(1);
        let mut highest = f64::NEG_INFINITY;
        for packet in self.tree.packets.iter().step_by(step) {
            let corners = packet.triangle(0);
            let normal = area_vector(corners).normalize_or(DVec3::Y);
            let inwards = if self.turned { normal } else { -normal };
            let from = (corners[0] + corners[1] + corners[2]) / 3.0;
            let borders = self.borders(from, from + size * inwards);
            if borders.len() > 2 {
                let place = from + 0.5 * borders[1] * size * inwards;
                highest = highest.max(self.winding_number(place));
                if highest > CLEARLY_INSIDE {
                    return highest;
                }
            }
        }
        const GRID: usize = 12;
        for cell in 0..GRID.pow(3) {
            let place = [cell / GRID / GRID, cell / GRID % GRID, cell % GRID]
                .map(|i| (i as f64 + 0.5) / GRID as f64);
            let p = low + DVec3::from_array(place) * (high - low);
            highest = highest.max(self.winding_number(p));
        }
        highest
    }
}

/// Triangles that have an area, with their indices.
fn checked(surface: &Surface) -> Result<Vec<(u32, [DVec3; 3])>, SolidError> {
    let count = surface.triangles.len();
    if count == 0 || count > 1 << 30 {
        return Err(SolidError::TriangleCount(count));
    }
    let mut triangles = Vec::with_capacity(count);
    for (face, indices) in (0..).zip(&surface.triangles) {
        let mut corners = [DVec3::ZERO; 3];
        for (corner, &vertex) in corners.iter_mut().zip(indices) {
            let position = surface.positions.get(vertex as usize);
            *corner = *position.ok_or(SolidError::Index {
                triangle: face as usize,
                vertex,
                count: surface.positions.len(),
            })?;
            if !corner.is_finite() {
                return Err(SolidError::NotFinite {
                    vertex,
                    position: *corner,
                });
            }
        }
        let farthest = corners
            .map(|c| c.abs().max_element())
            .into_iter()
            .fold(0.0, f64::max);
        if farthest > SIZES[1] {
            return Err(SolidError::Size(farthest));
        }
        let [a, b, c] = corners;
        let longest = (b - a).length().max((c - a).length()).max((c - b).length());
        if area_vector(corners).length() > 1e-15 * longest * longest {
            triangles.push((face, corners));
        }
    }
    if triangles.is_empty() {
        return Err(SolidError::NoArea(count));
    }
    Ok(triangles)
}

impl Solid for MeshSolid {
    fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    /// Distance to the closest triangle, with the sign of [`Solid::inside`]. In a hole the body ends where no triangle
    /// is, so near holes the magnitude is no bound: ask `inside` instead.
    fn signed_distance(&self, p: DVec3) -> f64 {
        let distance = self.nearest(p, f64::INFINITY).map_or(0.0, |n| n.distance);
        if self.inside(p) { -distance } else { distance }
    }

    fn inside(&self, p: DVec3) -> bool {
        self.in_bounds(p) && self.winding_number(p) > 0.5
    }

    /// The last place where the segment leaves the body: at a triangle, or where w = ½ in a hole, to 1e-6 of its
    /// length.
    fn crossing(&self, inside: DVec3, outside: DVec3) -> DVec3 {
        let at = |t: f64| inside.lerp(outside, t);
        let hits = segment::hits(&self.tree, inside, outside);
        if let [hit] = hits[..]
            && hit.leaves != self.turned
        {
            return at(hit.t);
        }
        let borders = self.borders(inside, outside);
        // From the outside end back to the first interval that is inside at its middle.
        let mut beyond = 1.0;
        for pair in borders.windows(2).rev() {
            let middle = 0.5 * (pair[0] + pair[1]);
            if self.inside(at(middle)) {
                return at(if pair[1] < 1.0 {
                    pair[1]
                } else {
                    self.fade(at, middle, 1.0)
                });
            }
            beyond = middle;
        }
        at(self.fade(at, 0.0, beyond))
    }

    /// Closest point of the surface with the normal of its face. The winding number drops by one along that normal, so
    /// it points outwards wherever one side is inside; between overlapping shells it is the face's own.
    fn closest(&self, p: DVec3) -> SurfacePoint {
        match self.nearest(p, f64::INFINITY) {
            Some(n) => SurfacePoint {
                position: n.position,
                normal: n.normal,
            },
            None => SurfacePoint {
                position: p,
                normal: DVec3::Y,
            },
        }
    }

    fn foot(&self, p: DVec3, within: f64) -> Option<DVec3> {
        self.nearest(p, within).map(|n| n.position)
    }

    fn exit(&self, from: DVec3, direction: DVec3) -> Option<f64> {
        let [low, high] = self.bounds;
        let reach = 1.001 * (high - low).length();
        if !self.inside(from) {
            return None;
        }
        let borders = self.borders(from, from + reach * direction);
        let at = |t: f64| from + t * reach * direction;
        for pair in borders.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            if !self.inside(at(middle)) {
                let t = if pair[0] > 0.0 {
                    pair[0]
                } else {
                    self.fade(at, 0.0, middle)
                };
                return Some(t * reach);
            }
        }
        Some(reach)
    }
}
