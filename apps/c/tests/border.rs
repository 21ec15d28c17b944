//! What C can get wrong is a code and a text, and nothing is written.

use std::ptr::{null, null_mut};

use frangible_c::*;

use crate::{at_middle, ball, body, hit, pane, sound, text};

#[test]
fn a_freed_handle_is_told_for_ever() {
    let kind = pane();
    sound(frangible_breakable_free(kind));
    // Its number is not given again.
    let other = pane();
    let mut solid = frangible_solid::default();
    let status = unsafe { frangible_breakable_solid(kind, &mut solid) };
    assert_eq!(status, frangible_status::Handle);
    assert!(text().contains("freed"), "{}", text());
    assert_eq!(frangible_breakable_free(kind), frangible_status::Handle);
    // Zero is what free leaves alone, as C's does.
    sound(frangible_body_free(frangible_body::default()));
    sound(frangible_breakable_free(other));
}

#[test]
fn a_body_outlives_its_kind() {
    // `body` frees the kind.
    let body = body(1);
    let outcome = hit(body, &[at_middle(12.0)], &ball(12.0));
    sound(frangible_body_free(body));
    let mut mesh = frangible_geometry::default();
    sound(unsafe { frangible_outcome_geometry(outcome, 0, &mut mesh) });
    assert!(mesh.vertices > 0);
    sound(frangible_outcome_free(outcome));
}

#[test]
fn a_null_or_misaligned_pointer_is_told() {
    let status = unsafe { frangible_breakable_load(null(), null_mut()) };
    assert_eq!(status, frangible_status::Pointer);
    assert_eq!(text(), "the pointer `out` is null");
    let body = body(1);
    let mut there = [0_u64; 40];
    let askew = (&raw mut there).cast::<u8>().wrapping_add(1);
    let status =
        unsafe { frangible_body_margin(body, null(), 0, null(), 0, null(), askew.cast::<f64>()) };
    assert_eq!(status, frangible_status::Pointer);
    assert_eq!(there, [0; 40]);
    sound(frangible_body_free(body));
}

#[test]
fn a_struct_of_another_size_is_told_and_left_alone() {
    let kind = pane();
    let own = size_of::<frangible_solid>() as u32;
    for size in [0, 4, own - 1, own + 8, u32::MAX] {
        let mut solid = frangible_solid {
            size,
            mass: -1.0,
            ..Default::default()
        };
        let status = unsafe { frangible_breakable_solid(kind, &mut solid) };
        assert_eq!(status, frangible_status::Size, "{size}");
        assert!(text().contains(&size.to_string()), "{}", text());
        assert_eq!((solid.size, solid.mass), (size, -1.0));
    }
    sound(frangible_breakable_free(kind));
}

#[test]
fn an_invalid_number_is_named_with_its_contact() {
    let body = body(1);
    let mut contacts = [at_middle(12.0); 2];
    contacts[1].point[0] = f64::NAN;
    let (by, mut breaks) = (ball(12.0), 7);
    let status = unsafe {
        frangible_body_would_break(body, contacts.as_ptr(), 2, &by, 1, null(), &mut breaks)
    };
    assert_eq!((status, breaks), (frangible_status::Input, 7));
    assert!(
        text().starts_with("contacts[1]: a contact's point"),
        "{}",
        text()
    );
    contacts[1] = at_middle(12.0);
    contacts[1].striker = 1;
    let status = unsafe {
        frangible_body_would_break(body, contacts.as_ptr(), 2, &by, 1, null(), &mut breaks)
    };
    assert_eq!((status, breaks), (frangible_status::Range, 7));
    sound(frangible_body_free(body));
}

#[test]
fn bytes_that_are_no_baked_body_are_told() {
    let (bytes, mut kind) = ([7_u8; 100], frangible_breakable::default());
    let status = unsafe { frangible_breakable_from_bytes(bytes.as_ptr(), 100, &mut kind) };
    assert_eq!((status, kind.id), (frangible_status::File, 0));
}

#[test]
fn a_panic_ends_in_a_code_and_a_text() {
    assert_eq!(wild::panicking(), frangible_status::Internal);
    assert!(text().contains("on purpose"), "{}", text());
}
