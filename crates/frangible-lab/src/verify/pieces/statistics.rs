//! Statistics of a way over many pieces.

use serde::Serialize;

use super::measure::{BlowSample, PieceSample, Sample};

/// A way over some pieces. Errors are relative.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Worth {
    /// Pieces that it served, and that it refused.
    pub(crate) served: usize,
    pub(crate) refused: usize,
    /// Size of the error of the first five frequencies: median, and 90th percentile.
    pub(crate) frequency: Option<[f64; 2]>,
    /// Size of the error of the largest tension, the same.
    pub(crate) stress: Option<[f64; 2]>,
    /// Median of the largest tension over the truth's, minus one.
    pub(crate) bias: Option<f64>,
    /// Distance of its place in sizes of the piece, median.
    pub(crate) apart: Option<f64>,
    /// Share of the blows that it decides as the truth does.
    pub(crate) right: Option<f64>,
    /// Time until ready, s, and memory, bytes: medians.
    pub(crate) ready_s: Option<f64>,
    pub(crate) bytes: Option<f64>,
}

impl Worth {
    /// Computes the statistics of a way over these pieces.
    pub(crate) fn of<'a>(
        pieces: impl Iterator<Item = &'a PieceSample> + Clone,
        way: usize,
    ) -> Self {
        let served = pieces
            .clone()
            .filter_map(|p| p.ways[way].as_ref().map(|w| (p, w)));
        let frequencies: Vec<f64> = served
            .clone()
            .flat_map(|(p, w)| frequency_errors(p, w))
            .collect();
        let blows = served.clone().flat_map(|(_, w)| &w.blows);
        let ratios: Vec<f64> = blows.clone().map(|b| b.stress).collect();
        let errors: Vec<f64> = ratios.iter().map(|r| (r - 1.0).abs()).collect();
        let apart: Vec<f64> = blows.filter_map(|b| b.apart).collect();
        let decided: Vec<bool> = served.clone().flat_map(|(p, w)| decisions(p, w)).collect();
        let right = decided.iter().filter(|right| **right).count();
        let ready: Vec<f64> = served.clone().map(|(_, w)| w.reading.ready).collect();
        let bytes: Vec<f64> = served
            .clone()
            .map(|(_, w)| w.reading.bytes as f64)
            .collect();
        let served = served.count();
        Self {
            served,
            refused: pieces.count() - served,
            frequency: both(&frequencies),
            stress: both(&errors),
            bias: quantile(&ratios, 0.5).map(|r| r - 1.0),
            apart: quantile(&apart, 0.5),
            right: (!decided.is_empty()).then(|| right as f64 / decided.len() as f64),
            ready_s: quantile(&ready, 0.5),
            bytes: quantile(&bytes, 0.5),
        }
    }
}

fn both(errors: &[f64]) -> Option<[f64; 2]> {
    Some([quantile(errors, 0.5)?, quantile(errors, 0.9)?])
}

/// Sizes of the relative errors of the first frequencies.
fn frequency_errors(piece: &PieceSample, sample: &Sample) -> impl Iterator<Item = f64> {
    let own = sample.reading.frequencies.iter();
    own.zip(&piece.truth.frequencies)
        .map(|(f, t)| (f / t - 1.0).abs())
}

/// True for each blow that is decided as the truth decides it.
pub(crate) fn decisions(piece: &PieceSample, sample: &Sample) -> impl Iterator<Item = bool> {
    let same = |(own, truth): (&BlowSample, &super::Blow)| own.breaks == truth.breaks;
    sample.blows.iter().zip(&piece.blows).map(same)
}

/// The value that this share of the numbers stays below; none of no numbers.
pub(crate) fn quantile(numbers: &[f64], share: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = numbers.iter().copied().filter(|x| !x.is_nan()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = share * last as f64;
    let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
    Some(low + (high - low) * at.fract())
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn a_quantile_lies_between_its_neighbours() {
        let numbers = [4.0, 1.0, 3.0, 2.0, f64::NAN];
        assert_eq!(quantile(&numbers, 0.0), Some(1.0));
        assert_eq!(quantile(&numbers, 0.5), Some(2.5));
        assert_eq!(quantile(&numbers, 1.0), Some(4.0));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
