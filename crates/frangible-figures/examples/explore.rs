use std::sync::Arc;
use frangible::glam::Vec3;
use frangible::*;
use frangible_bake::*;
fn blow(asset: &Asset, point: Vec3, normal: Vec3, speed: f64, striker: Striker) -> Contact {
    let normal = normal.normalize();
    let own = asset.mass.inverse_effective_mass(point.as_dvec3(), normal.as_dvec3());
    let mass = 1.0 / (own + f64::from(striker.inverse_effective_mass));
    let impulse = (1.0 + f64::from(striker.restitution)) * mass * speed;
    Contact::new(point, normal, impulse as f32, speed as f32, striker)
}
fn baked(name: &str, shape: Shape, material: &str, tets: f64) -> Arc<Asset> {
    let spec = BakeSpec { modes: 100, fracture: Some(shape.size_for(tets).unwrap()), ..BakeSpec::new(name, shape, Material::preset(material).unwrap()) };
    Arc::new(bake(&spec, &mut |_| {}).unwrap().0)
}
fn ball(mass: f64) -> Striker {
    let steel = Material::preset("steel").unwrap();
    let r = (mass / steel.density * 0.75 / std::f64::consts::PI).cbrt();
    Striker::ball(&steel, mass, r)
}
fn show(tag: &str, asset: &Arc<Asset>, c: Contact, seeds: u64, crumb: bool) {
    for (name, mut config) in [("paper", FractureConfig::as_in_the_paper()), ("ours ", FractureConfig::default())] {
        if crumb { config.crumb_share = 0.0; }
        let kind = Breakable::new(Arc::clone(asset)).unwrap();
        let (mut a, mut p, mut n) = (0.0, vec![], vec![]);
        let t = std::time::Instant::now();
        let mut r = None;
        for s in 1..=seeds {
            let o = impact(&kind.body(s), &[c], &config).unwrap();
            a += 1e4 * o.report().crack_area / seeds as f64;
            p.push(match &o { Outcome::Broke(f) => f.fragments.len(), _ => 1 });
            n.push(o.report().cracks);
            r = Some(o.report().clone());
        }
        let r = r.unwrap();
        println!("{tag} {name} td {:.0} us (raw {:.0}) peak {:.0} MPa bound {:.0} area {a:.1} pieces {p:?} cracks {n:?} {:.2} s each", 1e6 * r.contact_duration, 1e6 * r.unadjusted_duration, 1e-6 * r.peak_stress, 1e-6 * r.stress_bound, t.elapsed().as_secs_f64() / seeds as f64);
    }
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    match args[1].as_str() {
        "slab" => {
            let t: f64 = args[2].parse().unwrap();
            let a = baked("slab", Shape::plate(0.3, 0.3, t), "paper-slab-high", 40000.0);
            for pair in args[3..].chunks(2) {
                let (m, v): (f64, f64) = (pair[0].parse().unwrap(), pair[1].parse().unwrap());
                show(&format!("{m} kg {v} m/s"), &a, blow(&a, Vec3::Z * (t / 2.0) as f32, Vec3::NEG_Z, v, ball(m)), 2, false);
            }
        }
        "bar" | "plate" => {
            let (shape, tets, z) = if args[1] == "bar" { (Shape::block([0.16, 0.06, 0.05]), 1800.0, 0.025) } else { (Shape::plate(0.12, 0.09, 0.008), 900.0, 0.004) };
            let a = baked("b", shape, &args[2], tets);
            println!("{} tets", a.fracture.tets.len());
            for pair in args[3..].chunks(2) {
                let (m, v): (f64, f64) = (pair[0].parse().unwrap(), pair[1].parse().unwrap());
                show(&format!("{m} kg {v} m/s"), &a, blow(&a, Vec3::Z * z, Vec3::NEG_Z, v, ball(m)), 12, true);
            }
        }
        "pig" | "rabbit" => {
            let name = if args[1] == "pig" { "piggy_bank" } else { "rabbit" };
            let a = baked(name, Shape::ready(name).unwrap(), &args[2], 20000.0);
            let p = &a.fracture.positions;
            let ext = |d: Vec3| *p.iter().max_by(|x, y| x.dot(d).total_cmp(&y.dot(d))).unwrap();
            for d in [Vec3::X, Vec3::Y, Vec3::Z] { println!("{} {}", ext(d), ext(-d)); }
            println!("mass {} tets {}", a.mass.mass, a.fracture.tets.len());
            let d = match args[3].as_str() { "x" => Vec3::X, "-x" => -Vec3::X, "y" => Vec3::Y, "-y" => -Vec3::Y, "z" => Vec3::Z, _ => -Vec3::Z };
            for set in args[4..].chunks(3) {
                let (m, v): (f64, f64) = (set[0].parse().unwrap(), set[1].parse().unwrap());
                let mat = Material::preset(&set[2]).unwrap();
                let s = if m > 0.0 { Striker { restitution: 0.5, ..Striker::ball(&mat, m, 0.03) } } else { Striker::fixed(&mat) };
                show(&format!("{m} kg {v} m/s {}", set[2]), &a, blow(&a, ext(d), -d, v, s), 2, false);
                let c = blow(&a, ext(d), -d, v, s);
                for dt in [1e-3, 1.0/240.0] {
                    let o = rest(&Body::new(Arc::clone(&a), 1).unwrap(), &[Force { point: c.point, force: c.push() / dt as f32 }], Vec3::ZERO, &FractureConfig::as_in_the_paper()).unwrap();
                    println!("   quasi-static {dt}: peak {:.0} bound {:.0} area {:.1} pieces {}", 1e-6 * o.report().peak_stress, 1e-6*o.report().stress_bound, 1e4 * o.report().crack_area, match &o { Outcome::Broke(f) => f.fragments.len(), _ => 1 });
                }
            }
        }
        _ => {}
    }
}
