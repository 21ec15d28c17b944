//! Rigid bodies as plain numbers, and what a break does to their motion: the blow's impulse on the pieces about the contact, and the
//! cracks' energy taken from the motion. Momentum and angular momentum stay, and energy never rises.

use frangible::glam::{DMat3, DVec3};

/// A rigid body, world axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rigid {
    /// Mass, kg; infinite for one that does not give way.
    pub(crate) mass: f64,
    /// Moments of inertia about the centre, kg·m².
    pub(crate) inertia: DMat3,
    /// Centre of mass, m.
    pub(crate) centre: DVec3,
    /// Velocity of the centre, m/s.
    pub(crate) linear: DVec3,
    /// Angular velocity, rad/s.
    pub(crate) angular: DVec3,
}

/// Impulses at points, N·s and m.
pub(crate) type Pushes = [(DVec3, DVec3)];

impl Rigid {
    /// What does not move.
    pub(crate) fn earth() -> Self {
        Self {
            mass: f64::INFINITY,
            inertia: DMat3::IDENTITY,
            centre: DVec3::ZERO,
            linear: DVec3::ZERO,
            angular: DVec3::ZERO,
        }
    }

    pub(crate) fn gives_way(&self) -> bool {
        self.mass.is_finite()
    }

    #[cfg(test)]
    fn energy(&self) -> f64 {
        if !self.gives_way() {
            return 0.0;
        }
        let spin = self.angular.dot(self.inertia * self.angular);
        0.5 * (self.mass * self.linear.length_squared() + spin)
    }

    /// Bodies that move as one, with their mass, momentum and angular momentum; none of them: the earth.
    fn together(bodies: &[Self]) -> Self {
        match bodies {
            [] => return Self::earth(),
            [only] => return *only,
            _ => {}
        }
        let mass: f64 = bodies.iter().map(|b| b.mass).sum();
        let mean = |f: &dyn Fn(&Self) -> DVec3| -> DVec3 {
            bodies.iter().map(|b| f(b) * b.mass).sum::<DVec3>() / mass
        };
        let (centre, linear) = (mean(&|b| b.centre), mean(&|b| b.linear));
        let (mut inertia, mut spin) = (DMat3::ZERO, DVec3::ZERO);
        for b in bodies {
            let r = b.centre - centre;
            let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
            let steiner = DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer;
            inertia += b.inertia + steiner * b.mass;
            spin += b.inertia * b.angular + r.cross(b.linear - linear) * b.mass;
        }
        Self {
            mass,
            inertia,
            centre,
            linear,
            angular: inertia.inverse() * spin,
        }
    }

    /// What pushes change its velocity and spin by.
    fn answer(&self, pushes: &Pushes, sign: f64) -> (DVec3, DVec3) {
        if !self.gives_way() {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let (mut linear, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for &(point, impulse) in pushes {
            linear += impulse * sign;
            moment += (point - self.centre).cross(impulse * sign);
        }
        (linear / self.mass, self.inertia.inverse() * moment)
    }

    /// The rigid motion's velocity at a point.
    fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.linear + self.angular.cross(point - self.centre)
    }
}

/// Energy that a share s of pushes adds to two bodies, J: s · the first + ½ s² · the second.
fn price(plug: &Rigid, striker: &Rigid, pushes: &Pushes) -> (f64, f64) {
    let side = |body: &Rigid, sign: f64| {
        let (linear, angular) = body.answer(pushes, sign);
        let mut sums = (0.0, 0.0);
        for &(point, impulse) in pushes {
            let impulse = impulse * sign;
            sums.0 += impulse.dot(body.velocity_at(point));
            let arm = point - body.centre;
            sums.1 += impulse.dot(linear + angular.cross(arm));
        }
        if body.gives_way() {
            sums
        } else {
            (sums.0, 0.0)
        }
    };
    let ((a, b), (c, d)) = (side(plug, 1.0), side(striker, -1.0));
    (a + c, b + d)
}

/// Lets pushes act on bodies as on one; `whole` is what they are together.
fn push_together(bodies: &mut [Rigid], whole: &Rigid, pushes: &Pushes, sign: f64) {
    let (linear, angular) = whole.answer(pushes, sign);
    for body in bodies {
        let arm = body.centre - whole.centre;
        body.linear += linear + angular.cross(arm);
        body.angular += angular;
    }
}

fn scaled(pushes: &Pushes, share: f64) -> Vec<(DVec3, DVec3)> {
    pushes.iter().map(|&(p, j)| (p, j * share)).collect()
}

/// Puts a blow's impulses on the pieces that are nearest to it, and takes them from the striker: itself, the pieces that it has become, or
/// none where it does not give way. The pieces, in the order of their distance, take them as one body: the fewest that do not leave faster
/// than the striker follows. Where some are held, those take the rest. Returns the energy that the motion loses, J.
pub(crate) fn push_plug(pieces: &mut [Rigid], striker: &mut [Rigid], pushes: &Pushes) -> f64 {
    let whole = Rigid::together(striker);
    let mut lost = 0.0;
    let mut left = 1.0;
    let held = pieces.iter().any(|p| !p.gives_way());
    let first_holds = pieces.first().is_none_or(|p| !p.gives_way());
    let loose: Vec<usize> = (0..pieces.len())
        .filter(|&i| pieces[i].gives_way())
        .collect();
    let mut count = 1;
    while !first_holds && count <= loose.len() {
        let mut members: Vec<Rigid> = loose[..count].iter().map(|&i| pieces[i]).collect();
        let plug = Rigid::together(&members);
        let (work, give) = price(&plug, &whole, pushes);
        if work + give > 0.0 && count < loose.len() {
            count = (count + 1 + count / 8).min(loose.len());
            continue;
        }
        let share = if work >= 0.0 {
            0.0
        } else if held {
            (-work / give).min(1.0)
        } else {
            (-2.0 * work / give).min(1.0)
        };
        let scaled = scaled(pushes, share);
        push_together(&mut members, &plug, &scaled, 1.0);
        for (&i, member) in loose.iter().zip(members) {
            pieces[i] = member;
        }
        push_together(striker, &whole, &scaled, -1.0);
        lost -= share * work + 0.5 * share * share * give;
        left -= share;
        break;
    }
    if (held || first_holds) && left > 0.0 && !striker.is_empty() {
        let whole = Rigid::together(striker);
        let (work, give) = price(&Rigid::earth(), &whole, pushes);
        if work < 0.0 {
            let share = left.min(-2.0 * work / give);
            push_together(striker, &whole, &scaled(pushes, share), -1.0);
            lost -= share * work + 0.5 * share * share * give;
        }
    }
    lost.max(0.0)
}

/// Takes up to `energy`, J, from the motion of bodies against each other; returns what was taken. With one among them that does not give
/// way the motion counts against that one.
pub(crate) fn take_energy(bodies: &mut [Rigid], energy: f64) -> f64 {
    if energy.is_nan() || energy <= 0.0 {
        return 0.0;
    }
    let fixed = bodies.iter().find(|b| !b.gives_way()).copied();
    let loose: Vec<Rigid> = bodies.iter().filter(|b| b.gives_way()).copied().collect();
    if loose.is_empty() {
        return 0.0;
    }
    let common = fixed.unwrap_or_else(|| Rigid::together(&loose));
    let apart = |b: &Rigid| {
        let (u, w) = (
            b.linear - common.velocity_at(b.centre),
            b.angular - common.angular,
        );
        0.5 * (b.mass * u.length_squared() + w.dot(b.inertia * w))
    };
    let available: f64 = loose.iter().map(apart).sum();
    if !(available.is_finite() && available > 0.0) {
        return 0.0;
    }
    let scale = (1.0 - energy / available).max(0.0).sqrt();
    for b in bodies.iter_mut().filter(|b| b.gives_way()) {
        let at = common.velocity_at(b.centre);
        b.linear = at + (b.linear - at) * scale;
        b.angular = common.angular + (b.angular - common.angular) * scale;
    }
    energy.min(available)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(mass: f64, x: f64, speed: f64) -> Rigid {
        Rigid {
            mass,
            inertia: DMat3::from_diagonal(DVec3::splat(0.4 * mass * 1e-4)),
            centre: DVec3::X * x,
            linear: DVec3::X * speed,
            angular: DVec3::ZERO,
        }
    }

    fn momentum(bodies: &[Rigid]) -> DVec3 {
        bodies.iter().map(|b| b.linear * b.mass).sum()
    }

    #[test]
    fn a_plug_takes_the_impulse_and_no_energy_is_made() {
        for impulse in [0.01, 0.1, 1.0, 100.0] {
            let mut pieces = [0.02, 0.05, 0.4].map(|mass| ball(mass, 0.1, 0.0));
            let mut striker = ball(0.1, 0.0, 10.0);
            let all = |pieces: &[Rigid], striker: &Rigid| {
                let mut all = pieces.to_vec();
                all.push(*striker);
                all
            };
            let before = all(&pieces, &striker);
            let energy = |bodies: &[Rigid]| bodies.iter().map(Rigid::energy).sum::<f64>();
            let pushes = [(DVec3::X * 0.05, DVec3::X * impulse)];
            let lost = push_plug(&mut pieces, std::slice::from_mut(&mut striker), &pushes);
            let after = all(&pieces, &striker);
            assert!((momentum(&after) - momentum(&before)).length() < 1e-12);
            assert!(
                (energy(&after) + lost - energy(&before)).abs() < 1e-12,
                "{impulse}"
            );
            assert!(striker.linear.x < 10.0);
        }
    }

    #[test]
    fn a_toll_takes_what_it_should_and_keeps_momentum() {
        let mut bodies = [ball(1.0, 0.0, 3.0), ball(2.0, 1.0, -1.0)];
        let (before, energy) = (
            momentum(&bodies),
            bodies.iter().map(Rigid::energy).sum::<f64>(),
        );
        let taken = take_energy(&mut bodies, 2.0);
        let after = bodies.iter().map(Rigid::energy).sum::<f64>();
        assert!((taken - 2.0).abs() < 1e-12 && (energy - after - 2.0).abs() < 1e-12);
        assert!((momentum(&bodies) - before).length() < 1e-12);
        assert!(
            take_energy(&mut bodies, 1e9) < 10.0,
            "no more than there is"
        );
    }
}
