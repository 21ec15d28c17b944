//! Most loads of bodies that tumble are refused at the root; `docs/culling.md` has the table.

use crate::common::tumble::{BODIES, baked, tumble};
use frangible_rapier::LoadCounts;

fn sum(c: LoadCounts) -> u64 {
    c.by_impulses + c.by_amplitudes + c.by_clusters + c.by_stresses + c.broke
}

#[test]
fn most_loads_of_bricks_that_tumble_down_stairs_are_refused_free_of_time() {
    let kinds = [baked("brick")];
    let run = tumble(&kinds, 0.02, 2.0);
    let c = run.impacts;
    println!(
        "{c:?}\n{:?}, {} broken, at rest: {}",
        run.rests, run.broken, run.at_rest
    );
    assert_eq!(sum(c), c.asked);
    assert_eq!(sum(run.rests), run.rests.asked);
    assert!(c.contacts >= c.asked);
    assert!(c.asked > BODIES as u64, "{c:?}");
    assert!(c.broke as usize >= run.broken, "{c:?}");
    // Blows below the impact speed are not asked at all, so that impacts are the hard ones among what touches.
    let asked = c.asked + run.rests.asked;
    let at_root = c.by_impulses + run.rests.by_impulses;
    let share = at_root as f64 / asked as f64;
    println!("{share:.3} of {asked} loads refused free of time");
    assert!(share > 0.9, "{share}");
}
