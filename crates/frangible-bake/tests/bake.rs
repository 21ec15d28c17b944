//! The front door: assets that hold together, the same every time, and errors that help.

use std::process::Command;

use frangible::glam::DVec3;
use frangible::{Asset, Material};
use frangible_bake::{BakeError, BakeSpec, Baked, MeshSize, Shape, Stage, bake, bake_with};

fn small_glass() -> BakeSpec {
    let mut spec = BakeSpec::new(
        "glass",
        Shape::drinking_glass(),
        Material::preset("glass").unwrap(),
    );
    spec.analysis = Some(MeshSize {
        edge: 0.011,
        layers: 1,
    });
    spec.fracture = Some(MeshSize {
        edge: 0.004,
        layers: 1,
    });
    spec.modes = 40;
    spec
}

/// FNV-1a over the bits of everything that was computed.
fn hash(asset: &Asset) -> u64 {
    let mut bits: Vec<u32> = Vec::new();
    bits.extend(
        asset
            .fracture()
            .positions
            .iter()
            .flat_map(|p| p.to_array().map(f32::to_bits)),
    );
    bits.extend(asset.fracture().tets.iter().flatten());
    bits.extend(asset.modes().shapes.iter().map(|x| x.to_bits()));
    bits.extend(asset.modes().peak_stress.iter().map(|x| x.to_bits()));
    bits.extend(
        asset
            .embedding()
            .tets
            .iter()
            .flat_map(|p| p.barycentric.map(f32::to_bits)),
    );
    bits.extend(
        asset
            .surface()
            .normals
            .iter()
            .flatten()
            .flat_map(|n| n.to_array().map(f32::to_bits)),
    );
    bits.extend(asset.surface().curvature_radius.iter().map(|x| x.to_bits()));
    bits.extend(
        asset
            .modes()
            .eigenvalues
            .iter()
            .flat_map(|x| [x.to_bits() as u32, (x.to_bits() >> 32) as u32]),
    );
    bits.iter().fold(0xcbf2_9ce4_8422_2325, |h, b| {
        (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn an_asset_holds_together() {
    let mut stages = Vec::new();
    let Baked { asset, report } = bake_with(&small_glass(), |p| {
        assert!((0.0..=1.0).contains(&p.fraction), "{p:?}");
        stages.push(p.stage);
    })
    .unwrap();
    asset.validate().unwrap();
    stages.dedup();
    assert_eq!(
        stages,
        [
            Stage::Mesh,
            Stage::Assemble,
            Stage::Modes,
            Stage::Embed,
            Stage::Surface,
            Stage::Walls,
            Stage::Stress,
            Stage::Followed
        ]
    );
    assert_eq!(asset.modes().count(), 40);
    assert!(report.max_residual < 1e-7, "{}", report.max_residual);
    // A tumbler of this size weighs about 160 g; the origin is the centre of mass.
    assert!(
        (0.14..0.18).contains(&asset.mass().mass),
        "{} kg",
        asset.mass().mass
    );
    let first: DVec3 = (0..asset.fracture().tets.len())
        .map(|e| asset.fracture().centroid(e).as_dvec3() * asset.fracture().volume(e))
        .sum();
    assert!(
        first.length() / asset.mass().volume < 1e-8,
        "centre of mass at {}",
        first / asset.mass().volume
    );
    assert!(
        asset
            .modes()
            .peak_stress
            .iter()
            .all(|s| s.is_finite() && *s > 0.0)
    );
    for (triangle, normals) in asset
        .surface()
        .triangles
        .iter()
        .zip(&asset.surface().normals)
    {
        let [a, b, c] = triangle.map(|v| asset.fracture().positions[v as usize]);
        let face = (b - a).cross(c - a).normalize();
        assert!(
            normals
                .iter()
                .all(|n| (n.length() - 1.0).abs() < 1e-5 && n.dot(face) > 0.7)
        );
    }
    for cell in asset.cells() {
        assert!(cell.points.len() >= 6 && cell.points.iter().all(|p| p.is_finite()));
    }
}

#[test]
fn curvature_is_flat_inside_a_face_small_at_edges_and_right_on_a_cylinder() {
    let mut spec = BakeSpec::new(
        "block",
        Shape::block([0.1; 3]),
        Material::preset("glass").unwrap(),
    );
    (spec.modes, spec.analysis) = (
        4,
        Some(MeshSize {
            edge: 0.05,
            layers: 0,
        }),
    );
    spec.fracture = Some(MeshSize {
        edge: 0.01,
        layers: 0,
    });
    let block = bake(&spec).unwrap();
    for (triangle, radius) in block
        .surface()
        .triangles
        .iter()
        .zip(&block.surface().curvature_radius)
    {
        let on_edge = triangle.iter().any(|&v| {
            let p = block.fracture().positions[v as usize].abs();
            p.to_array().iter().filter(|x| **x > 0.0499).count() > 1
        });
        let expected = if on_edge { 0.003 } else { f32::INFINITY };
        assert_eq!(*radius, expected);
    }
    let glass = bake(&small_glass()).unwrap();
    let middle = |t: &[u32; 3]| {
        t.iter()
            .map(|&v| glass.fracture().positions[v as usize])
            .sum::<frangible::glam::Vec3>()
            / 3.0
    };
    let top = glass
        .fracture()
        .positions
        .iter()
        .map(|p| p.z)
        .fold(f32::MIN, f32::max);
    let wall = glass
        .surface()
        .triangles
        .iter()
        .zip(&glass.surface().curvature_radius)
        .filter(|(t, _)| {
            let p = middle(t);
            (p.z - top + 0.05).abs() < 0.02 && p.truncate().length() > 0.0353
        });
    let mut radii: Vec<f32> = wall.map(|w| *w.1).collect();
    radii.sort_by(f32::total_cmp);
    let median = radii[radii.len() / 2];
    assert!(
        (0.030..0.040).contains(&median),
        "wall radius {median} m, not about 36 mm"
    );
}

#[test]
fn two_bakes_give_the_same_bits() {
    let bake = || hash(&bake(&small_glass()).unwrap());
    assert_eq!(bake(), bake());
}

#[test]
fn the_number_of_threads_does_not_show() {
    const CHILD: &str = "FRANGIBLE_BAKE_HASH";
    if std::env::var_os(CHILD).is_some() {
        println!("hash {:016x}", hash(&bake(&small_glass()).unwrap()));
        return;
    }
    // Thread pools are sized once per process, so each count gets a process of its own.
    let with_threads = |threads: &str| {
        let output = Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "bake::the_number_of_threads_does_not_show",
                "--nocapture",
            ])
            .env(CHILD, "1")
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        text.split("hash ")
            .nth(1)
            .expect("a hash")
            .chars()
            .take(16)
            .collect::<String>()
    };
    assert_eq!(with_threads("1"), with_threads("4"));
}

#[test]
fn bad_input_is_refused_with_a_way_out() {
    let mut spec = small_glass();
    spec.modes = 0;
    assert!(matches!(
        bake(&spec),
        Err(BakeError::Modes { wanted: 0, .. })
    ));
    for density in [0.0, -1.0, f64::NAN] {
        let mut spec = small_glass();
        spec.material.density = density;
        assert!(
            matches!(bake(&spec), Err(BakeError::Input(_))),
            "density {density}"
        );
    }
    let mut spec = small_glass();
    spec.material.poisson_ratio = 0.5;
    assert!(matches!(bake(&spec), Err(BakeError::Input(_))));
    let mut spec = small_glass();
    spec.modes = 1_000_000;
    let error = bake(&spec).unwrap_err();
    assert!(
        matches!(
            error,
            BakeError::TooManyModes {
                wanted: 1_000_000,
                ..
            }
        ),
        "{error}"
    );
    let mut spec = small_glass();
    spec.analysis = Some(MeshSize {
        edge: 0.05,
        layers: 1,
    });
    spec.modes = 10;
    let error = bake(&spec).unwrap_err();
    assert!(
        matches!(
            error,
            BakeError::OutsideAnalysisMesh { .. } | BakeError::Inverted { .. }
        ),
        "{error}"
    );
}

/// A small plate; more than 60 modes, so that the bake chooses.
fn plate_of(modes: usize, followed: Option<usize>) -> Result<Baked, BakeError> {
    let shape = Shape::plate(0.1, 0.08, 0.008);
    let spec = BakeSpec {
        modes,
        followed,
        analysis: Some(shape.size_for(400.0).unwrap()),
        fracture: Some(shape.size_for(3000.0).unwrap()),
        ..BakeSpec::new("plate", shape, Material::preset("glass").unwrap())
    };
    bake_with(&spec, |_| {})
}

#[test]
fn the_bake_chooses_how_many_modes_a_blow_follows() {
    let Baked { asset, report } = plate_of(90, None).unwrap();
    assert_eq!((report.modes, asset.modes().count()), (90, 90));
    assert_eq!(report.followed, asset.modes().followed());
    assert!((10..=90).contains(&report.followed), "{}", report.followed);
    // The modes themselves do not hang on the choice.
    let told = plate_of(90, Some(33)).unwrap();
    let (report, modes) = (told.report, told.asset.modes());
    assert_eq!((report.followed, modes.residual_modes), (33, 57));
    assert_eq!(modes.shapes, asset.modes().shapes);
    // Of few modes all are followed.
    assert_eq!(plate_of(60, None).unwrap().asset.modes().residual_modes, 0);
}

#[test]
fn numbers_of_modes_that_cannot_be_are_refused_with_the_limit() {
    for (modes, followed, words) in [
        (401, None, "at most 400; request 1 to 400"),
        (0, None, "request 1 to 400"),
        (20, Some(0), "choose 1 to 20"),
        (20, Some(21), "21 of 20 modes"),
    ] {
        let error = plate_of(modes, followed).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn a_body_for_games_is_small() {
    let glass = Material::preset("glass").unwrap();
    for (name, shape) in [
        ("glass", Shape::drinking_glass()),
        ("plate", Shape::dinner_plate()),
        ("brick", Shape::block([0.21, 0.1, 0.05])),
    ] {
        let spec = BakeSpec::for_games(name, shape, glass.clone()).unwrap();
        let asset = bake(&spec).unwrap();
        let tets = asset.fracture().tets.len();
        assert!((1200..2500).contains(&tets), "{name}: {tets} tetrahedra");
        assert_eq!(asset.modes().count(), 40, "{name}");
    }
    let nothing = Shape::block([0.1, 0.0, 0.1]);
    assert!(BakeSpec::for_games("nothing", nothing, glass).is_err());
}
