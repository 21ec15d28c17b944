//! Bytes of assets and bodies.

use std::fmt::Write;

use super::{digits, table};
use crate::bench::memory::OfBody;

/// Targets for the largest slab's file, bytes: full precision, half precision.
const TARGETS: [usize; 2] = [30_000_000, 20_000_000];
/// The largest slab.
const LARGEST: &str = "slab-very-high";

/// Table of the bodies' sizes.
#[must_use]
pub fn memory(bodies: &[OfBody]) -> String {
    let mb = |bytes: f64| digits(1e-6 * bytes);
    let rows: Vec<Vec<String>> = (bodies.iter())
        .map(|b| {
            vec![
                b.name.to_string(),
                b.tets.to_string(),
                b.analysis_nodes.to_string(),
                mb(b.file as f64),
                mb(b.compact as f64),
                format!("{:.2} %", 100.0 * b.change),
                mb(b.asset as f64),
                mb(b.prepared as f64),
                b.weak_points.to_string(),
                digits(1e-3 * b.body as f64),
                mb(b.broken as f64),
            ]
        })
        .collect();
    let header = [
        "body",
        "tetrahedra",
        "analysis nodes",
        "file, MB",
        "half precision, MB",
        "changes stress by",
        "asset in memory, MB",
        "made ready, MB",
        "weak points",
        "each body, kB",
        "while it breaks, MB",
    ];
    let mut text = String::from(
        "The bodies of Table 1, 100 modes. An asset and what is made ready of it (trees, stress bounds, what hangs together) are shared by all \
         bodies of a kind; a body has its weak points and its cracks. While it breaks: the most that an impact held at a time beside all that, \
         its pieces included, in our model. Half precision is that of mode shapes in the file, in memory they are f32 again; beside it the largest \
         change of a mode's peak stress. Counted by the allocator, MB of 10⁶ bytes.\n\n",
    );
    text += &table(&header, &rows);
    if let Some(slab) = bodies.iter().find(|b| b.name == LARGEST) {
        let met = |bytes, target| if bytes <= target { "met" } else { "missed" };
        let _ = write!(
            text,
            "\nThe largest slab: {} MB, target {} MB, {}; with half precision {} MB, target {} MB, {}.\n",
            mb(slab.file as f64),
            TARGETS[0] / 1_000_000,
            met(slab.file, TARGETS[0]),
            mb(slab.compact as f64),
            TARGETS[1] / 1_000_000,
            met(slab.compact, TARGETS[1]),
        );
    }
    text
}
