//! Handles. Each is a number that is given once, so that a freed one is always told.
#![expect(unsafe_code, reason = "an exported name is an unsafe attribute")]

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use crate::body::BODIES;
use crate::breakable::BREAKABLES;
use crate::entry::{Failure, frangible_status};
use crate::outcome::OUTCOMES;

/// The number of the next handle. It does not come round: 2⁶⁴ are more than there is time for.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// Things of one sort that C has handles of.
pub(crate) struct Registry<T> {
    things: RwLock<BTreeMap<u64, Arc<T>>>,
    /// Their name in messages, with its article.
    name: &'static str,
}

impl<T> Registry<T> {
    /// An empty one.
    pub(crate) const fn new(name: &'static str) -> Self {
        Self {
            things: RwLock::new(BTreeMap::new()),
            name,
        }
    }

    /// Keeps a thing, and returns the number of its handle.
    pub(crate) fn add(&self, thing: T) -> u64 {
        let id = NEXT.fetch_add(1, Ordering::Relaxed);
        let mut things = self.things.write().unwrap_or_else(PoisonError::into_inner);
        things.insert(id, Arc::new(thing));
        id
    }

    /// The thing with this number.
    pub(crate) fn get(&self, id: u64) -> Result<Arc<T>, Failure> {
        let things = self.things.read().unwrap_or_else(PoisonError::into_inner);
        things.get(&id).cloned().ok_or_else(|| self.unknown(id))
    }

    /// Frees the thing with this number. Zero is no thing, and no error, as for `free`.
    pub(crate) fn free(&self, id: u64) -> Result<(), Failure> {
        if id == 0 {
            return Ok(());
        }
        let mut things = self.things.write().unwrap_or_else(PoisonError::into_inner);
        let freed = things.remove(&id);
        drop(things);
        // A thing is large, and is dropped without the lock.
        freed.map(drop).ok_or_else(|| self.unknown(id))
    }

    fn unknown(&self, id: u64) -> Failure {
        let name = self.name;
        let text = match id {
            0 => format!(
                "the handle of {name} is zero; was the call checked that should have made it?"
            ),
            _ => format!(
                "{id} is no handle of {name}; it was freed, or this library has not made it, or it belongs to a thing of another sort"
            ),
        };
        Failure(frangible_status::Handle, text)
    }

    fn count(&self) -> usize {
        let things = self.things.read().unwrap_or_else(PoisonError::into_inner);
        things.len()
    }
}

/// Returns the number of handles that were made and are not freed, of all sorts: zero at the end of a program that frees what it makes.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_live_handles() -> usize {
    BREAKABLES.count() + BODIES.count() + OUTCOMES.count()
}
