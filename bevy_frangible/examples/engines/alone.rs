//! A blow without an engine.

use std::f64::consts::PI;

use bevy_frangible::frangible::glam::{DMat3, DVec3, Vec3};
use bevy_frangible::frangible::internals::rigid::{
    Kick, Rigid, fly_through, nearest_first, take_blow, take_energy, take_held,
};
use bevy_frangible::frangible::{
    Contact, FractureConfig, InputError, Outcome, Striker as Properties, impact,
};

use super::scenes::{Scene, Solid};

/// Speed that a ball loses to a free pane, m/s: its speed just after the blow is one of the blow's outcomes. None in any other scene.
///
/// # Errors
/// An error of the impact.
pub fn lost(scene: &Scene, seed: u64) -> Result<Option<f64>, InputError> {
    let Some((striker, Solid::Ball(radius))) = scene.striker.as_ref().map(|s| (s, s.solid)) else {
        return Ok(None);
    };
    let (body, start) = (scene.kind.body(seed), striker.start);
    let mass = striker.material.density * 4.0 / 3.0 * PI * f64::from(radius).powi(3);
    let speed = start.velocity.length();
    let place = body
        .nearest_on_surface(start.at - Vec3::Z * start.at.z * 0.9)
        .position;
    let by = Properties::ball(&striker.material, mass, f64::from(radius));
    let contact = Contact::strike(place, start.velocity / speed, speed, by);
    let normal = contact.normal.as_dvec3();
    let point = place.as_dvec3();
    let inertia = DMat3::from_diagonal(DVec3::splat(0.4 * mass * f64::from(radius).powi(2)));
    let centre = point - normal * f64::from(radius);
    let velocity = normal * f64::from(speed);
    let mut ball = [Rigid::free(mass, inertia, [centre, velocity, DVec3::ZERO])];
    let still = |m: &bevy_frangible::frangible::MassProperties, centre: DVec3| {
        Rigid::free(m.mass, m.inertia, [centre, DVec3::ZERO, DVec3::ZERO])
    };
    let outcome = impact(&body, &[contact], &FractureConfig::default())?;
    let pushes: Vec<(DVec3, DVec3)> = (outcome.report().contacts.iter())
        .map(|c| (c.point.as_dvec3(), c.normal.as_dvec3() * c.impulse))
        .collect();
    if let Outcome::Broke(fracture) = &outcome {
        let order = nearest_first(fracture, &[place]);
        let fragments = order.iter().map(|&i| &fracture.fragments[i].mass);
        let mut all: Vec<Rigid> = fragments.map(|m| still(m, m.centre)).collect();
        let taken = Kick::about(centre, &pushes).scaled(-1.0);
        let axes = (&order[..], DMat3::IDENTITY);
        let gone = take_blow(fracture, axes, &mut all, &mut ball, &pushes, taken);
        all.extend(ball);
        take_energy(&mut all, fracture.report.fracture_energy - gone);
        let count = order.len();
        let (pieces, by) = all.split_at_mut(count);
        let place = (&order[..], DMat3::IDENTITY, DVec3::ZERO);
        fly_through(fracture, place, pieces, by);
        ball = [by[0]];
    } else {
        let mut whole = still(&body.asset().mass(), DVec3::ZERO);
        take_held(&mut whole, &mut ball, &pushes);
    }
    Ok(Some((velocity - ball[0].linear).dot(normal)))
}
