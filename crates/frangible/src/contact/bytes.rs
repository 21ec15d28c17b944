//! Serialization of contacts. A contact and the body's seed suffice to replay a break elsewhere.

use std::sync::Arc;

use glam::Vec3;

use super::{Contact, Receptance, SharedMass, Striker};
use crate::error::InputError;

/// Numbers of a contact.
const NUMBERS: usize = Contact::BYTES / 4;

/// Numbers of a contact but for those of a shared mass and of a receptance.
const OWN: usize = NUMBERS - 8;

impl Contact {
    /// Length of a contact in bytes, without the receptance of a vibrating striker.
    #[doc(hidden)]
    pub const BYTES: usize = 104;

    /// Serializes the contact: its fields in order, little-endian, four bytes each; then 0, or the number of modes of a vibrating striker
    /// plus one, followed by its receptance with eight bytes per number.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut contact = self.clone();
        // A striker that shares its mass has the number of its body plus one, and 0 says that it does not.
        let (number, velocity, spin) = (self.striker.shared.as_ref())
            .map_or((0, Vec3::ZERO, Vec3::ZERO), |shared| {
                (shared.body + 1, shared.velocity, shared.spin)
            });
        let ([vx, vy, vz], [sx, sy, sz]) = (velocity.to_array(), spin.to_array());
        let shared = [f32::from_bits(number), vx, vy, vz, sx, sy, sz];
        let numbers = contact.numbers().into_iter().map(|&mut number| number);
        let mut bytes: Vec<u8> = numbers.chain(shared).flat_map(f32::to_le_bytes).collect();
        let receptance = self.striker.receptance.as_ref();
        let modes = receptance.map_or(0, |felt| felt.eigenvalues.len() as u32 + 1);
        bytes.extend(modes.to_le_bytes());
        if let Some(felt) = receptance {
            bytes.extend(felt.to_numbers().into_iter().flat_map(f64::to_le_bytes));
        }
        bytes
    }

    /// Reads what [`Contact::to_bytes`] wrote, and checks it.
    ///
    /// # Errors
    /// Too few or too many bytes, or the errors of [`Contact::validate`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, InputError> {
        match Self::read(bytes)? {
            (contact, []) => Ok(contact),
            _ => Err(InputError::ContactBytes(bytes.len())),
        }
    }

    /// Reads the first of several consecutive contacts, and returns it with the remaining bytes.
    ///
    /// # Errors
    /// Too few bytes, or the errors of [`Contact::validate`].
    #[doc(hidden)]
    pub fn read(bytes: &[u8]) -> Result<(Self, &[u8]), InputError> {
        let short = || InputError::ContactBytes(bytes.len());
        let (head, rest) = bytes
            .split_first_chunk::<{ Self::BYTES }>()
            .ok_or_else(short)?;
        let mut read = (head.as_chunks().0.iter()).map(|&place| f32::from_le_bytes(place));
        let mut contact = Self::strike(Vec3::ZERO, Vec3::ZERO, 0.0, Striker::rigid());
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
        let mut left = rest;
        let modes = read.next().map_or(0, f32::to_bits);
        if let Some(modes) = modes.checked_sub(1) {
            let numbers = Receptance::numbers_of(modes as usize);
            let (numbers, behind) =
                (rest.split_at_checked(numbers.saturating_mul(8))).ok_or_else(short)?;
            let numbers = numbers.as_chunks().0.iter().map(|&n| f64::from_le_bytes(n));
            let felt = Receptance::of_numbers(&numbers.collect::<Vec<f64>>(), modes as usize)?;
            contact.striker.receptance = Some(Arc::new(felt));
            left = behind;
        }
        contact.validate()?;
        Ok((contact, left))
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
            &mut s.contact_modulus, &mut s.crushing_pressure, &mut s.inverse_effective_mass, &mut s.curvature_radius, &mut s.restitution, &mut s.modal_duration,
        ];
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact() -> Contact {
        let mut contact = Contact {
            impulse: 1.5,
            ..Contact::strike(
                Vec3::new(0.1, -0.2, 0.3),
                Vec3::new(0.6, 0.0, -0.8),
                7.25,
                Striker::rigid(),
            )
        };
        contact.friction = Vec3::new(0.01, f32::MIN_POSITIVE, -0.0);
        contact
    }

    fn shared() -> Contact {
        let mut contact = contact();
        contact.striker.inverse_effective_mass = 3.0;
        contact.striker.shared = Some(SharedMass {
            body: 3,
            velocity: Vec3::new(0.5, 0.0, -0.25),
            spin: Vec3::new(0.0, -1.5, 0.125),
        });
        contact
    }

    /// A striker of two modes, one of which follows the force, with a wall.
    fn flexible() -> Contact {
        let mut contact = shared();
        let mut numbers = vec![1.0, 1e-7, 2.0, 0.03, 2.0];
        numbers.extend([2e-3, 50.0, 5.0, 0.0, 4e7, 1e-5, 7e10, 0.22]);
        numbers.extend([0.05, 3e4, 0.8]);
        numbers.extend([1e8, 4e8, 0.5, -0.3]);
        let felt = Receptance::of_numbers(&numbers, 2).unwrap();
        contact.striker.receptance = Some(Arc::new(felt));
        contact.validate().unwrap();
        contact
    }

    #[test]
    fn a_contact_survives_its_bytes() {
        for contact in [contact(), shared(), flexible()] {
            let bytes = contact.to_bytes();
            let back = Contact::from_bytes(&bytes).unwrap();
            assert_eq!(back, contact);
            assert_eq!(back.to_bytes(), bytes);
        }
    }

    #[test]
    fn contacts_that_follow_each_other_are_read_one_by_one() {
        let contacts = [flexible(), contact(), flexible(), shared()];
        let bytes: Vec<u8> = contacts.iter().flat_map(Contact::to_bytes).collect();
        let mut left = &bytes[..];
        for contact in &contacts {
            let (read, behind) = Contact::read(left).unwrap();
            assert_eq!(&read, contact);
            left = behind;
        }
        assert!(left.is_empty());
        assert!(Contact::from_bytes(&bytes).is_err(), "four are not one");
    }

    #[test]
    fn a_receptance_of_absurd_numbers_is_refused() {
        let bytes = flexible().to_bytes();
        for length in Contact::BYTES..bytes.len() {
            assert_eq!(
                Contact::from_bytes(&bytes[..length]),
                Err(InputError::ContactBytes(length))
            );
        }
        for number in 0..Receptance::numbers_of(2) {
            for value in [f64::NAN, f64::INFINITY, -1e300] {
                let mut changed = bytes.clone();
                let at = Contact::BYTES + 8 * number;
                changed[at..at + 8].copy_from_slice(&value.to_le_bytes());
                let read = Contact::from_bytes(&changed);
                // A wall may be endlessly wide.
                let meant = number == 13 && value == f64::INFINITY;
                assert_eq!(read.is_ok(), meant, "{number}: {value}");
            }
        }
        let mut many = bytes;
        many[Contact::BYTES - 4..Contact::BYTES].fill(0xff);
        assert!(Contact::from_bytes(&many).is_err());
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
        signed[4 * 19 + 3] = 0x80;
        assert!(Contact::from_bytes(&signed).is_err(), "a zero with a sign");
        let bytes = shared().to_bytes();
        for length in 0..bytes.len() {
            assert_eq!(
                Contact::from_bytes(&bytes[..length]),
                Err(InputError::ContactBytes(length))
            );
        }
        for number in 0..NUMBERS - 1 {
            for value in [f32::NAN, f32::NEG_INFINITY] {
                let mut changed = bytes.clone();
                changed[4 * number..4 * number + 4].copy_from_slice(&value.to_le_bytes());
                assert!(Contact::from_bytes(&changed).is_err(), "{number}: {value}");
            }
        }
    }
}
