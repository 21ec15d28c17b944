//! Films among the commands: a file, and behind it the options that differ from the default.

use super::words::{file, number, one_of, whole};
use crate::command::{Command, FilmKind, FilmOptions};

pub(super) const FILMS: [(&str, FilmKind); 4] = [
    ("still", FilmKind::Still),
    ("gif", FilmKind::Gif),
    ("frames", FilmKind::Frames),
    ("mp4", FilmKind::Mp4),
];

/// A film: its file, and behind that the options that differ from the default: `3s`, `20fps`, `640x400`, `64spp`.
pub(super) fn film(kind: &str, tail: &str) -> Result<Command, String> {
    let mut options = FilmOptions::default();
    let mut rest = file(tail).to_string_lossy().into_owned();
    while let Some((before, last)) = rest.rsplit_once(char::is_whitespace) {
        if !option(last, &mut options) {
            break;
        }
        rest = before.trim_end().into();
    }
    if rest.is_empty() || option(&rest, &mut options.clone()) {
        return Err(format!(
            "write it as `save {kind} FILE`, followed by any of 3s 20fps 640x400 64spp"
        ));
    }
    // A word that is none would hide the options before it in the name of the file.
    let mut words = rest.split_whitespace();
    let hidden = words.any(|word| option(word, &mut options.clone()));
    if let (true, Some(last)) = (hidden, rest.split_whitespace().next_back()) {
        return Err(format!(
            "`{last}` after the file is none of 3s 20fps 640x400 64spp"
        ));
    }
    Ok(Command::Film(one_of(kind, &FILMS)?, rest.into(), options))
}

/// Returns true if a word is an option, and stores its value.
fn option(word: &str, options: &mut FilmOptions) -> bool {
    let taken = |unit: &str| word.strip_suffix(unit);
    if let Some(Ok(rate)) = taken("fps").map(number) {
        options.rate = rate;
    } else if let Some(Ok(samples)) = taken("spp").map(whole) {
        options.samples = samples;
    } else if let Some(Ok(seconds)) = taken("s").map(number) {
        options.seconds = seconds;
    } else if let Some((Ok(width), Ok(height))) =
        word.split_once('x').map(|(w, h)| (whole(w), whole(h)))
    {
        options.size = [width, height];
    } else {
        return false;
    }
    true
}

/// Options that differ from the default, in the form that [`film`] reads.
pub(super) fn write_film(options: &FilmOptions) -> String {
    let usual = FilmOptions::default();
    let mut text = String::new();
    if options.seconds != usual.seconds {
        text += &format!(" {}s", options.seconds);
    }
    if options.rate != usual.rate {
        text += &format!(" {}fps", options.rate);
    }
    if options.size != usual.size {
        text += &format!(" {}x{}", options.size[0], options.size[1]);
    }
    if options.samples != usual.samples {
        text += &format!(" {}spp", options.samples);
    }
    text
}
