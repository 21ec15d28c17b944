//! Round numbers along an axis.

/// Numbers with a label, and numbers that only have a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub(super) labelled: Vec<f64>,
    pub(super) plain: Vec<f64>,
}

/// The range with powers of ten, or at least 1, 2, 5 at its ends, and the numbers in between.
pub(super) fn logarithmic(low: f64, high: f64) -> ([f64; 2], Ticks) {
    let steps = |decade: i32, digits: &'static [f64]| {
        digits
            .iter()
            .map(move |digit| digit * 10.0_f64.powi(decade))
    };
    let (first, last) = (
        low.log10().floor() as i32 - 1,
        high.log10().ceil() as i32 + 1,
    );
    let all: Vec<f64> = (first..=last)
        .flat_map(|d| steps(d, &[1.0, 2.0, 5.0]))
        .collect();
    // The last step below and the first above, a rounding error aside.
    let end = |fallback: f64, mut found: Box<dyn Iterator<Item = &f64> + '_>| {
        found.next().copied().unwrap_or(fallback)
    };
    let from = end(
        low,
        Box::new(all.iter().rev().filter(|x| **x <= low * 1.000_001)),
    );
    let to = end(
        high,
        Box::new(all.iter().filter(|x| **x >= high * 0.999_999)),
    );
    let within = |x: &f64| (from * 0.999_999..=to * 1.000_001).contains(x);
    let decades: Vec<f64> = (first..=last)
        .map(|d| 10.0_f64.powi(d))
        .filter(within)
        .collect();
    let labelled = if decades.len() >= 3 {
        decades
    } else {
        all.into_iter().filter(within).collect()
    };
    let nine: &[f64] = &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
    let plain = (first..=last)
        .flat_map(|d| steps(d, nine))
        .filter(within)
        .collect();
    ([from, to], Ticks { labelled, plain })
}

/// The range widened to steps of 1, 2 or 5 times a power of ten, five to ten of them.
pub(super) fn linear(low: f64, high: f64) -> ([f64; 2], Ticks) {
    let span = if high > low {
        high - low
    } else {
        low.abs().max(1.0)
    };
    let power = 10.0_f64.powf((span / 5.0).log10().floor());
    let step = power
        * match span / 5.0 / power {
            share if share < 2.0 => 1.0,
            share if share < 5.0 => 2.0,
            _ => 5.0,
        };
    let (first, last) = ((low / step).floor() as i64, (high / step).ceil() as i64);
    let last = last.max(first + 1);
    let labelled: Vec<f64> = (first..=last).map(|k| k as f64 * step).collect();
    (
        [first as f64 * step, last as f64 * step],
        Ticks {
            plain: labelled.clone(),
            labelled,
        },
    )
}

/// A number without needless digits.
pub(super) fn label(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decade = x.abs().log10().floor() as i32;
    if !(-4..=6).contains(&decade) {
        return format!("{x:.0e}");
    }
    // Rounded to six digits: 3 × 0.1 is not 0.3.
    let decimals = (5 - decade).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{label, linear, logarithmic};

    #[test]
    fn ticks_enclose_every_range_and_are_few() {
        for low in [1e-9, 0.003, 0.99, 1.0, 7.3, 12_345.0] {
            for factor in [1.0, 1.3, 8.0, 100.0, 3e5] {
                let high = low * factor;
                for ([from, to], ticks) in [logarithmic(low, high), linear(low, high)] {
                    assert!(
                        from <= low * 1.001 && high <= to * 1.001,
                        "{low}..{high}: {from}..{to}"
                    );
                    assert!((1..=20).contains(&ticks.labelled.len()), "{ticks:?}");
                }
            }
        }
    }

    #[test]
    fn labels_have_no_needless_digits() {
        let labels = [0.1 * 3.0, 1000.0, 0.02, -5.0, 0.0, 1e-7, 20_000.0].map(label);
        assert_eq!(labels, ["0.3", "1000", "0.02", "-5", "0", "1e-7", "20000"]);
    }
}
