//! Weak tetrahedra by the clusters whose stress is bounded together.

use crate::asset::{Asset, StressBounds};
use crate::fields::Resistance;

/// Weak tetrahedra by cluster.
#[derive(Clone, Debug)]
pub(crate) struct WeakClusters {
    /// Numbers of the clusters that hold any.
    pub(crate) clusters: Vec<u32>,
    /// Where each one's tetrahedra start in `tets`, and the end.
    starts: Vec<u32>,
    tets: Vec<u32>,
    /// The smallest strength in each one, Pa.
    pub(crate) weakest: Vec<f32>,
}

impl WeakClusters {
    pub(crate) fn new(
        asset: &Asset,
        weak_tets: &[u32],
        bounds: &StressBounds,
        resistance: &Resistance,
    ) -> Self {
        let cluster_of = |e: u32| bounds.cluster_of_tet[asset.place(e as usize)];
        let mut tets = weak_tets.to_vec();
        tets.sort_by_cached_key(|&e| (cluster_of(e), e));
        let (mut clusters, mut starts) = (Vec::new(), Vec::new());
        for (i, &e) in tets.iter().enumerate() {
            let cluster = cluster_of(e);
            if clusters.last() != Some(&cluster) {
                clusters.push(cluster);
                starts.push(i as u32);
            }
        }
        starts.push(tets.len() as u32);
        let weakest = starts
            .windows(2)
            .map(|w| resistance.weakest_of(&tets[w[0] as usize..w[1] as usize]))
            .collect();
        Self {
            clusters,
            starts,
            tets,
            weakest,
        }
    }

    /// Where the tetrahedra of the cluster at place `i` of `clusters` stand among all weak ones, in this order.
    pub(crate) fn places(&self, i: usize) -> std::ops::Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }

    /// The place in `clusters` of the cluster that a weak tetrahedron belongs to, and the tetrahedron's place in the cluster; `place`: its
    /// place among all weak ones.
    pub(crate) fn locate(&self, place: usize) -> (usize, usize) {
        let after = self
            .starts
            .partition_point(|&start| start as usize <= place);
        let cluster = after.saturating_sub(1);
        (cluster, place - self.starts[cluster] as usize)
    }

    /// Weak tetrahedra of the cluster at place `i` of `clusters`.
    pub(crate) fn tets(&self, i: usize) -> &[u32] {
        &self.tets[self.places(i)]
    }
}
