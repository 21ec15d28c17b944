//! Principal stresses.

use frangible::internals::stress::{Symmetric3, largest_eigenvalue, principal_axes};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

fn random_tensor(rng: &mut ChaCha8Rng) -> Symmetric3 {
    let mut next = || (rng.next_u32() as f32 / u32::MAX as f32 - 0.5) * 2e8;
    Symmetric3 {
        diagonal: [next(), next(), next()],
        off: [next(), next(), next()],
    }
}

#[test]
fn principal_axes_diagonalise_and_both_routes_agree() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..2000 {
        let s = random_tensor(&mut rng);
        let (values, axes) = principal_axes(&s);
        let m = s.to_mat3().as_dmat3();
        let norm = values.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        for (value, axis) in values.iter().zip(axes) {
            assert!((m * axis - axis * *value).length() < 1e-12 * norm);
        }
        assert!(values[0] >= values[1] && values[1] >= values[2]);
        let closed = f64::from(largest_eigenvalue(&s));
        assert!(
            (closed - values[0]).abs() < 3e-6 * norm,
            "{closed} {}",
            values[0]
        );
    }
}

#[test]
fn equal_and_zero_tensors_have_their_own_values() {
    assert_eq!(largest_eigenvalue(&Symmetric3::default()), 0.0);
    let s = Symmetric3 {
        diagonal: [5e6; 3],
        off: [0.0; 3],
    };
    assert!((largest_eigenvalue(&s) - 5e6).abs() < 1.0);
    assert_eq!(principal_axes(&s).0, [5e6; 3]);
}

#[test]
fn release_takes_away_the_stress_across_a_crack() {
    let s = Symmetric3 {
        diagonal: [3e6, 2e6, 1e6],
        off: [0.0; 3],
    };
    let left = s.released(frangible::glam::Vec3::X, 0.0);
    assert_eq!(left.diagonal, [0.0, 2e6, 1e6]);
    let left = s.released(frangible::glam::Vec3::Y, 0.25);
    assert_eq!(left.diagonal, [3e6, 0.5e6, 1e6]);
}
