//! `frangible-lab sound`: struck and broken things, heard and drawn.

use std::error::Error;

use frangible_lab::sound::Heard;

use crate::args::PageArgs;
use crate::output::{Bar, Page};

/// The page, and the folder of its pictures.
const PAGE: &str = "sound.md";
const PICTURES: &str = "sound";

pub(crate) fn run(args: &PageArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.write.as_deref(), PAGE, PICTURES)?;
    let bar = Bar::new(args.json);
    let heard = Heard::compute(&mut |share| bar.show("simulating blows and sound", share))?;
    drop(bar);
    place.tell(heard.page(PICTURES)?, args.json)
}
