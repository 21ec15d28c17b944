//! Vertices, edges and triangles that do not fit together.

use frangible_mesh::InputMesh;
use frangible_mesh::glam::DVec3;

use super::{ball, cube, joined, mesh, repaired, soup, turned, volume};

#[test]
fn a_split_cube_is_welded_to_eight_closed_corners() {
    let (surface, report) = repaired(&soup(&cube(DVec3::splat(0.3), 0.1)));
    assert_eq!(surface.positions.len(), 8);
    assert_eq!(
        (report.welded, report.boundary_edges, report.shells),
        (28, 0, 1)
    );
    assert!((volume(&surface) - 1e-3).abs() < 1e-15);
    assert_eq!(report.to_string(), "welded 28 vertices");
}

#[test]
fn hairline_cracks_close_and_thin_walls_do_not() {
    let mut cracked = soup(&ball(1.0, DVec3::ZERO));
    for (i, p) in cracked.positions.iter_mut().enumerate() {
        *p *= 1.0 + 1e-6 * ((i * 7 % 5) as f64 - 2.0);
    }
    let (surface, report) = repaired(&cracked);
    assert_eq!((surface.positions.len(), report.boundary_edges), (86, 0));

    // A closed sheet far thinner than the reach of the crack rule.
    let mut thin = cube(DVec3::ZERO, 1.0);
    thin.positions.iter_mut().for_each(|p| p.z *= 4e-6);
    let (surface, report) = repaired(&soup(&thin));
    assert_eq!((surface.positions.len(), report.boundary_edges), (8, 0));
    assert!((volume(&surface) / 4e-6 - 1.0).abs() < 1e-9);
}

#[test]
fn a_finely_divided_rim_keeps_its_vertices() {
    // A cup whose rim has edges of 6e-6 of its size.
    let n = 1000_u32;
    let ring = |k: u32| {
        let turn = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        DVec3::new(1e-3 * turn.cos(), 0.0, -1e-3 * turn.sin())
    };
    let mut positions: Vec<DVec3> = (0..n).map(ring).collect();
    positions.push(-DVec3::Y);
    let cup = mesh(positions, (0..n).map(|k| [k, n, (k + 1) % n]).collect());
    let (surface, report) = repaired(&cup);
    assert_eq!(
        (surface.positions.len() as u32, report.boundary_edges as u32),
        (n + 1, n)
    );
}

#[test]
fn a_membrane_between_two_cubes_goes() {
    let (left, right) = (cube(DVec3::ZERO, 1.0), cube(DVec3::X, 1.0));
    let on_wall = |m: &InputMesh, t: &[u32; 3]| t.iter().all(|&v| m.positions[v as usize].x == 1.0);
    // Both cut the wall along the same diagonal: the right cube takes the left one's triangles, turned.
    let wall: Vec<[u32; 3]> = left
        .triangles
        .iter()
        .copied()
        .filter(|t| on_wall(&left, t))
        .collect();
    let mut open = right.clone();
    open.triangles.retain(|t| !on_wall(&right, t));
    let mut both = joined(&[left, open]);
    both.triangles
        .extend(wall.iter().map(|&[a, b, c]| [a, c, b]));
    let (surface, report) = repaired(&both);
    assert_eq!(
        (report.duplicate, report.non_manifold_edges, report.shells),
        (4, 0, 1)
    );
    assert!(report.is_watertight());
    assert!((volume(&surface) - 2.0).abs() < 1e-12);
}

#[test]
fn a_fin_goes_and_a_double_sided_lid_stays() {
    let body = cube(DVec3::ZERO, 1.0);
    let mut finned = body.clone();
    finned.positions.push(DVec3::new(-1.0, 0.5, -1.0));
    finned.triangles.extend([[0, 2, 8], [2, 0, 8]]);
    let (surface, report) = repaired(&finned);
    assert_eq!((surface.triangles.len(), report.duplicate), (12, 2));
    assert!(report.is_watertight());

    let mut lidded = body.clone();
    let lid = lidded.triangles[0];
    lidded.triangles.push([lid[0], lid[2], lid[1]]);
    let (surface, report) = repaired(&lidded);
    assert_eq!((surface.triangles.len(), report.duplicate), (12, 1));
    assert!(report.is_watertight() && (volume(&surface) - 1.0).abs() < 1e-12);
}

#[test]
fn two_cubes_on_one_edge_are_two_shells() {
    let both = joined(&[
        cube(DVec3::ZERO, 1.0),
        turned(cube(DVec3::new(1.0, 1.0, 0.0), 1.0)),
    ]);
    let (surface, report) = repaired(&both);
    assert_eq!(
        (report.non_manifold_edges, report.shells, report.open_shells),
        (1, 2, 0)
    );
    assert!((volume(&surface) - 2.0).abs() < 1e-12);
}

#[test]
fn a_moebius_strip_is_reported() {
    let n = 24_u32;
    let mut positions = Vec::new();
    for k in 0..n {
        let turn = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (turn / 2.0).cos();
            positions.push(DVec3::new(
                r * turn.cos(),
                side * (turn / 2.0).sin(),
                r * turn.sin(),
            ));
        }
    }
    let mut triangles = Vec::new();
    for k in 0..n {
        let (a, b) = (2 * k, 2 * k + 1);
        let (c, d) = if k + 1 == n {
            (1, 0)
        } else {
            (2 * k + 2, 2 * k + 3)
        };
        triangles.extend([[a, b, c], [b, d, c]]);
    }
    let (_, report) = repaired(&mesh(positions, triangles));
    assert_eq!(
        (report.shells, report.one_sided, report.boundary_loops),
        (1, 1, 1)
    );
}

#[test]
fn holes_loose_vertices_and_needles_are_counted() {
    let mut open = ball(1.0, DVec3::ZERO);
    open.triangles
        .retain(|t| !t.contains(&0) && !t.contains(&1));
    let needle = [2, 2, 3];
    open.triangles.push(needle);
    let (surface, report) = repaired(&open);
    assert_eq!(
        (report.boundary_loops, report.boundary_edges, report.loose),
        (2, 24, 2)
    );
    assert_eq!((report.degenerate, surface.positions.len()), (1, 84));
    // Turned as a whole, it is still turned back: closed over its rims it would be inside out.
    let (_, report) = repaired(&turned(open));
    assert_eq!(report.flipped, surface.triangles.len());
}

#[test]
fn a_triangle_without_area_goes_but_leaves_its_neighbours_wound_alike() {
    // A cube with one edge split on one side only; a needle bridges the split.
    let mut split = cube(DVec3::ZERO, 1.0);
    split.positions.push(DVec3::new(0.5, 0.0, 0.0));
    let at = split
        .triangles
        .iter()
        .position(|t| t.contains(&0) && t.contains(&1) && t.iter().all(|&v| v < 4));
    let [a, b, c] = split.triangles.remove(at.expect("a triangle on the edge"));
    let apex = [a, b, c]
        .into_iter()
        .find(|&v| v > 1)
        .expect("a third corner");
    split
        .triangles
        .extend([[apex, 1, 8], [apex, 8, 0], [0, 8, 1]]);
    let (surface, report) = repaired(&split);
    assert_eq!((report.degenerate, report.boundary_edges), (1, 0));
    assert!((volume(&surface) - 1.0).abs() < 1e-12);
}
