//! Pictures of the comparison.

use super::statistics::quantile;
use super::way::WAYS;
use super::{PieceSample, Truth};
use crate::plot::{Axis, Chart, Marker, Series};

/// Points of a curve.
const POINTS: usize = 20;
/// Markers that tell the ways apart beside their colours.
const MARKERS: [Marker; 4] = [
    Marker::Disc,
    Marker::Square,
    Marker::Diamond,
    Marker::Triangle,
];

impl Truth {
    /// Chart of the share of blows that a way gets wrong by no more than an error.
    pub(crate) fn errors_chart(&self) -> Chart {
        let series = WAYS.iter().enumerate().map(|(way, named)| {
            let blows = of_way(&self.pieces, way).flat_map(|(_, s)| s.blows.iter());
            let errors: Vec<f64> = blows.map(|b| 100.0 * (b.stress - 1.0).abs()).collect();
            let points = (1..=POINTS).filter_map(|k| {
                let share = k as f64 / POINTS as f64;
                Some((quantile(&errors, share)?.max(0.1), 100.0 * share))
            });
            Series {
                name: named.name.into(),
                points: points.collect(),
                marker: MARKERS[way % MARKERS.len()],
                line: true,
            }
        });
        // Auto repeats one of the others.
        let series = series.take(WAYS.len() - 1).collect();
        Chart {
            title: "How far the largest tension of a blow is off".into(),
            x: Axis::log("error, % of the full analysis"),
            y: Axis::linear("blows with no larger error, %").including(0.0),
            series,
        }
    }

    /// Chart of the time until a piece is ready, by its size.
    pub(crate) fn time_chart(&self) -> Chart {
        let series = WAYS.iter().enumerate().map(|(way, named)| {
            let points =
                of_way(&self.pieces, way).map(|(p, s)| (p.tets as f64, 1e3 * s.reading.ready));
            Series {
                name: named.name.into(),
                points: points.collect(),
                marker: MARKERS[way % MARKERS.len()],
                line: false,
            }
        });
        Chart {
            title: "Until a piece can break again".into(),
            x: Axis::log("uncut tetrahedra of the piece"),
            y: Axis::log("time of one thread, ms"),
            series: series.take(WAYS.len() - 1).collect(),
        }
    }
}

fn of_way(
    pieces: &[PieceSample],
    way: usize,
) -> impl Iterator<Item = (&PieceSample, &super::Sample)> {
    pieces
        .iter()
        .filter_map(move |p| p.ways[way].as_ref().map(|w| (p, w)))
}
