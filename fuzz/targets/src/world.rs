//! A world of breakable bodies lives through whatever a game does to it: no panic, finite poses, no mass made or lost.

use frangible::{Striker, impact};
use frangible_bake::pieces::{Method, Pieces};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{
    Ball, BreakableWorld, Breaking, ColliderDetail, Mortar, SavedWorld, SurfaceProperties,
    WorldConfig,
};

use crate::bodies::{Kinds, kinds, small_kinds};
use crate::draw::Draw;

/// Steps of one input.
const STEPS: usize = 30;
/// Most deeds per input.
const DEEDS: usize = 24;
/// Bodies in the world, so that one input ends soon.
const BODIES: usize = 80;

/// Contacts of one blow that count where bodies strike each other. Each of those vibrates by itself, and the time that a blow takes grows
/// faster than the square of their number: 35 take half a minute here.
const CONTACTS: usize = 6;

fn config(draw: &mut Draw<'_>) -> WorldConfig {
    let mut config = match draw.below(3) {
        0 => WorldConfig::default(),
        1 => WorldConfig::for_games(),
        _ => WorldConfig::plain(),
    };
    config.max_bodies = BODIES;
    // A step that waits for other threads takes longer where other programs run.
    if let Breaking::AfterStep { delay, .. } = &mut config.breaking {
        *delay = draw.below(3);
    }
    if draw.flag() {
        return config;
    }
    config.gravity = vector(draw, 20.0);
    config.dt = draw.size(1e-4, 0.03) as f32;
    config.length_unit = draw.size(0.02, 1.0) as f32;
    config.solver_iterations = draw.below(9);
    config.max_speed = draw.size(10.0, 1e3) as f32;
    config.impact_speed = draw.size(0.05, 5.0) as f32;
    config.merge_distance = draw.size(1e-5, 0.01) as f32;
    config.hull_volume_ratio = draw.size(1.0, 4.0) as f32;
    for detail in [&mut config.whole_collider, &mut config.fragment_collider] {
        *detail = ColliderDetail {
            parts: draw.below(20),
            hull_points: draw.below(64),
        };
    }
    config.overlap_relaxation = draw.between(0.0, 0.1) as f32;
    config.rolling_arm = draw.between(0.0, 0.01) as f32;
    config.rest_drift = draw.between(0.0, 0.01) as f32;
    config.joint_reach = draw.between(0.0, 0.05) as f32;
    config.debris_mass = draw.between(0.0, 0.01) as f32;
    config.dust_mass = draw.between(0.0, 0.001) as f32;
    config.max_debris = draw.below(64);
    config.resting_loads = !draw.flag();
    config.record_held = draw.flag();
    config.breaking = match draw.below(3) {
        0 => Breaking::InsideStep,
        _ => Breaking::AfterStep {
            budget: draw.size(1.0, 1e5) as usize,
            delay: draw.below(4),
        },
    };
    config.pieces.generations = draw.below(4) as u32;
    config.pieces.least_mass = draw.between(0.0, 0.05) as f32;
    config.pieces.least_tets = draw.below(256);
    config.pieces.delay = draw.between(0.0, 0.05) as f32;
    config.pieces.later = draw.between(0.0, 0.1) as f32;
    config.pieces.cracked = draw.flag();
    config.pieces.pace = draw.size(0.01, 10.0) as f32;
    config.fracture = draw.fracture();
    config
}

fn vector(draw: &mut Draw<'_>, most: f64) -> Vector {
    Vector::from_array(draw.vector(most).to_array())
}

fn pose(draw: &mut Draw<'_>) -> Pose {
    let at = vector(draw, 0.5);
    if draw.flag() {
        let [x, y, z] = draw.vector(1.0).to_array();
        let w = draw.between(-1.0, 1.0) as f32;
        let turn = Rotation::from_xyzw(x, y, z, w);
        // One that cannot be made a unit quaternion stays, and is refused.
        let unit = turn.normalize();
        return Pose::from_parts(at, if unit.is_finite() { unit } else { turn });
    }
    Pose::from_translation(at)
}

fn surface(draw: &mut Draw<'_>) -> SurfaceProperties {
    match draw.below(4) {
        0 => SurfaceProperties::STONE,
        1 => SurfaceProperties::STEEL,
        2 => SurfaceProperties::WOOD,
        _ => SurfaceProperties {
            contact_modulus: draw.size(1e6, 1e12) as f32,
            restitution: draw.between(0.0, 1.0) as f32,
            friction: draw.between(0.0, 2.0) as f32,
            curvature_radius: draw.size(1e-4, 10.0) as f32,
            crushing_pressure: draw.size(1e5, 1e12) as f32,
        },
    }
}

/// A world, the bodies in it, and a saved state.
struct Play {
    kinds: &'static Kinds,
    world: BreakableWorld,
    bodies: Vec<RigidBodyHandle>,
    /// Mass of all bodies that were put in and not taken out, kg; of those that never move it is 0.
    mass: f64,
    /// True if debris and dust disappear by themselves.
    loses: bool,
    /// True if there may be more than one breakable body.
    several: bool,
    saved: Option<(SavedWorld, Vec<RigidBodyHandle>, f64)>,
    steps: usize,
}

impl Play {
    fn any_body(&self, draw: &mut Draw<'_>) -> RigidBodyHandle {
        match self.bodies.len() {
            0 => RigidBodyHandle::from_raw_parts(u32::from(draw.byte()), 0),
            count => self.bodies[draw.below(count)],
        }
    }

    /// One thing that a game does. Errors are answers.
    fn deed(&mut self, draw: &mut Draw<'_>) {
        let world = &mut self.world;
        match draw.below(16) {
            0..=2 if self.several || world.breakables().next().is_none() => {
                let body = self.kinds[draw.below(3)].body(u64::from(draw.byte()));
                let mass = body.asset().mass().mass;
                let (pose, moves, spins) = (pose(draw), vector(draw, 15.0), vector(draw, 10.0));
                if let Ok(handle) = world.insert(
                    body,
                    RigidBodyBuilder::dynamic()
                        .pose(pose)
                        .linvel(moves)
                        .angvel(spins),
                ) {
                    self.bodies.push(handle);
                    self.mass += mass;
                }
            }
            3 => {
                let ball = Ball {
                    mass: draw.size(0.01, 2.0) as f32,
                    radius: draw.size(5e-3, 0.1) as f32,
                };
                let (surface, pose, moves) = (surface(draw), pose(draw), vector(draw, 30.0));
                if let Ok(handle) = world.insert_ball(ball, surface, pose, moves) {
                    self.bodies.push(handle);
                    self.mass += f64::from(ball.mass);
                }
            }
            4 => {
                let half = vector(draw, 0.3).abs();
                let mass = draw.size(0.01, 2.0) as f32;
                let shape = SharedShape::cuboid(half.x, half.y, half.z);
                let (surface, pose, moves) = (surface(draw), pose(draw), vector(draw, 30.0));
                if let Ok(handle) = world.insert_rigid(shape, mass, surface, pose, moves) {
                    self.bodies.push(handle);
                    self.mass += f64::from(mass);
                }
            }
            5 => {
                let (half, pose) = (vector(draw, 1.0).abs(), pose(draw));
                let _ = world.insert_fixed_box(half, pose, surface(draw));
            }
            6 => {
                let (point, normal) = (vector(draw, 0.3), vector(draw, 1.0));
                let _ = world.insert_fixed_half_space(point, normal, surface(draw));
            }
            7 => {
                let (one, two) = (self.any_body(draw), self.any_body(draw));
                let mortar = Mortar {
                    centre: vector(draw, 0.5),
                    normal: vector(draw, 1.0),
                    area: draw.size(1e-5, 1e-2) as f32,
                    strength: draw.size(1e3, 1e7) as f32,
                };
                if one != two {
                    let _ = self.world.insert_mortar(one, two, mortar);
                }
            }
            8 => {
                let (origin, impulse) = (vector(draw, 1.0), draw.size(0.1, 1e3) as f32);
                let _ = world.blast(origin, impulse, draw.size(1e-5, 0.01) as f32);
            }
            9 => {
                let (body, point) = (self.any_body(draw), vector(draw, 0.5));
                let _ = self.world.fracture_at(body, point, vector(draw, 5.0));
            }
            10 => {
                let (body, point) = (self.any_body(draw), vector(draw, 0.5));
                let (toward, speed) = (vector(draw, 1.0), draw.size(0.1, 30.0) as f32);
                let other = self.any_body(draw);
                let flexible = self.world.striker(other, point, toward);
                let striker = flexible.unwrap_or(Striker::rigid());
                let _ = self.world.would_break(body, point, toward, speed, striker);
                let _ = self.world.rest_margin(body);
            }
            11 => {
                let body = self.any_body(draw);
                let (moves, spins) = (vector(draw, 15.0), vector(draw, 10.0));
                if let Some(body) = self.world.physics.bodies.get_mut(body)
                    && moves.is_finite()
                    && spins.is_finite()
                {
                    body.set_linvel(moves, true);
                    body.set_angvel(spins, true);
                }
            }
            12 => {
                let body = self.any_body(draw);
                if let Some(gone) = self.world.physics.remove_body(body) {
                    self.mass -= f64::from(gone.mass());
                }
            }
            13 => {
                self.saved = Some((world.save(), self.bodies.clone(), self.mass));
            }
            14 => {
                if let Some((saved, bodies, mass)) = &self.saved {
                    world.restore(saved);
                    self.bodies.clone_from(bodies);
                    self.mass = *mass;
                }
            }
            0..=2 => {}
            _ => {
                let (body, surface) = (self.any_body(draw), surface(draw));
                let _ = self.world.set_surface(body, surface);
            }
        }
        for _ in 0..draw.below(8) {
            if self.steps < STEPS {
                self.steps += 1;
                self.step();
            }
        }
    }

    fn step(&mut self) {
        let made = match self.world.step() {
            Ok(events) => events,
            Err(_) => self.world.breaks(),
        };
        for event in made {
            let fragments = &event.fracture.fragments;
            let mass: f64 = fragments.iter().map(|f| f.mass.mass).sum();
            let whole = event.asset.mass().mass;
            assert!((mass / whole - 1.0).abs() < 1e-6, "{mass} kg of {whole}");
            for energy in [
                event.kinetic_before,
                event.kinetic_after,
                event.energy_paid,
                event.work,
            ] {
                assert!(energy.is_finite(), "{event:?}");
            }
            self.bodies.extend(&event.fragments);
        }
        self.check();
    }

    fn check(&self) {
        let mut mass = 0.0;
        for (_, body) in self.world.physics.bodies.iter() {
            assert!(body.position().is_finite(), "{:?}", body.position());
            let still = body.linvel().is_finite() && body.angvel().is_finite();
            assert!(still, "{:?} {:?}", body.linvel(), body.angvel());
            mass += f64::from(body.mass());
        }
        let (off, most) = (mass - self.mass, mass.max(self.mass));
        let least = if self.loses { f64::NEG_INFINITY } else { -1e-5 };
        // In f32, and what is gone was rounded too.
        let share = off / most.max(0.1);
        assert!((least..1e-5).contains(&share), "{mass} kg of {}", self.mass);
    }
}

/// Does the deeds that the bytes describe to a world.
pub fn world(data: &[u8]) {
    run(data, kinds());
}

/// Runs [`world`] with bodies of some 200 tetrahedra, for many inputs.
pub fn world_small(data: &[u8]) {
    run(data, small_kinds());
}

fn run(data: &[u8], kinds: &'static Kinds) {
    let mut draw = Draw::new(data);
    let config = config(&mut draw);
    let loses = config.dust_mass > 0.0 || config.max_debris < BODIES;
    let Ok(mut world) = BreakableWorld::new(config) else {
        return;
    };
    // One body, several, or several whose pieces break again.
    let (several, again) = match draw.below(3) {
        0 => (false, false),
        1 => (true, false),
        _ => (true, true),
    };
    if several {
        world.set_break_function(|body, contacts, config| {
            impact(body, &contacts[..contacts.len().min(CONTACTS)], config)
        });
    }
    if again {
        let mut pieces = Pieces::new(match draw.below(2) {
            0 => Method::Reanalysis,
            _ => Method::ParentModes,
        });
        (pieces.elements, pieces.modes) = (Some(40), 8);
        world = world.with_piece_model(pieces);
    }
    let floor = world.insert_fixed_half_space(Vector::NEG_Y, Vector::Y, SurfaceProperties::STONE);
    floor.expect("a floor");
    let mut play = Play {
        kinds,
        world,
        bodies: Vec::new(),
        mass: 0.0,
        loses,
        several,
        saved: None,
        steps: 0,
    };
    for _ in 0..DEEDS {
        if draw.is_over() {
            return;
        }
        play.deed(&mut draw);
    }
}
