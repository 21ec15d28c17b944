//! Bodies remember cracks that part nothing: they are not cut again, later blows carry them on, and a replay gives the same bits.

use crate::bodies::{block, block_hit, pane, pieces};
use frangible::internals::BodyState;
use frangible::{Body, Contact, FractureConfig, InputError, Outcome, impact};

fn strike(body: &mut Body, contact: Contact, config: &FractureConfig) -> Outcome {
    let outcome = impact(body, &[contact], config).unwrap();
    if let Outcome::Held {
        state: Some(state), ..
    } = &outcome
    {
        body.set_state((**state).clone()).unwrap();
    }
    outcome
}

/// A block with cracks that part nothing, and the contact that made them.
fn cracked(config: &FractureConfig) -> (Body, Contact) {
    for k in 0..200 {
        let mut body = block().body(k);
        let contact = block_hit(1.0 + 0.05 * k as f64);
        let outcome = strike(&mut body, contact.clone(), config);
        if pieces(&outcome) == 1 && !body.state().is_intact() {
            return (body, contact);
        }
    }
    panic!("no blow left a cracked block");
}

fn faster(contact: Contact, factor: f32) -> Contact {
    Contact {
        approach_speed: factor * contact.approach_speed,
        ..contact
    }
}

#[test]
fn more_hits_finish_the_break() {
    let config = FractureConfig::default();
    let (mut body, contact) = cracked(&config);
    let mut cuts = body.state().faces(body.asset().fracture()).count();
    for blow in 1..=40 {
        let outcome = strike(
            &mut body,
            faster(contact.clone(), 1.0 + 0.1 * blow as f32),
            &config,
        );
        if pieces(&outcome) > 1 {
            return;
        }
        let now = body.state().faces(body.asset().fracture()).count();
        assert!(now >= cuts, "cracks have healed");
        cuts = now;
    }
    panic!("40 blows, each harder, do not finish the break");
}

#[test]
fn pieces_of_a_cracked_body_still_tile_it() {
    let config = FractureConfig::default();
    let (body, contact) = cracked(&config);
    let outcome = impact(&body, &[faster(contact, 8.0)], &config).unwrap();
    assert!(pieces(&outcome) > 1);
    assert!(outcome.report().volume_error.abs() < 1e-9);
}

#[test]
fn replaying_the_impacts_rebuilds_the_state_bit_for_bit() {
    let config = FractureConfig::default();
    let (first, contact) = cracked(&config);
    let contacts: Vec<Contact> = (0..4)
        .map(|k| faster(contact.clone(), 1.0 - 0.2 * k as f32))
        .collect();
    let play = |config: &FractureConfig| {
        let mut body = block().body(first.seed());
        for contact in &contacts {
            strike(&mut body, contact.clone(), config);
        }
        body.state().to_bytes()
    };
    assert!(!BodyState::from_bytes(&play(&config)).unwrap().is_intact());
    assert_eq!(play(&config), play(&config));
    // With and without the bounds too.
    let mut slow = config.clone();
    slow.culling = false;
    assert_eq!(play(&slow), play(&config));
}

#[test]
fn a_state_survives_its_bytes_and_foreign_ones_are_refused() {
    let config = FractureConfig::default();
    let (mut body, _) = cracked(&config);
    let bytes = body.state().to_bytes();
    assert_eq!(&BodyState::from_bytes(&bytes).unwrap(), body.state());
    for end in 0..bytes.len() {
        assert!(BodyState::from_bytes(&bytes[..end]).is_err(), "{end} bytes");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(BodyState::from_bytes(&longer).is_err());
    // Any changed byte is refused, or gives a state that is checked: never a panic.
    for at in (0..bytes.len()).step_by((bytes.len() / 40).max(1)) {
        let mut changed = bytes.clone();
        changed[at] ^= 0xff;
        if let Ok(state) = BodyState::from_bytes(&changed)
            && body.set_state(state).is_ok()
        {
            impact(&body, &[block_hit(0.01)], &config).unwrap();
        }
    }
    let last = block().asset().fracture().tets.len() as u32 - 1;
    let state = BodyState::from_bytes(&foreign(last)).unwrap();
    let mut pane = pane().body(1);
    assert!(pane.asset().fracture().tets.len() as u32 <= last);
    assert!(matches!(pane.set_state(state), Err(InputError::State(_))));
}

/// A state with one crack through one tetrahedron.
fn foreign(tet: u32) -> Vec<u8> {
    let mut bytes = b"FRCRACK3".to_vec();
    for x in [1, tet, 0, 0, 0, 1.0_f32.to_bits(), 0, 0, 1, 0, 0, tet] {
        bytes.extend(x.to_le_bytes());
    }
    for x in [-1.0_f32, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0] {
        bytes.extend(x.to_bits().to_le_bytes());
    }
    bytes
}
