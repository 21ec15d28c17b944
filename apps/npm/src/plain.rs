//! Contacts and motions as rows of numbers.

use frangible::glam::{DMat3, DQuat, DVec3, Vec3};
use frangible::internals::MassProperties;
use frangible::internals::outcome::ContactReport;
use frangible::internals::rigid::{
    Kick, Rigid, fly_through, nearest_first, take_blow, take_energy, take_held,
};
use frangible::{Asset, Contact, Fracture, ImpactReport, Striker};

/// Numbers of a contact: point, direction of the push (m, body frame), speed of approach (m/s), one over the striker's mass at the contact
/// (1/kg), its radius of curvature (m), plane-strain modulus (Pa), crushing pressure (Pa), coefficient of restitution; then of a scripted push
/// its impulse (N·s) and duration (s), zeros otherwise.
pub const CONTACT: usize = 16;

/// Numbers of a pose: position (m) and rotation (quaternion x, y, z, w).
pub const POSE: usize = 7;

/// Numbers of a motion: velocity of the centre of mass (m/s) and angular velocity (rad/s), world axes.
pub const MOTION: usize = 6;

/// Numbers of a striker: mass (kg), position of its centre of mass (m), moments of inertia about it (kg·m², world axes, column by column),
/// and its [`MOTION`].
pub const STRIKER: usize = 1 + 3 + 9 + MOTION;

fn vec(numbers: &[f64]) -> Vec3 {
    double(numbers).as_vec3()
}

fn double(numbers: &[f64]) -> DVec3 {
    DVec3::new(numbers[0], numbers[1], numbers[2])
}

/// Converts rows of [`CONTACT`] numbers to contacts in the body frame.
#[must_use]
pub fn contacts(rows: &[f64]) -> Vec<Contact> {
    let contact = |row: &[f64]| {
        let [point, push] = [vec(&row[0..]), vec(&row[3..])];
        if row[15] != 0.0 {
            return Contact::push(point, vec(&row[12..]), row[15] as f32);
        }
        let mut striker = Striker::rigid();
        striker.inverse_effective_mass = row[7] as f32;
        striker.curvature_radius = row[8] as f32;
        striker.contact_modulus = row[9] as f32;
        striker.crushing_pressure = row[10] as f32;
        striker.restitution = row[11] as f32;
        Contact::strike(point, push, row[6] as f32, striker)
    };
    rows.chunks_exact(CONTACT).map(contact).collect()
}

/// A body in the world: its pose, its motion just before a blow, and whether it is held.
struct Placed {
    at: DVec3,
    axes: DMat3,
    linear: DVec3,
    angular: DVec3,
    held: bool,
}

impl Placed {
    fn new(asset: &Asset, pose: &[f64], motion: &[f64]) -> Self {
        Self {
            at: double(pose),
            axes: DMat3::from_quat(DQuat::from_array([3, 4, 5, 6].map(|i| pose[i]))),
            linear: double(motion),
            angular: double(&motion[3..]),
            held: asset.is_supported(),
        }
    }

    /// A part of the body, as it moves with it. `holds`: true for one that is held where the body is.
    fn part(&self, mass: &MassProperties, holds: bool) -> Rigid {
        let centre = self.at + self.axes * mass.centre;
        if holds && self.held {
            return Rigid::immovable([centre, DVec3::ZERO, DVec3::ZERO]);
        }
        let inertia = self.axes * mass.inertia * self.axes.transpose();
        let [linear, angular] = if self.held {
            [DVec3::ZERO; 2]
        } else {
            let moving = self.linear + self.angular.cross(centre - self.at);
            [moving, self.angular]
        };
        Rigid::free(mass.mass, inertia, [centre, linear, angular])
    }

    /// Impulses of a blow, at their places in the world.
    fn pushes(&self, report: &ImpactReport) -> Vec<(DVec3, DVec3)> {
        let push = |c: &ContactReport| {
            let [place, normal] = [c.point, c.normal].map(|v| self.axes * v.as_dvec3());
            (self.at + place, normal * c.impulse)
        };
        report.contacts.iter().map(push).collect()
    }
}

/// A striker of [`STRIKER`] numbers; none of no numbers.
fn striker_of(row: &[f64]) -> Vec<Rigid> {
    match row {
        [] => Vec::new(),
        row => vec![Rigid::free(
            row[0],
            DMat3::from_cols(double(&row[4..]), double(&row[7..]), double(&row[10..])),
            [double(&row[1..]), double(&row[13..]), double(&row[16..])],
        )],
    }
}

fn motion_of(body: &Rigid) -> Vec<f64> {
    [body.linear.to_array(), body.angular.to_array()].concat()
}

/// Computes the motions after a break: a row of [`MOTION`] numbers for each fragment, and one for the striker if there is one. `pose` and `motion`
/// are those of the body just before the break; `striker` has [`STRIKER`] numbers or is empty. A ball has flown through the fragments in its way.
/// Momentum and angular momentum are conserved; energy does not increase.
#[must_use]
pub fn motions(
    asset: &Asset,
    fracture: &Fracture,
    pose: &[f64],
    motion: &[f64],
    striker: &[f64],
) -> Vec<f64> {
    let body = Placed::new(asset, pose, motion);
    let points: Vec<Vec3> = fracture.report.contacts.iter().map(|c| c.point).collect();
    let order = nearest_first(fracture, &points);
    let fragments = order.iter().map(|&number| &fracture.fragments[number]);
    let mut bodies: Vec<Rigid> = fragments.map(|f| body.part(&f.mass, f.supported)).collect();
    let mut others = striker_of(striker);
    let pushes = body.pushes(&fracture.report);
    let about = Rigid::together(&others).centre;
    let taken = Kick::about(about, &pushes).scaled(-1.0);
    let lost = take_blow(
        fracture,
        (&order, body.axes),
        &mut bodies,
        &mut others,
        &pushes,
        taken,
    );
    let count = bodies.len();
    bodies.append(&mut others);
    if bodies.len() == count {
        bodies.push(Rigid::earth());
    }
    take_energy(&mut bodies, fracture.report.fracture_energy - lost);
    let (pieces, by) = bodies.split_at_mut(count);
    fly_through(fracture, (&order, body.axes, body.at), pieces, by);
    let mut rows = vec![0.0; MOTION * count];
    for (&number, body) in order.iter().zip(&bodies) {
        rows[MOTION * number..][..MOTION].copy_from_slice(&motion_of(body));
    }
    if !striker.is_empty() {
        rows.extend(motion_of(&bodies[count]));
    }
    rows
}

/// Computes the motions after a blow that a body has withstood, like [`motions`]: a row for the body, and one for the striker if there is one. A blow
/// that a bound has refused has no contacts in its report, and changes nothing: there the engine's own contact counts.
#[must_use]
pub fn motions_held(
    asset: &Asset,
    report: &ImpactReport,
    pose: &[f64],
    motion: &[f64],
    striker: &[f64],
) -> Vec<f64> {
    let body = Placed::new(asset, pose, motion);
    let mass = MassProperties {
        centre: DVec3::ZERO,
        ..asset.mass()
    };
    let (mut whole, mut by) = (body.part(&mass, true), striker_of(striker));
    take_held(&mut whole, &mut by, &body.pushes(report));
    let all = std::iter::once(&whole).chain(&by);
    all.flat_map(motion_of).collect()
}

/// Transforms rows of contacts from world axes to the frame of a body at this [`POSE`].
pub fn to_body_frame(rows: &mut [f64], pose: &[f64]) {
    let at = double(pose);
    let back = DQuat::from_array([3, 4, 5, 6].map(|i| pose[i])).inverse();
    for row in rows.chunks_exact_mut(CONTACT) {
        let point = back * (double(row) - at);
        let [push, impulse] = [3, 12].map(|i| back * double(&row[i..]));
        row[..3].copy_from_slice(&point.to_array());
        row[3..6].copy_from_slice(&push.to_array());
        row[12..15].copy_from_slice(&impulse.to_array());
    }
}
