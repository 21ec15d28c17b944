//! Lists of indices with different lengths, stored consecutively.

/// Rows of indices in compressed storage: the start of each row, and all rows consecutively.
#[derive(Clone, Debug)]
pub struct Rows {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Default for Rows {
    /// No row yet.
    fn default() -> Self {
        Self {
            starts: vec![0],
            items: Vec::new(),
        }
    }
}

impl Rows {
    /// Builds the inverse of `keys`: row r lists, in ascending order, the indices of the keys that contain r. For the nodes of
    /// tetrahedra these are the tetrahedra of each node.
    pub fn inverse<const N: usize>(count: usize, keys: &[[u32; N]]) -> Self {
        let mut starts = vec![0_u32; count + 1];
        for &r in keys.iter().flatten() {
            starts[r as usize + 1] += 1;
        }
        for r in 0..count {
            starts[r + 1] += starts[r];
        }
        let mut next = starts.clone();
        let mut items = vec![0; N * keys.len()];
        for (i, key) in keys.iter().enumerate() {
            for &r in key {
                items[next[r as usize] as usize] = i as u32;
                next[r as usize] += 1;
            }
        }
        Self { starts, items }
    }

    /// Adds a row, sorted in ascending order.
    pub fn push(&mut self, row: &mut [u32]) {
        row.sort_unstable();
        self.items.extend_from_slice(row);
        self.starts.push(self.items.len() as u32);
    }

    /// Releases unused memory.
    pub fn shrunk(mut self) -> Self {
        self.starts.shrink_to_fit();
        self.items.shrink_to_fit();
        self
    }

    /// Returns the number of rows.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns a row.
    pub fn of(&self, row: u32) -> &[u32] {
        let r = row as usize;
        &self.items[self.starts[r] as usize..self.starts[r + 1] as usize]
    }
}
