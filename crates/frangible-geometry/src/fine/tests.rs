use std::collections::BTreeMap;

use super::*;
use crate::surface::TriMesh;

/// Squares along one side of the interface.
const SQUARES: u32 = 12;

/// Side of a square, m.
const SIDE: f32 = 2e-3;

const FINE: FineFaces = FineFaces {
    edge: 0.6e-3,
    mesh_edge: SIDE,
    amplitude: 1e-3,
    wavelength: 8e-3,
};

/// A piece on one side of a level interface: the faces of the crack, and an apex above or below them.
fn piece(is_above: bool, origin: Vec3) -> RenderMesh {
    let row = SQUARES + 1;
    let mut positions = Vec::new();
    for x in 0..row {
        for z in 0..row {
            positions.push(Vec3::new(x as f32, 0.0, z as f32) * SIDE - origin);
        }
    }
    let side = SQUARES as f32 * SIDE;
    let apex = positions.len() as u32;
    let height = if is_above { side } else { -side };
    positions.push(Vec3::new(0.5 * side, height, 0.5 * side) - origin);
    let turned = |t: [u32; 3]| {
        if is_above { t } else { [t[0], t[2], t[1]] }
    };
    let mut inner = Vec::new();
    for x in 0..SQUARES {
        for z in 0..SQUARES {
            let [a, b, c, d] = [0, row, row + 1, 1].map(|step| x * row + z + step);
            inner.extend([[a, b, c], [a, c, d]].map(turned));
        }
    }
    let last = SQUARES * row;
    let mut triangles = Vec::new();
    for i in 0..SQUARES {
        let borders = [
            [i, i + 1],
            [last + i + 1, last + i],
            [(i + 1) * row, i * row],
            [i * row + SQUARES, (i + 1) * row + SQUARES],
        ];
        triangles.extend(borders.map(|[a, b]| turned([a, b, apex])));
    }
    let outer_triangles = triangles.len();
    triangles.extend(inner);
    RenderMesh {
        normals: vec![Vec3::Y; positions.len()],
        uvs: vec![[0.0; 2]; positions.len()],
        colors: vec![[0.5; 4]; positions.len()],
        positions,
        triangles,
        outer_triangles,
        ..RenderMesh::default()
    }
}

fn closed(mesh: &RenderMesh) -> TriMesh {
    let (positions, place_of) = welded(&mesh.positions);
    let triangles = mesh.triangles.iter();
    TriMesh {
        positions,
        triangles: triangles.map(|t| t.map(|v| place_of[v as usize])).collect(),
        outer_triangles: mesh.outer_triangles,
        ..TriMesh::default()
    }
}

/// Corners of the crack faces in the frame of the body.
fn corners(mesh: &RenderMesh, origin: Vec3) -> Vec<Vec3> {
    let places = closed(mesh);
    let mut of: BTreeMap<u32, Vec3> = BTreeMap::new();
    for t in &places.triangles[mesh.outer_triangles..] {
        for &v in t {
            of.insert(v, places.positions[v as usize] + origin);
        }
    }
    of.into_values().collect()
}

#[test]
fn pieces_stay_closed_with_their_volume_and_the_plane_of_their_outer_surface() {
    for is_above in [true, false] {
        let mesh = piece(is_above, Vec3::ZERO);
        assert!(closed(&mesh).is_closed());
        let fine = FINE.of(&mesh, Vec3::ZERO);
        let solid = closed(&fine);
        assert!(solid.is_closed());
        assert!((solid.volume() / closed(&mesh).volume() - 1.0).abs() < 0.01);
        assert!(fine.triangles.len() > 8 * mesh.triangles.len());
        // Rims are displaced within the outer surface, which is said to be level.
        let outer = &fine.triangles[..fine.outer_triangles];
        for &v in outer.as_flattened() {
            let position = fine.positions[v as usize];
            assert!(position.y == 0.0 || position == mesh.positions[mesh.positions.len() - 1]);
            assert_eq!(fine.colors[v as usize], [0.5; 4]);
        }
        assert!(outer.len() > 2 * mesh.outer_triangles);
        let vertices = fine.positions.len();
        assert_eq!(
            [fine.normals.len(), fine.uvs.len(), fine.colors.len()],
            [vertices; 3]
        );
    }
}

#[test]
fn edges_of_crack_faces_are_no_longer_than_asked_for() {
    let fine = closed(&FINE.of(&piece(true, Vec3::ZERO), Vec3::ZERO));
    for t in &fine.triangles[fine.outer_triangles..] {
        let [a, b, c] = t.map(|v| fine.positions[v as usize]);
        for (a, b) in [(a, b), (b, c), (c, a)] {
            assert!(a.distance(b) <= FINE.edge, "{a} {b}");
        }
    }
}

#[test]
fn the_two_sides_of_a_crack_fit() {
    let origins = [
        Vec3::new(0.013, 0.004, 0.011),
        Vec3::new(-0.002, -0.005, 0.02),
    ];
    let [above, below] = [true, false].map(|is_above| {
        let origin = origins[usize::from(is_above)];
        corners(&FINE.of(&piece(is_above, origin), origin), origin)
    });
    // Rounding may put the length of an edge on either side of the limit.
    let nearest = |a: &Vec3| {
        let distances = below.iter().map(|b| a.distance(*b));
        distances.fold(f32::MAX, f32::min)
    };
    let apart = above.iter().filter(|a| nearest(a) > 1e-6).count();
    assert!(apart < above.len() / 1000, "{apart} of {}", above.len());
    assert!(above.len().abs_diff(below.len()) < above.len() / 1000);
    let height = above.iter().map(|p| p.y.abs()).fold(0.0, f32::max);
    assert!(height > 1e-4, "{height}");
}

#[test]
fn middles_are_displaced_as_a_self_affine_profile_asks() {
    let of = |length| split::middle_deviation(&FINE, length);
    assert!((of(2.0 * SIDE) / of(SIDE) - 2.0_f32.powf(0.8)).abs() < 1e-4);
    let heights = |edge: f32| {
        let fine = FineFaces { edge, ..FINE };
        let all = corners(&fine.of(&piece(true, Vec3::ZERO), Vec3::ZERO), Vec3::ZERO);
        let sum: f32 = all.iter().map(|p| p.y * p.y).sum();
        (sum / all.len() as f32).sqrt()
    };
    // Middles alone move at first; of all corners they are about three quarters, and the diagonals of squares are longer than their sides.
    let expected = split::middle_deviation(&FINE, SIDE);
    let found = heights(0.75 * SIDE);
    assert!(
        (0.7..1.3).contains(&(found / expected)),
        "{found} {expected}"
    );
}

#[test]
fn smooth_materials_and_pieces_without_crack_faces_stay_as_they_are() {
    let mesh = piece(true, Vec3::ZERO);
    let smooth = FineFaces {
        amplitude: 0.0,
        ..FINE
    };
    assert_eq!(smooth.of(&mesh, Vec3::ZERO).triangles, mesh.triangles);
    let whole = RenderMesh {
        outer_triangles: mesh.triangles.len(),
        ..mesh.clone()
    };
    assert_eq!(FINE.of(&whole, Vec3::ZERO).triangles, mesh.triangles);
    for edge in [0.0, f32::NAN] {
        let fine = FineFaces { edge, ..FINE };
        assert_eq!(fine.of(&mesh, Vec3::ZERO).triangles, mesh.triangles);
    }
}
