//! Contacts, compared with brute force.

use rapier3d::geometry::SharedShape;
use rapier3d::math::Rotation;

use super::*;

/// Numbers from 0 to 1 of a plain generator.
fn numbers(mut state: u32) -> impl FnMut() -> Real {
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as Real / (1 << 24) as Real
    }
}

/// A prism of random outline and of one thickness, as the cells of a flat body are.
fn prism(random: &mut impl FnMut() -> Real) -> SharedShape {
    let corners = 5 + (4.0 * random()) as usize;
    let turn = random();
    let points: Vec<Vector> = (0..corners)
        .flat_map(|k| {
            let angle =
                (k as Real + 0.6 * random() + turn) * std::f32::consts::TAU / corners as Real;
            let radius = 0.006 + 0.003 * random();
            let (x, y) = (radius * angle.cos(), radius * angle.sin());
            [Vector::new(x, y, -0.004), Vector::new(x, y, 0.004)]
        })
        .collect();
    SharedShape::convex_hull(&points).expect("a prism has a volume")
}

/// Largest distance of two bodies along an axis, of the normals of faces and across pairs of edges, m.
fn apart(pair: &Pair) -> Real {
    let edges = |body: Solid| match body.shape.as_convex_polyhedron() {
        Some(hull) => (hull.edges().iter())
            .map(|edge| edge.vertices.map(|v| hull.points()[v as usize]))
            .map(|[from, to]| to - from)
            .collect(),
        None => Vector::AXES.to_vec(),
    };
    let there = pair.pos12.rotation;
    let theirs: Vec<Vector> = edges(pair.b).into_iter().map(|e| there * e).collect();
    let across = (edges(pair.a).into_iter())
        .flat_map(|e| theirs.iter().map(move |other| e.cross(*other)))
        .filter_map(|axis| axis.try_normalize())
        .flat_map(|axis| [axis, -axis]);
    (pair.a.normals().into_iter())
        .chain(pair.b.normals().into_iter().map(|n| there * -n))
        .chain(across)
        .map(|axis| pair.gap(axis))
        .fold(Real::NEG_INFINITY, Real::max)
}

#[test]
fn contacts_are_as_deep_as_the_bodies_overlap() {
    let mut random = numbers(7);
    let [mut overlapping, mut wrong_before, mut wrong_now] = [0; 3];
    for _ in 0..4000 {
        let shapes = [prism(&mut random), prism(&mut random)];
        let [x, y, z] = std::array::from_fn(|_| random() - 0.5);
        let shift = Vector::new(0.03 * x, 0.03 * y, 0.0076 + 1.2e-3 * z);
        let tilt = Vector::new(random() - 0.5, random() - 0.5, random());
        let pos12 = Pose::from_parts(
            shift,
            Rotation::from_scaled_axis(10_f32.powf(-4.0 + 2.0 * random()) * tilt),
        );
        let pair = [&*shapes[0], &*shapes[1]];
        let [a, b] = pair.map(|shape| Solid::of(shape).expect("it has faces"));
        let bodies = Pair {
            pos12: &pos12,
            a,
            b,
        };
        let gap = apart(&bodies);
        overlapping += usize::from(gap < 0.0);
        let wrong = |manifold: &Manifold| {
            let distances = manifold.points.iter().map(|point| point.dist);
            let deepest = distances.fold(Real::INFINITY, Real::min);
            let missed = gap < 0.0 && deepest > gap + 4.0 * ROUNDING;
            usize::from(missed || deepest < gap - 4.0 * ROUNDING)
        };
        let mut found = Manifold::new();
        DefaultQueryDispatcher
            .contact_manifold_convex_convex(&pos12, pair[0], pair[1], None, None, 0.005, &mut found)
            .expect("polyhedra are supported");
        wrong_before += wrong(&found);
        let mut ours = Manifold::new();
        touch(&pos12, pair, [None; 2], 0.005, &mut ours).expect("polyhedra are supported");
        wrong_now += wrong(&ours);
    }
    println!("of 4000 pairs {overlapping} overlap; Parry is wrong {wrong_before} times");
    assert!(overlapping > 1000 && wrong_before > 10);
    assert_eq!(wrong_now, 0);
}

#[test]
fn bodies_of_any_size_are_searched_alike() {
    let mut random = numbers(11);
    let [mut overlapping, mut failed] = [0; 2];
    for round in 0..1200 {
        let second = match round % 2 {
            0 => prism(&mut random),
            _ => SharedShape::cuboid(0.005, 0.01, 0.003),
        };
        let first = prism(&mut random);
        let [x, y, z] = std::array::from_fn(|_| 0.02 * (random() - 0.5));
        let turn = Vector::new(random(), random(), random()) * 3.0;
        let size = [0.05, 1.0, 300.0][round % 3];
        let pos12 = Pose::from_parts(
            size * Vector::new(x, y, z),
            Rotation::from_scaled_axis(turn),
        );
        let shapes = [first, second]
            .map(|shape| shape.scale_dyn(Vector::splat(size), 1).expect("it scales"));
        let [a, b] =
            [&*shapes[0], &*shapes[1]].map(|shape| Solid::of(shape).expect("it has faces"));
        let pair = Pair {
            pos12: &pos12,
            a,
            b,
        };
        let gap = apart(&pair);
        if gap >= 0.0 {
            continue;
        }
        overlapping += 1;
        let Found::Close {
            normal, gap: depth, ..
        } = pair.search(0.002, None)
        else {
            panic!("bodies that overlap by {gap} m touch");
        };
        let error = 1e-3 * size * 0.01;
        assert!((pair.gap(normal) - depth).abs() < ROUNDING + error);
        failed += usize::from((depth - gap).abs() > error);
    }
    assert!(overlapping > 400, "{overlapping}");
    assert_eq!(failed, 0);
}

/// Distance of a shape's points, without its radius, from a prism, m, by a search that has no tolerance: the farthest over many directions, the
/// best of which is improved by ever smaller turns.
fn distance(pair: &Pair, first: Vector) -> Real {
    let mut best = (first, pair.gap(first));
    let mut random = numbers(5);
    let mut direction = || 2.0 * Vector::new(random(), random(), random()) - Vector::ONE;
    for size in [
        1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5,
    ] {
        let from = best.0;
        let from = if size < 1.0 { from } else { Vector::ZERO };
        for _ in 0..400 {
            let Some(axis) = (from + size * direction()).try_normalize() else {
                continue;
            };
            let gap = pair.gap(axis);
            if gap > best.1 {
                best = (axis, gap);
            }
        }
    }
    best.1
}

#[test]
fn round_bodies_and_triangles_touch_prisms_where_they_are() {
    let mut random = numbers(3);
    let [mut wrong_before, mut wrong_now, mut touching] = [[0; 4]; 3];
    for round in 0..1200 {
        let first = prism(&mut random);
        let mut number = || random() - 0.5;
        let radius = 0.006 + 0.008 * number();
        let other = match round % 4 {
            0 => SharedShape::ball(radius),
            1 => SharedShape::capsule_y(0.004, radius),
            2 => SharedShape::cylinder(0.006, radius),
            _ => SharedShape::triangle(
                Vector::new(-0.2, 0.0, -0.1),
                Vector::new(0.1, 0.0, 0.3),
                Vector::new(0.2, 0.0, -0.2),
            ),
        };
        let turn = Rotation::from_scaled_axis(3.0 * Vector::new(number(), number(), number()));
        let away = match round % 4 {
            3 => turn * Vector::Y,
            _ => Vector::new(number(), number(), number()).normalize(),
        };
        let [a, b] = [&*first, &*other].map(|shape| Solid::of(shape).expect("it has faces"));
        // As far along the direction as the bodies reach, and a little more or less.
        let edge = Pose::from_parts(Vector::ZERO, turn);
        let near = Pair { pos12: &edge, a, b }.gap(away);
        let more = [1e-3, 1e-6][round / 4 % 2] * number();
        let shift = away * (a.radius + b.radius - near + more);
        let pos12 = Pose::from_parts(shift, turn);
        let pair = Pair {
            pos12: &pos12,
            a,
            b,
        };
        let true_distance = distance(&pair, away) - b.radius;
        let deepest = |manifold: &Manifold| {
            let distances = manifold.points.iter().map(|point| point.dist);
            distances.fold(Real::INFINITY, Real::min)
        };
        let wrong = |manifold: &Manifold| {
            let near = true_distance < 1.9e-3;
            usize::from(near && (deepest(manifold) - true_distance).abs() > 2.0 * ROUNDING)
        };
        let pair = [&*first, &*other];
        let mut found = vec![];
        DefaultQueryDispatcher
            .contact_manifolds(&pos12, pair[0], pair[1], 2e-3, &mut found, &mut None)
            .expect("convex shapes are supported");
        wrong_before[round % 4] += wrong(&found[0]);
        let mut ours = Manifold::new();
        touch(&pos12, pair, [None; 2], 2e-3, &mut ours).expect("convex shapes are supported");
        touching[round % 4] += usize::from(!ours.points.is_empty());
        wrong_now[round % 4] += wrong(&ours);
        for point in &ours.points {
            let on = |shape: &dyn Shape, point: Vector| {
                let bounds = shape.compute_local_aabb().loosened(1e-4);
                bounds.contains_local_point(point)
            };
            assert!(on(pair[0], point.local_p1) && on(pair[1], point.local_p2));
        }
    }
    println!("of {touching:?} Parry is wrong {wrong_before:?} times, this {wrong_now:?}");
    assert!(touching.iter().all(|&count| count > 100));
    assert_eq!(wrong_now, [0; 4]);
}
