//! Choice of cameras, so that the subject of a picture fills it.

use frangible::glam::Vec3;
use frangible_recording::{Recording, View};

use crate::recorder::Role;

/// Size of the picture over that of its subject.
const MARGIN: f32 = 1.08;

/// Share of a disc around pieces that their faces fill, at least: as many pieces as that allows are shown, and strays are not.
const FILLED: f64 = 0.12;

/// Share of the disc that is enough where pieces lie so far apart that [`FILLED`] would show fewer than [`FEW`] of them.
const FILLED_THINLY: f64 = 0.04;

/// Number of pieces below which a picture says little of the break.
const FEW: usize = 3;

/// Distance below which a body that moves stays where it is, m.
const STAYS: f32 = 0.01;

/// Height of a piece's centre over the floor above which it hangs, m.
const HANGS: f32 = 0.05;

/// Height over width below which a body lies flat.
const FLAT: f32 = 0.4;

/// Least height of the eye over a subject that lies flat, as a share of its distance along the floor.
const ABOVE: f32 = 0.9;

/// Least distance from which pieces are looked at, as a share of that of the whole body.
const NEARER: f32 = 0.6;

/// Number of the heaviest pieces of which one is in the middle of the picture.
const MIDDLES: usize = 8;

/// Share of the mass of what breaks that is shown while it still lies together: crumbs that have flown off are not.
const NEARLY_ALL: f64 = 0.95;

/// A piece that has less than this share of the area of the largest one is no piece that a viewer counts.
const COUNTS: f64 = 0.05;

/// Directions whose farthest point of a mesh is looked at.
const DIRECTIONS: usize = 128;

/// A thing in a frame.
struct Thing {
    mass: f64,
    /// Area that is seen of it, in the mean over all directions, m²: a quarter of its surface.
    area: f64,
    centre: Vec3,
    points: Vec<Vec3>,
}

/// A view of the whole of it, from before the break to the end, and the views of the four moments.
pub(crate) fn cameras(recording: &Recording, roles: &[Role], look_from: Vec3) -> (View, [View; 4]) {
    let moments = recording.moments;
    // Without a floor pieces fall for ever.
    let end = match recording.floor {
        Some(_) => moments.at_rest,
        None => moments.just_after,
    };
    let broke = |node: usize| {
        let mut blows = recording.blows.iter();
        blows.any(|blow| blow.node == node && !blow.pieces.is_empty())
    };
    let bodies = things(recording, roles, moments.before, |_, role| {
        role == Role::Body
    });
    // The bodies that break, where not all do.
    let mut breaking = things(recording, roles, moments.before, |node, role| {
        role == Role::Body && broke(node)
    });
    if breaking.is_empty() {
        breaking = bodies;
    }
    // A body that has cracked and holds is another node from then on.
    let stays = |node: usize, since: usize| {
        let [from, to] = [since, end].map(|frame| recording.pose(node, frame));
        let seen = recording.nodes[node].visible.contains(&end);
        seen && from.translation.distance(to.translation) < STAYS
    };
    let standing = (0..roles.len()).any(|node| match roles[node] {
        Role::Body => !broke(node) && stays(node, moments.before),
        // A piece that is held hangs over the floor.
        Role::Piece => {
            recording.floor.is_some()
                && recording.pose(node, end).translation.y > HANGS
                && stays(node, moments.just_after)
        }
        Role::Projectile => false,
    });
    let pieces = |frame: usize| {
        let pieces = things(recording, roles, frame, |_, role| role == Role::Piece);
        if pieces.is_empty() {
            things(recording, roles, frame, |_, role| role != Role::Projectile)
        } else {
            pieces
        }
    };
    let ground = match recording.floor {
        Some(_) => 0.0,
        None => f32::MIN,
    };
    let look = |points: &[Vec3]| view(points, ground, look_from, 0.0);
    let before = all(&breaking);
    // Bodies that stay whole, and where they are, are the place where the others broke: it stays in the picture.
    let about_place = || {
        let seen = things(recording, roles, end, |_, role| role != Role::Projectile);
        about(&seen, middle(&before))
    };
    // If all has fallen far from there, the place says nothing.
    let about_place = standing.then(about_place).filter(|seen| !seen.is_empty());
    let place_at_end = about_place.is_some();
    let resting = about_place.unwrap_or_else(|| together(&pieces(end)));
    let shown = [
        (nearly_all(&pieces(moments.first_crack)), standing),
        (together(&pieces(moments.just_after)), standing),
        (resting, place_at_end),
    ];
    let [first, flying, resting] = shown.map(|(mut points, with_place)| {
        if points.is_empty() || with_place {
            points.extend(&before);
        }
        points
    });
    let whole: Vec<Vec3> = before.iter().chain(&resting).copied().collect();
    let [before, first] = [&before, &first].map(|points| look(points));
    // One large piece alone, closer than the whole body was, would not be recognised.
    let nearest = NEARER * before.eye.distance(before.target);
    let flying = view(&flying, ground, look_from, nearest);
    let resting = view(&resting, ground, over(&resting, look_from), nearest);
    (look(&whole), [before, first, flying, resting])
}

/// The direction to look from, but from higher up if the subject lies flat.
fn over(seen: &[Vec3], look_from: Vec3) -> Vec3 {
    let low = seen.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let size = seen.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max) - low;
    let along = Vec3::new(look_from.x, 0.0, look_from.z).length();
    if look_from.y < 0.0 || size.y > FLAT * size.x.max(size.z) {
        return look_from;
    }
    look_from.with_y(look_from.y.max(ABOVE * along))
}

/// Visible things of these roles in a frame.
fn things(
    recording: &Recording,
    roles: &[Role],
    frame: usize,
    wanted: impl Fn(usize, Role) -> bool,
) -> Vec<Thing> {
    let nodes = recording.nodes.iter().zip(roles).enumerate();
    let seen =
        nodes.filter(|(i, (node, role))| node.visible.contains(&frame) && wanted(*i, **role));
    seen.map(|(i, (node, _))| {
        let pose = recording.pose(i, frame);
        let positions = &recording.meshes[node.mesh].positions;
        let mass = node.keep_extras.iter().find(|e| e.0 == "mass_kg");
        let mesh = &recording.meshes[node.mesh];
        let faces = mesh
            .parts
            .iter()
            .flat_map(|part| part.indices.chunks_exact(3));
        let area = faces.map(|face| {
            let [a, b, c] = [0, 1, 2].map(|k| positions[face[k] as usize]);
            0.5 * f64::from((b - a).cross(c - a).length())
        });
        Thing {
            area: 0.25 * area.sum::<f64>(),
            mass: mass.map_or(0.0, |e| e.1),
            centre: pose.translation,
            points: farthest(positions)
                .map(|p| pose.rotation * p + pose.translation)
                .collect(),
        }
    })
    .collect()
}

/// The farthest of these points in each of [`DIRECTIONS`], which lie evenly around (Fibonacci's spiral): the corners of a box are among them.
fn farthest(points: &[Vec3]) -> impl Iterator<Item = Vec3> {
    let golden = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    (0..DIRECTIONS).filter_map(move |k| {
        let up = 1.0 - (2 * k + 1) as f32 / DIRECTIONS as f32;
        let along = (1.0 - up * up).sqrt();
        let (sin, cos) = libm::sincosf(golden * k as f32);
        let toward = Vec3::new(along * cos, up, along * sin);
        let farther = |a: &&Vec3, b: &&Vec3| a.dot(toward).total_cmp(&b.dot(toward));
        points.iter().max_by(farther).copied()
    })
}

fn all(things: &[Thing]) -> Vec<Vec3> {
    things
        .iter()
        .flat_map(|thing| &thing.points)
        .copied()
        .collect()
}

/// The points of the heaviest things, which have [`NEARLY_ALL`] of the mass.
fn nearly_all(things: &[Thing]) -> Vec<Vec3> {
    let wanted = NEARLY_ALL * things.iter().map(|thing| thing.mass).sum::<f64>();
    let mut mass = 0.0;
    let heaviest = heaviest(things).into_iter().take_while(|&i| {
        let goes_on = mass <= wanted;
        mass += things[i].mass;
        goes_on
    });
    points(things, heaviest)
}

/// The points of things that lie together, as closely as shows a few of them.
fn together(things: &[Thing]) -> Vec<Vec3> {
    let close = heaviest_group(things, FILLED);
    if counted(things, &close) >= FEW {
        return points(things, close);
    }
    let wide = heaviest_group(things, FILLED_THINLY);
    let more = counted(things, &wide) > counted(things, &close);
    points(things, if more { wide } else { close })
}

/// The group with the most mass, times the number of its pieces that count.
fn heaviest_group(things: &[Thing], share: f64) -> Vec<usize> {
    let worth = |group: &[usize]| {
        let mass: f64 = group.iter().map(|&i| things[i].mass).sum();
        mass * counted(things, group).min(MIDDLES) as f64
    };
    let middles = heaviest(things).into_iter().take(MIDDLES);
    let groups = middles.map(|i| group(things, i, share));
    // The first of equals.
    let best = groups.reduce(|best, next| match worth(&next) > worth(&best) {
        true => next,
        false => best,
    });
    best.unwrap_or_default()
}

/// A thing, however thin it is, and those around it that fill this share of a disc.
fn group(things: &[Thing], middle: usize, share: f64) -> Vec<usize> {
    let around = filled(things, things[middle].centre, share);
    if around.is_empty() {
        vec![middle]
    } else {
        around
    }
}

/// Number of these that a viewer counts as pieces.
fn counted(things: &[Thing], chosen: &[usize]) -> usize {
    let areas = || chosen.iter().map(|&i| things[i].area);
    let largest = areas().fold(0.0, f64::max);
    areas().filter(|&area| area >= COUNTS * largest).count()
}

/// The points of things that lie about a place, as many as can be shown so that [`FILLED`] holds.
fn about(things: &[Thing], place: Vec3) -> Vec<Vec3> {
    points(things, filled(things, place, FILLED))
}

/// The things within the widest disc about a place of which they fill this share.
fn filled(things: &[Thing], place: Vec3, share: f64) -> Vec<usize> {
    let reach = |thing: &Thing| {
        let distances = thing.points.iter().map(|p| p.distance(place));
        distances.fold(0.0, f32::max)
    };
    let mut by_reach: Vec<(f32, usize)> = things.iter().map(reach).zip(0..).collect();
    by_reach.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (mut kept, mut area) = (0, 0.0);
    for (number, &(radius, i)) in (1..).zip(&by_reach) {
        area += things[i].area;
        if area >= share * std::f64::consts::PI * f64::from(radius).powi(2) {
            kept = number;
        }
    }
    by_reach[..kept].iter().map(|&(_, i)| i).collect()
}

/// Things by their mass, the heaviest first.
fn heaviest(things: &[Thing]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..things.len()).collect();
    order.sort_by(|&a, &b| things[b].mass.total_cmp(&things[a].mass).then(a.cmp(&b)));
    order
}

fn points(things: &[Thing], chosen: impl IntoIterator<Item = usize>) -> Vec<Vec3> {
    let points = chosen.into_iter().flat_map(|i| &things[i].points);
    points.copied().collect()
}

/// The middle of the box about points.
fn middle(points: &[Vec3]) -> Vec3 {
    let points = || points.iter().copied();
    let low = points().fold(Vec3::INFINITY, Vec3::min);
    0.5 * (low + points().fold(Vec3::NEG_INFINITY, Vec3::max))
}

/// Looks so that these points fill the picture (4:3), from at least `nearest`, m.
pub(crate) fn view(seen: &[Vec3], ground: f32, look_from: Vec3, nearest: f32) -> View {
    let vertical_fov = 0.55_f32;
    let back = look_from.normalize();
    let right = Vec3::Y.cross(back).normalize_or(Vec3::X);
    let up = back.cross(right);
    let tangent = (0.5 * vertical_fov).tan();
    let low = seen
        .iter()
        .copied()
        .fold(Vec3::INFINITY, Vec3::min)
        .max(Vec3::new(f32::MIN, ground, f32::MIN));
    let high = seen.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    let mut target = 0.5 * (low + high);
    let mut distance = nearest;
    // Near points look large: the middle of the picture is not that of the points, and a few rounds find it.
    for _ in 0..6 {
        let across = |p: Vec3| {
            let d = p - target;
            Vec3::new(d.dot(right), d.dot(up), d.dot(back))
        };
        // Far enough for every point to lie within the picture, with a margin.
        let enough = |p: &Vec3| {
            let d = across(*p);
            MARGIN * (d.x.abs() / (4.0 / 3.0)).max(d.y.abs()) / tangent + d.z
        };
        distance = seen.iter().map(enough).fold(nearest, f32::max);
        let (mut least, mut most) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for &p in seen {
            let d = across(p);
            let depth = (distance - d.z).max(1e-3 * distance);
            for (k, place) in [d.x / depth, d.y / depth].into_iter().enumerate() {
                least[k] = least[k].min(place);
                most[k] = most[k].max(place);
            }
        }
        let middle = [0, 1].map(|k| 0.5 * distance * (least[k] + most[k]));
        if middle.iter().all(|m| m.is_finite()) {
            target += right * middle[0] + up * middle[1];
        }
    }
    View {
        eye: target + back * distance,
        target,
        up: Vec3::Y,
        vertical_fov,
    }
}
