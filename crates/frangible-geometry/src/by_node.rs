//! Tables of edges, faces and similar entities that are defined by a few mesh nodes.

/// Entries by their lowest node and a key, stored as a linked list per node and numbered in the order of insertion. Lookups
/// need no hashing.
#[derive(Debug)]
pub struct ByNode<K> {
    /// Number of each node's latest entry plus one; 0 if there is none.
    latest: Vec<u32>,
    /// Key of each entry, and the previous entry of the same node.
    entries: Vec<(K, u32)>,
}

impl<K: Copy + PartialEq> ByNode<K> {
    /// Creates an empty table for this number of nodes.
    #[must_use]
    pub fn new(node_count: usize) -> Self {
        Self {
            latest: vec![0; node_count],
            entries: Vec::new(),
        }
    }

    /// Returns the number of the entry with this node and key.
    #[must_use]
    pub fn find(&self, node: u32, key: K) -> Option<u32> {
        let mut at = self.latest[node as usize];
        while at != 0 {
            let (known, before) = self.entries[at as usize - 1];
            if known == key {
                return Some(at - 1);
            }
            at = before;
        }
        None
    }

    /// Adds an entry, which must not exist yet.
    pub fn add(&mut self, node: u32, key: K) {
        let latest = &mut self.latest[node as usize];
        self.entries.push((key, *latest));
        *latest = self.entries.len() as u32;
    }
}
