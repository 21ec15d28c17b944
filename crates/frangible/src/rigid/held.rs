//! The impulse of a blow on a body that has withstood it.

use glam::DVec3;

use super::meet::meet;
use super::{Kick, Pushes, Rigid, push_whole};

/// Lets a blow that a body has withstood act on it and on its striker: itself, the pieces that it has become, or none where it does not give way. A
/// striker that would still approach the body goes on with it. Returns the energy that the motion loses, J; it goes into vibration.
pub fn take_held(body: &mut Rigid, striker: &mut [Rigid], pushes: &Pushes) -> f64 {
    let about = Rigid::together(striker).centre;
    let taken = Kick::about(about, pushes).scaled(-1.0);
    let mut lost = push_whole(std::slice::from_mut(body), striker, pushes, taken);
    let mut still = Rigid::earth();
    let other = match striker {
        [only] => only,
        [] => &mut still,
        _ => return lost,
    };
    for &(point, impulse) in pushes {
        let normal: DVec3 = impulse.normalize_or_zero();
        let arms = [point - body.centre, point - other.centre];
        lost += meet(body, other, normal, arms);
    }
    lost
}
