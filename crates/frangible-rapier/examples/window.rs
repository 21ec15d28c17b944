//! A window in the wall of a game that has a Rapier world of its own, with its own event handler:
//! `cargo run --release -p frangible-rapier --example window`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;
use std::sync::mpsc::channel;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};
use frangible_rapier::rapier3d::prelude::*;
use frangible_rapier::{Breaker, PieceContacts, Sets};

fn main() -> Result<(), Box<dyn Error>> {
    // The game's world, with contacts that suit broken pieces, a floor and a stone on its way.
    let mut game = PhysicsWorld::default();
    game.narrow_phase.set_query_dispatcher(PieceContacts);
    let floor = ColliderBuilder::cuboid(3.0, 0.1, 3.0).translation(Vector::NEG_Y * 0.1);
    game.colliders.insert(floor);
    let stone = RigidBodyBuilder::dynamic().translation(Vector::new(0.1, 1.1, 2.0));
    let stone = stone.linvel(Vector::new(0.0, 1.0, -14.0)).ccd_enabled(true);
    let stone = game.bodies.insert(stone);
    let collider = ColliderBuilder::ball(0.03).density(2600.0);
    game.insert_collider(collider, Some(stone));

    // A pane of 60 by 40 cm, held at its left and right edges.
    let mut spec = BakeSpec::for_games(
        "window",
        Shape::plate(0.6, 0.4, 0.004),
        Material::preset("glass")?,
    )?;
    let edges = [Region::below(0, 0.01), Region::above(0, 0.59)];
    spec.supports = edges.map(Support::clamped).to_vec();
    let kind = Breakable::new(bake(&spec)?)?;
    let mut breaker = Breaker::new();
    let rigid = RigidBodyBuilder::fixed().translation(Vector::new(0.0, 1.2, 0.0));
    breaker.with(Sets::from(&mut game), |world| {
        let heard = |c: ColliderBuilder| c.active_events(ActiveEvents::COLLISION_EVENTS);
        world.insert_with(kind.body(1), rigid, heard)
    })?;

    // The game hears what meets what, to play sounds; Rapier's own collector is its event handler.
    let ((collisions, heard), (forces, _), (tears, _)) = (channel(), channel(), channel());
    let events = ChannelEventCollector::new(collisions, forces, tears);
    for _ in 0..120 {
        for event in breaker.step(Sets::from(&mut game), &(), &events)? {
            let speed = game.bodies[stone].linvel().length();
            println!(
                "{} pieces; the stone flies on at {speed:.1} m/s",
                event.fragments.len()
            );
        }
    }
    println!(
        "{} sounds",
        heard.try_iter().filter(|event| event.started()).count()
    );
    Ok(())
}
