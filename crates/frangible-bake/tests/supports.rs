//! Bodies that are held: their modes against closed forms, and their held nodes.

use std::f64::consts::{PI, TAU};

use crate::common::{assert_near, held_modes};
use frangible::glam::{DVec3, Vec3};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::eigen::{Constraints, Modes, remaining_motions};
use frangible_bake::fem::{
    Cover, Elasticity, Elements, QuadraticMesh, System, assemble, assemble_supported_cover,
};
use frangible_bake::frangible_mesh::InputMesh;
use frangible_bake::{
    BakeError, BakeSpec, Baked, Group, ImportOptions, MeshSize, Region, Shape, Support, bake,
    bake_with, import_mesh,
};

const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.3,
    density: 2500.0,
};

/// Quadratic elements, and the nodes for which `held` says along which axes they are held.
fn system(
    shape: &Shape,
    edge: f64,
    layers: usize,
    held: impl Fn(DVec3) -> [bool; 3],
) -> (System, Constraints) {
    let mesh = QuadraticMesh::new(&shape.analysis_mesh(MeshSize { edge, layers }).unwrap());
    let system = assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &GLASS);
    let held: Vec<[bool; 3]> = mesh.positions.iter().map(|&x| held(x)).collect();
    let constraints = Constraints::of_nodes(&mesh.positions, &held);
    (system, constraints)
}

fn assert_orthonormal(system: &System, constraints: &Constraints, modes: &Modes) {
    let remaining = remaining_motions(system, constraints);
    assert_eq!(remaining.len(), modes.rigid_motions);
    for i in 0..modes.eigenvalues.len() {
        let inertia = system.mass.multiply(modes.shape(i));
        let product = |x: &[f64]| x.iter().zip(&inertia).map(|(x, y)| x * y).sum::<f64>();
        for j in 0..=i {
            let expected = if i == j { 1.0 } else { 0.0 };
            let found = product(modes.shape(j));
            assert!(
                (found - expected).abs() < 1e-8,
                "modes {i} and {j}: {found}"
            );
        }
        for motion in &remaining {
            let length = motion.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!(product(motion).abs() < 1e-8 * length, "mode {i}");
        }
        assert!(
            constraints
                .unknowns()
                .iter()
                .all(|&u| modes.shape(i)[u] == 0.0)
        );
    }
}

/// 1.8751² √(EI/(ρA)) / (2πL²), Hz, of a square bar.
fn cantilever(material: &Elasticity, length: f64, side: f64) -> f64 {
    let speed = (material.youngs_modulus / material.density).sqrt();
    1.875_104_f64.powi(2) * speed * side / 12.0_f64.sqrt() / (TAU * length * length)
}

/// √(D/(ρh)), m²/s, of a plate.
fn plate_speed(thickness: f64) -> f64 {
    let bending = GLASS.youngs_modulus * thickness.powi(3) / (12.0 * (1.0 - 0.09));
    (bending / (GLASS.density * thickness)).sqrt()
}

#[test]
fn a_cantilever_rings_at_its_bending_frequency() {
    let (system, constraints) = system(&Shape::rod(0.5, 0.02), 0.02, 2, |x| [x.x < 1e-9; 3]);
    let modes = held_modes(&system, &constraints, 10);
    assert_eq!(modes.rigid_motions, 0);
    assert_near(
        modes.frequency(0),
        cantilever(&GLASS, 0.5, 0.02),
        0.01,
        "first bending",
    );
    assert_near(
        modes.frequency(1),
        cantilever(&GLASS, 0.5, 0.02),
        0.01,
        "the other plane",
    );
    let second = (4.694_091_f64 / 1.875_104).powi(2) * cantilever(&GLASS, 0.5, 0.02);
    assert_near(modes.frequency(2), second, 0.02, "second bending");
    assert_orthonormal(&system, &constraints, &modes);
}

#[test]
fn a_pane_held_across_its_border_rings_as_simply_supported_and_may_still_slide() {
    let (a, h) = (0.4, 0.004);
    let on_border = |x: f64| x < 1e-9 || x > a - 1e-9;
    let (system, constraints) = system(&Shape::plate(a, a, h), a / 24.0, 1, |x| {
        [false, false, on_border(x.x) || on_border(x.y)]
    });
    let modes = held_modes(&system, &constraints, 12);
    assert_eq!(modes.rigid_motions, 3);
    // (π/2) √(D/ρh) ((m/a)² + (n/a)²).
    for (mode, squares) in [(0, 2.0), (1, 5.0), (2, 5.0), (3, 8.0)] {
        let reference = PI / 2.0 * plate_speed(h) * squares / (a * a);
        assert_near(
            modes.frequency(mode),
            reference,
            0.025,
            &format!("mode {mode}"),
        );
    }
    assert_orthonormal(&system, &constraints, &modes);
}

#[test]
fn a_clamped_plate_rings_as_such() {
    let (a, h) = (0.4, 0.004);
    let on_border = |x: f64| x < 1e-9 || x > a - 1e-9;
    let (system, constraints) = system(&Shape::plate(a, a, h), a / 24.0, 1, |x| {
        [on_border(x.x) || on_border(x.y); 3]
    });
    let modes = held_modes(&system, &constraints, 4);
    assert_eq!(modes.rigid_motions, 0);
    let coefficient = TAU * modes.frequency(0) * a * a / plate_speed(h);
    assert_near(coefficient, 35.99, 0.03, "clamped on four sides");
}

#[test]
fn the_dense_solver_agrees_with_lanczos_on_held_bodies() {
    let (system, constraints) = system(&Shape::plate(0.4, 0.4, 0.02), 0.08, 1, |x| {
        [x.x < 1e-9, false, x.x < 1e-9]
    });
    let left = system.unknowns() - constraints.unknowns().len();
    assert!(left > 800, "{left} unknowns would go to the dense solver");
    let few = held_modes(&system, &constraints, left / 5);
    let many = held_modes(&system, &constraints, left / 5 + 1);
    assert_eq!(few.rigid_motions, 1);
    for (a, b) in few.eigenvalues.iter().zip(&many.eigenvalues) {
        assert_near(*a, *b, 1e-7, "eigenvalue");
    }
}

#[test]
fn unknowns_can_be_taken_from_a_consistent_mass_too() {
    let body = Shape::block([0.1, 0.05, 0.04])
        .fracture_mesh(
            MeshSize {
                edge: 0.01,
                layers: 0,
            },
            1,
        )
        .unwrap();
    let cover = Cover::new(&body, 400).unwrap();
    let system = assemble_supported_cover(&cover, &GLASS, &body, &[]);
    let held: Vec<[bool; 3]> = system
        .positions
        .iter()
        .map(|x| [x.x < 0.0, x.x < 0.0, false])
        .collect();
    let constraints = Constraints::of_nodes(&system.positions, &held);
    for wanted in [8, system.unknowns() / 4] {
        let modes = held_modes(&system, &constraints, wanted);
        assert_eq!(modes.rigid_motions, 1, "it may still go along z");
        assert_orthonormal(&system, &constraints, &modes);
    }
}

/// A square bar from the origin along x as a mesh, so that it is covered by a lattice.
fn bar(length: f64, side: f64) -> Shape {
    let corner = |i: u32, bit: u32, size: f64| f64::from(i >> bit & 1) * size;
    let positions =
        (0..8).map(|i| DVec3::new(corner(i, 0, length), corner(i, 1, side), corner(i, 2, side)));
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let mesh = InputMesh {
        positions: positions.collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        ..InputMesh::default()
    };
    import_mesh(&mesh, &ImportOptions::default()).unwrap().shape
}

#[test]
fn a_cantilever_of_any_shape_rings_at_its_bending_frequency() {
    let glass = Material::preset("glass").unwrap();
    let free = 0.24;
    // A region that holds a face, one that holds a part, one that ends amid an element, and a coarse lattice.
    for (held, elements) in [
        (0.0, None),
        (0.02, None),
        (0.0133, None),
        (0.02, Some(0.012)),
    ] {
        let spec = BakeSpec {
            modes: 4,
            analysis: elements.map(|edge| MeshSize { edge, layers: 0 }),
            supports: vec![Support::clamped(Region::below(0, held))],
            ..BakeSpec::new("bar", bar(free + held, 0.02), glass.clone())
        };
        let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
        assert_eq!(report.rigid_motions, 0);
        let reference = cantilever(&Elasticity::from(&glass), free, 0.02);
        for frequency in &report.frequencies[..2] {
            assert_near(
                *frequency,
                reference,
                0.02,
                &format!("{held} m, {elements:?}"),
            );
        }
        let along = || asset.fracture().positions.iter().map(|p| p.x);
        let limit = along().fold(f32::INFINITY, f32::min) + held as f32 + 1e-6;
        assert_eq!(
            asset.supported().len(),
            along().filter(|x| *x < limit).count()
        );
    }
}

#[test]
fn springs_that_hold_one_axis_leave_the_motions_across_it() {
    let spec = BakeSpec {
        modes: 4,
        supports: vec![Support {
            region: Region::below(0, 0.0),
            axes: [true, false, false],
        }],
        ..BakeSpec::new("bar", bar(0.1, 0.02), Material::preset("glass").unwrap())
    };
    let report = bake_with(&spec, |_| {}).unwrap().report;
    // Along y, along z, about x.
    assert_eq!(report.rigid_motions, 3);
    assert!(report.frequencies[0] > 1000.0, "{:?}", report.frequencies);
}

fn small_plate(supports: Vec<Support>) -> BakeSpec {
    let glass = Material::preset("glass").unwrap();
    BakeSpec {
        modes: 4,
        analysis: Some(MeshSize {
            edge: 0.05,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.02,
            layers: 1,
        }),
        supports,
        ..BakeSpec::new("plate", Shape::plate(0.2, 0.2, 0.01), glass)
    }
}

#[test]
fn an_asset_knows_its_supported_nodes() {
    let ball = Region::Sphere {
        centre: DVec3::new(0.2, 0.2, 0.005),
        radius: 0.03,
    };
    let spec = small_plate(vec![
        Support::clamped(Region::below(0, 0.0)),
        Support::clamped(ball),
    ]);
    let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
    assert!(asset.is_supported());
    assert!(report.unknowns < 3 * asset.analysis().nodes.len());
    let centre = DVec3::new(0.1, 0.1, 0.005);
    for (v, p) in asset.fracture().positions.iter().enumerate() {
        let p = p.as_dvec3() + centre;
        let inside = p.x < 1e-6 || p.distance(DVec3::new(0.2, 0.2, 0.005)) < 0.03;
        let supported = asset.supported().contains(&(v as u32));
        // The irregular mesh has its centre of mass within a fraction of a millimetre.
        let near = p.x < 1e-3 || (p.distance(DVec3::new(0.2, 0.2, 0.005)) - 0.03).abs() < 1e-3;
        assert!(supported == inside || near, "node {v} at {p}");
    }
    let free = bake(&small_plate(Vec::new())).unwrap();
    assert!(!free.is_supported());
}

#[test]
fn a_shelf_that_breaks_leaves_a_piece_in_the_wall() {
    let mut spec = small_plate(vec![Support::clamped(Region::below(0, 0.03))]);
    spec.modes = 30;
    spec.analysis = Some(MeshSize {
        edge: 0.02,
        layers: 1,
    });
    spec.fracture = Some(MeshSize {
        edge: 0.008,
        layers: 1,
    });
    let asset = bake(&spec).unwrap();
    let read = Asset::from_bytes(&asset.to_bytes()).unwrap();
    assert_eq!(read.supported(), asset.supported());
    let body = Breakable::uniform(read).unwrap().body(1);
    let striker = Striker::rigid()
        .with_contact_modulus(2.3e11)
        .with_effective_mass(2.0)
        .with_curvature_radius(0.02)
        .with_restitution(0.5);
    // Impulse of a ball of 2 kg against a body that does not give way.
    let impulse = |speed: f32| 1.5 * 2.0 * speed;
    let point = Vec3::new(0.09, 0.0, 0.005);
    let hit = |speed| Contact {
        impulse: impulse(speed),
        ..Contact::strike(point, Vec3::NEG_Z, speed, striker.clone())
    };
    let config = FractureConfig::default();
    let soft = impact(&body, &[hit(0.05)], &config).unwrap();
    assert!(matches!(soft, Outcome::Held { .. }));
    let Outcome::Broke(fracture) = impact(&body, &[hit(6.0)], &config).unwrap() else {
        panic!("it held");
    };
    let supported: Vec<bool> = fracture.fragments.iter().map(|f| f.supported).collect();
    assert!(
        supported.contains(&true) && supported.contains(&false),
        "{supported:?}"
    );
    // Every supported piece reaches into the wall.
    for fragment in fracture.fragments.iter().filter(|f| f.supported) {
        let centre = fragment.mass.centre.as_vec3();
        let lowest = fragment.mesh.positions.iter().map(|p| p.x + centre.x);
        assert!(lowest.fold(f32::INFINITY, f32::min) < 0.03 - 0.1 + 1e-3);
    }
}

#[test]
fn supports_that_cannot_be_meant_are_errors_that_name_them() {
    let good = Support::clamped(Region::below(0, 0.0));
    let sphere = |radius| Region::Sphere {
        centre: DVec3::ZERO,
        radius,
    };
    let cuboid = |low, high| Region::Box { low, high };
    let half = |point, normal| Region::HalfSpace { point, normal };
    let cases = [
        (Region::below(2, -0.1), "contains no part of the body"),
        (
            cuboid(DVec3::splat(5.0), DVec3::splat(6.0)),
            "contains no part of the body",
        ),
        (cuboid(DVec3::ONE, DVec3::ZERO), "low corner above"),
        (cuboid(DVec3::NAN, DVec3::ONE), "NaN"),
        (sphere(0.0), "radius"),
        (sphere(f64::INFINITY), "not finite"),
        (half(DVec3::NAN, DVec3::X), "not finite"),
        (half(DVec3::ZERO, DVec3::ZERO), "normal of length zero"),
    ];
    for (region, words) in cases {
        let spec = small_plate(vec![good.clone(), good.clone(), Support::clamped(region)]);
        let error = bake(&spec).unwrap_err();
        assert!(
            matches!(error, BakeError::Support { support: 2, .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(
            message.starts_with("support 2 ") && message.contains(words),
            "{message}"
        );
    }
    let idle = Support {
        axes: [false; 3],
        ..good
    };
    let error = bake(&small_plate(vec![idle])).unwrap_err().to_string();
    assert!(error.contains("fixes no axis"), "{error}");
    let all = Support::clamped(Region::below(2, 1.0));
    let error = bake(&small_plate(vec![all])).unwrap_err();
    assert_eq!(error, BakeError::AllHeld);
    // Between the nodes that carry the modes, 25 mm apart, but not between those of the cracks.
    let spot = cuboid(
        DVec3::new(0.053, 0.053, -1.0),
        DVec3::new(0.072, 0.072, 1.0),
    );
    let mut spec = small_plate(vec![Support::clamped(spot)]);
    spec.fracture = Some(MeshSize {
        edge: 0.006,
        layers: 1,
    });
    let error = bake(&spec).unwrap_err();
    assert!(error.to_string().contains("refine the"), "{error}");
}

#[test]
fn a_plate_held_along_z_keeps_three_motions() {
    let mut spec = small_plate(vec![Support {
        region: Region::below(2, 0.0),
        axes: [false, false, true],
    }]);
    let report = bake_with(&spec, |_| {}).unwrap().report;
    // Along x, along y, about z.
    assert_eq!(report.rigid_motions, 3);
    spec.supports[0].axes = [true; 3];
    let report = bake_with(&spec, |_| {}).unwrap().report;
    assert_eq!(report.rigid_motions, 0);
}

/// The face x = 0 of the small plate, as two triangles.
fn end_face() -> Group {
    let corner = |y: f64, z: f64| DVec3::new(0.0, y, z);
    let [a, b, c, d] = [
        corner(0.0, 0.0),
        corner(0.2, 0.0),
        corner(0.2, 0.01),
        corner(0.0, 0.01),
    ];
    Group {
        name: "wall".into(),
        triangles: vec![[a, b, c], [a, c, d]],
        points: Vec::new(),
    }
}

#[test]
fn a_group_holds_what_the_same_region_holds() {
    let by_region = small_plate(vec![Support::clamped(Region::below(0, 0.0))]);
    let Baked {
        asset: region,
        report: at_region,
    } = bake_with(&by_region, |_| {}).unwrap();
    let mut by_group = small_plate(vec![Support::clamped(Region::Group("wall".into()))]);
    by_group.groups.push(end_face());
    let Baked {
        asset: group,
        report: at_group,
    } = bake_with(&by_group, |_| {}).unwrap();
    assert_eq!(region.supported(), group.supported());
    assert_eq!(at_region.frequencies, at_group.frequencies);
    // Its nodes one by one are the same part.
    let origin = region
        .fracture()
        .positions
        .iter()
        .fold(DVec3::INFINITY, |low, p| low.min(p.as_dvec3()));
    by_group.groups = vec![Group {
        name: "wall".into(),
        triangles: end_face().triangles.into_iter().take(2).collect(),
        points: region
            .supported()
            .iter()
            .map(|&v| region.fracture().positions[v as usize].as_dvec3() - origin)
            .collect(),
    }];
    let points = bake(&by_group).unwrap();
    assert_eq!(region.supported(), points.supported());
}

#[test]
fn an_unknown_group_is_refused_with_the_names_there_are() {
    let mut spec = small_plate(vec![Support::clamped(Region::Group("wal".into()))]);
    let message = |spec: &BakeSpec| bake(spec).unwrap_err().to_string();
    assert!(
        message(&spec).contains("this body has no groups"),
        "{}",
        message(&spec)
    );
    spec.groups = vec![end_face()];
    let text = message(&spec);
    assert!(
        text.contains("`wal`, did you mean `wall`?; groups: `wall`"),
        "{text}"
    );
    spec.supports[0].region = Region::Group("wall".into());
    spec.groups[0].triangles.clear();
    assert!(
        message(&spec).contains("contains no part of the body"),
        "{}",
        message(&spec)
    );
}
