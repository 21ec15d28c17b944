//! Conclusions from the numbers: targets, the default, the single basis, and the accuracy of the truth.

use std::fmt::Write;

use frangible_bake::pieces::Method;

use super::{milliseconds, per_cent, share, signed};
use crate::page::table;
use crate::verify::pieces::statistics::{Worth, quantile};
use crate::verify::pieces::way::{AUTO, FINE, PARENT_MODES, WAYS};
use crate::verify::pieces::{PieceSample, Truth};

/// Targets of a reanalysis: errors of frequencies and of the largest tension (medians), share of right decisions, time for a piece of about so many
/// tetrahedra, s.
const TARGETS: [f64; 4] = [0.05, 0.15, 0.95, 0.1];
const TARGET_TETS: std::ops::Range<usize> = 1500..2700;

impl Truth {
    pub(super) fn targets(&self, text: &mut String) {
        let worth = Worth::of(self.pieces.iter(), AUTO);
        let class = |p: &&PieceSample| TARGET_TETS.contains(&p.tets);
        let near = Worth::of(self.pieces.iter().filter(class), AUTO);
        let line = |met: Option<bool>, what: String| {
            let verdict = match met {
                Some(true) => "met",
                Some(false) => "**missed**",
                None => "not measured",
            };
            format!("- {what}: {verdict}.\n")
        };
        let _ = writeln!(
            text,
            "## What a reanalysis is to reach\n\n*{}*, a reanalysis on as many elements as the size asks for:\n\n{}{}{}{}",
            WAYS[AUTO].name,
            line(
                worth.frequency.map(|f| f[0] <= TARGETS[0]),
                format!(
                    "frequencies within 5 % (median): {}",
                    per_cent(worth.frequency.map(|f| f[0]))
                )
            ),
            line(
                worth.stress.map(|s| s[0] <= TARGETS[1]),
                format!(
                    "largest tension within 15 % (median): {}",
                    per_cent(worth.stress.map(|s| s[0]))
                )
            ),
            line(
                worth.right.map(|r| r >= TARGETS[2]),
                format!("right in 95 % of the decisions: {}", share(worth.right))
            ),
            line(
                near.ready.map(|r| r <= TARGETS[3]),
                format!(
                    "ready within 100 ms for a piece of 2000 tetrahedra on one core: {} ms, the median of {} pieces of {} to {}",
                    milliseconds(near.ready),
                    near.served,
                    TARGET_TETS.start,
                    TARGET_TETS.end
                )
            ),
        );
    }

    pub(super) fn choice(&self, text: &mut String) {
        let worth: Vec<Worth> = (0..WAYS.len())
            .map(|w| Worth::of(self.pieces.iter(), w))
            .collect();
        let default = Method::default();
        let _ = write!(
            text,
            "## The default\n\nThe default is *{}*: ",
            WAYS.iter()
                .find(|w| w.method == default)
                .map_or("", |w| w.name)
        );
        let pieces = frangible_bake::pieces::Pieces::default();
        let sizes = [100, 2000, 8000, 20_000];
        let of_sizes: Vec<String> = sizes
            .iter()
            .map(|&tets| format!("{} of {tets}", pieces.elements_for(tets)))
            .collect();
        let _ = write!(
            text,
            "a reanalysis of every piece, {} modes, on about as many elements as the size asks for ({} uncut tetrahedra). ",
            pieces.modes,
            of_sizes.join(", ")
        );
        let error = |w: usize| worth[w].stress.map_or(f64::INFINITY, |s| s[0]);
        let in_time = |w: &usize| worth[*w].ready.is_some_and(|r| r <= TARGETS[3]);
        let best = (0..AUTO)
            .filter(in_time)
            .min_by(|&a, &b| error(a).total_cmp(&error(b)));
        if let Some(best) = best {
            let _ = write!(
                text,
                "Of the ways that are ready within 100 ms (median of all pieces) *{}* has the smallest error of the largest tension, \
                 {}; the default has {}, and decides {} right against {}. ",
                WAYS[best].name,
                per_cent(Some(error(best))),
                per_cent(Some(error(AUTO))),
                share(worth[AUTO].right),
                share(worth[best].right),
            );
        }
        let _ = writeln!(
            text,
            "For comparison, *{}* decides {} right, at {} ms. Until the default is ready the parent's modes serve; they decide \
             {} right.\n",
            WAYS[FINE].name,
            share(worth[FINE].right),
            milliseconds(worth[FINE].ready),
            share(worth[PARENT_MODES].right),
        );
    }

    pub(super) fn single_basis(&self, text: &mut String) {
        let parent = Worth::of(self.pieces.iter(), PARENT_MODES);
        let blows = self.pieces.iter().flat_map(|p| &p.blows);
        let held = blows.clone().filter(|b| !b.breaks).count();
        let softened: Vec<f64> = blows.filter_map(|b| b.softened.map(|s| 1.0 - s)).collect();
        let little = quantile(&softened, 0.5)
            .zip(parent.frequency)
            .is_some_and(|(cracks, parting)| cracks.abs() < 0.25 * parting[0]);
        let verdict = if little {
            "Cracks that part nothing change the modes little beside what parting does: the assumption serves until pieces part, and \
             must not be kept after that."
        } else {
            "Cracks that part nothing change the modes about as much as parting does: the assumption is in doubt within one blow \
             already."
        };
        let _ = writeln!(
            text,
            "## The single basis\n\nDuring a break the modes of the unbroken body serve (the *single-basis assumption*): the stress that \
             drives the cracks is that of a body that has none yet, but for the release waves, and for small pieces that come to rest when \
             they are cut off. How far off that becomes is seen in what it would mean to go on with it. On a piece the body's own modes, restricted to it and made orthogonal to its rigid \
             motions, are off by {} in frequency and {} in the largest tension (median), since they cannot follow the new free \
             faces. Of {held} blows that did not break their piece, {} left cracks; with them its first frequency is {} of what it was \
             (median; the lowest {}). {verdict}\n",
            per_cent(parent.frequency.map(|f| f[0])),
            per_cent(parent.stress.map(|s| s[0])),
            softened.len(),
            per_cent(quantile(&softened, 0.5).map(|s| 1.0 - s)),
            per_cent(quantile(&softened, 1.0).map(|s| 1.0 - s)),
        );
    }

    pub(super) fn truth_of_the_truth(&self, text: &mut String) {
        let rows: Vec<Vec<String>> = self
            .baked
            .iter()
            .map(|b| {
                let errors: Vec<f64> = b.frequencies.iter().map(|r| (r - 1.0).abs()).collect();
                vec![
                    b.name.clone(),
                    b.tets.to_string(),
                    signed(b.volume - 1.0),
                    signed(b.frequencies.first().map_or(0.0, |f| f - 1.0)),
                    per_cent(quantile(&errors, 1.0)),
                ]
            })
            .collect();
        let all = self.baked.iter().flat_map(|b| &b.frequencies);
        let errors: Vec<f64> = all.map(|r| (r - 1.0).abs()).collect();
        let head = [
            "body",
            "uncut tetrahedra",
            "volume",
            "first frequency",
            "largest error of five",
        ]
        .map(String::from);
        let _ = writeln!(
            text,
            "## Is the truth true?\n\n{} of the free pieces were also meshed anew from their closed surface, whose rough crack faces the new \
             mesh rounds a little, and baked; what cracks a piece keeps inside, its surface does not show, so that such a piece is softer than its \
             bake. Frequencies of the full analysis against that bake: {} in the median, {} at most.\n\n{}",
            self.baked.len(),
            per_cent(quantile(&errors, 0.5)),
            per_cent(quantile(&errors, 1.0)),
            table(&head, &rows)
        );
    }
}
