//! The meshes as edges.

use std::sync::Arc;

use crate::common::{broken, give, pane};
use frangible_view::{Batch, BatchLooks, Session};

/// Batches that are drawn as edges only.
fn edges(session: &mut Session) -> Vec<Arc<Batch>> {
    let batches = session.shown().picture.batches.clone();
    let all = batches.into_iter();
    all.filter(|batch| matches!(batch.looks, BatchLooks::Edges(_)))
        .collect()
}

#[test]
fn both_meshes_of_a_whole_body_lie_where_it_does_and_go_when_they_are_hidden() {
    let mut session = pane("meshes");
    assert!(edges(&mut session).is_empty());
    give(&mut session, "show fracture-mesh");
    give(&mut session, "show analysis-mesh");
    let both = edges(&mut session);
    assert_eq!(both.len(), 2);
    let live = session.live().unwrap();
    let asset = live.body_before(live.things()[0].handle).unwrap().asset();
    assert_eq!(both[0].faces.len(), asset.surface().triangles.len());
    assert!(both[1].faces.len() < both[0].faces.len(), "the coarse one");
    for batch in &both {
        let used = batch.faces.iter().flatten();
        for &node in used {
            let at = batch.positions[node as usize];
            // 0.2 × 0.2 × 0.006 m on the floor, and a hair outside of it.
            assert!(at.x.abs() < 0.101 && at.z.abs() < 0.0035, "{at}");
            assert!(at.y > -0.0005 && at.y < 0.2008, "{at}");
        }
    }
    // The same faces in the next picture: they are uploaded once.
    give(&mut session, "step 1");
    assert!(Arc::ptr_eq(&both[0].faces, &edges(&mut session)[0].faces));
    give(&mut session, "hide fracture-mesh");
    assert_eq!(edges(&mut session).len(), 1);
}

#[test]
fn meshes_bend_with_the_body_that_is_looked_at() {
    let mut session = broken("meshes-bend");
    give(&mut session, "look stress");
    give(&mut session, "show analysis-mesh");
    let mut positions = Vec::new();
    for factor in [0, 10, 20] {
        give(&mut session, &format!("exaggerate {factor}"));
        positions.push(edges(&mut session)[0].positions.clone());
    }
    let ways = positions[0].iter().zip(&positions[1]).zip(&positions[2]);
    let mut farthest = 0.0_f32;
    for ((still, once), twice) in ways {
        farthest = farthest.max(once.distance(*still));
        // Edges are drawn a hair outside, along normals that turn.
        assert!((*twice - *still - 2.0 * (*once - *still)).length() < 1e-3);
    }
    assert!(farthest > 1e-4, "{farthest}");
    // Modes move both meshes; of a broken body nothing is whole in the scene.
    give(&mut session, "look modes");
    give(&mut session, "show fracture-mesh");
    let mut swung = Vec::new();
    for share in ["0", "0.25"] {
        give(&mut session, &format!("scrub {share}"));
        swung.push(edges(&mut session));
    }
    assert_eq!(swung[0].len(), 2);
    for (still, moved) in swung[0].iter().zip(&swung[1]) {
        assert_ne!(still.positions, moved.positions);
    }
    give(&mut session, "look world");
    assert!(edges(&mut session).is_empty());
}
