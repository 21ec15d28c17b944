//! Laminated walls: how they bend, beside closed forms, where their plies crack, and when the film lets through.

use std::sync::{Arc, OnceLock};

use frangible::glam::{DVec3, Vec3};
use frangible::internals::Laminate;
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact,
};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};

/// Side of the panes, m, and their thickness: 2.1 mm, a film of 0.76 mm, 2.1 mm.
const SIDE: f64 = 0.4;
const THICK: f64 = 4.96e-3;

fn laminated() -> Material {
    Material::preset("laminated-glass").expect("a preset")
}

fn spec(shape: Shape, material: Material) -> BakeSpec {
    BakeSpec {
        modes: 60,
        fracture: Some(shape.size_for(20_000.0).expect("a size")),
        ..BakeSpec::new("pane", shape, material)
    }
}

/// A pane that is held at its four edges.
fn pane() -> &'static Arc<Asset> {
    static PANE: OnceLock<Arc<Asset>> = OnceLock::new();
    PANE.get_or_init(|| {
        let rim = 0.01;
        let edges =
            (0..2).flat_map(|axis| [Region::below(axis, rim), Region::above(axis, SIDE - rim)]);
        let spec = BakeSpec {
            supports: edges.map(Support::clamped).collect(),
            ..spec(Shape::plate(SIDE, SIDE, THICK), laminated())
        };
        Arc::new(bake(&spec).expect("a baked pane"))
    })
}

/// Deflection of the middle of a beam on simple supports under its own weight, m.
fn sag(shape: [f64; 3], material: Material) -> f64 {
    let [length, width, thickness] = shape;
    let end = |at: f64| Support {
        region: Region::Box {
            low: DVec3::new(at - 1e-6, f64::NEG_INFINITY, -1e-6),
            high: DVec3::new(at + 1e-6, f64::INFINITY, 1e-6),
        },
        axes: [at == 0.0, true, true],
    };
    let spec = BakeSpec {
        modes: 40,
        analysis: Some(MeshSize {
            edge: 0.5 * width,
            layers: 1,
        }),
        supports: vec![end(0.0), end(length)],
        ..spec(Shape::plate(length, width, thickness), material)
    };
    let asset = bake(&spec).expect("a beam");
    let modes = asset.modes();
    let rows = |point: &frangible::internals::asset::EmbeddedPoint, mode: usize| -> f64 {
        let nodes = asset.analysis().elements[point.element as usize];
        let values = nodes.iter().zip(point.shape_values());
        values
            .map(|(&node, share)| f64::from(modes.row(3 * node as usize + 2)[mode] * share))
            .sum()
    };
    let points = &asset.embedding().tets;
    let middle = (0..points.len())
        .min_by(|&a, &b| {
            let x = |e: usize| asset.fracture().centroid(e).x.abs();
            x(a).total_cmp(&x(b))
        })
        .expect("a tetrahedron");
    let density = asset.material().density;
    (0..modes.count())
        .map(|mode| {
            let weight: f64 = (0..points.len())
                .map(|e| 9.81 * density * asset.fracture().volume(e) * rows(&points[e], mode))
                .sum();
            weight * rows(&points[middle], mode) / modes.eigenvalues[mode]
        })
        .sum()
}

#[test]
fn beams_bend_as_the_closed_form_of_two_plies_on_a_film() {
    let (length, width): (f64, f64) = (1.0, 0.14);
    for (ply, film, shear) in [
        (9.02e-3, 1.52e-3, 0.44e6),
        (5.56e-3, 1.52e-3, 7.1e6),
        (6.5e-3, 1.52e-3, 150e6),
    ] {
        let material = Material {
            laminate: Some(Laminate {
                interlayer: film,
                shear_modulus: shear,
                ..Laminate::PVB
            }),
            ..laminated()
        };
        let (modulus, s) = (material.youngs_modulus, ply + film);
        let own = modulus * ply.powi(3) / 6.0;
        let whole = own + 0.5 * modulus * ply * s * s;
        let a2 = shear / film * (2.0 / (modulus * ply) + s * s / own);
        let end = 1.0 - 1.0 / (a2.sqrt() * length / 2.0).cosh();
        let thickness = 2.0 * ply + film;
        let load = 9.81 * material.density * thickness;
        let exact = load
            * (5.0 * length.powi(4) / (384.0 * whole)
                + (whole / own - 1.0) / (a2 * whole) * (length * length / 8.0 - end / a2));
        let ours = sag([length, width, thickness], material);
        println!("{ply} {shear}: {ours} {exact} {}", ours / exact);
        assert!(
            (ours / exact - 1.0).abs() < 0.05,
            "{ply} {shear}: {ours} {exact}"
        );
    }
}

/// A ball in the middle of the pane.
fn hit(body: &Body, mass: f64, radius: f64, speed: f64, material: &str) -> Outcome {
    let material = Material::preset(material).expect("a preset");
    let ball = Striker::ball(&material, mass, radius);
    let point = Vec3::new(0.013, 0.007, 0.5 * THICK as f32);
    let contact = Contact::collision(body.asset(), point, Vec3::NEG_Z, speed, ball);
    impact(body, &[contact], &FractureConfig::default()).expect("sound input")
}

/// Tetrahedra that cracks cut in the ply that is hit and in the other.
fn cut(body: &Body, outcome: &Outcome) -> [usize; 2] {
    let mut counts = [0; 2];
    let arrivals = outcome.report().arrivals.iter().flatten();
    for &(tet, _) in arrivals {
        let z = body.asset().fracture().centroid(tet as usize).z;
        counts[usize::from(z < 0.0)] += 1;
    }
    counts
}

#[test]
fn a_small_stone_leaves_a_star_in_the_ply_that_it_hits() {
    let kind = Breakable::new(Arc::clone(pane())).expect("sound");
    for seed in 1..=3 {
        let body = kind.body(seed);
        let outcome = hit(&body, 0.003, 0.0065, 20.0, "stone");
        let [struck, other] = cut(&body, &outcome);
        println!("stone, seed {seed}: {struck} {other}");
        assert!(struck > 50 && 4 * other < struck, "{struck} {other}");
        assert!(matches!(outcome, Outcome::Held { .. }));
    }
}

#[test]
fn a_heavy_blow_cracks_both_plies_and_leaves_pieces_on_the_film() {
    let kind = Breakable::new(Arc::clone(pane())).expect("sound");
    for seed in 1..=3 {
        let body = kind.body(seed);
        let outcome = hit(&body, 5.0, 0.08, 16.0, "wood");
        let [struck, other] = cut(&body, &outcome);
        let Outcome::Broke(fracture) = outcome else {
            panic!("it held");
        };
        let (pieces, bonds) = (fracture.fragments.len(), fracture.film());
        println!(
            "5 kg, seed {seed}: {struck} {other}, {pieces} pieces, {} bonds",
            bonds.len()
        );
        assert!(struck > 200 && other > 200 && pieces > 3);
        // Each piece hangs on another, or in the frame.
        for piece in 0..pieces as u32 {
            assert!(
                bonds.iter().any(|bond| bond.pieces.contains(&piece)),
                "{piece}"
            );
        }
        for bond in bonds {
            assert!(bond.length > 0.0 && bond.section > 0.0 && bond.place.is_finite());
            assert!(
                (bond.along.length() - 1.0).abs() < 1e-4
                    && bond.along.dot(bond.across).abs() < 1e-4
            );
        }
    }
}

/// Message of the error about a plate of this thickness, m, with this laminate.
fn refused(shape: Shape, laminate: Laminate) -> String {
    let material = Material {
        laminate: Some(laminate),
        ..laminated()
    };
    match bake(&spec(shape, material)) {
        Ok(_) => panic!("it was accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_laminate_that_does_not_fit_is_named() {
    let plate = |thickness| Shape::plate(SIDE, SIDE, thickness);
    let one = Laminate {
        plies: 1,
        ..Laminate::PVB
    };
    assert!(refused(plate(THICK), one).contains("number of plies of the laminate is 1"));
    let said = refused(plate(0.7e-3), Laminate::PVB);
    assert!(
        said.contains("`pane` is of `laminated-glass`") && said.contains("thicker than its wall"),
        "{said}"
    );
    let apart = Laminate {
        ply: 1e-3,
        ..Laminate::PVB
    };
    assert!(refused(plate(THICK), apart).contains("do not touch"));
    assert!(refused(Shape::bowl(), Laminate::PVB).contains("no wall between two faces"));
}

#[test]
fn an_asset_keeps_its_laminate_in_a_file() {
    let read = Asset::from_bytes(&pane().to_bytes()).expect("an asset");
    assert_eq!(read.material().laminate, Some(Laminate::PVB));
}
