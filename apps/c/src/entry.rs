//! The frame of every exported function: it catches panics, and turns failures into a code and a text.
#![expect(unsafe_code, reason = "an exported name is an unsafe attribute")]
#![expect(
    non_camel_case_types,
    reason = "the name is that of the C header, which is made from it"
)]

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Status of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum frangible_status {
    /// It succeeded.
    Ok = 0,
    /// A pointer is null or misaligned.
    Pointer = 1,
    /// A handle is zero, was freed, or is not one of this library.
    Handle = 2,
    /// The `size` of a struct is not one that this version knows.
    Size = 3,
    /// A number, a name or an array is invalid.
    Input = 4,
    /// An index or a count does not fit.
    Range = 5,
    /// A file cannot be read, or the bytes are not a baked body of this version.
    File = 6,
    /// A fragment is too small for vibration modes, so it cannot break again.
    TooSmall = 7,
    /// An error of the library itself. Please report it with the text.
    Internal = 8,
}

/// A call that fails: its code, and what is wrong and how to mend it.
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) frangible_status, pub(crate) String);

impl Failure {
    /// A failure with the text of an error.
    pub(crate) fn of(status: frangible_status) -> impl Fn(&dyn Display) -> Self {
        move |error| Self(status, error.to_string())
    }

    /// An invalid number, name or array.
    pub(crate) fn input(error: impl Display) -> Self {
        Self(frangible_status::Input, error.to_string())
    }

    /// An index or a count that does not fit.
    pub(crate) fn range(text: String) -> Self {
        Self(frangible_status::Range, text)
    }
}

thread_local! {
    static TEXT: RefCell<CString> = RefCell::default();
}

/// Runs the work of an exported function. No panic leaves it.
pub(crate) fn entry(work: impl FnOnce() -> Result<(), Failure>) -> frangible_status {
    // A panic leaves sound data behind: handles are behind a lock, and the core takes bodies by shared reference.
    let Failure(status, text) = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => return frangible_status::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => {
            let said = panic.downcast_ref::<&str>().copied();
            let said = said.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            let text = format!(
                "an error of the library: {}; please report it",
                said.unwrap_or("a panic without a text")
            );
            // A payload may panic when it is dropped.
            std::mem::forget(panic);
            Failure(frangible_status::Internal, text)
        }
    };
    let text = CString::new(text.replace('\0', " ")).unwrap_or_default();
    // It is gone while its thread ends, and then nobody asks for it.
    let _ = TEXT.try_with(|kept| kept.replace(text));
    status
}

/// Returns what was wrong in the last call of this thread that failed, and how to mend it, as UTF-8; an empty text if none failed. The text belongs
/// to the library. It is valid until the next call of this thread that fails, and until the thread ends.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_error_text() -> *const c_char {
    TEXT.try_with(|kept| kept.borrow().as_ptr())
        .unwrap_or(c"".as_ptr())
}
