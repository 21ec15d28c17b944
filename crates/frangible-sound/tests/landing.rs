//! Sound of landing dice of tempered glass and small shards, by their mass and speed.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use frangible::glam::{Quat, Vec3};
use frangible::{
    Asset, Breakable, Contact, Fracture, FractureConfig, Material, Outcome, Striker, impact,
};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_sound::glam::DVec3;
use frangible_sound::{
    Cast, Hearing, Listener, Pose, RecordedBlow, RecordedTouch, SoundFloor, Sounding, SynthConfig,
    recorded_blow,
};

const SIDE: f64 = 0.15;
const THICK: f64 = 0.004;
const FALL: f64 = 2.0;

/// Things in front of the ears, each with a mesh.
struct World {
    soundings: Vec<Sounding>,
    meshes: Vec<(Vec<Vec3>, Vec<[u32; 3]>)>,
    poses: Vec<Pose>,
}

impl Cast for World {
    fn name(&self, _: usize) -> &str {
        "thing"
    }
    fn sounding(&self, node: usize) -> &Sounding {
        &self.soundings[node]
    }
    fn vertices(&self, node: usize) -> &[Vec3] {
        &self.meshes[node].0
    }
    fn triangles(&self, node: usize) -> Vec<[u32; 3]> {
        self.meshes[node].1.clone()
    }
    fn balls(&self, _: f64) -> Vec<usize> {
        Vec::new()
    }
    fn pose(&self, node: usize, _: f64) -> Pose {
        self.poses[node]
    }
    fn floor(&self) -> Option<f32> {
        None
    }
}

/// A tempered pane and its break by a ball.
fn broken() -> &'static (Breakable, Fracture) {
    static BROKEN: OnceLock<(Breakable, Fracture)> = OnceLock::new();
    BROKEN.get_or_init(|| {
        let glass = Material::preset("tempered-glass").expect("a preset");
        let shape = Shape::plate(SIDE, SIDE, THICK);
        let spec = BakeSpec {
            modes: 30,
            fracture: Some(shape.size_for(4_000.0).expect("a size")),
            ..BakeSpec::new("pane", shape, glass)
        };
        let asset: Arc<Asset> = Arc::new(bake(&spec).expect("a bake"));
        let kind = Breakable::new(asset).expect("a kind");
        let body = kind.body(1);
        let steel = Material::preset("steel").expect("a preset");
        let ball = Striker::ball(&steel, 0.25, 0.02);
        let at = Vec3::new(0.02, 0.01, 0.5 * THICK as f32);
        let hit = Contact::collision(body.asset(), at, Vec3::NEG_Z, 40.0, ball);
        let mut config = FractureConfig::default();
        config.clumps = 6;
        match impact(&body, &[hit], &config).expect("sound input") {
            Outcome::Broke(fracture) => (kind, *fracture),
            _ => panic!("it held"),
        }
    })
}

/// The pane, node 0, and its clumps.
fn world() -> (World, RecordedBlow) {
    let (kind, fracture) = broken();
    let body = kind.body(1);
    let glass = body.asset().material().clone();
    let pieces: Range<usize> = 1..1 + fracture.fragments.len();
    let blow = recorded_blow(0, body.asset(), &fracture.report, 0.0, pieces);
    let mut world = World {
        soundings: vec![Sounding::Modes(body)],
        meshes: vec![(Vec::new(), Vec::new())],
        poses: vec![Pose::default()],
    };
    for (i, fragment) in fracture.fragments.iter().enumerate() {
        let clump = Arc::clone(fracture.clump(i).expect("a clump"));
        let dice = Sounding::Dice(glass.clone(), fragment.mass.mass, clump);
        world.soundings.push(dice);
        let mesh = &fragment.mesh;
        world
            .meshes
            .push((mesh.positions.clone(), mesh.triangles.clone()));
        world.poses.push(Pose {
            translation: fragment.mass.centre.as_vec3(),
            rotation: Quat::IDENTITY,
        });
    }
    (world, blow)
}

fn hearing(floor: bool) -> Hearing {
    let listener = Listener {
        channels: 1,
        ..Listener::at(DVec3::new(0.7, 0.5, 0.51), DVec3::ZERO)
    };
    let stone = Material::preset("stone").expect("a preset");
    let config = SynthConfig {
        floor: floor.then(|| SoundFloor::of(&stone, 0.0)),
        ..SynthConfig::new(listener)
    };
    Hearing::new(config, Some(stone)).expect("a configuration")
}

/// Energy of samples, and the time in which 98 % of it come after the first sound, s.
fn energy(samples: &[f32]) -> (f64, f64) {
    let square = |&s: &f32| f64::from(s).powi(2);
    let all: f64 = samples.iter().map(square).sum();
    let mut sum = 0.0;
    let mut after = |share: f64| {
        let at = samples.iter().position(|s| {
            sum += square(s);
            sum >= share * all
        });
        sum = 0.0;
        at.unwrap_or(0) as f64 / 48_000.0
    };
    (all, after(0.99) - after(0.01))
}

/// A clump that comes down flat or on its edge at a speed, m/s; its momentum is `share` of what it had.
fn landing(node: usize, speed: f64, on_edge: bool, share: f64) -> (Vec<f32>, [u64; 2]) {
    let (mut world, _) = world();
    // On its edge no row of dice is level, so that they do not come at once.
    world.poses[node].rotation = if on_edge {
        Quat::from_rotation_z(0.4)
    } else {
        Quat::from_rotation_x(-0.5 * std::f32::consts::PI)
    };
    let mut hearing = hearing(true);
    let touch = RecordedTouch {
        time: 0.0,
        nodes: (node, None),
        point: Vec3::ZERO,
        normal: Vec3::Y,
        impulse: share * world.soundings[node].mass() * speed,
        speed,
    };
    hearing.touch(&world, &touch).expect("a touch");
    let samples = hearing.until_silence(3.0).expect("a sound");
    (samples, hearing.dice())
}

#[test]
fn all_dice_are_heard_when_they_come_loose_and_within_the_time_of_the_front() {
    let (world, blow) = world();
    let heard = || {
        let mut hearing = hearing(false);
        hearing.blow(&world, &blow).expect("a blow");
        (hearing.dice(), hearing.until_silence(3.0).expect("a sound"))
    };
    let (dice, samples) = heard();
    let count = |sounding: &Sounding| match sounding {
        Sounding::Dice(_, _, clump) => clump.count() as u64,
        _ => 0,
    };
    let all: u64 = world.soundings.iter().map(count).sum();
    assert!(all > 300 && dice == [all, 0], "{dice:?} of {all}");
    // The front takes 0.1 ms to the corners; the pane falls silent within 0.7 ms, and nothing rings.
    let (power, long) = energy(&samples);
    assert!(power > 0.0 && long < 2e-3, "{long} s");
    assert_eq!(heard().1, samples);
}

#[test]
fn a_clump_gives_its_momentum_die_by_die_as_long_as_it_takes_to_fall() {
    let dice = |(_, [loose, landed]): &(Vec<f32>, [u64; 2])| {
        assert_eq!(*loose, 0);
        *landed as f64
    };
    let edge = landing(1, FALL, true, 1.0);
    let flat = landing(1, FALL, false, 1.0);
    let some = landing(1, FALL, true, 0.25);
    let count = dice(&edge);
    assert!(count > 20.0 && (dice(&flat) - count).abs() < 1.5);
    assert!((dice(&some) / count - 0.25).abs() < 0.05, "{}", dice(&some));
    // Some 60 mm high at 2 m/s; all dice of a flat one are there at once.
    let [edge, flat] = [&edge, &flat].map(|(samples, _)| energy(samples).1);
    assert!(
        (5e-3..50e-3).contains(&edge) && flat < 2e-3,
        "{edge} {flat}"
    );
}

#[test]
fn a_clump_is_heard_by_its_dice_and_by_their_speed() {
    // What dice send goes with the square of their speed; the floor is thumped likewise.
    let of = |speed| energy(&landing(1, speed, true, 1.0).0).0;
    let growth = 10.0 * (of(5.0) / of(0.5)).log10();
    assert!((17.0..24.0).contains(&growth), "{growth} dB");
    // Twice as many dice send twice as much: they do not come at once.
    let (many, few) = (landing(1, FALL, true, 1.0), landing(1, FALL, true, 0.5));
    let ratio = energy(&many.0).0 / energy(&few.0).0;
    assert!((1.4..2.8).contains(&ratio), "{ratio}");
}

#[test]
fn a_clump_that_parts_is_not_hushed_and_its_touch_is_not_part_of_a_blow() {
    let (world, _) = world();
    let touch = RecordedTouch {
        time: 1e-3,
        nodes: (1, None),
        point: Vec3::ZERO,
        normal: Vec3::Y,
        impulse: world.soundings[1].mass() * FALL,
        speed: FALL,
    };
    let heard = |parts: bool| {
        let mut hearing = hearing(true);
        if parts {
            let parting = RecordedBlow {
                node: 1,
                pieces: 2..4,
                ..RecordedBlow::default()
            };
            hearing.note(&parting);
            hearing.blow(&world, &parting).expect("a parting");
        }
        hearing.touch(&world, &touch).expect("a touch");
        hearing.until_silence(3.0).expect("a sound")
    };
    let alone = heard(false);
    assert!(energy(&alone).0 > 0.0);
    assert_eq!(heard(true), alone);
}

/// A cube of glass that lands on a face: side, m, speed, m/s. The energy of its sound.
fn cube(side: f64, speed: f64) -> f64 {
    let half = 0.5 * side as f32;
    let corner = |k: usize| {
        let at = |bit: usize| if k & bit > 0 { half } else { -half };
        Vec3::new(at(1), at(2), at(4))
    };
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let glass = Material::preset("glass").expect("a preset");
    let mass = glass.density * side.powi(3);
    let world = World {
        soundings: vec![Sounding::Piece(glass, mass)],
        meshes: vec![((0..8).map(corner).collect(), faces.to_vec())],
        poses: vec![Pose {
            translation: Vec3::new(0.0, half, 0.0),
            rotation: Quat::IDENTITY,
        }],
    };
    let mut hearing = hearing(false);
    let touch = RecordedTouch {
        time: 0.0,
        nodes: (0, None),
        point: Vec3::ZERO,
        normal: Vec3::Y,
        impulse: mass * speed,
        speed,
    };
    hearing.touch(&world, &touch).expect("a touch");
    energy(&hearing.until_silence(1.0).expect("a sound")).0
}

#[test]
fn what_lands_without_ringing_is_heard_by_its_volume_and_its_speed() {
    // A body that is small against the waves sends a pressure that goes with its volume and its change of speed (Koss and Alfredson, J. Sound Vib. 27,
    // 1973): 20 dB for ten times either, and the push, the faster the shorter, adds a little.
    let level = |side: f64, speed: f64| 10.0 * cube(side, speed).log10();
    let faster = level(4e-3, 3.0) - level(4e-3, 0.3);
    assert!((18.0..25.0).contains(&faster), "{faster} dB");
    // Of a push that is shorter than a sample, what it sends above the range of hearing is folded into it, and all that it sends goes with the volume
    // alone: 10 dB for ten times as much.
    let heavier = level(5e-3, 1.0) - level(2.5e-3, 1.0);
    let volumes = 8.0_f64.log10();
    let range = 10.0 * volumes - 2.0..20.0 * volumes;
    assert!(range.contains(&heavier), "{heavier} dB of {range:?}");
}
