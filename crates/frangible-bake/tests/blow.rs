//! Blows on plates and blocks, integrated against the body, beside closed forms.

use std::f64::consts::PI;

use frangible::blow::Blow;
use frangible::glam::{DVec3, Vec3};
use frangible::near_field::PlateTheory;
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};

const SIDE: f64 = 0.1;
const THICKNESS: f64 = 1e-3;

fn pmma() -> Material {
    let mut material = Material::preset("glass").unwrap();
    (material.youngs_modulus, material.poisson_ratio) = (3.3e9, 0.37);
    material.density = 1180.0;
    (material.stiffness_damping, material.mass_damping) = (0.0, 0.0);
    // Every tetrahedron is a weak point: stresses are looked at everywhere.
    material.weak_point_density = 1e15;
    material
}

/// A plate of PMMA, 100 × 100 × 1 mm, held across at its edges.
fn supported_plate(modes: usize) -> Body {
    let edge = |axis: usize, sign: f64| {
        let mut normal = DVec3::ZERO;
        normal[axis] = sign;
        Support {
            region: Region::HalfSpace {
                point: DVec3::splat(if sign > 0.0 { SIDE } else { 0.0 }),
                normal: -normal,
            },
            axes: [false, false, true],
        }
    };
    let spec = BakeSpec {
        modes,
        analysis: Some(MeshSize {
            edge: 0.003,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.001,
            layers: 1,
        }),
        supports: vec![edge(0, 1.0), edge(0, -1.0), edge(1, 1.0), edge(1, -1.0)],
        ..BakeSpec::new("plate", Shape::plate(SIDE, SIDE, THICKNESS), pmma())
    };
    let asset = bake(&spec, &mut |_| {}).unwrap().0;
    println!("f1 {}", asset.modes.frequency(0));
    Breakable::new(asset).unwrap().body(1)
}

fn ball(speed: f32, radius: f64, mass: f64) -> Contact {
    let steel = Material::preset("steel").unwrap();
    let striker = Striker::ball(&steel, mass, radius);
    Contact::new(
        Vec3::new(0.0, 0.0, 0.0005),
        Vec3::NEG_Z,
        0.0,
        speed,
        striker,
    )
}

/// Curvatures along x and y of a simply supported plate at points along x from its middle, of all its modes: theory of thin plates, a
/// force that is linear between samples `step` apart, spread as Hertz' pressure on a disc.
fn series(force: &[f32], step: f64, radius: f64, points: &[f64]) -> Vec<[f64; 2]> {
    let m = pmma();
    let d = m.youngs_modulus * THICKNESS.powi(3) / 12.0 / (1.0 - m.poisson_ratio.powi(2));
    let mu = m.density * THICKNESS;
    let mut sums = vec![[0.0; 2]; points.len()];
    for i in (1..420).step_by(2) {
        for j in (1..420).step_by(2) {
            let (a, b) = (f64::from(i) * PI / SIDE, f64::from(j) * PI / SIDE);
            let k2 = a * a + b * b;
            let w = k2 * (d / mu).sqrt();
            let x = k2.sqrt() * radius;
            let spread = 3.0 * (x.sin() - x * x.cos()) / x.powi(3);
            let (mut q, mut v, mut f) = (0.0, 0.0, 0.0);
            let (sin, cos) = (w * step).sin_cos();
            for &next in force {
                let (next, slope) = (f64::from(next), (f64::from(next) - f) / step);
                // About f/w² + slope t/w².
                let (e, g) = (q - f / (w * w), v - slope / (w * w));
                q = next / (w * w) + e * cos + g / w * sin;
                v = slope / (w * w) - e * w * sin + g * cos;
                f = next;
            }
            let at = |p: f64| (a * (SIDE / 2.0 + p)).sin() * (b * SIDE / 2.0).sin();
            let amplitude = 4.0 / (SIDE * SIDE * mu) * at(0.0) * spread * q;
            for (sum, &p) in sums.iter_mut().zip(points) {
                sum[0] += amplitude * a * a * at(p);
                sum[1] += amplitude * b * b * at(p);
            }
        }
    }
    sums
}

#[test]
fn look() {
    let m = pmma();
    let d = m.youngs_modulus * THICKNESS.powi(3) / 12.0 / (1.0 - m.poisson_ratio.powi(2));
    println!(
        "expected f1 {}",
        2.0 * (PI / SIDE).powi(2) * (d / (m.density * THICKNESS)).sqrt() / 2.0 / PI
    );
    let modes: usize = std::env::var("MODES").map_or(100, |m| m.parse().unwrap());
    let body = supported_plate(modes);
    for theory in [PlateTheory::Kirchhoff, PlateTheory::Layer] {
        let mut config = FractureConfig::default();
        config.near_field = Some(theory);
        for v in [20.0, 80.0] {
            let t = std::time::Instant::now();
            let blow = Blow::new(&body, &[ball(v, 2e-3, 2.6e-4)], &config)
                .unwrap()
                .unwrap();
            let time = t.elapsed();
            let r = &blow.reports()[0];
            println!(
                "{theory:?} {v} m/s: {:?} peak {} N, {} us, a {} mm, e {}, energies {:?}, step {} steps {}",
                time,
                r.peak_force,
                1e6 * r.duration,
                1e3 * r.contact_radius,
                r.departure_speed / f64::from(v),
                blow.energies(),
                blow.time_step(),
                r.force.len()
            );
            for t in [1e-5, 3e-5, 6e-5, 1e-4] {
                let i = (t / blow.time_step()) as usize;
                print!("{} ", r.force.get(i).copied().unwrap_or(0.0));
            }
            println!();
            let mesh = &body.asset().fracture;
            for step in [10, 20, 30] {
                println!("t {}", blow.time_step() * (step + 1) as f64);
                for target in [0.0, 1e-3, 2e-3, 4e-3, 8e-3, 16e-3] {
                    let tet = body
                        .weak_tets()
                        .iter()
                        .copied()
                        .filter(|&e| mesh.centroid(e as usize).z < -0.0001)
                        .min_by_key(|&e| {
                            let d = mesh.centroid(e as usize) - Vec3::new(target, 0.0, -0.0004);
                            (d.length() * 1e9) as i64
                        })
                        .unwrap();
                    let s = blow.stress(&body, tet, step, &config);
                    // along local
                    let c = mesh.centroid(tet as usize);
                    let surf = body
                        .asset()
                        .surface
                        .tets
                        .iter()
                        .position(|&t| t == tet)
                        .map(|t| {
                            let p = body.asset().surface.triangles[t]
                                .map(|v| mesh.positions[v as usize]);
                            (p[0] + p[1] + p[2]) / 3.0
                        })
                        .unwrap_or(c);
                    let r0 = surf.truncate().length() as f64;
                    let truth =
                        series(&r.force[..=step], blow.time_step(), r.contact_radius, &[r0])[0];
                    let bend = |a: f64, b: f64| {
                        d * (a + m.poisson_ratio * b) * 6.0 / THICKNESS.powi(2) / 1e6
                    };
                    let tr = s.diagonal[0] + s.diagonal[1];
                    println!(
                        "  at r {:.5}: sum {:.1} series {:.1}   (rr {:.1} tt {:.1})",
                        r0,
                        tr / 1e6,
                        bend(truth[0], truth[1]) + bend(truth[1], truth[0]),
                        s.diagonal[0] / 1e6,
                        s.diagonal[1] / 1e6
                    );
                }
            }
        }
    }
}
