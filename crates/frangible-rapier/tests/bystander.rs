//! A body that nothing touches does not make the debris of another one dearer.

use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{BreakableWorld, Breaking, LoadCounts, SurfaceProperties, WorldConfig};

use crate::common::{at, body, box_asset, slicer};
use frangible::glam::Vec3;

const HALF: Vec3 = Vec3::new(0.05, 0.02, 0.05);

/// Work of a world, counted and not timed.
#[derive(Debug, Default)]
struct Work {
    pieces: usize,
    /// Copies of the world, and steps that were undone.
    copies: [u64; 2],
    /// Blows that were tested.
    blows: LoadCounts,
    /// Pairs near each other, of which one body is awake, over all steps.
    pairs: usize,
    /// Contacts of those pairs that Rapier's solver had, over all steps.
    contacts: usize,
    /// Bodies awake, over all steps.
    awake: usize,
}

/// A block falls on a floor of stone and breaks; two seconds of its debris.
fn debris(breaking: Breaking, bystander: bool) -> Work {
    let mut config = WorldConfig::default();
    config.breaking = breaking;
    let mut world = BreakableWorld::new(config).unwrap();
    world.set_break_function(slicer(HALF, [4, 2, 4], 0.0, 0.01));
    let block = box_asset(HALF, [4, 2, 4]);
    let half = Vector::new(10.0, 0.5, 10.0);
    world
        .insert_fixed_box(half, at(0.0, -0.5, 0.0), SurfaceProperties::STONE)
        .unwrap();
    let falls = RigidBodyBuilder::dynamic()
        .pose(at(0.0, 0.06, 0.0))
        .rotation(Vector::new(0.7, 0.3, 0.0))
        .linvel(Vector::new(0.0, -3.0, 0.0));
    world.insert(body(&block), falls).unwrap();
    let stands = |world: &mut BreakableWorld| -> RigidBodyHandle {
        let upright = RigidBodyBuilder::dynamic().pose(at(5.0, HALF.y, 0.0));
        world.insert(body(&block), upright).unwrap()
    };
    let bystander = bystander.then(|| stands(&mut world));
    let mut work = Work::default();
    for _ in 0..480 {
        work.pieces += (world.step().unwrap().iter())
            .map(|event| event.fragments.len())
            .sum::<usize>();
        let physics = &world.physics;
        let own = |h: Option<RigidBodyHandle>| h.is_some() && h == bystander;
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let moves = |h: Option<RigidBodyHandle>| {
            let body = h.and_then(|h| physics.bodies.get(h));
            body.is_some_and(|b| b.is_dynamic() && !b.is_sleeping())
        };
        for pair in physics.narrow_phase.contact_pairs() {
            let ends = [pair.collider1, pair.collider2].map(parent);
            if ends.into_iter().any(own) || !ends.into_iter().any(moves) {
                continue;
            }
            work.pairs += 1;
            work.contacts += (pair.solver_manifolds().iter())
                .map(|m| m.points.len())
                .sum::<usize>();
        }
        let awake = physics.bodies.iter().filter(|(h, _)| moves(Some(*h)));
        work.awake += awake.filter(|(h, _)| !own(Some(*h))).count();
    }
    work.copies = [world.snapshots(), world.undone_steps()];
    work.blows = world.impact_counts();
    if let Some(bystander) = bystander {
        assert!(world.breakable(bystander).is_some());
        assert!(world.physics.bodies[bystander].is_sleeping());
    }
    work
}

#[test]
fn a_body_five_metres_away_makes_debris_no_dearer() {
    let after = Breaking::AfterStep {
        budget: usize::MAX,
        delay: 0,
    };
    for breaking in [Breaking::InsideStep, after] {
        let (alone, beside) = (debris(breaking, false), debris(breaking, true));
        println!("{alone:?}\n{beside:?}");
        assert!(alone.pieces == 32 && alone.pairs > 1000, "{alone:?}");
        assert_eq!(beside.pieces, alone.pieces, "{breaking:?}");
        assert_eq!(beside.copies, alone.copies, "{breaking:?}");
        assert_eq!(beside.blows, alone.blows, "{breaking:?}");
        // One body more changes the order in which the solver takes the contacts, so the pieces fly a little otherwise: the work counts by piece.
        let more = |of: fn(&Work) -> usize| {
            let share = |work: &Work| of(work) as f64 / work.awake as f64;
            share(&beside) / share(&alone)
        };
        let more = [more(|w| w.pairs), more(|w| w.contacts)];
        assert!(more.iter().all(|&m| m < 1.1), "{breaking:?}: {more:?}");
    }
}
