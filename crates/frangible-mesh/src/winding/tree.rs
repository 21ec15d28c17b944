//! A bounding volume hierarchy with four children per node and one packet per leaf.

use glam::DVec3;

use super::packet::{Lanes, Packet, WIDTH};

const BINS: usize = 16;
/// Depth below which ranges are halved, whatever it costs, so that recursion stays shallow.
const DEEPEST_BEST_SPLIT: usize = 24;

/// Content of a node's slot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Child {
    Empty,
    Node(usize),
    Leaf(usize),
}

/// Boxes of four children. An empty slot has an inside-out box at infinity.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Lowest coordinates by axis and child, m.
    pub(super) low: [Lanes; 3],
    /// Highest coordinates by axis and child, m.
    pub(super) high: [Lanes; 3],
    slots: [u32; WIDTH],
}

const EMPTY: u32 = u32::MAX;
const LEAF: u32 = 1 << 31;

impl Node {
    pub(super) fn child(&self, slot: usize) -> Child {
        match self.slots[slot] {
            EMPTY => Child::Empty,
            leaf if leaf & LEAF != 0 => Child::Leaf((leaf & !LEAF) as usize),
            node => Child::Node(node as usize),
        }
    }
}

/// Nodes, parents before children; packets in the order of a depth-first walk. Node 0 is the root.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) packets: Vec<Packet>,
}

struct Item {
    low: DVec3,
    high: DVec3,
    triangle: u32,
}

/// Builds the tree over triangles given with their indices in the surface. At most 2³⁰ triangles.
pub(super) fn build(triangles: &[(u32, [DVec3; 3])]) -> Tree {
    let mut items: Vec<Item> = (0..)
        .zip(triangles)
        .map(|(triangle, (_, [a, b, c]))| Item {
            low: a.min(*b).min(*c),
            high: a.max(*b).max(*c),
            triangle,
        })
        .collect();
    let mut tree = Tree::default();
    if !items.is_empty() {
        add_node(&mut tree, triangles, &mut items, 0);
    }
    tree
}

fn add_node(
    tree: &mut Tree,
    triangles: &[(u32, [DVec3; 3])],
    items: &mut [Item],
    depth: usize,
) -> u32 {
    let index = tree.nodes.len();
    tree.nodes.push(Node {
        low: [[f64::INFINITY; WIDTH]; 3],
        high: [[f64::NEG_INFINITY; WIDTH]; 3],
        slots: [EMPTY; WIDTH],
    });
    for (slot, part) in quarter(items, depth).into_iter().enumerate() {
        let [low, high] = bounds(part);
        let child = if part.len() <= WIDTH {
            tree.packets.push(Packet::new(
                part.iter().map(|item| triangles[item.triangle as usize]),
            ));
            LEAF | (tree.packets.len() - 1) as u32
        } else {
            add_node(tree, triangles, part, depth + 1)
        };
        let node = &mut tree.nodes[index];
        node.slots[slot] = child;
        for axis in 0..3 {
            node.low[axis][slot] = low[axis];
            node.high[axis][slot] = high[axis];
        }
    }
    index as u32
}

/// Up to four parts, each made by splitting the one of largest surface that does not fit a packet.
fn quarter(items: &mut [Item], depth: usize) -> Vec<&mut [Item]> {
    let mut parts = vec![(half_surface(bounds(items)), items)];
    while parts.len() < WIDTH {
        let largest = (0..parts.len())
            .filter(|&i| parts[i].1.len() > WIDTH)
            .max_by(|&i, &j| parts[i].0.total_cmp(&parts[j].0));
        let Some(largest) = largest else { break };
        let (_, part) = parts.remove(largest);
        let middle = split(part, depth);
        let (left, right) = part.split_at_mut(middle);
        parts.insert(largest, (half_surface(bounds(right)), right));
        parts.insert(largest, (half_surface(bounds(left)), left));
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

fn bounds(items: &[Item]) -> [DVec3; 2] {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    items
        .iter()
        .fold(nothing, |[l, h], item| [l.min(item.low), h.max(item.high)])
}

fn half_surface([low, high]: [DVec3; 2]) -> f64 {
    let e = high - low;
    e.x * e.y + e.y * e.z + e.z * e.x
}

/// Reorders `items` into two parts, neither empty, by the surface area heuristic over bins along the longest axis;
/// the cost of a part is its surface times its packets. Returns where the second part starts.
fn split(items: &mut [Item], depth: usize) -> usize {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = items.iter().fold(nothing, |[l, h], item| {
        let c = item.low + item.high;
        [l.min(c), h.max(c)]
    });
    let extent = high - low;
    let axis = extent.max_position();
    let scale = BINS as f64 / extent[axis];
    let bin = |item: &Item| {
        let along = item.low[axis] + item.high[axis] - low[axis];
        ((along * scale) as usize).min(BINS - 1)
    };
    if depth < DEEPEST_BEST_SPLIT && scale.is_finite() {
        let border = best_border(items, bin);
        let mut middle = 0;
        for i in 0..items.len() {
            if bin(&items[i]) < border {
                items.swap(i, middle);
                middle += 1;
            }
        }
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        let (ca, cb) = (a.low[axis] + a.high[axis], b.low[axis] + b.high[axis]);
        ca.total_cmp(&cb).then(a.triangle.cmp(&b.triangle))
    });
    middle
}

/// The bin at which the cheaper cut starts its second part.
fn best_border(items: &[Item], bin: impl Fn(&Item) -> usize) -> usize {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let mut boxes = [nothing; BINS];
    let mut counts = [0_usize; BINS];
    for item in items {
        let b = bin(item);
        boxes[b] = [boxes[b][0].min(item.low), boxes[b][1].max(item.high)];
        counts[b] += 1;
    }
    let join = |a: [DVec3; 2], b: [DVec3; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    let cost = |around: [DVec3; 2], count: usize| match count {
        0 => f64::INFINITY,
        _ => half_surface(around) * count.div_ceil(WIDTH) as f64,
    };
    let mut right_costs = [f64::INFINITY; BINS];
    let (mut around, mut count) = (nothing, 0);
    for b in (1..BINS).rev() {
        (around, count) = (join(around, boxes[b]), count + counts[b]);
        right_costs[b] = cost(around, count);
    }
    let (mut around, mut count) = (nothing, 0);
    let mut best = (f64::INFINITY, BINS / 2);
    for b in 1..BINS {
        (around, count) = (join(around, boxes[b - 1]), count + counts[b - 1]);
        let total = cost(around, count) + right_costs[b];
        if total < best.0 {
            best = (total, b);
        }
    }
    best.1
}
