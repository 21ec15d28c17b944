//! Parts of surfaces: what is one body, and what is not.

use frangible_mesh::glam::DVec3;
use frangible_mesh::{
    ChosenParts, InputGroup, InputMesh, MeshSolid, PartChoice, PartError, Parts, Surface, repair,
};

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
fn two_cubes_apart_are_two_bodies_with_their_volumes_and_their_gap() {
    let mesh = boxes(&[([0.0; 3], [0.1; 3]), ([0.102, 0.0, 0.0], [0.202, 0.1, 0.1])]);
    let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
    assert_eq!(chosen.bodies.len(), 2);
    assert!(
        chosen
            .bodies
            .iter()
            .all(|b| b.is_exact && near(b.volume, 1e-3))
    );
    assert!((chosen.gap.unwrap().width - 0.002).abs() < 1e-12);
    for body in &chosen.bodies {
        let own = parts.mesh(&mesh, &body.parts);
        assert_eq!(own.triangles.len(), 12);
        assert!(near(volume(&own), 1e-3));
    }
    let note = chosen.note.unwrap();
    assert!(
        note.contains("2 closed parts") && note.contains("2.000 mm"),
        "{note}"
    );
}

#[test]
fn one_closed_shell_is_its_own_mesh_and_has_no_note() {
    for mesh in [boxes(&[([0.0; 3], [1.0; 3])]), ball(DVec3::ONE, 0.5, 9)] {
        let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
        assert_eq!((chosen.bodies.len(), chosen.note), (1, None));
        assert!(near(chosen.bodies[0].volume, volume(&mesh)));
        let own = parts.mesh(&mesh, &chosen.bodies[0].parts);
        assert_eq!(
            (own.positions, own.triangles),
            (mesh.positions, mesh.triangles)
        );
    }
}

#[test]
fn layers_that_share_faces_are_one_body_without_losing_volume() {
    for count in [2, 3, 8] {
        let mesh = layers(count);
        let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
        assert_eq!([parts.list.len(), chosen.bodies.len()], [count, 1]);
        assert_eq!(parts.shared_faces, 2 * (count - 1));
        assert!(near(chosen.bodies[0].volume, 1.0) && chosen.bodies[0].is_exact);
        let own = parts.mesh(&mesh, &chosen.bodies[0].parts);
        let (surface, report) = repair(&own).unwrap();
        assert!(report.is_watertight(), "{report:?}");
        let solid = MeshSolid::new(&surface).unwrap();
        for level in 0..count {
            let p = DVec3::new(0.4, 0.6, (level as f64 + 0.5) / count as f64);
            assert!((solid.winding_number(p) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn each_layer_can_be_a_closed_body() {
    let mesh = layers(3);
    let (parts, chosen) = chosen(&mesh, &PartChoice::Separate);
    assert_eq!(chosen.bodies.len(), 3);
    for body in &chosen.bodies {
        let own = parts.mesh(&mesh, &body.parts);
        let (surface, report) = repair(&own).unwrap();
        assert!(report.is_watertight() && report.flipped == 0, "{report:?}");
        assert!(near(body.volume, 1.0 / 3.0) && near(volume(&own), 1.0 / 3.0));
        assert_eq!(surface.triangles.len(), 12);
    }
    assert!(chosen.gap.unwrap().width < 1e-12);
}

#[test]
fn boxes_that_touch_are_two_bodies_whether_or_not_their_vertices_meet() {
    let whole_face = ([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]);
    let part_of_face = ([1.0, 0.2, 0.3], [2.0, 0.7, 0.8]);
    let an_edge = ([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]);
    let a_corner = ([1.0, 1.0, 1.0], [2.0, 2.0, 2.0]);
    // Rounding makes bodies that touch overlap by some micrometres.
    let rounded = ([1.0 - 2e-6, 0.0, 0.0], [2.0, 1.0, 1.0]);
    for other in [whole_face, part_of_face, an_edge, a_corner, rounded] {
        let mesh = boxes(&[([0.0; 3], [1.0; 3]), other]);
        let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
        assert_eq!(chosen.bodies.len(), 2, "{other:?}");
        assert!(chosen.gap.unwrap().width <= 2e-6);
        for body in &chosen.bodies {
            let own = parts.mesh(&mesh, &body.parts);
            assert_eq!(own.triangles.len(), 12);
            assert!(near(volume(&own), body.volume));
        }
    }
}

#[test]
fn shells_that_overlap_are_one_body() {
    let plank = ([0.0, 0.0, 0.0], [10.0, 1.0, 1.0]);
    for (case, other) in [
        ("a handle that pierces", ([4.0, 0.5, 0.2], [5.0, 3.0, 0.8])),
        (
            "planks that cross flush",
            ([4.0, -5.0, 0.0], [5.0, 5.0, 1.0]),
        ),
        ("ends in one another", ([9.0, 0.0, 0.0], [15.0, 1.0, 1.0])),
        ("the same box again", plank),
        ("a box inside", ([4.0, 0.2, 0.2], [6.0, 0.8, 0.8])),
        (
            "a box inside on its floor",
            ([4.0, 0.2, 0.0], [6.0, 0.8, 0.8]),
        ),
        ("a needle through", ([4.0, -5.0, 0.4], [4.01, 5.0, 0.41])),
    ] {
        for turn in [false, true] {
            let pair = if turn { [other, plank] } else { [plank, other] };
            assert_eq!(counts(&boxes(&pair)), [1, 1], "{case}");
        }
    }
    let turned = join(boxes(&[plank]), &ball(DVec3::new(5.0, 1.3, 0.5), 0.6, 12));
    assert_eq!(counts(&turned), [1, 1]);
    // A chain of overlaps, whose ends are far apart.
    let chain: Vec<_> = (0..6)
        .map(|i| {
            let x = 0.9 * f64::from(i);
            ([x, 0.0, 0.0], [x + 1.0, 1.0 + 0.1 * f64::from(i), 1.0])
        })
        .collect();
    assert_eq!(counts(&boxes(&chain)), [1, 1]);
}

#[test]
fn a_shell_inside_another_is_a_hollow_a_solid_or_loose() {
    let outer = ball(DVec3::ZERO, 1.0, 16);
    let inner = ball(DVec3::new(0.1, 0.0, 0.0), 0.5, 12);
    let loose = ball(DVec3::new(0.1, 0.05, 0.0), 0.3, 8);
    let [v, w, x] = [&outer, &inner, &loose].map(volume);
    let hollow = join(outer.clone(), &inside_out(inner.clone()));
    // Inside out as a whole it is the same.
    for mesh in [hollow.clone(), inside_out(hollow.clone())] {
        let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
        assert_eq!(chosen.bodies.len(), 1);
        assert_eq!((parts.list[0].hollows, parts.list[0].nested), (1, 0));
        assert!(near(parts.list[0].volume, v - w) && parts.list[0].is_exact);
    }
    let solid = Parts::of(&join(outer, &inner)).unwrap();
    assert_eq!((solid.list.len(), solid.list[0].nested), (1, 1));
    assert!(near(solid.list[0].volume, v));
    for rattle in [loose.clone(), inside_out(loose)] {
        let parts = Parts::of(&join(hollow.clone(), &rattle)).unwrap();
        assert_eq!(parts.list.len(), 2);
        assert!(near(parts.list[1].volume, x));
    }
}

#[test]
fn windings_do_not_change_what_is_closed() {
    let mut mesh = boxes(&[([0.0; 3], [1.0; 3]), ([2.0; 3], [3.0; 3])]);
    for t in [0, 3, 4, 8, 11, 13, 17] {
        mesh.triangles[t].swap(1, 2);
    }
    assert_eq!(counts(&mesh), [2, 2]);
    let mut mesh = layers(3);
    for t in [0, 3, 4, 8, 11, 13, 17] {
        mesh.triangles[t].swap(1, 2);
    }
    assert_eq!(counts(&mesh), [3, 1]);
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
fn a_shell_with_a_hole_is_a_part_and_a_sheet_beside_it_is_not() {
    let mut mesh = boxes(&[([0.0; 3], [1.0; 3]), ([3.0, 0.0, 0.0], [4.0, 1.0, 1.0])]);
    // The second box has no lid.
    mesh.triangles.drain(14..16);
    mesh.groups.clear();
    let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
    assert_eq!(chosen.bodies.len(), 2);
    assert!(parts.list[0].is_exact && !parts.list[1].is_exact);
    assert_eq!(parts.mesh(&mesh, &[1]).triangles.len(), 10);

    let sheet = InputMesh {
        positions: [[7.0, 0.0], [8.0, 0.0], [7.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.3))
            .to_vec(),
        triangles: vec![[0, 1, 2]],
        ..InputMesh::default()
    };
    let mesh = join(mesh, &sheet);
    let parts = Parts::of(&mesh).unwrap();
    assert_eq!((parts.list.len(), parts.loose_sheets), (2, 1));
    // Alone it is what the file has.
    let parts = Parts::of(&sheet).err();
    assert_eq!(parts, None);
}

#[test]
fn a_soup_of_sheets_that_enclose_a_body_together_is_one_part() {
    let mut mesh = boxes(&[([0.0; 3], [1.0; 3])]);
    // Every triangle has its own corners, a little apart.
    let corners: Vec<DVec3> = (mesh.triangles.iter().enumerate())
        .flat_map(|(t, triangle)| {
            let shift = DVec3::splat(1e-4 * (t as f64 - 6.0) / 6.0);
            triangle.map(|v| mesh.positions[v as usize] + shift)
        })
        .collect();
    mesh.positions = corners;
    mesh.triangles = (0..12).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    assert_eq!(counts(&mesh), [1, 1]);
    // A speck far from it is counted, one inside it belongs to it.
    let far = boxes(&[([3.0; 3], [3.05; 3])]);
    let (_, with_speck) = chosen(&join(mesh.clone(), &far), &PartChoice::Auto);
    assert_eq!((with_speck.bodies.len(), with_speck.dropped), (1, 1));
    let within = boxes(&[([0.4; 3], [0.5; 3])]);
    assert_eq!(counts(&join(mesh, &within)), [1, 1]);
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

#[test]
fn hostile_meshes_are_refused_or_divided_and_never_panic() {
    let mut state = 7_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as u32
    };
    for _ in 0..300 {
        let vertices = 4 + next() % 9;
        let mut mesh = InputMesh::default();
        for _ in 0..vertices {
            let mut at = || f64::from(next() % 4) * 0.5;
            mesh.positions.push(DVec3::new(at(), at(), at()));
        }
        for _ in 0..3 + next() % 40 {
            mesh.triangles.push([0; 3].map(|_| next() % vertices));
        }
        let Ok(parts) = Parts::of(&mesh) else {
            continue;
        };
        for choice in [
            PartChoice::Auto,
            PartChoice::Separate,
            PartChoice::Largest,
            PartChoice::Weld { gap: Some(9.0) },
        ] {
            let chosen = parts.choose(&mesh, &choice).unwrap();
            assert!(!chosen.bodies.is_empty());
            for body in &chosen.bodies {
                let own: &InputMesh = &parts.mesh(&mesh, &body.parts);
                assert!(!own.triangles.is_empty());
                let _: Option<Surface> = repair(own).ok().map(|(surface, _)| surface);
            }
        }
    }
}
