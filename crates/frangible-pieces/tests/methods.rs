//! The ways to find how a piece vibrates, on pieces whose answer is known.

mod common;

use std::sync::Arc;

use common::{breakable, frequencies, modes, whole};
use faer::Mat;
use faer::linalg::solvers::Solve as _;
use frangible::glam::Vec3;
use frangible::piece::{Response, Statics};
use frangible::stress::ShapeWeights;
use frangible::{
    Body, Contact, Elastic, FractureConfig, Material, Outcome, Portion, Striker, impact,
};
use frangible_bake::Shape;
use frangible_pieces::{ProxyLibrary, parent_modes, quasi_static, reanalysis};

/// Sides of the bar, m.
const BAR: [f64; 3] = [0.2, 0.03, 0.02];

fn bar() -> Body {
    breakable(Shape::block(BAR), "porcelain", 6_000.0, 30).body(1)
}

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    for (f, e) in found.iter().zip(expected) {
        let error = f / e - 1.0;
        assert!(
            error.abs() < tolerance,
            "{what}: {found:?} and {expected:?}"
        );
    }
}

#[test]
fn a_whole_body_analysed_again_has_the_modes_of_its_bake() {
    // Elements that merely cover a body are a little too stiff, most of all in torsion; never too soft, as displacements of
    // their kind only (Ritz).
    for (shape, tolerance) in [
        (Shape::block(BAR), 0.03),
        (Shape::plate(0.2, 0.2, 0.005), 0.03),
    ] {
        let body = breakable(shape, "porcelain", 6_000.0, 30).body(1);
        let elastic = reanalysis(&whole(&body), 1500, 20).expect("modes");
        let (found, expected) = (
            frequencies(modes(&elastic)),
            frequencies(&body.asset().modes),
        );
        assert_near(&found, &expected, tolerance, "reanalysis");
        let soft = found
            .iter()
            .zip(&expected)
            .filter(|(f, e)| **f < 0.998 * **e);
        assert_eq!(soft.count(), 0, "{found:?} {expected:?}");
    }
}

#[test]
fn a_cracked_body_rings_lower() {
    let kind = breakable(Shape::plate(0.15, 0.15, 0.005), "glass", 10_000.0, 40);
    let steel = Material::preset("steel").expect("a preset");
    let ball = Striker::ball(&steel, 0.02, 8e-3);
    let config = FractureConfig::default();
    let middle = Vec3::new(0.0, 0.0, 2.5e-3);
    // Of many blows the one with the most crack that parts nothing.
    let (mut most, mut state) = (0.0, None);
    for seed in 1..=4 {
        let body = kind.body(seed);
        for step in 1..=20 {
            let speed = f64::from(step);
            let hit = Contact::collision(body.asset(), middle, Vec3::NEG_Z, speed, ball);
            let outcome = impact(&body, &[hit], &config).expect("an outcome");
            let area = outcome.report().crack_area;
            if let Outcome::Held { state: Some(s), .. } = outcome
                && area > most
            {
                (most, state) = (area, Some((body.clone(), s)));
            }
        }
    }
    let (mut cracked, state) = state.expect("a blow that cracks and does not part");
    let sound = reanalysis(&whole(&cracked), 600, 10).expect("modes");
    cracked.set_state(*state).expect("its own state");
    let soft = reanalysis(&whole(&cracked), 600, 10).expect("modes");
    let (sound, soft) = (frequencies(modes(&sound)), frequencies(modes(&soft)));
    assert!(soft[0] < 0.9999 * sound[0], "{soft:?} {sound:?}");
    // A crack never stiffens, but for another lattice: elements are split along it.
    for (a, b) in soft.iter().zip(&sound) {
        assert!(*a < 1.005 * b, "{soft:?} {sound:?}");
    }
}

/// Forces of a uniform traction, N/m², on all triangles of a body's surface that lie at `x`, along x.
fn pulled(body: &Body, elastic: &Elastic, at: f32, traction: f64) -> Vec<f64> {
    let asset = body.asset();
    let mut forces = vec![0.0; 3 * elastic.analysis.nodes.len()];
    for triangle in &asset.surface.triangles {
        let corners = triangle.map(|v| asset.fracture.positions[v as usize]);
        if corners.iter().any(|c| (c.x - at).abs() > 1e-6) {
            continue;
        }
        let [a, b, c] = corners.map(|c| c.as_dvec3());
        let area = 0.5 * (b - a).cross(c - a).length();
        for &v in triangle {
            // Of a whole body the nodes of the portion are all of the mesh's.
            let point = &elastic.nodes[v as usize];
            let element = elastic.analysis.elements[point.element as usize];
            for (node, weight) in element.into_iter().zip(ShapeWeights::values(point)) {
                forces[3 * node as usize] += traction * area / 3.0 * f64::from(weight);
            }
        }
    }
    forces
}

/// How the displacement along x of the nodes away from a bar's ends grows: c of c X + d X² in X = x / half its length, fitted
/// together with what turns of the bar and Poisson's ratio add.
fn stretch(body: &Body, elastic: &Elastic, u: &[f64]) -> [f64; 2] {
    const TERMS: usize = 6;
    let half = 0.5 * BAR[0];
    let mut normal = Mat::<f64>::zeros(TERMS, TERMS);
    let mut right = Mat::<f64>::zeros(TERMS, 1);
    for (v, p) in body.asset().fracture.positions.iter().enumerate() {
        let [x, y, z] = p.as_dvec3().to_array().map(|p| p / half);
        // The ends are a section's width and more away.
        if x.abs() > 0.6 {
            continue;
        }
        let point = &elastic.nodes[v];
        let element = elastic.analysis.elements[point.element as usize];
        let own = element.into_iter().zip(ShapeWeights::values(point));
        let along: f64 = own.map(|(n, w)| f64::from(w) * u[3 * n as usize]).sum();
        let terms = [1.0, x, x * x, y, z, y * y + z * z];
        for i in 0..TERMS {
            right[(i, 0)] += terms[i] * along;
            for j in 0..TERMS {
                normal[(i, j)] += terms[i] * terms[j];
            }
        }
    }
    let fitted = normal.partial_piv_lu().solve(right);
    [fitted[(1, 0)], fitted[(2, 0)]]
}

fn statics(elastic: &Elastic) -> &Arc<dyn Statics> {
    match &elastic.response {
        Response::Static(statics) => statics,
        Response::Modes(_) => panic!("statics were expected"),
    }
}

#[test]
fn a_bar_pulled_at_both_ends_or_at_one_stretches_by_the_textbook() {
    let body = bar();
    let elastic = quasi_static(&whole(&body), 600).expect("statics");
    let half = 0.5 * BAR[0];
    let traction = 1e6;
    let modulus = body.asset().material.youngs_modulus;
    let at = |x: f64| x as f32;
    let right = pulled(&body, &elastic, at(half), traction);
    let left = pulled(&body, &elastic, at(-half), -traction);
    let force: f64 = right.iter().sum();
    assert!((force / (traction * BAR[1] * BAR[2]) - 1.0).abs() < 1e-4);

    // What σ/E everywhere would stretch half of it by, m.
    let unit = traction / modulus * half;

    let both: Vec<f64> = right.iter().zip(&left).map(|(a, b)| a + b).collect();
    let u = statics(&elastic).displacement(&both);
    let [linear, square] = stretch(&body, &elastic, &u);
    assert!((linear / unit - 1.0).abs() < 0.01, "{linear} {unit}");
    assert!(square.abs() < 0.01 * unit, "{square} {unit}");

    // Pulled at one end its own inertia holds it, and the stress falls linearly to zero at the other (d'Alembert).
    let u = statics(&elastic).displacement(&right);
    let [linear, square] = stretch(&body, &elastic, &u);
    assert!(
        (linear / (0.5 * unit) - 1.0).abs() < 0.01,
        "{linear} {unit}"
    );
    assert!(
        (square / (0.25 * unit) - 1.0).abs() < 0.02,
        "{square} {unit}"
    );
}

#[test]
fn the_parents_modes_of_an_uncut_whole_are_its_own() {
    let body = bar();
    let elastic = parent_modes(&whole(&body), &body).expect("modes");
    let (found, expected) = (
        frequencies(modes(&elastic)),
        frequencies(&body.asset().modes),
    );
    // One point per tetrahedron integrates a curved shape a little wrong.
    assert_near(&found, &expected, 0.02, "parent's modes");
}

#[test]
fn the_proxy_of_a_box_is_the_box() {
    // Of a stored shape's proportions, and between two.
    // Coarse elements with lumped masses are some per cent too low; between stored shapes one factor serves all modes, which
    // thinner boxes miss by a quarter.
    for (sides, tolerance) in [([0.12, 0.06, 0.03], 0.06), ([0.12, 0.05, 0.025], 0.3)] {
        let body = breakable(Shape::block(sides), "brick", 4_000.0, 20).body(1);
        let library = ProxyLibrary::new(body.asset().material.poisson_ratio, 12).expect("shapes");
        let elastic = library.fitted(&whole(&body)).expect("a proxy");
        let (found, expected) = (
            frequencies(modes(&elastic)),
            frequencies(&body.asset().modes),
        );
        assert_near(&found, &expected, tolerance, "proxy");
    }
}

#[test]
fn every_way_gives_the_same_bits_on_any_number_of_threads() {
    let body = bar();
    let portion = whole(&body);
    let library = ProxyLibrary::new(body.asset().material.poisson_ratio, 6).expect("shapes");
    let all = |portion: &Arc<Portion>| -> Vec<u64> {
        let mut bits = Vec::new();
        let bases = [
            reanalysis(portion, 150, 12),
            parent_modes(portion, &body),
            library.fitted(portion),
        ];
        for elastic in bases {
            let elastic = elastic.expect("modes");
            let modes = modes(&elastic);
            bits.extend(modes.eigenvalues.iter().map(|x| x.to_bits()));
            bits.extend(modes.shapes.iter().map(|x| u64::from(x.to_bits())));
        }
        let elastic = quasi_static(portion, 150).expect("statics");
        let forces = pulled(&body, &elastic, 0.5 * BAR[0] as f32, 1e6);
        let u = statics(&elastic).displacement(&forces);
        bits.extend(u.iter().map(|x| x.to_bits()));
        bits
    };
    let alone = all(&portion);
    assert!(alone.len() > 1000);
    let side_by_side: Vec<Vec<u64>> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..3).map(|_| scope.spawn(|| all(&portion))).collect();
        threads
            .into_iter()
            .map(|t| t.join().expect("no panic"))
            .collect()
    });
    assert!(side_by_side.iter().all(|bits| *bits == alone));
}
