//! A tree of coral.

use super::MILLIMETRE;
use crate::DistanceSolid;
use glam::{DQuat, DVec3};

/// Forks from the trunk to a tip.
const FORKS: u32 = 3;

/// A fork: how far its arms lean from the branch they grow on, rad.
const LEAN: [f64; 3] = [0.62, 0.66, 0.60];

/// Turn of a fork about its branch against the one before, rad.
const TURN: f64 = 1.9;

/// Lengths, mm, and radii, mm, of the trunk and of the branches after each fork.
const LENGTHS: [f64; 4] = [52.0, 58.0, 46.0, 40.0];
const RADII: [f64; 5] = [14.0, 10.5, 8.2, 6.6, 5.4];

/// A trunk on a foot of rock that parts into three branches, and those twice into two: twelve tips. 170 mm tall; the tips are 11 mm thick, and the
/// foot thins to 5 mm at its rim.
pub fn coral() -> DistanceSolid {
    let foot = DistanceSolid::ellipsoid(DVec3::new(0.0, 0.0, 2.0), DVec3::new(46.0, 42.0, 15.0));
    let trunk = Branch {
        from: DVec3::ZERO,
        turned: DQuat::from_rotation_x(0.04),
        grown: 0,
    };
    foot.smooth_union(trunk.solid(), 14.0)
        .intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .scaled(MILLIMETRE)
}

/// A piece from one fork to the next, along its own z.
struct Branch {
    from: DVec3,
    turned: DQuat,
    /// Forks before it.
    grown: u32,
}

impl Branch {
    /// The branch and all that grows on it.
    fn solid(&self) -> DistanceSolid {
        let at = self.grown as usize;
        let end = self.from + LENGTHS[at] * (self.turned * DVec3::Z);
        let mut solid = DistanceSolid::round_cone(self.from, RADII[at], end, RADII[at + 1]);
        if self.grown == FORKS {
            return solid;
        }
        let arms = if self.grown == 0 { 3 } else { 2 };
        for arm in 0..arms {
            let about = std::f64::consts::TAU * f64::from(arm) / f64::from(arms)
                + TURN * f64::from(self.grown);
            // No two arms are alike, so that no two tips tell the same.
            let lean = LEAN[arm as usize] - 0.05 * f64::from(self.grown);
            let turned = self.turned * DQuat::from_rotation_z(about) * DQuat::from_rotation_x(lean);
            let branch = Self {
                from: end,
                turned,
                grown: self.grown + 1,
            };
            solid = solid.smooth_union(branch.solid(), 6.0);
        }
        solid
    }
}
