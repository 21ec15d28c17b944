//! Bodies remember cracks that part nothing: they are not cut again, later blows carry them on, and a replay gives the
//! same bits.

mod common;

use std::sync::Arc;

use common::{glass, pieces, rim_hit};
use frangible::internals::BodyState;
use frangible::{Body, Breakable, Contact, FractureConfig, InputError, Outcome, impact};

/// Blows of this speed leave cracks in the glass and it whole.
const SPEED: f64 = 0.8;

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

/// A glass with cracks that part nothing, and the contact that made them.
fn cracked(config: &FractureConfig) -> (Body, Contact) {
    let kind = Breakable::new(Arc::clone(glass())).unwrap();
    for k in 0..60 {
        let mut body = kind.body(k);
        let contact = rim_hit(6.0 * k as f32, SPEED + 0.05 * k as f64);
        let outcome = strike(&mut body, contact, config);
        if pieces(&outcome) == 1 && !body.state().is_intact() {
            return (body, contact);
        }
    }
    panic!("no blow left a cracked glass");
}

#[test]
fn more_hits_finish_the_break() {
    let config = FractureConfig::default();
    let (mut body, contact) = cracked(&config);
    let mut cuts = body.state().faces(glass()).count();
    println!(
        "after one blow: {} cracks, {cuts} cuts",
        body.state().cracks()
    );
    for blow in 2..=40 {
        let outcome = strike(&mut body, contact, &config);
        if pieces(&outcome) > 1 {
            println!("blow {blow}: {} pieces", pieces(&outcome));
            return;
        }
        let now = body.state().faces(glass()).count();
        assert!(now >= cuts, "cracks have healed");
        cuts = now;
    }
    // The same blow again finds its cracks released; a harder one must do.
    let harder = Contact {
        approach_speed: 2.0 * contact.approach_speed,
        ..contact
    };
    let outcome = strike(&mut body, harder, &config);
    println!("harder: {} pieces, {cuts} cuts before", pieces(&outcome));
    assert!(pieces(&outcome) > 1);
}

#[test]
fn pieces_of_a_cracked_body_still_tile_it() {
    let config = FractureConfig::default();
    let (body, contact) = cracked(&config);
    let harder = Contact {
        approach_speed: 5.0 * contact.approach_speed,
        ..contact
    };
    let outcome = impact(&body, &[harder], &config).unwrap();
    assert!(pieces(&outcome) > 1);
    assert!(outcome.report().volume_error.abs() < 1e-9);
}

#[test]
fn replaying_the_impacts_rebuilds_the_state_bit_for_bit() {
    let config = FractureConfig::default();
    let kind = Breakable::new(Arc::clone(glass())).unwrap();
    let (first, contact) = cracked(&config);
    let contacts: Vec<Contact> = (0..4)
        .map(|k| Contact {
            approach_speed: (1.0 - 0.2 * k as f32) * contact.approach_speed,
            ..contact
        })
        .collect();
    let play = || {
        let mut body = kind.body(first.seed());
        let last = contacts
            .iter()
            .map(|&c| pieces(&strike(&mut body, c, &config)))
            .last();
        (body.state().to_bytes(), last)
    };
    assert_eq!(play(), play());
    // With and without culling too.
    let mut slow = config.clone();
    slow.culling = false;
    let mut body = kind.body(first.seed());
    for &c in &contacts {
        strike(&mut body, c, &slow);
    }
    assert_eq!(body.state().to_bytes(), play().0);
}

#[test]
fn a_state_survives_its_bytes_and_foreign_ones_are_refused() {
    let config = FractureConfig::default();
    let (mut body, _) = cracked(&config);
    let bytes = body.state().to_bytes();
    println!("{} bytes for {} cracks", bytes.len(), body.state().cracks());
    assert_eq!(&BodyState::from_bytes(&bytes).unwrap(), body.state());
    for end in 0..bytes.len() {
        assert!(BodyState::from_bytes(&bytes[..end]).is_err(), "{end} bytes");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(BodyState::from_bytes(&longer).is_err());
    // Any changed byte is refused, or gives a state that is checked: never a panic.
    for at in (0..bytes.len()).step_by(bytes.len() / 40) {
        let mut changed = bytes.clone();
        changed[at] ^= 0xff;
        if let Ok(state) = BodyState::from_bytes(&changed)
            && body.set_state(state).is_ok()
        {
            let soft = rim_hit(0.0, 0.01);
            impact(&body, &[soft], &config).unwrap();
        }
    }
    let other = common::block();
    let mut brick = Body::new(Arc::clone(other), 1).unwrap();
    let last = body.asset().fracture.tets.len() as u32 - 1;
    let state = BodyState::from_bytes(&foreign(last)).unwrap();
    if other.fracture.tets.len() as u32 <= last {
        assert!(matches!(brick.set_state(state), Err(InputError::State(_))));
    }
}

/// A state with one crack through one tetrahedron.
fn foreign(tet: u32) -> Vec<u8> {
    let mut bytes = b"FRCRACK2".to_vec();
    for x in [1, tet, 1.0_f32.to_bits(), 0, 0, 1, 0, 0, tet] {
        bytes.extend(x.to_le_bytes());
    }
    for x in [-1.0_f32, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0] {
        bytes.extend(x.to_bits().to_le_bytes());
    }
    bytes
}
