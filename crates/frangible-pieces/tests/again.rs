use frangible::{
    Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, glam::Vec3, impact,
};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_pieces::reanalysis;
use std::sync::Arc;
use std::time::Instant;

#[test]
fn again() {
    let spec = BakeSpec {
        modes: 60,
        ..BakeSpec::new(
            "glass",
            Shape::drinking_glass(),
            Material::preset("glass").unwrap(),
        )
    };
    let (asset, _) = bake(&spec, &mut |_| {}).unwrap();
    println!("tets {}", asset.fracture.tets.len());
    let body = Breakable::new(Arc::new(asset)).unwrap().body(1);
    let stone = Striker::fixed(&Material::preset("stone").unwrap());
    let hit = Contact::new(Vec3::new(-0.038, 0.0, 0.068), Vec3::X, 0.8, 5.0, stone);
    let config = FractureConfig::default();
    let t = Instant::now();
    let Outcome::Broke(fracture) = impact(&body, &[hit], &config).unwrap() else {
        panic!()
    };
    println!(
        "break {:?} {} fragments",
        t.elapsed(),
        fracture.fragments.len()
    );
    let t = Instant::now();
    let portions = fracture.portions(&body, |_, f| f.mass.mass > 1e-3);
    println!("portions {:?}", t.elapsed());
    again_at(&body, &fracture, &portions, &config, 1);
}

fn again_at(
    body: &Body,
    fracture: &frangible::Fracture,
    portions: &[Option<Arc<frangible::Portion>>],
    config: &FractureConfig,
    depth: u32,
) {
    let stone = Striker::fixed(&Material::preset("stone").unwrap());
    for (fragment, portion) in fracture.fragments.iter().zip(portions) {
        let Some(portion) = portion else { continue };
        if portion.tets().len() < 100 {
            continue;
        }
        let t = Instant::now();
        let solid = portion.solid();
        let volume: f64 = solid
            .tets
            .iter()
            .map(|t| {
                let [a, b, c, d] = t.map(|v| solid.positions[v as usize]);
                (b - a).cross(c - a).dot(d - a) / 6.0
            })
            .sum();
        let ts = t.elapsed();
        println!(
            "gen {} mass {:.4} tets {} solid {} {:?} volume {:e}",
            portion.generation(),
            fragment.mass.mass,
            portion.tets().len(),
            solid.tets.len(),
            ts,
            volume / fragment.mass.volume - 1.0
        );
        assert!((volume / fragment.mass.volume - 1.0).abs() < 1e-3);
        for elements in [150, 300, 600, 3000] {
            let t = Instant::now();
            let elastic = reanalysis(portion, elements, 30).unwrap();
            let time = t.elapsed();
            let frangible::piece::Response::Modes(m) = &elastic.response else {
                panic!()
            };
            println!(
                "   {} elements {} nodes {:?}: {:?}",
                elastic.analysis.elements.len(),
                elastic.analysis.nodes.len(),
                time,
                (0..6).map(|i| m.frequency(i) as u32).collect::<Vec<_>>()
            );
            if elements != 300 {
                continue;
            }
            let t = Instant::now();
            let piece = body.piece(portion, elastic).unwrap();
            println!(
                "   made in {:?}, weak {}",
                t.elapsed(),
                piece.weak_tets().len()
            );
            let p = fragment.mesh.positions[0];
            let hit = Contact::new(p, -p.normalize(), 0.3, 6.0, stone);
            let t = Instant::now();
            let out = impact(&piece, &[hit], config).unwrap();
            println!(
                "   impact {:?} peak {:e} cracks {}",
                t.elapsed(),
                out.report().peak_stress,
                out.report().cracks
            );
            if let Outcome::Broke(f) = out {
                println!(
                    "   broke: {} volume error {:e}",
                    f.fragments.len(),
                    f.report.volume_error
                );
                assert!(f.fragments.iter().all(|f| f.mesh.is_closed()));
                assert!(f.report.volume_error.abs() < 1e-9);
                if depth < 3 {
                    let portions = f.portions(&piece, |_, f| f.mass.mass > 1e-3);
                    again_at(&piece, &f, &portions, config, depth + 1);
                }
            }
        }
    }
}
