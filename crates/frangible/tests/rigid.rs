//! What a break does to the motion of bodies.

use crate::bodies;
use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::internals::rigid::{
    Ball, Kick, Rigid, affordable, fly_through, nearest_first, pass, push_plug, take_blow,
    take_energy, take_held,
};
use frangible::{Contact, Fracture, FractureConfig, Outcome, TriMesh, impact};

fn ball(mass: f64, at: DVec3, velocity: DVec3) -> Rigid {
    let inertia = DMat3::from_diagonal(DVec3::splat(0.4 * mass * 1e-4));
    Rigid::free(mass, inertia, [at, velocity, DVec3::ZERO])
}

fn along(mass: f64, x: f64, speed: f64) -> Rigid {
    ball(mass, DVec3::X * x, DVec3::X * speed)
}

fn energy(bodies: &[Rigid]) -> f64 {
    bodies.iter().map(Rigid::kinetic_energy).sum()
}

/// Momentum and angular momentum about the origin.
fn momenta(bodies: &[Rigid]) -> [DVec3; 2] {
    let linear = bodies.iter().map(|b| b.linear * b.mass).sum();
    let turn = |b: &Rigid| b.centre.cross(b.linear * b.mass) + b.inertia * b.angular;
    [linear, bodies.iter().map(turn).sum()]
}

fn same(a: [DVec3; 2], b: [DVec3; 2]) {
    for (a, b) in a.into_iter().zip(b) {
        assert!((a - b).length() < 1e-10, "{a} and {b}");
    }
}

/// Puts one impulse between pieces and striker; what is lost.
fn push(pieces: &mut [Rigid], striker: &mut [Rigid], at: DVec3, impulse: DVec3) -> f64 {
    let pushes = [(at, impulse)];
    let centre = Rigid::together(striker).centre;
    let taken = Kick::about(centre, &pushes).scaled(-1.0);
    push_plug(pieces, striker, &pushes, taken)
}

#[test]
fn the_affordable_share_of_a_kick_spends_what_is_allowed() {
    for (work, give, allowed) in [
        (1.0, 2.0, 0.5),
        (-1.0, 4.0, 0.0),
        (-1.0, 4.0, 0.3),
        (3.0, 0.0, 1.0),
        (2.0, 1e-9, 1.0),
    ] {
        let s = affordable(work, give, allowed);
        let spent = s * work + 0.5 * s * s * give;
        assert!((spent - allowed).abs() < 1e-9, "{s} spends {spent} J");
    }
    assert_eq!(affordable(-1.0, 0.5, 0.0), 1.0);
    assert_eq!(affordable(1.0, 0.5, 0.0), 0.0);
    assert_eq!(affordable(0.0, 0.0, 0.0), 1.0);
}

#[test]
fn a_plug_takes_the_impulse_and_no_energy_is_made() {
    for impulse in [0.01, 0.1, 1.0, 100.0] {
        let places = [(0.02, 0.01), (0.05, -0.02), (0.4, 0.03)];
        let mut pieces = places.map(|(m, y)| ball(m, DVec3::new(0.1, y, 0.0), DVec3::ZERO));
        let mut striker = [along(0.1, 0.0, 10.0)];
        let before = [&pieces[..], &striker].concat();
        let at = DVec3::new(0.05, 0.004, 0.0);
        let lost = push(&mut pieces, &mut striker, at, DVec3::X * impulse);
        let after = [&pieces[..], &striker].concat();
        same(momenta(&before), momenta(&after));
        let made = energy(&after) + lost - energy(&before);
        assert!(lost >= 0.0 && made.abs() < 1e-12, "{impulse}: {made} J");
        assert!(striker[0].linear.x < 10.0);
    }
}

#[test]
fn what_is_held_takes_what_the_loose_pieces_cannot() {
    let mut pieces = [along(0.01, 0.1, 0.0), Rigid::earth()];
    let mut striker = [along(0.1, 0.0, 10.0)];
    push(&mut pieces, &mut striker, DVec3::X * 0.05, DVec3::X * 1.5);
    let [piece, striker] = [pieces[0].linear.x, striker[0].linear.x];
    println!("the piece leaves at {piece} m/s, the striker goes at {striker} m/s");
    assert!(piece > 5.0 && striker < 0.0, "{piece} {striker}");
    let mut pieces = [Rigid::earth()];
    let mut striker = [along(0.1, 0.0, 10.0)];
    let lost = push(&mut pieces, &mut striker, DVec3::X * 0.05, DVec3::X * 1.5);
    assert!((striker[0].linear.x + 5.0).abs() < 1e-12 && (lost - 3.75).abs() < 1e-12);
}

#[test]
fn a_toll_takes_what_it_should_and_keeps_momentum() {
    let mut bodies = [
        ball(1.0, DVec3::ZERO, DVec3::new(3.0, 1.0, 0.0)),
        ball(2.0, DVec3::X, DVec3::new(-1.0, 0.5, 2.0)),
        ball(0.5, DVec3::Y, DVec3::NEG_X),
    ];
    let (before, had) = (momenta(&bodies), energy(&bodies));
    let taken = take_energy(&mut bodies, 2.0);
    assert!((taken - 2.0).abs() < 1e-12 && (had - energy(&bodies) - 2.0).abs() < 1e-12);
    same(before, momenta(&bodies));
    let most = take_energy(&mut bodies, 1e9);
    assert!(most < had - 2.0, "no more than there is");
    same(before, momenta(&bodies));
}

#[test]
fn a_toll_among_held_ones_comes_from_the_motion_against_them() {
    let mut bodies = [Rigid::earth(), along(2.0, 0.0, 3.0)];
    assert_eq!(take_energy(&mut bodies, 5.0), 5.0);
    assert!((energy(&bodies) - 4.0).abs() < 1e-12);
}

/// A blow on a pane, and the break.
fn broken_pane() -> (Contact, Fracture) {
    let hit = bodies::pane_hit(0.01, 0.005, 12.0);
    let outcome = impact(
        &bodies::pane().body(0),
        std::slice::from_ref(&hit),
        &FractureConfig::default(),
    );
    let Ok(Outcome::Broke(fracture)) = outcome else {
        panic!("it breaks");
    };
    (hit, *fracture)
}

#[test]
fn the_nearest_fragment_is_the_one_that_was_hit() {
    let (hit, fracture) = broken_pane();
    let order = nearest_first(&fracture, &[hit.point]);
    let gap = |i: usize| {
        let fragment = &fracture.fragments[i];
        let near = hit.point - fragment.mass.centre.as_vec3();
        let corners = fragment.mesh.positions.iter();
        corners
            .map(|p| p.distance(near))
            .fold(f32::INFINITY, f32::min)
    };
    let mut all = order.clone();
    all.sort_unstable();
    assert!(all.into_iter().eq(0..fracture.fragments.len()));
    let (first, last) = (gap(order[0]), gap(order[order.len() - 1]));
    assert!(first < last, "{first} m, {last} m");
}

/// Fragments as they are right after a blow on a body that was at rest.
fn fragments(fracture: &Fracture, order: &[usize]) -> Vec<Rigid> {
    let body = |&i: &usize| {
        let mass = &fracture.fragments[i].mass;
        Rigid::free(
            mass.mass,
            mass.inertia,
            [mass.centre, DVec3::ZERO, DVec3::ZERO],
        )
    };
    order.iter().map(body).collect()
}

#[test]
fn fragments_move_apart_with_the_momentum_and_no_more_than_the_energy_of_the_blow() {
    let (hit, fracture) = broken_pane();
    assert!(fracture.moves_apart());
    let order = nearest_first(&fracture, &[hit.point]);
    let report = &fracture.report;
    let contact = &report.contacts[0];
    let push = contact.normal.as_dvec3() * contact.impulse;
    let pushes = [(contact.point.as_dvec3(), push)];
    let ball_mass = 1.0 / f64::from(hit.striker.inverse_effective_mass);
    let mut striker = [ball(
        ball_mass,
        contact.point.as_dvec3(),
        contact.normal.as_dvec3() * contact.approach_speed,
    )];
    let mut pieces = fragments(&fracture, &order);
    let before = [&pieces[..], &striker].concat();
    let taken = Kick::about(striker[0].centre, &pushes).scaled(-1.0);
    let lost = take_blow(
        &fracture,
        (&order, DMat3::IDENTITY),
        &mut pieces,
        &mut striker,
        &pushes,
        taken,
    );
    let after = [&pieces[..], &striker].concat();
    same(momenta(&before), momenta(&after));
    let made = energy(&after) + lost - energy(&before);
    println!(
        "{:.4} J before, {:.4} J after, {lost:.4} J lost, {:.4} J for cracks",
        energy(&before),
        energy(&after),
        report.fracture_energy
    );
    assert!(made.abs() < 1e-12 && lost >= report.fracture_energy);
    // They fly apart: faster against each other than as one body.
    let whole = Rigid::together(&pieces);
    let apart = energy(&pieces) - whole.kinetic_energy();
    assert!(apart > 0.05 * energy(&pieces), "{apart} J");
}

/// A box about its centre, m.
fn box_mesh(half: Vec3) -> TriMesh {
    let corner = |i: u32| half * Vec3::new(sign(i & 1), sign(i >> 1 & 1), sign(i >> 2));
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    TriMesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        outer_triangles: 12,
        ..TriMesh::default()
    }
}

fn sign(bit: u32) -> f32 {
    if bit == 0 { -1.0 } else { 1.0 }
}

/// A plate of a kilogram across x, with its middle there, and its mesh.
fn plate(middle: DVec3) -> (Rigid, TriMesh) {
    let half = Vec3::new(0.002, 0.1, 0.1);
    let [x, y, z] = half.to_array().map(|h| f64::from(h * h) / 3.0);
    let inertia = DMat3::from_diagonal(DVec3::new(y + z, x + z, x + y));
    let body = Rigid::free(1.0, inertia, [middle, DVec3::ZERO, DVec3::ZERO]);
    (body, box_mesh(half))
}

/// Throws a ball of 100 g and of 10 mm along x at plates, which it first touches at x = 0. Returns the ball, and what is lost, J.
fn thrown(plates: &mut [(Rigid, TriMesh)], speed: f64) -> (Rigid, f64) {
    let (mut bodies, meshes): (Vec<Rigid>, Vec<&TriMesh>) =
        plates.iter().map(|(body, mesh)| (*body, mesh)).unzip();
    let mut striker = along(0.1, -0.01, speed);
    let ball = Ball {
        point: DVec3::ZERO,
        normal: DVec3::X,
        radius: 0.01,
    };
    let lost = pass(&mut bodies, (&meshes, DMat3::IDENTITY), &mut striker, ball);
    plates.iter_mut().zip(bodies).for_each(|(p, b)| p.0 = b);
    (striker, lost)
}

#[test]
fn a_ball_takes_with_it_what_is_in_its_way() {
    let mut plates = [plate(DVec3::X * 0.002)];
    let (ball, lost) = thrown(&mut plates, 11.0);
    // One tenth and one kilogram go on together.
    assert!((ball.linear.x - 1.0).abs() < 1e-9, "{} m/s", ball.linear.x);
    assert!((plates[0].0.linear.x - 1.0).abs() < 1e-9);
    let goes = 0.5 * 0.1 * 121.0 - 0.5 * 1.1;
    assert!((lost - goes).abs() < 1e-9, "{lost} J");
}

#[test]
fn a_ball_flies_through_a_hole_that_is_wide_enough_and_touches_the_rim_of_another() {
    for (gap, free) in [(0.0102, true), (0.008, false)] {
        // Two plates with their edges at these distances from the line of flight.
        let side = |y: f64| plate(DVec3::new(0.002, y * (0.1 + gap), 0.0));
        let mut plates = [side(-1.0), side(1.0)];
        let before: Vec<Rigid> = plates.iter().map(|p| p.0).collect();
        let (ball, lost) = thrown(&mut plates, 5.0);
        let after: Vec<Rigid> = plates.iter().map(|p| p.0).collect();
        println!("gap {gap}: {} m/s, {lost} J lost", ball.linear.x);
        assert_eq!(free, ball.linear.x == 5.0);
        assert_eq!(free, lost == 0.0);
        let ball_before = along(0.1, -0.01, 5.0);
        let [before, after] = [(before, ball_before), (after, ball)].map(|(mut all, ball)| {
            all.push(ball);
            all
        });
        let made = energy(&after) + lost - energy(&before);
        assert!(made.abs() < 1e-12, "{made} J");
        let [p, q] = [&before, &after].map(|all| momenta(all)[0]);
        assert!((p - q).length() < 1e-12);
    }
}

#[test]
fn a_ball_that_leaves_meets_nothing() {
    let mut plates = [plate(DVec3::X * 0.002)];
    let (ball, lost) = thrown(&mut plates, -1.0);
    assert_eq!((ball.linear.x, lost), (-1.0, 0.0));
}

#[test]
fn a_ball_that_has_broken_a_pane_flies_on_with_the_momentum_that_the_pieces_leave_it() {
    let (hit, fracture) = broken_pane();
    let order = nearest_first(&fracture, &[hit.point]);
    let contact = &fracture.report.contacts[0];
    let (point, normal) = (contact.point.as_dvec3(), contact.normal.as_dvec3());
    let radius = contact.striker_radius;
    assert_eq!(radius, f64::from(hit.striker.curvature_radius));
    let mass = 1.0 / f64::from(hit.striker.inverse_effective_mass);
    let mut striker = [ball(
        mass,
        point - normal * radius,
        normal * contact.approach_speed,
    )];
    let mut pieces = fragments(&fracture, &order);
    let before = [&pieces[..], &striker].concat();
    let pushes = [(point, normal * contact.impulse)];
    let taken = Kick::about(striker[0].centre, &pushes).scaled(-1.0);
    let place = (&order[..], DMat3::IDENTITY);
    take_blow(&fracture, place, &mut pieces, &mut striker, &pushes, taken);
    let blown = [&pieces[..], &striker].concat();
    let place = (&order[..], DMat3::IDENTITY, DVec3::ZERO);
    let lost = fly_through(&fracture, place, &mut pieces, &mut striker);
    let after = [&pieces[..], &striker].concat();
    println!("{lost} J lost, then {} m/s", striker[0].linear.dot(normal));
    let [p, q] = [&before, &after].map(|all| momenta(all)[0]);
    assert!((p - q).length() < 1e-12, "{p} {q}");
    let made = energy(&after) + lost - energy(&blown);
    assert!(made.abs() < 1e-12 && lost >= 0.0, "{made} J");
    // One that is no ball about its own centre stays as it is.
    let mut off = [ball(mass, point, normal * 10.0)];
    let lost = fly_through(&fracture, place, &mut pieces, &mut off);
    assert_eq!((lost, off[0].linear), (0.0, normal * 10.0));
}

#[test]
fn a_body_that_holds_and_its_striker_get_the_blow_and_never_approach_after_it() {
    for impulse in [0.05, 0.3, 0.9] {
        let mut body = ball(1.0, DVec3::ZERO, DVec3::ZERO);
        let mut striker = [along(0.1, -0.1, 5.0)];
        let before = [&[body][..], &striker].concat();
        let pushes = [(DVec3::new(-0.05, 0.0, 0.0), DVec3::X * impulse)];
        let lost = take_held(&mut body, &mut striker, &pushes);
        let after = [&[body][..], &striker].concat();
        same(momenta(&before), momenta(&after));
        let made = energy(&after) + lost - energy(&before);
        assert!(made.abs() < 1e-12 && lost >= 0.0, "{made} J");
        // As one body they have lost 5 / 11 N·s.
        let got = body.linear.x;
        let says = f64::max(impulse, 5.0 / 11.0);
        assert!((got - says).abs() < 1e-9, "{got} N·s, not {says}");
    }
}
