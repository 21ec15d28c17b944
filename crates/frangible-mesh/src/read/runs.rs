//! Names in force while a file is read: runs of triangles.
//!
//! Groups are runs of triangles, so that memory grows with the file, however many names a line has.

use crate::InputGroup;

/// Names that hold until others take their place.
#[derive(Default)]
pub(crate) struct Runs {
    names: Vec<String>,
    from: u32,
}

impl Runs {
    /// Begins a run of these names at triangle `next`; the run before it is added to `groups` if it has any triangle.
    pub(crate) fn change(
        &mut self,
        names: impl IntoIterator<Item = String>,
        next: u32,
        groups: &mut Vec<InputGroup>,
    ) {
        let held = std::mem::replace(&mut self.names, names.into_iter().collect());
        if next > self.from {
            groups.extend(held.into_iter().map(|name| InputGroup {
                name,
                triangles: self.from..next,
            }));
        }
        self.from = next;
    }
}
