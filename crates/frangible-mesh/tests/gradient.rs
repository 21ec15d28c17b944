//! Gradients that come with the distance, against differences of the distance.

use frangible_mesh::glam::DVec3;
use frangible_mesh::{READY_SHAPES, Solid, ready_shape};

#[test]
fn gradients_of_all_ready_shapes_are_those_of_their_distances() {
    for name in READY_SHAPES {
        let solid = ready_shape(name).unwrap();
        let [low, high] = solid.bounds();
        let h = 1e-6 * (high - low).max_element();
        let (mut wrong, mut all) = (0, 0);
        for i in 0..4000_u32 {
            // Spread evenly: powers of the inverse root of x⁴ = x + 1.
            let share = DVec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * f64::from(i);
            let p = low + share.fract() * (high - low);
            let (value, gradient) = solid.gradient(p);
            assert_eq!(value, solid.signed_distance(p), "{name} at {p}");
            let d = |e: DVec3| solid.signed_distance(p + h * e) - solid.signed_distance(p - h * e);
            let expected = DVec3::new(d(DVec3::X), d(DVec3::Y), d(DVec3::Z)) / (2.0 * h);
            all += 1;
            wrong += u32::from(gradient.distance(expected) > 1e-3);
        }
        // On creases and medial planes differences are neither side's.
        assert!(wrong * 200 < all, "{name}: {wrong} of {all}");
    }
}

#[test]
fn a_foot_lies_on_the_surface_within_its_bound_or_there_is_none() {
    for name in READY_SHAPES {
        let solid = ready_shape(name).unwrap();
        let [low, high] = solid.bounds();
        let size = (high - low).max_element();
        let within = 0.05 * size;
        for i in 0..500_u32 {
            let share = DVec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * f64::from(i);
            let p = low + share.fract() * (high - low);
            match solid.foot(p, within) {
                Some(foot) => {
                    assert!(foot.distance(p) <= within);
                    assert_eq!(foot, solid.closest(p).position, "{name} at {p}");
                }
                None => assert!(
                    solid
                        .signed_distance(p)
                        .abs()
                        .max(solid.closest(p).position.distance(p))
                        > within
                ),
            }
        }
    }
}
