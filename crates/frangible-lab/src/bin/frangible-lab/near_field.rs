//! `frangible-lab near-field`: the stress and the force of a blow, in tables.

use std::error::Error;

use frangible_lab::verify::near_field::NearField;

use crate::args::PageArgs;
use crate::output::{Bar, Page};

/// The page, and the folder of its picture.
const PAGE: &str = "near-field.md";
const PICTURES: &str = "near-field";

pub(crate) fn run(args: &PageArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.write.as_deref(), PAGE, PICTURES)?;
    let bar = Bar::new(args.json);
    let found = NearField::compute(&mut |share| bar.show("hitting plates", share))?;
    drop(bar);
    place.tell(found.page(PICTURES)?, args.json)
}
