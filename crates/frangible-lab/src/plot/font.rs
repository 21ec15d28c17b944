//! Letters of single strokes, as draughtsmen draw them.
//!
//! A stroke is a list of points, two digits (base 36) each: x and y in half units, capitals 12 half units high on the
//! base line y = 4, small letters 8 high, descenders down to 0. `~` makes a smooth curve of them that starts at the first
//! and ends at the last (quadratic B-spline), `@` a closed one.

/// Half units per height of a capital.
const CAPITAL: f64 = 12.0;
/// Y of the base line.
const BASE: f64 = 4.0;
/// Space between letters, half units.
const GAP: f64 = 4.0;
/// Width of a blank, half units.
const BLANK: f64 = 4.0;
/// Points of a curve per control point.
const SMOOTHNESS: usize = 6;

/// Letter that replaces an unknown one: an empty box.
const UNKNOWN: &str = "040g6g6404";

const LETTERS: &[(char, &str)] = &[
    ('A', "044g84 1777"),
    ('B', "040g ~0g7g7a0a ~0a8a8404"),
    ('C', "~8e8g0g048486"),
    ('D', "040g ~0g8g8404"),
    ('E', "84040g8g 0a6a"),
    ('F', "040g8g 0a6a"),
    ('G', "~8e8g0g04848a 8a5a"),
    ('H', "040g 848g 0a8a"),
    ('I', "040g"),
    ('J', "~6g6a640406"),
    ('K', "040g 8g08 3b84"),
    ('L', "0g0484"),
    ('M', "040g4a8g84"),
    ('N', "040g848g"),
    ('O', "@04848g0g"),
    ('P', "040g ~0g8g8909"),
    ('Q', "@04848g0g 5884"),
    ('R', "040g ~0g8g8909 4984"),
    ('S', "~8e8g0g0a8a840406"),
    ('T', "0g8g 4g44"),
    ('U', "~0g080484888g"),
    ('V', "0g448g"),
    ('W', "0g245e84ag"),
    ('X', "048g 0g84"),
    ('Y', "0g4a8g 4a44"),
    ('Z', "0g8g0484"),
    ('a', "@04646c0c 6c64"),
    ('b', "040g @04646c0c"),
    ('c', "~6a6c0c046466"),
    ('d', "@04646c0c 646g"),
    ('e', "0868 ~686c0c046465"),
    ('f', "~5g2g2c 2c24 0c5c"),
    ('g', "@04646c0c ~6c62600001"),
    ('h', "040g ~090c6c68 6864"),
    ('i', "040c 0f0g"),
    ('j', "~2c222000 2f2g"),
    ('k', "040g 6c08 2964"),
    ('l', "040g"),
    ('m', "040c ~090c5c58 5854 ~595caca8 a8a4"),
    ('n', "040c ~090c6c68 6864"),
    ('o', "@04646c0c"),
    ('p', "000c @04646c0c"),
    ('q', "@04646c0c 606c"),
    ('r', "040c ~090c4c"),
    ('s', "~5b5c0c0858540405"),
    ('t', "2g26 ~262454 0c5c"),
    ('u', "~0c08046467 6c64"),
    ('v', "0c346c"),
    ('w', "0c244a648c"),
    ('x', "046c 0c64"),
    ('y', "0c34 6c20"),
    ('z', "0c6c0464"),
    ('0', "@0464686c6g0g0c08"),
    ('1', "0d3g34"),
    ('2', "~0d0g6g6b04 0464"),
    ('3', "~0e0g6g6a2a ~2a6a640406"),
    ('4', "444g0878"),
    ('5', "6g0g0a ~0a2b6b640406"),
    ('6', "@04646b0b ~5g1g0b07"),
    ('7', "0g6g24"),
    ('8', "@04646a0a @0a6a6g0g"),
    ('9', "@0g6g6909 ~6d695414"),
    ('.', "0405"),
    (',', "1402"),
    (':', "0405 0a0b"),
    (';', "1402 1a1b"),
    ('!', "0405 080g"),
    ('?', "~0e0g6g6a3a38 3435"),
    ('-', "0959"),
    ('−', "0969"),
    ('+', "0969 363c"),
    ('=', "0767 0b6b"),
    ('×', "055a 0a55"),
    ('*', "055a 0a55 2c23"),
    ('/', "006g"),
    ('\\', "0g60"),
    ('|', "000g"),
    ('(', "~3g0d0532"),
    (')', "~0g3d3502"),
    ('[', "3g0g0232"),
    (']', "0g3g3202"),
    ('{', "~3g1g1a0a ~0a1a1434"),
    ('}', "~0g2g2a3a ~3a2a2404"),
    ('<', "6c0966"),
    ('>', "0c6906"),
    ('^', "0d3g6d"),
    ('%', "046g @0c2c2g0g @44646848"),
    ('_', "0363"),
    ('`', "0g1e"),
    ('\'', "0c0g"),
    ('"', "0c0g 2c2g"),
    ('#', "142g 445g 0868 0c6c"),
    ('$', "~8e8g0g0a8a840406 434h"),
    ('&', "~841c1g5g5c0a046488"),
    ('~', "~080b3b38686b"),
    ('@', "@04848g0g @36666c3c"),
    ('²', "~0e0g3g3e0b 0b3b"),
    ('³', "~0f0g3g3e1e ~1e3e3b0b0c"),
    ('°', "@0d3d3g0g"),
];

/// Strokes of a letter, in heights of a capital above the base line and from the letter's left.
pub(super) fn strokes(letter: char) -> Vec<Vec<[f64; 2]>> {
    outline(letter).split_whitespace().map(stroke).collect()
}

/// Advance of the pen after a letter, in heights of a capital.
pub(super) fn advance(letter: char) -> f64 {
    let right = strokes(letter)
        .iter()
        .flatten()
        .map(|p| p[0])
        .fold(f64::NEG_INFINITY, f64::max);
    let width = if right.is_finite() {
        right
    } else {
        BLANK / CAPITAL
    };
    width + GAP / CAPITAL
}

fn outline(letter: char) -> &'static str {
    if letter.is_whitespace() {
        return "";
    }
    let found = LETTERS.iter().find(|(name, _)| *name == letter);
    found.map_or(UNKNOWN, |(_, outline)| outline)
}

fn stroke(text: &str) -> Vec<[f64; 2]> {
    let digits: Vec<f64> = text
        .chars()
        .filter_map(|c| c.to_digit(36))
        .map(f64::from)
        .collect();
    let points: Vec<[f64; 2]> = digits
        .chunks_exact(2)
        .map(|pair| [pair[0] / CAPITAL, (pair[1] - BASE) / CAPITAL])
        .collect();
    match text.chars().next() {
        Some('~') => curve(&points, false),
        Some('@') => curve(&points, true),
        _ => points,
    }
}

/// Quadratic B-spline: parabolas from the middle of each edge of the control polygon to that of the next.
fn curve(points: &[[f64; 2]], closed: bool) -> Vec<[f64; 2]> {
    let n = points.len();
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let mut out = Vec::new();
    let bends = if closed { 0..n } else { 1..n.saturating_sub(1) };
    for i in bends {
        let (before, at, after) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        let start = if !closed && i == 1 {
            before
        } else {
            middle(before, at)
        };
        let end = if !closed && i + 2 == n {
            after
        } else {
            middle(at, after)
        };
        for k in 0..=SMOOTHNESS {
            let t = k as f64 / SMOOTHNESS as f64;
            let (a, b) = (1.0 - t, t);
            out.push([0, 1].map(|x| a * a * start[x] + 2.0 * a * b * at[x] + b * b * end[x]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{LETTERS, UNKNOWN, advance, outline, strokes};

    #[test]
    fn every_printable_ascii_letter_is_there_once() {
        for letter in '!'..='~' {
            assert_ne!(outline(letter), UNKNOWN, "{letter}");
            assert_eq!(
                LETTERS.iter().filter(|l| l.0 == letter).count(),
                1,
                "{letter}"
            );
        }
    }

    #[test]
    fn letters_stay_between_descender_and_ascender() {
        for (letter, outline) in LETTERS {
            for stroke in outline.split_whitespace() {
                let digits = stroke.trim_start_matches(['~', '@']);
                assert!(
                    digits.len() % 2 == 0 && digits.len() >= 4,
                    "{letter}: {stroke}"
                );
                assert!(digits.chars().all(|c| c.is_digit(36)), "{letter}: {stroke}");
            }
            for [x, y] in strokes(*letter).into_iter().flatten() {
                assert!(
                    (0.0..=1.0).contains(&x) && (-0.35..=1.1).contains(&y),
                    "{letter}"
                );
            }
            assert!(advance(*letter) > 0.3);
        }
    }
}
