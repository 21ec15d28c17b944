//! Thin walls from files are meshed in layers, and vibrate as plate theory says.

use std::f64::consts::PI;

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::frangible_mesh::InputMesh;
use frangible_bake::{
    BakeError, BakeReport, BakeSpec, ImportOptions, Imported, Region, Shape, Support, bake,
    bake_with, import_mesh,
};

/// A box from the origin.
fn block(size: [f64; 3]) -> InputMesh {
    let corner = |i: usize| {
        let side = |axis: usize| size[axis] * (i >> axis & 1) as f64;
        DVec3::new(side(0), side(1), side(2))
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    InputMesh {
        positions: (0..8).map(corner).collect(),
        triangles: faces
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        ..InputMesh::default()
    }
}

/// A sheet over two parameters in 0..1.
fn sheet(place: impl Fn(f64, f64) -> DVec3, count: u32) -> InputMesh {
    let mut mesh = InputMesh::default();
    let share = |i: u32| f64::from(i) / f64::from(count);
    for j in 0..=count {
        mesh.positions
            .extend((0..=count).map(|i| place(share(i), share(j))));
    }
    for j in 0..count {
        for i in 0..count {
            let v = j * (count + 1) + i;
            mesh.triangles.push([v, v + 1, v + count + 2]);
            mesh.triangles.push([v, v + count + 2, v + count + 1]);
        }
    }
    mesh
}

fn imported(mesh: &InputMesh, tets: usize, wall: Option<f64>) -> Result<Imported, BakeError> {
    let mut options = ImportOptions::default();
    (options.tets, options.wall) = (tets, wall);
    import_mesh(mesh, &options)
}

fn baked(shape: Shape, supports: Vec<Support>, material: Material) -> BakeReport {
    let spec = BakeSpec {
        modes: 8,
        supports,
        ..BakeSpec::new("wall", shape, material)
    };
    bake_with(&spec, |_| {}).unwrap().report
}

#[test]
fn an_imported_pane_and_a_sheet_with_a_wall_ring_as_a_free_plate() {
    const SIDE: f64 = 0.4;
    const THICK: f64 = 0.004;
    let mut material = Material::preset("glass").unwrap();
    material.poisson_ratio = 0.3;
    let stiffness =
        material.youngs_modulus * THICK.powi(3) / (12.0 * (1.0 - material.poisson_ratio.powi(2)));
    let unit = (stiffness / (material.density * THICK)).sqrt() / (SIDE * SIDE) / (2.0 * PI);
    let pane = block([SIDE, SIDE, THICK]);
    let quad = sheet(|u, v| SIDE * DVec3::new(u, v, 0.0), 1);
    for (name, mesh, wall) in [("pane", pane, None), ("sheet", quad, Some(THICK))] {
        let shape = imported(&mesh, 20_000, wall).unwrap().shape;
        assert!(matches!(shape, Shape::Wall(_)), "{name}: {shape:?}");
        let report = baked(shape, Vec::new(), material.clone());
        let count = report.fracture.tets as f64 / 20_000.0;
        assert!(
            (0.85..1.2).contains(&count),
            "{name}: {count} of the tetrahedra"
        );
        let volume = SIDE * SIDE * THICK;
        // Tetrahedra twice as long as high.
        let angle = report.fracture.min_dihedral;
        assert!(angle > 8.0, "{name}: {angle}°");
        assert!((report.fracture.volume / volume - 1.0).abs() < 1e-6);
        // A free square plate with ν = 0.3: the limits of the Ritz series, whose first terms give 13.49, 19.79 and 24.43 [Leissa 1973].
        for (f, lambda) in report
            .frequencies
            .iter()
            .zip([13.468, 19.596, 24.270, 34.801, 34.801])
        {
            let off = f / (lambda * unit) - 1.0;
            println!("{name}: {f:.2} Hz, {:+.3} % of plate theory", 100.0 * off);
            assert!(off.abs() < 0.005, "{name}: {f} Hz is off by {off}");
        }
    }
}

#[test]
fn a_plate_gets_about_as_many_tetrahedra_as_requested_whatever_its_layers() {
    for thick in [0.002, 0.006, 0.009, 0.02, 0.03] {
        let plate = block([0.2, 0.2, thick]);
        let Shape::Wall(shape) = imported(&plate, 15_000, None).unwrap().shape else {
            panic!("{thick} m is no wall");
        };
        let size = Shape::Wall(shape.clone()).size_for(15_000.0).unwrap();
        let mesh = Shape::Wall(shape).fracture_mesh(size, 1).unwrap();
        let count = mesh.tets.len() as f64 / 15_000.0;
        println!(
            "{thick} m: {} layers, {count:.3} of the tetrahedra",
            size.layers
        );
        assert!((0.85..1.2).contains(&count), "{thick} m: {count}");
        let volume = 0.2 * 0.2 * thick;
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-6);
    }
}

#[test]
fn what_is_no_wall_is_filled_by_a_lattice() {
    let half = |v: f64| 0.01 * v;
    // Two faces that meet in a sharp edge, and two that cross.
    let mut wedge = sheet(|u, v| DVec3::new(0.2 * u, 0.2 * v, half(v)), 8);
    let below = sheet(|u, v| DVec3::new(0.2 * u, 0.2 * v, -half(v)), 8);
    let offset = wedge.positions.len() as u32;
    wedge.positions.extend(&below.positions);
    let turned = below
        .triangles
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(|v| v + offset));
    wedge.triangles.extend(turned);
    for i in 0..8 {
        let far = 8 * 9;
        let mut rim = |a: u32, b: u32| {
            wedge
                .triangles
                .extend([[b, a, a + offset], [b, a + offset, b + offset]]);
        };
        rim(far + i + 1, far + i);
        rim(9 * i + 9, 9 * i);
        rim(9 * i + 8, 9 * i + 17);
    }
    let imported_wedge = imported(&wedge, 4000, None).unwrap();
    assert!(imported_wedge.mended.is_watertight());
    assert!(matches!(imported_wedge.shape, Shape::Solid(_)));
    let roll = |u: f64, v: f64| {
        let (sin, cos) = (4.0 * PI * u).sin_cos();
        let r = 0.03 + 0.006 * u;
        DVec3::new(r * cos, r * sin, 0.1 * v)
    };
    let roll = sheet(roll, 60);
    let shape = |wall: f64| imported(&roll, 4000, Some(wall)).unwrap().shape;
    assert!(matches!(shape(0.001), Shape::Wall(_)));
    assert!(matches!(shape(0.005), Shape::Solid(_)));
}

#[test]
fn an_open_sheet_without_a_wall_is_told_the_option_and_a_pot_is_filled() {
    let wavy = sheet(
        |u, v| DVec3::new(u, v, 0.05 * (9.0 * u).sin() * (7.0 * v).sin()),
        24,
    );
    let error = imported(&wavy, 4000, None).unwrap_err();
    assert_eq!(error, BakeError::OpenSheet);
    assert!(error.to_string().contains("--wall METRES"), "{error}");
    let flat = sheet(|u, v| DVec3::new(u, v, 0.0), 1);
    let error = imported(&flat, 4000, None).unwrap_err();
    assert!(error.to_string().contains("--wall METRES"), "{error}");
    let mut pot = block([0.1; 3]);
    pot.triangles.truncate(10);
    assert!(matches!(
        imported(&pot, 4000, None).unwrap().shape,
        Shape::Solid(_)
    ));
}

#[test]
fn a_wall_can_be_held_at_an_edge_and_ring_lower() {
    let shape = || {
        imported(&block([0.3, 0.1, 0.003]), 4000, None)
            .unwrap()
            .shape
    };
    let material = Material::preset("glass").unwrap();
    let held = vec![Support::clamped(Region::below(0, 0.0))];
    let report = baked(shape(), held, material.clone());
    assert_eq!(report.rigid_motions, 0);
    // A clamped strip, between a beam and a wide plate.
    let beam = 3.516 / (2.0 * PI * 0.3 * 0.3)
        * (material.youngs_modulus * 0.003_f64.powi(2) / (12.0 * material.density)).sqrt();
    let stiffer = report.frequencies[0] / beam;
    let wide = (1.0 - material.poisson_ratio.powi(2)).powf(-0.5);
    assert!(
        (0.995..wide * 1.01).contains(&stiffer),
        "{stiffer} of a beam"
    );
}

#[test]
fn bakes_of_walls_have_the_same_bits_on_one_thread_and_two() {
    let bend = |u: f64, v: f64| {
        let (sin, cos) = (0.5 * PI * u).sin_cos();
        DVec3::new(0.1 * cos, 0.1 * sin, 0.1 * v)
    };
    let mesh = sheet(bend, 12);
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let shape = imported(&mesh, 2000, Some(0.003)).unwrap().shape;
            let spec = BakeSpec {
                modes: 6,
                ..BakeSpec::new("bent", shape, Material::preset("glass").unwrap())
            };
            bake(&spec).unwrap().to_bytes()
        })
    };
    assert!(with_threads(1) == with_threads(2), "the bits differ");
}
