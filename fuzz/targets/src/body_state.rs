//! Bytes that pass for a body's state are an error, or a state that an impact can use; and so are those of a contact.

use std::sync::OnceLock;

use frangible::glam::Vec3;
use frangible::internals::BodyState;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Striker, impact};

const ASSET: &[u8] = include_bytes!("../../corpus/read_asset/cubes");

fn body() -> Body {
    static BODY: OnceLock<Body> = OnceLock::new();
    let make = || {
        let asset = Asset::from_bytes(ASSET).expect("the seed is an asset");
        Breakable::new(asset).expect("the seed is sound").body(1)
    };
    BODY.get_or_init(make).clone()
}

/// Gives the bytes to the readers of states and contacts.
pub fn body_state(data: &[u8]) {
    if let Ok((contact, behind)) = Contact::read(data) {
        assert_eq!(contact.to_bytes()[..], data[..data.len() - behind.len()]);
    }
    let Ok(state) = BodyState::from_bytes(data) else {
        return;
    };
    assert_eq!(state.to_bytes(), data);
    let mut body = body();
    if body.set_state(state).is_err() {
        return;
    }
    for impulse in [1e-6, 1e-2] {
        let contact = Contact {
            impulse,
            ..Contact::strike(Vec3::ONE, Vec3::NEG_ONE, 1.0, Striker::rigid())
        };
        let _ = impact(&body, &[contact], &FractureConfig::default());
    }
}
