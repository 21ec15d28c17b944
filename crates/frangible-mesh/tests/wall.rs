//! Thin walls are found, and meshed along their faces.

use std::f64::consts::{PI, TAU};

use frangible_mesh::glam::DVec3;
use frangible_mesh::{InputMesh, RepairReport, Surface, Wall, WallMesh, repair, repair_skin};

/// Vertices and polygons as a mesh.
fn mesh(positions: Vec<DVec3>, polygons: &[Vec<u32>]) -> InputMesh {
    let fan = |p: &Vec<u32>| -> Vec<[u32; 3]> {
        (1..p.len() - 1).map(|i| [p[0], p[i], p[i + 1]]).collect()
    };
    InputMesh {
        positions,
        triangles: polygons.iter().flat_map(fan).collect(),
        ..InputMesh::default()
    }
}

/// A box from one corner to the other, its faces outwards or inwards.
fn block(low: DVec3, high: DVec3) -> InputMesh {
    let corner = |i: u32| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    mesh((0..8).map(corner).collect(), &faces.map(|f| f.to_vec()))
}

fn together(mut first: InputMesh, second: &InputMesh) -> InputMesh {
    let offset = first.positions.len() as u32;
    first.positions.extend(&second.positions);
    let moved = second.triangles.iter().map(|t| t.map(|v| v + offset));
    first.triangles.extend(moved);
    first
}

/// A closed wall: `place` maps two parameters in 0..1 and a side of −1 or 1 to metres; `round` joins the ends of the first.
fn swept(place: impl Fn(f64, f64, f64) -> DVec3, [nu, nv]: [u32; 2], round: bool) -> InputMesh {
    let columns = if round { nu } else { nu + 1 };
    let mut positions = Vec::new();
    for side in [-1.0, 1.0] {
        for j in 0..=nv {
            for i in 0..columns {
                let at = [i, j].map(f64::from);
                positions.push(place(at[0] / f64::from(nu), at[1] / f64::from(nv), side));
            }
        }
    }
    let far = columns * (nv + 1);
    let v = |i: u32, j: u32| j * columns + i % columns;
    let mut polygons = Vec::new();
    for j in 0..nv {
        for i in 0..nu {
            let q = [v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)];
            polygons.push(q.iter().map(|w| w + far).collect());
            polygons.push(q.iter().rev().copied().collect());
        }
    }
    let mut rim = |a: u32, b: u32| polygons.push(vec![a, b, b + far, a + far]);
    for i in 0..nu {
        rim(v(i, 0), v(i + 1, 0));
        rim(v(i + 1, nv), v(i, nv));
    }
    for j in 0..if round { 0 } else { nv } {
        rim(v(0, j + 1), v(0, j));
        rim(v(nu, j), v(nu, j + 1));
    }
    mesh(positions, &polygons)
}

fn tube() -> InputMesh {
    let place = |u: f64, v: f64, side: f64| {
        let (sin, cos) = (TAU * u).sin_cos();
        let r = 0.05 + 0.0015 * side;
        DVec3::new(r * cos, r * sin, 0.2 * v)
    };
    swept(place, [48, 5], true)
}

/// A plate of 0.3 m with a round hole, 6 mm thick.
fn holed() -> InputMesh {
    let place = |u: f64, v: f64, side: f64| {
        let (sin, cos) = (TAU * u).sin_cos();
        let out = 0.15 / sin.abs().max(cos.abs());
        let r = 0.05 + v * (out - 0.05);
        DVec3::new(r * cos, r * sin, 0.003 * side)
    };
    swept(place, [48, 1], true)
}

/// A quarter of a tube with a wall that grows from 3 to 5 mm.
fn bent() -> InputMesh {
    let place = |u: f64, v: f64, side: f64| {
        let (sin, cos) = (0.5 * PI * u).sin_cos();
        let r = 0.2 + (0.0015 + 0.001 * v) * side;
        DVec3::new(r * cos, r * sin, 0.3 * v)
    };
    swept(place, [40, 30], false)
}

fn hollow() -> InputMesh {
    let outer = block(DVec3::ZERO, DVec3::splat(0.2));
    let mut inner = block(DVec3::splat(0.003), DVec3::splat(0.197));
    inner.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    together(outer, &inner)
}

fn found(mesh: &InputMesh) -> Option<(Wall, Surface, RepairReport)> {
    let (surface, report) = repair(mesh).unwrap();
    Some((Wall::of_closed(&surface, &report)?, surface, report))
}

fn volume(surface: &Surface) -> f64 {
    let six = |t: usize| {
        let [a, b, c] = surface.corners(t);
        a.dot(b.cross(c))
    };
    (0..surface.triangles.len()).map(six).sum::<f64>() / 6.0
}

fn meshed(wall: &Wall, triangles: f64) -> WallMesh {
    let edge = (wall.area() / (0.412 * triangles)).sqrt();
    wall.mesh(edge, Some(1)).expect("a mesh")
}

#[test]
fn plates_tubes_bent_sheets_and_hollow_boxes_are_walls_of_their_volume() {
    let pane = block(DVec3::ZERO, DVec3::new(0.4, 0.004, 0.4));
    let cases = [
        ("pane", pane, 0.004),
        ("holed", holed(), 0.006),
        ("tube", tube(), 0.003),
        ("bent", bent(), 0.004),
        ("hollow", hollow(), 0.003),
    ];
    for (name, mesh, thickness) in cases {
        let (wall, surface, _) = found(&mesh).unwrap_or_else(|| panic!("{name} is no wall"));
        assert!(
            (wall.thickness() / thickness - 1.0).abs() < 0.01,
            "{name}: {} m",
            wall.thickness()
        );
        for triangles in [1500.0, 6000.0] {
            let mesh = meshed(&wall, triangles);
            let count = mesh.triangles.len() as f64 / triangles;
            assert!(
                (0.85..1.2).contains(&count),
                "{name}: {count} of the number"
            );
            let off = mesh.volume() / volume(&surface) - 1.0;
            assert!(off.abs() < 1e-3, "{name}: volume {off:+.5}");
            assert!(
                mesh.smallest_angle > 15.0,
                "{name}: an angle of {}°",
                mesh.smallest_angle
            );
        }
    }
}

#[test]
fn a_box_keeps_its_faces_its_edges_and_its_volume_to_rounding() {
    let size = DVec3::new(0.3, 0.2, 0.005);
    let (wall, ..) = found(&block(DVec3::ZERO, size)).unwrap();
    let mesh = meshed(&wall, 3000.0);
    assert!((mesh.volume() / size.element_product() - 1.0).abs() < 1e-9);
    let mut corners = 0;
    for (column, free) in mesh.columns.iter().zip(&mesh.free) {
        let [a, b] = *column;
        assert!((a - b).truncate().length() < 1e-12, "a column leans");
        assert!(((a.z - b.z).abs() - size.z).abs() < 1e-12);
        let on = [
            a.x.abs(),
            (a.x - size.x).abs(),
            a.y.abs(),
            (a.y - size.y).abs(),
        ];
        let sides = on.iter().filter(|d| **d < 1e-12).count();
        assert_eq!(*free, sides == 0);
        corners += usize::from(sides == 2);
    }
    assert_eq!(corners, 4);
}

#[test]
fn every_edge_joins_two_triangles_and_the_rims_are_those_of_the_surface() {
    for (mesh, rims) in [(holed(), 2), (tube(), 2), (bent(), 1), (hollow(), 0)] {
        let mesh = meshed(&found(&mesh).unwrap().0, 2500.0);
        let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let mut all: Vec<[u32; 2]> = mesh.triangles.iter().flat_map(sides).collect();
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]));
        let open = all
            .iter()
            .filter(|[a, b]| all.binary_search(&[*b, *a]).is_err());
        let open: Vec<[u32; 2]> = open.copied().collect();
        let (v, f) = (mesh.columns.len() as i64, mesh.triangles.len() as i64);
        let e = (all.len() + open.len()) as i64 / 2;
        // A sphere with this many holes.
        assert_eq!(v - e + f, 2 - rims, "{} open edges", open.len());
    }
}

#[test]
fn no_direction_is_preferred() {
    let pane = block(DVec3::ZERO, DVec3::new(0.4, 0.4, 0.004));
    let wall = found(&pane).unwrap().0;
    let mut lengths = [0.0; 12];
    for seed in 0..4 {
        let mesh = wall.mesh(0.006, Some(seed)).unwrap();
        for t in &mesh.triangles {
            for k in 0..3 {
                let ends = [t[k], t[(k + 1) % 3]].map(|v| v as usize);
                if ends.iter().all(|&v| mesh.free[v]) {
                    let way = mesh.columns[ends[1]][1] - mesh.columns[ends[0]][1];
                    let turn = way.y.atan2(way.x).rem_euclid(PI) / PI;
                    lengths[((12.0 * turn) as usize).min(11)] += way.length();
                }
            }
        }
    }
    let mean = lengths.iter().sum::<f64>() / 12.0;
    // Some 6 000 edges in each twelfth: by chance alone they differ by 1.3 %.
    for length in lengths {
        assert!((length / mean - 1.0).abs() < 0.06, "{lengths:?}");
    }
}

#[test]
fn lumps_rods_steps_and_separate_parts_are_no_walls() {
    let slab = |size: [f64; 3]| block(DVec3::ZERO, DVec3::from_array(size));
    let step = |u: f64, v: f64, side: f64| {
        let half = if u < 0.5 { 0.001 } else { 0.02 };
        DVec3::new(0.2 * u, 0.2 * v, half * side)
    };
    let far = block(DVec3::new(0.0, 0.0, 0.1), DVec3::new(0.2, 0.2, 0.104));
    for (name, mesh) in [
        ("cube", slab([0.1, 0.1, 0.1])),
        ("brick", slab([0.2, 0.1, 0.06])),
        ("rod", slab([0.2, 0.008, 0.006])),
        ("step", swept(step, [40, 10], false)),
        ("two panes", together(slab([0.2, 0.2, 0.004]), &far)),
    ] {
        assert!(found(&mesh).is_none(), "{name} is a wall");
    }
    let mut open = slab([0.2, 0.2, 0.004]);
    open.triangles.pop();
    assert!(found(&open).is_none());
}

#[test]
fn a_sheet_of_one_quadrangle_becomes_a_pane() {
    let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]];
    let flat = |[x, y]: [f64; 2]| DVec3::new(x, y, 0.3);
    let quad = mesh(corners.map(flat).to_vec(), &[vec![0, 1, 2, 3]]);
    let doubled = mesh(
        corners.map(flat).to_vec(),
        &[vec![0, 1, 2, 3], vec![0, 3, 2, 1]],
    );
    for sheet in [quad, doubled] {
        let (surface, report) = repair_skin(&sheet).unwrap();
        assert_eq!((report.shells, surface.facing()), (1, 1.0));
        let wall = Wall::of_skin(&surface, 0.004).unwrap();
        let mesh = meshed(&wall, 1000.0);
        assert!((mesh.volume() / (0.2 * 0.1 * 0.004) - 1.0).abs() < 1e-9);
        for [a, b] in mesh.columns {
            assert!((a.z - 0.3).abs() < 0.002 + 1e-12 && (a.z + b.z - 0.6).abs() < 1e-12);
        }
    }
}

#[test]
fn a_closed_sheet_becomes_a_hollow_body_with_mitred_edges() {
    let size = DVec3::new(0.2, 0.15, 0.1);
    let (surface, _) = repair_skin(&block(DVec3::ZERO, size)).unwrap();
    let wall = Wall::of_skin(&surface, 0.004).unwrap();
    let exact = (size + 0.004).element_product() - (size - 0.004).element_product();
    let volume = meshed(&wall, 9000.0).volume();
    // Corners of the remeshed box are kept, and so are its edges.
    assert!((volume / exact - 1.0).abs() < 1e-6, "{volume}, not {exact}");
}

#[test]
fn sheets_that_branch_touch_or_overlap_get_no_layers() {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    // Three sheets at one edge.
    let three = mesh(
        vec![
            at(0.0, 0.0, 0.0),
            at(0.0, 0.0, 0.1),
            at(0.1, 0.0, 0.0),
            at(0.1, 0.0, 0.1),
            at(-0.1, 0.05, 0.0),
            at(-0.1, 0.05, 0.1),
            at(-0.1, -0.05, 0.0),
            at(-0.1, -0.05, 0.1),
        ],
        &[vec![0, 1, 3, 2], vec![0, 1, 5, 4], vec![0, 1, 7, 6]],
    );
    let (surface, _) = repair_skin(&three).unwrap();
    assert!(Wall::of_skin(&surface, 0.004).is_none());
    // A roll whose turns are 3 mm apart.
    let turns = 2.0;
    let columns = 120;
    let mut positions = Vec::new();
    for i in 0..=columns {
        let t = turns * f64::from(i) / f64::from(columns);
        let r = 0.03 + 0.003 * t;
        let (sin, cos) = (TAU * t).sin_cos();
        positions.extend([at(r * cos, r * sin, 0.0), at(r * cos, r * sin, 0.1)]);
    }
    let strip: Vec<Vec<u32>> = (0..columns)
        .map(|i| vec![2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1])
        .collect();
    let (surface, _) = repair_skin(&mesh(positions, &strip)).unwrap();
    let thin = Wall::of_skin(&surface, 0.001).unwrap();
    assert!(thin.mesh(0.004, Some(1)).is_some());
    let thick = Wall::of_skin(&surface, 0.004).unwrap();
    assert!(thick.mesh(0.004, Some(1)).is_none());
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let (surface, report) = repair(&bent()).unwrap();
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let wall = Wall::of_closed(&surface, &report).unwrap();
            wall.mesh(0.01, Some(3)).unwrap()
        })
    };
    let mesh = with_threads(1);
    assert_eq!(mesh, with_threads(2));
    let other = Wall::of_closed(&surface, &report).unwrap();
    assert_ne!(mesh, other.mesh(0.01, Some(4)).unwrap());
}
