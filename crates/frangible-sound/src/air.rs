//! Properties of air.

/// Density of air at 20 °C and 1013 hPa, kg/m³.
pub const AIR_DENSITY: f64 = 1.204;

/// Speed of sound in air at 20 °C, m/s.
pub const SPEED_OF_SOUND: f64 = 343.2;
