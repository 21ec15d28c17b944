//! Where flaws lie on their faces, and that the bounds hold there.

use crate::bodies::{block, pane, shelf};
use frangible::glam::Vec3;
use frangible::internals::modal::Motion;
use frangible::internals::stress::{DisplacementBatch, Elasticity, Law, largest_eigenvalue};
use frangible::{Body, FractureConfig};

/// Wherever a body's seed puts its flaws, no mode stresses them by more than the bound of their cluster says.
#[test]
fn no_flaw_of_any_body_feels_more_than_the_bound() {
    let config = FractureConfig::default();
    for kind in [pane(), block(), shelf()] {
        let asset = &**kind.asset();
        let elasticity = Elasticity::new(asset.material()).with_green_lagrange(false);
        let modes = asset.modes().followed();
        let bounds = kind.stress_bounds();
        let (mut most, mut moved) = (0.0_f32, 0);
        for mode in 0..modes {
            let mut amplitudes = vec![0.0; modes];
            amplitudes[mode] = 1e-6;
            let motion = Motion::new(amplitudes, modes, 0.0, 0.0);
            let mut displacement = DisplacementBatch::new(asset);
            displacement.seek(&motion, 0);
            for seed in 1..=8 {
                let body = kind.body(seed);
                for &tet in body.weak_tets() {
                    let (point, law) = body.weak_place(tet, &config, &[]);
                    let gradient = displacement.gradient(asset, &point, 0);
                    let stress = elasticity.state_by(gradient, law).stress;
                    let cluster = bounds.cluster_of_tet[tet as usize] as usize;
                    let bound = 1e-6 * bounds.stress[cluster * asset.modes().count() + mode];
                    let tension = largest_eigenvalue(&stress);
                    assert!(tension <= bound, "mode {mode}: {tension} above {bound}");
                    most = most.max(tension / bound);
                    moved += usize::from(point != *asset.embedded_tet(tet as usize));
                }
            }
        }
        assert!(most > 0.9 && moved > 1000, "{most}, {moved}");
    }
}

/// Flaws lie all over their faces, elsewhere in every body.
#[test]
fn flaws_are_spread_evenly_over_their_faces() {
    let config = FractureConfig::default();
    let kind = pane();
    let mesh = kind.asset().fracture();
    let place = |body: &Body, tet: u32| {
        let (point, law) = body.weak_place(tet, &config, &[]);
        let element = kind.asset().analysis().elements[point.element as usize];
        let nodes = &kind.asset().analysis().nodes;
        let corners = point.barycentric.iter().zip(element);
        let at: Vec3 = corners.map(|(&l, node)| nodes[node as usize] * l).sum();
        matches!(law, Law::Free(_)).then_some(at + point.offset)
    };
    let (mut mean, mut square, mut count) = (Vec3::ZERO, 0.0, 0);
    for seed in 1..=20 {
        let [body, other] = [seed, seed + 100].map(|seed| kind.body(seed));
        for &tet in body.weak_tets() {
            let Some(at) = place(&body, tet).filter(|at| at.z.abs() > 0.0019) else {
                continue;
            };
            if let Some(elsewhere) = place(&other, tet)
                && other.weak_tets().contains(&tet)
            {
                assert!(at.distance(elsewhere) > 0.0, "tetrahedron {tet}");
            }
            // Relative to the face: its middle, and the mean square of the distance from there.
            let x = mesh.corners(tet as usize);
            let face: Vec<Vec3> = (x.iter().copied())
                .filter(|x| (x.z - at.z).abs() < 1e-4)
                .collect();
            assert_eq!(face.len(), 3);
            let middle = face.iter().sum::<Vec3>() / 3.0;
            let spread: f32 = face.iter().map(|x| x.distance_squared(middle)).sum();
            mean += (at - middle) / spread.sqrt();
            // Of a triangle: a twelfth of the sum over its corners.
            square += at.distance_squared(middle) / (spread / 12.0);
            count += 1;
        }
    }
    let (mean, square) = (mean.length() / count as f32, square / count as f32);
    assert!(count > 2000, "{count}");
    assert!(
        mean < 0.02 && (square - 1.0).abs() < 0.05,
        "{mean}, {square}"
    );
}
