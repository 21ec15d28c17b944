//! Reports of contacts.

use glam::Vec3;

/// Report of one contact of a blow that was integrated: an outcome, not an input.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ContactReport {
    /// Point of contact on the surface, m, body frame.
    pub point: Vec3,
    /// Unit direction of the force on this body.
    pub normal: Vec3,
    /// Impulse along the normal until the contact parted, or the wall or the piece under it was cut free, N·s.
    pub impulse: f64,
    /// Speed of approach, m/s; 0 of a script.
    pub approach_speed: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Duration of the contact, s.
    pub duration: f64,
    /// Radius of the disc that touched at the peak force, m.
    pub contact_radius: f64,
    /// Speed at which the striker leaves the body as a rigid one, m/s; negative where it goes on into it. Over the speed of
    /// approach it is the coefficient of restitution.
    pub departure_speed: f64,
    /// Energy that went into crushing the weaker of the two bodies where they touched, J.
    pub crushing_energy: f64,
    /// Volume that was crushed, m³: that energy over the pressure that crushes.
    pub crushed_volume: f64,
    /// Force at the end of each [time step](crate::ImpactReport::time_step), N. It is linear between them, and ends with the last.
    pub force: Vec<f32>,
}
