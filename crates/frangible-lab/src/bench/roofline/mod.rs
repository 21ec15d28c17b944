//! Speed of the initiation as a share of what the machine can do: operations and bytes of each stage against measured peaks.
//!
//! A stage can be no faster than its operations at the peak of arithmetic, nor than its bytes at the rate of the memory that holds
//! them: the *roofline*. Reached is the longer of the two over the time it takes.

mod counts;
mod peak;

use std::time::{Duration, Instant};

use frangible::internals::stress::{DisplacementBatch, Law};
use frangible::internals::{Drive, Stage, Vibration};
use frangible::{Body, Breakable, FractureConfig};
use serde_json::{Value, json};

use self::peak::Arithmetic;
use super::cache::Cache;
use super::subjects::{MODES, Subject, chosen};
use crate::{Error, Result};

/// Bodies that are measured where none is named.
const BODIES: [&str; 3] = ["glass", "slab-moderate", "rabbit"];

/// Sizes of memory whose rate is listed, bytes: a half of a usual second-level cache, a share of the third-level cache, main memory.
const MEMORY: [usize; 3] = [1 << 19, 1 << 23, 1 << 28];
/// Factor of the strengths, so that nothing breaks and every weak point is analysed to the end.
const TOUGHER: f64 = 1e6;
/// The best of so many runs counts: others may use the machine.
const RUNS: usize = 60;
/// Number of batches for which displacements and stresses are computed: a run is over before the next one's turn.
const BATCHES: usize = 2;
/// Time for which a body's stresses are computed again and again, each time after a pause.
const BUDGET: Duration = Duration::from_secs(2);
const NAP: Duration = Duration::from_millis(2);

/// A stage beside its roofline. `need`: operations and bytes; `roof`: operations a second, and size of the memory that holds the bytes.
fn reached(stage: &str, need: [f64; 2], roof: (f64, usize), seconds: f64) -> Value {
    let bandwidth = peak::read(roof.1);
    json!({
        "stage": stage,
        "operations": need[0],
        "bytes": need[1],
        "working_set_bytes": roof.1,
        "peak_per_s": roof.0,
        "bandwidth_bytes_per_s": bandwidth,
        "seconds": seconds,
        "share": share(need, [roof.0, bandwidth], seconds),
    })
}

/// Share of the roofline that is reached: the longer of the times that arithmetic and memory allow, over the measured time.
fn share(need: [f64; 2], rates: [f64; 2], seconds: f64) -> f64 {
    (need[0] / rates[0]).max(need[1] / rates[1]) / seconds
}

/// Measures the machine, then bodies in the paper's model, every weak point at every time step.
///
/// # Errors
/// A name of no body of Table 1; an error of the bake or of the impact.
pub fn measure(names: &[String], cache: &Cache) -> Result<Value> {
    let names = match names {
        [] => BODIES.map(String::from).to_vec(),
        names => names.to_vec(),
    };
    let arithmetic = Arithmetic::measure();
    let bodies = chosen(&names)?.into_iter();
    let bodies = bodies.map(|subject| of_body(subject, cache, &arithmetic));
    let bodies: Vec<Value> = bodies.collect::<Result<_>>()?;
    let reading = MEMORY.map(|bytes| json!({ "bytes": bytes, "per_s": peak::read(bytes) }));
    Ok(json!({
        "vector": arithmetic.lanes,
        "arithmetic": [
            { "number": "f32", "per_s": arithmetic.separate },
            { "number": "f64", "per_s": arithmetic.double },
        ],
        "reading": reading,
        "bodies": bodies,
    }))
}

fn of_body(subject: &Subject, cache: &Cache, arithmetic: &Arithmetic) -> Result<Value> {
    let geometry = || subject.geometry();
    let baked = cache.body(subject.file(), MODES, subject.material, geometry)?;
    let contact = subject.contact(&baked.asset, subject.blow.speed_ours)?;
    let mut asset = baked.asset;
    asset.parts_mut().material.strength *= TOUGHER;
    let body = Breakable::uniform(asset)?.body(1);
    // Ours reads rows of its own for most bodies; in the paper's model all stress comes from displacements.
    let mut config = FractureConfig::as_in_the_paper();
    config.culling = false;
    let whole = vibration(&body, &contact, &config)?;
    let mut vibration = whole.clone();
    let all_steps = whole.report.time_steps;
    let steps = all_steps.min(BATCHES * DisplacementBatch::STRIDE);
    if let Drive::Pulse { pulse, .. } = &mut vibration.drive {
        pulse.total_steps = steps;
    }
    let work = Work::of(&body, &vibration, &config);
    let product = displacement_time(&body, &vibration);
    // Some nodes belong to no weak point's element, and the stage leaves them out.
    let needed = product * work.nodes[0] as f64 / work.nodes[1] as f64;
    let stresses = stress_time(&body, &vibration, &config) - needed;
    let batches = steps.div_ceil(DisplacementBatch::STRIDE) as f64;
    let (modes, steps) = (work.modes, all_steps);
    let all = work.nodes[1];
    let shapes = 12 * modes * all;
    let fields = counts::NODE * all + 10 * 8 * body.asset().analysis().elements.len();
    let response = shortest(|| {
        std::hint::black_box(whole.motion(&body));
    });
    let (nodes, points) = (
        batches * all as f64,
        work.points.iter().sum::<usize>() as f64,
    );
    let needs = [
        [
            counts::response(modes, steps),
            counts::response_bytes(modes, steps),
        ],
        [
            nodes * counts::displacement(modes),
            nodes * counts::displacement_bytes(modes),
        ],
        [
            batches * work.operations,
            batches * points * counts::weak_point_bytes(),
        ],
    ];
    let f32s = arithmetic.separate;
    let stages = [
        reached(
            "response of the modes",
            needs[0],
            (arithmetic.double, 4 * modes * steps),
            response,
        ),
        reached("displacements", needs[1], (f32s, shapes), product),
        reached(
            "gradients, stresses, bounds",
            needs[2],
            (f32s, fields),
            stresses,
        ),
    ];
    // Nodes: those whose displacements are needed, and all; weak points: inside, beside a free surface, at an edge.
    Ok(json!({
        "body": subject.name,
        "steps": steps,
        "modes": modes,
        "nodes": work.nodes,
        "points": work.points,
        "stages": stages,
    }))
}

/// Work of an analysis of every weak point.
struct Work {
    modes: usize,
    nodes: [usize; 2],
    points: [usize; 3],
    /// Operations of gradients and stresses, at a batch.
    operations: f64,
}

impl Work {
    fn of(body: &Body, vibration: &Vibration, config: &FractureConfig) -> Self {
        let analysis = body.asset().analysis();
        let mut needed = vec![false; analysis.nodes.len()];
        let (mut points, mut operations) = ([0; 3], 0.0);
        for &tet in body.weak_tets() {
            let (point, law) = body.weak_place(tet, config, &vibration.pressed);
            for &node in &analysis.elements[point.element as usize] {
                needed[node as usize] = true;
            }
            operations += counts::weak_point(law);
            points[match law {
                Law::Solid => 0,
                Law::Free(_) => 1,
                Law::Edge(_) => 2,
            }] += 1;
        }
        Self {
            modes: body.asset().modes().count(),
            nodes: [needed.iter().filter(|&&n| n).count(), needed.len()],
            points,
            operations,
        }
    }
}

fn vibration(
    body: &Body,
    contact: &frangible::Contact,
    config: &FractureConfig,
) -> Result<Vibration> {
    match Vibration::begin(body, std::slice::from_ref(contact), config)? {
        Stage::Vibrates(vibration) => Ok(vibration),
        Stage::Held(_) => Err(Error::from(
            "a blow of Table 1 is refused by its impulse; change its speed in subjects.rs",
        )),
    }
}

/// u = Φ q at all nodes and steps, s.
fn displacement_time(body: &Body, vibration: &Vibration) -> f64 {
    let asset = body.asset();
    let motion = vibration.motion(body);
    shortest(|| {
        let mut batch = DisplacementBatch::new(asset);
        for step in (0..motion.steps()).step_by(DisplacementBatch::STRIDE) {
            batch.seek(&motion, step);
            batch.fill(asset);
            std::hint::black_box(&batch);
        }
    })
}

/// Displacements, gradients and stresses as the impact itself times them, s.
fn stress_time(body: &Body, vibration: &Vibration, config: &FractureConfig) -> f64 {
    let (clock, mut shortest) = (Instant::now(), f64::INFINITY);
    while clock.elapsed() < BUDGET {
        // A thread that has just slept is not stopped soon for others.
        std::thread::sleep(NAP);
        let outcome = vibration.clone().end(body, config, 0);
        shortest = shortest.min(outcome.report().timings.stress);
    }
    shortest
}

fn shortest(mut run: impl FnMut()) -> f64 {
    let times = (0..RUNS).map(|_| {
        let clock = Instant::now();
        run();
        clock.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::share;

    #[test]
    fn the_longer_of_the_two_is_the_roof() {
        assert_eq!(share([8e9, 1e9], [8e9, 5e9], 4.0), 0.25);
        assert_eq!(share([8e9, 10e9], [8e9, 5e9], 4.0), 0.5);
    }
}
