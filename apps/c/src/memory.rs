//! Reading and writing through the pointers of a caller. Nothing else in the crate dereferences one.
#![expect(unsafe_code, reason = "C hands over pointers")]

use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;

use crate::entry::{Failure, frangible_status};

/// Most elements of an array that a caller may give: more contacts than any engine reports of one body.
const MOST: usize = 1 << 16;

/// A struct of the header that begins with its size.
///
/// # Safety
/// The type is `repr(C)`, all its bits may be zero or anything else, and its first field is a `u32`, which is the size in bytes that the program's
/// header has for it.
pub(crate) unsafe trait Sized32: Copy {
    /// Its name in C.
    const NAME: &'static str;
    /// Its size in the first version of the header that has it.
    const FIRST: usize;
}

fn check<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    let wrong = |text: String| Failure(frangible_status::Pointer, text);
    if pointer.is_null() {
        return Err(wrong(format!("the pointer `{name}` is null")));
    }
    if !pointer.is_aligned() {
        let alignment = align_of::<T>();
        return Err(wrong(format!(
            "the pointer `{name}` is misaligned; its address must be a multiple of {alignment}"
        )));
    }
    Ok(())
}

/// Bytes of a struct that the caller has.
///
/// # Safety
/// `pointer` is null, or points to a struct whose first four bytes can be read.
unsafe fn size_of_given<T: Sized32>(pointer: *const T, name: &str) -> Result<usize, Failure> {
    check(pointer, name)?;
    // SAFETY: it is aligned, not null, and the caller says that these bytes can be read.
    let size = unsafe { pointer.cast::<u32>().read() } as usize;
    if (T::FIRST..=size_of::<T>()).contains(&size) {
        return Ok(size);
    }
    let (own, kind) = (size_of::<T>(), T::NAME);
    let text = match size {
        _ if size > own => format!(
            "`{name}.size` is {size}, and this library knows {own} bytes of a {kind}; use the library of your header's version"
        ),
        _ => format!("`{name}.size` is {size}; set it to sizeof({kind}), which is {own}"),
    };
    Err(Failure(frangible_status::Size, text))
}

/// Copies a struct of so many bytes; what a shorter one lacks is zero.
///
/// # Safety
/// `from` points to `size` bytes that can be read, no more than `T` has.
unsafe fn copied<T: Sized32>(from: *const u8, size: usize) -> T {
    let mut value = MaybeUninit::<T>::zeroed();
    // SAFETY: `value` has at least `size` bytes, and so has what `from` points to.
    unsafe { from.copy_to_nonoverlapping(value.as_mut_ptr().cast::<u8>(), size) };
    // SAFETY: every bit is set, and the trait says that all bits are sound.
    unsafe { value.assume_init() }
}

/// Reads a struct.
///
/// # Safety
/// `pointer` is null, or points to as many bytes as its first field says.
pub(crate) unsafe fn read<T: Sized32>(pointer: *const T, name: &str) -> Result<T, Failure> {
    // SAFETY: by the caller.
    let size = unsafe { size_of_given(pointer, name) }?;
    // SAFETY: `size` bytes can be read, and `T` has as many.
    Ok(unsafe { copied(pointer.cast(), size) })
}

/// Reads an array of structs, which all have the same size.
///
/// # Safety
/// `pointer` is null, or points to `count` structs of as many bytes as the first field of the first one says.
pub(crate) unsafe fn read_all<T: Sized32>(
    pointer: *const T,
    count: usize,
    name: &str,
) -> Result<Vec<T>, Failure> {
    check_count(count, name)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    // SAFETY: by the caller.
    let size = unsafe { size_of_given(pointer, name) }?;
    let mut all = Vec::with_capacity(count);
    for number in 0..count {
        // The stride is that of the program's header.
        let place = pointer.cast::<u8>().wrapping_add(number * size);
        // SAFETY: the caller says that there are `count` of them.
        let own = unsafe { place.cast::<u32>().read_unaligned() } as usize;
        if own != size {
            let text = format!(
                "`{name}[{number}].size` is {own}, and that of `{name}[0]` is {size}; set it in every element"
            );
            return Err(Failure(frangible_status::Size, text));
        }
        // SAFETY: as above.
        all.push(unsafe { copied(place, size) });
    }
    Ok(all)
}

fn check_count(count: usize, name: &str) -> Result<(), Failure> {
    if count <= MOST {
        return Ok(());
    }
    Err(Failure::range(format!(
        "`{name}` has {count} elements; the most are {MOST}"
    )))
}

/// Reads a value of plain numbers.
///
/// # Safety
/// `pointer` is null, or points to a `T`, of which any bits are sound.
pub(crate) unsafe fn read_plain<T: Copy>(pointer: *const T, name: &str) -> Result<T, Failure> {
    check(pointer, name)?;
    // SAFETY: it is aligned, not null, and the caller says that it can be read.
    Ok(unsafe { pointer.read() })
}

/// The bytes of an array. Null is the empty one.
///
/// # Safety
/// `pointer` is null, or points to `length` bytes that nobody changes while the slice lives.
pub(crate) unsafe fn bytes<'a>(pointer: *const u8, length: usize) -> Result<&'a [u8], Failure> {
    if length == 0 {
        return Ok(&[]);
    }
    check(pointer, "bytes")?;
    if isize::try_from(length).is_err() {
        return Err(Failure::range(format!(
            "{length} bytes are more than memory can hold"
        )));
    }
    // SAFETY: it is not null, its length fits, and the caller says that it can be read.
    Ok(unsafe { std::slice::from_raw_parts(pointer, length) })
}

/// A text that ends with a zero.
///
/// # Safety
/// `pointer` is null, or points to such a text, which nobody changes while the result lives.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, Failure> {
    check(pointer, name)?;
    // SAFETY: by the caller.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str()
        .map_err(|_| Failure::input(format!("the text `{name}` is not UTF-8")))
}

/// A place of the caller's to write to, once all else has succeeded.
pub(crate) struct Place<T> {
    pointer: *mut T,
    count: usize,
}

impl<T: Copy> Place<T> {
    /// A place for one value.
    ///
    /// # Safety
    /// `pointer` is null, or points to memory for a `T` that can be written until the place is used.
    pub(crate) unsafe fn new(pointer: *mut T, name: &str) -> Result<Self, Failure> {
        check(pointer.cast_const(), name)?;
        Ok(Self { pointer, count: 1 })
    }

    /// A place for several, or for none.
    ///
    /// # Safety
    /// `pointer` is null, or points to memory for `count` of `T`.
    pub(crate) unsafe fn of(pointer: *mut T, count: usize, name: &str) -> Result<Self, Failure> {
        if count > 0 {
            check(pointer.cast_const(), name)?;
        }
        Ok(Self { pointer, count })
    }

    /// A place for several that may be missing: null is none.
    ///
    /// # Safety
    /// The same as for [`Place::of`].
    pub(crate) unsafe fn optional(
        pointer: *mut T,
        count: usize,
        name: &str,
    ) -> Result<Option<Self>, Failure> {
        if pointer.is_null() {
            return Ok(None);
        }
        // SAFETY: by the caller.
        unsafe { Self::of(pointer, count, name) }.map(Some)
    }

    /// Writes one value.
    pub(crate) fn write(self, value: T) {
        self.write_all(&[value]);
    }

    /// Writes as many values as there is room for.
    pub(crate) fn write_all(self, values: &[T]) {
        let count = values.len().min(self.count);
        // SAFETY: whoever made the place says that `count` values have room.
        unsafe {
            self.pointer
                .copy_from_nonoverlapping(values.as_ptr(), count);
        }
    }
}

/// A struct of the caller's to fill, once all else has succeeded.
pub(crate) struct Form<T> {
    pointer: *mut T,
    size: usize,
}

impl<T: Sized32> Form<T> {
    /// Checks the struct's size.
    ///
    /// # Safety
    /// `pointer` is null, or points to as many bytes as its first field says, which can be written until the form is filled.
    pub(crate) unsafe fn new(pointer: *mut T, name: &str) -> Result<Self, Failure> {
        // SAFETY: by the caller.
        let size = unsafe { size_of_given(pointer.cast_const(), name) }?;
        Ok(Self { pointer, size })
    }

    /// Fills all of it but its size.
    pub(crate) fn fill(self, value: &T) {
        let from = std::ptr::from_ref(value).cast::<u8>();
        let (head, to) = (size_of::<u32>(), self.pointer.cast::<u8>());
        let (from, to) = (from.wrapping_add(head), to.wrapping_add(head));
        // SAFETY: whoever made the form says that `size` bytes have room, and `value` has at least as many.
        unsafe { to.copy_from_nonoverlapping(from, self.size - head) };
    }
}
