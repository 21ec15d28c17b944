//! `frangible verify near-field`: the stress and the force of a blow, in tables.

use std::error::Error;

use frangible_export::write_atomically;
use frangible_verify::near_field::NearField;
use serde_json::json;

use crate::args::VerifyArgs;
use crate::progress::Bar;
use crate::say::say;
use crate::verifying::make_folders;

/// The page, and the folder of its picture.
const PAGE: &str = "near-field.md";
const PICTURES: &str = "near-field";

pub(crate) fn run(args: &VerifyArgs) -> Result<(), Box<dyn Error>> {
    make_folders(args.write.as_deref(), PAGE, PICTURES)?;
    let bar = Bar::new(args.json);
    let found = NearField::compute(&mut |share| bar.show("hitting plates", share))?;
    drop(bar);
    let page = found.page(PICTURES)?;
    let mut files = Vec::new();
    if let Some(folder) = &args.write {
        let mut write = |name: String, bytes: &[u8]| -> Result<(), Box<dyn Error>> {
            let path = folder.join(name);
            write_atomically(&path, bytes)?;
            files.push(path.display().to_string());
            Ok(())
        };
        write(PAGE.into(), page.text.as_bytes())?;
        for (name, png) in &page.pictures {
            write(format!("{PICTURES}/{name}.png"), png)?;
        }
    }
    if args.json {
        return Ok(say(&format!(
            "{:#}\n",
            json!({ "page": page.text, "files": files })
        ))?);
    }
    let mut text = page.text;
    for file in files {
        text.push_str(&format!("wrote {file}\n"));
    }
    Ok(say(&text)?)
}
