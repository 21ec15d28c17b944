//! Contacts and strikers as C gives them.
#![expect(unsafe_code, reason = "exported functions take pointers")]

use std::ffi::c_char;

use frangible::glam::{DMat3, DQuat, DVec3, Vec3};
use frangible::internals::contact::SharedMass;
use frangible::{Contact, FractureConfig, Material, Striker};

use crate::body::BODIES;
use crate::entry::{Failure, entry, frangible_status};
use crate::memory::{Form, read_all, read_plain, text};
use crate::types::{
    FRANGIBLE_STRIKER_BALL, FRANGIBLE_STRIKER_BODY, FRANGIBLE_STRIKER_BREAKABLE,
    FRANGIBLE_STRIKER_FIXED, frangible_body, frangible_contact, frangible_motion, frangible_pose,
    frangible_striker,
};

/// A rotation's length may differ from 1 by this much: engines keep them to a few digits.
const OFF_UNIT: f64 = 1e-3;

/// Fills a striker with the numbers of a named material: "steel", "glass", "stone", "wood", "rubber", "concrete" … It is fixed and flat: set its
/// kind, mass, radius and centre if it is not.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_striker_of(
    material: *const c_char,
    out: *mut frangible_striker,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        // SAFETY: by the contract of the crate.
        let material = unsafe { text(material, "material") }?;
        let material = Material::preset(material).map_err(Failure::input)?;
        out.fill(&frangible_striker {
            kind: FRANGIBLE_STRIKER_FIXED,
            contact_modulus: material.contact_modulus(),
            crushing_pressure: material.crushing_pressure,
            restitution: material.restitution,
            radius: f64::INFINITY,
            mass: f64::INFINITY,
            rotation: DQuat::IDENTITY.to_array(),
            ..Default::default()
        });
        Ok(())
    })
}

/// Arguments of a blow, as the caller gives them.
#[derive(Clone, Copy)]
pub(crate) struct Given {
    pub(crate) contacts: *const frangible_contact,
    pub(crate) contact_count: usize,
    pub(crate) strikers: *const frangible_striker,
    pub(crate) striker_count: usize,
    pub(crate) pose: *const frangible_pose,
}

impl Given {
    /// Reads and checks a blow. Its contacts are in the frame of the body.
    ///
    /// # Safety
    /// The arrays have as many elements as it says, and the pose is null or one.
    pub(crate) unsafe fn read(self) -> Result<Vec<Contact>, Failure> {
        // SAFETY: by the caller.
        let contacts = unsafe { read_all(self.contacts, self.contact_count, "contacts") }?;
        // SAFETY: by the caller.
        let strikers = unsafe { read_all(self.strikers, self.striker_count, "strikers") }?;
        let (at, turn) = if self.pose.is_null() {
            (DVec3::ZERO, DQuat::IDENTITY)
        } else {
            // SAFETY: by the caller.
            pose(&unsafe { read_plain(self.pose, "pose") }?)?
        };
        let mut shares = vec![0_usize; strikers.len()];
        for contact in contacts.iter().filter(|c| c.duration == 0.0) {
            if let Some(share) = shares.get_mut(contact.striker as usize) {
                *share += 1;
            }
        }
        let mut read = Vec::with_capacity(contacts.len());
        for (number, contact) in contacts.iter().enumerate() {
            let named = |text: String| Failure::input(format!("contacts[{number}]: {text}"));
            let contact = if contact.duration == 0.0 {
                let index = contact.striker as usize;
                let given = strikers.get(index).ok_or_else(|| {
                    Failure::range(format!(
                        "contacts[{number}].striker is {index}, and there are {} strikers",
                        strikers.len()
                    ))
                })?;
                let share = (shares[index] > 1).then_some(index as u32);
                collision(contact, given, share).map_err(|Failure(status, text)| {
                    Failure(status, format!("contacts[{number}]: {text}"))
                })?
            } else {
                script(contact)
            };
            let contact = in_frame(contact, at, turn);
            contact.validate().map_err(|e| named(e.to_string()))?;
            read.push(contact);
        }
        Ok(read)
    }
}

/// Position and rotation of a pose.
pub(crate) fn pose(pose: &frangible_pose) -> Result<(DVec3, DQuat), Failure> {
    let at = finite(pose.position, "pose.position")?;
    Ok((at, rotation(pose.rotation, "pose.rotation")?))
}

fn rotation(numbers: [f64; 4], name: &str) -> Result<DQuat, Failure> {
    let turn = DQuat::from_array(numbers);
    // NaN is not near 1 either.
    if (turn.length() - 1.0).abs() <= OFF_UNIT {
        return Ok(turn.normalize());
    }
    Err(Failure::input(format!(
        "{name} is {numbers:?}; give a quaternion x, y, z, w of length 1"
    )))
}

fn finite(numbers: [f64; 3], name: &str) -> Result<DVec3, Failure> {
    let vector = DVec3::from_array(numbers);
    if vector.is_finite() {
        return Ok(vector);
    }
    Err(Failure::input(format!(
        "{name} is {numbers:?}; give three finite numbers"
    )))
}

/// Both velocities of a motion, if they are numbers.
pub(crate) fn motion(motion: &frangible_motion, name: &str) -> Result<[DVec3; 2], Failure> {
    Ok([
        finite(motion.linear, &format!("{name}.linear"))?,
        finite(motion.angular, &format!("{name}.angular"))?,
    ])
}

fn script(given: &frangible_contact) -> Contact {
    let [point, impulse] = [given.point, given.impulse].map(single);
    Contact::push(point, impulse, given.duration as f32)
}

fn single(numbers: [f64; 3]) -> Vec3 {
    DVec3::from_array(numbers).as_vec3()
}

/// A contact with a striker, in the axes that it is given in. `share`: the number of a striker that has several contacts.
fn collision(
    given: &frangible_contact,
    by: &frangible_striker,
    share: Option<u32>,
) -> Result<Contact, Failure> {
    let [point, normal] = [given.point, given.normal].map(DVec3::from_array);
    let normal = normal.normalize_or_zero();
    let mut striker = Striker::rigid()
        .with_contact_modulus(by.contact_modulus)
        .with_curvature_radius(by.radius)
        .with_restitution(by.restitution);
    striker.crushing_pressure = by.crushing_pressure as f32;
    let solid = solid(by)?;
    if let Some((mass, centre, inverse)) = solid {
        let arm = match by.kind {
            FRANGIBLE_STRIKER_BALL => DVec3::ZERO,
            _ => point - centre,
        };
        let turn = arm.cross(normal);
        let give = 1.0 / mass + turn.dot(inverse * turn);
        striker.inverse_effective_mass = give as f32;
        striker.shared = share.map(|number| {
            let columns = [inverse.x_axis, inverse.y_axis, inverse.z_axis].map(|c| c.as_vec3());
            let velocity = (normal / mass.sqrt()).as_vec3();
            SharedMass::of(number, velocity, columns, turn.as_vec3())
        });
    }
    let mut contact = Contact::strike(
        point.as_vec3(),
        // As it is given, so that its check names what is wrong with it.
        single(given.normal),
        given.speed as f32,
        striker,
    );
    if by.kind == FRANGIBLE_STRIKER_BREAKABLE {
        vibrate(&mut contact, by, share)?;
    }
    let friction = DVec3::from_array(given.friction);
    if friction == DVec3::ZERO {
        return Ok(contact);
    }
    let along = friction - normal * normal.dot(friction);
    Ok(contact.with_friction(along.as_vec3()))
}

/// Mass, kg, centre, m, and inverse inertia, 1/(kg·m²), of a striker that moves.
pub(crate) fn solid(by: &frangible_striker) -> Result<Option<(f64, DVec3, DMat3)>, Failure> {
    match by.kind {
        FRANGIBLE_STRIKER_FIXED => return Ok(None),
        FRANGIBLE_STRIKER_BALL | FRANGIBLE_STRIKER_BODY | FRANGIBLE_STRIKER_BREAKABLE => {}
        kind => {
            return Err(Failure::input(format!(
                "striker.kind is {kind}; give FRANGIBLE_STRIKER_FIXED, _BALL, _BODY or _BREAKABLE"
            )));
        }
    }
    if !(by.mass > 0.0 && by.mass.is_finite()) {
        return Err(Failure::input(format!(
            "striker.mass is {}; give a number above zero, kg, or the kind FRANGIBLE_STRIKER_FIXED",
            by.mass
        )));
    }
    let centre = finite(by.centre, "striker.centre")?;
    let inverse = inertia(by)?.inverse();
    if inverse.is_finite() && inverse.determinant() > 0.0 {
        return Ok(Some((by.mass, centre, inverse)));
    }
    Err(Failure::input(format!(
        "striker.inertia is {:?}; give the nine numbers of the inertia of a solid body, kg·m²",
        by.inertia
    )))
}

/// Inertia of a striker, kg·m².
pub(crate) fn inertia(by: &frangible_striker) -> Result<DMat3, Failure> {
    if by.kind != FRANGIBLE_STRIKER_BALL || by.inertia != [0.0; 9] {
        return Ok(DMat3::from_cols_array(&by.inertia));
    }
    if by.radius > 0.0 && by.radius.is_finite() {
        let moment = 0.4 * by.mass * by.radius * by.radius;
        return Ok(DMat3::from_diagonal(DVec3::splat(moment)));
    }
    Err(Failure::input(format!(
        "striker.radius of the ball is {}; give a number above zero, m, or its inertia",
        by.radius
    )))
}

/// The striker is breakable: it vibrates under the blow, as one body at all its contacts.
fn vibrate(
    contact: &mut Contact,
    by: &frangible_striker,
    share: Option<u32>,
) -> Result<(), Failure> {
    let frangible_body { id } = by.body;
    let back = rotation(by.rotation, "striker.rotation")?.inverse();
    let point = contact.point.as_dvec3() - DVec3::from_array(by.centre);
    let felt = Contact {
        point: (back * point).as_vec3(),
        normal: (back * -contact.normal.as_dvec3()).as_vec3(),
        ..contact.clone()
    };
    let body = BODIES.get(id)?.snapshot();
    let flexible =
        Striker::flexible(&body, &felt, &FractureConfig::default()).map_err(Failure::input)?;
    let striker = &mut contact.striker;
    striker.curvature_radius = flexible.curvature_radius;
    striker.receptance = flexible.receptance;
    if let (None, Some(number)) = (striker.shared, share) {
        striker.shared = Some(SharedMass::immovable(number));
    }
    Ok(())
}

/// A contact in the frame of a body at this place.
fn in_frame(mut contact: Contact, at: DVec3, turn: DQuat) -> Contact {
    let back = turn.inverse();
    let turned = |v: Vec3| (back * v.as_dvec3()).as_vec3();
    contact.point = (back * (contact.point.as_dvec3() - at)).as_vec3();
    contact.normal = turned(contact.normal);
    contact.friction = turned(contact.friction);
    contact
}
