use std::time::Instant;
use frangible_scenes::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut s = scene(&args[1]).unwrap();
    if let Some(h) = args.get(2).and_then(|h| h.parse::<f64>().ok()) {
        match &mut s.action { Action::Drop { height } => *height = h, Action::Ball(b) => b.speed = h }
    }
    let seeds: u64 = args.get(3).and_then(|h| h.parse().ok()).unwrap_or(1);
    if let Some(a) = args.get(4).and_then(|h| h.parse::<f32>().ok()) {
        s.rotation = frangible::glam::Quat::from_rotation_z(a.to_radians()) * frangible::glam::Quat::from_rotation_x(-1.5707964);
    }
    let t = Instant::now();
    let (asset, r) = bake(&s, &mut |_| {}).unwrap();
    println!("bake {:?} {:?}", t.elapsed(), r);
    for seed in 1..=seeds {
        s.seed = seed;
        let t = Instant::now();
        let run = play(&s, &asset, &mut |_| {}).unwrap();
        println!("seed {seed} play {:?} breaks {} rest {} sim {:.2} rigid {:.2}", t.elapsed(), run.breaks.len(), run.at_rest, run.simulated, run.rigid_seconds);
        if let Some(h) = &run.held { println!("  held {h:?}"); }
        for b in &run.breaks {
            println!("  {:?}", b.report);
            println!("  contacts {:?}", b.contacts);
            println!("  {} pieces, g: {:?}", b.masses.len(), b.masses.iter().map(|m| (m * 1e4).round() / 10.0).collect::<Vec<_>>());
        }
    }
}
