//! Rows of the stress at a body's weak points, cluster by cluster, each made when it is first looked at.

use std::sync::OnceLock;

use crate::body::Body;
use crate::config::FractureConfig;
use crate::stress::{
    ClusterRows, Coarse, Elasticity, Law, LawRows, OppositeRows, RowPoint, Rows, Sizes, WeakRows,
    weak_place,
};

/// Work per point where stress is found from displacements: gradient of ten nodes, law; multiplications and additions.
const FROM_GRADIENT: usize = 348;

/// Rows are used where they are no more than so many times the work of displacements: they are read from end to end.
const WORTH: usize = 2;

impl ClusterRows {
    /// A few shapes in place of all modes, where they suffice.
    pub(crate) fn coarse(&self, body: &Body) -> Option<&Coarse> {
        let make = || {
            let periods = &body.prepared.periods[..self.rows.modes()];
            Coarse::new(&self.frames, &self.rows, periods)
        };
        self.coarse.get_or_init(make).as_ref()
    }

    /// Largest stress of each mode at each point.
    pub(crate) fn sizes(&self) -> &Sizes {
        let make = || Sizes::new(&self.frames, &self.rows);
        self.sizes.get_or_init(make)
    }
}

impl OppositeRows {
    fn new(body: &Body, config: &FractureConfig, modes: usize, cluster: usize) -> Self {
        let skin = &body.prepared.skin;
        let mut count = 0;
        let tets = body.clusters.tets(cluster).iter();
        let image = |&tet: &u32| {
            let weak = weak_place(&body.asset, skin, &body.places, config, &[], tet as usize);
            let image = weak.opposite(body, config, tet as usize)?;
            let first = count;
            count += image.frame.count();
            Some((image, first))
        };
        let images: Vec<_> = tets.map(image).collect();
        let points = images.iter().flatten().map(|(image, _)| image.clone());
        let points: Vec<RowPoint> = points.collect();
        let elasticity = Elasticity::new(&body.asset.material);
        Self {
            rows: Rows::new(&body.asset, &elasticity, modes, &points),
            images,
        }
    }
}

impl WeakRows {
    /// Stress rows of a body under so many modes; none where the stress comes from displacements: where strain is not linear, and where
    /// that is less work.
    pub(crate) fn of<'a>(
        &'a self,
        body: &Body,
        config: &FractureConfig,
        modes: usize,
    ) -> Option<&'a LawRows> {
        let followed = body.asset.modes.followed();
        if config.is_paper() || modes > followed {
            return None;
        }
        let laws = usize::from(config.sized_flaws);
        let make = || {
            let clusters = body.clusters.clusters.len();
            is_less_work(body, config, followed).then(|| LawRows {
                modes: followed,
                clusters: (0..clusters).map(|_| OnceLock::new()).collect(),
            })
        };
        self.0[laws].get_or_init(make).as_ref()
    }
}

impl Body {
    /// Computes the stress rows of its weak points, so that its first blow does not have to wait for them. Otherwise they are computed part by part,
    /// where a blow has to look. Copies of the body share them.
    pub fn prepare_for_blows(&self, config: &FractureConfig) {
        if let Some(rows) = self.rows.of(self, config, self.asset.modes.followed()) {
            for cluster in 0..rows.clusters.len() {
                let own = rows.cluster(self, config, cluster);
                if own.coarse(self).is_none() {
                    own.sizes();
                }
                rows.opposite(self, config, cluster);
            }
        }
    }
}

impl LawRows {
    /// Rows of the cluster at a place in the body's list.
    pub(crate) fn cluster(
        &self,
        body: &Body,
        config: &FractureConfig,
        cluster: usize,
    ) -> &ClusterRows {
        self.clusters[cluster].get_or_init(|| {
            let points = row_points(body, config, cluster);
            let elasticity = Elasticity::new(&body.asset.material);
            ClusterRows {
                rows: Rows::new(&body.asset, &elasticity, self.modes, &points),
                frames: points.iter().map(|point| point.frame).collect(),
                points,
                coarse: OnceLock::new(),
                sizes: OnceLock::new(),
                opposite: OnceLock::new(),
            }
        })
    }

    /// Rows of the images of the weak points of the cluster at a place in the body's list.
    pub(crate) fn opposite(
        &self,
        body: &Body,
        config: &FractureConfig,
        cluster: usize,
    ) -> &OppositeRows {
        let rows = &self.cluster(body, config, cluster).opposite;
        rows.get_or_init(|| OppositeRows::new(body, config, self.modes, cluster))
    }
}

/// The weak points of a cluster where nothing presses.
fn row_points(body: &Body, config: &FractureConfig, cluster: usize) -> Vec<RowPoint> {
    let skin = &body.prepared.skin;
    let tets = body.clusters.tets(cluster).iter();
    tets.map(|&tet| {
        let weak = weak_place(&body.asset, skin, &body.places, config, &[], tet as usize);
        weak.row_point(body, config, tet as usize)
    })
    .collect()
}

/// Returns true if rows are no more than [`WORTH`] times the work of displacements.
fn is_less_work(body: &Body, config: &FractureConfig, modes: usize) -> bool {
    let (asset, skin) = (&*body.asset, &body.prepared.skin);
    let weak = body.weak_tets();
    let count = |&tet: &u32| {
        let weak = weak_place(asset, skin, &body.places, config, &[], tet as usize);
        match weak.law {
            Law::Solid => 6,
            Law::Free(_) => 3,
            Law::Edge(_) => 1,
        }
    };
    let rows: usize = weak.iter().map(count).sum();
    let displacements = 6 * modes * asset.analysis.nodes.len();
    2 * modes * rows <= WORTH * (displacements + FROM_GRADIENT * weak.len())
}
