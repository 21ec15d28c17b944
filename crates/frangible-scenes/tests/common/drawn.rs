//! Drawn surfaces of things at the end of a recording: depths in each other, and heights above what carries them.

use std::collections::BTreeMap;
use std::fmt;

use frangible::glam::Vec3;
use frangible_mesh::glam::DVec3;
use frangible_mesh::{MeshSolid, Surface};
use frangible_recording::{Pose, RecordedMesh, Recording};

/// Frames at the end of a recording in which a thing at rest stays where it is, and how far it may move meanwhile, m.
const REST: (usize, f32) = (12, 2e-4);

/// Error of a drawn place that is allowed, over the longest side of the body, and in any case, m.
const BOUND: (f64, f64) = (5e-3, 5e-4);

/// A body or piece as it is drawn in the last frame.
struct Thing {
    name: String,
    /// Longest side of the body that it is, or comes from, m.
    size: f64,
    surface: Surface,
    /// None where nothing is inside.
    solid: Option<MeshSolid>,
    bounds: [DVec3; 2],
    rests: bool,
    /// A piece that has never moved is held where it is.
    held: bool,
}

/// Place of a thing at rest.
#[derive(Clone, Debug)]
pub(crate) struct Lie {
    name: String,
    /// Largest of the lengths below that counts as nothing, m.
    pub(crate) bound: f64,
    /// Greatest depth of its vertices in the floor, m.
    pub(crate) in_floor: f64,
    /// Greatest depth of its vertices in another thing, m, and the thing.
    pub(crate) in_other: (f64, Option<String>),
    /// Distance from the nearest thing or the floor, m; 0 for one that is held.
    pub(crate) apart: f64,
}

impl Lie {
    /// Returns true if it lies where it is drawn.
    pub(crate) fn is_true(&self) -> bool {
        self.in_floor.max(self.in_other.0).max(self.apart) <= self.bound
    }
}

impl fmt::Display for Lie {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [bound, floor, other, apart] =
            [self.bound, self.in_floor, self.in_other.0, self.apart].map(|x| 1e3 * x);
        let of_which = self.in_other.1.as_deref().unwrap_or("another");
        write!(
            f,
            "{}: {floor:.2} mm in the floor, {other:.2} mm in {of_which}, {apart:.2} mm apart, of {bound:.2} mm",
            self.name
        )
    }
}

/// Closedness of a thing as it is drawn, without its cracks that end inside.
#[derive(Clone, Debug)]
pub(crate) struct Closed {
    /// Name of the thing.
    pub(crate) name: String,
    /// Sides of triangles that do not have exactly two faces, once in each direction.
    pub(crate) open_sides: usize,
    /// Its own volume, m³.
    pub(crate) volume: f64,
    /// Difference of the volume in its surface from its own, over its own.
    pub(crate) volume_off: f64,
}

/// Closedness of everything of which a recording tells the volume.
pub(crate) fn closed(recording: &Recording) -> Vec<Closed> {
    let things = recording.nodes.iter().filter_map(|node| {
        let volume = node
            .keep_extras
            .iter()
            .find(|(key, _)| key == "volume_m3")?
            .1;
        let still = Pose {
            translation: Vec3::ZERO,
            rotation: frangible::glam::Quat::IDENTITY,
        };
        let surface = drawn(recording, &recording.meshes[node.mesh], still);
        // Vertices are split where normals or texture coordinates differ.
        let place = |v: u32| surface.positions[v as usize].to_array().map(f64::to_bits);
        let mut sides: BTreeMap<[[u64; 3]; 2], [usize; 2]> = BTreeMap::new();
        let mut drawn_volume = 0.0;
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.map(|v| surface.positions[v as usize]);
            drawn_volume += a.dot(b.cross(c)) / 6.0;
            for k in 0..3 {
                let [from, to] = [triangle[k], triangle[(k + 1) % 3]].map(place);
                sides.entry([from.min(to), from.max(to)]).or_default()[usize::from(from < to)] += 1;
            }
        }
        Some(Closed {
            name: node.name.clone(),
            open_sides: sides.values().filter(|&&count| count != [1, 1]).count(),
            volume,
            volume_off: (drawn_volume / volume - 1.0).abs(),
        })
    });
    things.collect()
}

/// The things at rest at the end of a recording.
pub(crate) fn lies(recording: &Recording) -> Vec<Lie> {
    let things = things(recording);
    let floor = recording.floor.map(|floor| f64::from(floor.height));
    let at_rest = (0..things.len()).filter(|&i| things[i].rests);
    at_rest.map(|i| lie(&things, i, floor)).collect()
}

fn things(recording: &Recording) -> Vec<Thing> {
    let last = recording.frame_count - 1;
    let seen = recording.nodes.iter().enumerate();
    let seen = seen.filter(|(_, node)| node.visible.contains(&last));
    // Projectiles have no volume of their own.
    let seen = seen.filter(|(_, node)| node.keep_extras.iter().any(|(key, _)| key == "volume_m3"));
    let thing = |(i, node): (usize, &frangible_recording::RecordedNode)| {
        let mesh = &recording.meshes[node.mesh];
        let (frames, most) = REST;
        let now = recording.pose(i, last);
        let before = recording.pose(i, last.saturating_sub(frames));
        let of = recording.nodes.iter().find(|body| {
            let rest = node.name.strip_prefix(&body.name[..]);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(" piece "))
        });
        let body = &recording.meshes[of.unwrap_or(node).mesh];
        let [low, high] = bounds(body.positions.iter().map(|p| p.as_dvec3()));
        let surface = drawn(recording, mesh, now);
        let born = node.visible.start;
        Thing {
            name: node.name.clone(),
            size: (high - low).max_element(),
            solid: MeshSolid::new(&surface).ok(),
            bounds: bounds(surface.positions.iter().copied()),
            surface,
            rests: way(before, now, mesh) <= most && born + frames <= last,
            held: born > 0 && now == recording.pose(i, born),
        }
    };
    seen.map(thing).collect()
}

/// The longest way of a vertex from one pose to another, m.
fn way(from: Pose, to: Pose, mesh: &RecordedMesh) -> f32 {
    let at = |pose: Pose, p: Vec3| pose.rotation.normalize() * p + pose.translation;
    let ways = mesh
        .positions
        .iter()
        .map(|&p| at(from, p).distance(at(to, p)));
    ways.fold(0.0, f32::max)
}

/// The closed surface of a mesh, without its cracks that end inside, where it is.
fn drawn(recording: &Recording, mesh: &RecordedMesh, pose: Pose) -> Surface {
    let mut surface = Surface::default();
    let mut number = vec![u32::MAX; mesh.positions.len()];
    let closed =
        |part: &&frangible_recording::MeshPart| !recording.surfaces[part.surface].ends_inside;
    for triangle in mesh
        .parts
        .iter()
        .filter(closed)
        .flat_map(|part| part.indices.as_chunks().0)
    {
        surface.triangles.push(triangle.map(|v: u32| {
            let v = v as usize;
            if number[v] == u32::MAX {
                number[v] = surface.positions.len() as u32;
                let place = pose.rotation.normalize() * mesh.positions[v] + pose.translation;
                surface.positions.push(place.as_dvec3());
            }
            number[v]
        }));
    }
    surface
}

fn bounds(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    points.fold(nothing, |[low, high], p| [low.min(p), high.max(p)])
}

fn lie(things: &[Thing], i: usize, floor: Option<f64>) -> Lie {
    let thing = &things[i];
    let above = floor.map_or(f64::INFINITY, |floor| thing.bounds[0].y - floor);
    let (share, least) = BOUND;
    let mut lie = Lie {
        name: thing.name.clone(),
        bound: least.max(share * thing.size),
        in_floor: (-above).max(0.0),
        in_other: (0.0, None),
        apart: if thing.held { 0.0 } else { above.max(0.0) },
    };
    let others = things.iter().enumerate().filter(|(k, _)| *k != i);
    for (_, other) in others {
        let near = |a: &Thing, p: &DVec3, reach: f64| {
            p.cmpge(a.bounds[0] - reach).all() && p.cmple(a.bounds[1] + reach).all()
        };
        if let Some(solid) = &other.solid {
            let points = thing.surface.positions.iter();
            let points = points.filter(|p| near(other, p, lie.apart));
            let points: Vec<DVec3> = points.copied().collect();
            for (p, inside) in points.iter().zip(solid.inside_many(&points)) {
                let within = if inside { f64::INFINITY } else { lie.apart };
                let Some(nearest) = solid.nearest(*p, within) else {
                    continue;
                };
                lie.apart = lie.apart.min(nearest.distance);
                if inside && nearest.distance > lie.in_other.0 {
                    lie.in_other = (nearest.distance, Some(other.name.clone()));
                }
            }
        }
        if let Some(solid) = &thing.solid {
            for p in &other.surface.positions {
                if near(thing, p, lie.apart)
                    && let Some(nearest) = solid.nearest(*p, lie.apart)
                {
                    lie.apart = lie.apart.min(nearest.distance);
                }
            }
        }
    }
    lie
}
