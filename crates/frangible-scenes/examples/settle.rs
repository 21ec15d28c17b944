use frangible::glam::{Quat, Vec3};
use frangible::{Body, Fracture, Material, Outcome};
use frangible_rapier::rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::rapier3d::parry::query;
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};
use frangible_scenes::*;
use std::sync::{Arc, Mutex};

fn far_speed(b: &RigidBody, ext: f32) -> f32 { b.linvel().length() + b.angvel().length() * ext }

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut s = scene(&args[1]).unwrap();
    if let Some(h) = args.get(2).and_then(|h| h.parse::<f64>().ok()) {
        match &mut s.action { Action::Drop { height } => *height = h, Action::Ball(b) => b.speed = h }
    }
    if let Some(a) = args.get(3).and_then(|h| h.parse::<f32>().ok()) {
        s.rotation = Quat::from_rotation_z(a.to_radians()) * Quat::from_rotation_x(-1.5707964);
    }
    let env = |n: &str| std::env::var(n).ok().and_then(|v| v.parse::<f32>().ok());
    let verbose = env("V").is_some();
    let damping = env("DAMP").unwrap_or(0.8);
    s.seed = env("SEED").unwrap_or(1.0) as u64;
    let t = std::time::Instant::now();
    let (asset, _) = bake(&s, &mut |_| {}).unwrap();
    eprintln!("bake {:?}", t.elapsed());
    // several variants share the cached fracture
    let cache: Arc<Mutex<Option<Fracture>>> = Arc::default();
    let variants = std::env::var("VARIANTS").unwrap_or("base".into());
    for variant in variants.split(',') {
        let mut config = WorldConfig::default();
        config.fracture = s.fracture.clone();
        for part in variant.split('+') {
            if let Some((k, v)) = part.split_once('=') {
                let v: f32 = v.parse().unwrap();
                match k { "relax" => config.overlap_relaxation = v, "lu" => config.length_unit = v, "hvr" => config.hull_volume_ratio = v, "arm" => config.rolling_arm = v, "drift" => config.rest_drift = v, "it" => config.solver_iterations = v as usize, _ => {} }
            }
        }
        let mut world = BreakableWorld::new(config).unwrap();
        let c2 = Arc::clone(&cache);
        world.set_break_function(move |b, c, f| {
            let mut lock = c2.lock().unwrap();
            if let Some(f) = &*lock { return Ok(Outcome::Broke(Box::new(f.clone()))); }
            let o = frangible::impact(b, c, f)?;
            if let Outcome::Broke(f) = &o { if f.fragments.len() > 1 { *lock = Some((**f).clone()); } }
            Ok(o)
        });
        for part in variant.split('+') {
            if let Some((k, v)) = part.split_once('=') {
                let v: f32 = v.parse().unwrap();
                let p = &mut world.physics.integration_parameters;
                match k {
                    "sf" => p.contact_softness.natural_frequency *= v,
                    "ssf" => p.static_contact_softness.natural_frequency *= v,
                    "mcv" => p.normalized_max_corrective_velocity = v,
                    "pred" => p.normalized_prediction_distance = v,
                    "clus" => p.contact_clustering = v > 0.0,
                    "coul" => if v > 0.0 { p.friction_model = frangible_rapier::rapier3d::dynamics::FrictionModel::Coulomb },
                    "fbp" => p.friction_in_bias_pass = v > 0.0,
                    "warm" => p.warmstart_coefficient = v,
                    "stab" => p.num_internal_stabilization_iterations = v as usize,
                    _ => {}
                }
            }
        }
        let floor = SurfaceProperties::of(&Material::preset(&s.floor).unwrap(), f32::INFINITY);
        if variant.contains("box") { world.insert_fixed_box(Vector::new(5.0, 0.5, 5.0), Pose::translation(0.0, -0.5, 0.0), floor).unwrap(); } else { world.insert_fixed_half_space(Vector::ZERO, Vector::Y, floor).unwrap(); }
        let lowest = asset.fracture.positions.iter().map(|&p| (s.rotation * p).y).fold(f32::INFINITY, f32::min);
        let (clear, thrown) = match &s.action { Action::Drop { height } => (*height as f32, None), Action::Ball(b) => (1e-4, Some(b.clone())) };
        let centre = Vec3::new(0.0, clear - lowest, 0.0);
        let q = s.rotation;
        let pose = Pose::from_parts(Vector::new(centre.x, centre.y, centre.z), frangible_rapier::rapier3d::math::Rotation::from_xyzw(q.x, q.y, q.z, q.w));
        let handle = world.insert_breakable(Body::new(Arc::clone(&asset), s.seed).unwrap(), pose, Vector::ZERO, Vector::ZERO).unwrap();
        let mut ball_h = None;
        if let Some(b) = &thrown {
            let d = b.toward.normalize();
            let reach = asset.fracture.positions.iter().map(|p| p.length()).fold(0.0, f32::max);
            let r = b.radius as f32;
            let start = centre + b.at - d * (reach + r + (0.1 * b.speed as f32).clamp(0.2, 1.5));
            let surf = SurfaceProperties::of(&Material::preset(&b.material).unwrap(), r);
            let v = d * b.speed as f32;
            ball_h = Some(world.insert_ball(Ball { mass: b.mass as f32, radius: r }, surf, Pose::translation(start.x, start.y, start.z), Vector::new(v.x, v.y, v.z)).unwrap());
        }
        let mut frags: Vec<(RigidBodyHandle, Vec<Vector>)> = vec![(handle, asset.fracture.positions.clone())];
        let mut fine_until = 300usize;
        let mut broke_at = None;
        let mut rest_at = None;
        let mut e_prev = f64::INFINITY;
        let mut e_rise: f64 = 0.0;
        let wall = std::time::Instant::now();
        let maxframes = (env("SECS").unwrap_or(7.0) * 60.0) as usize;
        let total_e = |w: &BreakableWorld| w.kinetic_energy() + w.physics.bodies.iter().filter(|(_, b)| b.is_dynamic()).map(|(_, b)| f64::from(b.mass() * 9.81 * b.center_of_mass().y)).sum::<f64>();
        for frame in 1..=maxframes {
            let steps = if frame <= fine_until { 64 } else { 4 };
            world.physics.integration_parameters.dt = 1.0 / (60.0 * steps as f32);
            for _ in 0..steps {
                let speeds: Vec<f32> = world.physics.bodies.iter().filter(|(_, b)| b.is_dynamic()).map(|(_, b)| b.linvel().length()).collect();
                let events: Vec<_> = world.step().unwrap().to_vec();
                for e in events {
                    fine_until = frame + 2;
                    broke_at = Some(frame as f32 / 60.0);
                    frags = e.fragments.iter().zip(&e.fracture.fragments).map(|(&h, f)| (h, f.mesh.positions.clone())).collect();
                    let mut v: Vec<(f32, f32)> = e.fragments.iter().filter_map(|&h| world.physics.bodies.get(h)).map(|b| (b.linvel().length(), b.mass() * 1e3)).collect();
                    v.sort_by(|a, b| b.0.total_cmp(&a.0));
                    println!("[{variant}] broke frame {frame} into {} ({} debris); speed before {:.2?}, fastest after (m/s, g) {:.2?}", frags.len(), world.debris().count(), speeds.iter().copied().fold(0.0, f32::max), &v[..v.len().min(5)]);
                    e_prev = total_e(&world);
                }
                let e = total_e(&world);
                if broke_at.is_some() && e > e_prev { e_rise += e - e_prev; }
                e_prev = e;
            }
            for (_, b) in world.physics.bodies.iter_mut() { b.set_angular_damping(damping); }
            if broke_at.is_none() && frame as f32 / 60.0 > 1.6 { fine_until = 0; }
            let since = frame as f32 / 60.0 - broke_at.unwrap_or(0.0);
            if verbose && frame % 30 == 0 || frame == maxframes {
                let mut awake: Vec<_> = frags.iter().filter_map(|(h, p)| { let b = world.physics.bodies.get(*h)?; (!b.is_sleeping()).then(|| { let ext = p.iter().map(|p| p.length()).fold(0.0, f32::max); (far_speed(b, ext), b, ext, *h) }) }).collect();
                awake.sort_by(|a, b| b.0.total_cmp(&a.0));
                let quick = awake.iter().filter(|a| a.0 > 0.005).count();
                println!("[{variant}] t+{since:.2}: awake {} quick {quick} ball {:?}", awake.len(), ball_h.map(|b| { let b = &world.physics.bodies[b]; (b.linvel().length(), b.is_sleeping()) }));
                for (sp, b, ext, h) in awake.iter().take(if frame == maxframes { 8 } else { 4 }) {
                    let c = &world.physics.colliders[b.colliders()[0]];
                    let nc = world.physics.narrow_phase.contact_pairs_with(b.colliders()[0]).filter(|p| p.has_any_active_contact()).count();
                    println!("    {h:?} m {:.3} g ext {:.1} mm far {:.4} lin {:.4} ang {:.3} wdir {:.2?} y {:.4} {:?} contacts {nc} still {:.2}", b.mass() * 1e3, ext * 1e3, sp, b.linvel().length(), b.angvel().length(), b.angvel().normalize_or_zero(), b.translation().y, c.shape().shape_type(), b.activation().time_since_can_sleep);
                }
            }
            if world.at_rest() { rest_at = Some(since); break; }
        }
        // Geometry at the end.
        let floor_c = world.physics.colliders.iter().find(|(_, c)| world.physics.bodies[c.parent().unwrap()].is_fixed()).unwrap().0;
        let mut floor_pen: f32 = 0.0; let mut mesh_low: (f32, f32) = (0.0, 0.0);
        let mut pair_pen: Vec<(f32, f32, f32)> = vec![];
        let mut hover: Vec<(f32, f32, usize)> = vec![];
        let bodies: Vec<_> = frags.iter().filter_map(|(h, p)| world.physics.bodies.get(*h).map(|b| (b, p))).collect();
        let fc = &world.physics.colliders[floor_c];
        for (i, (b, p)) in bodies.iter().enumerate() {
            let c = &world.physics.colliders[b.colliders()[0]];
            let low = p.iter().map(|&p| (*b.position() * p).y).fold(f32::INFINITY, f32::min);
            if low < mesh_low.0 { mesh_low = (low, b.mass() * 1e3); }
            let mut gap = low.max(0.0);
            if let Ok(Some(k)) = query::contact(c.position(), c.shape(), fc.position(), fc.shape(), 0.01) { floor_pen = floor_pen.min(k.dist); gap = gap.min(k.dist.max(0.0)); }
            let cgap_floor = query::contact(c.position(), c.shape(), fc.position(), fc.shape(), 0.02).ok().flatten().map_or(9.0, |k| k.dist);
            let mut near: f32 = cgap_floor; let mut touching = 0;
            for (j, (b2, _)) in bodies.iter().enumerate() {
                if i == j { continue; }
                let c2 = &world.physics.colliders[b2.colliders()[0]];
                if !c.compute_aabb().mins.cmple(c2.compute_aabb().maxs + Vector::splat(0.01)).all() || !c2.compute_aabb().mins.cmple(c.compute_aabb().maxs + Vector::splat(0.01)).all() { continue; }
                if let Ok(Some(k)) = query::contact(c.position(), c.shape(), c2.position(), c2.shape(), 0.002) {
                    near = near.min(k.dist);
                    if k.dist < 5e-4 { touching += 1; }
                    if i < j && k.dist < 0.0 { pair_pen.push((k.dist * 1e3, b.mass() * 1e3, b2.mass() * 1e3)); }
                }
            }
            if low > 0.0015 && near > 1e-3 || low > 0.0015 && cgap_floor < 1e-3 && touching == 0 { hover.push((low * 1e3, b.mass() * 1e3, touching)); }
        }
        pair_pen.sort_by(|a, b| a.0.total_cmp(&b.0));
        hover.sort_by(|a, b| b.0.total_cmp(&a.0));
        let nd = pair_pen.iter().filter(|p| p.0 < -1.0).count();
        let far = bodies.iter().map(|(b, _)| b.translation().length()).fold(0.0, f32::max);
        println!("[{variant}] REST {rest_at:?} wall {:.1?} rise {:.2e} J | floor pen {:.2} mm, mesh below floor {:.2} mm ({:.3} g), pairs>1mm {nd}/{} worst {:.2?}, hovering {} {:.2?}, farthest {:.2} m", wall.elapsed(), e_rise, floor_pen * 1e3, mesh_low.0 * 1e3, mesh_low.1, pair_pen.len(), &pair_pen[..pair_pen.len().min(3)], hover.len(), &hover[..hover.len().min(4)], far);
    }
}
