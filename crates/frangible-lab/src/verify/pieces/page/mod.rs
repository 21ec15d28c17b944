//! The page. Every sentence that depends on the outcome is made from the numbers.

mod verdict;

use std::fmt::Write;

use super::measure::NUDGE;
use super::statistics::{Worth, decisions, quantile};
use super::way::{FINEST, WAYS};
use super::{PieceSample, Truth};
use crate::page::{Page, table};
use crate::verify::{VerifyError, png};

/// Size of a chart, pixels.
const CHART: (u32, u32) = (800, 600);

/// Bounds of the classes of size, uncut tetrahedra.
const CLASSES: [usize; 5] = [0, 300, 1000, 3000, usize::MAX];

impl Truth {
    /// The page; its pictures are `FOLDER/NAME.png`. Times and memory aside, the same build writes the same page.
    ///
    /// # Errors
    /// A picture that could not be encoded.
    pub fn page(&self, folder: &str) -> Result<Page, VerifyError> {
        let mut text = String::from(
            "# Pieces that break again: which way is right?\n\nWritten by `frangible-lab pieces --write docs`, which computes \
             it anew. Here nothing passes or fails; all sentences about outcomes are made from the computed numbers.\n\n",
        );
        self.method(&mut text);
        self.by_way(&mut text, folder);
        self.by_size(&mut text);
        self.by_level(&mut text);
        self.targets(&mut text);
        self.choice(&mut text);
        self.single_basis(&mut text);
        self.truth_of_the_truth(&mut text);
        let mut pictures = Vec::new();
        for (name, chart) in [("errors", self.errors_chart()), ("time", self.time_chart())] {
            let picture = chart.draw(CHART.0, CHART.1);
            pictures.push((name.into(), png(name, &picture)?));
        }
        Ok(Page { text, pictures })
    }

    /// The table by way, for a terminal.
    #[must_use]
    pub fn rows(&self) -> Vec<Vec<String>> {
        (0..WAYS.len())
            .map(|way| row(WAYS[way].name, &Worth::of(self.pieces.iter(), way)))
            .collect()
    }

    /// The heads of its columns.
    #[must_use]
    pub fn head() -> Vec<String> {
        [
            "",
            "frequencies",
            "largest tension",
            "bias",
            "its place",
            "decides right",
            "ready, ms",
            "kB",
            "refused",
        ]
        .map(String::from)
        .into()
    }

    fn method(&self, text: &mut String) {
        let mut names: Vec<&str> = self.pieces.iter().map(|p| p.name.as_str()).collect();
        names.sort_unstable();
        let each: Vec<String> = names
            .chunk_by(|a, b| a == b)
            .map(|n| format!("{} {}", n[0], n.len()))
            .collect();
        let tets = |share| quantile(&self.numbers(|p| p.tets as f64), share).unwrap_or(0.0);
        let mass = |share| 1e3 * quantile(&self.numbers(|p| p.mass), share).unwrap_or(0.0);
        let blows = self.pieces.iter().flat_map(|p| &p.blows);
        let broke = blows.clone().filter(|b| b.breaks).count();
        let _ = writeln!(
            text,
            "{} fragments of the built-in scenes ({}), of {:.0} to {:.0} uncut tetrahedra (median {:.0}) and {:.1} g to {:.0} g. \
             Each is hit at three seeded places of its surface, inwards, as if it fell on stone there (one that is still held: by a \
             steel ball of its mass), so fast that the largest tension is about 0.5, 1.2 and 3 times the strength of its weak \
             point; {broke} of {} blows break the piece. The truth is a modal analysis of the piece itself on about {} quadratic \
             elements with {} modes, as fine as a bake. Every way is given the same contacts, and answers with a contact duration \
             of its own.\n",
            self.pieces.len(),
            each.join(", "),
            tets(0.0),
            tets(1.0),
            tets(0.5),
            mass(0.0),
            mass(1.0),
            blows.count(),
            self.plan.elements,
            self.plan.modes,
        );
        if !self.refused.is_empty() {
            let _ = writeln!(
                text,
                "The full analysis refused {} more: {}.\n",
                self.refused.len(),
                self.refused.join("; ")
            );
        }
    }

    fn by_way(&self, text: &mut String, folder: &str) {
        let _ = writeln!(
            text,
            "## By way\n\nErrors of the first five frequencies and of the largest tension at a weak point before any crack: median, \
             and what nine of ten stay below. *Bias*: median of the tension over the truth's, less one. *Its place*: how far the \
             most stressed weak point lies from the truth's, in diagonals of the box around the piece, median. *Decides right*: \
             breaks or holds as the truth does. *Ready*: processor time of one thread from the broken parent to a piece that can be \
             hit, median. *kB*: elements, modes, places in the elements and surface of a piece, median; the fracture mesh belongs \
             to the body that broke.\n\n{}",
            table(&Self::head(), &self.rows())
        );
        let _ = writeln!(
            text,
            "![How far the largest tension is off]({folder}/errors.png)\n\n![Time until ready by size]({folder}/time.png)\n"
        );
    }

    fn by_size(&self, text: &mut String) {
        let head = [
            "uncut tetrahedra",
            "way",
            "pieces",
            "frequencies",
            "largest tension",
            "decides right",
            "ready, ms",
        ];
        let mut rows = Vec::new();
        for bounds in CLASSES.windows(2) {
            let class = |p: &&PieceSample| (bounds[0]..bounds[1]).contains(&p.tets);
            for way in 0..WAYS.len() {
                let worth = Worth::of(self.pieces.iter().filter(class), way);
                if worth.served == 0 {
                    continue;
                }
                rows.push(vec![
                    class_name(bounds),
                    WAYS[way].name.into(),
                    worth.served.to_string(),
                    pair(worth.frequency),
                    pair(worth.stress),
                    share(worth.right),
                    milliseconds(worth.ready),
                ]);
            }
        }
        let _ = writeln!(
            text,
            "## By size\n\n{}",
            table(&head.map(String::from), &rows)
        );
    }

    fn by_level(&self, text: &mut String) {
        let levels = [(0.0, 0.8), (0.8, 2.0), (2.0, f64::INFINITY)];
        let mut head = vec![String::new()];
        head.extend(levels.map(|(low, high)| {
            let all = self.pieces.iter().flat_map(|p| &p.blows);
            let count = all.filter(|b| (low..high).contains(&b.level)).count();
            if high.is_finite() {
                format!("{low} to {high} strengths ({count} blows)")
            } else {
                format!("more ({count} blows)")
            }
        }));
        let mut rows: Vec<Vec<String>> = (0..WAYS.len())
            .map(|way| {
                let mut row = vec![WAYS[way].name.to_string()];
                row.extend(levels.map(|(low, high)| {
                    let right = self
                        .pieces
                        .iter()
                        .filter_map(|p| p.ways[way].as_ref().map(|w| (p, w)));
                    let right: Vec<bool> = right
                        .flat_map(|(p, w)| {
                            let levels = p.blows.iter().map(|b| b.level);
                            decisions(p, w).zip(levels).collect::<Vec<_>>()
                        })
                        .filter(|(_, level)| (low..high).contains(level))
                        .map(|d| d.0)
                        .collect();
                    let count = right.iter().filter(|r| **r).count();
                    share((!right.is_empty()).then(|| count as f64 / right.len() as f64))
                }));
                row
            })
            .collect();
        let mut truth = vec![format!("the truth at {:.0} % other speed", 100.0 * NUDGE)];
        truth.extend(levels.map(|(low, high)| share(self.sure(low..high))));
        rows.push(truth);
        let _ = writeln!(
            text,
            "## How near the decision is\n\nBlows decided right, by the largest tension of the truth. Around the strength a few per \
             cent of stress decide, and whether a crack then parts the piece is decided by energy as well. How sharp the question \
             is, the truth itself tells: hit {:.0} % slower or {:.0} % faster, it decides as at the speed itself in {} of the cases; \
             a way whose stresses are off by as much cannot be asked for more. *{}*, which is nearly the truth, decides {} right.\n\n{}",
            100.0 * NUDGE,
            100.0 * NUDGE,
            share(self.sure(0.0..f64::INFINITY)),
            WAYS[FINEST].name,
            share(Worth::of(self.pieces.iter(), FINEST).right),
            table(&head, &rows)
        );
    }

    /// Share of the truth's decisions, at levels in this range, that stay when the blow is a little slower or faster.
    fn sure(&self, levels: std::ops::Range<f64>) -> Option<f64> {
        let blows = self.pieces.iter().flat_map(|p| &p.blows);
        let same: Vec<bool> = blows
            .filter(|b| levels.contains(&b.level))
            .flat_map(|b| b.nudged.map(|breaks| breaks == b.breaks))
            .collect();
        let count = same.iter().filter(|s| **s).count();
        (!same.is_empty()).then(|| count as f64 / same.len() as f64)
    }

    fn numbers(&self, of: impl Fn(&PieceSample) -> f64) -> Vec<f64> {
        self.pieces.iter().map(of).collect()
    }
}

fn row(name: &str, worth: &Worth) -> Vec<String> {
    vec![
        name.into(),
        pair(worth.frequency),
        pair(worth.stress),
        worth.bias.map_or_else(|| "–".into(), signed),
        worth
            .apart
            .map_or_else(|| "–".into(), |a| format!("{a:.2}")),
        share(worth.right),
        milliseconds(worth.ready),
        worth
            .bytes
            .map_or_else(|| "–".into(), |b| format!("{:.0}", 1e-3 * b)),
        worth.refused.to_string(),
    ]
}

fn class_name(bounds: &[usize]) -> String {
    match bounds {
        [0, high] => format!("below {high}"),
        [low, usize::MAX] => format!("{low} and more"),
        [low, high] => format!("{low} to {high}"),
        _ => String::new(),
    }
}

fn pair(both: Option<[f64; 2]>) -> String {
    both.map_or_else(
        || "–".into(),
        |[a, b]| format!("{} / {}", per_cent(Some(a)), per_cent(Some(b))),
    )
}

/// Per cent, with a decimal below ten.
fn per_cent(share: Option<f64>) -> String {
    match share {
        None => "–".into(),
        Some(s) if s < 0.0995 => format!("{:.1} %", 100.0 * s),
        Some(s) => format!("{:.0} %", 100.0 * s),
    }
}

fn signed(share: f64) -> String {
    format!("{:+.1} %", 100.0 * share).replace('-', "−")
}

/// Per cent of decisions.
fn share(share: Option<f64>) -> String {
    share.map_or_else(|| "–".into(), |s| format!("{:.1} %", 100.0 * s))
}

fn milliseconds(seconds: Option<f64>) -> String {
    match seconds {
        None => "–".into(),
        Some(s) if s < 0.01 => format!("{:.1}", 1e3 * s),
        Some(s) => format!("{:.0}", 1e3 * s),
    }
}
