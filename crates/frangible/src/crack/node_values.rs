//! Values of each crack's s at the nodes that it has met.

use crate::mesh::ByNode;

/// s of all cracks at the nodes of a mesh.
#[derive(Debug)]
pub(crate) struct NodeValues {
    /// Places in the values, by the node and the crack.
    places: ByNode<u32>,
    /// The values of s, m.
    values: Vec<f32>,
}

impl NodeValues {
    pub(crate) fn new(node_count: usize) -> Self {
        Self {
            places: ByNode::new(node_count),
            values: Vec::new(),
        }
    }

    /// A crack's s at a node, m.
    pub(crate) fn get(&self, crack: u32, node: u32) -> Option<f32> {
        let place = self.places.find(node, crack)?;
        Some(self.values[place as usize])
    }

    /// Sets a crack's s at a node, m, unless it has one: the first holds.
    pub(crate) fn keep(&mut self, crack: u32, node: u32, value: f32) {
        if self.places.find(node, crack).is_none() {
            self.places.add(node, crack);
            self.values.push(value);
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
