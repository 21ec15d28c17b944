//! `frangible-lab sound`: struck and broken things, heard and drawn.

use std::error::Error;

use frangible_lab::sound::Heard;
use serde_json::json;

use crate::args::PageArgs;
use crate::output::{Bar, Page, say};

/// The page, and the folder of its pictures.
const PAGE: &str = "sound.md";
const PICTURES: &str = "sound";

pub(crate) fn run(args: &PageArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.write.as_deref(), PAGE, PICTURES)?;
    let bar = Bar::new(args.json);
    let heard = Heard::compute(&mut |share| bar.show("striking and listening", share))?;
    drop(bar);
    let page = heard.page(PICTURES)?;
    let pictures: Vec<(&str, Vec<u8>)> = (page.pictures.iter())
        .map(|(name, png)| (name.as_str(), png.clone()))
        .collect();
    let files = place.write(&page.text, &pictures)?;
    if args.json {
        let told = json!({ "page": page.text, "files": files });
        return Ok(say(&format!("{told:#}\n"))?);
    }
    let mut text = page.text;
    for file in files {
        text.push_str(&format!("wrote {file}\n"));
    }
    Ok(say(&text)?)
}
