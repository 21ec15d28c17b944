//! Assigns components that fill almost nothing of their cell to a neighbouring element.
//!
//! Such components add unknowns, contribute little stiffness and make the system ill-conditioned. A component that is the only
//! connection between its neighbours is kept; otherwise they would be connected only along an edge.

use crate::fem::cover::lattice::{CELL_VOLUME, Cell, Quarters};

/// Share of its cell below which a component is a sliver. Measured on a glass of 3 000 elements: at 0.01 points lie
/// at most 0.06 outside their element (barycentric) and frequencies come from above; from 0.1 on, extrapolation
/// makes the body too soft and frequencies fall below the true ones.
const SLIVER: f64 = 1e-2;

/// Face contacts between components: `contacts[starts[c]..starts[c + 1]]` are those of component c.
pub(crate) struct Contacts {
    starts: Vec<usize>,
    /// Neighbour, and the approximate area of the contact with it.
    contacts: Vec<(u32, f64)>,
}

impl Contacts {
    /// Lists the contacts of pairs that meet inside a tetrahedron of the body, with the area; each pair in one direction, any number
    /// of times.
    pub(crate) fn new(cells: &[Cell], pairs: impl Iterator<Item = (u32, u32, f64)>) -> Self {
        let pairs: Vec<(u32, u32, f64)> = pairs
            .flat_map(|(a, b, area)| [(a, b, area), (b, a, area)])
            .collect();
        // Sorted in two steps, both stable, so that areas are summed in the order of the tetrahedra.
        let mut ends = vec![0; cells.len() + 1];
        pairs.iter().for_each(|c| ends[c.0 as usize + 1] += 1);
        for c in 0..cells.len() {
            ends[c + 1] += ends[c];
        }
        let mut found = vec![(0, 0, 0.0); pairs.len()];
        for pair in pairs {
            let next: &mut usize = &mut ends[pair.0 as usize];
            found[*next] = pair;
            *next += 1;
        }
        found
            .chunk_by_mut(|a, b| a.0 == b.0)
            .for_each(|c| c.sort_by_key(|c| c.1));
        found.dedup_by(|later, kept| {
            let same = (later.0, later.1) == (kept.0, kept.1);
            kept.2 += if same { later.2 } else { 0.0 };
            same
        });
        found.retain(|c| common(cells[c.0 as usize], &cells[c.1 as usize].corners()).len() == 3);
        let starts = (0..=cells.len() as u32)
            .map(|c| found.partition_point(|x| x.0 < c))
            .collect();
        Self {
            starts,
            contacts: found.into_iter().map(|c| (c.1, c.2)).collect(),
        }
    }

    fn of(&self, component: u32) -> &[(u32, f64)] {
        let c = component as usize;
        &self.contacts[self.starts[c]..self.starts[c + 1]]
    }
}

/// The component that carries each component, mostly itself; volumes are in cubes.
pub(crate) fn carriers(cells: &[Cell], volumes: &[f64], contacts: &Contacts) -> Vec<u32> {
    let sliver = |c: u32| volumes[c as usize] < SLIVER * CELL_VOLUME;
    let mut carrier: Vec<u32> = (0..cells.len() as u32).collect();
    let mut slivers: Vec<u32> = carrier.iter().copied().filter(|&c| sliver(c)).collect();
    slivers.sort_by(|&a, &b| volumes[a as usize].total_cmp(&volumes[b as usize]));
    for component in slivers {
        let stays = |c: u32| carrier[c as usize] == c;
        let mut hosts: Vec<(u32, f64)> = contacts.of(component).to_vec();
        hosts.retain(|h| !sliver(h.0));
        hosts.sort_by(|a, b| b.1.total_cmp(&a.1));
        let neighbours = contacts.of(component).iter().map(|n| n.0);
        let host = hosts.first().map(|h| h.0).filter(|&host| {
            neighbours
                .filter(|&n| n != host && stays(n))
                .all(|n| joined_without(component, n, host, cells, contacts, &stays))
        });
        if let Some(host) = host {
            carrier[component as usize] = host;
        }
    }
    carrier
}

/// Returns true if two neighbours of a component hang together by faces round the edge that all three have in common.
fn joined_without(
    component: u32,
    from: u32,
    to: u32,
    cells: &[Cell],
    contacts: &Contacts,
    stays: &dyn Fn(u32) -> bool,
) -> bool {
    let edge = common(
        cells[component as usize],
        &common(cells[from as usize], &cells[to as usize].corners()),
    );
    let round =
        |c: u32| c != component && stays(c) && common(cells[c as usize], &edge).len() == edge.len();
    let mut reached = vec![from];
    let mut next = 0;
    while next < reached.len() {
        for &(c, _) in contacts.of(reached[next]) {
            if c == to {
                return true;
            }
            if round(c) && !reached.contains(&c) {
                reached.push(c);
            }
        }
        next += 1;
    }
    false
}

/// Points that are corners of the cell.
fn common(cell: Cell, points: &[Quarters]) -> Vec<Quarters> {
    let corners = cell.corners();
    points
        .iter()
        .copied()
        .filter(|p| corners.contains(p))
        .collect()
}
