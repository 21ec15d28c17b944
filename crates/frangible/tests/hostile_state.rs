//! States that were saved, sent and damaged are refused, or an impact can use them. The fuzz target `body_state` does
//! the same with more patience; with `FRANGIBLE_WRITE_SEEDS=1` the state that it starts from is written anew.

use std::fs;
use std::path::Path;

use frangible::glam::Vec3;
use frangible::internals::BodyState;
use frangible::{Breakable, Contact, FractureConfig, Striker, impact};

use crate::common::{Size, synthetic_asset};

fn kind() -> Breakable {
    let asset = synthetic_asset(&Size {
        cubes: 2,
        analysis_nodes: 12,
        elements: 3,
        modes: 2,
    });
    Breakable::uniform(asset).unwrap()
}

/// A state whose cracks cut these tetrahedra, with numbers that follow from `k`.
fn state(cracks: &[Vec<u32>], k: u32) -> Vec<u8> {
    let mut bytes = b"FRCRACK3".to_vec();
    let mut number = |x: u32| bytes.extend(x.to_le_bytes());
    number(cracks.len() as u32);
    for cuts in cracks {
        for x in [
            cuts[0],
            0,
            0,
            0,
            1.0_f32.to_bits(),
            0,
            0,
            cuts.len() as u32,
            0,
            1,
        ] {
            number(x);
        }
        for (i, &tet) in cuts.iter().enumerate() {
            number(tet);
            for j in 0..7 {
                let x = (k + 31 * i as u32 + 17 * j) % 19;
                number((x as f32 - 9.0).to_bits());
            }
        }
        number((k % cuts.len() as u32) << 1 | k & 1);
    }
    bytes
}

#[test]
fn states_that_no_impact_left_are_refused_or_can_be_used() {
    let kind = kind();
    let tets = kind.asset().fracture().tets.len() as u32;
    let mut used = 0;
    for k in 0..200_u32 {
        let step = 1 + k % 7;
        let cuts: Vec<u32> = (0..tets).filter(|e| (e + k) % 9 < step).collect();
        let halves = cuts.split_at(cuts.len() / 2);
        let bytes = state(&[halves.0.to_vec(), halves.1.to_vec()], k);
        let read = BodyState::from_bytes(&bytes).unwrap();
        assert_eq!(read.to_bytes(), bytes);
        assert_eq!(bytes.len(), 12 + 2 * (40 + 4) + 32 * cuts.len());
        let mut body = kind.body(u64::from(k));
        if body.set_state(read).is_err() {
            continue;
        }
        for impulse in [1e-6, 1e-2, 10.0] {
            let contact = Contact {
                impulse,
                ..Contact::strike(Vec3::ONE, Vec3::NEG_ONE, 1.0, Striker::rigid())
            };
            let config = FractureConfig::default();
            used += usize::from(impact(&body, &[contact], &config).is_ok());
        }
    }
    assert!(used > 300, "{used}");
}

#[test]
fn the_state_that_fuzzing_starts_from_is_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/body_state");
    if !folder.is_dir() {
        println!("skipped: {} is not here", folder.display());
        return;
    }
    let bytes = state(&[vec![3, 4, 5], vec![11]], 5);
    let path = folder.join("two_cracks");
    if std::env::var_os("FRANGIBLE_WRITE_SEEDS").is_some() {
        fs::write(&path, &bytes).unwrap();
    }
    assert_eq!(
        fs::read(&path).unwrap(),
        bytes,
        "set FRANGIBLE_WRITE_SEEDS=1 to write it anew"
    );
    let state = BodyState::from_bytes(&bytes).unwrap();
    kind().body(1).set_state(state).unwrap();
}
