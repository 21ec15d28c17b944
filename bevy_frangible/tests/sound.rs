//! A break is heard at its time, with its loudness, and alike in two runs.

use crate::common::{STEP, app_with, bodies, body, ready};
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{Ears, FrangibleSoundPlugin, Heard};

const RATE: f64 = 48_000.0;
/// Speed of sound, m/s.
const SPEED: f64 = 343.0;
/// Vector from the place where the pane lands to the ears, m.
const AWAY: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// Time at which the pane broke, s of the fixed steps.
#[derive(Resource, Default)]
struct BrokeAt(Option<f64>);

/// Sound of a pane that falls flat from a height, m, during one second: pressures, Pa, left and right in turn; the samples for a loudspeaker; the
/// time at which it broke, s.
fn fall(height: f32, listens: bool) -> (Vec<f32>, Vec<f32>, Option<f64>) {
    let (mut app, _) = app_with(bodies(), |app| {
        app.add_plugins(FrangibleSoundPlugin::default())
            .init_resource::<BrokeAt>()
            .add_observer(
                |_: On<Broke>, time: Res<Time<Fixed>>, mut at: ResMut<BrokeAt>| {
                    at.0.get_or_insert(time.elapsed_secs_f64());
                },
            );
    });
    app.world_mut()
        .spawn((RigidBody::Static, Collider::half_space(Vec3::Y)));
    let place = Transform::from_translation(AWAY);
    let ears = app.world_mut().spawn(place).id();
    if listens {
        app.world_mut().entity_mut(ears).insert(Ears);
    }
    let flat = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let start = Transform::from_xyz(0.0, height, 0.0).with_rotation(flat);
    // How long a file takes to load is the machine's business.
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    let pane = body(&mut app, "pane", start);
    ready(&mut app, pane);
    app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    let outlet = app.world().resource::<Heard>().outlet();
    let (mut pressures, mut samples) = (Vec::new(), Vec::new());
    for _ in 0..(1.0 / STEP) as usize {
        app.update();
        pressures.extend_from_slice(app.world().resource::<Heard>().pressures());
        samples.extend(outlet.drain());
    }
    let broke = app.world().resource::<BrokeAt>().0;
    (pressures, samples, broke)
}

/// Time of the first sound, s after the first sample.
fn onset(pressures: &[f32]) -> Option<f64> {
    let first = pressures.iter().position(|&p| p != 0.0)?;
    Some((first / 2) as f64 / RATE)
}

fn loudest(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |most: f32, s| most.max(s.abs()))
}

#[test]
fn a_pane_that_breaks_is_heard_from_its_break_on() {
    let (pressures, samples, broke) = fall(1.5, true);
    let broke = broke.expect("it breaks");
    let heard = onset(&pressures).expect("it is heard");
    // Half a side of the pane is nearer.
    let [soonest, latest] = [0.85, 1.0].map(|far| broke + far / SPEED);
    println!(
        "broke at {broke:.4} s, heard at {heard:.4} s, {:.1} Pa",
        loudest(&pressures)
    );
    assert!((soonest - STEP..latest + STEP).contains(&heard));
    assert!(pressures.iter().all(|p| p.is_finite()));
    assert!((0.1..1000.0).contains(&loudest(&pressures)));
    assert!(samples.len() == pressures.len() && (0.01..1.0).contains(&loudest(&samples)));
    // Shards clatter after it.
    let later = ((broke + 0.1) * RATE) as usize * 2;
    assert!(loudest(&pressures[later..]) > 1e-3);
}

#[test]
fn two_runs_give_the_same_samples() {
    let bits = |samples: &[f32]| -> Vec<u32> { samples.iter().map(|s| s.to_bits()).collect() };
    let [one, two] = [0, 1].map(|_| fall(1.5, true));
    assert!(bits(&one.0) == bits(&two.0), "the pressures differ");
    assert!(bits(&one.1) == bits(&two.1), "the samples differ");
}

#[test]
fn what_holds_clinks_and_without_ears_nothing_is_heard() {
    let (pressures, _, broke) = fall(0.02, true);
    assert_eq!(broke, None);
    let (loud, heard) = (loudest(&pressures), onset(&pressures));
    println!("heard at {heard:?} s, {loud:.3} Pa");
    // It lands after √(2h/g).
    let lands = (2.0 * 0.019 / 9.81_f64).sqrt();
    let heard = heard.expect("it is heard");
    assert!(
        (lands - 0.01..lands + 0.03).contains(&heard),
        "{heard} {lands}"
    );
    assert!((1e-3..100.0).contains(&loud));
    let (silent, ..) = fall(0.5, false);
    assert_eq!(loudest(&silent), 0.0);
    assert_eq!(silent.len(), pressures.len());
}
