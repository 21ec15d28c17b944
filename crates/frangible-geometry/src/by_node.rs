//! Tables of edges, faces and the like, each among a few mesh nodes.

/// Entries by their lowest node and a key: a chain per node, numbered in the order they came. Costs
/// memory for its entries, not for the mesh, and needs no hash.
#[derive(Debug)]
pub struct ByNode<K> {
    /// Number plus one of each node's latest entry, 0 for none.
    latest: Vec<u32>,
    /// Each entry's key, and the node's entry before it.
    entries: Vec<(K, u32)>,
}

impl<K: Copy + PartialEq> ByNode<K> {
    /// A table of no entries, for this number of nodes.
    #[must_use]
    pub fn new(node_count: usize) -> Self {
        Self {
            latest: vec![0; node_count],
            entries: Vec::new(),
        }
    }

    /// Number of the entry at a node with a key.
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

    /// Adds an entry that is not there yet.
    pub fn add(&mut self, node: u32, key: K) {
        let latest = &mut self.latest[node as usize];
        self.entries.push((key, *latest));
        *latest = self.entries.len() as u32;
    }
}
