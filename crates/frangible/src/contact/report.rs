//! Reports of contacts.

use glam::Vec3;

/// Results for one contact of an integrated blow.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ContactReport {
    /// Point of contact on the surface, m, body frame.
    pub point: Vec3,
    /// Unit direction of the force on this body.
    pub normal: Vec3,
    /// Impulse along the normal until separation, or until the wall or piece under the contact was cut free, N·s.
    pub impulse: f64,
    /// Radius of curvature of the striker at the contact, m: infinite where it is flat, 0 for a script.
    #[doc(hidden)]
    pub striker_radius: f64,
    /// Approach speed, m/s; 0 for a script.
    #[doc(hidden)]
    pub approach_speed: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Duration of the contact, s.
    pub duration: f64,
    /// Radius of the contact area at the peak force, m.
    #[doc(hidden)]
    pub contact_radius: f64,
    /// Separation speed of striker and body as rigid bodies, m/s; negative if the striker continues into the body. Divided by the approach
    /// speed it is the coefficient of restitution.
    #[doc(hidden)]
    pub departure_speed: f64,
    /// Energy spent on crushing the weaker of the two bodies at the contact, J.
    #[doc(hidden)]
    pub crushing_energy: f64,
    /// Crushed volume, m³: the crushing energy over the crushing pressure.
    #[doc(hidden)]
    pub crushed_volume: f64,
    /// Force at the end of each [time step](crate::ImpactReport::time_step), N. It is linear between them, and ends with the last.
    #[doc(hidden)]
    pub force: Vec<f32>,
}
