//! Response of one oscillator to a half-sine, against an independent integrator.

use frangible::modal::Oscillator;

/// Classical Runge–Kutta with a step far below every time scale.
fn integrate(lambda: f64, d: f64, u: f64, t_end: f64, t_d: f64, steps: usize) -> (f64, f64) {
    let f = |t: f64, q: f64, v: f64| {
        (
            v,
            (if t <= t_d { (u * t).sin() } else { 0.0 }) - d * v - lambda * q,
        )
    };
    let h = t_end / steps as f64;
    let (mut q, mut v) = (0.0, 0.0);
    for k in 0..steps {
        let t = k as f64 * h;
        let k1 = f(t, q, v);
        let k2 = f(t + h / 2.0, q + h / 2.0 * k1.0, v + h / 2.0 * k1.1);
        let k3 = f(t + h / 2.0, q + h / 2.0 * k2.0, v + h / 2.0 * k2.1);
        let k4 = f(t + h, q + h * k3.0, v + h * k3.1);
        q += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        v += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
    }
    (q, v)
}

#[test]
fn the_recurrence_is_exact_for_any_damping_and_at_resonance() {
    let t_d = 1e-3;
    let u = std::f64::consts::PI / t_d;
    let w: f64 = 4000.0;
    let critical = 2.0 * w;
    for (name, lambda, d) in [
        ("undamped", w * w, 0.0),
        ("underdamped", w * w, 0.1 * critical),
        ("critical", w * w, critical),
        ("overdamped", w * w, 5.0 * critical),
        ("resonance", u * u, 0.0),
        ("damped resonance", u * u, 0.01 * u),
    ] {
        // 20 coarse steps in the contact, 20 after it.
        let mut mode = Oscillator::new(lambda, d, u, t_d / 20.0);
        let mut scale: f64 = 0.0;
        for k in 1..=40 {
            mode.step(k <= 20);
            scale = scale.max(mode.displacement().abs());
            if k % 10 == 0 {
                let t = t_d / 20.0 * f64::from(k);
                let (q, v) = integrate(lambda, d, u, t, t_d, 40_000 * k as usize / 40);
                assert!(
                    (mode.displacement() - q).abs() < 1e-9 * scale,
                    "{name}: q {} {q}",
                    mode.displacement()
                );
                assert!(
                    (mode.velocity() - v).abs() < 1e-7 * scale * lambda.sqrt(),
                    "{name}: v"
                );
            }
        }
    }
}

#[test]
fn a_short_pulse_is_an_impulse() {
    let (w, t_d) = (1000.0_f64, 1e-7);
    let u = std::f64::consts::PI / t_d;
    let mut mode = Oscillator::new(w * w, 0.0, u, t_d / 16.0);
    for _ in 0..16 {
        mode.step(true);
    }
    // Impulse φ = 2/u of the unit sine gives the velocity φ.
    assert!((mode.velocity() * u / 2.0 - 1.0).abs() < 1e-6);
}
