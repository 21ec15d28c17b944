//! Shells that are bodies of their own, and shells that are one body together.

use frangible_mesh::glam::DVec3;
use frangible_mesh::{MeshSolid, PartChoice, Parts, repair};

use super::{ball, boxes, chosen, counts, inside_out, join, layers, near, volume};

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
