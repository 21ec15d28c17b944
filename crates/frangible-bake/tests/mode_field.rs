//! A mode at the nodes of the meshes: against displacements whose stress is known.

use frangible::glam::{Mat3, Vec3};
use frangible::internals::asset::{AnalysisMesh, AssetParts, EmbeddedPoint, Embedding};
use frangible::internals::modal::ModalBasis;
use frangible::internals::stress::{Symmetric3, principal_axes};
use frangible::{Asset, Material};
use frangible_bake::mode_field::{
    mode_on_analysis_mesh, mode_on_fracture_mesh, motion_on_analysis_mesh, motion_on_fracture_mesh,
    von_mises,
};
use frangible_bake::{BakeSpec, Shape, bake};

const CORNERS: [Vec3; 4] = [
    Vec3::new(0.01, -0.02, 0.03),
    Vec3::new(0.11, 0.0, 0.02),
    Vec3::new(0.02, 0.09, 0.04),
    Vec3::new(0.03, 0.01, 0.12),
];

/// ∇L of a tetrahedron: the rows of the inverse of its edges.
fn gradients(corners: [Vec3; 4]) -> [Vec3; 4] {
    let [a, b, c, d] = corners;
    let inverse = Mat3::from_cols(b - a, c - a, d - a).inverse().transpose();
    let rows = [inverse.x_axis, inverse.y_axis, inverse.z_axis];
    [-(rows[0] + rows[1] + rows[2]), rows[0], rows[1], rows[2]]
}

/// A baked block, for properties that the test does not look at.
fn block() -> Asset {
    let glass = Material::preset("glass").expect("a preset");
    let spec = BakeSpec {
        modes: 4,
        ..BakeSpec::new("block", Shape::block([0.1, 0.05, 0.03]), glass)
    };
    bake(&spec).expect("a baked block")
}

/// Two elements that share a face, a point in each, and modes that move every node as these functions say.
fn two_elements(modes: &[fn(Vec3) -> Vec3]) -> Asset {
    // The fifth corner is the first, mirrored in the middle of the opposite face.
    let middle = (CORNERS[1] + CORNERS[2] + CORNERS[3]) / 3.0;
    let mut nodes = CORNERS.to_vec();
    nodes.push(2.0 * middle - CORNERS[0]);
    let mut elements = Vec::new();
    for corners in [[0, 1, 2, 3], [4, 2, 1, 3_usize]] {
        let mut element = [0; 10];
        for (place, pair) in [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]
            .into_iter()
            .enumerate()
        {
            let [a, b] = pair.map(|corner: usize| nodes[corners[corner]]);
            let centre = 0.5 * (a + b);
            let known = nodes.iter().position(|&p| p == centre);
            element[4 + place] = known.unwrap_or_else(|| {
                nodes.push(centre);
                nodes.len() - 1
            }) as u32;
        }
        for (place, corner) in corners.into_iter().enumerate() {
            element[place] = corner as u32;
        }
        elements.push(element);
    }
    let rows = nodes.iter().flat_map(|&node| {
        (0..3).flat_map(move |axis| modes.iter().map(move |mode| mode(node)[axis]))
    });
    let modes = ModalBasis {
        eigenvalues: (1..=modes.len()).map(|i| i as f64).collect(),
        shapes: rows.collect(),
        peak_stress: vec![1.0; modes.len()],
        ..ModalBasis::default()
    };
    let barycentric_gradients = elements
        .iter()
        .map(|e| gradients(std::array::from_fn(|k| nodes[e[k] as usize])))
        .collect();
    let point = |element, barycentric, offset| EmbeddedPoint {
        element,
        barycentric,
        offset,
    };
    Asset::from_parts(AssetParts {
        analysis: AnalysisMesh {
            nodes,
            elements,
            barycentric_gradients,
        },
        embedding: Embedding {
            tets: Vec::new(),
            nodes: vec![
                point(0, [0.1, 0.2, 0.3, 0.4], Vec3::ZERO),
                point(1, [0.7, 0.1, 0.1, 0.1], Vec3::new(0.001, 0.002, -0.003)),
                // A little outside.
                point(0, [-0.05, 0.35, 0.35, 0.35], Vec3::ZERO),
            ],
        },
        modes,
        ..block().into_parts()
    })
}

fn place(asset: &Asset, point: &EmbeddedPoint) -> Vec3 {
    let nodes = asset.analysis().elements[point.element as usize];
    let corner = |k: usize| point.barycentric[k] * asset.analysis().nodes[nodes[k] as usize];
    (0..4).map(corner).sum::<Vec3>() + point.offset
}

fn near(a: Symmetric3, b: Symmetric3, scale: f32) -> bool {
    let pairs = a.diagonal.into_iter().chain(a.off);
    let others = b.diagonal.into_iter().chain(b.off);
    pairs.zip(others).all(|(x, y)| (x - y).abs() < 1e-4 * scale)
}

/// Stretch along x with Poisson's contraction, and a rotation on top, which strains nothing.
fn stretch(p: Vec3) -> Vec3 {
    const NU: f32 = 0.23;
    100.0 * Vec3::new(p.x, -NU * p.y, -NU * p.z) + 40.0 * Vec3::new(-p.y, p.x, 0.0)
}

/// Pure bending about y: ε_xx = −c z, u_x = −c x z, and what contracts across and sags.
fn bending(p: Vec3) -> Vec3 {
    const NU: f32 = 0.23;
    let sag = 0.5 * (p.x * p.x + NU * (p.z * p.z - p.y * p.y));
    300.0 * Vec3::new(-p.x * p.z, NU * p.y * p.z, sag)
}

#[test]
fn stretched_and_bent_bodies_have_the_stress_of_the_closed_form() {
    let mut asset = two_elements(&[stretch, bending]);
    asset.parts_mut().material.poisson_ratio = 0.23;
    let modulus = asset.material().youngs_modulus as f32;
    let along_x = |s: f32| Symmetric3 {
        diagonal: [s, 0.0, 0.0],
        off: [0.0; 3],
    };
    let on_nodes = |mode| {
        (
            mode_on_analysis_mesh(&asset, mode),
            asset.analysis().nodes.clone(),
        )
    };
    let on_points = |mode| {
        let places = asset.embedding().nodes.iter().map(|p| place(&asset, p));
        (mode_on_fracture_mesh(&asset, mode), places.collect())
    };
    let (stretched, bent) = (100.0 * modulus, |p: Vec3| -300.0 * modulus * p.z);
    for (field, places) in [on_nodes(0), on_points(0)] {
        for ((u, s), p) in field.displacements.iter().zip(&field.stresses).zip(&places) {
            assert!(u.abs_diff_eq(stretch(*p), 1e-4), "{u} at {p}");
            assert!(near(*s, along_x(stretched), stretched), "{s:?}");
            assert!((von_mises(s) / stretched - 1.0).abs() < 1e-4);
        }
    }
    for (number, (field, places)) in [on_nodes(1), on_points(1)].into_iter().enumerate() {
        for (i, ((u, s), p)) in (field.displacements.iter().zip(&field.stresses))
            .zip(&places)
            .enumerate()
        {
            // A point beside its element is reached by the tangent, and has the stress of the closest point.
            let beside = number == 1 && i == 1;
            let (slack, at) = if beside {
                (0.02, *p - asset.embedding().nodes[1].offset)
            } else {
                (1e-4, *p)
            };
            assert!(u.abs_diff_eq(bending(*p), slack), "{u} at {p}");
            assert!(near(*s, along_x(bent(at)), stretched), "{s:?} at {p}");
        }
    }
}

#[test]
fn the_equivalent_stress_is_that_of_the_principal_stresses_and_blind_to_pressure() {
    let mut number = 1.0_f32;
    let mut next = || {
        number = (number * 7.13 + 0.37) % 5.0;
        1e7 * (number - 2.5)
    };
    for _ in 0..500 {
        let stress = Symmetric3 {
            diagonal: [next(), next(), next()],
            off: [next(), next(), next()],
        };
        let [a, b, c] = principal_axes(&stress).0;
        let reference = (0.5 * ((a - b).powi(2) + (b - c).powi(2) + (c - a).powi(2))).sqrt();
        assert!((f64::from(von_mises(&stress)) / reference - 1.0).abs() < 1e-5);
        let squeezed = Symmetric3 {
            diagonal: stress.diagonal.map(|s| s - 3e7),
            off: stress.off,
        };
        assert!((von_mises(&squeezed) / von_mises(&stress) - 1.0).abs() < 1e-4);
    }
    assert_eq!(von_mises(&Symmetric3::default()), 0.0);
}

#[test]
fn a_motion_is_the_sum_of_its_modes_and_modes_not_named_stand_still() {
    let asset = two_elements(&[stretch, bending]);
    for amplitudes in [&[2.0, -0.5][..], &[2.0], &[]] {
        let of = |mode: usize| amplitudes.get(mode).copied().unwrap_or(0.0);
        for (motion, modes) in [
            (
                motion_on_analysis_mesh(&asset, amplitudes),
                [0, 1].map(|mode| mode_on_analysis_mesh(&asset, mode)),
            ),
            (
                motion_on_fracture_mesh(&asset, amplitudes),
                [0, 1].map(|mode| mode_on_fracture_mesh(&asset, mode)),
            ),
        ] {
            let largest = modes[0].stresses.iter().map(von_mises);
            let largest = largest.fold(0.0, f32::max);
            for (i, (u, s)) in motion
                .displacements
                .iter()
                .zip(&motion.stresses)
                .enumerate()
            {
                let expected: Vec3 = (0..2).map(|m| of(m) * modes[m].displacements[i]).sum();
                assert!(u.abs_diff_eq(expected, 1e-4), "{u}, not {expected}");
                let sum = |part: fn(&Symmetric3) -> [f32; 3]| {
                    let [a, b] = [0, 1].map(|m| part(&modes[m].stresses[i]).map(|x| of(m) * x));
                    [0, 1, 2].map(|k| a[k] + b[k])
                };
                let expected = Symmetric3 {
                    diagonal: sum(|s| s.diagonal),
                    off: sum(|s| s.off),
                };
                assert!(near(*s, expected, largest), "{s:?}, not {expected:?}");
            }
        }
    }
}

#[test]
#[should_panic(expected = "mode 2 of 2")]
fn a_mode_that_does_not_exist_is_a_bug_of_the_caller() {
    let _ = mode_on_fracture_mesh(&two_elements(&[stretch, bending]), 2);
}
