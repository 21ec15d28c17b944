//! Calls with wild arguments, for fuzzing and for tests: null, misaligned and freed things, wrong sizes and numbers of every sort. A call that
//! fails must have written nothing, and no call may panic.
#![expect(unsafe_code, reason = "the functions that it calls take pointers")]
#![allow(
    clippy::missing_panics_doc,
    reason = "a panic is what tells of a finding"
)]

mod draw;

use std::ffi::CStr;
use std::ptr::null;
use std::slice::from_raw_parts;

use crate::entry::entry;
use crate::memory::Sized32;
use crate::*;

/// Calls at most.
const CALLS: usize = 40;

/// Status of a call that panics inside.
#[must_use]
pub fn panicking() -> frangible_status {
    entry(|| panic!("on purpose"))
}

/// Makes the calls that the bytes describe. `asset`: a baked body.
pub fn wild(asset: &[u8], data: &[u8]) {
    let mut wild = Wild::new(asset, data);
    for _ in 0..CALLS {
        if wild.bytes.as_slice().is_empty() {
            break;
        }
        wild.call();
    }
    wild.end();
}

/// Memory for what a call writes, with room around it.
struct Memory([u64; 64]);

/// A word that no call writes.
const MARK: u64 = 0xa5a5_a5a5_a5a5_a5a5;

struct Wild<'a> {
    bytes: std::slice::Iter<'a, u8>,
    asset: &'a [u8],
    /// If true, numbers are odd now and then.
    odd: bool,
    breakables: Vec<frangible_breakable>,
    bodies: Vec<frangible_body>,
    outcomes: Vec<frangible_outcome>,
    state: Vec<u8>,
}

impl<'a> Wild<'a> {
    fn new(asset: &'a [u8], data: &'a [u8]) -> Self {
        let mut wild = Self {
            bytes: data.iter(),
            asset,
            odd: false,
            breakables: vec![frangible_breakable::default()],
            bodies: vec![frangible_body::default()],
            outcomes: vec![frangible_outcome::default()],
            state: Vec::new(),
        };
        wild.odd = wild.byte() & 1 == 1;
        let mut made = frangible_breakable::default();
        // SAFETY: the slice and the place are there.
        let status =
            unsafe { frangible_breakable_from_bytes(asset.as_ptr(), asset.len(), &raw mut made) };
        assert_eq!(status, frangible_status::Ok, "the asset is sound");
        wild.breakables.push(made);
        let mut body = frangible_body::default();
        // SAFETY: the place is there.
        let status = unsafe { frangible_body_new(made, 1, &raw mut body) };
        assert_eq!(status, frangible_status::Ok, "the kind is sound");
        wild.bodies.push(body);
        wild
    }

    /// Gives a call a place to write to, or none that fits; returns what it wrote if it succeeded.
    fn place<T: Copy>(
        &mut self,
        before: T,
        call: impl FnOnce(*mut T) -> frangible_status,
    ) -> Option<T> {
        const { assert!(size_of::<T>() < 448 && align_of::<T>() <= 8) };
        let mut memory = Memory([MARK; 64]);
        let start = (&raw mut memory.0).cast::<u8>().wrapping_add(16);
        let (place, fits) = match self.one_in(16) {
            false => (start.cast::<T>(), true),
            true if self.byte() & 1 == 0 => (std::ptr::null_mut(), false),
            true => (start.wrapping_add(1).cast::<T>(), align_of::<T>() == 1),
        };
        if fits {
            // SAFETY: the memory has room for it there, and the place is aligned.
            unsafe { place.write(before) };
        }
        let whole = memory.0;
        let status = call(place);
        if status != frangible_status::Ok {
            assert_eq!(memory.0, whole, "a call that failed has written");
            assert_ne!(status, frangible_status::Internal, "{}", text());
            assert!(!text().is_empty(), "a failure without a text");
            return None;
        }
        assert!(fits, "a call accepted a place that does not fit");
        // SAFETY: the call has written there, or left what was.
        Some(unsafe { place.read() })
    }

    /// As [`place`](Self::place) with a struct that has a size.
    fn form<T: Sized32>(&mut self, call: impl FnOnce(*mut T) -> frangible_status) -> Option<T> {
        let right = size_of::<T>();
        let size = self.size(right);
        let mut before = std::mem::MaybeUninit::<T>::zeroed();
        // SAFETY: its first field is its size, by the trait.
        unsafe { before.as_mut_ptr().cast::<u32>().write(size) };
        // SAFETY: all bits are sound, by the trait.
        let form = self.place(unsafe { before.assume_init() }, call);
        assert!(
            form.is_none() || size as usize == right,
            "a wrong size is accepted"
        );
        form
    }

    /// Calls one of the three functions that take a blow.
    fn blow(&mut self, which: u8) {
        let body = self.body();
        let strikers: Vec<_> = (0..1 + self.byte() % 2).map(|_| self.striker()).collect();
        let count = usize::from(self.byte() % 4);
        let contacts: Vec<_> = (0..count).map(|_| self.contact(strikers.len())).collect();
        let pose = self.pose();
        let at = pose.as_ref().map_or(null(), std::ptr::from_ref);
        let (mut first, mut count) = (contacts.as_ptr(), contacts.len());
        if self.one_in(16) {
            // Far too many; these are refused before any is read.
            count = [1 << 17, usize::MAX][usize::from(self.byte() & 1)];
        }
        if self.one_in(16) {
            first = [null(), first.wrapping_byte_add(1)][usize::from(self.byte() & 1)];
        }
        let (by, bys) = (strikers.as_ptr(), strikers.len());
        match which {
            0 => {
                let outcome = self.place(frangible_outcome::default(), |out| {
                    // SAFETY: the arrays are as long as it is told, or are not read.
                    unsafe { frangible_body_impact(body, first, count, by, bys, at, out) }
                });
                self.outcomes.extend(outcome);
            }
            1 => {
                let breaks = self.place(7, |out| {
                    // SAFETY: as above.
                    unsafe { frangible_body_would_break(body, first, count, by, bys, at, out) }
                });
                assert!(breaks.is_none_or(|b| b == 0 || b == 1));
            }
            _ => {
                let margin = self.place(-1.0, |out| {
                    // SAFETY: as above.
                    unsafe { frangible_body_margin(body, first, count, by, bys, at, out) }
                });
                assert!(margin.is_none_or(|m| m >= 0.0), "a margin of {margin:?}");
            }
        }
    }

    fn save(&mut self) {
        let (body, mut buffer) = (self.body(), vec![0xa5; 1 << 16]);
        let capacity = usize::from(self.byte()) * 257;
        let to = buffer.as_mut_ptr();
        let length = self.place(0, |length| {
            // SAFETY: the buffer has that room.
            unsafe { frangible_body_save(body, to, capacity, length) }
        });
        if let Some(length) = length {
            assert!(capacity == 0 || length <= capacity);
            buffer.truncate(if capacity == 0 { 0 } else { length });
            self.state = buffer;
        } else {
            assert!(
                buffer.iter().all(|&b| b == 0xa5),
                "a save that failed has written"
            );
        }
    }

    fn restore(&mut self) {
        let (body, mut state) = (self.body(), self.state.clone());
        if self.odd && !state.is_empty() {
            let place = usize::from(self.byte()) % state.len();
            state[place] ^= self.byte();
        }
        let (bytes, length) = (state.as_ptr(), state.len());
        // SAFETY: the slice is that long.
        let status = unsafe { frangible_body_restore(body, bytes, length) };
        assert_ne!(status, frangible_status::Internal, "{}", text());
    }

    /// Asks something of a fragment or a contact.
    fn ask<T: Sized32>(
        &mut self,
        (outcome, index): (frangible_outcome, usize),
        call: unsafe extern "C" fn(frangible_outcome, usize, *mut T) -> frangible_status,
    ) -> Option<T> {
        // SAFETY: the place is what the form says.
        self.form(|out| unsafe { call(outcome, index, out) })
    }

    /// Asks something of a kind.
    fn ask_kind<T: Sized32>(
        &mut self,
        kind: frangible_breakable,
        call: unsafe extern "C" fn(frangible_breakable, *mut T) -> frangible_status,
    ) -> Option<T> {
        // SAFETY: the place is what the form says.
        self.form(|out| unsafe { call(kind, out) })
    }

    /// Looks at all that can be asked of an outcome.
    fn look(&mut self) {
        let outcome = self.outcome();
        // SAFETY: the place is what the form says.
        let report = self.form(|out| unsafe { frangible_outcome_report(outcome, out) });
        let index = self.index(report.map_or(2, |r: frangible_report| r.fragments));
        self.ask((outcome, index), frangible_outcome_contact);
        let solid = self.ask((outcome, index), frangible_outcome_solid);
        assert!(solid.is_none_or(|s: frangible_solid| s.mass > 0.0));
        let drawn = self.ask((outcome, index), frangible_outcome_geometry);
        drawn.iter().for_each(check_mesh);
        let closed = self.ask((outcome, index), frangible_outcome_surface);
        closed.iter().for_each(check_mesh);
        let hulls = self.ask((outcome, index), frangible_outcome_hulls);
        hulls.iter().for_each(check_hulls);
        if report.is_some_and(|r| r.broke == 1) {
            self.motions(outcome, report.map_or(0, |r| r.fragments));
        }
        // The modes of a large piece take long.
        if index > 1 {
            let piece = self.place(frangible_body::default(), |out| {
                // SAFETY: the place is there.
                unsafe { frangible_outcome_piece(outcome, index, out) }
            });
            self.bodies.extend(piece);
        }
    }

    fn motions(&mut self, outcome: frangible_outcome, fragments: usize) {
        let (pose, motion, striker) = (self.pose(), self.motion(), self.striker());
        let at = pose.as_ref().map_or(null(), std::ptr::from_ref);
        let mut motions = vec![frangible_motion::default(); fragments];
        let count = if self.one_in(8) {
            fragments + 1
        } else {
            fragments
        };
        let to = motions.as_mut_ptr();
        let (motion, striker) = (&raw const motion, &raw const striker);
        let no_poses = std::ptr::null_mut();
        let after = self.place(frangible_motion::default(), |after| {
            // SAFETY: there is room for the fragments, and another count is refused.
            unsafe {
                frangible_outcome_motions(outcome, at, motion, striker, no_poses, to, count, after)
            }
        });
        assert!(after.is_none() || count == fragments);
    }

    fn kind(&mut self) {
        let kind = self.breakable();
        let about = self.ask_kind(kind, frangible_breakable_about);
        if let Some(frangible_about { name, .. }) = about {
            // SAFETY: a text of the kind, which is not freed yet.
            let name = unsafe { CStr::from_ptr(name) };
            assert!(name.to_str().is_ok());
        }
        self.ask_kind(kind, frangible_breakable_solid);
        let drawn = self.ask_kind(kind, frangible_breakable_geometry);
        drawn.iter().for_each(check_mesh);
        let hulls = self.ask_kind(kind, frangible_breakable_hulls);
        hulls.iter().for_each(check_hulls);
    }

    fn call(&mut self) {
        match self.byte() % 16 {
            0 => {
                let mut bytes = self.asset.to_vec();
                if self.odd {
                    let place = usize::from(self.byte()) * bytes.len() / 256;
                    bytes[place] ^= self.byte();
                    bytes.truncate(bytes.len() - usize::from(self.byte() / 128));
                }
                let made = self.place(frangible_breakable::default(), |out| {
                    let (bytes, length) = (bytes.as_ptr(), bytes.len());
                    // SAFETY: the slice and the place are there.
                    unsafe { frangible_breakable_from_bytes(bytes, length, out) }
                });
                self.breakables.extend(made);
            }
            1 => {
                let (kind, factor) = (self.breakable(), self.number(1.0));
                let made = self.place(frangible_breakable::default(), |out| {
                    // SAFETY: the place is there.
                    unsafe { frangible_breakable_scaled(kind, factor, out) }
                });
                self.breakables.extend(made);
            }
            2 => {
                let (kind, seed) = (self.breakable(), u64::from(self.byte()));
                let made = self.place(frangible_body::default(), |out| {
                    // SAFETY: the place is there.
                    unsafe { frangible_body_new(kind, seed, out) }
                });
                self.bodies.extend(made);
            }
            3 => self.kind(),
            4 => self.save(),
            5 => self.restore(),
            6 => drop(frangible_breakable_free(self.breakable())),
            7 => drop(frangible_body_free(self.body())),
            8 => drop(frangible_outcome_free(self.outcome())),
            9 => self.blow(1),
            10 => self.blow(2),
            11 | 12 => self.look(),
            _ => self.blow(0),
        }
    }

    /// Frees all, and checks that what is freed is told.
    fn end(self) {
        for kind in self.breakables {
            frangible_breakable_free(kind);
            let again = frangible_breakable_free(kind);
            assert!(kind.id == 0 || again == frangible_status::Handle);
        }
        for body in self.bodies {
            frangible_body_free(body);
            let again = frangible_body_free(body);
            assert!(body.id == 0 || again == frangible_status::Handle);
        }
        for outcome in self.outcomes {
            frangible_outcome_free(outcome);
            let again = frangible_outcome_free(outcome);
            assert!(outcome.id == 0 || again == frangible_status::Handle);
        }
    }
}

/// The text of the last failure.
fn text() -> String {
    // SAFETY: it is a text, and no call comes between.
    let text = unsafe { CStr::from_ptr(frangible_error_text()) };
    text.to_string_lossy().into_owned()
}

fn check_mesh(mesh: &frangible_geometry) {
    // SAFETY: the arrays are as long as the struct says, and their handle is live.
    let indices = unsafe { from_raw_parts(mesh.indices, mesh.indices_count) };
    // SAFETY: as above.
    let positions = unsafe { from_raw_parts(mesh.positions, 3 * mesh.vertices) };
    assert!(indices.iter().all(|&i| (i as usize) < mesh.vertices));
    assert!(positions.iter().all(|x| x.is_finite()));
    assert!(mesh.outer_indices <= mesh.indices_count);
}

fn check_hulls(hulls: &frangible_hulls) {
    if hulls.count == 0 {
        return;
    }
    // SAFETY: the arrays are as long as the struct says, and their handle is live.
    let ends = unsafe { from_raw_parts(hulls.ends, hulls.count) };
    // SAFETY: as above.
    let points = unsafe { from_raw_parts(hulls.points, 3 * ends[hulls.count - 1]) };
    assert!(ends.is_sorted());
    assert!(points.iter().all(|x| x.is_finite()));
}
