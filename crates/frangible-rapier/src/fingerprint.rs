//! A checksum of the state of motion, to verify that two machines in the same game agree.

use crate::world::BreakableWorld;

/// First value of the hash, and its factor: FNV-1a of 64 bits.
const START: u64 = 0xcbf2_9ce4_8422_2325;
const FACTOR: u64 = 0x0100_0000_01b3;

impl BreakableWorld {
    /// Returns a checksum of the bits of the poses, velocities and masses of all bodies. Worlds that differ in one of these bits have different
    /// checksums, except with a probability of 2⁻⁶⁴; worlds stepped alike have equal ones, on any machine if the feature `portable` is on.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hash = START;
        let mut add = |bits: u32| {
            for byte in bits.to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(FACTOR);
            }
        };
        for (handle, body) in self.physics.bodies.iter() {
            let (index, generation) = handle.into_raw_parts();
            add(index);
            add(generation);
            let (pose, v, w) = (body.position(), body.linvel(), body.angvel());
            let place = pose.translation.to_array();
            let turn = pose.rotation.to_array();
            let numbers = place.into_iter().chain(turn);
            let numbers = numbers.chain(v.to_array()).chain(w.to_array());
            for number in numbers.chain([body.mass()]) {
                add(number.to_bits());
            }
        }
        hash
    }
}
