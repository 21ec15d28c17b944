//! Mesh solids against closed forms and brute force.

use std::f64::consts::PI;

use frangible_mesh::glam::DVec3;
use frangible_mesh::{MeshSolid, Solid, SolidError, Surface, wall_thickness};

use crate::hard::shapes::{cuboid, noise, sphere};
use crate::hard::{self, Expect, HardCase, broken, crossing, sound};

fn solid(surface: &Surface) -> MeshSolid {
    MeshSolid::new(surface).unwrap_or_else(|error| panic!("{error}"))
}

/// Points in the box of the surface, widened by half its size.
fn scattered(solid: &MeshSolid, count: usize) -> Vec<DVec3> {
    let [low, high] = solid.bounds();
    noise(3 * count)
        .chunks(3)
        .map(|x| low + (2.0 * DVec3::new(x[0], x[1], x[2]) - 0.5) * (high - low))
        .collect()
}

fn bodies() -> Vec<HardCase> {
    let is_body = |case: &HardCase| matches!(case.expect, Expect::Solid { .. });
    hard::all().into_iter().filter(is_body).collect()
}

/// Sum of the triangles' solid angles, each by L'Huilier's theorem [Todhunter 1886, §102].
fn winding_number_by_brute_force(surface: &Surface, p: DVec3) -> f64 {
    (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t).map(|corner| (corner - p).normalize());
            let [x, y, z] = [b.angle_between(c), c.angle_between(a), a.angle_between(b)];
            let s = 0.5 * (x + y + z);
            let product = (s / 2.0).tan()
                * ((s - x) / 2.0).tan()
                * ((s - y) / 2.0).tan()
                * ((s - z) / 2.0).tan();
            let excess = 4.0 * product.max(0.0).sqrt().atan();
            excess.copysign(a.dot(b.cross(c))) / (4.0 * PI)
        })
        .sum()
}

/// Distance to the triangles that have an area: to the plane within one, else to its sides.
fn distance_by_brute_force(surface: &Surface, p: DVec3) -> f64 {
    let mut least = f64::INFINITY;
    for t in 0..surface.triangles.len() {
        let corners = surface.corners(t);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if normal.length() == 0.0 {
            continue;
        }
        let mut over = true;
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            over &= normal.cross(b - a).dot(p - a) > 0.0;
            let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            least = least.min(p.distance(if along > 0.0 { a.lerp(b, along) } else { a }));
        }
        if over {
            least = least.min((p - corners[0]).dot(normal).abs() / normal.length());
        }
    }
    least
}

#[test]
fn the_winding_number_is_that_of_brute_force() {
    for HardCase { name, surface, .. } in bodies() {
        let solid = solid(&surface);
        let exact = |p| winding_number_by_brute_force(&surface, p);
        let sign = if name == "inside-out ball" { -1.0 } else { 1.0 };
        let mut sum = 0.0;
        let points = scattered(&solid, 100);
        for &p in &points {
            let error = (solid.winding_number(p) - sign * exact(p)).abs();
            assert!(error < 1e-2, "{name} at {p}: off by {error}");
            sum += error;
        }
        let mean = sum / points.len() as f64;
        assert!(mean < 1e-3, "{name}: off by {mean} in the mean");
    }
}

#[test]
fn a_closed_ball_winds_once_around_its_inside_and_never_around_its_outside() {
    let solid = solid(&sphere(DVec3::ZERO, 1.0, 60));
    for p in scattered(&solid, 2000) {
        // Facets lie up to 1 − cos(π/60)² below the sphere.
        if (p.length() - 1.0).abs() > 0.003 {
            let expected = if p.length() < 1.0 { 1.0 } else { 0.0 };
            let w = solid.winding_number(p);
            assert!((w - expected).abs() < 3e-3, "{w} at {p}");
        }
    }
}

#[test]
fn half_a_sphere_winds_by_the_solid_angle_of_its_rim() {
    let half = broken::half_ball();
    let solid = solid(&half.surface);
    for z in [-0.9, -0.5, -0.1, 0.0, 0.1, 0.5, 2.0] {
        // The rim of radius 1 at z = 0 subtends 2π(1 − z/√(1+z²)) from the axis; the bowl is the rest, below.
        let disc: f64 = 0.5 * (1.0 - f64::abs(z) / f64::hypot(z, 1.0));
        let expected = if z <= 0.0 { 1.0 - disc } else { disc };
        let w = solid.winding_number(DVec3::new(0.0, 0.0, z));
        // 80 facets around subtend a thousandth less than the circle, and the expansion is off by as much.
        assert!((w - expected).abs() < 3e-3, "{w}, not {expected}, at {z}");
    }
}

#[test]
fn the_nearest_point_is_that_of_brute_force() {
    for HardCase { name, surface, .. } in bodies() {
        let solid = solid(&surface);
        for p in scattered(&solid, 50) {
            let nearest = solid.nearest(p, f64::INFINITY).expect("a triangle");
            let expected = distance_by_brute_force(&surface, p);
            let size = p.abs().max_element().max(1.0);
            let error = (nearest.distance - expected).abs();
            assert!(error < 1e-12 * size, "{name} at {p}: off by {error}");
            assert!((p.distance(nearest.position) - expected).abs() < 1e-12 * size);
            let bound = solid.nearest(p, nearest.distance * (1.0 + 1e-9));
            assert_eq!(bound, Some(nearest), "{name} at {p}, with a bound");
            assert_eq!(solid.nearest(p, 0.999 * nearest.distance), None);
        }
    }
}

#[test]
fn the_inside_of_every_hard_case_has_its_volume() {
    for HardCase {
        name,
        surface,
        expect,
    } in hard::all()
    {
        let (solid, volume) = match (MeshSolid::new(&surface), expect) {
            (Ok(solid), Expect::Solid { volume, .. }) => (solid, volume),
            (Err(error), Expect::Refused) => {
                println!("{name}: {error}");
                continue;
            }
            (result, _) => panic!("{name}: {:?}", result.map(|_| "a body")),
        };
        let [low, high] = solid.bounds();
        const N: usize = 60;
        let points: Vec<DVec3> = (0..N.pow(3))
            .map(|i| [i / N / N, i / N % N, i % N].map(|i| (i as f64 + 0.5) / N as f64))
            .map(|place| low + DVec3::from_array(place) * (high - low))
            .collect();
        let inside = solid.inside_many(&points);
        let share = inside.iter().filter(|&&inside| inside).count() as f64 / points.len() as f64;
        let measured = share * (high - low).element_product();
        let error = measured / volume - 1.0;
        println!("{name}: {measured:.6e} m³, off by {:.2} %", 100.0 * error);
        assert!(error.abs() < 0.04, "{name}: {measured} m³, not {volume}");
        for (p, inside) in points.iter().zip(&inside).step_by(997) {
            assert_eq!(solid.inside(*p), *inside, "{name} at {p}");
        }
    }
}

#[test]
fn a_crossing_lies_between_inside_and_outside() {
    for HardCase { name, surface, .. } in bodies() {
        let solid = solid(&surface);
        let points = scattered(&solid, 400);
        let (inside, outside): (Vec<DVec3>, Vec<DVec3>) =
            points.into_iter().partition(|&p| solid.inside(p));
        for (&a, &b) in inside.iter().zip(&outside).take(100) {
            let x = solid.crossing(a, b);
            let along = (b - a).normalize();
            let off = (x - a).reject_from(along).length();
            let step = 1e-5 * a.distance(b);
            assert!(
                off < 1e-9 * a.abs().max_element().max(1.0),
                "{name}: {off} off the segment"
            );
            let before = solid.inside(x - step * along);
            let after = solid.inside(x + step * along);
            assert!(
                before && !after,
                "{name} from {a} to {b} at {x}: {before} {after}"
            );
        }
    }
}

#[test]
fn the_normal_of_the_closest_face_points_to_where_the_body_is_not() {
    for HardCase {
        name,
        surface,
        expect,
    } in bodies()
    {
        if !matches!(
            expect,
            Expect::Solid {
                watertight: true,
                ..
            }
        ) {
            continue;
        }
        let solid = solid(&surface);
        let [low, high] = solid.bounds();
        let step = 1e-7 * (high - low).length();
        for p in scattered(&solid, 100) {
            let nearest = solid.nearest(p, f64::INFINITY).expect("a triangle");
            let [a, b, c] = surface.corners(nearest.face as usize);
            let middle = (a + b + c) / 3.0;
            assert!(
                solid.inside(middle - step * nearest.normal),
                "{name}, face {}",
                nearest.face
            );
            assert!(
                !solid.inside(middle + step * nearest.normal),
                "{name}, face {}",
                nearest.face
            );
        }
    }
}

#[test]
fn walls_are_as_thick_as_they_were_made() {
    let measure = |case: HardCase| wall_thickness(&solid(&case.surface), 1000, 7);
    let glass = measure(sound::wine_glass());
    assert!((glass.median / 0.0015 - 1.0).abs() < 0.15, "{glass:?}");
    let hollow = measure(sound::hollow_ball());
    assert!((hollow.thinnest / 0.0015 - 1.0).abs() < 0.15, "{hollow:?}");
    assert!((hollow.median / 0.0015 - 1.0).abs() < 0.15, "{hollow:?}");
    for case in [crossing::ball_twice(), sound::inside_out_ball()] {
        let ball = measure(case);
        assert!((ball.median / 2.0 - 1.0).abs() < 0.1, "{ball:?}");
        assert!((ball.thinnest / 2.0 - 1.0).abs() < 0.15, "{ball:?}");
        assert!(
            (ball.volume / (4.0 * PI / 3.0) - 1.0).abs() < 0.03,
            "{ball:?}"
        );
    }
    let cube = measure(sound::cube());
    assert!(
        (cube.median - 1.0).abs() < 0.05 && (cube.area - 6.0).abs() < 1e-9,
        "{cube:?}"
    );
    assert!((cube.volume - 1.0).abs() < 1e-9, "{cube:?}");
}

#[test]
fn sphere_tracing_finds_the_exit_that_rays_find() {
    struct Distance(MeshSolid);
    impl Solid for Distance {
        fn bounds(&self) -> [DVec3; 2] {
            self.0.bounds()
        }
        fn signed_distance(&self, p: DVec3) -> f64 {
            self.0.signed_distance(p)
        }
    }
    let by_rays = solid(&sound::star_prism().surface);
    let by_distance = Distance(by_rays.clone());
    for p in scattered(&by_rays, 200) {
        let direction = (DVec3::new(0.3, 0.2, 0.4) - p).normalize();
        match (by_rays.exit(p, direction), by_distance.exit(p, direction)) {
            (None, None) => assert!(!by_rays.inside(p)),
            (Some(ray), Some(traced)) => assert!((ray - traced).abs() < 1e-6, "{ray} {traced}"),
            other => panic!("{other:?} at {p}"),
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let solid = solid(&sound::lattice().surface);
    let points = scattered(&solid, 3000);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("threads");
        pool.install(|| (solid.inside_many(&points), wall_thickness(&solid, 100, 3)))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn refusals_say_what_is_wrong() {
    let mut nowhere = cuboid(DVec3::ZERO, DVec3::ONE);
    nowhere.triangles[4][2] = 77;
    let error = MeshSolid::new(&nowhere).expect_err("refused");
    assert!(error.to_string().contains("vertex 77"), "{error}");
    let flat = hard::refused::flat_square().surface;
    let error = MeshSolid::new(&flat).expect_err("refused");
    assert!(
        matches!(error, SolidError::NoInside { highest } if highest <= 0.51),
        "{error}"
    );
}
