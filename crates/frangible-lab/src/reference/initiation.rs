//! Algorithm 1: the deformation wave, step by step, and where it tears the body `[G12 §4.4]`.

use frangible::glam::DVec3;
use frangible::{Body, Contact};

use crate::reference::body::{Field, ReferenceError, Solid};
use crate::reference::contact::Force;
use crate::reference::fragments::fragments;
use crate::reference::modes::amplitudes;
use crate::reference::options::{Initiation, Options};
use crate::reference::propagation::{Crack, propagate};
use crate::reference::skin::Look;
use crate::reference::stress::principal;
use crate::reference::surface::{Surface, area};

/// Tests of strength this close to it are kept.
const NEAR: f64 = 0.02;

/// Effect of an impact on a body.
#[derive(Clone, Debug, Default)]
pub struct Break {
    /// t_d, s.
    pub duration: f64,
    /// Δt, s.
    pub time_step: f64,
    /// Time steps.
    pub steps: usize,
    /// Relative change that would alter their number.
    pub steps_margin: f64,
    /// Largest principal stress met where it is tested, Pa.
    pub peak_stress: f64,
    /// Cracks in the order they started.
    pub cracks: Vec<Crack>,
    /// Fragment of each node of the fracture mesh, numbered by first node; one fragment when it held.
    pub fragment_of_node: Vec<u32>,
    /// Tests of strength that started a crack or came near it, in order.
    pub starts: Vec<StartTest>,
}

/// A test of strength.
#[derive(Clone, Copy, Debug)]
pub struct StartTest {
    /// Time step, from 0.
    pub step: usize,
    /// Time at which the crack starts, in steps: that step's end, or between the two as the stress passes R_c.
    pub time: f64,
    /// Change of σ₁ / R_c since the step before; infinite where the time does not hang on it.
    pub rise: f64,
    /// Number of the tetrahedron.
    pub tet: u32,
    /// σ₁ / R_c.
    pub stress: f64,
    /// Relative change, of the stress or of an energy, that would have decided otherwise.
    pub margin: f64,
}

/// Algorithm 1, from line 2: the modes are the asset's.
///
/// # Errors
/// [`Field::Linear`] with an asset whose modes do not live on its fracture mesh.
pub fn fracture(
    body: &Body,
    contacts: &[Contact],
    field: Field,
    options: &Options,
) -> Result<Break, ReferenceError> {
    run(body, contacts, field, options, usize::MAX)
}

/// Runs [`fracture`] until a first crack has run: later cracks may be another model's.
///
/// # Errors
/// The same as [`fracture`].
pub fn first_crack(
    body: &Body,
    contacts: &[Contact],
    field: Field,
    options: &Options,
) -> Result<Break, ReferenceError> {
    run(body, contacts, field, options, 1)
}

fn run(
    body: &Body,
    contacts: &[Contact],
    field: Field,
    options: &Options,
    most_cracks: usize,
) -> Result<Break, ReferenceError> {
    let mut solid = Solid::new(body.asset(), field)?;
    solid.strain = options.strain;
    let mut result = Break::default();
    let Some(force) = Force::new(&solid, contacts, options) else {
        result.fragment_of_node = vec![0; solid.nodes.len()];
        return Ok(result);
    };
    result.duration = force.duration; // line 5
    result.time_step = force.time_step; // line 6
    result.steps = force.steps;
    result.steps_margin = force.margin;
    let look = Look::new(&solid, body, options.surface_flaws, &force.pressed);
    let mut marked = vec![None; body.asset().fracture().tets.len()];
    let mut before = vec![DVec3::ZERO; solid.displacements(&amplitudes(&solid, &force, 1)).len()];
    for step in 0..force.steps {
        // lines 7, 8
        let q = amplitudes(&solid, &force, step + 1); // line 9
        let u = solid.displacements(&q); // line 10
        let starts = match options.initiation {
            // line 11
            Initiation::WeakElements => {
                let before = options.between_steps.then_some(&before[..]);
                weak_elements(&solid, &look, body, &u, before, step, &marked, &mut result)
            }
            Initiation::NearestWeak => nearest_weak(&solid, &look, body, &u, &marked, &mut result),
        };
        if result.cracks.len() >= most_cracks {
            break;
        }
        for e in starts {
            if marked[e].is_none() && result.cracks.len() < most_cracks {
                start(
                    &solid,
                    &look,
                    body,
                    &u,
                    e,
                    step,
                    options,
                    &mut marked,
                    &mut result,
                ); // line 12
            }
        }
        before = u;
    }
    result.fragment_of_node = fragments(&solid, &result.cracks, options.marks);
    Ok(result)
}

/// Weak elements above R_c, by the time they pass it where a step before is given, by falling stress, then by number.
fn weak_elements(
    solid: &Solid,
    look: &Look,
    body: &Body,
    u: &[DVec3],
    before: Option<&[DVec3]>,
    step: usize,
    marked: &[Option<u32>],
    result: &mut Break,
) -> Vec<usize> {
    let mut above = Vec::new();
    for &e in body.weak_tets() {
        if marked[e as usize].is_some() {
            continue;
        }
        let sigma = largest_stress(solid, look, u, e as usize);
        result.peak_stress = result.peak_stress.max(sigma);
        let stress = sigma / solid.material.strength;
        if stress <= 1.0 - NEAR {
            continue;
        }
        let (mut time, mut rise) = (step as f64 + 1.0, f64::INFINITY);
        if let Some(before) = before {
            let was = largest_stress(solid, look, before, e as usize) / solid.material.strength;
            rise = stress - was;
            time = step as f64;
            if was < 1.0 && rise > 0.0 {
                time += ((1.0 - was) / rise).min(1.0);
            }
        }
        if stress > 1.0 {
            above.push((time, stress, e as usize));
        }
        result.starts.push(StartTest {
            step,
            time,
            rise,
            tet: e,
            stress,
            margin: (stress - 1.0).abs(),
        });
    }
    above.sort_by(|a, b| {
        a.0.total_cmp(&b.0)
            .then(b.1.total_cmp(&a.1))
            .then(a.2.cmp(&b.2))
    });
    above.into_iter().map(|(.., e)| e).collect()
}

/// "at the location of the weak element which is the closest to the element that has the highest principal stress".
fn nearest_weak(
    solid: &Solid,
    look: &Look,
    body: &Body,
    u: &[DVec3],
    marked: &[Option<u32>],
    result: &mut Break,
) -> Vec<usize> {
    let mut highest = (f64::NEG_INFINITY, 0);
    for e in (0..marked.len()).filter(|&e| marked[e].is_none()) {
        let sigma = largest_stress(solid, look, u, e);
        if sigma > highest.0 {
            highest = (sigma, e);
        }
    }
    result.peak_stress = result.peak_stress.max(highest.0);
    if highest.0 <= solid.material.strength {
        return Vec::new();
    }
    let at = solid.centres[highest.1];
    let mut nearest = (f64::INFINITY, None);
    for &e in body.weak_tets() {
        let distance = solid.centres[e as usize].distance(at);
        if marked[e as usize].is_none() && distance < nearest.0 {
            nearest = (distance, Some(e as usize));
        }
    }
    nearest.1.into_iter().collect()
}

fn largest_stress(solid: &Solid, look: &Look, u: &[DVec3], e: usize) -> f64 {
    let (sigma, _) = look.stress(solid, u, e);
    principal(&sigma).0[0]
}

fn start(
    solid: &Solid,
    look: &Look,
    body: &Body,
    u: &[DVec3],
    e: usize,
    step: usize,
    options: &Options,
    marked: &mut [Option<u32>],
    result: &mut Break,
) {
    let (sigma, _) = look.stress(solid, u, e);
    let material = solid.material;
    let surface = Surface::new(solid.centres[e], &sigma, material, body.seed(), e);
    let x = solid.corners(e);
    let values = x.map(|p| surface.s(p));
    // A wave of the noise may carry the surface past the corners: the paper does not treat that case.
    let missed = area(x, values) <= 0.0;
    let mut margin = f64::INFINITY;
    if missed {
        let margins = (0..4).map(|k| surface.margin_of(x[k], values[k]));
        margin = margins.fold(margin, f64::min);
    }
    for test in &mut result.starts {
        if test.step == step && test.tet == e as u32 {
            test.margin = test.margin.min(margin);
        }
    }
    if missed {
        return;
    }
    let id = result.cracks.len() as u32;
    let test = options.energy_test;
    let mut crack = propagate(solid, u, &surface, e, id, test, marked);
    crack.step = step;
    let test = result.starts.iter().rev().find(|t| t.tet == e as u32);
    crack.time = test.map_or(step as f64 + 1.0, |t| t.time);
    result.cracks.push(crack);
}
