//! The shop: a thousand things on planks, and the bull.

use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::{
    Group, InteractionGroups, InteractionTestMode, SharedShape,
};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

use frangible_lab::Result;

use crate::crockery::Kind;

const RACKS: usize = 5;
const BOARDS: usize = 5;
const COLUMNS: usize = 2;
/// Things on a plank: ten along it, two across.
const PLACES: [usize; 2] = [10, 2];
/// Distances between racks, boards and things, m.
const RACK: f32 = 1.2;
const BOARD: f32 = 0.36;
const PLACE: f32 = 0.17;
/// Half extents of a plank, m, and its mass, kg.
const PLANK: Vector = Vector::new(0.88, 0.012, 0.18);
const PLANK_MASS: f32 = 5.0;
/// The bull, kg and m.
const BULL: Ball = Ball {
    mass: 400.0,
    radius: 0.45,
};

pub(crate) struct Shop {
    pub(crate) world: BreakableWorld,
    pub(crate) things: Vec<RigidBodyHandle>,
}

/// The shop before the bull comes; `seed` decides the weak points.
pub(crate) fn furnish(kinds: &[Kind], config: WorldConfig, seed: u64) -> Result<Shop> {
    let mut world = BreakableWorld::new(config)?;
    let floor = Vector::new(20.0, 0.5, 20.0);
    let pose = Pose::translation(0.0, -floor.y, 0.0);
    world.insert_fixed_box(floor, pose, SurfaceProperties::STONE)?;
    let mut things = Vec::new();
    for rack in 0..RACKS {
        for board in 0..BOARDS {
            for column in 0..COLUMNS {
                let middle = Vector::new(
                    (2.0 * PLANK.x + 0.04) * (column as f32 - 0.5),
                    0.25 + BOARD * board as f32,
                    RACK * rack as f32,
                );
                plank(&mut world, rack, middle)?;
                for place in 0..PLACES[0] * PLACES[1] {
                    let (along, across) = (place % PLACES[0], place / PLACES[0]);
                    let kind = &kinds[(3 * along + across + board + rack) % kinds.len()];
                    let at = middle
                        + Vector::new(
                            PLACE * (along as f32 - 0.5 * (PLACES[0] - 1) as f32),
                            PLANK.y + kind.foot,
                            PLACE * (across as f32 - 0.5),
                        );
                    let upright = Rotation::from_rotation_x(-std::f32::consts::FRAC_PI_2);
                    let body = kind.breakable.body(seed + things.len() as u64);
                    things.push(world.insert(
                        body,
                        RigidBodyBuilder::dynamic().pose(Pose::from_parts(at, upright)),
                    )?);
                }
            }
        }
    }
    Ok(Shop { world, things })
}

/// A loose plank on two ledges. They hold the planks of their rack alone: a plank on its way through the shop that
/// caught on the fixed ledges of the next rack would stop the bull.
fn plank(world: &mut BreakableWorld, rack: usize, middle: Vector) -> Result<()> {
    let shape = SharedShape::cuboid(PLANK.x, PLANK.y, PLANK.z);
    let pose = Pose::from_translation(middle);
    let wood = SurfaceProperties::WOOD;
    let plank = world.insert_rigid(shape, PLANK_MASS, wood, pose, Vector::ZERO)?;
    // Nothing here is so thin that it passes through in a step.
    world.physics.bodies[plank].enable_ccd(false);
    let own = Group::from_bits_truncate(1 << rack);
    group(world, plank, own, Group::ALL);
    for side in [-1.0, 1.0] {
        let half = Vector::new(0.02, 0.01, PLANK.z);
        let ledge = middle + Vector::new(side * (PLANK.x - half.x), -PLANK.y - half.y, 0.0);
        let pose = Pose::from_translation(ledge);
        let ledge = world.insert_fixed_box(half, pose, wood)?;
        group(world, ledge, Group::GROUP_32, own);
    }
    Ok(())
}

fn group(world: &mut BreakableWorld, body: RigidBodyHandle, members: Group, filter: Group) {
    let groups = InteractionGroups::new(members, filter, InteractionTestMode::And);
    for &collider in world.physics.bodies[body].colliders() {
        world.physics.colliders[collider].set_collision_groups(groups);
    }
}

/// Lets the bull in at a speed, m/s: it rolls along the middle of the right-hand planks.
pub(crate) fn let_in(world: &mut BreakableWorld, speed: f32) -> Result<RigidBodyHandle> {
    let lane = PLANK.x + 0.02;
    let start = Pose::translation(lane, BULL.radius + 0.001, -1.2);
    let velocity = Vector::new(0.0, 0.0, speed);
    let bull = world.insert_ball(BULL, SurfaceProperties::STONE, start, velocity)?;
    world.physics.bodies[bull].enable_ccd(false);
    Ok(bull)
}
