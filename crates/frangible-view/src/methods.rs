//! Comparison of fracture methods on the last impact, up to four side by side.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Fracture, ImpactReport};
use frangible_compare::{Broken, Method};
use frangible_recording::RecordedMesh;
use frangible_scenes::LiveScene;

use crate::blow::Blow;
use crate::compare::place;
use crate::marks::reach;
use crate::mesher::numbered;
use crate::numbers::OutcomeNumbers;
use crate::picture::{Batch, Label};

/// Methods that are shown at once, at most.
pub(crate) const PANES: usize = 4;

/// Methods that are shown first.
pub(crate) const FIRST: [Method; PANES] = [
    Method::Ours,
    Method::QuasiStatic,
    Method::Elements,
    Method::EnergyVoronoi,
];

/// Distance of the middles of panes across and upwards, in widths and heights of the body.
const GAPS: [f32; 2] = [1.55, 1.6];

/// Least width and height of a pane over the body's reach: a heading needs room, and the camera may be turned.
const LEAST: [f32; 2] = [1.5, 0.7];

/// Least spread of the drawn pieces, as [`Command::Explode`](crate::Command::Explode) sets it: without it a cracked body would look whole.
const APART: f32 = 0.2;

/// Methods by name, each once; `first` for none.
pub(crate) fn named_methods(word: &str) -> Result<Vec<Method>, String> {
    let mut methods = Vec::new();
    for name in word.split(',').filter(|_| word != "first") {
        let method = Method::from_name(name)?;
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    Ok(methods)
}

/// Outcome of the impact with one method.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Its numbers.
    pub numbers: OutcomeNumbers,
    /// Shapes of the pieces and their positions in the body, m; empty if it did not break.
    shapes: Vec<(Vec3, RecordedMesh)>,
}

impl Outcome {
    pub(crate) fn new(broken: Broken, blow: &Blow, live: &LiveScene) -> Self {
        let numbers = OutcomeNumbers {
            method: broken.method,
            pieces: broken.pieces(),
            largest_share: broken.largest_share(),
            crack_area: broken.crack_area,
            energy: broken.energy,
            seconds: broken.seconds,
        };
        let mut outcome = Self {
            numbers,
            shapes: Vec::new(),
        };
        if let Some(thing) = live.things().get(blow.thing) {
            let fracture = Fracture::new(broken.fragments, ImpactReport::default());
            outcome.shapes = live.shapes(thing, &fracture);
        }
        outcome
    }
}

/// Outcomes of an impact with several methods.
#[derive(Clone, Debug)]
pub struct Methods {
    /// The impact.
    pub blow: Arc<Blow>,
    /// Methods that are shown, row by row from the upper left.
    pub chosen: Vec<Method>,
    /// Outcomes so far.
    pub outcomes: Vec<Arc<Outcome>>,
    /// Direction towards the camera of the scene.
    pub(crate) look_from: Vec3,
}

/// Layout of the panes.
struct Layout {
    /// Right and up directions in the picture.
    axes: [Vec3; 2],
    /// Width and height of the body in the view, m.
    size: [f32; 2],
    columns: usize,
    rows: usize,
}

impl Methods {
    /// Returns the outcome of a method, if it has been computed.
    #[must_use]
    pub fn outcome(&self, method: Method) -> Option<&Arc<Outcome>> {
        self.outcomes
            .iter()
            .find(|known| known.numbers.method == method)
    }

    /// Half the width and height of all panes, m.
    pub(crate) fn extent(&self) -> [f32; 2] {
        let Layout {
            size,
            columns,
            rows,
            ..
        } = self.layout();
        let half = |count: usize, k: usize| {
            let apart = GAPS[k] * (count as f32 - 1.0) * size[k];
            0.5 * (apart + 1.4 * size[k])
        };
        [half(columns, 0), half(rows, 1)]
    }

    /// Two methods side by side, more in two rows.
    fn layout(&self) -> Layout {
        let back = self.look_from.normalize_or(Vec3::Z);
        let right = Vec3::Y.cross(back).normalize_or(Vec3::X);
        let axes = [right, back.cross(right)];
        let asset = self.blow.body.asset();
        let rotation = self.blow.pose.rotation.normalize();
        let reach = reach(asset);
        let size = [0, 1].map(|k: usize| {
            let along = asset.fracture().positions.iter();
            let along = along.map(|&p| (rotation * p).dot(axes[k]).abs());
            2.0 * along.fold(0.5 * LEAST[k] * reach, f32::max)
        });
        let count = self.chosen.len().max(1);
        Layout {
            axes,
            size,
            columns: count.min(2),
            rows: count.div_ceil(2),
        }
    }

    /// The panes, pieces drawn apart by `explode`, and their labels.
    pub(crate) fn draw(&self, live: &LiveScene, explode: f32) -> (Vec<Batch>, Vec<Label>) {
        let Layout {
            axes: [right, up],
            size: [width, height],
            columns,
            rows,
        } = self.layout();
        let blow = &*self.blow;
        let mut batches: BTreeMap<usize, Batch> = BTreeMap::new();
        let mut labels = Vec::new();
        for (i, &method) in self.chosen.iter().enumerate() {
            let across = (i % columns) as f32 - 0.5 * (columns as f32 - 1.0);
            let down = (i / columns) as f32 - 0.5 * (rows as f32 - 1.0);
            let shift = GAPS[0] * width * across * right - GAPS[1] * height * down * up;
            let Some(outcome) = self.outcome(method) else {
                continue;
            };
            for (birth, mesh) in &outcome.shapes {
                let middle = (1.0 + explode.max(APART)) * *birth;
                place(live, mesh, blow, middle, shift, &mut batches);
            }
            if let (true, Some(thing)) =
                (outcome.numbers.pieces == 1, live.things().get(blow.thing))
            {
                place(live, &thing.mesh, blow, Vec3::ZERO, shift, &mut batches);
            }
            labels.push(Label {
                at: blow.pose.translation + shift + 0.62 * height * up,
                text: match outcome.numbers.pieces {
                    1 => format!("{}: held", method.title()),
                    pieces => format!("{}: {pieces} pieces", method.title()),
                },
            });
        }
        for batch in batches.values_mut() {
            batch.faces = Arc::new(numbered(batch.positions.len()));
        }
        (batches.into_values().collect(), labels)
    }
}
