//! A session is heard by whoever listens, as fast as its clock runs.

use crate::common::{bits, give, pane};
use frangible_view::{Command, Outlet, Session};

const RATE: f64 = 48_000.0;

/// The pane with somebody who listens.
fn heard(test: &str) -> (Session, Outlet) {
    let (mut session, outlet) = (pane(test), Outlet::new(RATE));
    session.listen(outlet.clone());
    (session, outlet)
}

/// Takes steps until the pane is in pieces and some more. Returns all sound, and the time of the break, s.
fn listened(session: &mut Session, outlet: &Outlet) -> (Vec<f32>, f64) {
    let (mut samples, mut broke) = (Vec::new(), 0.0);
    while session.time() < 0.35 {
        give(session, "step 20");
        samples.extend(outlet.drain());
        if broke == 0.0 && session.shown().pieces > 0 {
            broke = session.blow().expect("a blow").time;
        }
    }
    (samples, broke)
}

#[test]
fn a_break_is_heard_when_its_sound_has_come_and_nothing_before() {
    let (mut session, outlet) = heard("heard");
    let (samples, broke) = listened(&mut session, &outlet);
    assert!(broke > 0.0);
    assert!(samples.iter().all(|s| s.is_finite() && s.abs() < 1.0));
    // The pane settles on its floor before, 40 dB softer.
    let first = samples.iter().position(|s| s.abs() > 0.1).expect("sound") / 2;
    let first = first as f64 / RATE;
    let home = session.shown().home;
    let way = f64::from((home.eye - home.target).length()) / 343.0;
    // The ears are where the camera is, and the pane is 0.2 m wide: a millisecond of way.
    assert!(
        (first - broke - way).abs() < 1.5e-3,
        "{first} s, broke at {broke} s, {way} s away"
    );
    // The same time was heard as went by; a block of samples is still to come.
    let missing = session.time() - samples.len() as f64 / 2.0 / RATE;
    assert!((0.0..4e-3).contains(&missing), "{missing} s");
}

#[test]
fn listening_changes_nothing_and_the_same_steps_sound_the_same() {
    let mut silent = pane("silent");
    let (mut first, outlet) = heard("first");
    let (samples, _) = listened(&mut first, &outlet);
    let (mut second, outlet) = heard("second");
    let (again, _) = listened(&mut second, &outlet);
    assert_eq!(samples, again);
    while silent.time() < 0.35 {
        give(&mut silent, "step 20");
    }
    assert_eq!(bits(&silent), bits(&first));
}

#[test]
fn slow_motion_is_as_much_longer_and_a_muted_session_is_silent() {
    let (mut session, outlet) = heard("slow");
    give(&mut session, "slow-motion 0.25");
    let (slow, _) = listened(&mut session, &outlet);
    let long = slow.len() as f64 / 2.0 / RATE;
    assert!(
        (long / (4.0 * session.time()) - 1.0).abs() < 0.01,
        "{long} s"
    );
    // In the middle of the sound, too, and at once.
    give(&mut session, "slow-motion 1");
    give(&mut session, "step 1");
    give(&mut session, "sound off");
    give(&mut session, "step 20");
    let muted = outlet.drain();
    assert!(!muted.is_empty() && muted.iter().all(|&s| s == 0.0));
    let (mut session, outlet) = heard("muted");
    give(&mut session, "sound off");
    let (muted, _) = listened(&mut session, &outlet);
    assert!(muted.iter().all(|&s| s == 0.0));
    give(&mut session, "sound on");
    give(&mut session, "volume 0.5");
    assert_eq!(session.shown().sound, Some((0.5, false)));
    for number in [Command::Volume(f64::NAN), Command::SlowMotion(f64::NAN)] {
        let error = session.apply(number).expect_err("NaN");
        assert!(error.to_string().contains("NaN"), "{error}");
    }
    assert_eq!(session.shown().sound, Some((0.5, false)));
}
