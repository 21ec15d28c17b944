//! A contact as bytes: with the body's seed all that a break needs to be replayed elsewhere.

use glam::Vec3;

use super::{Contact, SharedMass, Striker};
use crate::error::InputError;

/// Numbers of a contact.
const NUMBERS: usize = Contact::BYTES / 4;

/// Numbers of a contact but for those of a shared mass.
const OWN: usize = NUMBERS - 7;

impl Contact {
    /// Length of a contact in bytes.
    pub const BYTES: usize = 96;

    /// The contact as bytes: its numbers in the order of the fields, little-endian, four bytes each.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut contact = *self;
        // A striker that shares its mass has the number of its body plus one, and 0 says that it does not.
        let (number, velocity, spin) = (self.striker.shared.as_ref())
            .map_or((0, Vec3::ZERO, Vec3::ZERO), |shared| {
                (shared.body + 1, shared.velocity, shared.spin)
            });
        let ([vx, vy, vz], [sx, sy, sz]) = (velocity.to_array(), spin.to_array());
        let shared = [f32::from_bits(number), vx, vy, vz, sx, sy, sz];
        let numbers = contact.numbers().into_iter().map(|&mut number| number);
        let mut bytes = [0; Self::BYTES];
        for (place, number) in bytes
            .as_chunks_mut()
            .0
            .iter_mut()
            .zip(numbers.chain(shared))
        {
            *place = number.to_le_bytes();
        }
        bytes
    }

    /// Reads what [`Contact::to_bytes`] wrote, and checks it.
    ///
    /// # Errors
    /// Another number of bytes than [`Contact::BYTES`], or what [`Contact::validate`] refuses.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, InputError> {
        let Ok(bytes) = <&[u8; Self::BYTES]>::try_from(bytes) else {
            return Err(InputError::ContactBytes(bytes.len()));
        };
        let mut read = (bytes.as_chunks().0.iter()).map(|&place| f32::from_le_bytes(place));
        let mut contact = Self::new(Vec3::ZERO, Vec3::ZERO, 0.0, 0.0, Striker::rigid());
        for (number, read) in contact.numbers().into_iter().zip(&mut read) {
            *number = read;
        }
        let [number, vx, vy, vz, sx, sy, sz] = std::array::from_fn(|_| read.next().unwrap_or(0.0));
        let shared = SharedMass {
            body: number.to_bits().wrapping_sub(1),
            velocity: Vec3::new(vx, vy, vz),
            spin: Vec3::new(sx, sy, sz),
        };
        // Bit for bit: a zero with a sign would not be written again.
        let alone = [number, vx, vy, vz, sx, sy, sz]
            .iter()
            .all(|x| x.to_bits() == 0);
        contact.striker.shared = (!alone).then_some(shared);
        contact.validate()?;
        Ok(contact)
    }

    /// The numbers of the contact in the order of its fields, but for those of a shared mass.
    fn numbers(&mut self) -> [&mut f32; OWN] {
        let Self {
            point,
            normal,
            impulse,
            friction,
            approach_speed,
            duration,
            striker: s,
        } = self;
        let [[px, py, pz], [nx, ny, nz], [fx, fy, fz]] =
            [point, normal, friction].map(|v| v.as_mut().each_mut());
        #[rustfmt::skip]
        let numbers = [
            px, py, pz, nx, ny, nz, impulse, fx, fy, fz, approach_speed, duration,
            &mut s.contact_modulus, &mut s.inverse_effective_mass, &mut s.curvature_radius, &mut s.restitution, &mut s.modal_duration,
        ];
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact() -> Contact {
        let mut contact = Contact::new(
            Vec3::new(0.1, -0.2, 0.3),
            Vec3::new(0.6, 0.0, -0.8),
            1.5,
            7.25,
            Striker::rigid(),
        );
        contact.friction = Vec3::new(0.01, f32::MIN_POSITIVE, -0.0);
        contact
    }

    fn shared() -> Contact {
        let mut contact = contact();
        contact.striker.shared = Some(SharedMass {
            body: 3,
            velocity: Vec3::new(0.5, 0.0, -0.25),
            spin: Vec3::new(0.0, -1.5, 0.125),
        });
        contact
    }

    #[test]
    fn a_contact_survives_its_bytes() {
        for contact in [contact(), shared()] {
            let bytes = contact.to_bytes();
            let back = Contact::from_bytes(&bytes).unwrap();
            assert_eq!(back, contact);
            assert_eq!(back.to_bytes(), bytes);
        }
    }

    #[test]
    fn the_bytes_of_a_contact_are_the_same_on_every_machine() {
        let bytes = contact().to_bytes();
        assert_eq!(bytes[..4], [0xcd, 0xcc, 0xcc, 0x3d]);
        assert_eq!(bytes[24..28], [0, 0, 0xc0, 0x3f]);
        assert_eq!(bytes[48..52], [0, 0, 0x80, 0x7f]);
    }

    #[test]
    fn hostile_bytes_are_refused_and_never_a_panic() {
        let mut signed = contact().to_bytes();
        signed[4 * 18 + 3] = 0x80;
        assert!(Contact::from_bytes(&signed).is_err(), "a zero with a sign");
        let bytes = shared().to_bytes();
        for length in 0..bytes.len() {
            assert_eq!(
                Contact::from_bytes(&bytes[..length]),
                Err(InputError::ContactBytes(length))
            );
        }
        for number in 0..NUMBERS {
            for value in [f32::NAN, f32::NEG_INFINITY] {
                let mut changed = bytes;
                changed[4 * number..4 * number + 4].copy_from_slice(&value.to_le_bytes());
                assert!(Contact::from_bytes(&changed).is_err(), "{number}: {value}");
            }
        }
    }
}
