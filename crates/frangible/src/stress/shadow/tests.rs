use super::*;
use crate::rng::{Purpose, stream, uniform};
use crate::stress::largest_eigenvalue;

/// [`share_beside`] for distances of a quarter, a half, one and two half-lengths.
fn shares(beta: f32) -> [f32; 4] {
    [0.25, 0.5, 1.0, 2.0].map(|y| share_beside(3.0 * y, 3.0, beta))
}

fn close(ours: [f32; 4], theirs: [f32; 4], to: f32) {
    for (ours, theirs) in ours.into_iter().zip(theirs) {
        assert!((ours - theirs).abs() <= to, "{ours} {theirs}");
    }
}

/// Tension across a crack on the real axis from −1 to 1, at i y on its middle line, of a sheet under unit tension:
/// Re Z + y Im Z', Z = z / √(z² − 1), by complex arithmetic and a difference quotient.
fn westergaard(y: f64) -> f64 {
    // z = i y: z² − 1 = −(y² + 1), whose root on the upper side of the crack is i √(y² + 1).
    let z = |y: f64| y / (y * y + 1.0).sqrt();
    // dZ/dz = dZ/d(i y) = −i dZ/dy.
    let slope = (z(y + 1e-5) - z(y - 1e-5)) / 2e-5;
    z(y) - y * slope
}

/// Bending moment across a crack on the real axis from −1 to 1, at i y on its middle line, of a plate bent by a unit moment: differences
/// of its deflection w = A Re F + y Im F', F'' = Z, which is biharmonic. A = −(1 + ν)/(1 − ν) leaves the crack's edges free of Kirchhoff's
/// force V = ∂/∂y (w_yy + (2 − ν) w_xx), and M = w_yy + ν w_xx is zero there, too.
fn bent_plate(y: f64, nu: f64) -> f64 {
    let h = 1e-3;
    // Seen from the axis x = 0: with z = i y, F' = √(z² − 1) = i √(y² + 1), Re F = −∫ √(y² + 1) dy, and w is even in x and biharmonic.
    let re_f = |y: f64| -0.5 * (y * (y * y + 1.0).sqrt() + y.asinh());
    let im_slope = |y: f64| (y * y + 1.0).sqrt();
    let a = -(1.0 + nu) / (1.0 - nu);
    let second = |f: &dyn Fn(f64) -> f64, y: f64| (f(y + h) - 2.0 * f(y) + f(y - h)) / (h * h);
    let w_yy = second(&|y| a * re_f(y) + y * im_slope(y), y);
    // Harmonic: the second derivative along x is minus that along y.
    let w_xx = -second(&|y| a * re_f(y), y) - y * second(&im_slope, y);
    let moment = |w_yy: f64, w_xx: f64| w_yy + nu * w_xx;
    // Far from the crack Re Z = 1: w_xx = A, w_yy = 2 − A.
    moment(w_yy, w_xx) / moment(2.0 - a, a)
}

#[test]
fn the_shares_beside_a_crack_are_those_of_the_closed_forms() {
    // Two digits, of a wall of ν = 1/3 that is bent.
    close(shares(bent(1.0 / 3.0)), [0.29, 0.52, 0.78, 0.93], 5e-3);
    close(shares(STRETCHED), [0.014, 0.09, 0.35, 0.72], 5e-3);
    let exact = [0.25, 0.5, 1.0, 2.0].map(|y| westergaard(y) as f32);
    close(shares(STRETCHED), exact, 1e-6);
    assert_eq!(bent(0.2), 0.25);
    for nu in [0.0, 0.23, 1.0 / 3.0, 0.5] {
        let exact = [0.25, 0.5, 1.0, 2.0].map(|y| bent_plate(y, nu) as f32);
        close(shares(bent(nu)), exact, 1e-5);
    }
}

#[test]
fn shares_lie_between_none_and_all_and_fall_as_the_crack_grows() {
    for beta in [STRETCHED, bent(0.5), bent(0.23), bent(0.0), bent(-0.9)] {
        let mut before = 1.0;
        for k in 0..400_u16 {
            let half_length = 1e-6 * 1.05_f32.powi(i32::from(k));
            let share = share_beside(0.01, half_length, beta);
            assert!((0.0..=before).contains(&share), "{beta} {half_length}");
            before = share + 2e-7;
        }
        assert!(before < 1e-2);
        assert_eq!(share_beside(0.0, 0.01, beta), 0.0);
        assert_eq!(share_beside(0.0, 0.0, beta), 0.0);
    }
}

/// Tension across a penny of unit radius in a solid under unit tension, at this height over its middle: σ_zz = 1 + f − z f', where f is harmonic and
/// −1 on the penny, found from the potential of a double layer √(1 − r²) by quadrature and difference quotients.
fn penny(z: f64) -> f64 {
    const RINGS: u32 = 200_000;
    let potential = |z: f64| -> f64 {
        let rings = (0..RINGS).map(|k| {
            // r = sin θ, for which √(1 − r²) dr is smooth.
            let theta = (f64::from(k) + 0.5) / f64::from(RINGS) * std::f64::consts::FRAC_PI_2;
            let (r, c) = theta.sin_cos();
            c * z * r / (r * r + z * z).powf(1.5) * c
        });
        rings.sum::<f64>() * std::f64::consts::FRAC_PI_2 / f64::from(RINGS)
    };
    let h = 1e-2;
    let first = |z: f64| (potential(z + h) - potential(z - h)) / (2.0 * h);
    let second = (potential(z + h) - 2.0 * potential(z) + potential(z - h)) / (h * h);
    2.0 / std::f64::consts::PI * (first(z) - z * second) + 1.0
}

#[test]
fn the_share_beside_a_penny_is_that_of_its_double_layer_and_a_long_crack_is_endless() {
    for y in [0.5_f32, 1.0, 2.0] {
        let ours = share_in_solid(3.0 * y, 3.0, 3.0);
        let theirs = penny(f64::from(y)) as f32;
        assert!((ours - theirs).abs() < 2e-3, "{y}: {ours} {theirs}");
        let endless = share_beside(3.0 * y, 3.0, STRETCHED);
        assert!((share_in_solid(3.0 * y, 3.0, 3e6) - endless).abs() < 1e-5);
        assert!(endless < ours);
    }
    assert_eq!(share_in_solid(0.0, 0.01, 0.01), 0.0);
    assert_eq!(share_in_solid(0.01, 0.0, 0.01), 1.0);
    assert_eq!(share_in_solid(0.0, 0.0, 0.01), 0.0);
}

#[test]
fn nothing_is_taken_ahead_of_the_tips_and_the_square_of_the_cosine_between() {
    let beta = bent(0.25);
    for distance in [1e-4, 0.01, 3.0] {
        let left = |angle: f32| {
            let to_crack = Vec3::new(angle.sin(), angle.cos(), 0.0) * distance;
            share_left(to_crack, Vec3::Y, |y| share_beside(y, 0.02, beta))
        };
        let beside = share_beside(distance, 0.02, beta);
        let along = share_left(Vec3::X * distance, Vec3::Y, |y| share_beside(y, 0.02, beta));
        assert_eq!(along, 1.0);
        assert!((left(0.0) - beside).abs() < 1e-6);
        let half = left(std::f32::consts::FRAC_PI_4);
        assert!((half - 0.5 * (1.0 + beside)).abs() < 1e-6);
    }
}

/// A number from −1 to 1, zero at times.
fn signed(rng: &mut rand_chacha::ChaCha8Rng) -> f32 {
    let x = 2.0 * uniform(rng) - 1.0;
    if x.abs() < 0.1 { 0.0 } else { x as f32 }
}

fn direction(rng: &mut rand_chacha::ChaCha8Rng) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| signed(rng))).normalize_or(Vec3::Z)
}

/// Stress that may be in no wall, in one, or along a line only.
fn tensor(rng: &mut rand_chacha::ChaCha8Rng) -> Symmetric3 {
    let mut components = [0.0_f32; 6];
    components.iter_mut().for_each(|c| *c = 1e8 * signed(rng));
    if uniform(rng) < 0.4 {
        (components[2], components[4], components[5]) = (0.0, 0.0, 0.0);
    }
    Symmetric3::from_components(components)
}

fn lanes(stresses: &[Symmetric3]) -> StressLanes {
    let mut lanes = StressLanes::default();
    for (k, s) in stresses.iter().enumerate() {
        let [xx, yy, zz] = s.diagonal;
        let [xy, yz, zx] = s.off;
        for (lane, c) in lanes.components.iter_mut().zip([xx, yy, zz, xy, yz, zx]) {
            lane[k] = c;
        }
    }
    lanes
}

fn released(own: &StressLanes, opposite: Option<&StressLanes>, by: &[Shadow]) -> StressLanes {
    let mut rest = Released::of_batch(own, opposite);
    by.iter().for_each(|shadow| rest.release(shadow));
    rest.left_of_batch()
}

#[test]
fn no_release_raises_the_largest_tension_whatever_the_parts_of_the_stress() {
    let mut rng = stream(7, Purpose::WeakPoints, 0);
    let mut taken = 0;
    for _ in 0..2000 {
        let mut sides = [[Symmetric3::default(); 8]; 2];
        for side in &mut sides {
            side.iter_mut().for_each(|s| *s = tensor(&mut rng));
        }
        let [own, opposite] = [lanes(&sides[0]), lanes(&sides[1])];
        let by: Vec<Shadow> = (0..4)
            .map(|_| Shadow {
                normal: direction(&mut rng),
                stretched: uniform(&mut rng) as f32,
                bent: uniform(&mut rng) as f32,
            })
            .collect();
        for opposite in [None, Some(&opposite)] {
            let mut before = own;
            // One after the other: each prefix is bounded by the one before.
            for count in 1..=by.len() {
                let left = released(&own, opposite, &by[..count]);
                for (k, s) in sides[0].iter().enumerate() {
                    let [was, is] = [&before, &left].map(|l| largest_eigenvalue(&l.stress(k)));
                    // Rounding: of f32, of numbers up to 3e8.
                    assert!(is <= was.max(0.0) + 300.0, "{s:?} {was} {is}");
                    taken += u32::from(is < 0.99 * was);
                }
                before = left;
            }
        }
    }
    assert!(taken > 30_000, "{taken}");
}

#[test]
fn each_part_of_a_walls_stress_is_left_its_own_share() {
    let shadow = Shadow {
        normal: Vec3::X,
        stretched: 0.25,
        bent: 0.64,
    };
    let left = |own: [f32; 2], opposite: [f32; 2]| {
        let wall = |[xx, xy]: [f32; 2]| Symmetric3 {
            diagonal: [xx, 1e6, 0.0],
            off: [xy, 0.0, 0.0],
        };
        let [own, opposite] = [own, opposite].map(|s| lanes(&[wall(s); 8]));
        let left = released(&own, Some(&opposite), &[shadow]).stress(3);
        assert_eq!(left.diagonal[1], 1e6);
        [left.diagonal[0], left.off[0]]
    };
    let close = |ours: [f32; 2], theirs: [f32; 2]| {
        for (a, b) in ours.into_iter().zip(theirs) {
            assert!((a - b).abs() <= 3.0, "{ours:?} {theirs:?}");
        }
    };
    // Stretched alone, bent alone: the share itself, and its root of the shear.
    close(left([8e6, 2e6], [8e6, 2e6]), [2e6, 1e6]);
    close(left([8e6, 2e6], [-8e6, -2e6]), [5.12e6, 1.6e6]);
    // 6 stretched and 3 bent: 1.5 and 1.92 are left.
    close(left([9e6, 0.0], [3e6, 0.0]), [3.42e6, 0.0]);
    // 6 stretched and −3 bent: 1.5 and −1.92 are left, which is no tension.
    close(left([3e6, 0.0], [9e6, 0.0]), [0.0, 0.0]);
    // −3 stretched and 4 bent: −0.75 and 2.56 would be more than there was.
    close(left([1e6, 5e5], [-7e6, 5e5]), [1e6, 5e5]);
    // Pressure passes.
    close(left([-1e6, 5e5], [3e6, 0.0]), [-1e6, 5e5]);
    close(left([0.0, 5e5], [3e6, 0.0]), [0.0, 5e5]);
}

#[test]
fn stresses_side_by_side_are_released_as_one_is() {
    let mut rng = stream(8, Purpose::WeakPoints, 0);
    for _ in 0..500 {
        let stresses: [Symmetric3; 8] = std::array::from_fn(|_| tensor(&mut rng));
        let share = uniform(&mut rng) as f32;
        let shadow = Shadow {
            normal: direction(&mut rng),
            stretched: share,
            bent: share,
        };
        let own = lanes(&stresses);
        let opposite = lanes(&std::array::from_fn::<_, 8, _>(|_| tensor(&mut rng)));
        for opposite in [None, Some(&opposite)] {
            let left = released(&own, opposite, &[shadow]);
            for (k, s) in stresses.iter().enumerate() {
                let one = s.released(shadow.normal, share).to_mat3();
                let difference = one - left.stress(k).to_mat3();
                // Where n·σn is within rounding of zero one may be released and the other not.
                let across = shadow.normal.dot(s.times(shadow.normal));
                if across.abs() > 100.0 {
                    let largest = difference.to_cols_array().map(f32::abs);
                    assert!(largest.into_iter().all(|d| d < 200.0), "{s:?}");
                }
            }
        }
    }
}

#[test]
fn the_order_of_cracks_counts_and_nothing_is_made_of_extremes() {
    let [a, b] = [Vec3::X, Vec3::new(0.6, 0.8, 0.0)].map(|normal| Shadow {
        normal,
        stretched: 0.1,
        bent: 0.1,
    });
    let s = lanes(
        &[Symmetric3 {
            diagonal: [3e6, 1e6, 0.0],
            off: [1e6, 0.0, 0.0],
        }; 8],
    );
    let [ab, ba] = [[a, b], [b, a]].map(|by| released(&s, None, &by).stress(0));
    assert!((ab.diagonal[0] - ba.diagonal[0]).abs() > 1e4);
    let all_taken = Shadow {
        stretched: 0.0,
        bent: 0.0,
        ..a
    };
    for size in [f32::MIN_POSITIVE * 1e-6, f32::MIN_POSITIVE, 1e-20, 1e12] {
        let s = |x: f32| {
            lanes(
                &[Symmetric3 {
                    diagonal: [x * size, 0.0, 0.0],
                    off: [0.0; 3],
                }; 8],
            )
        };
        for opposite in [-3.0, 0.0, 1.0, 7.0].map(s) {
            for shadow in [a, all_taken] {
                let left = released(&s(1.0), Some(&opposite), &[shadow]).stress(0);
                assert!((0.0..=size).contains(&left.diagonal[0]), "{size} {left:?}");
            }
        }
    }
}
