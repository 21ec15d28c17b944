//! Bodies that meet without rebound.

use glam::DVec3;

use super::{Kick, Rigid};

/// Slower approaches than this are none, m/s.
const LEAST: f64 = 1e-9;

/// Lets two bodies meet at a place: the impulse along `normal` on the first one that ends their approach there. `arms`: from the centre of each to
/// the place, m. Returns the energy that their motion loses, J: none if they do not approach.
pub(super) fn meet(first: &mut Rigid, second: &mut Rigid, normal: DVec3, arms: [DVec3; 2]) -> f64 {
    let kicks = [(normal, arms[0]), (-normal, arms[1])].map(|(linear, arm)| Kick {
        linear,
        moment: arm.cross(linear),
    });
    let speed = -(first.work(kicks[0]) + second.work(kicks[1]));
    let give = first.give(kicks[0]) + second.give(kicks[1]);
    if !(speed > LEAST && give > 0.0) {
        return 0.0;
    }
    let impulse = speed / give;
    for (body, kick) in [(first, kicks[0]), (second, kicks[1])] {
        if body.gives_way() {
            let (linear, angular) = body.answer(kick.scaled(impulse));
            body.linear += linear;
            body.angular += angular;
        }
    }
    0.5 * speed * impulse
}
