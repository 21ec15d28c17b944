//! The air that carries the sound.

/// Air at 20 °C and 1013 hPa: density, kg/m³.
pub const AIR_DENSITY: f64 = 1.204;

/// Speed of sound in it, m/s.
pub const SPEED_OF_SOUND: f64 = 343.2;
