//! A break as bytes: the contacts and a seed rebuild the same fragments elsewhere, bit for bit.

use std::sync::Arc;

use crate::common::{glass, rim_hit};
use frangible::{Asset, Breakable, Contact, FractureConfig, Outcome, impact};

/// Message that goes over the network for a body: its seed, then every impact as a count and its contacts.
fn message(seed: u64, impacts: &[Vec<Contact>]) -> Vec<u8> {
    let mut bytes = seed.to_le_bytes().to_vec();
    for contacts in impacts {
        bytes.push(contacts.len() as u8);
        bytes.extend(contacts.iter().flat_map(Contact::to_bytes));
    }
    bytes
}

/// Plays a message on a body of this kind: the state after each impact that it held, then the pieces.
fn replay(
    kind: &Breakable,
    mut message: &[u8],
    config: &FractureConfig,
) -> (Vec<Vec<u8>>, Vec<u32>) {
    let (seed, rest) = message.split_at(8);
    message = rest;
    let mut body = kind.body(u64::from_le_bytes(seed.try_into().unwrap()));
    let mut states = Vec::new();
    while let Some((&count, rest)) = message.split_first() {
        message = rest;
        let contacts: Vec<Contact> = (0..count)
            .map(|_| {
                let (contact, behind) = Contact::read(message).unwrap();
                message = behind;
                contact
            })
            .collect();
        match impact(&body, &contacts, config).unwrap() {
            Outcome::Held { state, .. } => {
                if let Some(state) = state {
                    body.set_state(*state).unwrap();
                }
                states.push(body.state().to_bytes());
            }
            Outcome::Broke(fracture) => {
                let corners = fracture.fragments.iter().flat_map(|f| &f.mesh.positions);
                let bits = corners.flat_map(|p| p.to_array().map(f32::to_bits));
                return (states, bits.collect());
            }
            other => panic!("{other:?}"),
        }
    }
    (states, Vec::new())
}

#[test]
fn contacts_and_a_seed_replay_a_break_bit_for_bit() {
    let impacts: Vec<Vec<Contact>> = [(0.0, 0.2), (120.0, 3.0), (60.0, 3.1), (0.0, 9.0)]
        .into_iter()
        .enumerate()
        .map(|(i, (degrees, speed))| {
            let second = rim_hit(degrees + 20.0, 0.5 * speed);
            let mut contacts = vec![rim_hit(degrees, speed), second];
            contacts.truncate(1 + i % 2);
            contacts
        })
        .collect();
    let bytes = message(5, &impacts);
    let contacts: usize = impacts.iter().map(Vec::len).sum();
    assert_eq!(bytes.len(), 8 + impacts.len() + Contact::BYTES * contacts);
    let config = FractureConfig::default();
    // Another machine: the asset came there as a file.
    let here = Breakable::uniform(Arc::clone(glass())).unwrap();
    let there = Breakable::uniform(Asset::from_bytes(&glass().to_bytes()).unwrap()).unwrap();
    let (states, pieces) = replay(&here, &bytes, &config);
    let cracked: usize = states.iter().map(Vec::len).sum();
    println!(
        "{} impacts, {contacts} contacts: {} bytes; the states between them {cracked}, the pieces' corners {}",
        impacts.len(),
        bytes.len(),
        4 * pieces.len()
    );
    assert!(!pieces.is_empty(), "the glass did not break");
    assert!(replay(&there, &bytes, &config) == (states.clone(), pieces.clone()));
    // On many threads at once, and without culling.
    let mut slow = config.clone();
    slow.culling = false;
    std::thread::scope(|scope| {
        let runs = [&config, &slow, &config, &slow];
        let runs = runs.map(|config| scope.spawn(|| replay(&here, &bytes, config)));
        for run in runs {
            assert!(run.join().unwrap() == (states.clone(), pieces.clone()));
        }
    });
    // Another seed is another break.
    let other = replay(&here, &message(6, &impacts), &config);
    assert!(other.1 != pieces);
}
