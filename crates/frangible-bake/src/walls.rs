//! Thin walls behind the outer surface: their thickness, curvature and distance to an edge.
//!
//! An impact bends a wall most within a few thicknesses of the contact, which the modes do not resolve; the simulation adds this
//! bending from the quantities computed here. They depend on the surface only, so that parametric shapes and imported meshes are
//! treated alike.
//!
//! **Thickness.** Three rays per triangle are cast into the body against the smooth normal to the opposite face, which must be nearly
//! parallel. The result is averaged over a neighbourhood half a thickness wide to remove the effect of facets on curved walls: an
//! error of 5 % in thickness is 10–15 % in stress.
//!
//! **Curvature.** The normal is fitted as a linear function of position over a neighbourhood of [`SCALE`] thicknesses by least
//! squares. This is exact for spheres and tubes at any size of the neighbourhood and averages out facets. The middle surface is half
//! a thickness away.
//!
//! **Margin.** Distances are propagated from the edges of the wall: creases, places without a parallel face behind, changes of
//! thickness by a third, radii below [`SLENDER`] thicknesses, and supports.
//!
//! **Definition of a wall.** A wall is a connected region into which a disc of radius [`SLENDER`] thicknesses fits. Panes, plates and
//! the side of a drinking glass are walls; a cube, a brick, a ball, a hammer head and the rim of a pane are not.

use frangible::glam::{DMat2, DVec2, DVec3, Vec3};
use frangible::internals::asset::{OuterSurface, SurfaceWalls};
use frangible::internals::mesh::AlongSurface;
use frangible_mesh::{MeshSolid, Surface};

/// A wall's radius, of the largest disc in it and of its curvature, is at least this many times its thickness.
const SLENDER: f64 = 3.0;
/// Cosine between the normals of the two faces of a wall, at most.
const OPPOSITE: f64 = -0.8;
/// Radius of the neighbourhood in which the curvature is found, in thicknesses.
const SCALE: f64 = 4.0;
/// The neighbourhood reaches at least this many edges of its triangle, so that there is something to fit to.
const RINGS: f64 = 3.0;
/// The neighbourhood has at most this many triangles: some eleven rings, over which facets have averaged out.
const FITTED: usize = 400;
/// Radius of the neighbourhood over which the thickness is averaged, in thicknesses, and at least one ring.
const AVERAGED: f64 = 0.5;
/// A wall ends where its thickness has changed by this factor.
const CHANGE: f64 = 4.0 / 3.0;
/// Thicknesses within a factor of this are measured from the same edges.
const CLASS: f64 = 1.15;
/// Rays start this far below the surface, in sizes of the body.
const SKIN: f64 = 1e-6;

/// Measures the walls of a body. `supported`: nodes that are held, rising. `crease`: faces that meet at a larger angle,
/// degrees, meet at an edge.
pub(crate) fn walls(
    positions: &[Vec3],
    surface: &OuterSurface,
    supported: &[u32],
    crease: f64,
) -> SurfaceWalls {
    let Some(faces) = Faces::new(positions, surface, crease) else {
        return SurfaceWalls::default();
    };
    let measured = faces.thickness();
    let thickness = faces.averaged(&measured);
    let mut walk = Walk::new(faces.count());
    let bends: Vec<Option<Bend>> = (0..faces.count())
        .map(|t| faces.bend(&mut walk, t, thickness[t]?))
        .collect();
    let along = AlongSurface::new(positions, &surface.triangles);
    let stretches = faces.stretches(&along, &bends);
    if stretches.iter().all(Option::is_none) {
        return SurfaceWalls::default();
    }
    let held = faces.distances_from_supports(&along, &stretches, &measured, supported);
    let of = |number: &dyn Fn(usize, Bend, f64) -> f64| -> Vec<f32> {
        let numbers = (0..faces.count()).map(|t| match (bends[t], stretches[t]) {
            (Some(bend), Some(margin)) => number(t, bend, margin) as f32,
            _ => f32::INFINITY,
        });
        numbers.collect()
    };
    SurfaceWalls {
        thickness: of(&|_, bend, _| bend.thickness),
        stiffening: of(&|_, bend, _| bend.stiffening),
        margin: of(&|t, _, margin| margin.min(held[t])),
    }
}

/// A place that may be a wall.
#[derive(Clone, Copy)]
struct Bend {
    thickness: f64,
    stiffening: f64,
}

/// Thickness and the face behind, as the rays from a triangle found them.
type Measured = Option<(f64, u32)>;

/// The surface, triangle by triangle.
struct Faces<'a> {
    surface: &'a OuterSurface,
    solid: MeshSolid,
    corners: Vec<[DVec3; 3]>,
    centroid: Vec<DVec3>,
    /// Unit normal of the flat triangle.
    normal: Vec<DVec3>,
    area: Vec<f64>,
    /// Neighbours across edges that are not creases.
    smooth: Vec<[u32; 3]>,
    size: f64,
}

const NONE: u32 = u32::MAX;

impl<'a> Faces<'a> {
    /// `None` for what encloses nothing.
    fn new(positions: &[Vec3], surface: &'a OuterSurface, crease: f64) -> Option<Self> {
        let points: Vec<DVec3> = positions.iter().map(|p| p.as_dvec3()).collect();
        let triangles = &surface.triangles;
        let corners = triangles.iter().map(|t| t.map(|v| points[v as usize]));
        let corners: Vec<[DVec3; 3]> = corners.collect();
        let areas = corners
            .iter()
            .map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a));
        let areas: Vec<DVec3> = areas.collect();
        let normal: Vec<DVec3> = areas.iter().map(|a| a.normalize_or_zero()).collect();
        let box_of = corners.iter().flatten();
        let [low, high] = box_of.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[l, h], &x| {
            [l.min(x), h.max(x)]
        });
        let smooth = crease.to_radians().cos();
        let solid = MeshSolid::new(&Surface {
            positions: points,
            triangles: triangles.clone(),
        });
        Some(Self {
            surface,
            solid: solid.ok()?,
            centroid: corners
                .iter()
                .map(|x| x.iter().sum::<DVec3>() / 3.0)
                .collect(),
            smooth: neighbours(triangles, |t, u| normal[t].dot(normal[u]) > smooth),
            area: areas.iter().map(|a| a.length()).collect(),
            corners,
            normal,
            size: low.distance(high),
        })
    }

    fn count(&self) -> usize {
        self.corners.len()
    }

    /// Thickness behind each triangle, m, and the face there: the mean of those rays that meet a nearly parallel one.
    fn thickness(&self) -> Vec<Measured> {
        // A thicker body has no room for a wall of that thickness.
        let longest = self.size / (2.0 * SLENDER);
        let skin = SKIN * self.size;
        let ray = |t: usize, k: usize| -> Measured {
            let weights = [0, 1, 2].map(|i| if i == k { 2.0 / 3.0 } else { 1.0 / 6.0 });
            let mean =
                |x: [DVec3; 3]| -> DVec3 { x.iter().zip(weights).map(|(x, w)| w * *x).sum() };
            let from = mean(self.corners[t]);
            let normals = self.surface.normals[t].map(Vec3::as_dvec3);
            let into = -mean(normals).try_normalize()?;
            let (at, face) = self
                .solid
                .first_exit(from + skin * into, from + longest * into)?;
            let cosine = into.dot(self.normal[face as usize]);
            let length = skin + at * (longest - skin);
            // Half way between the way to the other face and the distance from its plane: of a wedge, its thickness half way.
            (cosine > -OPPOSITE).then_some((0.5 * length * (1.0 + cosine), face))
        };
        let all = (0..self.count()).map(|t| {
            let found: Vec<(f64, u32)> = (0..3).filter_map(|k| ray(t, k)).collect();
            let sum: f64 = found.iter().map(|f| f.0).sum();
            // One stray ray out of three may miss; two are no wall.
            (found.len() >= 2).then(|| (sum / found.len() as f64, found[0].1))
        });
        all.collect()
    }

    /// The mean over the neighbourhood of each triangle, by area, of thicknesses like its own.
    fn averaged(&self, measured: &[Measured]) -> Vec<Option<f64>> {
        let mut walk = Walk::new(self.count());
        let mean = |t: usize| {
            let own = measured[t]?.0;
            let (mut sum, mut area) = (0.0, 0.0);
            let reach = (AVERAGED * own).max(self.longest_edge(t));
            for &u in walk.around(self, t, reach) {
                if let Some((h, _)) = measured[u as usize]
                    && (own / CHANGE..own * CHANGE).contains(&h)
                {
                    sum += self.area[u as usize] * h;
                    area += self.area[u as usize];
                }
            }
            Some(if area > 0.0 { sum / area } else { own })
        };
        (0..self.count()).map(mean).collect()
    }

    fn longest_edge(&self, t: usize) -> f64 {
        let [a, b, c] = self.corners[t];
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    /// Curvature of the middle surface about a triangle; `None` where it is too curved for a wall.
    fn bend(&self, walk: &mut Walk, t: usize, thickness: f64) -> Option<Bend> {
        let reach = (SCALE * thickness).max(RINGS * self.longest_edge(t));
        let near = walk.around(self, t, reach);
        // Not its own: the mean is that of the smooth surface.
        let mean: DVec3 = near
            .iter()
            .map(|&u| self.area[u as usize] * self.normal[u as usize])
            .sum();
        let n = mean.try_normalize()?;
        let (x, y) = n.any_orthonormal_pair();
        let flat = |v: DVec3| DVec2::new(v.dot(x), v.dot(y));
        let mut area = 0.0;
        let (mut place, mut turn) = (DVec2::ZERO, DVec2::ZERO);
        for &u in near {
            let u = u as usize;
            area += self.area[u];
            place += self.area[u] * flat(self.centroid[u] - self.centroid[t]);
            turn += self.area[u] * flat(self.normal[u]);
        }
        let (place, turn) = (place / area, turn / area);
        let outer = |a: DVec2, b: DVec2| DMat2::from_cols(a * b.x, a * b.y);
        let (mut spread, mut turned) = (DMat2::ZERO, DMat2::ZERO);
        for &u in near {
            let u = u as usize;
            let p = flat(self.centroid[u] - self.centroid[t]) - place;
            let q = flat(self.normal[u]) - turn;
            spread += self.area[u] * outer(p, p);
            turned += self.area[u] * outer(q, p);
        }
        let [a, b] = [spread.x_axis.x, spread.y_axis.y];
        let [k1, k2] = match spread.determinant() > 1e-9 * a * b {
            true => principal(turned * spread.inverse()),
            // A strip in line shows one direction only.
            false => return None,
        };
        let middle = |k: f64| {
            let shrunk = 1.0 - 0.5 * k * thickness;
            (shrunk > 0.0).then(|| k / shrunk)
        };
        let [k1, k2] = [middle(k1)?, middle(k2)?];
        (k1.abs().max(k2.abs()) * thickness * SLENDER <= 1.0).then_some(Bend {
            thickness,
            stiffening: (3.0 * k1 * k1 + 3.0 * k2 * k2 + 2.0 * k1 * k2) / 8.0,
        })
    }

    /// Margin of each triangle that belongs to a wall, m, without regard to supports.
    fn stretches(&self, along: &AlongSurface<'_>, bends: &[Option<Bend>]) -> Vec<Option<f64>> {
        // In sizes of the body, so that a larger body of the same shape has the same classes.
        let class = |h: f64| ((h / self.size).ln() / CLASS.ln()).round() as i32;
        let mut classes: Vec<i32> = bends.iter().flatten().map(|b| class(b.thickness)).collect();
        classes.sort_unstable();
        classes.dedup();
        let mut margins = vec![None; self.count()];
        for wanted in classes {
            let typical = self.size * CLASS.powi(wanted);
            let alike = typical / CHANGE..=typical * CHANGE;
            let open = bends
                .iter()
                .map(|b| b.is_some_and(|b| alike.contains(&b.thickness)));
            let open: Vec<bool> = open.collect();
            let edges = self.edges(&open);
            let distances = along.at_triangles(&along.distances(&edges, |t| open[t]));
            let wide = self.wide(&open, &distances, SLENDER * typical);
            for t in 0..self.count() {
                if wide[t] && bends[t].is_some_and(|b| class(b.thickness) == wanted) {
                    margins[t] = Some(distances[t]);
                }
            }
        }
        margins
    }

    /// Vertices of sides beyond which an open triangle has no open neighbour.
    fn edges(&self, open: &[bool]) -> Vec<u32> {
        let mut edges = Vec::new();
        for t in (0..self.count()).filter(|&t| open[t]) {
            for (k, &u) in self.smooth[t].iter().enumerate() {
                if u == NONE || !open[u as usize] {
                    let corners = self.surface.triangles[t];
                    edges.extend([corners[k], corners[(k + 1) % 3]]);
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// For each triangle, true if it hangs together, over open ones, with an open one at least so far from every edge.
    fn wide(&self, open: &[bool], distances: &[f64], radius: f64) -> Vec<bool> {
        let mut wide = vec![false; self.count()];
        let mut waiting = Vec::new();
        for t in 0..self.count() {
            if open[t] && !wide[t] && distances[t] >= radius {
                wide[t] = true;
                waiting.push(t);
            }
            while let Some(t) = waiting.pop() {
                for &u in &self.smooth[t] {
                    if u != NONE && open[u as usize] && !wide[u as usize] {
                        wide[u as usize] = true;
                        waiting.push(u as usize);
                    }
                }
            }
        }
        wide
    }

    /// Distance of each triangle from the supports of its wall, m: on either of its faces.
    fn distances_from_supports(
        &self,
        along: &AlongSurface<'_>,
        stretches: &[Option<f64>],
        measured: &[Measured],
        supported: &[u32],
    ) -> Vec<f64> {
        if supported.is_empty() {
            return vec![f64::INFINITY; self.count()];
        }
        let held = |t: usize| {
            let corners = self.surface.triangles[t].into_iter();
            corners.filter(|v| supported.binary_search(v).is_ok())
        };
        let mut sources = Vec::new();
        for t in (0..self.count()).filter(|&t| stretches[t].is_some()) {
            sources.extend(held(t));
            // Two nodes are a side of the face behind; one would be a corner only, which it shares with a supported face.
            if measured[t].is_some_and(|(_, behind)| held(behind as usize).count() >= 2) {
                sources.extend(self.surface.triangles[t]);
            }
        }
        sources.sort_unstable();
        sources.dedup();
        along.at_triangles(&along.distances(&sources, |t| stretches[t].is_some()))
    }
}

/// Principal curvatures, of the symmetric part.
fn principal(turn: DMat2) -> [f64; 2] {
    let (a, c) = (turn.x_axis.x, turn.y_axis.y);
    let b = 0.5 * (turn.x_axis.y + turn.y_axis.x);
    let (mean, half) = (0.5 * (a + c), (0.25 * (a - c) * (a - c) + b * b).sqrt());
    [mean - half, mean + half]
}

/// The triangle across each side, corner k to k + 1, where `smooth` agrees.
fn neighbours(triangles: &[[u32; 3]], smooth: impl Fn(usize, usize) -> bool) -> Vec<[u32; 3]> {
    let mut sides: Vec<(u32, u32, u32, u8)> = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push((a.min(b), a.max(b), t as u32, k as u8));
        }
    }
    sides.sort_unstable();
    let mut across = vec![[NONE; 3]; triangles.len()];
    let mut first = 0;
    while first < sides.len() {
        let (a, b, ..) = sides[first];
        let same = sides[first..]
            .iter()
            .take_while(|s| (s.0, s.1) == (a, b))
            .count();
        // More than two meet where a body touches itself along a line: an edge.
        if let [(.., t, k), (.., u, l)] = sides[first..first + same]
            && smooth(t as usize, u as usize)
        {
            across[t as usize][usize::from(k)] = u;
            across[u as usize][usize::from(l)] = t;
        }
        first += same;
    }
    across
}

/// Walks over triangles that hang together, nearest rings first.
struct Walk {
    /// Number of the last traversal that visited each triangle.
    seen: Vec<u32>,
    walks: u32,
    found: Vec<u32>,
}

impl Walk {
    fn new(triangles: usize) -> Self {
        Self {
            seen: vec![0; triangles],
            walks: 0,
            found: Vec::new(),
        }
    }

    /// Triangles about one, itself the first, that no crease parts from it, within `reach`, m, and facing the same half of all
    /// directions.
    fn around(&mut self, faces: &Faces<'_>, centre: usize, reach: f64) -> &[u32] {
        self.walks += 1;
        self.found.clear();
        self.found.push(centre as u32);
        self.seen[centre] = self.walks;
        let mut next = 0;
        while let Some(&t) = self.found.get(next) {
            next += 1;
            for &u in &faces.smooth[t as usize] {
                if u == NONE || self.seen[u as usize] == self.walks || self.found.len() >= FITTED {
                    continue;
                }
                self.seen[u as usize] = self.walks;
                let u = u as usize;
                if faces.centroid[u].distance(faces.centroid[centre]) <= reach
                    && faces.normal[u].dot(faces.normal[centre]) > 0.0
                {
                    self.found.push(u as u32);
                }
            }
        }
        &self.found
    }
}
