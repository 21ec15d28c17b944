//! Elimination ordering: minimum degree on the nodes; the unknowns of a node stay together.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::Perm;
use faer::sparse::SymbolicSparseColMat;
use faer::sparse::linalg::amd;
use faer::sparse::{SparseColMat, SymbolicSparseColMatRef};

use crate::error::BakeError;

/// Orders the unknowns of a lower triangle; `node_of`: the node of each unknown, rising.
///
/// The graph of the nodes has a ninth of the entries, and unknowns of a node are eliminated together, which makes
/// supernodes larger.
pub(crate) fn by_nodes(
    lower: &SparseColMat<usize, f64>,
    node_of: &[usize],
) -> Result<Perm<usize>, BakeError> {
    let mut firsts = Vec::new();
    let mut number = Vec::with_capacity(node_of.len());
    for (unknown, node) in node_of.iter().enumerate() {
        if unknown == 0 || *node != node_of[unknown - 1] {
            firsts.push(unknown);
        }
        number.push(firsts.len() - 1);
    }
    let graph = node_graph(lower.symbolic(), &firsts, &number);
    let nodes = firsts.len();
    let (mut order, mut place) = (vec![0; nodes], vec![0; nodes]);
    let scratch = amd::order_scratch::<usize>(nodes, graph.compute_nnz());
    amd::order(
        &mut order,
        &mut place,
        graph.as_ref(),
        amd::Control::default(),
        MemStack::new(&mut MemBuffer::new(scratch)),
    )
    .map_err(|e| BakeError::Factorization {
        reason: format!("ordering: {e:?}"),
    })?;
    firsts.push(node_of.len());
    let forward: Vec<usize> = order
        .iter()
        .flat_map(|&node| firsts[node]..firsts[node + 1])
        .collect();
    let mut inverse = vec![0; forward.len()];
    for (place, &unknown) in forward.iter().enumerate() {
        inverse[unknown] = place;
    }
    Ok(Perm::new_checked(
        forward.into_boxed_slice(),
        inverse.into_boxed_slice(),
        node_of.len(),
    ))
}

/// Lower triangle of the pattern over the nodes. The first unknown of a node has an entry for every neighbour.
fn node_graph(
    lower: SymbolicSparseColMatRef<'_, usize>,
    firsts: &[usize],
    number: &[usize],
) -> SymbolicSparseColMat<usize> {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for &first in firsts {
        let start = rows.len();
        for &row in &lower.row_idx()[lower.col_range(first)] {
            if rows.len() == start || rows[rows.len() - 1] != number[row] {
                rows.push(number[row]);
            }
        }
        starts.push(rows.len());
    }
    SymbolicSparseColMat::new_checked(firsts.len(), firsts.len(), starts, None, rows)
}
