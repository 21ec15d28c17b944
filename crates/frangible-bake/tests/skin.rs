//! Flaws lie on the free surface, and what bends a thin wall is as large there as beam theory says.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::stress::Skin;
use frangible::internals::{Force, rest};
use frangible::{Asset, Breakable, FractureConfig, Material};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};

const SIZE: [f64; 3] = [0.2, 0.1, 0.006];

fn baked(shape: Shape, layers: usize, supports: Vec<Support>) -> Asset {
    let material = Material::preset("glass").unwrap();
    // The plate in large elements of one layer, the others as they come.
    let plate = matches!(shape, Shape::Box { size } if size[2] < 0.01);
    let spec = BakeSpec {
        analysis: plate.then_some(MeshSize {
            edge: 0.02,
            layers: 1,
        }),
        fracture: plate.then_some(MeshSize {
            edge: 0.008,
            layers,
        }),
        modes: 2,
        supports,
        ..BakeSpec::new("body", shape, material)
    };
    bake(&spec).unwrap()
}

fn plate(layers: usize) -> Asset {
    baked(Shape::plate(SIZE[0], SIZE[1], SIZE[2]), layers, Vec::new())
}

/// Stresses of one mode, a bar bent to the curvature 1 about y [Timoshenko, Goodier, art. 102], and a stretch across it that
/// a mesh of one layer cannot tell from nothing: E_zz = `noise` · z.
fn bent(mut asset: Asset, noise: f32) -> Asset {
    let nu = asset.material().poisson_ratio as f32;
    let middle = middle(&asset);
    let rows = asset.analysis().nodes.iter().flat_map(|&p| {
        let Vec3 { x, y, z } = p - middle;
        let down = -0.5 * (x * x + nu * (z * z - y * y)) + 0.5 * noise * z * z;
        [x * z, -nu * y * z, down]
    });
    asset.parts_mut().modes.shapes = rows.collect();
    asset.parts_mut().modes.eigenvalues.truncate(1);
    asset.parts_mut().material.weak_point_density = 1e15;
    asset.parts_mut().material.strength = 1e12;
    asset.restressed()
}

/// The middle of the box around the body: the origin, its centre of mass, is a little off.
fn middle(asset: &Asset) -> Vec3 {
    let p = &asset.fracture().positions;
    let low = p.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let high = p.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    0.5 * (low + high)
}

/// Peak stress met over E κ h/2, the stress of the skin.
fn peak(asset: &Asset, config: &FractureConfig) -> f64 {
    // A force at the far edge moves the mode by φ · f / λ.
    let point = middle(asset) + Vec3::new(0.1, 0.0, 0.003);
    let wanted = 1e-5;
    let shape = -0.5 * (0.1_f64 * 0.1 + 0.23 * 0.003 * 0.003);
    let force = Vec3::Z * (wanted * asset.modes().eigenvalues[0] / shape) as f32;
    let body = Breakable::uniform(Arc::new(asset.clone())).unwrap().body(1);
    let forces = [Force { point, force }];
    let report = rest(&body, &forces, Vec3::ZERO, config)
        .unwrap()
        .report()
        .clone();
    let skin = asset.material().youngs_modulus * wanted * 0.5 * SIZE[2];
    report.peak_stress / skin
}

fn unculled() -> FractureConfig {
    let mut config = FractureConfig::default();
    config.culling = false;
    // The force's own near field is no stress of the bent plate.
    config.near_field = None;
    config
}

#[test]
fn a_bent_plate_of_one_layer_has_the_stress_of_its_skin() {
    let config = unculled();
    // Its weak points are at centres, and its walls have the stress of the mesh.
    let mut paper = FractureConfig::as_in_the_paper();
    paper.culling = false;
    let centres = peak(&bent(plate(1), 0.0), &paper);
    assert!(centres < 0.6, "{centres}");
    for noise in [0.0, 0.5] {
        let asset = bent(plate(1), noise);
        let ours = peak(&asset, &config);
        println!("noise {noise}: peak over E κ h/2: {ours:.4}, at the centres {centres:.4}");
        assert!((ours - 1.0).abs() < 0.01, "noise {noise}: {ours}");
    }
    let noisy = peak(&bent(plate(1), 0.5), &paper) / centres;
    println!("without plane stress the noise changes the peak to {noisy:.3} of it");
    assert!((noisy - 1.0).abs() > 0.05);
}

#[test]
fn no_bound_is_below_the_stress_of_the_skin() {
    for noise in [0.0, 0.5, -2.0] {
        let asset = bent(plate(1), noise);
        let body = Breakable::uniform(Arc::new(asset.clone())).unwrap().body(1);
        let force = [Force {
            point: Vec3::new(0.1, 0.0, 0.0),
            force: Vec3::Z * 1e3,
        }];
        let of = |config: &FractureConfig| rest(&body, &force, Vec3::ZERO, config).unwrap();
        let (culled, looked_at) = (of(&FractureConfig::default()), of(&unculled()));
        let bound = culled.report().stress_bound;
        let stress = looked_at.report().peak_stress;
        assert!(bound >= stress * (1.0 - 1e-6), "{bound} < {stress}");
        assert!(bound < 3.0 * stress, "{bound} is far above {stress}");
    }
}

#[test]
fn flaws_lie_on_the_largest_free_face() {
    let glass = baked(Shape::drinking_glass(), 1, Vec::new());
    let block = baked(Shape::block([0.06, 0.05, 0.04]), 0, Vec::new());
    for (asset, off) in [(plate(1), 1e-6), (block, 1e-6), (glass, 1e-3)] {
        let skin = Skin::of(&asset);
        let area = |t: usize| {
            let [a, b, c] =
                asset.surface().triangles[t].map(|v| asset.fracture().positions[v as usize]);
            (b - a).cross(c - a).length()
        };
        let mut flaws = 0;
        for (t, &tet) in asset.surface().tets.iter().enumerate() {
            let flaw = skin.flaw(tet as usize).unwrap();
            assert!(area(t) <= area(flaw.triangle as usize));
            if flaw.triangle as usize != t {
                continue;
            }
            flaws += 1;
            let corners =
                asset.surface().triangles[t].map(|v| asset.fracture().positions[v as usize]);
            let centroid = corners.iter().sum::<Vec3>() / 3.0;
            let element = asset.analysis().elements[flaw.point.element as usize];
            let place: Vec3 = (0..4)
                .map(|k| flaw.point.barycentric[k] * asset.analysis().nodes[element[k] as usize])
                .sum();
            assert!(centroid.distance(place + flaw.point.offset) < 1e-6);
            assert!(flaw.point.offset.length() < off, "{}", flaw.point.offset);
            assert!(flaw.point.barycentric.iter().all(|&l| l > -0.25));
        }
        assert!(flaws > 100);
    }
}

#[test]
fn walls_are_what_is_thinner_than_its_elements_are_long() {
    for layers in [1, 2] {
        let asset = plate(layers);
        let skin = Skin::of(&asset);
        for e in 0..asset.fracture().tets.len() {
            let wall = skin.wall(&asset, e).unwrap();
            assert!(wall.normal.z.abs() > 0.999, "{}", wall.normal);
            let [front, back] = wall.distances(asset.fracture().centroid(e));
            assert!(front > 0.0 && back < 0.0, "{front} {back}");
            let thickness = front - back;
            assert!((f64::from(thickness) - SIZE[2]).abs() < 1e-5, "{thickness}");
        }
    }
    let glass = baked(Shape::drinking_glass(), 1, Vec::new());
    let skin = Skin::of(&glass);
    let tets = glass.fracture().tets.len();
    let walled = (0..tets)
        .filter(|&e| skin.wall(&glass, e).is_some())
        .count();
    println!("{walled} of {tets} tetrahedra of the glass are wall");
    assert!(walled * 10 > tets * 8);
    // From a centre in a curved wall both faces are within its thickness, one before and one behind.
    let astray = (0..tets)
        .filter_map(|e| {
            Some(
                skin.wall(&glass, e)?
                    .distances(glass.fracture().centroid(e)),
            )
        })
        .filter(|[front, back]| *front < 0.0 || *back > 0.0)
        .count();
    assert!(astray * 20 < tets, "{astray} of {tets}");
    let block = baked(Shape::block([0.06, 0.05, 0.04]), 0, Vec::new());
    let skin = Skin::of(&block);
    assert!((0..block.fracture().tets.len()).all(|e| skin.wall(&block, e).is_none()));
}

#[test]
fn a_rod_is_no_wall() {
    let walled = |asset: &Asset, counts: &dyn Fn(Vec3) -> bool| {
        let skin = Skin::of(asset);
        let mesh = asset.fracture();
        let counted = (0..mesh.tets.len()).filter(|&e| counts(mesh.centroid(e)));
        let counted: Vec<usize> = counted.collect();
        let walled = counted.iter().filter(|&&e| skin.wall(asset, e).is_some());
        (walled.count(), counted.len())
    };
    let bar = baked(Shape::block([0.1, 0.008, 0.006]), 1, Vec::new());
    let (walls, all) = walled(&bar, &|_| true);
    assert!(walls == 0 && all > 50, "{walls} of {all}");
    let glass = Shape::ready("wine_glass").unwrap();
    let glass = baked(glass, 1, Vec::new());
    let (walls, all) = walled(&glass, &|p| (-0.08..-0.03).contains(&p.z));
    assert!(walls == 0 && all > 500, "{walls} of {all} of a stem");
    let (walls, all) = walled(&glass, &|p| p.z > 0.01);
    assert!(walls * 20 > all * 19, "{walls} of {all} of a bowl");
}

#[test]
fn held_faces_are_not_free() {
    let shape = || Shape::plate(SIZE[0], SIZE[1], SIZE[2]);
    let clamped = vec![Support::clamped(Region::below(0, 0.03))];
    let (free, held) = (baked(shape(), 1, Vec::new()), baked(shape(), 1, clamped));
    let flaws = |asset: &Asset| {
        let skin = Skin::of(asset);
        (0..asset.fracture().tets.len())
            .filter(|&e| skin.flaw(e).is_some())
            .count()
    };
    let asset = &held;
    let skin = Skin::of(asset);
    for e in 0..asset.fracture().tets.len() {
        if let Some(flaw) = skin.flaw(e) {
            let nodes = asset.surface().triangles[flaw.triangle as usize];
            let all = nodes.iter().all(|v| asset.supported().contains(v));
            assert!(!all, "tetrahedron {e} has its flaw on a held face");
        }
    }
    let (free, held) = (flaws(&free), flaws(&held));
    assert!(held < free && held * 2 > free, "{held} of {free}");
}
