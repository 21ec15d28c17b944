//! Kinds of bodies.
#![expect(unsafe_code, reason = "exported functions take pointers")]

use std::ffi::{CString, c_char};

use frangible::{Asset, Breakable};

use crate::arrays::{Arrays, Whose, solid};
use crate::entry::{Failure, entry, frangible_status};
use crate::looks::Names;
use crate::memory::{Form, Place, bytes, text};
use crate::registry::Registry;
use crate::types::{
    frangible_about, frangible_breakable, frangible_geometry, frangible_hulls, frangible_solid,
};

/// A kind, and what C may ask of it.
pub(crate) struct Kind {
    pub(crate) breakable: Breakable,
    name: CString,
    material: CString,
    pub(crate) names: Names,
    arrays: Arrays,
}

/// A text as C has it.
pub(crate) fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

pub(crate) static BREAKABLES: Registry<Kind> = Registry::new("a breakable");

impl Kind {
    fn new(breakable: Breakable) -> Self {
        let asset = breakable.asset();
        let (name, material) = (c_text(asset.name()), c_text(&asset.material().name));
        Self {
            name,
            material,
            names: Names::of(asset),
            arrays: Arrays::default(),
            breakable,
        }
    }
}

fn made(asset: Asset) -> Result<frangible_breakable, Failure> {
    let breakable = Breakable::new(asset).map_err(Failure::input)?;
    let id = BREAKABLES.add(Kind::new(breakable));
    Ok(frangible_breakable { id })
}

/// Makes a kind from the bytes of a `.frangible` file. The bytes are copied. Free it with `frangible_breakable_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_from_bytes(
    bytes: *const u8,
    length: usize,
    out: *mut frangible_breakable,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        // SAFETY: by the contract of the crate.
        let bytes = unsafe { self::bytes(bytes, length) }?;
        let asset =
            Asset::from_bytes(bytes).map_err(|e| Failure::of(frangible_status::File)(&e))?;
        out.write(made(asset)?);
        Ok(())
    })
}

/// Makes a kind from a `.frangible` file. `path` is UTF-8. Free it with `frangible_breakable_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_load(
    path: *const c_char,
    out: *mut frangible_breakable,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        // SAFETY: by the contract of the crate.
        let path = unsafe { text(path, "path") }?;
        let asset = Asset::load(path).map_err(|e| Failure::of(frangible_status::File)(&e))?;
        out.write(made(asset)?);
        Ok(())
    })
}

/// Makes a kind that is `factor` times as large in every direction. Scale the kind that was loaded, not one that was scaled: roundings add up. Free
/// it with `frangible_breakable_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_scaled(
    breakable: frangible_breakable,
    factor: f64,
    out: *mut frangible_breakable,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let scaled = kind.breakable.scaled(factor).map_err(Failure::input)?;
        let id = BREAKABLES.add(Kind::new(scaled));
        out.write(frangible_breakable { id });
        Ok(())
    })
}

/// Frees a kind. Its bodies stay; the arrays and texts that the kind gave are gone. A handle of zero is left alone.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_breakable_free(breakable: frangible_breakable) -> frangible_status {
    entry(|| BREAKABLES.free(breakable.id))
}

/// Tells what a kind is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_about(
    breakable: frangible_breakable,
    out: *mut frangible_about,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let asset = kind.breakable.asset();
        out.fill(&frangible_about {
            supported: asset.is_supported().into(),
            name: kind.name.as_ptr(),
            material: kind.material.as_ptr(),
            strength: asset.material().strength,
            friction: asset.material().friction,
            restitution: asset.material().restitution,
            ..Default::default()
        });
        Ok(())
    })
}

/// Gives the masses of a kind. Its centre of mass is the origin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_solid(
    breakable: frangible_breakable,
    out: *mut frangible_solid,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let asset = kind.breakable.asset();
        out.fill(&solid(&asset.mass(), asset.is_supported()));
        Ok(())
    })
}

/// Gives the mesh of a kind, to draw. Texture coordinates are those of the mesh that was baked, if it has any, else a box projection in metres.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_geometry(
    breakable: frangible_breakable,
    out: *mut frangible_geometry,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        out.fill(&kind.arrays.geometry(Whose::Body(kind.breakable.asset())));
        Ok(())
    })
}

/// Gives the convex parts of a kind, for colliders.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_hulls(
    breakable: frangible_breakable,
    out: *mut frangible_hulls,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        out.fill(&kind.arrays.hulls(Whose::Body(kind.breakable.asset())));
        Ok(())
    })
}
