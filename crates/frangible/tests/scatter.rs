//! The scatter of strength, which a kind has unless it is asked for without.

use crate::bodies::pane;
use frangible::Breakable;
use frangible::internals::{Factors, Fields};

/// Smallest and largest strength of the weak points of a body, over that of its material.
fn strengths(kind: &Breakable) -> [f32; 2] {
    let body = kind.body(1);
    let strength = kind.asset().material().strength as f32;
    let all = body
        .weak_tets()
        .iter()
        .map(|&e| body.strength(e) / strength);
    all.fold([f32::INFINITY, 0.0], |[least, most], s| {
        [least.min(s), most.max(s)]
    })
}

#[test]
fn strength_scatters_as_that_of_the_material_unless_it_is_asked_to_be_uniform() {
    let asset = pane().asset();
    let usual = Breakable::new(asset.clone()).unwrap();
    assert_eq!(usual.fields(), &Fields::of_material(asset.material()));
    let [least, most] = strengths(&usual);
    assert!(most > 2.0 * least, "{least} to {most}");
    let uniform = Breakable::uniform(asset.clone()).unwrap();
    assert_eq!(uniform.fields(), &Fields::default());
    assert_eq!(strengths(&uniform), [1.0, 1.0]);
    // A pattern on the body leaves its scatter, and a material without a preset has none.
    let halves = Fields::from_function(asset, |_| Factors::of_strength(0.5));
    let [weakest, strongest] = strengths(&usual.with_fields(halves).unwrap());
    assert_eq!([weakest, strongest], [0.5 * least, 0.5 * most]);
    let mut own = (**asset).clone();
    own.parts_mut().material.name = "ice of a lake".into();
    assert_eq!(strengths(&Breakable::new(own).unwrap()), [1.0, 1.0]);
}
