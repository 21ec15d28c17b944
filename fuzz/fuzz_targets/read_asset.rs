//! Bytes that pass for a whole `.frangible` file are an error or a sound asset, never a panic.
#![no_main]

use frangible::Asset;
use frangible::internals::asset::seal;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let _ = Asset::from_bytes(data);
    // The checksum would stop every mutation.
    let mut sealed = data.to_vec();
    seal(&mut sealed);
    if let Ok(asset) = Asset::from_bytes(&sealed) {
        let bytes = asset.to_bytes();
        let back = Asset::from_bytes(&bytes).expect("what was written must be readable");
        assert_eq!(bytes, back.to_bytes());
    }
});
