//! Weak tetrahedra by the clusters whose stress is bounded together.

use glam::Vec3;

use crate::asset::{Asset, StressBounds};
use crate::fields::Resistance;

/// Weak tetrahedra by cluster.
#[derive(Clone, Debug, Default)]
pub(crate) struct WeakClusters {
    /// Numbers of the clusters that hold any.
    pub(crate) clusters: Vec<u32>,
    /// Start of each one's tetrahedra in `tets`, and the end.
    starts: Vec<u32>,
    tets: Vec<u32>,
    /// The smallest strength in each one, Pa.
    pub(crate) weakest: Vec<f32>,
    /// The deepest flaw in each one that is larger than its tetrahedron, m; zero where there is none.
    pub(crate) deepest: Vec<f32>,
    /// Bounds of the stress, and of the displacement gradient, in each one and all clusters that its flaws reach: cluster after cluster, a
    /// number per mode. Empty where no flaw is larger than its tetrahedron.
    reaching: [Vec<f32>; 2],
}

impl WeakClusters {
    /// `flaw_depth`: depth of the flaw of a weak tetrahedron, m; zero where it is smaller than that.
    pub(crate) fn new(
        asset: &Asset,
        weak_tets: &[u32],
        bounds: &StressBounds,
        resistance: &Resistance,
        flaw_depth: impl Fn(u32) -> f32,
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
        let of_clusters = || (starts.windows(2)).map(|w| &tets[w[0] as usize..w[1] as usize]);
        let weakest = of_clusters().map(|tets| resistance.weakest_of(tets));
        let deepest = of_clusters().map(|tets| {
            let depths = tets.iter().map(|&e| flaw_depth(e));
            depths.fold(0.0, f32::max)
        });
        let (weakest, deepest) = (weakest.collect(), deepest.collect::<Vec<_>>());
        Self {
            reaching: reaching(asset, bounds, &clusters, &deepest),
            clusters,
            starts,
            tets,
            weakest,
            deepest,
        }
    }

    /// Returns bounds of the stress, Pa per m·√kg, and of the displacement gradient of each mode at the weak points of cluster `clusters[i]`.
    #[inline(always)]
    pub(crate) fn rows<'a>(
        &'a self,
        bounds: &'a StressBounds,
        i: usize,
        modes: usize,
    ) -> (&'a [f32], &'a [f32]) {
        match &self.reaching {
            [stress, _] if stress.is_empty() => bounds.rows(self.clusters[i] as usize, modes),
            [stress, gradient] => {
                let own = i * modes..(i + 1) * modes;
                (&stress[own.clone()], &gradient[own])
            }
        }
    }

    /// Range of the tetrahedra of the cluster at place `i` of `clusters` among all weak ones, in this order.
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

/// The larger of the bounds of all clusters that the flaws of each one of `clusters` reach; `deepest`: the depth of its deepest flaw, m.
fn reaching(
    asset: &Asset,
    bounds: &StressBounds,
    clusters: &[u32],
    deepest: &[f32],
) -> [Vec<f32>; 2] {
    let modes = asset.modes.count();
    if deepest.iter().all(|&depth| depth <= 0.0) {
        return [Vec::new(), Vec::new()];
    }
    let count = bounds
        .cluster_of_tet
        .iter()
        .max()
        .map_or(0, |&c| c as usize + 1);
    let mut boxes = vec![(Vec3::INFINITY, Vec3::NEG_INFINITY); count];
    for tet in asset.tets() {
        let (low, high) = &mut boxes[bounds.cluster_of_tet[asset.place(tet)] as usize];
        for x in asset.fracture.corners(tet) {
            (*low, *high) = (low.min(x), high.max(x));
        }
    }
    let mut all = [Vec::new(), Vec::new()];
    for (&cluster, &depth) in clusters.iter().zip(deepest) {
        let (low, high) = boxes[cluster as usize];
        let (low, high) = (low - depth, high + depth);
        let (stress, gradient) = bounds.rows(cluster as usize, modes);
        let mut own = [stress.to_vec(), gradient.to_vec()];
        for (other, &(l, h)) in boxes.iter().enumerate() {
            if depth > 0.0 && l.cmple(high).all() && h.cmpge(low).all() {
                let (stress, gradient) = bounds.rows(other, modes);
                for (own, other) in own.iter_mut().zip([stress, gradient]) {
                    for (own, &other) in own.iter_mut().zip(other) {
                        *own = own.max(other);
                    }
                }
            }
        }
        for (all, own) in all.iter_mut().zip(own) {
            all.extend(own);
        }
    }
    all
}
