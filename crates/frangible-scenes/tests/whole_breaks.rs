//! Whole breaks: what must hold of every one of them.

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use crate::common::{block, corner_hit, glass, mean, pane, pane_hit, rim_hit, strike};
use frangible::glam::Vec3;
use frangible::{Asset, Breakable, Contact, Fracture, FractureConfig, Outcome, TriMesh, impact};
use frangible_scenes::{bake, breakable, first_break, scene};

type Case = (&'static str, &'static Arc<Asset>, Contact);

fn cases() -> Vec<Case> {
    vec![
        ("glass, rim", glass(), rim_hit(20.0, 6.0)),
        ("glass, rim, hard", glass(), rim_hit(200.0, 15.0)),
        ("pane, middle", pane(), pane_hit(0.0, 0.0, 12.0)),
        ("pane, off the middle", pane(), pane_hit(0.08, -0.05, 20.0)),
        ("block, corner", block(), corner_hit(8.0)),
    ]
}

fn models() -> [(&'static str, FractureConfig); 2] {
    [
        ("ours", FractureConfig::default()),
        ("paper", FractureConfig::as_in_the_paper()),
    ]
}

/// A break, with its name and its asset.
type Break = (String, &'static Arc<Asset>, Box<Fracture>);

/// Looks at every break of the cases above, for three seeds and both models.
fn breaks(mut look: impl FnMut(&str, &Arc<Asset>, &Fracture)) {
    static BREAKS: OnceLock<Vec<Break>> = OnceLock::new();
    let all = BREAKS.get_or_init(|| {
        let mut broke = Vec::new();
        for (name, asset, contact) in cases() {
            for (model, config) in models() {
                for seed in 1..=3 {
                    if let Outcome::Broke(f) =
                        strike(asset, seed, std::slice::from_ref(&contact), &config)
                    {
                        broke.push((format!("{name}, {model}, seed {seed}"), asset, f));
                    }
                }
            }
        }
        broke
    });
    assert!(
        all.len() > 15,
        "only {} of 30 blows break anything",
        all.len()
    );
    for (name, asset, fracture) in all {
        look(name, asset, fracture);
    }
}

/// Directed edges that do not occur as often as their opposites.
fn unmatched_edges(mesh: &TriMesh) -> usize {
    let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (i, j) in [(a, b), (b, c), (c, a)] {
            *balance.entry((i.min(j), i.max(j))).or_default() += if i < j { 1 } else { -1 };
        }
    }
    balance.values().filter(|&&n| n != 0).count()
}

#[test]
fn fragments_tile_the_body() {
    let (mut count, mut pinched, mut worst, mut worst_f32) = (0, 0, 0.0_f64, 0.0_f64);
    breaks(|name, asset, fracture| {
        let body = asset.mass().volume;
        let sum: f64 = fracture.fragments.iter().map(|f| f.mass.volume).sum();
        let emitted: f64 = fracture.fragments.iter().map(|f| f.mesh.volume()).sum();
        let mass: f64 = fracture.fragments.iter().map(|f| f.mass.mass).sum();
        worst = worst.max((sum / body - 1.0).abs());
        worst_f32 = worst_f32.max((emitted / body - 1.0).abs());
        assert!(
            (sum / body - 1.0).abs() < 1e-9,
            "{name}: volumes sum to {sum}, not {body}"
        );
        assert!(
            (emitted / body - 1.0).abs() < 1e-6,
            "{name}: meshes enclose {emitted}, not {body}"
        );
        assert!(
            (mass / asset.mass().mass - 1.0).abs() < 1e-9,
            "{name}: {mass} kg, not {}",
            asset.mass().mass
        );
        assert!(fracture.report.volume_error.abs() < 1e-9);
        assert!(fracture.fragments.len() > 1, "{name}");
        for (i, f) in fracture.fragments.iter().enumerate() {
            assert!(
                f.mass.volume > 0.0 && f.mesh.volume() > 0.0,
                "{name}: piece {i} is turned inside out"
            );
            assert_eq!(unmatched_edges(&f.mesh), 0, "{name}: piece {i} is open");
            assert!(
                f.mesh
                    .triangles
                    .iter()
                    .flatten()
                    .all(|&v| (v as usize) < f.mesh.positions.len())
            );
            assert_eq!(f.mesh.normals.len(), f.mesh.triangles.len());
            count += 1;
            pinched += usize::from(!f.mesh.is_closed());
        }
    });
    println!(
        "{count} pieces, {pinched} touch themselves along an edge; volume {worst:.1e}, emitted {worst_f32:.1e}"
    );
    assert_eq!(
        pinched, 0,
        "pieces touch themselves along an edge, of {count}"
    );
}

#[test]
fn a_soft_hit_holds_and_a_harder_one_cracks_more() {
    for (model, config) in models() {
        for seed in 1..=5 {
            for (asset, contact) in [
                (glass(), rim_hit(20.0, 0.2)),
                (pane(), pane_hit(0.0, 0.0, 0.3)),
                (block(), corner_hit(0.1)),
            ] {
                let outcome = strike(asset, seed, std::slice::from_ref(&contact), &config);
                assert!(
                    matches!(outcome, Outcome::Held { .. }),
                    "{}, {model}, seed {seed}",
                    asset.name()
                );
                assert_eq!(
                    outcome.report().cracks,
                    0,
                    "{}, {model}, seed {seed}",
                    asset.name()
                );
            }
        }
        let series = |f: &dyn Fn(u64, f64) -> f64, speeds: &[f64]| -> Vec<f64> {
            speeds.iter().map(|&v| mean(5, |seed| f(seed, v))).collect()
        };
        let of = |asset: &'static Arc<Asset>, hit: fn(f64) -> Contact| {
            let config = config.clone();
            move |seed: u64, v: f64| {
                1e4 * strike(asset, seed, &[hit(v)], &config).report().crack_area
            }
        };
        let rim = series(&of(glass(), |v| rim_hit(20.0, v)), &[2.0, 5.0, 10.0]);
        let corner = series(&of(block(), corner_hit), &[1.0, 4.0, 8.0, 16.0]);
        println!("{model}: crack area, cm²: glass {rim:.1?}, block {corner:.1?}");
        for areas in [rim, corner] {
            // Of five bodies the mean is off by some per cent.
            let grows = areas.windows(2).all(|w| w[1] >= 0.9 * w[0]);
            let [first, .., last] = areas[..] else {
                panic!()
            };
            assert!(grows && last > 2.0 * first, "{model}: {areas:?} cm²");
        }
    }
}

/// From 10 m/s on the areas of single glasses scatter more than they grow: twenty of them.
#[test]
fn a_hit_at_20_m_s_cracks_the_glass_more_than_one_at_10() {
    for (model, config) in models() {
        let [slow, fast] = [10.0, 20.0].map(|v| {
            let hit = rim_hit(20.0, v);
            1e4 * mean(20, |seed| {
                strike(glass(), seed, std::slice::from_ref(&hit), &config)
                    .report()
                    .crack_area
            })
        });
        println!("{model}: glass at 10 and 20 m/s, crack area: {slow:.1}, {fast:.1} cm²");
        assert!(fast > slow, "{model}: {slow:.1}, {fast:.1} cm²");
    }
}

fn pane_areas(config: &FractureConfig) -> [f64; 4] {
    let areas = [2.0, 6.0, 15.0, 30.0].map(|v| {
        let hit = pane_hit(0.0, 0.0, v);
        1e4 * mean(5, |seed| {
            strike(pane(), seed, std::slice::from_ref(&hit), config)
                .report()
                .crack_area
        })
    });
    println!("pane at 2, 6, 15, 30 m/s, crack area in cm²: {areas:.1?}");
    areas
}

#[test]
fn a_harder_hit_cracks_the_pane_more() {
    let areas = pane_areas(&FractureConfig::default());
    // A star under the ball, which parts little.
    assert!(areas[0] < 0.15 * areas[3], "{areas:.1?} cm²");
    assert!(areas.windows(2).all(|w| w[1] > w[0]), "{areas:.1?} cm²");
}

/// Known deviation: a harder hit should crack more. In the paper's model, where no crack relieves another, 15 m/s cut the whole pane at
/// once, and 30 m/s cannot cut more.
#[test]
fn a_harder_hit_cuts_the_whole_pane_at_once_in_the_papers_model() {
    let areas = pane_areas(&FractureConfig::as_in_the_paper());
    assert!(areas[1] <= areas[2], "{areas:.1?} cm²");
    assert!((areas[3] / areas[2] - 1.0).abs() < 0.1, "{areas:.1?} cm²");
}

/// Share of the crack faces' area that lies more than 30° askew in the pane.
fn askew(config: &FractureConfig) -> f64 {
    let (mut all, mut flat) = (0.0, 0.0);
    for (seed, speed) in [(1, 8.0), (2, 12.0), (3, 12.0), (4, 20.0)] {
        let outcome = strike(pane(), seed, &[pane_hit(0.03, 0.02, speed)], config);
        let Outcome::Broke(fracture) = outcome else {
            panic!("the pane holds, seed {seed}")
        };
        for f in &fracture.fragments {
            for triangle in &f.mesh.triangles[f.mesh.outer_triangles..] {
                let [a, b, c] = triangle.map(|v| f.mesh.positions[v as usize]);
                let across = (b - a).cross(c - a);
                all += f64::from(across.length());
                flat += f64::from(if 2.0 * across.z.abs() > across.length() {
                    across.length()
                } else {
                    0.0
                });
            }
        }
    }
    flat / all
}

#[test]
fn cracks_stand_upright_in_a_pane() {
    let ours = askew(&FractureConfig::default());
    println!("crack area more than 30° askew: {ours:.3}");
    // The tension across a crack feeds it, which hardly feeds one that lies askew. Of faces in all directions it would be half.
    assert!(ours < 0.2, "{ours}");
}

/// Share of the crack faces' area between 60 and 190 mm from the blow whose normals lie within 45° of the direction around it, in panes that
/// are hit in their middle: cracks that run away from the blow.
fn arms(pane: &Breakable, hit: &Contact, speed: f32) -> f64 {
    let (mut all, mut away) = (0.0, 0.0);
    let hit = Contact {
        approach_speed: speed,
        ..hit.clone()
    };
    for seed in 1..=6 {
        let hit = std::slice::from_ref(&hit);
        let outcome = impact(&pane.body(seed), hit, &FractureConfig::default()).unwrap();
        let Outcome::Broke(fracture) = outcome else {
            panic!("the pane holds, seed {seed}")
        };
        for f in &fracture.fragments {
            let centre = f.mass.centre.as_vec3();
            for triangle in &f.mesh.triangles[f.mesh.outer_triangles..] {
                let [a, b, c] = triangle.map(|v| f.mesh.positions[v as usize] + centre);
                let across = (b - a).cross(c - a);
                let out = ((a + b + c) / 3.0 - hit[0].point).reject_from(hit[0].normal);
                if !(0.06..0.19).contains(&out.length()) {
                    continue;
                }
                let around = hit[0].normal.cross(out).normalize();
                all += f64::from(across.length());
                if across.normalize_or_zero().dot(around).abs() > 0.707 {
                    away += f64::from(across.length());
                }
            }
        }
    }
    away / all
}

#[test]
fn a_pane_that_is_hit_hard_has_a_star_whose_arms_run_through_the_rings() {
    let scene = scene("pane").unwrap();
    let bodies = bake(&scene).unwrap();
    let first = first_break(&scene, &bodies, &mut |_| {}).unwrap().unwrap();
    let pane = breakable(&scene.bodies[0], first.body.asset()).unwrap();
    let [slow, fast] = [10.0, 20.0].map(|speed| arms(&pane, &first.contacts[0], speed));
    println!("cracks that run away from the blow: {slow:.2} at 10 m/s, {fast:.2} at 20 m/s");
    // At 20 m/s rings have part of the cracks, nearer to the blow a quarter: `docs/real-breaks.md`.
    assert!(slow > 0.9 && fast > 0.35, "{slow} {fast}");
}

/// Mean place of the crack faces, weighted by area, body frame, m, and the least distance of any to `point`.
fn crack_place(fracture: &Fracture, point: Vec3) -> (Vec3, f32) {
    let (mut sum, mut area, mut nearest) = (Vec3::ZERO, 0.0, f32::INFINITY);
    for f in &fracture.fragments {
        let centre = f.mass.centre.as_vec3();
        for triangle in &f.mesh.triangles[f.mesh.outer_triangles..] {
            let [a, b, c] = triangle.map(|v| f.mesh.positions[v as usize] + centre);
            let w = 0.5 * (b - a).cross(c - a).length();
            let middle = (a + b + c) / 3.0;
            sum += w * middle;
            area += w;
            nearest = nearest.min(middle.distance(point));
        }
    }
    (sum / area, nearest)
}

#[test]
fn cracks_follow_the_point_of_impact() {
    let config = FractureConfig::default();
    for seed in 1..=4 {
        let place = |x: f32, y: f32| {
            let contact = pane_hit(x, y, 15.0);
            let outcome = strike(pane(), seed, std::slice::from_ref(&contact), &config);
            let Outcome::Broke(fracture) = outcome else {
                panic!("the pane holds at ({x}, {y}), seed {seed}")
            };
            let first = fracture.report.first_crack_point.unwrap();
            let (middle, nearest) = crack_place(&fracture, contact.point);
            println!(
                "seed {seed}, hit ({x}, {y}): first {first:.3}, mean {middle:.3}, nearest {:.1} mm",
                1e3 * nearest
            );
            (first, middle, nearest)
        };
        let (left, right) = (place(-0.08, 0.0), place(0.08, 0.0));
        assert_ne!(
            left.0, right.0,
            "seed {seed}: the first crack stays where it was"
        );
        assert!(
            left.1.distance(right.1) > 0.002,
            "seed {seed}: the cracks stay at {} and {}",
            left.1,
            right.1
        );
        assert!(
            right.0.x > left.0.x + 0.1,
            "seed {seed}: the first crack does not follow the impact"
        );
        assert!(
            left.2 < 0.03 && right.2 < 0.03,
            "seed {seed}: nothing cracks within 30 mm of the impact"
        );
    }
}

#[test]
fn equivalent_points_of_the_rim_break_alike() {
    for (model, config) in models() {
        let area = |degrees: f32| {
            1e4 * mean(6, |seed| {
                strike(glass(), seed, &[rim_hit(degrees, 10.0)], &config)
                    .report()
                    .crack_area
            })
        };
        let areas = [0.0, 90.0, 180.0, 270.0].map(area);
        println!("{model}: crack area at four rim points {areas:.1?} cm²");
        let low = areas.iter().copied().fold(f64::MAX, f64::min);
        let high = areas.iter().copied().fold(0.0, f64::max);
        assert!(low > 0.0 && high < 2.0 * low, "{model}: {areas:?} cm²");
    }
}

#[test]
fn a_fast_ball_cuts_a_plug_out_and_keeps_most_of_its_speed() {
    let kind = Breakable::uniform(Arc::clone(pane())).unwrap();
    let hit = [pane_hit(0.0, 0.0, 40.0)];
    let config = FractureConfig::default();
    let outcome = impact(&kind.body(1), &hit, &config).unwrap();
    let strong = kind.body(1).strengthened(1e3);
    let whole = impact(&strong, &hit, &config).unwrap();
    let [cut, held] = [&outcome, &whole].map(|o| o.report().contacts[0].clone());
    println!(
        "{:.0} µs, {:.2} N·s, leaves at {:.1} m/s; a pane that holds: {:.0} µs, {:.2} N·s, {:.1} m/s",
        1e6 * cut.duration,
        cut.impulse,
        cut.departure_speed,
        1e6 * held.duration,
        held.impulse,
        held.departure_speed
    );
    assert!(matches!(outcome, Outcome::Broke(_)));
    // The wall under the ball is gone long before the ball would have come to rest.
    assert!(cut.duration < 0.2 * held.duration && cut.impulse < 0.5 * held.impulse);
    assert!(cut.departure_speed < -20.0, "{}", cut.departure_speed);
}

#[test]
fn what_a_dropped_plate_has_lost_comes_to_rest() {
    let scene = scene("plate").unwrap();
    let bodies = bake(&scene).unwrap();
    let first = first_break(&scene, &bodies, &mut |_| {}).unwrap().unwrap();
    let kind = breakable(&scene.bodies[0], first.body.asset()).unwrap();
    let broken: Vec<(usize, f64)> = (1..=4)
        .map(|seed| {
            let outcome = impact(&kind.body(seed), &first.contacts, &first.config).unwrap();
            let Outcome::Broke(fracture) = outcome else {
                panic!("seed {seed} holds");
            };
            let cuts = fracture.report.arrivals.iter().flatten();
            let last = cuts.map(|(_, time)| *time).fold(0.0, f64::max);
            (fracture.fragments.len(), last)
        })
        .collect();
    println!("pieces, and the last cut, s: {broken:?}");
    // If the whole plate's modes go on in all pieces, there are 233 to 313 pieces. The rest of the plate rings on, and cracks late.
    for (pieces, last) in broken {
        assert!(pieces < 150 && last < 4e-3, "{pieces} pieces, {last} s");
    }
}
