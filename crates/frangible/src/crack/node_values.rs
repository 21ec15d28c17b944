//! What each crack's s is at the nodes that it has met: a chain per node, which knows no hash.

/// One crack's s at one node.
#[derive(Clone, Copy, Debug)]
struct Entry {
    crack: u32,
    /// m.
    value: f32,
    /// The node's entry before it, plus one; 0 for none.
    before: u32,
}

/// s of all cracks at the nodes of a mesh.
#[derive(Debug)]
pub(crate) struct NodeValues {
    /// Each node's latest entry, plus one; 0 for none.
    latest: Vec<u32>,
    entries: Vec<Entry>,
}

impl NodeValues {
    pub(crate) fn new(node_count: usize) -> Self {
        Self {
            latest: vec![0; node_count],
            entries: Vec::new(),
        }
    }

    /// A crack's s at a node, m.
    pub(crate) fn get(&self, crack: u32, node: u32) -> Option<f32> {
        let mut at = self.latest[node as usize];
        while at != 0 {
            let entry = &self.entries[at as usize - 1];
            if entry.crack == crack {
                return Some(entry.value);
            }
            at = entry.before;
        }
        None
    }

    /// Sets a crack's s at a node, m, unless it has one: the first holds.
    pub(crate) fn keep(&mut self, crack: u32, node: u32, value: f32) {
        if self.get(crack, node).is_none() {
            let latest = &mut self.latest[node as usize];
            self.entries.push(Entry {
                crack,
                value,
                before: *latest,
            });
            *latest = self.entries.len() as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::NodeValues;

    #[test]
    fn the_first_value_of_each_crack_at_each_node_holds() {
        let mut values = NodeValues::new(5);
        for (crack, node, value) in [
            (0, 2, 1.0),
            (1, 2, 2.0),
            (0, 2, 3.0),
            (0, 4, 4.0),
            (7, 2, -5.0),
        ] {
            values.keep(crack, node, value);
        }
        assert_eq!(values.get(0, 2), Some(1.0));
        assert_eq!(values.get(1, 2), Some(2.0));
        assert_eq!(values.get(7, 2), Some(-5.0));
        assert_eq!(values.get(0, 4), Some(4.0));
        assert_eq!(values.get(1, 4), None);
        assert_eq!(values.get(0, 0), None);
    }
}
