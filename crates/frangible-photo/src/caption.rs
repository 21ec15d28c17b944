//! Lines of text on pictures.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

use crate::Picture;

/// Roboto, see `font/README.md`.
const FONT: &[u8] = include_bytes!("../font/Roboto-Latin.ttf");

/// Writes a line of text, its upper left corner at column `x` and row `y`; `height` is that of the line, pixels. Parts outside of the picture are
/// left out.
pub(crate) fn write(
    picture: &mut Picture,
    text: &str,
    [x, y]: [f32; 2],
    height: f32,
    color: [u8; 3],
) {
    static PARSED: OnceLock<FontRef<'_>> = OnceLock::new();
    let font = PARSED.get_or_init(|| FontRef::try_from_slice(FONT).expect("the font is built in"));
    let scaled = font.as_scaled(PxScale::from(height));
    let (mut pen, base) = (x, y + scaled.ascent());
    let mut before = None;
    for letter in text.chars() {
        let glyph = scaled.glyph_id(letter);
        pen += before.map_or(0.0, |before| scaled.kern(before, glyph));
        before = Some(glyph);
        let placed = glyph.with_scale_and_position(height, point(pen, base));
        pen += scaled.h_advance(glyph);
        let Some(outline) = font.outline_glyph(placed) else {
            continue;
        };
        let corner = outline.px_bounds().min;
        outline.draw(|column, row, covered| {
            let (at_x, at_y) = (corner.x + column as f32, corner.y + row as f32);
            if at_x < 0.0
                || at_y < 0.0
                || at_x >= picture.width() as f32
                || at_y >= picture.height() as f32
            {
                return;
            }
            let (at_x, at_y) = (at_x as u32, at_y as u32);
            let paper = picture.pixel(at_x, at_y);
            let share = covered.min(1.0);
            let ink = |channel: usize| {
                let [under, over] = [paper[channel], color[channel]].map(f32::from);
                (under + (over - under) * share + 0.5) as u8
            };
            picture.set_pixel(at_x, at_y, [ink(0), ink(1), ink(2)]);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns and rows that are inked.
    fn inked(text: &str) -> (Vec<u32>, Vec<u32>) {
        let mut picture = Picture::filled(200, 40, [255; 3]);
        write(&mut picture, text, [10.0, 5.0], 24.0, [0; 3]);
        let dark = |x, y| picture.pixel(x, y)[0] < 128;
        let columns = (0..200).filter(|&x| (0..40).any(|y| dark(x, y)));
        let rows = (0..40).filter(|&y| (0..200).any(|x| dark(x, y)));
        (columns.collect(), rows.collect())
    }

    #[test]
    fn a_line_stands_where_it_is_put_and_grows_to_the_right() {
        let (short, rows) = inked("seed");
        let (long, _) = inked("seed 3: 12 pieces");
        assert!(short[0] >= 10 && long[0] == short[0]);
        assert!(long[long.len() - 1] > short[short.len() - 1] + 60);
        assert!(rows[0] >= 5 && rows[rows.len() - 1] < 29, "{rows:?}");
    }

    #[test]
    fn letters_of_labels_are_in_the_font_and_the_edge_cuts_them_off() {
        for letter in "µ–é×°≥12 m/s".chars().filter(|letter| *letter != ' ') {
            assert!(!inked(&letter.to_string()).0.is_empty(), "{letter}");
            // A letter that is missing is drawn as the box that stands for all that are.
            assert_ne!(inked(&letter.to_string()), inked("\u{4e00}"), "{letter}");
        }
        let (columns, _) = inked("a line that is a good deal longer than its picture is wide");
        assert_eq!(columns[columns.len() - 1], 199);
    }
}
