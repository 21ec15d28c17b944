//! Parts of surfaces: what is one body, and what is not.

mod bodies;
mod open;

use frangible_mesh::glam::DVec3;
use frangible_mesh::{ChosenParts, InputGroup, InputMesh, PartChoice, PartError, Parts};

/// Adds a box with twelve triangles that face outwards, in a group of this name.
fn add_box(mesh: &mut InputMesh, name: &str, low: [f64; 3], high: [f64; 3]) {
    let [low, high] = [low, high].map(DVec3::from);
    let first = mesh.positions.len() as u32;
    let start = mesh.triangles.len() as u32;
    for i in 0..8 {
        let pick = |k: usize| if i >> k & 1 == 0 { low[k] } else { high[k] };
        mesh.positions.push(DVec3::new(pick(0), pick(1), pick(2)));
    }
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    for [a, b, c, d] in quads {
        mesh.triangles
            .extend([[a, b, c], [a, c, d]].map(|t| t.map(|v| first + v)));
    }
    let triangles = start..mesh.triangles.len() as u32;
    let name = name.into();
    mesh.groups.push(InputGroup { name, triangles });
}

fn boxes(list: &[([f64; 3], [f64; 3])]) -> InputMesh {
    let mut mesh = InputMesh::default();
    for (low, high) in list {
        add_box(&mut mesh, "", *low, *high);
    }
    mesh
}

/// A ball of triangles about `centre`.
fn ball(centre: DVec3, radius: f64, rings: u32) -> InputMesh {
    let mut mesh = InputMesh::default();
    let around = 2 * rings;
    for i in 0..=rings {
        for j in 0..around {
            let polar = std::f64::consts::PI * f64::from(i) / f64::from(rings);
            let turn = std::f64::consts::TAU * f64::from(j) / f64::from(around);
            let (s, c) = polar.sin_cos();
            // One place at each pole.
            let s = if i == 0 || i == rings { 0.0 } else { s };
            mesh.positions
                .push(centre + radius * DVec3::new(s * turn.cos(), s * turn.sin(), c));
        }
    }
    for i in 0..rings {
        for j in 0..around {
            let at = |i: u32, j: u32| i * around + j % around;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if i > 0 {
                mesh.triangles.push([a, b, d]);
            }
            if i + 1 < rings {
                mesh.triangles.push([b, c, d]);
            }
        }
    }
    mesh
}

fn join(mut one: InputMesh, two: &InputMesh) -> InputMesh {
    let first = one.positions.len() as u32;
    one.positions.extend(&two.positions);
    one.triangles
        .extend(two.triangles.iter().map(|t| t.map(|v| first + v)));
    one
}

fn inside_out(mut mesh: InputMesh) -> InputMesh {
    for [_, b, c] in &mut mesh.triangles {
        std::mem::swap(b, c);
    }
    mesh
}

fn volume(mesh: &InputMesh) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
    mesh.triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corners(t);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

fn chosen(mesh: &InputMesh, choice: &PartChoice) -> (Parts, ChosenParts) {
    let parts = Parts::of(mesh).unwrap();
    let chosen = parts.choose(mesh, choice).unwrap();
    (parts, chosen)
}

/// Number of parts, and of the bodies that are chosen without asking.
fn counts(mesh: &InputMesh) -> [usize; 2] {
    let (parts, chosen) = chosen(mesh, &PartChoice::Auto);
    [parts.list.len(), chosen.bodies.len()]
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1e-3)
}

/// Layers of 1 × 1 × 1/`count` m that share single faces, as a file of layers has them.
fn layers(count: usize) -> InputMesh {
    let mut mesh = InputMesh::default();
    for level in 0..=count {
        let z = level as f64 / count as f64;
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        mesh.positions
            .extend(corners.map(|[x, y]| DVec3::new(x, y, z)));
        let [a, b, c, d] = [0, 1, 2, 3].map(|v| 4 * level as u32 + v);
        // The bottom faces down; all others face up.
        if level == 0 {
            mesh.triangles.extend([[a, c, b], [a, d, c]]);
        } else {
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
            for (p, q) in [(a, b), (b, c), (c, d), (d, a)] {
                mesh.triangles.extend([[p - 4, q - 4, q], [p - 4, q, p]]);
            }
        }
    }
    mesh
}

#[test]
fn specks_are_left_out_and_counted_and_many_equal_parts_are_not() {
    let mut list = vec![([0.0; 3], [1.0; 3])];
    for i in 0..5 {
        let x = 1.5 + 0.2 * f64::from(i);
        list.push(([x, 0.0, 0.0], [x + 0.1, 0.1, 0.1]));
    }
    let (_, chosen_bodies) = chosen(&boxes(&list), &PartChoice::Auto);
    assert_eq!((chosen_bodies.bodies.len(), chosen_bodies.dropped), (1, 5));
    assert!((chosen_bodies.dropped_share - 0.005 / 1.005).abs() < 1e-9);
    let note = chosen_bodies.note.unwrap();
    assert!(note.contains("5 parts smaller than 1 %"), "{note}");

    let many = |count: i32| {
        let cubes = (0..count).map(|i| {
            let x = 1.5 * f64::from(i);
            ([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0])
        });
        boxes(&cubes.collect::<Vec<_>>())
    };
    assert_eq!(counts(&many(100)), [100, 100]);
    let mesh = many(120);
    let parts = Parts::of(&mesh).unwrap();
    let refused = parts.choose(&mesh, &PartChoice::Auto).unwrap_err();
    assert_eq!(refused, PartError::TooMany { count: 120 });
    let largest = parts.choose(&mesh, &PartChoice::Largest).unwrap();
    assert_eq!((largest.bodies.len(), largest.dropped), (1, 119));
}

#[test]
fn the_choice_is_kept_and_what_cannot_be_chosen_is_refused() {
    let mut mesh = InputMesh::default();
    add_box(&mut mesh, "base", [0.0; 3], [1.0, 1.0, 1.0]);
    add_box(&mut mesh, "lid", [0.0, 0.0, 1.01], [1.0, 1.0, 1.2]);
    add_box(&mut mesh, "knob", [0.4, 0.4, 1.25], [0.6, 0.6, 1.7]);
    let parts = Parts::of(&mesh).unwrap();
    let names = |choice: &PartChoice| -> Vec<String> {
        let chosen = parts.choose(&mesh, choice).unwrap();
        chosen.bodies.into_iter().map(|b| b.name).collect()
    };
    assert_eq!(names(&PartChoice::Auto), ["base", "lid", "knob"]);
    assert_eq!(names(&PartChoice::Largest), ["base"]);
    assert_eq!(names(&PartChoice::Only("knob".into())), ["knob"]);
    let unknown = parts.choose(&mesh, &PartChoice::Only("foot".into()));
    assert!(
        unknown
            .unwrap_err()
            .to_string()
            .contains("`base`, `lid`, `knob`")
    );

    // Welding wants the widest gap that is on the way: the knob is 50 mm above the lid.
    let weld = |gap: f64| parts.choose(&mesh, &PartChoice::Weld { gap: Some(gap) });
    let Err(PartError::Apart {
        one, other, width, ..
    }) = weld(0.02)
    else {
        panic!("it was welded");
    };
    assert_eq!((&*one, &*other), ("lid", "knob"));
    assert!((width - 0.05).abs() < 1e-9);
    let welded = weld(0.05).unwrap();
    assert_eq!((welded.bodies.len(), welded.weld), (1, Some(0.05)));
    assert_eq!(welded.bodies[0].parts, [0, 1, 2]);
    for gap in [f64::NAN, -1.0] {
        assert!(matches!(weld(gap), Err(PartError::Gap(_))));
    }
    let touching = parts.choose(&mesh, &PartChoice::Weld { gap: None });
    assert!(matches!(touching, Err(PartError::Apart { .. })));
}

#[test]
fn parts_are_named_as_the_file_names_them_and_numbered_without_a_name() {
    let mut mesh = InputMesh::default();
    for i in 0..3 {
        let x = 2.0 * f64::from(i);
        add_box(&mut mesh, "", [x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]);
    }
    let names = |mesh: &InputMesh| -> Vec<String> {
        let parts = Parts::of(mesh).unwrap().list.into_iter();
        parts.map(|part| part.name).collect()
    };
    assert_eq!(names(&mesh), ["part 1", "part 2", "part 3"]);
    // A group of all, one of two and one of a few faces.
    let group = |name: &str, triangles| InputGroup {
        name: name.into(),
        triangles,
    };
    mesh.groups = vec![
        group("all", 0..36),
        group("two", 0..24),
        group("last", 24..36),
        group("few", 0..3),
    ];
    assert_eq!(names(&mesh), ["two 1", "two 2", "last"]);
}

#[test]
fn attributes_of_a_part_stay_with_its_vertices() {
    let mut mesh = layers(2);
    let count = mesh.positions.len();
    mesh.normals = vec![frangible_mesh::glam::Vec3::Z; count];
    mesh.uvs = (0..count)
        .map(|v| frangible_mesh::glam::Vec2::splat(v as f32))
        .collect();
    mesh.material_of_triangle = vec![0; mesh.triangles.len()];
    mesh.materials = vec![Default::default()];
    let (parts, chosen) = chosen(&mesh, &PartChoice::Separate);
    for body in &chosen.bodies {
        let own = parts.mesh(&mesh, &body.parts);
        assert_eq!(own.material_of_triangle.len(), own.triangles.len());
        for (p, uv) in own.positions.iter().zip(&own.uvs) {
            assert_eq!(mesh.positions[uv.x as usize], *p);
        }
        // The shared face is turned for one of the layers, and its normals with it.
        for triangle in &own.triangles {
            let [a, b, c] = triangle.map(|v| own.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            if (a.z - 0.5).abs() < 1e-9 && normal.z.abs() > 0.1 {
                assert_eq!(
                    f64::from(own.normals[triangle[0] as usize].z),
                    normal.z.signum()
                );
            }
        }
    }
}
