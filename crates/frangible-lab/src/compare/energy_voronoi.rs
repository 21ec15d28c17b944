//! Voronoi cells drawn by strain energy, apart where that pays (after Zheng and James, *Rigid-body fracture sound with
//! precomputed soundbanks*, 2010, as `[G12 §2.2]` tells of it: sites are drawn with probabilities proportional to the strain energy
//! density, and no more surface is made than there is strain energy for).
//!
//! 1. The moment of the largest strain energy W of the vibration that ours follows.
//! 2. A stated number of sites, drawn with the strain energy density η of that moment; their Voronoi cells.
//! 3. A common border of two cells of area A asks for G_c A and gets γ η A, what ours gives to a crack there. Where it gets
//!    less than it asks for the two grow together.
//! 4. While all borders together ask for more than W (with the energy ledger), the one that gets least for what it asks for goes,
//!    too.
//!
//! Left out: their quasi-static solver (the moment comes from our modes), several events during one contact, and all sound. They
//! go on drawing sites until the energy is spent; here their number is stated, and each border must pay for itself as well.

use super::divide::{Border, Division};
use super::draws::Draws;
use super::error::CompareError;
use super::hit::Hit;
use super::moment::{Moment, Wave};
use super::voronoi::Sites;

/// Sites that are drawn unless another number is asked for.
pub const DEFAULT_SITES: usize = 100;

/// Stream of random numbers of this method's sites.
const STREAM: u64 = 2;

/// Boundary between two cells.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seam {
    between: [u32; 2],
    /// Energy that it takes to open, Σ A G_c, J.
    asks: f64,
    /// Energy that is released there, Σ A γ η, J.
    gets: f64,
}

/// The body divided, and W, J.
pub(crate) fn divide<'a>(
    hit: Hit<'a>,
    sites: usize,
    seed: u64,
) -> Result<(Division<'a>, f64), CompareError> {
    let wave = Wave::new(hit)?;
    let mut moment = wave.at(wave.most_strained());
    let mesh = hit.body.asset().fracture();
    let energies: Vec<f64> = (0..mesh.tets.len() as u32)
        .map(|tet| f64::from(moment.inside(tet).energy_density).max(0.0))
        .collect();
    let drawn = Draws::new(mesh, |tet| energies[tet], seed, STREAM);
    let drawn = drawn.map_or_else(Vec::new, |mut draws| {
        (0..sites).map(|_| draws.place()).collect()
    });
    let cells = Sites(drawn).divide(hit.body)?;
    let seams = seams(hit, &mut moment, cells.borders());
    let budget = match hit.config.is_paper() {
        true => f64::INFINITY,
        false => wave.strain_energy(),
    };
    let joined = join(sites, seams, budget);
    let division = cells.relabelled(|cell| joined[cell as usize]);
    Ok((division, wave.strain_energy()))
}

/// Borders of the same two cells as one, the best paid first.
fn seams(hit: Hit<'_>, moment: &mut Moment<'_>, mut borders: Vec<Border>) -> Vec<Seam> {
    borders.sort_by_key(|border| (border.between, border.tet));
    let depth = hit.body.asset().material().energy_depth;
    let mut seams: Vec<Seam> = Vec::new();
    for group in borders.chunk_by(|a, b| a.between == b.between) {
        let mut seam = Seam {
            between: group[0].between,
            asks: 0.0,
            gets: 0.0,
        };
        for &Border { tet, area, .. } in group {
            seam.asks += area * hit.body.toughness(tet);
            seam.gets += area * depth * f64::from(moment.inside(tet).energy_density);
        }
        seams.push(seam);
    }
    seams.sort_by(|a, b| b.pay().total_cmp(&a.pay()).then(a.between.cmp(&b.between)));
    seams
}

impl Seam {
    /// Energy released over energy taken.
    fn pay(&self) -> f64 {
        self.gets / self.asks
    }
}

/// The cell that each cell is part of, the lowest of them. `seams`: the best paid first.
fn join(cells: usize, mut seams: Vec<Seam>, budget: f64) -> Vec<u32> {
    let mut cell: Vec<u32> = (0..cells as u32).collect();
    let grow = |cell: &mut Vec<u32>, seam: Seam| {
        let [a, b] = seam.between.map(|c| cell[c as usize]);
        let (low, high) = (a.min(b), a.max(b));
        cell.iter_mut()
            .filter(|c| **c == high)
            .for_each(|c| *c = low);
    };
    let paid = seams.partition_point(|seam| seam.gets >= seam.asks);
    for seam in seams.split_off(paid) {
        grow(&mut cell, seam);
    }
    loop {
        // A border within one piece separates nothing.
        seams.retain(|seam| {
            let [a, b] = seam.between.map(|c| cell[c as usize]);
            a != b
        });
        let asked: f64 = seams.iter().map(|seam| seam.asks).sum();
        match seams.pop() {
            Some(dearest) if asked > budget => grow(&mut cell, dearest),
            _ => return cell,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seam(between: [u32; 2], asks: f64, gets: f64) -> Seam {
        Seam {
            between,
            asks,
            gets,
        }
    }

    /// Four cells in a ring.
    fn ring() -> Vec<Seam> {
        vec![
            seam([0, 1], 1.0, 9.0),
            seam([1, 2], 1.0, 5.0),
            seam([2, 3], 1.0, 3.0),
            seam([0, 3], 1.0, 0.5),
        ]
    }

    #[test]
    fn cells_grow_together_where_a_border_does_not_pay() {
        assert_eq!(join(4, ring(), f64::INFINITY), [0, 1, 2, 0]);
    }

    #[test]
    fn of_borders_that_cannot_all_be_paid_the_best_stay() {
        // Without 0|3 three are left; with 2 J the worst of them, 2|3, goes, with less than 2 J all.
        assert_eq!(join(4, ring(), 2.0), [0, 1, 0, 0]);
        assert_eq!(join(4, ring(), 1.9), [0, 0, 0, 0]);
        assert_eq!(join(4, ring(), 0.0), [0, 0, 0, 0]);
    }
}
