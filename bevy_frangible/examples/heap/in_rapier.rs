//! The heap in a world of Rapier.

use bevy_frangible::FrangibleAsset;
use bevy_frangible::frangible::Breakable;
use bevy_frangible::frangible::glam::{Quat, Vec3};
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{AtRest, BreakableWorld, SurfaceProperties, WorldConfig, WorldError};

use super::{DUST, Heap};

pub struct InRapier {
    world: BreakableWorld,
    bowl: Breakable,
}

/// An empty floor.
///
/// # Errors
/// An error of the world.
pub fn new(bowl: FrangibleAsset, merge: bool) -> Result<InRapier, WorldError> {
    let mut config = WorldConfig::for_games();
    config.dust_mass = DUST as f32;
    config.max_debris = 1000;
    config.at_rest = if merge { AtRest::Merge } else { AtRest::Sleep };
    config.rest_time = 1.0;
    let mut world = BreakableWorld::new(config)?;
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    Ok(InRapier {
        world,
        bowl: bowl.0,
    })
}

impl Heap for InRapier {
    fn drop(&mut self, number: usize, at: Vec3, turn: Quat) {
        let body = self.bowl.body(number as u64);
        let builder = RigidBodyBuilder::dynamic().pose(Pose::from_parts(at, turn));
        if let Err(error) = self.world.insert(body, builder) {
            println!("bowl {number} stays away: {error}");
        }
    }

    fn step(&mut self) {
        if let Err(error) = self.world.step() {
            println!("the step fails: {error}");
        }
    }

    fn pieces(&mut self) -> (usize, usize) {
        let bodies = self.world.physics.bodies.iter();
        let pieces = bodies.filter(|(_, b)| b.is_dynamic() && !b.colliders().is_empty());
        let awake: Vec<bool> = pieces.map(|(_, b)| !b.is_sleeping()).collect();
        (awake.len(), awake.iter().filter(|awake| **awake).count())
    }
}
