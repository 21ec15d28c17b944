//! Bodies, and the effects of blows on them.
#![expect(unsafe_code, reason = "exported functions take pointers")]

use std::sync::{Mutex, MutexGuard, PoisonError};

use frangible::internals::BodyState;
use frangible::{Body, Contact, FractureConfig, Outcome, impact, would_break};

use crate::blow::Given;
use crate::breakable::BREAKABLES;
use crate::entry::{Failure, entry, frangible_status};
use crate::memory::{Place, bytes};
use crate::outcome::{Came, OUTCOMES};
use crate::registry::Registry;
use crate::types::{
    frangible_body, frangible_breakable, frangible_contact, frangible_outcome, frangible_pose,
    frangible_striker,
};

/// A body that calls of several threads may ask for.
pub(crate) struct Shared(Mutex<Body>);

pub(crate) static BODIES: Registry<Shared> = Registry::new("a body");

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Body> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A copy of the body as it is.
    pub(crate) fn snapshot(&self) -> Body {
        self.lock().clone()
    }
}

/// Keeps a body.
pub(crate) fn added(body: Body) -> frangible_body {
    let id = BODIES.add(Shared(Mutex::new(body)));
    frangible_body { id }
}

/// Makes a body of a kind. The seed selects its weak points; the same seed and blow give the same pieces, to the bit, on every machine. Free it with
/// `frangible_body_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_new(
    breakable: frangible_breakable,
    seed: u64,
    out: *mut frangible_body,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        out.write(added(kind.breakable.body(seed)));
        Ok(())
    })
}

/// Frees a body. A handle of zero is left alone.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_body_free(body: frangible_body) -> frangible_status {
    entry(|| BODIES.free(body.id))
}

/// Computes the outcome of a blow: all contacts that meet the body at one time. `strikers` are those that the contacts name by their index; it may be
/// null if all are pushes of a script. With a `pose`, which may be null, contacts and strikers are in world axes. If the body holds, it keeps the
/// cracks of the blow. The body itself stays as it is if it breaks: replace it by the fragments. Free the outcome with `frangible_outcome_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_impact(
    body: frangible_body,
    contacts: *const frangible_contact,
    contact_count: usize,
    strikers: *const frangible_striker,
    striker_count: usize,
    pose: *const frangible_pose,
    out: *mut frangible_outcome,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        let given = Given {
            contacts,
            contact_count,
            strikers,
            striker_count,
            pose,
        };
        // SAFETY: by the contract of the crate.
        let contacts = unsafe { given.read() }?;
        let shared = BODIES.get(body.id)?;
        let mut body = shared.lock();
        let outcome =
            impact(&body, &contacts, &FractureConfig::default()).map_err(Failure::input)?;
        let came = Came::new(&mut body, outcome)?;
        drop(body);
        let id = OUTCOMES.add(came);
        out.write(frangible_outcome { id });
        Ok(())
    })
}

/// Writes 1 if the blow would break the body, else 0. It computes no fragments and changes nothing. The arguments are those of
/// `frangible_body_impact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_would_break(
    body: frangible_body,
    contacts: *const frangible_contact,
    contact_count: usize,
    strikers: *const frangible_striker,
    striker_count: usize,
    pose: *const frangible_pose,
    out: *mut i32,
) -> frangible_status {
    let given = Given {
        contacts,
        contact_count,
        strikers,
        striker_count,
        pose,
    };
    let ask = |body: &Body, contacts: &[Contact]| {
        let breaks = would_break(body, contacts, &FractureConfig::default());
        breaks.map(i32::from).map_err(Failure::input)
    };
    // SAFETY: by the contract of the crate.
    entry(|| unsafe { asked(body, given, out, ask) })
}

/// Writes the strength over the largest stress at a weak point. Above 1 no crack starts; at or below 1 cracks start, which may or may not part the
/// body. Every weak point is computed, so it takes longer than `frangible_body_would_break`. It changes nothing. The arguments are those of
/// `frangible_body_impact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_margin(
    body: frangible_body,
    contacts: *const frangible_contact,
    contact_count: usize,
    strikers: *const frangible_striker,
    striker_count: usize,
    pose: *const frangible_pose,
    out: *mut f64,
) -> frangible_status {
    let given = Given {
        contacts,
        contact_count,
        strikers,
        striker_count,
        pose,
    };
    let ask = |body: &Body, contacts: &[Contact]| {
        let mut config = FractureConfig::default();
        config.culling = false;
        let outcome = impact(body, contacts, &config).map_err(Failure::input)?;
        Ok(match &outcome {
            Outcome::Held { margin, .. } => *margin,
            other => other.report().strength / other.report().stress_bound,
        })
    };
    // SAFETY: by the contract of the crate.
    entry(|| unsafe { asked(body, given, out, ask) })
}

/// Asks something of a body and a blow, and writes the answer.
///
/// # Safety
/// The contract of the crate, for `given` and `out`.
unsafe fn asked<T: Copy>(
    body: frangible_body,
    given: Given,
    out: *mut T,
    ask: impl FnOnce(&Body, &[Contact]) -> Result<T, Failure>,
) -> Result<(), Failure> {
    // SAFETY: by the caller.
    let out = unsafe { Place::new(out, "out") }?;
    // SAFETY: by the caller.
    let contacts = unsafe { given.read() }?;
    let answer = ask(&BODIES.get(body.id)?.lock(), &contacts)?;
    out.write(answer);
    Ok(())
}

/// Saves the state of a body, its cracks: all that a body is besides its kind and its seed. Writes the number of bytes to `length`, and the bytes to
/// `buffer`, which has room for `capacity`. Call it with a null `buffer` and a capacity of 0 to learn the length. Too little room is an error, and
/// nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_save(
    body: frangible_body,
    buffer: *mut u8,
    capacity: usize,
    length: *mut usize,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let length = unsafe { Place::new(length, "length") }?;
        // SAFETY: by the contract of the crate.
        let buffer = unsafe { Place::of(buffer, capacity, "buffer") }?;
        let state = BODIES.get(body.id)?.lock().state().to_bytes();
        if capacity > 0 && capacity < state.len() {
            return Err(Failure::range(format!(
                "`buffer` has room for {capacity} bytes, and the state has {}",
                state.len()
            )));
        }
        buffer.write_all(&state);
        length.write(state.len());
        Ok(())
    })
}

/// Restores a state that was saved of a body of the same kind and seed. A piece is restored by the blow that made it: its parent's kind, seed, state
/// and contacts make it again, to the bit; its own state comes on top.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_body_restore(
    body: frangible_body,
    bytes: *const u8,
    length: usize,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let bytes = unsafe { self::bytes(bytes, length) }?;
        let state = BodyState::from_bytes(bytes).map_err(Failure::input)?;
        let shared = BODIES.get(body.id)?;
        shared.lock().set_state(state).map_err(Failure::input)
    })
}
