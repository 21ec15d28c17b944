//! A heap of pieces at rest in both engines: how many sleep, and what a step of them takes.
//!
//! `cargo run --release --example heap [BOWLS] [SECONDS] [merge]` drops bowls on one place, one after the other, in Avian and in a world of Rapier, with the settings
//! for games. Once a second it prints how many pieces there are, how many of them are awake, and the least time of a step in that second.
//! With `merge` pieces of a bowl that have slept for a second become one static body.

mod in_avian;
mod in_rapier;

use std::time::Instant;

use bevy_frangible::FrangibleAsset;
use bevy_frangible::frangible::Material;
use bevy_frangible::frangible::glam::{Quat, Vec3};
use frangible_bake::{BakeSpec, Shape, bake};

/// Steps per second.
const RATE: f32 = 60.0;

/// Pieces lighter than this are dust, kg.
const DUST: f64 = 1e-3;

/// Bowls come from so high, and so long after one another: m and s.
const HEIGHT: f32 = 2.5;
const PAUSE: f32 = 0.1;

/// A world of either engine.
trait Heap {
    /// Lets bowl number `number` fall.
    fn drop(&mut self, number: usize, at: Vec3, turn: Quat);
    /// Takes a step.
    fn step(&mut self);
    /// Number of pieces, and of those that are awake.
    fn pieces(&mut self) -> (usize, usize);
}

/// A bowl of porcelain.
fn bowl() -> Result<FrangibleAsset, Box<dyn std::error::Error>> {
    let shape = Shape::bowl();
    let spec = BakeSpec {
        modes: 40,
        fracture: Some(shape.size_for(1500.0)?),
        analysis: Some(shape.size_for(1500.0)?),
        ..BakeSpec::new("bowl", shape, Material::preset("porcelain")?)
    };
    Ok(FrangibleAsset::new(bake(&spec)?)?)
}

/// Starting position of a bowl, m: beside that of the bowl before, so that no two land on the same spot.
fn start(number: usize) -> (Vec3, Quat) {
    let turn = 2.4 * number as f32;
    let aside = 0.08 * Vec3::new(turn.cos(), 0.0, turn.sin());
    let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    (
        aside + Vec3::Y * HEIGHT,
        Quat::from_rotation_z(0.3 * turn) * upright,
    )
}

fn play(name: &str, heap: &mut dyn Heap, bowls: usize, seconds: usize) {
    let every = (PAUSE * RATE) as usize;
    for second in 1..=seconds {
        let mut least = f64::INFINITY;
        for step in (second - 1) * RATE as usize..second * RATE as usize {
            if step.is_multiple_of(every) && step / every < bowls {
                let (at, turn) = start(step / every);
                heap.drop(step / every, at, turn);
            }
            let began = Instant::now();
            heap.step();
            least = least.min(1e3 * began.elapsed().as_secs_f64());
        }
        let (pieces, awake) = heap.pieces();
        println!(
            "{name}, {second:2} s: {pieces} pieces, {awake} awake, a step takes {least:.3} ms"
        );
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let merge = words.pop_if(|word| word == "merge").is_some();
    let mut numbers = words.iter().map(|word| word.parse());
    let mut number = |otherwise| numbers.next().unwrap_or(Ok(otherwise));
    let (bowls, seconds) = (number(24)?, number(20)?);
    let bowl = bowl()?;
    play("Avian", &mut in_avian::new(&bowl, merge), bowls, seconds);
    play("Rapier", &mut in_rapier::new(bowl, merge)?, bowls, seconds);
    Ok(())
}
