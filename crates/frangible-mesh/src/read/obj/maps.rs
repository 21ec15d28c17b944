//! Textures of material libraries: a file name behind options.

use crate::read::text::{lower, number};
use crate::{Placement, Texture, TextureSlot, Wrap};

/// A texture as a material library names it.
#[derive(Clone)]
pub(super) struct Map {
    pub(super) file: String,
    offset: [f32; 2],
    scale: [f32; 2],
    is_clamped: bool,
    strength: f32,
}

impl Map {
    pub(super) fn texture(&self, slot: TextureSlot, image: u32) -> Texture {
        let ([u, v], [along, across]) = (self.offset, self.scale);
        Texture {
            wrap: [if self.is_clamped {
                Wrap::Clamp
            } else {
                Wrap::Repeat
            }; 2],
            strength: self.strength,
            placement: Placement {
                // In the file v runs up, in a mesh down: v' = s v + o becomes 1 − v' = s (1 − v) + 1 − s − o.
                offset: [u, 1.0 - across - v],
                rotation: 0.0,
                scale: [along, across],
            },
            ..Texture::of(slot, image)
        }
    }
}

/// Reads what stands behind the keyword; `None` without a file name.
pub(super) fn map(text: &[u8]) -> Option<Map> {
    let mut map = Map {
        file: String::new(),
        offset: [0.0; 2],
        scale: [1.0; 2],
        is_clamped: false,
        strength: 1.0,
    };
    let mut rest = text.trim_ascii();
    while rest.starts_with(b"-") {
        let option = next_word(&mut rest);
        let most = match &*lower(option) {
            b"-o" | b"-s" | b"-t" => 3,
            b"-mm" => 2,
            _ => 1,
        };
        let (mut values, mut word) = (Vec::new(), &b""[..]);
        for k in 0..most {
            let mut after = rest;
            let next = next_word(&mut after);
            let value = number(next).filter(|x| x.is_finite());
            // One value is there whatever it is; more only if they are numbers.
            if k > 0 && value.is_none() {
                break;
            }
            (rest, word) = (after, next);
            values.extend(value.map(|x| x as f32));
        }
        let pair = |other: [f32; 2]| [0, 1].map(|k| values.get(k).copied().unwrap_or(other[k]));
        match &*lower(option) {
            b"-o" => map.offset = pair(map.offset),
            b"-s" => map.scale = pair(map.scale),
            b"-bm" => map.strength = values.first().copied().unwrap_or(1.0),
            b"-clamp" => map.is_clamped = word.eq_ignore_ascii_case(b"on"),
            _ => {}
        }
    }
    // Programs on Windows write backslashes.
    map.file = String::from_utf8_lossy(rest).replace('\\', "/");
    (!map.file.is_empty()).then_some(map)
}

/// Takes a word from the front.
fn next_word<'a>(rest: &mut &'a [u8]) -> &'a [u8] {
    let text = rest.trim_ascii_start();
    let end = text
        .iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(text.len());
    let (word, after) = text.split_at(end);
    *rest = after.trim_ascii_start();
    word
}
