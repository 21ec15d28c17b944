//! Numbers, handles, strikers and contacts drawn from bytes.
#![expect(unsafe_code, reason = "the function that it calls takes pointers")]

use super::Wild;
use crate::*;

/// Numbers that arithmetic goes wrong with.
const ODD: [f64; 12] = [
    0.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    5e-324,
    1e-45,
    3.4e38,
    -3.4e38,
    1e-18,
    1e18,
];

impl Wild<'_> {
    pub(super) fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }

    pub(super) fn one_in(&mut self, chances: u8) -> bool {
        self.odd && self.byte() % chances == 1
    }

    pub(super) fn number(&mut self, usual: f64) -> f64 {
        if self.one_in(24) {
            return ODD[usize::from(self.byte()) % ODD.len()];
        }
        usual * (f64::from(self.byte()) / 128.0)
    }

    pub(super) fn vector(&mut self, usual: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.number(usual) - usual)
    }

    pub(super) fn index(&mut self, count: usize) -> usize {
        match self.byte() {
            255 if self.odd => usize::MAX,
            index => usize::from(index) % (count + 1),
        }
    }

    /// One of the handles that were made, which may have been freed, or a number that is none.
    pub(super) fn id(&mut self, ids: &[u64]) -> u64 {
        if self.one_in(16) {
            return u64::from(self.byte()) << 40;
        }
        // The last one is the likeliest to be of use.
        match self.byte() {
            usual if usual < 192 => ids[ids.len() - 1],
            other => ids[usize::from(other) % ids.len()],
        }
    }

    pub(super) fn breakable(&mut self) -> frangible_breakable {
        let ids: Vec<u64> = self.breakables.iter().map(|b| b.id).collect();
        frangible_breakable { id: self.id(&ids) }
    }

    pub(super) fn body(&mut self) -> frangible_body {
        let ids: Vec<u64> = self.bodies.iter().map(|b| b.id).collect();
        frangible_body { id: self.id(&ids) }
    }

    pub(super) fn outcome(&mut self) -> frangible_outcome {
        let ids: Vec<u64> = self.outcomes.iter().map(|b| b.id).collect();
        frangible_outcome { id: self.id(&ids) }
    }

    pub(super) fn size(&mut self, right: usize) -> u32 {
        let right = right as u32;
        if !self.one_in(16) {
            return right;
        }
        [0, 4, right - 1, right + 8, 1 << 31, u32::MAX][usize::from(self.byte()) % 6]
    }

    pub(super) fn striker(&mut self) -> frangible_striker {
        let name = [c"steel", c"glass", c"no such material", c"\xff"];
        let name = name[usize::from(self.byte()) % if self.odd { 4 } else { 2 }];
        // SAFETY: the name is a text, and the place is what the form says.
        let of = |place| unsafe { frangible_striker_of(name.as_ptr(), place) };
        let mut striker = self.form(of).unwrap_or_default();
        striker.size = self.size(size_of::<frangible_striker>());
        striker.kind = u32::from(self.byte()) % if self.odd { 5 } else { 3 };
        striker.mass = self.number(0.2);
        striker.radius = self.number(0.02);
        striker.centre = self.vector(0.1);
        for k in [0, 4, 8] {
            striker.inertia[k] = self.number(1e-4);
        }
        if self.one_in(4) {
            striker.inertia[1] = self.number(1e-3);
            striker.restitution = self.number(1.0);
            striker.contact_modulus = self.number(1e11);
            striker.crushing_pressure = self.number(1e9);
        }
        striker.motion.linear = self.vector(10.0);
        striker.motion.angular = self.vector(10.0);
        striker.body = self.body();
        if self.one_in(4) {
            striker.rotation = std::array::from_fn(|_| self.number(1.0));
        }
        striker
    }

    pub(super) fn contact(&mut self, strikers: usize) -> frangible_contact {
        let mut contact = frangible_contact {
            size: self.size(size_of::<frangible_contact>()),
            striker: self.index(strikers.saturating_sub(1)) as u32,
            point: self.vector(0.1),
            normal: self.vector(1.0),
            speed: self.number(15.0),
            ..Default::default()
        };
        match self.byte() % 4 {
            0 => contact.friction = self.vector(0.5),
            1 => (contact.impulse, contact.duration) = (self.vector(1.0), self.number(1e-3)),
            _ => {}
        }
        contact
    }

    pub(super) fn pose(&mut self) -> Option<frangible_pose> {
        let rotation = match self.byte() % 4 {
            0 => return None,
            1 if self.odd => std::array::from_fn(|_| self.number(1.0)),
            2 => [0.5, 0.5, -0.5, 0.5],
            _ => [0.0, 0.0, 0.0, 1.0],
        };
        let position = self.vector(0.1);
        Some(frangible_pose { position, rotation })
    }

    pub(super) fn motion(&mut self) -> frangible_motion {
        frangible_motion {
            linear: self.vector(5.0),
            angular: self.vector(5.0),
        }
    }
}
