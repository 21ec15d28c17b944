//! scratch
use frangible::{
    Breakable, Contact, FractureConfig, Material, Outcome, Striker, glam::Vec3, impact,
};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_pieces::reanalysis;
use std::sync::Arc;
use std::time::Instant;
fn main() {
    let spec = BakeSpec {
        modes: 40,
        ..BakeSpec::new(
            "glass",
            Shape::drinking_glass(),
            Material::preset("glass").unwrap(),
        )
    };
    let (asset, _) = bake(&spec, &mut |_| {}).unwrap();
    let body = Breakable::new(Arc::new(asset)).unwrap().body(1);
    let stone = Striker::fixed(&Material::preset("stone").unwrap());
    let hit = Contact::new(Vec3::new(-0.038, 0.0, 0.068), Vec3::X, 0.8, 5.0, stone);
    let config = FractureConfig::default();
    let Outcome::Broke(fracture) = impact(&body, &[hit], &config).unwrap() else {
        panic!()
    };
    let portions = fracture.portions(&body, |_, f| f.mass.mass > 2e-3);
    let rounds: usize = std::env::args().nth(1).map_or(3, |s| s.parse().unwrap());
    for portion in portions.iter().flatten() {
        let (mut a, mut b) = (f64::MAX, f64::MAX);
        let mut f = 0.0;
        for _ in 0..rounds {
            let t = Instant::now();
            let elastic = reanalysis(portion, 300, 30).unwrap();
            a = a.min(t.elapsed().as_secs_f64());
            if let frangible::piece::Response::Modes(m) = &elastic.response {
                f = m.frequency(0);
            }
            let t = Instant::now();
            body.piece(portion, elastic).unwrap();
            b = b.min(t.elapsed().as_secs_f64());
        }
        println!(
            "tets {} f {f:.2} reanalysis {:.1} ms, piece {:.1} ms",
            portion.tets().len(),
            1e3 * a,
            1e3 * b
        );
    }
}
