//! Bodies with many branches: how far the largest stress of a blow is off when only the lowest modes are followed.
//!
//! `cargo run --release -p frangible-bake --example branches [KEPT [BODY [FOLLOWED …]]]` prints the tables of `docs/branches.md`; all KEPT modes, 400
//! unless told, are the truth.

use frangible::glam::{Quat, Vec3};
use frangible::internals::blow::Blow;
use frangible::internals::contact::modal_load;
use frangible::internals::stress::{Symmetric3, largest_eigenvalue, largest_eigenvalue_bound};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, Baked, Shape, bake_with, stress_rows};

type Failure = Box<dyn std::error::Error>;

/// Numbers of modes that are followed.
const FOLLOWED: [usize; 5] = [20, 50, 100, 200, 400];

/// Radii of the region about the contact and of that about the root of the branch, m.
const NEAR: f32 = 0.02;
const ROOT: f32 = 0.025;

/// Places looked at: in each of those regions, and all over the surface.
const PLACES: usize = 250;

/// Most times that are looked at.
const TIMES: usize = 1500;

/// Place of a hit in the frame of the shape, m, direction of its force, and root of the struck branch.
struct Hit {
    name: &'static str,
    at: Vec3,
    toward: Vec3,
    root: Vec3,
}

struct Subject {
    shape: &'static str,
    material: &'static str,
    hits: [Hit; 4],
}

fn main() -> Result<(), Failure> {
    let mut words = std::env::args().skip(1);
    let kept = words.next().map_or(Ok(400), |word| word.parse())?;
    let only = words.next();
    let counts: Vec<usize> = words.map(|word| word.parse()).collect::<Result<_, _>>()?;
    let counts = match counts.is_empty() {
        true => FOLLOWED.to_vec(),
        false => counts,
    };
    let wanted = |s: &Subject| only.as_deref().is_none_or(|name| name == s.shape);
    for subject in subjects().iter().filter(|s| wanted(s)) {
        measure(subject, kept, &counts)?;
    }
    Ok(())
}

fn measure(subject: &Subject, kept: usize, counts: &[usize]) -> Result<(), Failure> {
    let mut material = Material::preset(subject.material)?;
    // Stress is looked at where we say.
    material.weak_point_density = 1.0;
    let shape = Shape::ready(subject.shape).ok_or("no such shape")?;
    let spec = BakeSpec {
        modes: kept,
        ..BakeSpec::new(subject.shape, shape, material)
    };
    let Baked { asset, report } = bake_with(&spec, |_| {})?;
    println!(
        "\n{}: {:.2} kg, {} tetrahedra, {} elements, {} modes from {:.0} to {:.0} Hz, {} followed by choice",
        subject.shape,
        report.mass,
        asset.fracture().tets.len(),
        asset.analysis().elements.len(),
        kept,
        asset.modes().frequency(0),
        asset.modes().frequency(kept - 1),
        report.followed
    );
    let frequencies: Vec<String> = (0..kept)
        .map(|i| format!("{:.0}", asset.modes().frequency(i)))
        .collect();
    println!("Hz: {}", frequencies.join(" "));
    println!(
        "| hit | ball | modes | anywhere | contact | root | without: anywhere | contact | root |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    let mut counts: Vec<usize> = counts.iter().copied().filter(|n| *n < kept).collect();
    counts.push(report.followed.min(kept - 1));
    let mut worst = vec![[0.0_f64; 6]; counts.len()];
    for hit in &subject.hits {
        let (at, root) = (
            hit.at - report.centre.as_vec3(),
            hit.root - report.centre.as_vec3(),
        );
        for (ball, striker, speed) in balls()? {
            let contact = Contact::strike(at, hit.toward.normalize(), speed, striker);
            let body = Breakable::uniform(asset.clone())?.body(1);
            let touched = modal_load(&body, [&contact]).touches[0].contact.point;
            let places = places(&asset, touched, root);
            let truth = peaks(&asset, &contact, kept, true, &places)?;
            println!(
                "| {} | {ball} | all | {:.1} MPa | {:.1} | {:.1} | {:.0} N, {:.0} µs |",
                hit.name,
                1e-6 * truth.most[0],
                1e-6 * truth.most[1],
                1e-6 * truth.most[2],
                truth.force,
                1e6 * truth.duration
            );
            for (&count, worst) in counts.iter().zip(&mut worst) {
                let mut off = [0.0; 6];
                for (k, residual) in [true, false].into_iter().enumerate() {
                    let found = peaks(&asset, &contact, count, residual, &places)?;
                    for r in 0..3 {
                        off[3 * k + r] = 100.0 * (found.most[r] / truth.most[r] - 1.0);
                    }
                }
                for (w, o) in worst.iter_mut().zip(off) {
                    *w = w.max(o.abs());
                }
                let cells: Vec<String> = off.iter().map(|o| format!("{o:+.1} %")).collect();
                println!(
                    "| {} | {ball} | {count} | {} |",
                    hit.name,
                    cells.join(" | ")
                );
            }
        }
    }
    for (count, worst) in counts.iter().zip(&worst) {
        let cells: Vec<String> = worst.iter().map(|o| format!("{o:.1} %")).collect();
        println!("| worst | both | {count} | {} |", cells.join(" | "));
    }
    Ok(())
}

/// A hard ball and a soft one: name, striker, speed in m/s.
fn balls() -> Result<[(&'static str, Striker, f32); 2], Failure> {
    let (steel, wood) = (Material::preset("steel")?, Material::preset("wood")?);
    Ok([
        ("steel", Striker::ball(&steel, 0.03, 0.0097), 4.0),
        ("wood", Striker::ball(&wood, 0.25, 0.045), 2.0),
    ])
}

/// Results of a blow: largest tension anywhere, at the contact and at the root, Pa; largest force, N; duration, s.
struct Found {
    most: [f64; 3],
    force: f64,
    duration: f64,
}

/// A place: its stress per amplitude of each mode, and whether it lies at the contact and at the root.
struct Place {
    rows: [Vec<f32>; 6],
    within: [bool; 3],
}

fn places(asset: &Asset, contact: Vec3, root: Vec3) -> Vec<Place> {
    let mesh = asset.fracture();
    let tets: Vec<u32> = {
        let mut all = asset.surface().tets.clone();
        all.sort_unstable();
        all.dedup();
        all
    };
    let near = |tet: u32, place: Vec3, reach| mesh.centroid(tet as usize).distance(place) < reach;
    let mut taken: Vec<u32> = Vec::new();
    let mut take = |of: &dyn Fn(u32) -> bool| {
        let some: Vec<u32> = tets.iter().copied().filter(|&t| of(t)).collect();
        taken.extend(some.iter().step_by(some.len().div_ceil(PLACES).max(1)));
    };
    take(&|t| near(t, contact, NEAR));
    take(&|t| near(t, root, ROOT));
    take(&|_| true);
    taken.sort_unstable();
    taken.dedup();
    let place = |tet: u32| Place {
        rows: stress_rows(asset, tet as usize),
        within: [true, near(tet, contact, NEAR), near(tet, root, ROOT)],
    };
    taken.into_iter().map(place).collect()
}

/// The blow with so many modes followed, the rest static or left out.
fn peaks(
    asset: &Asset,
    contact: &Contact,
    followed: usize,
    residual: bool,
    places: &[Place],
) -> Result<Found, Failure> {
    let mut asset = asset.clone();
    let kept = asset.modes().count();
    asset.parts_mut().modes.residual_modes = kept - followed;
    let body = Breakable::uniform(asset)?.body(1);
    let mut config = FractureConfig::default();
    (config.residual, config.near_field) = (residual, None);
    let blow = Blow::new(&body, std::slice::from_ref(contact), &config)?.ok_or("no blow")?;
    let report = blow.reports()[0].clone();
    let load = modal_load(&body, [contact]);
    let modes = body.asset().modes();
    let still: Vec<f32> = (followed..kept)
        .map(|i| match residual {
            true => (load.touches[0].modal_shape[i] / modes.eigenvalues[i]) as f32,
            false => 0.0,
        })
        .collect();
    let motion = blow.motion();
    let contact_steps = report.force.len();
    let stride = (motion.steps() / TIMES).max(1);
    let mut most = [0.0_f32; 3];
    let dot = |a: &[f32], b: &[f32]| -> f32 {
        let mut lanes = [0.0_f32; 8];
        for (a, b) in a.chunks_exact(8).zip(b.chunks_exact(8)) {
            for (lane, (a, b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
                *lane += a * b;
            }
        }
        let rest = a.len() / 8 * 8;
        let tail: f32 = a[rest..].iter().zip(&b[rest..]).map(|(a, b)| a * b).sum();
        lanes.iter().sum::<f32>() + tail
    };
    for place in places {
        let following: [f32; 6] = std::array::from_fn(|c| dot(&place.rows[c][followed..], &still));
        let followed_rows = place.rows.each_ref().map(|row| &row[..followed]);
        let mut peak = 0.0_f32;
        for step in (0..motion.steps()).filter(|s| *s < contact_steps || s % stride == 0) {
            let (q, force) = (
                motion.at(step),
                report.force.get(step).copied().unwrap_or(0.0),
            );
            let [xx, yy, zz, xy, yz, zx] =
                std::array::from_fn(|c| dot(followed_rows[c], q) + following[c] * force);
            let stress = Symmetric3 {
                diagonal: [xx, yy, zz],
                off: [xy, yz, zx],
            };
            if largest_eigenvalue_bound(&stress) > peak {
                peak = peak.max(largest_eigenvalue(&stress));
            }
        }
        for (most, within) in most.iter_mut().zip(place.within) {
            if within {
                *most = most.max(peak);
            }
        }
    }
    Ok(Found {
        most: most.map(f64::from),
        force: report.peak_force,
        duration: report.duration,
    })
}

/// A hit of an arm of the chandelier or the candelabrum, `turned` about z.
fn arm(name: &'static str, turned: f32, [at, toward, root]: [Vec3; 3]) -> Hit {
    let turn = Quat::from_rotation_z(turned.to_radians());
    Hit {
        name,
        at: turn * at,
        toward: turn * toward,
        root: turn * root,
    }
}

fn subjects() -> [Subject; 3] {
    let v = Vec3::new;
    let root = v(0.040, 0.0, 0.072);
    let inner = v(0.020, 0.0, 0.174);
    let outer = v(0.030, 0.0, 0.116);
    [
        Subject {
            shape: "chandelier",
            material: "glass",
            hits: [
                arm(
                    "cup, from above",
                    0.0,
                    [v(0.150, 0.0, 0.170), -Vec3::Z, root],
                ),
                arm(
                    "cup, sideways",
                    120.0,
                    [v(0.150, 0.0095, 0.155), -Vec3::Y, root],
                ),
                arm(
                    "cup, inwards",
                    210.0,
                    [v(0.159, 0.0, 0.156), -Vec3::X, root],
                ),
                arm("bowl", 15.0, [v(0.035, 0.0, 0.085), -Vec3::X, root]),
            ],
        },
        Subject {
            shape: "candelabrum",
            material: "porcelain",
            hits: [
                arm(
                    "outer cup, from above",
                    0.0,
                    [v(0.131, 0.0, 0.279), -Vec3::Z, outer],
                ),
                arm(
                    "inner cup, sideways",
                    180.0,
                    [v(0.075, 0.0095, 0.290), -Vec3::Y, inner],
                ),
                arm(
                    "outer cup, inwards",
                    180.0,
                    [v(0.141, 0.0, 0.266), -Vec3::X, outer],
                ),
                arm("stem", 0.0, [v(0.010, 0.0, 0.148), -Vec3::X, outer]),
            ],
        },
        coral(),
    ]
}

fn coral() -> Subject {
    let v = Vec3::new;
    let hit = |name, at, toward, root| Hit {
        name,
        at,
        toward,
        root,
    };
    let roots = [
        v(0.0, -0.0127, 0.0657),
        v(0.0092, 0.0027, 0.0659),
        v(-0.0085, 0.0023, 0.0665),
    ];
    Subject {
        shape: "coral",
        material: "marble",
        hits: [
            hit(
                "tip, from above",
                v(0.0905, 0.003, 0.163),
                -Vec3::Z,
                roots[1],
            ),
            hit(
                "tip, sideways",
                v(-0.056, -0.0931, 0.1226),
                v(0.73, -0.68, 0.0),
                roots[0],
            ),
            hit(
                "tip, along it",
                v(-0.0538, 0.0902, 0.1322),
                v(0.29, -0.95, -0.09),
                roots[2],
            ),
            hit("trunk", v(0.013, 0.0, 0.025), -Vec3::X, roots[1]),
        ],
    }
}
