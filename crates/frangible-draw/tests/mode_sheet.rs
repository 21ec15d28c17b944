//! Sheets of shapes coloured by numbers.

use frangible_draw::frangible_photo::PhotoError;
use frangible_draw::{DrawError, ModeCell, ModeSheetOptions, has_adapter, mode_sheet};
use frangible_recording::glam::Vec3;

/// A square that faces the camera, of one value.
fn square(value: f32) -> ModeCell {
    let corner = |x, y| Vec3::new(x, y, 0.0);
    ModeCell {
        positions: vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        values: vec![value; 4],
        ..ModeCell::default()
    }
}

#[test]
fn what_does_not_fit_together_is_refused_by_its_number() {
    let refused = |cell: ModeCell| {
        let cells = [square(0.5), cell];
        let error = mode_sheet(&cells, &ModeSheetOptions::default()).unwrap_err();
        assert!(matches!(error, DrawError::BadField { number: 2, .. }));
        error.to_string()
    };
    let mut cell = square(0.0);
    cell.positions[1].x = f32::NAN;
    assert!(refused(cell).contains("shape 2 of the sheet"));
    assert!(refused(square(f32::INFINITY)).contains("value"));
    let mut cell = square(0.0);
    cell.triangles[0][0] = 4;
    assert!(refused(cell).contains("does not exist"));
    let mut cell = square(0.0);
    cell.values.pop();
    assert!(refused(cell).contains("one value per vertex"));
    assert!(refused(ModeCell::default()).contains("no triangle"));
    let empty = mode_sheet(&[], &ModeSheetOptions::default());
    assert!(matches!(
        empty,
        Err(DrawError::Photo(PhotoError::EmptySheet))
    ));
}

#[test]
fn bodies_fill_their_cells_and_have_the_colours_of_their_values() {
    if !has_adapter() {
        println!("skipped: {}", DrawError::NoAdapter);
        return;
    }
    let options = ModeSheetOptions {
        look_from: Vec3::Z,
        ..ModeSheetOptions::default()
    };
    let sheet = mode_sheet(&[square(0.0), square(1.0)], &options).unwrap();
    assert_eq!(sheet.width(), 2 * 340 + 4);
    // Below the text, above the margin.
    let (middle, top, bottom) = (170, 75, 255);
    for (left, violet) in [(0, true), (344, false)] {
        for y in [top, (top + bottom) / 2, bottom] {
            let [red, green, blue] = sheet.pixel(left + middle, y).map(i32::from);
            if violet {
                assert!(blue > green + 40, "{red} {green} {blue} at {y}");
            } else {
                assert!(red > blue + 80 && green > blue + 80, "{red} {green} {blue}");
            }
        }
        let corner = sheet.pixel(left + 4, 200);
        assert!(
            corner[0].abs_diff(corner[2]) < 8,
            "{corner:?} is no backdrop"
        );
    }
}
