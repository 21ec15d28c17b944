//! Colours, texture coordinates, materials and names of the mesh that was baked.

use std::ffi::{CStr, c_char};

use super::*;

fn words(text: *const c_char) -> &'static str {
    unsafe { CStr::from_ptr(text) }.to_str().expect("UTF-8")
}

fn list<T>(first: *const T, count: usize) -> &'static [T] {
    assert!(!first.is_null());
    unsafe { std::slice::from_raw_parts(first, count) }
}

/// Everything is linear in the place: colours are (x, y, z) over the sides of the tile, its second texture coordinates (2 y, z).
fn check(mesh: &frangible_geometry, centre: [f64; 3]) {
    let sides = [0.1, 0.1, 0.006];
    assert_eq!((mesh.more_uv_sets, mesh.groups_count > 0), (1, true));
    let positions = list(mesh.positions, 3 * mesh.vertices).as_chunks::<3>().0;
    let colors = list(mesh.colors, 4 * mesh.vertices).as_chunks::<4>().0;
    let more = list(mesh.more_uvs, 2 * mesh.vertices).as_chunks::<2>().0;
    let indices = list(mesh.indices, mesh.indices_count);
    let mut next = 0;
    for group in list(mesh.groups, mesh.groups_count) {
        assert_eq!(group.first, next);
        next += group.count;
        for &v in &indices[group.first..next] {
            let v = v as usize;
            let place =
                [0, 1, 2].map(|k| (f64::from(positions[v][k]) + centre[k]) / sides[k] + 0.5);
            let [red, green, blue, opacity] = colors[v].map(f64::from);
            for (k, color) in [red, green, blue].into_iter().enumerate() {
                assert!((color - place[k]).abs() < 0.02, "{color} at {place:?}");
            }
            let [s, t] = more[v].map(f64::from);
            assert!((s - 2.0 * place[1]).abs() < 0.04 && (t - place[2]).abs() < 0.02);
            assert_eq!(opacity, 1.0);
            // The glaze is the front.
            assert!(group.look == 1 || place[2] > 0.99, "{place:?}");
        }
    }
    assert_eq!(next, mesh.outer_indices);
    for &v in &indices[next..] {
        let v = v as usize;
        assert_eq!((colors[v], more[v]), ([1.0; 4], [0.0; 2]));
    }
}

#[test]
fn a_body_and_its_fragments_have_the_looks_of_their_mesh() {
    let kind = kind(TILE);
    let mut looks = frangible_looks::default();
    sound(unsafe { frangible_breakable_looks(kind, &mut looks) });
    assert_eq!((looks.looks, looks.images), (2, 1));
    assert_eq!(words(looks.name), "painted tile");
    let mut glaze = frangible_look::default();
    sound(unsafe { frangible_breakable_look(kind, 0, &mut glaze) });
    assert_eq!((words(glaze.name), glaze.double_sided), ("glaze", 1));
    assert_eq!(glaze.emission, [0.5, 0.25, 0.0]);
    assert_eq!(glaze.base_color, [0.2, 0.4, 0.6, 1.0]);
    assert_eq!((glaze.metallic, glaze.roughness), (0.25, 0.5));
    assert_eq!(
        (glaze.blending, glaze.alpha_cutoff, glaze.textures),
        (FRANGIBLE_BLENDING_MASK, 0.75, 1)
    );
    let mut texture = frangible_texture::default();
    sound(unsafe { frangible_breakable_texture(kind, 0, 0, &mut texture) });
    assert_eq!(
        (texture.slot, texture.image, texture.uv_set),
        (FRANGIBLE_TEXTURE_BASE_COLOR, 0, 1)
    );
    assert_eq!(texture.wrap, [FRANGIBLE_WRAP_CLAMP, FRANGIBLE_WRAP_MIRROR]);
    let mut image = frangible_image::default();
    sound(unsafe { frangible_breakable_image(kind, 0, &mut image) });
    assert_eq!(
        (words(image.name), image.kind),
        ("glaze.png", FRANGIBLE_IMAGE_PNG)
    );
    assert!(list(image.bytes, image.length).starts_with(b"\x89PNG"));

    let mut mesh = frangible_geometry::default();
    sound(unsafe { frangible_breakable_geometry(kind, &mut mesh) });
    check(&mesh, [0.0; 3]);
    assert_eq!(mesh.outer_indices, mesh.indices_count);
    let body = body_of(kind, 3);
    let outcome = hit(body, &[at_middle(25.0)], &ball(25.0));
    let fragments = report(outcome).fragments;
    assert!(fragments > 1, "{}", text());
    for k in 0..fragments {
        let mut solid = frangible_solid::default();
        sound(unsafe { frangible_outcome_solid(outcome, k, &mut solid) });
        let mut mesh = frangible_geometry::default();
        sound(unsafe { frangible_outcome_geometry(outcome, k, &mut mesh) });
        check(&mesh, solid.centre);
    }
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn a_body_without_a_mesh_has_no_looks_and_numbers_out_of_range_are_told() {
    let plain = pane();
    let (mut looks, mut look) = (frangible_looks::default(), frangible_look::default());
    sound(unsafe { frangible_breakable_looks(plain, &mut looks) });
    assert_eq!((looks.looks, looks.images, words(looks.name)), (0, 0, ""));
    let status = unsafe { frangible_breakable_look(plain, 0, &mut look) };
    assert_eq!(status, frangible_status::Range);
    assert!(text().contains("there is no look 0"), "{}", text());
    let mut mesh = frangible_geometry::default();
    sound(unsafe { frangible_breakable_geometry(plain, &mut mesh) });
    assert!(mesh.colors.is_null() && mesh.more_uvs.is_null() && mesh.groups.is_null());
    sound(frangible_breakable_free(plain));
    let painted = kind(TILE);
    let mut texture = frangible_texture::default();
    let status = unsafe { frangible_breakable_texture(painted, 1, 0, &mut texture) };
    assert_eq!(status, frangible_status::Range);
    let mut image = frangible_image::default();
    let status = unsafe { frangible_breakable_image(painted, 1, &mut image) };
    assert_eq!(status, frangible_status::Range);
    sound(frangible_breakable_free(painted));
}
