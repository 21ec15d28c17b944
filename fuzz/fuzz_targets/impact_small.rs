#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| frangible_fuzz_targets::impact_small(bytes));
