//! Figs. 6, 9 and 10: cracks in a coarse bar and a coarse plate.

use std::collections::BTreeSet;
use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::{CrackTrace, ElementTrace, TetMesh, impact_traced};
use frangible::{Asset, Body, Contact, Fracture, FractureConfig, Material, Outcome, Striker};
use frangible_bake::Shape;
use serde_json::{Value, json};

use super::bodies::{baked, changed};
use super::slice::crossing;
use crate::Result;

/// Fig. 6: the order in which a crack takes the elements of a bar.
pub(super) fn propagation() -> Result<Value> {
    let broken = bar()?;
    let mesh = broken.asset.fracture();
    let crack = broken
        .trace
        .cracks
        .iter()
        .max_by_key(|elements| elements.len());
    let crack = crack.ok_or("no crack in the bar")?;
    let depths = depths(mesh, crack);
    let last = depths.iter().copied().filter(|d| *d < usize::MAX).max();
    let waves = (0..=last.unwrap_or(0)).map(|wave| depths.iter().filter(|d| **d == wave).count());
    let different: BTreeSet<u32> = crack.iter().map(|e| e.tet).collect();
    Ok(json!({
        "tets": mesh.tets.len(),
        "speed_m_s": broken.speed,
        "elements": crack.len(),
        "connected": depths.iter().all(|d| *d < usize::MAX),
        "pairs_in_order": depths.windows(2).filter(|w| w[0] <= w[1]).count(),
        "elements_by_wave": waves.collect::<Vec<_>>(),
        "crossed": crack.iter().filter(|e| !crossing(mesh, e).is_empty()).count(),
        "twice": crack.len() - different.len(),
    }))
}

/// Fig. 9: fragments of a plate from marked elements.
pub(super) fn labels() -> Result<Value> {
    let broken = plate()?;
    let mesh = broken.asset.fracture();
    let (trace, fracture) = (&broken.trace, &broken.fracture);
    let own = components(&broken);
    let fragments = fracture.fragments.iter().enumerate().map(|(i, fragment)| {
        let of = trace.fragment_of_node.iter().filter(|l| **l as usize == i);
        json!({
            "fragment": i + 1,
            "nodes": of.count(),
            "share": fragment.mass.volume / mesh.total_volume(),
        })
    });
    Ok(json!({
        "tets": mesh.tets.len(),
        "speed_m_s": broken.speed,
        "cracks": trace.cracks.len(),
        "fragments": fragments.collect::<Vec<_>>(),
        "sets": own.iter().collect::<BTreeSet<_>>().len(),
        "same_sets": same_partition(&own, &trace.fragment_of_node),
        "volume_error": fracture.report.volume_error,
    }))
}

/// Fig. 10: a crack's surface against the mesh that it cuts.
pub(super) fn surface() -> Result<Value> {
    let broken = bar()?;
    let (surface, nodes) = deviations(&broken);
    let mesh = broken.asset.fracture();
    Ok(json!({
        "tets": mesh.tets.len(),
        "edge_m": mesh.mean_edge(),
        "rms_of_surface_m": surface,
        "rms_of_nodes_m": nodes,
    }))
}

/// A break, and how its cracks ran.
struct Broken {
    asset: Arc<Asset>,
    fracture: Box<Fracture>,
    trace: CrackTrace,
    /// Speed of the ball, m/s.
    speed: f64,
}

/// The paper's model, but every piece counts, however small.
fn config() -> FractureConfig {
    let mut config = FractureConfig::as_in_the_paper();
    config.crumb_share = 0.0;
    config
}

/// Slowest and fastest ball that is tried, m/s, and the factor between one and the next.
const SPEEDS: [f64; 3] = [2.0, 30.0, 1.04];

/// Seeds that are tried at each speed.
const SEEDS: u64 = 6;

/// Modes of these bodies: their blows are long against their higher ones.
const MODES: usize = 30;

/// A bar of 160 × 60 × 50 mm, hit in its middle so that one crack parts it.
fn bar() -> Result<Broken> {
    let asset = baked(
        "bar",
        Shape::block([0.16, 0.06, 0.05]),
        "porcelain",
        1800.0,
        MODES,
    )?;
    let top = Vec3::new(0.0, 0.0, 0.025);
    search(&asset, top, |f, trace| {
        f.fragments.len() == 2 && trace.cracks.len() == 1
    })
    .or_else(|_| search(&asset, top, |f, _| f.fragments.len() == 2))
}

/// A plate of 120 × 90 × 8 mm, a single layer of tetrahedra, hit in its middle so that a few cracks part it.
fn plate() -> Result<Broken> {
    let asset = baked(
        "plate",
        Shape::plate(0.12, 0.09, 0.008),
        "porcelain",
        900.0,
        MODES,
    )?;
    // Few weak points, so that cracks start where there is one and not all under the blow.
    let asset = changed(&asset, |m| m.weak_point_density = 1e6);
    let top = Vec3::new(0.02, 0.012, 0.004);
    search(&asset, top, |fracture, trace| {
        (3..=6).contains(&fracture.fragments.len())
            && trace.cracks.len() <= 5
            && smallest(fracture) > 0.05
    })
    .or_else(|_| search(&asset, top, |f, _| f.fragments.len() >= 3))
}

/// Share of the smallest piece.
fn smallest(fracture: &Fracture) -> f64 {
    let volumes = || fracture.fragments.iter().map(|f| f.mass.volume);
    volumes().fold(f64::INFINITY, f64::min) / volumes().sum::<f64>()
}

/// The gentlest blow of a steel ball whose outcome is wanted.
fn search(
    asset: &Arc<Asset>,
    point: Vec3,
    wanted: impl Fn(&Fracture, &CrackTrace) -> bool,
) -> Result<Broken> {
    let steel = Material::preset("steel")?;
    let kind = frangible::Breakable::uniform(Arc::clone(asset))?;
    let [slowest, fastest, factor] = SPEEDS;
    let mut speed = slowest;
    while speed < fastest {
        let contact: Contact = Contact::collision(
            asset,
            point,
            Vec3::NEG_Z,
            speed,
            Striker::ball(&steel, 0.2, 0.018),
        );
        for seed in 1..=SEEDS {
            let body: Body = kind.body(seed);
            let (outcome, trace) = impact_traced(&body, std::slice::from_ref(&contact), &config())?;
            if let Outcome::Broke(fracture) = outcome
                && wanted(&fracture, &trace)
            {
                return Ok(Broken {
                    asset: Arc::clone(asset),
                    fracture,
                    trace,
                    speed,
                });
            }
        }
        speed *= factor;
    }
    Err("no blow parts the coarse body as the figure needs it".into())
}

/// Distance of each element from the first, in steps across faces through elements that joined before it.
fn depths(mesh: &TetMesh, crack: &[ElementTrace]) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::with_capacity(crack.len());
    for (i, element) in crack.iter().enumerate() {
        let near = mesh.neighbours[element.tet as usize];
        let from = crack[..i]
            .iter()
            .zip(&depths)
            .filter(|(e, _)| near.contains(&e.tet));
        let nearest = from.map(|(_, d)| *d).min();
        depths.push(if i == 0 {
            0
        } else {
            nearest.map_or(usize::MAX, |d| d.saturating_add(1))
        });
    }
    depths
}

/// The smallest node of each node's set: nodes connected over mesh edges that no crack cuts.
fn components(broken: &Broken) -> Vec<u32> {
    let mesh = broken.asset.fracture();
    let mut cut = BTreeSet::new();
    for element in broken.trace.cracks.iter().flatten() {
        let nodes = mesh.tets[element.tet as usize];
        for (i, j) in pairs() {
            if (element.values[i] < 0.0) != (element.values[j] < 0.0) {
                cut.insert((nodes[i].min(nodes[j]), nodes[i].max(nodes[j])));
            }
        }
    }
    let mut least: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    // Passes until nothing changes: slow, and plainly right.
    loop {
        let mut changed = false;
        for tet in &mesh.tets {
            for (i, j) in pairs() {
                let (a, b) = (tet[i].min(tet[j]), tet[i].max(tet[j]));
                let low = least[a as usize].min(least[b as usize]);
                if !cut.contains(&(a, b)) && least[a as usize] != least[b as usize] {
                    least[a as usize] = low;
                    least[b as usize] = low;
                    changed = true;
                }
            }
        }
        if !changed {
            return least;
        }
    }
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)))
}

/// Returns true if two labellings divide the nodes alike.
fn same_partition(a: &[u32], b: &[u32]) -> bool {
    let both: BTreeSet<(u32, u32)> = a.iter().copied().zip(b.iter().copied()).collect();
    let labels = |list: &[u32]| list.iter().copied().collect::<BTreeSet<_>>().len();
    a.len() == b.len() && both.len() == labels(a) && both.len() == labels(b)
}

/// Root mean square distances from the plane of the longest crack, m: of its own points, and of the nodes of its elements.
fn deviations(broken: &Broken) -> (f64, f64) {
    let mesh = broken.asset.fracture();
    let Some(crack) = broken.trace.cracks.iter().max_by_key(|c| c.len()) else {
        return (0.0, 0.0);
    };
    let points: Vec<DVec3> = crack
        .iter()
        .flat_map(|e| crossing(mesh, e))
        .flatten()
        .map(|p| p.as_dvec3())
        .collect();
    let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    // The mean normal of its triangles, all turned to one side.
    let mut normal = DVec3::ZERO;
    for [a, b, c] in crack.iter().flat_map(|e| crossing(mesh, e)) {
        let area = (b - a).cross(c - a).as_dvec3();
        normal += if area.dot(normal) < 0.0 { -area } else { area };
    }
    let normal = normal.normalize_or(DVec3::X);
    let rms = |points: &mut dyn Iterator<Item = DVec3>| {
        let (mut sum, mut count) = (0.0, 0.0);
        for p in points {
            sum += (p - centre).dot(normal).powi(2);
            count += 1.0;
        }
        (sum / f64::max(count, 1.0)).sqrt()
    };
    let mut nodes = crack
        .iter()
        .flat_map(|e| mesh.corners(e.tet as usize))
        .map(|p| p.as_dvec3());
    (rms(&mut points.iter().copied()), rms(&mut nodes))
}
