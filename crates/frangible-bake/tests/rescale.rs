//! A rescaled asset is the asset that a bake of the other material or size gives.

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::frangible_mesh::InputMesh;
use frangible_bake::{
    BakeSpec, ImportOptions, MeshSize, Region, RescaleError, Shape, Support, bake, import_mesh,
    scaled, with_material,
};

/// Kind of body that is baked: by a rule or covered by a lattice, free or held at one end.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Glass,
    Shelf,
    Covered,
    CoveredShelf,
    Pane,
}

const KINDS: [Kind; 5] = [
    Kind::Glass,
    Kind::Shelf,
    Kind::Covered,
    Kind::CoveredShelf,
    Kind::Pane,
];

/// Sides of the block, m: no two modes of nearly the same frequency.
const SIDES: [f64; 3] = [0.11, 0.07, 0.03];

fn spec(kind: Kind, size: f64, material: &Material) -> BakeSpec {
    let edges = |analysis: f64, fracture: f64, layers| {
        [analysis, fracture].map(|edge| {
            let edge = edge * size;
            Some(MeshSize { edge, layers })
        })
    };
    let (shape, [analysis, fracture]) = match kind {
        Kind::Glass => (glass(size), edges(0.011, 0.004, 1)),
        Kind::Shelf => (
            Shape::block(SIDES.map(|s| s * size)),
            edges(0.0185, 0.0093, 0),
        ),
        Kind::Covered | Kind::CoveredShelf => (solid(size), edges(0.015, 0.008, 0)),
        Kind::Pane => (
            Shape::plate(0.11 * size, 0.07 * size, 0.004 * size),
            edges(0.011, 0.004, 1),
        ),
    };
    let held = |below| vec![Support::clamped(Region::below(0, below * size))];
    BakeSpec {
        analysis,
        fracture,
        modes: 12,
        supports: match kind {
            // The block begins at the origin of its shape, the solid lies about it.
            Kind::Shelf => held(0.02),
            Kind::CoveredShelf => held(-0.035),
            _ => Vec::new(),
        },
        ..BakeSpec::new("body", shape, material.clone())
    }
}

fn glass(size: f64) -> Shape {
    let Shape::Revolution { mut profile } = Shape::drinking_glass() else {
        unreachable!("a glass is round");
    };
    for station in &mut profile {
        station.outer = station.outer.map(|x| x * size);
        station.inner = station.inner.map(|x| x * size);
    }
    Shape::Revolution { profile }
}

fn solid(size: f64) -> Shape {
    let corner = |i: usize, k: usize| SIDES[k] * size * ((i >> k & 1) as f64 - 0.5);
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let mesh = InputMesh {
        positions: (0..8)
            .map(|i| DVec3::new(corner(i, 0), corner(i, 1), corner(i, 2)))
            .collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        ..InputMesh::default()
    };
    let mut options = ImportOptions::default();
    options.tets = 2000;
    import_mesh(&mesh, &options).unwrap().shape
}

fn baked(kind: Kind, size: f64, material: &Material) -> Asset {
    bake(&spec(kind, size, material)).unwrap()
}

fn start() -> Material {
    Material::preset("glass").unwrap()
}

/// All numbers but Poisson's ratio another.
fn other() -> Material {
    let mut m = start();
    m.name = "other".into();
    m.youngs_modulus *= 0.37;
    m.density *= 1.9;
    m.stiffness_damping *= 3.0;
    m.mass_damping *= 0.7;
    m.strength *= 0.41;
    m.fracture_energy *= 1.3;
    m.energy_depth *= 1.1;
    m.weak_point_density *= 2.0;
    m.roughness_amplitude *= 0.5;
    m.roughness_wavelength *= 1.5;
    m.restitution *= 0.5;
    m.friction *= 0.5;
    m
}

fn near(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!(
        (a - b).abs() <= tolerance * b.abs(),
        "{what}: {a}, not {b} within {tolerance}"
    );
}

fn near_points(a: &[Vec3], b: &[Vec3], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().map(|p| p.length()).fold(0.0, f32::max);
    for (a, b) in a.iter().zip(b) {
        assert!(a.distance(*b) < 1e-6 * size, "{what}: {a}, not {b}");
    }
}

/// Compares everything, but for the sign of a mode and the rounding of solver and f32.
fn assert_same(rescaled: &Asset, fresh: &Asset, what: &str) {
    rescaled.validate().unwrap();
    assert_eq!(rescaled.material(), fresh.material(), "{what}");
    assert_eq!(rescaled.fracture().tets, fresh.fracture().tets, "{what}");
    assert_eq!(rescaled.supported(), fresh.supported(), "{what}");
    assert_eq!(rescaled.cell_of_tet(), fresh.cell_of_tet(), "{what}");
    near_points(
        &rescaled.fracture().positions,
        &fresh.fracture().positions,
        what,
    );
    near_points(&rescaled.analysis().nodes, &fresh.analysis().nodes, what);
    let [ours, theirs] = [rescaled, fresh].map(|a| {
        let gradients = a.analysis().barycentric_gradients.iter().flatten();
        gradients.copied().collect::<Vec<_>>()
    });
    near_points(&ours, &theirs, what);
    for (a, b) in rescaled.cells().iter().zip(fresh.cells()) {
        near_points(&a.points, &b.points, what);
    }
    near(rescaled.mass().mass, fresh.mass().mass, 1e-6, what);
    near(rescaled.mass().volume, fresh.mass().volume, 1e-6, what);
    for k in 0..3 {
        let inertia = |a: &Asset| a.mass().inertia.col(k)[k];
        near(inertia(rescaled), inertia(fresh), 1e-6, what);
    }
    let walls = |a: &Asset| {
        let walls = a.surface().walls.clone();
        [walls.thickness, walls.stiffening, walls.margin]
    };
    // Flat but for the rounding of positions: its curvature is noise, far below that of any tube.
    let size = f64::from(
        fresh
            .fracture()
            .positions
            .iter()
            .fold(0.0, |m: f32, p| m.max(p.length())),
    );
    let noise = [0.0, 1e-6 / (size * size), 0.0];
    for (k, (ours, theirs)) in walls(rescaled).iter().zip(walls(fresh)).enumerate() {
        assert_eq!(ours.len(), theirs.len(), "{what}");
        for (a, b) in ours.iter().zip(&theirs) {
            let (a, b) = (f64::from(*a), f64::from(*b));
            assert!(
                a == b || (a - b).abs() <= 1e-4 * b + noise[k],
                "{what}: {a}, not {b}"
            );
        }
    }
    let (a, b) = (rescaled.modes(), fresh.modes());
    for i in 0..b.count() {
        near(a.eigenvalues[i], b.eigenvalues[i], 1e-6, what);
        let apart = |j: usize| (b.eigenvalues[j] / b.eigenvalues[i] - 1.0).abs() > 0.01;
        if (i > 0 && !apart(i - 1)) || (i + 1 < b.count() && !apart(i + 1)) {
            // Modes of nearly one frequency mix freely.
            continue;
        }
        let stress = |m: &frangible::internals::modal::ModalBasis| f64::from(m.peak_stress[i]);
        near(stress(a), stress(b), 1e-4, &format!("{what}, mode {i}"));
        let column = |m: &frangible::internals::modal::ModalBasis| -> Vec<f64> {
            let column = m.shapes.iter().skip(i).step_by(m.count());
            column.map(|&x| f64::from(x)).collect()
        };
        let (a, b) = (column(a), column(b));
        let dot: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
        let (sign, largest) = (dot.signum(), b.iter().fold(0.0_f64, |m, x| m.max(x.abs())));
        for (a, b) in a.iter().zip(&b) {
            assert!(
                (sign * a - b).abs() < 1e-5 * largest,
                "{what}, mode {i}: {a}, not {b}"
            );
        }
    }
}

#[test]
fn another_material_is_what_its_bake_gives() {
    for kind in KINDS {
        let rescaled = with_material(&baked(kind, 1.0, &start()), &other()).unwrap();
        let fresh = baked(kind, 1.0, &other());
        assert_same(&rescaled, &fresh, "material");
        // The mesh is the same, so its mass is bit for bit.
        assert_eq!(rescaled.mass(), fresh.mass());
    }
}

#[test]
fn another_size_is_what_its_bake_gives() {
    for kind in KINDS {
        // A power of two rounds nothing; at other factors a lattice may be cut otherwise at its roundings.
        let factors: &[f64] = match kind {
            Kind::Shelf => &[2.0, 0.5, 1.7],
            Kind::Covered => &[2.0, 0.5],
            Kind::Glass => &[1.7],
            Kind::CoveredShelf => &[2.0, 0.5],
            Kind::Pane => &[2.0, 1.7],
        };
        for &factor in factors {
            let rescaled = scaled(&baked(kind, 1.0, &start()), factor).unwrap();
            let fresh = baked(kind, factor, &start());
            if kind == Kind::Glass {
                // The walls of a vessel are meshed to tolerances in metres: the meshes differ, and only the values to which they converge
                // are the same.
                near(rescaled.mass().mass, fresh.mass().mass, 1e-3, "mass");
                let (ours, theirs) = (rescaled.modes(), fresh.modes());
                for (a, b) in ours.eigenvalues.iter().zip(&theirs.eigenvalues) {
                    near(*a, *b, 1e-2, "eigenvalue of a glass");
                }
                continue;
            }
            assert_same(&rescaled, &fresh, "size");
            assert_eq!(fresh.surface().walls.is_empty(), kind != Kind::Pane);
            let radii = rescaled.surface().curvature_radius.iter();
            for (a, b) in radii.zip(&fresh.surface().curvature_radius) {
                let clamped = *a == 0.003 && factor > 1.0;
                assert!(a == b || (a / b - 1.0).abs() < 1e-2 || clamped, "{a}, {b}");
            }
        }
    }
}

/// Hits the block at one place, times its size.
fn hit(asset: &Asset, size: f32) -> Outcome {
    let striker = Striker::rigid()
        .with_contact_modulus(2e11)
        .with_curvature_radius(f64::from(0.01 * size))
        .with_restitution(0.4);
    let point = size * Vec3::new(0.01, 0.005, 0.015);
    let contact = Contact {
        impulse: 6.0 * size.powi(3),
        ..Contact::strike(point, -Vec3::Z, 12.0, striker)
    };
    let body = Breakable::uniform(asset.clone()).unwrap().body(3);
    impact(
        &body,
        std::slice::from_ref(&contact),
        &FractureConfig::default(),
    )
    .unwrap()
}

fn masses(outcome: &Outcome) -> Vec<f64> {
    match outcome {
        Outcome::Broke(fracture) => fracture.fragments.iter().map(|f| f.mass.mass).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn a_rescaled_body_breaks_as_a_baked_one() {
    let rescaled = baked(Kind::Covered, 1.0, &start());
    let rescaled = scaled(&with_material(&rescaled, &other()).unwrap(), 2.0);
    let (a, b) = (rescaled.unwrap(), baked(Kind::Covered, 2.0, &other()));
    let (a, b) = (hit(&a, 2.0), hit(&b, 2.0));
    let (stress, reference) = (a.report().peak_stress, b.report().peak_stress);
    near(stress, reference, 1e-4, "peak stress");
    let (a, b) = (masses(&a), masses(&b));
    assert!(b.len() > 1, "it held");
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        near(*a, *b, 1e-4, "mass of a fragment");
    }
}

#[test]
fn rescaling_there_and_back_does_not_drift() {
    let asset = baked(Kind::Shelf, 1.0, &start());
    let same = with_material(&asset, &start()).unwrap();
    assert_eq!(format!("{same:?}"), format!("{asset:?}"));
    let mut moved = asset.clone();
    for _ in 0..50 {
        moved = scaled(&with_material(&moved, &other()).unwrap(), 1.3).unwrap();
        moved = scaled(&with_material(&moved, &start()).unwrap(), 1.0 / 1.3).unwrap();
    }
    assert_eq!(moved.material(), asset.material());
    for (a, b) in moved
        .modes()
        .eigenvalues
        .iter()
        .zip(&asset.modes().eigenvalues)
    {
        near(*a, *b, 1e-13, "eigenvalue");
    }
    // Two hundred roundings of 6e-8 that walk at random; all one way they would be 1.2e-5.
    for (a, b) in moved.modes().shapes.iter().zip(&asset.modes().shapes) {
        near(f64::from(*a), f64::from(*b), 1.2e-5, "mode shape");
    }
}

#[test]
fn another_poisson_ratio_names_both_and_asks_for_a_bake() {
    let asset = baked(Kind::Shelf, 1.0, &start());
    let mut rounded = start();
    rounded.poisson_ratio += 1e-12;
    let same = with_material(&asset, &rounded).unwrap();
    assert_eq!(same.material().poisson_ratio, start().poisson_ratio);
    let mut different = other();
    different.poisson_ratio = 0.19;
    let error = with_material(&asset, &different).unwrap_err();
    let text = error.to_string();
    let baked = start().poisson_ratio.to_string();
    for part in ["glass", "other", "0.19", &baked, "bake it again"] {
        assert!(text.contains(part), "{text}");
    }
    assert!(matches!(error, RescaleError::PoissonRatio { .. }));
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-30, 1e30] {
        assert!(scaled(&asset, factor).is_err(), "{factor}");
    }
    for modulus in [f64::NAN, 0.0, 1e-300] {
        let mut m = start();
        m.youngs_modulus = modulus;
        m.density = 1e300;
        assert!(with_material(&asset, &m).is_err(), "{modulus}");
    }
}

#[test]
fn peak_stresses_found_anew_are_those_of_the_bake() {
    for kind in KINDS {
        let asset = baked(kind, 1.0, &start());
        let again = asset.clone().restressed();
        assert_eq!(asset.modes().peak_stress, again.modes().peak_stress);
        let bytes = asset.to_bytes_with(&SaveOptions::compact());
        let compact = Asset::from_bytes(&bytes).unwrap();
        let rounded = asset.clone().with_compact_shapes();
        // Too strong to crack: cracks unload, and a change in one starts others.
        let [exact, near_exact] = [&asset, &rounded].map(|a| {
            let mut strong = a.clone();
            strong.parts_mut().material.strength *= 1e6;
            hit(&strong, 1.0).report().peak_stress
        });
        near(near_exact, exact, 0.02, "peak stress of an impact");
        assert_eq!(compact.modes().shapes, rounded.modes().shapes);
        for (mode, (a, b)) in rounded
            .restressed()
            .modes()
            .peak_stress
            .iter()
            .zip(&asset.modes().peak_stress)
            .enumerate()
        {
            near(
                f64::from(*a),
                f64::from(*b),
                0.05,
                &format!("compact mode {mode}"),
            );
        }
    }
}
