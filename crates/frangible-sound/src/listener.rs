//! The listener, and the sound paths to the ears.

use frangible::Material;
use glam::DVec3;

use crate::air::SPEED_OF_SOUND;
use crate::error::{SoundError, finite, within};

/// A pair of ears, or one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listener {
    /// Position of the head, m.
    pub place: DVec3,
    /// Unit direction to the right.
    pub right: DVec3,
    /// Number of channels: 2 for stereo, left and right; 1 for mono.
    pub channels: usize,
}

/// Half the way between the ears, m.
const HALF_HEAD: f64 = 0.09;

/// Longest way that sound is followed on, m.
const FARTHEST: f64 = 300.0;

/// Shortest way: nearer than this nobody holds an ear to what breaks, m.
const NEAREST: f64 = 0.05;

impl Listener {
    /// Creates a stereo listener at a position, m, facing another, m, with y up.
    #[must_use]
    pub fn at(place: DVec3, towards: DVec3) -> Self {
        let right = (towards - place).cross(DVec3::Y);
        Self {
            place,
            right: right.try_normalize().unwrap_or(DVec3::X),
            channels: 2,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The position or direction is not finite, or the number of channels is not 1 or 2.
    pub fn validate(&self) -> Result<(), SoundError> {
        for part in self.place.to_array() {
            finite(|| "the listener's place".into(), part)?;
        }
        let long = self.right.length();
        let range = "close to 1";
        let name = || "the length of the listener's direction to the right".into();
        within(name, long, (0.5..2.0).contains(&long), range)?;
        let channels = self.channels as f64;
        let fits = (1..=2).contains(&self.channels);
        within(|| "the number of channels".into(), channels, fits, "1 or 2").map(|_| ())
    }

    /// Position of each channel's ear, m.
    fn ears(&self) -> impl Iterator<Item = DVec3> {
        let side = if self.channels == 2 { HALF_HEAD } else { 0.0 };
        let signs: &[f64] = if self.channels == 2 {
            &[-1.0, 1.0]
        } else {
            &[1.0]
        };
        signs
            .iter()
            .map(move |sign| self.place + self.right * (sign * side))
    }

    /// Distance to a place, m, as gains are computed for.
    pub(crate) fn distance(&self, place: DVec3) -> f64 {
        (self.place - place).length().clamp(NEAREST, FARTHEST)
    }
}

/// A hard level floor, which reflects sound and sounds itself when struck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoundFloor {
    /// Height of the floor (y coordinate), m.
    pub height: f64,
    /// Reflected fraction of the pressure, 0–1: 0.97 for stone and concrete, whose absorption is 0.01 to 0.05 (any table of absorption
    /// coefficients), 0.8 for carpet.
    pub reflection: f64,
    /// Shear modulus of the floor's material, Pa.
    pub shear_modulus: f64,
    /// Poisson's ratio of the floor's material.
    pub poisson_ratio: f64,
}

impl SoundFloor {
    /// Creates a stone floor at this height, m.
    #[must_use]
    pub fn stone(height: f64) -> Self {
        Self {
            height,
            reflection: 0.97,
            shear_modulus: 22e9,
            poisson_ratio: 0.25,
        }
    }

    /// Creates a floor of this material at this height, m, with the reflection of stone.
    #[must_use]
    pub fn of(material: &Material, height: f64) -> Self {
        Self {
            shear_modulus: material.shear_modulus(),
            poisson_ratio: material.poisson_ratio,
            ..Self::stone(height)
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// A value is not finite or out of range.
    pub fn validate(&self) -> Result<(), SoundError> {
        finite(|| "the height of the floor".into(), self.height)?;
        let (share, modulus) = (self.reflection, self.shear_modulus);
        let fits = (0.0..=1.0).contains(&share);
        within(
            || "the reflection of the floor".into(),
            share,
            fits,
            "from 0 to 1",
        )?;
        let range = "above zero, in Pa";
        within(
            || "the shear modulus of the floor".into(),
            modulus,
            modulus > 0.0,
            range,
        )?;
        let nu = self.poisson_ratio;
        let fits = nu > -1.0 && nu <= 0.5;
        within(
            || "Poisson's ratio of the floor".into(),
            nu,
            fits,
            "between -1 and 0.5",
        )
        .map(|_| ())
    }
}

/// One way of the sound to one ear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Way {
    pub(crate) channel: usize,
    /// Delay until it arrives, in samples.
    pub(crate) delay: usize,
    /// Loudness relative to the sound at the middle of the head.
    pub(crate) gain: f32,
    /// True if the sound leaves towards the floor.
    pub(crate) by_floor: bool,
}

/// Ways to an ear, and ears.
pub(crate) const MOST_WAYS: usize = 4;

/// The ways of a sound, and their number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ways {
    ways: [Way; MOST_WAYS],
    count: usize,
}

impl Ways {
    /// Finds the ways from a sphere of a radius, m, at a place, m, directly and by the floor. The pressure at the listener's distance from it is
    /// taken as given for both.
    pub(crate) fn new(
        listener: &Listener,
        floor: Option<&SoundFloor>,
        rate: f64,
        place: DVec3,
        radius: f64,
    ) -> Self {
        let whole = listener.distance(place);
        let mut ways = Self::default();
        let mut add = |channel: usize, ear: DVec3, from: DVec3, share: f64, by_floor: bool| {
            let long = (ear - from).length().clamp(NEAREST, FARTHEST);
            let delay = (long - radius).max(0.0) / SPEED_OF_SOUND;
            ways.ways[ways.count] = Way {
                channel,
                delay: (delay * rate).round() as usize,
                gain: (share * whole / long) as f32,
                by_floor,
            };
            ways.count += 1;
        };
        for (channel, ear) in listener.ears().enumerate() {
            add(channel, ear, place, 1.0, false);
            if let Some(floor) = floor.filter(|f| f.reflection > 0.0) {
                let mut image = place;
                // A body that has sunk into the floor by the engine's tolerance lies on it.
                image.y = 2.0 * floor.height - place.y.max(floor.height);
                add(channel, ear, image, floor.reflection, true);
            }
        }
        ways
    }

    /// One way for each channel, from a place on the floor itself.
    pub(crate) fn from_floor(listener: &Listener, rate: f64, place: DVec3) -> Self {
        Self::new(listener, None, rate, place, 0.0)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Way> {
        self.ways[..self.count].iter()
    }
}

/// The longest delay, in samples.
pub(crate) fn longest_delay(rate: f64) -> usize {
    (FARTHEST / SPEED_OF_SOUND * rate).ceil() as usize + 1
}
