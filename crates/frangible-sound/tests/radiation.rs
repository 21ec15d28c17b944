//! Sound of moving surfaces, against closed forms.

use std::f64::consts::{PI, TAU};

use frangible_sound::glam::DVec3;
use frangible_sound::{
    AIR_DENSITY, EquivalentSphere, HARMONICS, MOST_DEGREE, SPEED_OF_SOUND, SurfaceElement,
    efficiencies, harmonic, harmonics, moved_air,
};

/// A sphere of triangles' worth of elements, equal in area: rings of equal height (Archimedes).
fn sphere(radius: f64, rings: usize) -> Vec<SurfaceElement> {
    let around = 2 * rings;
    let mut surface = Vec::new();
    for i in 0..rings {
        let z = -1.0 + 2.0 * (i as f64 + 0.5) / rings as f64;
        for j in 0..around {
            let angle = TAU * (j as f64 + 0.5) / around as f64;
            let level = (1.0 - z * z).sqrt();
            let normal = DVec3::new(level * angle.cos(), level * angle.sin(), z);
            let area = 4.0 * PI * radius * radius / (rings * around) as f64;
            surface.push(SurfaceElement {
                place: radius * normal,
                area: area * normal,
            });
        }
    }
    surface
}

/// Motion on the sphere of a surface that moves so.
fn motion(
    sphere: &EquivalentSphere,
    surface: &[SurfaceElement],
    moves: impl Fn(DVec3) -> DVec3,
) -> Vec<f32> {
    let mut sums = vec![0.0; HARMONICS];
    for element in surface {
        let displacement = moves(element.place);
        for (sum, weight) in sums.iter_mut().zip(sphere.weights(element)) {
            *sum += weight.dot(displacement);
        }
    }
    sums.into_iter().map(|s| s as f32).collect()
}

#[test]
fn harmonics_are_orthonormal() {
    let surface = sphere(1.0, 240);
    let mut gram = vec![[0.0; HARMONICS]; HARMONICS];
    for element in &surface {
        let y = harmonics(element.place);
        for (row, a) in gram.iter_mut().zip(y) {
            for (sum, b) in row.iter_mut().zip(y) {
                *sum += a * b * element.area.length();
            }
        }
    }
    for (i, row) in gram.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            let wanted = if i == j { 1.0 } else { 0.0 };
            // The midpoint rule over 240 rings.
            assert!((value - wanted).abs() < 2.5e-3, "{i} {j}: {value}");
        }
    }
}

#[test]
fn degrees_zero_and_one_radiate_as_rayleigh_says() {
    for x in [1e-3, 0.03, 0.4, 1.0, 2.0, 7.0, 50.0_f64] {
        let found = efficiencies(x);
        let zero = x * x / (1.0 + x * x);
        let one = x.powi(4) / (4.0 + x.powi(4));
        // From the derivatives of h_2: Morse and Ingard, Theoretical Acoustics, eq. 7.1.
        let two = x.powi(6) / (81.0 + 9.0 * x * x - 2.0 * x.powi(4) + x.powi(6));
        for (l, wanted) in [zero, one, two].into_iter().enumerate() {
            assert!(
                (found[l] / wanted - 1.0).abs() < 1e-9,
                "{l} at {x}: {} {wanted}",
                found[l]
            );
        }
        assert!(found.windows(2).all(|p| p[1] <= p[0] * 1.2 && p[1] > 0.0));
    }
}

#[test]
fn a_pulsating_and_a_shaken_sphere_send_rayleighs_power_within_a_percent() {
    let radius = 0.05;
    let surface = sphere(radius, 60);
    let sphere = EquivalentSphere::of(&surface).expect("a sphere");
    assert!((sphere.radius / radius - 1.0).abs() < 1e-6);
    for frequency in [100.0, 1000.0, 4000.0, 12_000.0_f64] {
        let omega = TAU * frequency;
        let x = omega * radius / SPEED_OF_SOUND;
        let plane = 4.0 * PI * radius * radius * AIR_DENSITY * SPEED_OF_SOUND;
        // With unit velocity a unit modal mass holds ½ J: the power is half the loss.
        let pulsating = motion(&sphere, &surface, |p| p.normalize());
        let power = 0.5 * sphere.radiation_loss(&pulsating, omega);
        let wanted = 0.5 * plane * x * x / (1.0 + x * x);
        assert!(
            (power / wanted - 1.0).abs() < 0.01,
            "pulsating: {power} {wanted}"
        );
        for axis in DVec3::AXES {
            let shaken = motion(&sphere, &surface, |_| axis);
            let power = 0.5 * sphere.radiation_loss(&shaken, omega);
            let wanted = 0.5 * plane / 3.0 * x.powi(4) / (4.0 + x.powi(4));
            assert!(
                (power / wanted - 1.0).abs() < 0.01,
                "shaken: {power} {wanted}"
            );
        }
    }
}

#[test]
fn the_air_that_ellipsoids_move_is_lambs() {
    let sphere = moved_air([0.1; 3]);
    assert!(
        sphere
            .iter()
            .all(|d| (d / (2.0 * PI * 1e-3) - 1.0).abs() < 1e-6)
    );
    let disc = moved_air([0.1, 0.1, 1e-4]);
    // A thin disc moves 8/3 a³ across itself, and nothing along.
    assert!(
        (disc[2] / (8.0 / 3.0 * 1e-3) - 1.0).abs() < 2e-3,
        "{disc:?}"
    );
    assert!(disc[0] < 0.01 * disc[2]);
    // Oblate 2:1, Lamb's table in art. 71 and 114: k = 1.121 across, 0.310 along.
    let oblate = moved_air([0.2, 0.2, 0.1]);
    let volume = 4.0 / 3.0 * PI * 0.004;
    assert!(
        (oblate[2] / volume - 2.12).abs() < 0.01,
        "{}",
        oblate[2] / volume
    );
    assert!(
        (oblate[0] / volume - 1.31).abs() < 0.01,
        "{}",
        oblate[0] / volume
    );
}

#[test]
fn the_flow_of_any_body_is_kept_and_its_shaking_is_its_ellipsoids() {
    // A brick that grows and shakes.
    let sides = [0.2, 0.1, 0.06];
    let mut surface = Vec::new();
    let n = 24;
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for sign in [-1.0, 1.0] {
            for i in 0..n * n {
                let step = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
                let mut place = DVec3::ZERO;
                place[axis] = 0.5 * sign * sides[axis];
                (place[u], place[v]) = (sides[u] * step(i % n), sides[v] * step(i / n));
                let mut area = DVec3::ZERO;
                area[axis] = sign * sides[u] * sides[v] / (n * n) as f64;
                surface.push(SurfaceElement { place, area });
            }
        }
    }
    let sphere = EquivalentSphere::of(&surface).expect("a brick");
    let grows = motion(&sphere, &surface, |p| p);
    let flow: f64 = surface.iter().map(|e| e.area.dot(e.place)).sum();
    let kept = f64::from(grows[harmonic(0, 0)]) * (4.0 * PI).sqrt() * sphere.radius.powi(2);
    assert!((kept / flow - 1.0).abs() < 1e-5);
    // At low frequency a shaken body sends ρ ω⁴ D² / (24 π c³) of unit velocity, D the air that it moves.
    let omega = TAU * 40.0;
    let power = |axis: DVec3| {
        let shaken = motion(&sphere, &surface, |_| axis);
        0.5 * sphere.radiation_loss(&shaken, omega)
    };
    let found: Vec<f64> = (0..3)
        .map(|i| power(sphere.axes * DVec3::AXES[i]))
        .collect();
    for (power, moved) in found.iter().zip(sphere.moved_air) {
        let wanted =
            AIR_DENSITY * omega.powi(4) * moved * moved / (24.0 * PI * SPEED_OF_SOUND.powi(3));
        assert!((power / wanted - 1.0).abs() < 0.01, "{power} {wanted}");
    }
}

#[test]
fn a_hollow_ball_sounds_by_its_outside() {
    let (outer, mut both) = (sphere(0.05, 40), sphere(0.05, 40));
    both.extend(sphere(0.045, 40).iter().map(|e| SurfaceElement {
        area: -e.area,
        ..*e
    }));
    let ball = EquivalentSphere::of(&outer).expect("a ball");
    let hollow = EquivalentSphere::of(&both).expect("a hollow ball");
    assert!((ball.radius - hollow.radius).abs() < 1e-9);
    // The wall bends in ovals: degree 2.
    let oval = |p: DVec3| p.normalize() * (p.x * p.x - p.y * p.y) / p.length_squared();
    let (a, b) = (motion(&ball, &outer, oval), motion(&hollow, &both, oval));
    for l in 1..=MOST_DEGREE {
        let l = l as isize;
        for m in -l..=l {
            let i = harmonic(l as usize, m);
            assert!((a[i] - b[i]).abs() < 1e-4, "{l} {m}: {} {}", a[i], b[i]);
        }
    }
}
