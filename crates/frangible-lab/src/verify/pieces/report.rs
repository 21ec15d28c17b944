//! The numbers of the comparison: by way, by size and by level of the blow.

use std::ops::Range;

use serde_json::{Value, json};

use super::measure::NUDGE;
use super::statistics::{Worth, decisions, quantile};
use super::way::WAYS;
use super::{PieceSample, Truth};

/// Bounds of the classes of size, uncut tetrahedra.
const CLASSES: [usize; 5] = [0, 300, 1000, 3000, usize::MAX];
/// Sizes for which a reanalysis has a target time, uncut tetrahedra.
const TARGET: Range<usize> = 1500..2700;
/// Classes of the largest tension of a blow, in strengths.
const LEVELS: [Range<f64>; 3] = [0.0..0.8, 0.8..2.0, 2.0..f64::INFINITY];
/// Shares of the blows for which the error that they stay below is given.
const SHARES: u32 = 20;

impl Truth {
    /// The numbers. Times and memory aside, the same build gives the same ones.
    #[must_use]
    pub fn data(&self) -> Value {
        let ways = 0..WAYS.len();
        let by_size = CLASSES.windows(2).flat_map(|bounds| {
            let class = bounds[0]..bounds[1];
            ways.clone().map(move |way| self.of_size(&class, way))
        });
        let blows = || self.pieces.iter().flat_map(|p| &p.blows);
        let softened: Vec<f64> = blows().filter_map(|b| b.softened).collect();
        let sure = LEVELS.map(|level| self.sure(&level));
        json!({
            "plan": self.plan,
            "pieces": self.pieces.len(),
            "refused": self.refused,
            "blows": blows().count(),
            "break": blows().filter(|b| b.breaks).count(),
            "ways": ways.clone().map(|way| self.of_way(way)).collect::<Vec<_>>(),
            "by_size": by_size.filter(|row| row["served"] != 0).collect::<Vec<_>>(),
            "near_target": self.of_size(&TARGET, WAYS.len() - 1),
            "level_blows": LEVELS.map(|level| blows().filter(|b| level.contains(&b.level)).count()),
            "by_level": ways.map(|way| self.by_level(way)).collect::<Vec<_>>(),
            "truth_nudged": { "speed": NUDGE, "right": sure, "all": self.sure(&(0.0..f64::INFINITY)) },
            "cracked": softened.len(),
            "softened": { "median": quantile(&softened, 0.5), "least": quantile(&softened, 0.0) },
            "rebaked": self.rebaked(),
        })
    }

    fn of_size(&self, class: &Range<usize>, way: usize) -> Value {
        let of = |p: &&PieceSample| class.contains(&p.tets);
        let mut row = json!(Worth::of(self.pieces.iter().filter(of), way));
        row["way"] = json!(WAYS[way].name);
        row["size"] = match class.end {
            usize::MAX => format!("{} and more", class.start),
            end => format!("{} to {end}", class.start),
        }
        .into();
        row
    }

    /// A way over all pieces, with the points of its curves: error in shares and share of the blows below it; uncut tetrahedra and time, s.
    fn of_way(&self, way: usize) -> Value {
        let served = || {
            self.pieces
                .iter()
                .filter_map(|p| p.ways[way].as_ref().map(|w| (p, w)))
        };
        let errors = served()
            .flat_map(|(_, w)| &w.blows)
            .map(|b| (b.stress - 1.0).abs());
        let errors: Vec<f64> = errors.collect();
        let share = |k: u32| f64::from(k) / f64::from(SHARES);
        let below = (1..=SHARES).filter_map(|k| Some([quantile(&errors, share(k))?, share(k)]));
        let times = served().map(|(p, w)| [p.tets as f64, w.reading.ready]);
        let mut row = json!(Worth::of(self.pieces.iter(), way));
        row["way"] = json!(WAYS[way].name);
        row["errors"] = json!(below.collect::<Vec<_>>());
        row["times"] = json!(times.collect::<Vec<_>>());
        row
    }

    /// Share of a way's decisions that are right, by the level of the blow.
    fn by_level(&self, way: usize) -> Value {
        let right = LEVELS.map(|level| {
            let served = self
                .pieces
                .iter()
                .filter_map(|p| p.ways[way].as_ref().map(|w| (p, w)));
            let decided = served.flat_map(|(p, w)| decisions(p, w).zip(&p.blows));
            share(
                decided
                    .filter(|(_, blow)| level.contains(&blow.level))
                    .map(|d| d.0),
            )
        });
        json!({ "way": WAYS[way].name, "right": right })
    }

    /// Share of the truth's decisions that stay when the blow is a little slower or faster.
    fn sure(&self, level: &Range<f64>) -> Option<f64> {
        let blows = self.pieces.iter().flat_map(|p| &p.blows);
        let blows = blows.filter(|b| level.contains(&b.level));
        share(blows.flat_map(|b| b.nudged.map(|breaks| breaks == b.breaks)))
    }

    /// Frequencies of the full analysis over those of a bake of the same piece.
    fn rebaked(&self) -> Value {
        let rows = self.baked.iter().map(|b| {
            let off = b.frequencies.iter().map(|f| (f - 1.0).abs());
            json!({
                "name": b.name, "tets": b.tets, "volume": b.volume - 1.0,
                "first": b.frequencies.first().map(|f| f - 1.0), "largest_of_five": off.fold(0.0, f64::max),
            })
        });
        rows.collect()
    }
}

/// Share of the answers that are yes; none without answers.
fn share(answers: impl Iterator<Item = bool>) -> Option<f64> {
    let (mut yes, mut all) = (0.0, 0.0);
    for answer in answers {
        yes += f64::from(u8::from(answer));
        all += 1.0;
    }
    (all > 0.0).then(|| yes / all)
}
